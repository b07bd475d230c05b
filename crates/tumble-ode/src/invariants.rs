//! Functions that are zero along a flow: how far rounding has moved them, and the states moved back.
//!
//! With W the squares of the states' units and J the gradients of the functions g, the smallest correction in these
//! units is `-W J^T (J W J^T)^-1 g` (Newton's method, least norm). The unit of a state is its scale, or what moves one of
//! the functions by the scale of that, if it is less: an angle that has turned many times round has a large scale, and a
//! function of it is not moved more by a radian for that. A state whose spacing of doubles moves a function by about what is
//! allowed is corrected only where no other can be, so its unit is a small part of that: it could hardly take a correction up. What rounding of the states does to a function is no
//! fault of a step, which would not do less if it were shorter.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Branches, Expr, Jets, Layout};

use crate::compiled::Compiled;
use crate::hybrid::Invariant;
use crate::program::Program;
use crate::scale::Scales;

/// A step may move an invariant by this part of its scale: a few ulps.
const ALLOWED: f64 = 1e-14;
/// A step whose own error may be this large may move an invariant by this part of it: it is projected out at its end.
const OF_TOLERANCE: f64 = 0.1;
/// Below this part of what is allowed, the function's own rounding would be projected into the states.
const WORTH_IT: f64 = 0.1;
/// A state is too coarse if its spacing moves a function by this part of its scale: ten of them are what is allowed.
const TOO_COARSE: f64 = 0.1 * ALLOWED;
/// It is then moved less than others by the square of this.
const HELD: f64 = 1e-3;
/// Newton's method from one rounding error away: the second correction is already nothing.
const CORRECTIONS: usize = 2;

pub(crate) struct Invariants {
    /// Outputs: each function, then its slopes.
    values: Jets<f64>,
    rows: Arc<[Row]>,
}

/// One function.
#[derive(Debug)]
pub(crate) struct Row {
    group: usize,
    /// Index of its value among the outputs; its slopes follow.
    output: usize,
    /// The states that it depends on.
    states: Vec<usize>,
}

/// By what a step may be off anyway.
pub(crate) struct Slack<'a> {
    /// Error that it is allowed, in units of the scales.
    pub(crate) tolerance: f64,
    /// What each rate was put off by.
    pub(crate) off: &'a [f64],
    /// Its length.
    pub(crate) length: f64,
    /// Part of each state that rounding may have put it off by.
    pub(crate) rounding: f64,
}

impl Row {
    /// The rows of some functions, and the formulas that they are evaluated by.
    pub(crate) fn of_all(invariants: &[Invariant], layout: &Layout) -> (Vec<Expr>, Vec<Self>) {
        let (mut outputs, mut rows) = (vec![], vec![]);
        for Invariant { formula, group } in invariants {
            let used = formula.symbols();
            let states = layout.states.iter().enumerate().filter(|(_, state)| used.contains(*state));
            let states: Vec<usize> = states.map(|(index, _)| index).collect();
            let output = outputs.len();
            outputs.push(formula.clone());
            outputs.extend(states.iter().map(|state| formula.derivative(&layout.states[*state])));
            rows.push(Self { group: *group, output, states });
        }
        (outputs, rows)
    }
}

impl Invariants {
    pub(crate) fn new(program: &Program, inputs: &[f64]) -> Self {
        let values = Jets::new(Arc::clone(&program.invariants), 0, inputs);
        Self { values, rows: Arc::clone(&program.plan.invariants) }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// How far the worst is from zero, in units of what is allowed and what rounding of the states makes of it.
    fn excess(&mut self, time: f64, states: &[f64], scales: &Scales) -> f64 {
        self.excess_of_step(
            time,
            states,
            scales,
            &Slack { tolerance: 0.0, off: &[], length: 0.0, rounding: 0.0 },
        )
    }

    /// The same at the end of a step.
    pub(crate) fn excess_of_step(
        &mut self,
        time: f64,
        states: &[f64],
        scales: &Scales,
        slack: &Slack<'_>,
    ) -> f64 {
        self.values.start(time, states, Branches::Free);
        let part = |row: &Row| {
            let scale = scales.of(row.group);
            let off = row.states.iter().enumerate().map(|(index, state)| {
                let off = slack.off.get(*state).copied().unwrap_or(0.0).abs() * slack.length;
                self.values.value_of(row.output + 1 + index).abs()
                    * (off + slack.rounding * states[*state].abs())
            });
            let allowed = ALLOWED.max(OF_TOLERANCE * slack.tolerance) * scale + off.sum::<f64>();
            if scale == 0.0 { 0.0 } else { self.values.value_of(row.output).abs() / allowed }
        };
        self.rows.iter().map(part).fold(0.0, f64::max)
    }

    /// Moves the states to where all of them are zero, unless they are as good as there.
    pub(crate) fn project(&mut self, time: f64, states: &mut [f64], system: &Compiled, scales: &Scales) {
        if self.excess(time, states, scales) <= WORTH_IT {
            return;
        }
        // The states that any of them depends on, in order, are the columns.
        let mut columns: Vec<usize> = self.rows.iter().flat_map(|row| row.states.iter().copied()).collect();
        columns.sort_unstable();
        columns.dedup();
        let units: Vec<f64> =
            columns.iter().map(|state| self.unit(*state, states[*state], system, scales)).collect();
        for _ in 0..CORRECTIONS {
            self.values.start(time, states, Branches::Free);
            let jacobian = DMatrix::from_fn(self.rows.len(), columns.len(), |row, column| {
                self.slope(row, columns[column]) * units[column]
            });
            let off = DVector::from_fn(self.rows.len(), |row, _| self.values.value_of(self.rows[row].output));
            // Functions that depend on each other have no one answer: the drift, a few ulps, then stays.
            let Some(factors) = (&jacobian * jacobian.transpose()).cholesky() else { return };
            let step = jacobian.transpose() * factors.solve(&off);
            for (column, change) in step.iter().enumerate().filter(|(_, change)| change.is_finite()) {
                states[columns[column]] -= units[column] * change;
            }
        }
    }

    /// In what a correction of a state of that value is measured.
    fn unit(&self, state: usize, value: f64, system: &Compiled, scales: &Scales) -> f64 {
        let scale = scales.of(system.group(state));
        let (mut unit, mut is_coarse) = (if scale == 0.0 { 1.0 } else { scale }, false);
        for (place, row) in self.rows.iter().enumerate() {
            let (slope, size) = (self.slope(place, state).abs(), scales.of(row.group));
            is_coarse |= size > 0.0 && slope * f64::EPSILON * value.abs() > TOO_COARSE * size;
            if size > 0.0 && slope * unit > size {
                unit = size / slope;
            }
        }
        if is_coarse { HELD * unit } else { unit }
    }

    fn slope(&self, row: usize, state: usize) -> f64 {
        let Row { output, states, .. } = &self.rows[row];
        states.binary_search(&state).map_or(0.0, |index| self.values.value_of(output + 1 + index))
    }
}
