//! The seam between a model and the integrator: what moves, by mode, and what happens between modes.

use std::fmt::Debug;
use std::hash::Hash;
use std::sync::Arc;

use tumble_expr::{Expr, Rounding, Symbol};

use crate::Reason;
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

/// Equations of one mode, as formulas of the states, the time and the inputs.
#[derive(Clone, Debug)]
pub struct Flow {
    /// What changes, each with its rate.
    pub states: Vec<StateVariable>,
    /// The time, s.
    pub time: Symbol,
    /// Parameters, fixed during a run.
    pub inputs: Vec<Symbol>,
    /// How numbers that no `f64` is are rounded.
    pub rounding: Rounding,
    /// Groups of states that share a scale.
    pub groups: Vec<ScaleGroup>,
    /// Times, as formulas of the inputs, at which a step must end and the system is asked to jump.
    pub schedule: Vec<Expr>,
    /// Functions whose zeros end a step and make the system jump.
    pub guards: Vec<Guard>,
    /// Guards that are evaluated only while the motion may reach their zeros.
    pub lazy_guards: Vec<LazyGuard>,
    /// Functions that are zero all along this flow; rounding is taken out of them after each step.
    pub invariants: Vec<Invariant>,
    /// Time transformation: `dt/ds` of the parameter s that the pieces run in, where it is not the time itself.
    /// Positive, but for isolated instants.
    pub time_transformation: Option<Expr>,
}

/// A function whose zero is an event.
#[derive(Clone, Debug)]
pub struct Guard {
    /// Its name, by which it is known in every mode.
    pub name: String,
    /// The function.
    pub formula: Expr,
    /// Which crossings count.
    pub direction: Direction,
    /// What it means to be found at zero at the start of a step, about to cross.
    pub at_zero: AtZero,
}

/// What a guard does that is zero at the start of a step and about to cross.
#[derive(Clone, Debug)]
pub enum AtZero {
    /// Nothing: what starts at a value has not passed it.
    Begins,
    /// The flow holds on one side only, and ends at once.
    Ends,
    /// The same, if it matters: the guard is a force that holds something in its place, with this acceleration, a
    /// formula of the inputs, for each unit of it. What it would move within the step counts if it is more than a
    /// rounding error of the group's scale.
    EndsIfItMoves {
        /// Acceleration for each unit of the guard.
        response: Expr,
        /// Index of the [`ScaleGroup`] of what it moves.
        group: usize,
    },
}

/// A guard outside the tape of the field: of many of them, only those near zero cost more than a comparison.
#[derive(Clone, Debug)]
pub struct LazyGuard {
    /// The function, of the states, the time and the inputs.
    pub guard: Guard,
    /// Index of the [`ScaleGroup`] that its error is measured against.
    pub group: usize,
    /// How fast it can change: `|g(a) - g(b)| <= sum slope_i |a_i - b_i|` over all states it depends on, each by its
    /// index with a formula of the inputs. `None` where there is no such bound: it is then always evaluated.
    pub slopes: Option<Vec<(usize, Expr)>>,
}

/// A function that is zero along a flow, such as the distance of bodies that stay in touch.
#[derive(Clone, Debug)]
pub struct Invariant {
    /// The function, of the states, the time and the inputs.
    pub formula: Expr,
    /// Index of the [`ScaleGroup`] that its size is measured against.
    pub group: usize,
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

/// A state and its rate of change.
#[derive(Clone, Debug)]
pub struct StateVariable {
    /// Name and dimension.
    pub symbol: Symbol,
    /// Derivative with respect to time.
    pub rate: Expr,
    /// Index of its [`ScaleGroup`].
    pub group: usize,
    /// Whether the rate is with respect to the parameter of the flow's time transformation, where that has a finite
    /// value and this has not.
    pub per_parameter: bool,
}

/// States whose errors are measured against one scale.
///
/// The scale is the largest absolute value that any of them has had, and at least the floor.
#[derive(Clone, Debug)]
pub struct ScaleGroup {
    /// What it measures: "length of the rod", ...
    pub name: String,
    /// The least scale, a formula of the inputs.
    pub floor: Expr,
    /// Whether the floor is to be divided by the length of the run: a rate so small changes nothing that matters within
    /// it.
    pub per_run: bool,
}

/// An instant at which a flow ends.
#[derive(Clone, Debug)]
pub struct Crossing<'a, Mode> {
    /// When, s.
    pub time: f64,
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
    /// one.
    pub zeros: Vec<(String, usize)>,
    /// A later time, s, at which the system is to be asked again.
    pub wake: Option<f64>,
}

impl<Mode, Record: Default> Jump<Mode, Record> {
    /// A jump that changes nothing yet.
    pub fn to(mode: Mode, states: Vec<f64>) -> Self {
        Self { mode, states, record: Record::default(), stop: false, zeros: vec![], wake: None }
    }
}
