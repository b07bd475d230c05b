//! Bodies that meet surfaces: which points may touch, how they do at the moment, and what an instant changes.
//!
//! [`Pair`] is a point of a body that may touch a surface; [`Phase`] is how it does in a mode; `touch` has the numbers of
//! one body's pairs at an instant; `settle` finds what an instant changes; `cascade` ends impacts that accumulate.

mod cascade;
pub(crate) mod complementarity;
mod feature;
mod interval;
mod pair;
mod pairs;
mod phase;
mod settle;
mod start;
mod switch;
mod touch;

pub use feature::Feature;
pub(crate) use interval::Change;
pub use interval::{Contact, Impulse};
pub use pair::Pair;
pub(crate) use pairs::Pairs;
pub use phase::Phase;
pub(crate) use touch::{Impulses, TouchTapes};
