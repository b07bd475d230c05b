//! Initial value problems with events, solved by Taylor steps whose every result is a polynomial.
//!
//! The way through this crate is [`Hybrid`] (what moves, by mode) → [`Program`] (one tape a mode) → [`Solver`] (step by
//! step) → [`Trajectory`] (polynomial pieces and events). The only knob is the [`Accuracy`]. It knows no body.

mod accuracy;
mod check;
mod coefficients;
mod compiled;
mod enclosure;
mod engine;
mod expansion;
mod flow;
mod hybrid;
mod invariants;
mod joined;
mod lazy_guards;
mod order;
mod polynomial;
mod program;
mod radius;
mod refusal;
mod roots;
mod scale;
mod settle;
mod signs;
mod solver;
mod trajectory;
mod whole;
mod work;

pub use accuracy::{Accuracy, AccuracyError};
pub use coefficients::Coefficients;
pub use enclosure::{Bounds, Enclosure, Path, Vanishing};
pub use flow::{AtZero, Flow, Guard, Invariant, LazyGuard, ScaleGroup, StateVariable};
pub use hybrid::{Cause, Crossing, Direction, Hybrid, Jump};
pub use joined::{AsOne, Of, Segment};
pub use lazy_guards::Watched;
pub use program::Program;
pub use refusal::{Demands, Reason, Refusal};
pub use roots::turns;
pub use solver::{Carried, Handover, InitialState, Motion, Over, Solver, Stopped, solve};
pub use trajectory::{Cursor, MotionState, Occurrence, Piece, Side, Spot, Trajectory};
pub use work::Work;
