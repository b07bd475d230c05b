//! Why a motion is not integrated, or no further.

use thiserror::Error;
use tumble_expr::CompileError;

/// A motion that cannot be integrated, with the time it is stopped at.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("stopped at t = {time} s: {reason}")]
pub struct Refusal {
    /// Time up to which the trajectory stands.
    pub time: f64,
    /// What stands in the way.
    #[source]
    pub reason: Reason,
}

/// What stands in the way of a motion.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Reason {
    /// A formula that cannot be evaluated.
    #[error(transparent)]
    Compile(#[from] CompileError),
    /// A derivative that is infinite or not a number.
    #[error(
        "the motion of {state} cannot be continued: its rate of change, or how that changes, is not a finite number"
    )]
    NotFinite {
        /// Name of the state.
        state: String,
    },
    /// A value to start from, or to go on with after an event, that is infinite or not a number.
    #[error("{state} starts as {value}, which is not a finite number")]
    BadStart {
        /// Name of the state.
        state: String,
        /// Its value.
        value: f64,
    },
    /// Steps that shrink without end: the motion has a singularity here.
    #[error("steps became as small as {step:e} s without meeting the accuracy: {state} changes too fast")]
    Stalled {
        /// Length of the last step tried, s.
        step: f64,
        /// Name of the state whose error was largest.
        state: String,
    },
    /// Too many steps.
    #[error("{steps} steps were taken and the end is not reached")]
    TooManySteps {
        /// How many.
        steps: u64,
    },
    /// A scheduled time that is not a number.
    #[error("a scheduled time is {value}, which is not a finite number")]
    BadSchedule {
        /// The time.
        value: f64,
    },
    /// A time to run to that is not a number after the start.
    #[error("the end, {until} s, is not a finite time after the start")]
    BadEnd {
        /// The end asked for.
        until: f64,
    },
    /// A branch both of whose sides lead to the other.
    #[error(
        "`{guard}` is zero and stays there: with its sign positive the motion makes it negative, with its sign \
         negative positive, so neither side of the formula that depends on it holds"
    )]
    Sliding {
        /// The guard.
        guard: String,
    },
    /// The argument of a measured function left the measured range.
    #[error("`{table}` is not measured at {at} (SI units), and says nothing outside its range")]
    OutsideTable {
        /// Name of the table.
        table: String,
        /// The argument, SI units.
        at: f64,
    },
    /// Events that follow each other without time passing.
    #[error("{events} events follow each other without time passing")]
    Chatter {
        /// How many.
        events: u64,
    },
    /// Whoever asked for the motion wants no more of it.
    #[error("interrupted")]
    Interrupted,
    /// The model's own reason.
    #[error("{0}")]
    Model(String),
}
