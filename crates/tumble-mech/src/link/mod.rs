//! Modes by link: the equations of bodies, terms, rows and contacts are prepared once, and a mode puts those together that act.
//!
//! [`Part`] says what there are equations of, in the symbols of the motion; [`Names`] what every such symbol means. [`Linking`]
//! finds what the symbols stand for in a mode, one after the other as they are asked for: a state is a leaf, an acceleration the sum
//! of the terms that act, a multiplier an unknown of its island's rows. It does so in an [`Algebra`]: on the nodes of a linker, which
//! makes programs and tapes without looking through a formula, or on formulas, where they are to be read.

mod algebra;
mod algebraic;
mod flow;
mod instant;
mod island;
mod linking;
mod names;
mod part;
mod readings;

pub(crate) use algebra::{Nodes, Written};
pub(crate) use instant::{InstantTape, InstantTapes, Measured, Pushes, Slipping};
pub(crate) use linking::Linking;
pub(crate) use part::{Library, RowOf, TermOf, total};
