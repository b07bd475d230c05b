//! The scene language: a TOML file becomes a [`Study`], or a list of diagnostics that show what to change.
//!
//! One section of the language a file. There is no physics here: formulas go to `tumble-expr`, bodies and loads to
//! `tumble-mech`.

mod study;

pub use study::{Check, Curve, Plot, Quantity, Stroboscope, Study};
