//! The equations of a mode, compiled once: for any values of the inputs, any length of the run, and any rounding of numbers.

use std::sync::Arc;

use tumble_expr::{
    Binary, Branches, CompileError, Degree, Expr, Jets, Layout, Linker, NodeId, Rounding, Tape,
};

use crate::flow::{AtZero, LazyGuard, StateVariable};
use crate::hybrid::Direction;
use crate::invariants::Rows;
use crate::lazy_guards::{WatchPlan, WatchTape};
use crate::{Flow, Reason};

/// A polynomial solution of higher degree than this is left to ordinary steps: its coefficients would overflow first.
const LARGEST_EXACT_DEGREE: u32 = 48;

/// The equations of a mode, compiled. Whoever integrates many motions keeps it.
#[derive(Clone, Debug)]
pub struct Program {
    pub(crate) plan: Arc<Plan>,
    pub(crate) rounding: Rounding,
    /// Its outputs are the rates of all states with respect to the parameter s, then dt/ds where s is not the time, then the
    /// model's guards.
    pub(crate) tape: Arc<Tape>,
    pub(crate) floors: Arc<Tape>,
    /// What guards that end a flow if they move something are multiplied with.
    pub(crate) responses: Vec<Option<Arc<Tape>>>,
    /// Of all lazily evaluated guards, one after the other.
    pub(crate) slopes: Arc<Tape>,
    pub(crate) invariants: Arc<Tape>,
    pub(crate) watches: Vec<Arc<WatchTape>>,
}

/// What rounding has no part in.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) names: Vec<String>,
    pub(crate) groups: Vec<usize>,
    /// Whether the floor of each group is divided by the length of the run.
    pub(crate) per_run: Vec<bool>,
    /// Scheduled times. Inputs are rounded already, and numbers are with the whole: two moves might take each other back.
    pub(crate) schedule: Arc<Tape>,
    /// Highest degree of the solution, where it is a polynomial in time whatever the inputs are.
    pub(crate) exact_degree: Option<usize>,
    pub(crate) transformed: bool,
    /// How many guards the tape has; lazily evaluated guards are counted after them.
    pub(crate) guards: usize,
    /// Names of guards and lazily evaluated guards.
    pub(crate) guard_names: Vec<String>,
    pub(crate) guard_directions: Vec<Direction>,
    /// What each of them does at zero.
    pub(crate) at_zero: Vec<AtZero<()>>,
    /// Whether there is anything to watch along a step.
    pub(crate) is_watched: bool,
    /// Whether rates may change within a stretch that their coefficients do not show.
    pub(crate) may_be_narrow: bool,
    pub(crate) invariants: Arc<Rows>,
}

impl Program {
    /// Compiles the equations of a mode.
    pub fn new(flow: &Flow) -> Result<Self, Reason> {
        let mut formulas: Vec<Expr> = vec![];
        flow.map(|formula| formulas.push(formula.clone()));
        let mut linker = Linker::default();
        let mut linked = linker.formulas(&formulas)?.into_iter();
        let flow = flow.map(|_| linked.next().expect("one of each formula"));
        Self::linked(&mut linker, &flow)
    }

    /// Those of a mode whose formulas are linked.
    pub fn linked(linker: &mut Linker, flow: &Flow<NodeId>) -> Result<Self, Reason> {
        let layout = layout(flow);
        let guards = flow.guards.iter().map(|guard| guard.formula);
        let outputs: Vec<NodeId> = rates(linker, flow).into_iter().chain(guards).collect();
        let tape = linker.tape(&layout, &outputs)?;
        let (invariants, rows) = Rows::of_all(&flow.invariants, layout.states.len());
        let invariants = Arc::new(linker.tape(&layout, &invariants)?);
        let watches = WatchPlan::of_all(&flow.lazy_guards, &layout)?.into_iter();
        let watches = watches.map(|plan| Arc::new(WatchTape::new(plan))).collect();
        let fixed = Fixed { linker, layout: Layout { states: vec![], ..layout.clone() } };
        let floors: Vec<NodeId> = flow.groups.iter().map(|group| group.floor).collect();
        let bounds = |lazy_guard: &LazyGuard<NodeId>| -> Vec<NodeId> {
            let slopes = lazy_guard.slopes.iter().flatten().map(|(_, slope)| *slope);
            slopes.chain(lazy_guard.reach).collect()
        };
        let slopes: Vec<NodeId> = flow.lazy_guards.iter().flat_map(bounds).collect();
        let responses = at_zero(flow).map(|at_zero| fixed.response(at_zero));
        let nearest = Self {
            rounding: Rounding::NEAREST,
            floors: fixed.tape(&floors)?,
            responses: responses.collect::<Result<_, _>>()?,
            slopes: fixed.tape(&slopes)?,
            plan: Arc::new(Plan::of(flow, layout, &tape, fixed.tape(&flow.schedule)?, rows)),
            tape: Arc::new(tape),
            invariants,
            watches,
        };
        Ok(if flow.rounding.is_nearest() { nearest } else { nearest.rounded(flow.rounding) })
    }

    /// The same for states and guards of other names: what differs by names alone is compiled once.
    #[must_use]
    pub fn renamed(&self, names: Vec<String>, guard_names: Vec<String>) -> Self {
        let Plan { groups, per_run, schedule, guard_directions, at_zero, invariants, .. } = &*self.plan;
        let plan = Plan {
            names,
            guard_names,
            groups: groups.clone(),
            per_run: per_run.clone(),
            schedule: Arc::clone(schedule),
            guard_directions: guard_directions.clone(),
            at_zero: at_zero.clone(),
            invariants: Arc::clone(invariants),
            ..*self.plan
        };
        Self { plan: Arc::new(plan), ..self.clone() }
    }

    /// The same with numbers rounded in another way.
    #[must_use]
    pub fn rounded(&self, rounding: Rounding) -> Self {
        let again = |tape: &Arc<Tape>| Arc::new(tape.rounded(rounding));
        Self {
            plan: Arc::clone(&self.plan),
            rounding,
            tape: again(&self.tape),
            floors: again(&self.floors),
            responses: self.responses.iter().map(|tape| tape.as_ref().map(again)).collect(),
            slopes: again(&self.slopes),
            invariants: again(&self.invariants),
            watches: self.watches.iter().map(|watch| Arc::new(watch.rounded(rounding))).collect(),
        }
    }
}

impl Plan {
    fn of(flow: &Flow<NodeId>, layout: Layout, tape: &Tape, schedule: Arc<Tape>, rows: Rows) -> Self {
        let transformed = flow.time_transformation.is_some();
        let lazy = || flow.lazy_guards.iter();
        let names = flow.guards.iter().map(|guard| &guard.name).chain(lazy().map(|guard| &guard.name));
        let directions = flow.guards.iter().map(|guard| guard.direction);
        Self {
            names: layout.states.into_iter().map(|state| state.name.to_string()).collect(),
            groups: flow.states.iter().map(|state| state.group).collect(),
            per_run: flow.groups.iter().map(|group| group.per_run).collect(),
            schedule,
            exact_degree: if transformed { None } else { polynomial_degree(tape) },
            transformed,
            guards: flow.guards.len(),
            guard_names: names.cloned().collect(),
            guard_directions: directions.chain(lazy().map(|guard| guard.direction)).collect(),
            at_zero: at_zero(flow).map(|at_zero| at_zero.map(|_| ())).collect(),
            is_watched: !flow.guards.is_empty() || tape.sides() > 0 || !tape.turnings().is_empty(),
            may_be_narrow: tape.may_be_narrow(),
            invariants: Arc::new(rows),
        }
    }
}

/// What the tapes of a flow run on, rounded to the nearest.
fn layout(flow: &Flow<NodeId>) -> Layout {
    let states = flow.states.iter().map(|state| state.symbol.clone()).collect();
    Layout::new(states, flow.time.clone(), flow.inputs.clone())
}

/// Tapes of formulas of the inputs.
struct Fixed<'a> {
    linker: &'a Linker,
    layout: Layout,
}

impl Fixed<'_> {
    fn tape(&self, formulas: &[NodeId]) -> Result<Arc<Tape>, CompileError> {
        Ok(Arc::new(self.linker.tape(&self.layout, formulas)?))
    }

    fn response(&self, at_zero: &AtZero<NodeId>) -> Result<Option<Arc<Tape>>, CompileError> {
        match at_zero {
            AtZero::EndsIfItMoves { response, .. } => self.tape(&[*response]).map(Some),
            AtZero::Begins | AtZero::Keeps { .. } | AtZero::Ends | AtZero::EndsBeyond { .. } => Ok(None),
        }
    }
}

/// Values of formulas of the inputs.
pub(crate) fn values(tape: &Arc<Tape>, inputs: &[f64]) -> Vec<f64> {
    let mut values = Jets::new(Arc::clone(tape), 0, inputs);
    values.start(f64::NAN, &[], Branches::Free);
    (0..tape.outputs().len()).map(|index| values.value_of(index)).collect()
}

/// What guards do at zero, then what lazily evaluated guards do.
fn at_zero<F>(flow: &Flow<F>) -> impl Iterator<Item = &AtZero<F>> {
    let lazy = flow.lazy_guards.iter().map(|guard| &guard.at_zero);
    flow.guards.iter().map(|guard| &guard.at_zero).chain(lazy)
}

/// Rates with respect to the parameter.
fn rates(linker: &mut Linker, flow: &Flow<NodeId>) -> Vec<NodeId> {
    let mut per_parameter = |state: &StateVariable<NodeId>| match flow.time_transformation {
        Some(time_rate) if !state.per_parameter => linker.binary(Binary::Mul, state.rate, time_rate),
        _ => state.rate,
    };
    let rates = flow.states.iter().map(&mut per_parameter);
    rates.chain(flow.time_transformation).collect()
}

/// Degree of the solution, found state by state: one whose rate is a polynomial of states already known is one itself.
/// What is watched along it must be polynomial too, or its zeros could be missed.
///
/// Each pass settles at least one more state or ends, so there are at most as many passes as states.
fn polynomial_degree(tape: &Tape) -> Option<usize> {
    let mut known: Vec<Degree> = vec![None; tape.states()];
    loop {
        let outputs = tape.degrees(&known);
        let next: Vec<Degree> = outputs
            .iter()
            .take(known.len())
            .zip(0..)
            .map(|(rate, state)| integral(tape, *rate, state))
            .collect();
        if next == known {
            break;
        }
        known = next;
    }
    let watched = tape.watched_degrees(&known);
    let degree =
        known.into_iter().chain(watched).try_fold(0, |largest, degree| Some(degree?.max(largest)))?;
    (degree <= LARGEST_EXACT_DEGREE).then_some(degree as usize)
}

fn integral(tape: &Tape, rate: Degree, state: usize) -> Degree {
    let slot = tape.outputs()[state];
    // A rate that is literally zero leaves the state constant.
    if tape.is_zero(slot) { Some(0) } else { rate?.checked_add(1) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ScaleGroup, StateVariable};
    use tumble_expr::{Dimension, Symbol};

    fn degree(rates: &[Expr]) -> Option<usize> {
        let symbol = |name: String| Symbol::new(name, Dimension::NONE);
        let states = rates.iter().enumerate().map(|(i, rate)| StateVariable {
            symbol: symbol(format!("x{i}")),
            rate: rate.clone(),
            group: 0,
            per_parameter: false,
        });
        let flow = Flow {
            states: states.collect(),
            time: symbol("t".into()),
            inputs: vec![symbol("p".into())],
            rounding: tumble_expr::Rounding::NEAREST,
            groups: vec![ScaleGroup { name: "size".into(), floor: Expr::one(), per_run: false }],
            schedule: vec![],
            guards: vec![],
            lazy_guards: vec![],
            invariants: vec![],
            time_transformation: None,
        };
        Program::new(&flow).expect("pure numbers").plan.exact_degree
    }

    fn leaf(name: &str) -> Expr {
        Expr::symbol(name, Dimension::NONE)
    }

    #[test]
    fn chains_of_polynomials_are_found() {
        // x0' = x1, x1' = p, x2' = x0^2: degrees 2, 1, 5.
        assert_eq!(degree(&[leaf("x1"), leaf("p"), leaf("x0").powi(2)]), Some(5));
        assert_eq!(degree(&[Expr::zero()]), Some(0));
        assert_eq!(degree(&[leaf("t").powi(3)]), Some(4));
    }

    #[test]
    fn loops_and_functions_are_not() {
        assert_eq!(degree(&[leaf("x1"), leaf("x0")]), None);
        assert_eq!(degree(&[leaf("t").sin()]), None);
        // A parameter may make it polynomial, but the tape must hold for every value.
        assert_eq!(degree(&[leaf("p") * leaf("x0")]), None);
        assert_eq!(degree(&[leaf("t").powi(60)]), None);
    }
}
