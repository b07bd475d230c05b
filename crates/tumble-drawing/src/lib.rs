//! Figures of a mechanics laboratory, from plain data: curves, stroboscopic
//! pictures and free-body diagrams.
//!
//! Nothing here integrates or knows a law. Drawings are SVG written by
//! [`svg`]; [`png`](mod@png) turns them into pictures with embedded fonts.

pub mod animation;
pub mod axes;
pub mod curves;
mod ends;
pub mod font;
pub mod free_body;
mod geometry;
#[cfg(feature = "png")]
pub mod gif;
pub mod heading;
pub mod legend;
pub mod map;
mod marks;
pub mod outline;
mod placing;
#[cfg(feature = "png")]
pub mod png;
pub mod rect;
pub mod retrace;
pub mod scale;
pub mod scale_bar;
pub mod scene_drawing;
pub mod stroboscope;
pub mod svg;
pub mod text;
pub mod theme;
pub mod thin;
pub mod ticks;
pub mod track;
mod units;

pub use animation::{Animation, MovingBody, MovingCase, MovingForce, MovingLink};
pub use axes::Axis;
pub use curves::{Band, CurveFigure, DataSeries, Mark};
#[cfg(feature = "png")]
pub use gif::{ANIMATION_SEAL, GifError, animation_gif};
pub use map::MapFigure;
pub use outline::{Outline, Pose};
#[cfg(feature = "png")]
pub use png::{PngError, png};
pub use scale::Range;
pub use scene_drawing::{LinkKind, SceneBody, SceneDrawing, SceneLink};
pub use stroboscope::StroboscopicPicture;
pub use svg::Svg;
pub use text::Label;
pub use track::BodyPath;
