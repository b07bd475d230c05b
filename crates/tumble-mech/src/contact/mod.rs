//! Bodies that meet surfaces: which points may touch, how they do at the moment, and what an instant changes.
//!
//! [`Pair`] is a point of a body that may touch a surface; [`ContactMode`] is how it does in a mode; `touch` has the
//! numbers of one body's pairs at an instant; `settle` finds what an instant changes; `zeno` ends impacts that
//! accumulate.

mod between;
mod border;
mod capture;
mod certain;
mod change;
mod circles;
pub(crate) mod complementarity;
mod contact_mode;
mod depth;
mod feature;
mod grip;
mod interval;
mod lemke;
mod lost;
mod meeting;
mod opposite;
mod outlines;
mod pair;
mod pairs;
mod patch;
mod possible;
mod release;
mod routh;
mod said;
mod settle;
mod slight;
mod slip;
mod slipping;
mod start;
mod sticking;
mod straight;
mod switch;
mod touch;
mod watched;
mod zeno;

pub(crate) use border::{Border, Rim};
pub use change::Change;
pub(crate) use circles::{Circles, Surrounding, meeting, meeting_within};
pub use contact_mode::{ContactMode, Margin};
pub use feature::{Feature, PolygonSide};
pub use grip::{Grip, Way};
pub use interval::Contact;
pub use meeting::BodyContact;
pub(crate) use outlines::Couple;
pub(crate) use pair::{Alike, moves};
pub use pair::{NORMAL, Pair, Rule, TANGENT};
pub(crate) use pairs::Pairs;
pub(crate) use said::{friction_of_bodies, of_surface_and_body};
pub(crate) use settle::{BALANCED, STANDS};
pub(crate) use slip::WEDGED;
pub(crate) use switch::Causes;
pub(crate) use watched::Watched;
