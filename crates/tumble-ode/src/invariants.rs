//! Functions that are zero along a flow: how far rounding has moved them, and the states moved back.
//!
//! With W the squares of the states' scales and J the gradients of the functions g, the smallest correction in units of
//! the scales is `-W J^T (J W J^T)^-1 g` (Newton's method, least norm).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Branches, Expr, Jets, Layout, Tape};

use crate::Reason;
use crate::compiled::Compiled;
use crate::hybrid::Invariant;
use crate::scale::Scales;

/// A step may move an invariant by this part of its scale: some roundings.
const ALLOWED: f64 = 1e-14;
/// Below this part of what is allowed, the function's own rounding would be projected into the states.
const WORTH_IT: f64 = 0.1;
/// Newton's method from one rounding error away: the second correction is already nothing.
const CORRECTIONS: usize = 2;

pub(crate) struct Invariants {
    /// Outputs: each function, then its gradient.
    values: Jets<f64>,
    groups: Vec<usize>,
    states: usize,
}

impl Invariants {
    pub(crate) fn new(invariants: &[Invariant], layout: &Layout, inputs: &[f64]) -> Result<Self, Reason> {
        let with_gradient = |invariant: &Invariant| -> Vec<Expr> {
            let slopes = layout.states.iter().map(|state| invariant.formula.derivative(state));
            [invariant.formula.clone()].into_iter().chain(slopes).collect()
        };
        let outputs: Vec<Expr> = invariants.iter().flat_map(with_gradient).collect();
        let tape = Arc::new(Tape::compile(layout, &outputs)?);
        Ok(Self {
            values: Jets::new(tape, 0, inputs),
            groups: invariants.iter().map(|invariant| invariant.group).collect(),
            states: layout.states.len(),
        })
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// How far the worst is from zero, in units of what is allowed.
    pub(crate) fn excess(&mut self, time: f64, states: &[f64], scales: &Scales) -> f64 {
        self.values.start(time, states, Branches::Free);
        let part = |(index, group): (usize, &usize)| {
            let scale = scales.of(*group);
            if scale == 0.0 { 0.0 } else { self.function(index).abs() / (ALLOWED * scale) }
        };
        self.groups.iter().enumerate().map(part).fold(0.0, f64::max)
    }

    /// Moves the states to where all of them are zero, unless they are as good as there.
    pub(crate) fn project(&mut self, time: f64, states: &mut [f64], system: &Compiled, scales: &Scales) {
        if self.excess(time, states, scales) <= WORTH_IT {
            return;
        }
        let weight = |state: usize| {
            let scale = scales.of(system.group(state));
            if scale == 0.0 { 1.0 } else { scale }
        };
        let weights = DVector::from_fn(self.states, |state, _| weight(state));
        for _ in 0..CORRECTIONS {
            self.values.start(time, states, Branches::Free);
            let count = self.groups.len();
            let jacobian =
                DMatrix::from_fn(count, self.states, |row, state| self.slope(row, state) * weights[state]);
            let off = DVector::from_fn(count, |row, _| self.function(row));
            // Functions that depend on each other have no one answer: the drift, a few roundings, then stays.
            let Some(factors) = (&jacobian * jacobian.transpose()).cholesky() else { return };
            let step = jacobian.transpose() * factors.solve(&off);
            for (state, change) in step.iter().enumerate().filter(|(_, change)| change.is_finite()) {
                states[state] -= weights[state] * change;
            }
        }
    }

    fn function(&self, index: usize) -> f64 {
        self.values.value_of(index * (self.states + 1))
    }

    fn slope(&self, index: usize, state: usize) -> f64 {
        self.values.value_of(index * (self.states + 1) + 1 + state)
    }
}
