//! Formulas with units: from text or from Rust operators to numbers and Taylor coefficients.
//!
//! The way through this crate is
//! [`Expr`] (a typed formula) → [`Graph`] (deduplicated) → [`Tape`] (straight line) →
//! [`Values`] (one value each) or [`Jets`] (Taylor coefficients each), on one number or on lanes of them.
//! It knows nothing of mechanics.

mod dimension;
mod drops;
mod expr;
mod operators;
mod typing;
mod unit;
mod vector;

pub use dimension::{Dimension, Exponent};
pub use expr::{Binary, Expr, Node, Relation, Symbol, Unary};
pub use typing::{Kind, TypeError};
pub use unit::{Unit, units};
pub use vector::Vector;
