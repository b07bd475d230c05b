//! A flow compiled for the integrator: one tape, and what is known of it before any step.

use std::sync::Arc;

use tumble_expr::{
    Branches, Degree, Expr, Jets, LEFT_OUT, Layout, Rounded, Rounding, Scalar, Tape, rounded_sum,
};

use crate::hybrid::{AtZero, Direction, Guard, StateVariable};
use crate::invariants::Invariants;
use crate::lazy_guards::LazyGuards;
use crate::{Flow, Reason};

/// A polynomial solution of higher degree than this is left to ordinary steps: its coefficients would overflow first.
const LARGEST_EXACT_DEGREE: u32 = 48;

/// The tape's outputs are the rates of all states with respect to the parameter s, then dt/ds where s is not the time,
/// then the model's guards.
pub(crate) struct Compiled {
    pub(crate) tape: Arc<Tape>,
    pub(crate) names: Vec<String>,
    groups: Vec<usize>,
    pub(crate) floors: Vec<f64>,
    /// Scheduled times, each with its index.
    pub(crate) schedule: Vec<f64>,
    /// What rounding left out of each of them.
    pub(crate) schedule_left_out: Vec<f64>,
    /// Highest degree of the solution, where it is a polynomial in time whatever the inputs are.
    pub(crate) exact_degree: Option<usize>,
    pub(crate) transformed: bool,
    /// How many guards the tape has; lazily evaluated guards are counted after them.
    pub(crate) guards: usize,
    /// Names of guards and lazily evaluated guards.
    pub(crate) guard_names: Vec<String>,
    pub(crate) guard_directions: Vec<Direction>,
    /// What they do where they are at zero and about to cross.
    pub(crate) guard_limits: Vec<Limit>,
    /// Whether there is anything to watch along a step.
    pub(crate) is_watched: bool,
    /// Whether rates may change within a stretch that their coefficients do not show.
    pub(crate) may_be_narrow: bool,
}

impl Compiled {
    /// `span` is the length of the run, s.
    pub(crate) fn new(flow: &Flow, inputs: &[f64], span: f64) -> Result<Self, Reason> {
        let layout = layout(flow);
        let guards = flow.guards.iter().map(|guard| guard.formula.clone());
        let outputs: Vec<Expr> = rates(flow).into_iter().chain(guards).collect();
        let tape = Tape::compile(&layout, &outputs)?;
        let (schedule, schedule_left_out): (Vec<f64>, Vec<f64>) =
            scheduled(&layout, flow, inputs)?.into_iter().unzip();
        if let Some(&value) = schedule.iter().find(|time| !time.is_finite()) {
            return Err(Reason::BadSchedule { value });
        }
        let floors: Vec<Expr> = flow.groups.iter().map(|group| group.floor.clone()).collect();
        let transformed = flow.time_transformation.is_some();
        let exact_degree = if transformed { None } else { polynomial_degree(&tape) };
        let is_watched = !flow.guards.is_empty() || tape.sides() > 0 || !tape.turnings().is_empty();
        Ok(Self {
            names: layout.states.iter().map(|state| state.name.to_string()).collect(),
            groups: flow.states.iter().map(|state| state.group).collect(),
            floors: fixed(&layout, &floors, inputs)?
                .into_iter()
                .zip(&flow.groups)
                .map(|(floor, group)| if group.per_run { floor / span } else { floor })
                .collect(),
            may_be_narrow: tape.may_be_narrow(),
            tape: Arc::new(tape),
            schedule,
            schedule_left_out,
            exact_degree,
            transformed,
            guards: flow.guards.len(),
            guard_names: watched(flow).map(|guard| guard.name.clone()).collect(),
            guard_directions: watched(flow).map(|guard| guard.direction).collect(),
            guard_limits: limits(flow, &layout, inputs)?,
            is_watched,
        })
    }

    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }

    pub(crate) fn group(&self, state: usize) -> usize {
        self.groups[state]
    }

    /// What rounding left out of a time, if it is a scheduled one.
    pub(crate) fn left_out_of(&self, time: f64) -> f64 {
        let index = self.schedule.iter().position(|scheduled| *scheduled == time);
        index.map_or(0.0, |index| self.schedule_left_out[index])
    }

    /// The first scheduled time after `time`.
    pub(crate) fn next_scheduled(&self, time: f64) -> Option<f64> {
        self.schedule.iter().copied().filter(|scheduled| *scheduled > time).reduce(f64::min)
    }
}

/// [`AtZero`] with numbers.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Limit {
    None,
    Always,
    /// Acceleration for each unit of the guard, and the group of what it moves.
    IfItMoves(f64, usize),
}

fn limits(flow: &Flow, layout: &Layout, inputs: &[f64]) -> Result<Vec<Limit>, Reason> {
    let limit = |guard: &Guard| match &guard.at_zero {
        AtZero::Begins => Ok(Limit::None),
        AtZero::Ends => Ok(Limit::Always),
        AtZero::EndsIfItMoves { response, group } => {
            let response = fixed(layout, std::slice::from_ref(response), inputs)?[0];
            Ok(Limit::IfItMoves(response, *group))
        }
    };
    watched(flow).map(limit).collect()
}

/// What the tapes of a flow run on.
fn layout(flow: &Flow) -> Layout {
    Layout {
        states: flow.states.iter().map(|state| state.symbol.clone()).collect(),
        time: flow.time.clone(),
        inputs: flow.inputs.clone(),
        rounding: flow.rounding,
    }
}

/// Guards, then those of lazily evaluated guards.
fn watched(flow: &Flow) -> impl Iterator<Item = &Guard> {
    flow.guards.iter().chain(flow.lazy_guards.iter().map(|lazy_guard| &lazy_guard.guard))
}

/// What is watched and kept outside the tape of the field, for expansions of that order.
pub(crate) fn beside(flow: &Flow, inputs: &[f64], order: usize) -> Result<(LazyGuards, Invariants), Reason> {
    let layout = layout(flow);
    let lazy_guards = LazyGuards::new(&flow.lazy_guards, &layout, inputs, order)?;
    Ok((lazy_guards, Invariants::new(&flow.invariants, &layout, inputs)?))
}

/// Rates with respect to the parameter.
fn rates(flow: &Flow) -> Vec<Expr> {
    let states = flow.states.iter().map(|state| &state.rate);
    match &flow.time_transformation {
        None => states.cloned().collect(),
        Some(time_rate) => {
            let per_parameter = |state: &StateVariable| match state.per_parameter {
                true => state.rate.clone(),
                false => &state.rate * time_rate,
            };
            flow.states.iter().map(per_parameter).chain([time_rate.clone()]).collect()
        }
    }
}

/// What the draws for scheduled times are told apart by from those for other numbers: not by the times, which may nearly agree.
const SCHEDULED: f64 = std::f64::consts::TAU;

/// Times by formulas of the inputs, each rounded as the flow says, and what rounding left out of them. Two that follow each other,
/// as both ends of a short window do, are moved apart or together, and never alike: what lies between them is known no better than
/// both.
fn scheduled(layout: &Layout, flow: &Flow, inputs: &[f64]) -> Result<Vec<(f64, f64)>, Reason> {
    // Inputs are moved already, and numbers are with the whole: two moves might take each other back.
    let layout = Layout { states: vec![], rounding: Rounding::NEAREST, ..layout.clone() };
    let inputs: Vec<Rounded> = inputs.iter().map(|value| Rounded::splat(*value)).collect();
    let mut times = Jets::new(Arc::new(Tape::compile(&layout, &flow.schedule)?), 0, &inputs);
    times.start(Rounded::leaf(f64::NAN), &[], Branches::Free);
    let time = |index: usize| {
        let time = times.value_of(index);
        let side = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let drawn = side * flow.rounding.draw(SCHEDULED, index as u64 / 2);
        rounded_sum(time.value, drawn * LEFT_OUT * time.noise())
    };
    Ok((0..flow.schedule.len()).map(time).collect())
}

/// Values of formulas of the inputs.
pub(crate) fn fixed(layout: &Layout, formulas: &[Expr], inputs: &[f64]) -> Result<Vec<f64>, Reason> {
    let layout = Layout { states: vec![], ..layout.clone() };
    let mut values = Jets::new(Arc::new(Tape::compile(&layout, formulas)?), 0, inputs);
    values.start(f64::NAN, &[], Branches::Free);
    Ok((0..formulas.len()).map(|index| values.value_of(index)).collect())
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
        Compiled::new(&flow, &[1.0], 1.0).expect("pure numbers").exact_degree
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
