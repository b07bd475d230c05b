//! Figures of a mechanics laboratory, from plain data: curves, stroboscopic
//! pictures, free-body diagrams, the gallery's page, and the report.
//!
//! Nothing here integrates or knows a law. Drawings are SVG written by
//! [`svg`]; [`png`](mod@png) turns them into pictures with embedded fonts.

pub mod axes;
pub mod curves;
pub mod font;
pub mod free_body;
#[cfg(feature = "png")]
pub mod gif;
pub mod heading;
pub mod legend;
pub mod numeral;
pub mod outline;
pub mod page;
pub mod place;
#[cfg(feature = "png")]
pub mod png;
pub mod rect;
pub mod report;
pub mod retrace;
pub mod scale;
pub mod scale_bar;
pub mod scene_drawing;
pub mod stroboscope;
pub mod svg;
pub mod symbol;
pub mod text;
pub mod theme;
pub mod thin;
pub mod ticks;
pub mod track;

pub use axes::Axis;
pub use curves::{CurveFigure, Mark, Series};
#[cfg(feature = "png")]
pub use gif::{ANIMATION_SEAL, GifError, animation_gif};
pub use outline::{Outline, Pose};
pub use page::{Entry, Figure, GALLERY_SEAL, IndexPage, Link};
#[cfg(feature = "png")]
pub use png::{PngError, png};
pub use report::Report;
pub use scale::Range;
pub use scene_drawing::{SceneBody, SceneDrawing, SceneLink};
pub use stroboscope::{Reference, Stroboscope};
pub use svg::Svg;
pub use text::Label;
pub use ticks::Ticking;
pub use track::{Instants, Track};
