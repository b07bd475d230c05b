//! The equations of one mode: formulas of the states, the time and the inputs, or what a linker has made of them.

use std::sync::Arc;

use tumble_expr::{Expr, Rounding, Symbol};

use crate::hybrid::Direction;
use crate::lazy_guards::Watched;

/// Equations of one mode. `F` is a formula, or where it stands in a [`tumble_expr::Linker`].
#[derive(Clone, Debug)]
pub struct Flow<F = Expr> {
    /// What changes, each with its rate.
    pub states: Vec<StateVariable<F>>,
    /// The time, s.
    pub time: Symbol,
    /// Parameters, fixed during a run.
    pub inputs: Vec<Symbol>,
    /// How numbers that no `f64` is are rounded.
    pub rounding: Rounding,
    /// Groups of states that share a scale.
    pub groups: Vec<ScaleGroup<F>>,
    /// Times, as formulas of the inputs, at which a step must end and the system is asked to jump.
    pub schedule: Vec<F>,
    /// Functions whose zeros end a step and make the system jump.
    pub guards: Vec<Guard<F>>,
    /// Guards that are evaluated only while the motion may reach their zeros.
    pub lazy_guards: Vec<LazyGuard<F>>,
    /// Functions that are zero all along this flow; rounding is taken out of them after each step.
    pub invariants: Vec<Invariant<F>>,
    /// Time transformation: `dt/ds` of the parameter s that the pieces run in, where it is not the time itself.
    /// Positive, but for isolated instants.
    pub time_transformation: Option<F>,
}

/// A function whose zero is an event.
#[derive(Clone, Debug)]
pub struct Guard<F = Expr> {
    /// Its name, by which it is known in every mode.
    pub name: String,
    /// The function.
    pub formula: F,
    /// Which crossings count.
    pub direction: Direction,
    /// What it means to be found at zero at the start of a step, about to cross.
    pub at_zero: AtZero<F>,
}

/// What a guard does that is zero at the start of a step and about to cross.
#[derive(Clone, Debug)]
pub enum AtZero<F = Expr> {
    /// Nothing: what starts at a value has not passed it.
    Begins,
    /// The flow holds on one side only, as friction against a slip does. It counts where it goes beyond zero by more than a rounding error of the
    /// group's scale, as with [`Self::EndsBeyond`]; but its jump says itself whether it is zero then. What gets beyond unseen is refused. For
    /// guards of one direction.
    Keeps {
        /// Index of the [`ScaleGroup`] that it is measured against.
        group: usize,
    },
    /// The flow holds on one side only, and ends at once.
    Ends,
    /// The same, if it matters: the guard is a force that holds something in its place, with this acceleration, a
    /// formula of the inputs, for each unit of it. What it would move within the step counts if it is more than a
    /// rounding error of the group's scale.
    EndsIfItMoves {
        /// Acceleration for each unit of the guard.
        response: F,
        /// Index of the [`ScaleGroup`] of what it moves.
        group: usize,
        /// Whether it ends the flow again where the jump that it led to has left it at zero and it goes on beyond.
        again: bool,
    },
    /// The same, if it goes beyond zero by more than a rounding error of the group's scale; so do zeros on the way.
    EndsBeyond {
        /// Index of the [`ScaleGroup`] that it is measured against.
        group: usize,
    },
}

/// A guard outside the tape of the field: of many of them, only those near zero cost more than a comparison.
#[derive(Clone, Debug)]
pub struct LazyGuard<F = Expr> {
    /// Its name, by which it is known in every mode.
    pub name: String,
    /// The function; modes may share it.
    pub of: Arc<Watched>,
    /// Which crossings count.
    pub direction: Direction,
    /// What it means to be found at zero at the start of a step, about to cross.
    pub at_zero: AtZero<F>,
    /// Index of the [`ScaleGroup`] that its error is measured against.
    pub group: usize,
    /// How fast it can change: `|g(a) - g(b)| <= sum slope_i |a_i - b_i|` over all states it depends on, each by its
    /// index with a formula of the inputs. `None` where there is no such bound: it is then always evaluated.
    pub slopes: Option<Vec<(usize, F)>>,
    /// How large the function and its conditions may be for that bound to hold, a formula of the inputs; `None` where it always does.
    pub reach: Option<F>,
}

/// A function that is zero along a flow, such as the distance of bodies that stay in touch.
#[derive(Clone, Debug)]
pub struct Invariant<F = Expr> {
    /// The function, of the states, the time and the inputs.
    pub formula: F,
    /// Its derivatives by the states that it depends on, each with the state's index, in order.
    pub slopes: Vec<(usize, F)>,
    /// Index of the [`ScaleGroup`] that its size is measured against.
    pub group: usize,
    /// Whether the states of the slopes follow from all others by it. Rounding of these does to the function what it likes, and is no
    /// fault of a step; what is not that must have been integrated over a jump.
    pub follows: bool,
}

impl Invariant {
    /// One of these states.
    pub fn new(formula: Expr, group: usize, states: &[Symbol]) -> Self {
        let used = formula.symbols();
        let own = states.iter().enumerate().filter(|(_, state)| used.contains(*state));
        let slopes = own.map(|(index, state)| (index, formula.derivative(state))).collect();
        Self { formula, slopes, group, follows: false }
    }
}

/// A state and its rate of change.
#[derive(Clone, Debug)]
pub struct StateVariable<F = Expr> {
    /// Name and dimension.
    pub symbol: Symbol,
    /// Derivative with respect to time.
    pub rate: F,
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
pub struct ScaleGroup<F = Expr> {
    /// What it measures: "length of the rod", ...
    pub name: String,
    /// The least scale, a formula of the inputs.
    pub floor: F,
    /// Whether the floor is to be divided by the length of the run: a rate so small changes nothing that matters within
    /// it.
    pub per_run: bool,
}

impl<F> Flow<F> {
    /// The same flow of other things that stand for its formulas, asked for always in the same order.
    pub(crate) fn map<G>(&self, mut of: impl FnMut(&F) -> G) -> Flow<G> {
        let state = |state: &StateVariable<F>, of: &mut dyn FnMut(&F) -> G| StateVariable {
            symbol: state.symbol.clone(),
            rate: of(&state.rate),
            group: state.group,
            per_parameter: state.per_parameter,
        };
        let group = |group: &ScaleGroup<F>, of: &mut dyn FnMut(&F) -> G| ScaleGroup {
            name: group.name.clone(),
            floor: of(&group.floor),
            per_run: group.per_run,
        };
        Flow {
            states: self.states.iter().map(|one| state(one, &mut of)).collect(),
            time: self.time.clone(),
            inputs: self.inputs.clone(),
            rounding: self.rounding,
            groups: self.groups.iter().map(|one| group(one, &mut of)).collect(),
            schedule: self.schedule.iter().map(&mut of).collect(),
            guards: self.guards.iter().map(|guard| guard.map(&mut of)).collect(),
            lazy_guards: self.lazy_guards.iter().map(|guard| guard.map(&mut of)).collect(),
            invariants: self.invariants.iter().map(|one| one.map(&mut of)).collect(),
            time_transformation: self.time_transformation.as_ref().map(&mut of),
        }
    }
}

impl<F> Guard<F> {
    fn map<G>(&self, mut of: impl FnMut(&F) -> G) -> Guard<G> {
        let formula = of(&self.formula);
        let at_zero = self.at_zero.map(of);
        Guard { name: self.name.clone(), formula, direction: self.direction, at_zero }
    }
}

impl<F> AtZero<F> {
    pub(crate) fn map<G>(&self, mut of: impl FnMut(&F) -> G) -> AtZero<G> {
        match self {
            Self::Begins => AtZero::Begins,
            Self::Ends => AtZero::Ends,
            Self::Keeps { group } => AtZero::Keeps { group: *group },
            Self::EndsBeyond { group } => AtZero::EndsBeyond { group: *group },
            Self::EndsIfItMoves { response, group, again } => {
                AtZero::EndsIfItMoves { response: of(response), group: *group, again: *again }
            }
        }
    }
}

impl<F> LazyGuard<F> {
    fn map<G>(&self, mut of: impl FnMut(&F) -> G) -> LazyGuard<G> {
        let at_zero = self.at_zero.map(&mut of);
        let slopes = self.slopes.as_ref().map(|slopes| by_state(slopes, &mut of));
        let reach = self.reach.as_ref().map(of);
        LazyGuard {
            name: self.name.clone(),
            of: Arc::clone(&self.of),
            direction: self.direction,
            at_zero,
            group: self.group,
            slopes,
            reach,
        }
    }
}

impl<F> Invariant<F> {
    fn map<G>(&self, mut of: impl FnMut(&F) -> G) -> Invariant<G> {
        Invariant {
            formula: of(&self.formula),
            slopes: by_state(&self.slopes, of),
            group: self.group,
            follows: self.follows,
        }
    }
}

fn by_state<F, G>(slopes: &[(usize, F)], mut of: impl FnMut(&F) -> G) -> Vec<(usize, G)> {
    slopes.iter().map(|(state, slope)| (*state, of(slope))).collect()
}
