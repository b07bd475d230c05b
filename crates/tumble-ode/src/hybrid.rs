//! The seam between a model and the integrator: what moves, by mode, and what happens between modes.

use std::fmt::Debug;
use std::hash::Hash;
use std::sync::Arc;

use crate::Reason;
use crate::flow::Flow;
use crate::program::Program;

/// A system that flows by one set of equations at a time and jumps between them.
pub trait Hybrid {
    /// Which equations hold.
    type Mode: Clone + Eq + Hash + Debug;

    /// What a jump did, in the model's terms, as data.
    type Record: Clone + Debug + Default + PartialEq;

    /// The equations of a mode. Asked for once a mode, when the motion first enters it.
    fn flow(&self, mode: &Self::Mode) -> Result<Flow, Reason>;

    /// The same compiled. What is integrated more than once may keep it.
    fn program(&self, mode: &Self::Mode) -> Result<Arc<Program>, Reason> {
        Ok(Arc::new(Program::new(&self.flow(mode)?)?))
    }

    /// What happens at an instant that ends a flow; all that happens then is given at once.
    fn jump(&self, at: &Crossing<'_, Self::Mode>) -> Result<Jump<Self::Mode, Self::Record>, Reason>;

    /// Bytes that a record holds beside its own size: a motion is kept in memory as a whole.
    fn held_by(_record: &Self::Record) -> usize {
        0
    }
}

/// Direction of a crossing of zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From negative to positive.
    Rising,
    /// From positive to negative.
    Falling,
    /// Either.
    Both,
}

impl Direction {
    /// Whether a crossing to that sign counts.
    pub fn allows(self, to: f64) -> bool {
        match self {
            Self::Rising => to > 0.0,
            Self::Falling => to < 0.0,
            Self::Both => true,
        }
    }
}

/// An instant at which a flow ends.
#[derive(Clone, Debug)]
pub struct Crossing<'a, Mode> {
    /// When, s.
    pub time: f64,
    /// When the event before it was, or the beginning, s.
    pub since: f64,
    /// The mode that ends.
    pub mode: &'a Mode,
    /// The states just before.
    pub states: &'a [f64],
    /// What rounding has left out of the states: added to them, they are as exact as two doubles.
    pub compensation: &'a [f64],
    /// Values of the inputs.
    pub inputs: &'a [f64],
    /// All that happens at this instant.
    pub causes: &'a [Cause],
    /// Scales of the groups of states so far.
    pub scales: &'a [f64],
    /// Jumps of this instant that have left the states as they are, but for rounding, and have come back to this mode, in order: modes that led
    /// into each other around a circle, with what ended each.
    pub around: Vec<(&'a Mode, &'a [Cause])>,
}

/// What ends a flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The scheduled time of that index.
    Scheduled(usize),
    /// The guard of that index crosses zero.
    Guard(usize),
    /// The lazily evaluated guard of that index crosses zero.
    LazyGuard(usize),
    /// The time has come that an earlier jump asked to be woken at.
    Wake,
}

/// How the motion goes on after a crossing.
#[derive(Clone, Debug)]
pub struct Jump<Mode, Record = ()> {
    /// The mode that begins.
    pub mode: Mode,
    /// The states just after; another mode may have another number of them.
    pub states: Vec<f64>,
    /// What happened, in the model's terms.
    pub record: Record,
    /// Whether the motion ends here.
    pub stop: bool,
    /// Guards and lazily evaluated guards of the new mode that are zero now, whatever rounding has left of them, by
    /// name; each with how many of its derivatives, itself included, vanish. Those that made the jump have at least
    /// one, but for [`crate::AtZero::Keeps`]: the model says whether that has come to zero and goes on.
    pub zeros: Vec<(String, usize)>,
    /// A later time, s, at which the system is to be asked again.
    pub wake: Option<f64>,
    /// By how much later than told it may happen, s.
    pub early: f64,
}

impl<Mode, Record: Default> Jump<Mode, Record> {
    /// A jump that changes nothing yet.
    pub fn to(mode: Mode, states: Vec<f64>) -> Self {
        Self { mode, states, record: Record::default(), stop: false, zeros: vec![], wake: None, early: 0.0 }
    }
}
