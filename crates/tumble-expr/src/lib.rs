//! Formulas with units: from text or from Rust operators to numbers and Taylor coefficients.
//!
//! The way through this crate is
//! [`Expr`] (a typed formula) → [`Graph`] (deduplicated) → [`Tape`] (straight line) →
//! [`Values`] (one value each) or [`Jets`] (Taylor coefficients each), on one number or on lanes of them. Formulas that are parts of
//! many graphs are a [`Fragment`] each, which a [`Linker`] puts into them.
//! It knows nothing of mechanics.

mod active;
mod affine;
mod arena;
mod bernstein;
mod degree;
mod describe;
mod differentiate;
mod dimension;
mod drops;
mod expr;
mod fold;
mod graph;
mod hashing;
mod jets;
pub mod language;
mod linear;
mod link;
mod lower;
mod narrow;
mod operators;
mod ops;
mod outline;
mod peel;
mod remainder;
mod resolved;
mod rounding;
mod same;
mod scalar;
mod shape;
mod signs;
mod simplify;
mod sparse;
mod substitute;
mod table;
mod tape;
mod traces;
mod typing;
mod unit;
mod vector;
mod written;

pub use active::Active;
pub use bernstein::{Bernstein, Row};
pub use degree::Degree;
pub use dimension::{Dimension, Exponent};
pub use expr::{Binary, Expr, Node, Relation, Symbol, Unary};
pub use graph::{Graph, NodeId, is_identically_zero};
pub use hashing::{FastMap, Mixer};
pub use jets::{Branches, Jets, Values};
pub use link::{Code, Fragment, Linker};
pub use ops::kernels::Kernels;
pub use ops::{Op, Series, Slot};
pub use outline::Skeleton;
pub use remainder::Remainders;
pub use rounding::{LEFT_OUT, Rounding, rounded_sum};
pub use same::{Formulas, is_renamed};
pub use scalar::{
    Drawn, Inexact, Interval, Lanes, Lanewise, OneError, Rounded, RoundingError, Scalar, is_short, nearest,
};
pub use shape::SparsityPattern;
pub use sparse::SparseSystem;
pub use substitute::Substitution;
pub use table::{Interpolation, Outside, Table, TableError, TableRef};
pub use tape::{CompileError, Layout, Lookup, Stage, Tape, Turning};
pub use typing::{Kind, TypeError};
pub use unit::{Unit, units};
pub use vector::Vector;
pub use written::{Named, Written};
