//! Why a motion is not integrated, or no further.

use std::fmt;

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

/// What a run has taken so far, and would take to its end if it went on as in the second half of that.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demands {
    /// Steps taken.
    pub steps: u64,
    /// Time that the run is to end at, s.
    pub until: f64,
    /// Bytes that pieces and events hold.
    pub bytes: u64,
    /// Estimated steps of the whole run.
    pub steps_in_all: f64,
    /// Estimated bytes of the whole run.
    pub bytes_in_all: f64,
    /// Bytes that one run may hold.
    pub limit: u64,
}

/// A number of bytes for people.
struct Size(f64);

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const UNITS: [&str; 4] = ["bytes", "KiB", "MiB", "GiB"];
        let (mut size, mut unit) = (self.0, 0);
        while size >= 1024.0 && unit + 1 < UNITS.len() {
            (size, unit) = (size / 1024.0, unit + 1);
        }
        match size {
            large if large >= 1e4 => write!(f, "{large:.0e} {}", UNITS[unit]),
            _ => write!(f, "{size:.0} {}", UNITS[unit]),
        }
    }
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
    /// A run that holds as much memory as a run may.
    #[error(
        "{} steps hold {} of memory, the most that one run may, and t = {} s is not reached: ask for a shorter run, or look at \
         `{because}`, which makes the steps short",
        demands.steps, Size(demands.bytes as f64), demands.until
    )]
    TooMuchMemory {
        /// What the run has taken.
        demands: Demands,
        /// Name of what makes the steps short.
        because: String,
    },
    /// A run that would need much more memory than a run may hold.
    #[error(
        "{} steps so far hold {} of memory; as the latest of them went, it takes {:.0e} steps and {} to reach t = {} s, and one \
         run may hold {}: ask for a shorter run, or look at `{because}`, which makes the steps short",
        demands.steps, Size(demands.bytes as f64), demands.steps_in_all, Size(demands.bytes_in_all), demands.until,
        Size(demands.limit as f64)
    )]
    WouldTakeTooMuchMemory {
        /// What the run has taken, and would.
        demands: Demands,
        /// Name of what makes the steps short.
        because: String,
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
    /// A branch whose two signs each lead to the other.
    #[error(
        "`{guard}` is zero and stays there: with its sign positive the motion makes it negative, with its sign \
         negative positive, so neither branch of the formula that depends on it holds"
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
    /// A motion on that side of a guard on which its equations do not hold.
    #[error("the motion that was found is none: its equations do not hold beyond the zero of `{guard}`")]
    Beyond {
        /// The guard.
        guard: String,
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
