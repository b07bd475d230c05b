//! A flow as the integrator runs it: its program, and what is known of it with the values of the inputs before any step.

use std::ops::Deref;
use std::sync::Arc;

use tumble_expr::{Branches, Jets, LEFT_OUT, Rounded, Rounding, Scalar, Tape, rounded_sum};

use crate::Reason;
use crate::flow::AtZero;
use crate::invariants::Invariants;
use crate::lazy_guards::LazyGuards;
use crate::program::{Plan, Program, values};

/// The tape's outputs are the rates of all states with respect to the parameter s, then dt/ds where s is not the time,
/// then the model's guards.
pub(crate) struct Compiled {
    plan: Arc<Plan>,
    pub(crate) tape: Arc<Tape>,
    pub(crate) floors: Vec<f64>,
    /// Scheduled times, each with its index.
    pub(crate) schedule: Vec<f64>,
    /// What rounding left out of each of them.
    pub(crate) schedule_left_out: Vec<f64>,
    /// What guards and lazily evaluated guards do where they are at zero and about to cross.
    pub(crate) guard_limits: Vec<Limit>,
}

impl Deref for Compiled {
    type Target = Plan;
    fn deref(&self) -> &Plan {
        &self.plan
    }
}

impl Compiled {
    /// `span` is the length of the run, s.
    pub(crate) fn new(program: &Program, inputs: &[f64], span: f64) -> Result<Self, Reason> {
        let plan = &program.plan;
        let (schedule, schedule_left_out): (Vec<f64>, Vec<f64>) =
            scheduled(&plan.schedule, program.rounding, inputs).into_iter().unzip();
        if let Some(&value) = schedule.iter().find(|time| !time.is_finite()) {
            return Err(Reason::BadSchedule { value });
        }
        let floors = values(&program.floors, inputs).into_iter().zip(&plan.per_run);
        Ok(Self {
            plan: Arc::clone(plan),
            floors: floors.map(|(floor, per_run)| if *per_run { floor / span } else { floor }).collect(),
            tape: Arc::clone(&program.tape),
            schedule,
            schedule_left_out,
            guard_limits: limits(program, inputs),
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
    /// What is known to be zero begins, and may not get beyond; the group that it is measured against.
    Kept(usize),
    Always,
    /// Acceleration for each unit of the guard, and the group of what it moves.
    IfItMoves {
        response: f64,
        group: usize,
        again: bool,
    },
    /// The group that it is measured against.
    IfBeyond(usize),
}

impl Limit {
    /// Whether what is at zero and about to cross may end the flow at once.
    pub(crate) fn may_end(self) -> bool {
        !matches!(self, Self::None | Self::Kept(_))
    }
}

fn limits(program: &Program, inputs: &[f64]) -> Vec<Limit> {
    let limit = |(at_zero, response): (&AtZero<()>, &Option<Arc<Tape>>)| match (at_zero, response) {
        (AtZero::EndsIfItMoves { group, again, .. }, Some(response)) => {
            Limit::IfItMoves { response: values(response, inputs)[0], group: *group, again: *again }
        }
        (AtZero::EndsBeyond { group }, _) => Limit::IfBeyond(*group),
        (AtZero::Begins, _) => Limit::None,
        (AtZero::Keeps { group }, _) => Limit::Kept(*group),
        (AtZero::Ends | AtZero::EndsIfItMoves { .. }, _) => Limit::Always,
    };
    program.plan.at_zero.iter().zip(&program.responses).map(limit).collect()
}

/// What is watched and kept outside the tape of the field, for expansions of that order.
pub(crate) fn beside(program: &Program, inputs: &[f64], order: usize) -> (LazyGuards, Invariants) {
    (LazyGuards::new(program, inputs, order), Invariants::new(program, inputs))
}

/// What the draws for scheduled times are told apart by from those for other numbers: not by the times, which may nearly agree.
const SCHEDULED: f64 = std::f64::consts::TAU;

/// Times by formulas of the inputs, each rounded as the flow says, and what rounding left out of them. Two that follow each other,
/// as both ends of a short window do, are moved apart or together, and never alike: what lies between them is known no better than
/// both.
fn scheduled(schedule: &Arc<Tape>, rounding: Rounding, inputs: &[f64]) -> Vec<(f64, f64)> {
    let inputs: Vec<Rounded> = inputs.iter().map(|value| Rounded::splat(*value)).collect();
    let mut times = Jets::new(Arc::clone(schedule), 0, &inputs);
    times.start(Rounded::leaf(f64::NAN), &[], Branches::Free);
    let time = |index: usize| {
        let time = times.value_of(index);
        let side = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let drawn = side * rounding.draw(SCHEDULED, index as u64 / 2);
        rounded_sum(time.value, drawn * LEFT_OUT * time.noise())
    };
    (0..schedule.outputs().len()).map(time).collect()
}
