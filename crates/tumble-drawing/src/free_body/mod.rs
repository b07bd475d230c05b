//! Free-body diagrams: a body at an instant with every force on it, and
//! sheets of several instants at one scale.
//!
//! Arrows start at their points of action. Arrows that would lie on each
//! other are set off sideways by some pixels, so dots mark the true points.
//! An arrow too short to be seen is drawn at a least length with a break in
//! its shaft. Forces of zero are listed below the body instead.
//!
//! ```
//! use tumble_drawing::free_body::{Arrow, FreeBodyDiagram, ArrowKind, FreeBodySheet, Ground};
//! use tumble_drawing::{Label, Outline, Pose};
//!
//! let pose = Pose { t: 0.5, x: 0.0, y: 0.3, angle: 0.64 };
//! let rod = Outline::Segment { from: [-0.5, 0.0], to: [0.5, 0.0] };
//! let body = FreeBodyDiagram::new(Label::plain("rod"), pose, vec![rod])
//!     .heading(Label::plain("touching the floor"))
//!     .surface(Ground::new([0.0, 0.0], [0.0, 1.0], Label::plain("floor")))
//!     .force(Arrow::new(ArrowKind::Weight, Label::markup("$m$ $g$"), [0.0, 0.3], [0.0, -4.905]))
//!     .force(Arrow::new(ArrowKind::Contact, Label::symbol("N"), [-0.4, 0.0], [0.0, 170.0]));
//! let svg = FreeBodySheet { panels: vec![body], ..FreeBodySheet::default() }.svg();
//! assert!(svg.description.contains("N = 170"));
//! ```

mod arrow;
mod body;
pub(crate) mod circular_arrow;
mod cone;
mod describe;
pub(crate) mod draw;
mod fit;
mod grid;
mod key;
pub(crate) mod layout;
mod panel;
mod set_apart;
mod sheet;
mod side;
pub(crate) mod strokes;
pub(crate) mod surface;
mod tags;
#[cfg(test)]
mod tests;

pub use arrow::{Arrow, ArrowKind, ArrowUnit, Couple, DistributedForce, Velocity};
pub use body::{AngleMark, FreeBodyDiagram, NamedPoint};
pub use cone::FrictionCone;
pub use sheet::FreeBodySheet;
pub use side::SideView;
pub use surface::{Ground, GroundCircle};
