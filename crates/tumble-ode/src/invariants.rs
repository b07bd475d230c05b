//! Functions that are zero along a flow: how far rounding has moved them, and the states moved back.
//!
//! With W the squares of the states' units and J the gradients of the functions g, the smallest correction in these
//! units is `-W J^T (J W J^T)^-1 g` (Newton's method, least norm). The unit of a state is its scale, or what moves one of
//! the functions by the scale of that, if it is less: an angle that has turned many times round has a large scale, and a
//! function of it is not moved more by a radian for that. A state whose spacing of doubles moves a function by about what is
//! allowed is corrected only where no other can be, so its unit is a small part of that: it could hardly take a correction up. What rounding of the states does to a function is no
//! fault of a step, which would not do less if it were shorter.

use std::collections::BTreeMap;
use std::sync::Arc;

use tumble_expr::{Branches, Jets, Rounding, SparseSystem};

use crate::compiled::Compiled;
use crate::flow::Invariant;
use crate::program::Program;
use crate::scale::Scales;

/// A step may move an invariant by this part of its scale: a few ulps.
const ALLOWED: f64 = 1e-14;
/// The same of what follows from other states: these are known to their tolerance, and it is found from them at the end of the step.
const ALLOWED_TO_FOLLOW: f64 = 1e-7;
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
    rounding: Rounding,
    rows: Arc<Rows>,
    /// `J W J^T`, and what a correction is found in.
    normal: SparseSystem,
    entries: Vec<f64>,
    off: Vec<f64>,
    shares: Vec<f64>,
    step: Vec<f64>,
    /// In what corrections of the states are measured, and which of them can hardly take one up.
    units: Vec<f64>,
    is_coarse: Vec<bool>,
}

/// All functions, and which have states in common: each with few others.
#[derive(Debug)]
pub(crate) struct Rows {
    list: Vec<Row>,
    /// By entry of `J W J^T` in its rows' order, the terms of its sum.
    entries: Vec<Vec<Product>>,
    normal: SparseSystem,
}

/// Slopes of two functions by one state, as outputs.
#[derive(Clone, Copy, Debug)]
struct Product {
    slopes: [usize; 2],
    state: usize,
}

/// One function.
#[derive(Debug)]
pub(crate) struct Row {
    group: usize,
    follows: bool,
    /// Index of its value among the outputs; its slopes follow.
    output: usize,
    /// The states that it depends on.
    states: Vec<usize>,
}

/// By what a step may be off anyway.
pub(crate) struct Slack<'a> {
    /// Error that it is allowed, in units of the scales.
    pub(crate) tolerance: f64,
    /// What rounding of the rates may have moved each state by.
    pub(crate) moved: &'a [f64],
    /// Part of each state that rounding may have put it off by.
    pub(crate) rounding: f64,
}

impl Rows {
    /// Those of some functions of so many states, and what they are evaluated by.
    pub(crate) fn of_all<F: Clone>(invariants: &[Invariant<F>], states: usize) -> (Vec<F>, Self) {
        let (mut outputs, mut list) = (vec![], vec![]);
        for Invariant { formula, slopes, group, follows } in invariants {
            let output = outputs.len();
            outputs.push(formula.clone());
            outputs.extend(slopes.iter().map(|(_, slope)| slope.clone()));
            list.push(Row {
                group: *group,
                follows: *follows,
                output,
                states: slopes.iter().map(|(state, _)| *state).collect(),
            });
        }
        (outputs, Self::new(list, states))
    }

    fn new(list: Vec<Row>, states: usize) -> Self {
        // By state, the slopes by it, each with its row.
        let mut by_state = vec![vec![]; states];
        for (index, row) in list.iter().enumerate() {
            row.slopes().for_each(|(state, slope)| by_state[state].push((index, slope)));
        }
        let (mut pattern, mut entries) = (vec![], vec![]);
        for row in &list {
            let mut own: BTreeMap<usize, Vec<Product>> = BTreeMap::new();
            for (state, slope) in row.slopes() {
                for &(other, other_slope) in &by_state[state] {
                    own.entry(other).or_default().push(Product { slopes: [slope, other_slope], state });
                }
            }
            pattern.push(own.keys().map(|other| *other as u32).collect());
            entries.extend(own.into_values());
        }
        Self { list, entries, normal: SparseSystem::new(pattern) }
    }
}

impl Row {
    /// The states that it depends on, each with the output of its slope.
    fn slopes(&self) -> impl Iterator<Item = (usize, usize)> {
        self.states.iter().copied().zip(self.output + 1..)
    }
}

impl Invariants {
    pub(crate) fn new(program: &Program, inputs: &[f64]) -> Self {
        let values = Jets::new(Arc::clone(&program.invariants), 0, inputs);
        let rows = Arc::clone(&program.plan.invariants);
        let (normal, shares) = (rows.normal.clone(), vec![0.0; rows.list.len()]);
        Self {
            values,
            rounding: program.rounding,
            rows,
            normal,
            entries: vec![],
            off: vec![],
            shares,
            step: vec![],
            units: vec![],
            is_coarse: vec![],
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.list.is_empty()
    }

    /// How far the worst is from zero, in units of what is allowed and what rounding of the states makes of it.
    fn excess(&mut self, time: f64, states: &[f64], scales: &Scales) -> f64 {
        let none = Slack { tolerance: 0.0, moved: &[], rounding: 0.0 };
        self.excess_beyond(time, states, scales, &none, ALLOWED)
    }

    /// The same at the end of a step.
    pub(crate) fn excess_of_step(
        &mut self,
        time: f64,
        states: &[f64],
        scales: &Scales,
        slack: &Slack<'_>,
    ) -> f64 {
        self.excess_beyond(time, states, scales, slack, ALLOWED_TO_FOLLOW)
    }

    fn excess_beyond(
        &mut self,
        time: f64,
        states: &[f64],
        scales: &Scales,
        slack: &Slack<'_>,
        allowed_to_follow: f64,
    ) -> f64 {
        self.values.start(time, states, Branches::Free);
        let part = |row: &Row| {
            let scale = scales.of(row.group);
            let moved = row.states.iter().enumerate().map(|(index, state)| {
                let moved = slack.moved.get(*state).copied().unwrap_or(0.0);
                self.values.value_of(row.output + 1 + index).abs()
                    * (moved + slack.rounding * states[*state].abs())
            });
            let least = if row.follows { allowed_to_follow } else { ALLOWED };
            let allowed = least.max(OF_TOLERANCE * slack.tolerance) * scale + moved.sum::<f64>();
            if scale == 0.0 { 0.0 } else { self.values.value_of(row.output).abs() / allowed }
        };
        self.rows.list.iter().map(part).fold(0.0, f64::max)
    }

    /// Moves the states to where all of them are zero, unless they are as good as there.
    pub(crate) fn project(&mut self, time: f64, states: &mut [f64], system: &Compiled, scales: &Scales) {
        if self.excess(time, states, scales) <= WORTH_IT {
            return;
        }
        self.set_units(states, system, scales);
        // Functions that depend on each other have no one answer: the drift, a few ulps, then stays.
        if !self.factor() {
            return;
        }
        for correction in 0..CORRECTIONS {
            if correction > 0 {
                self.values.start(time, states, Branches::Free);
            }
            self.correct(states);
        }
    }

    /// Factors `J W J^T` where the functions have been evaluated; whether it has an inverse. The corrections that follow change it by no
    /// more than they are, a few ulps, so that it serves all of them.
    fn factor(&mut self) -> bool {
        let (of, units) = (|output: usize| self.values.value_of(output), &self.units);
        let product =
            |Product { slopes: [a, b], state }: &Product| of(*a) * of(*b) * (units[*state] * units[*state]);
        self.entries.clear();
        self.entries.extend(self.rows.entries.iter().map(|entry| entry.iter().map(product).sum::<f64>()));
        self.normal.factor(&self.entries) > 0.0
    }

    /// Moves the states by one correction, where the functions have been evaluated. Rounded in another way, they are to be as much as
    /// rounding of the states makes of zero, and more than it leaves: far from the origin a place that cannot take a correction up leaves it to
    /// others.
    fn correct(&mut self, states: &mut [f64]) {
        let of = |output: usize| self.values.value_of(output);
        let zero = |row: &Row| {
            let spacing: f64 = row.slopes().map(|(state, slope)| (of(slope) * states[state]).abs()).sum();
            self.rounding.draw(spacing, row.output as u64) * f64::EPSILON * spacing
        };
        self.off.clear();
        self.off.extend(self.rows.list.iter().map(|row| of(row.output) - zero(row)));
        self.normal.solve(&self.off, &mut self.shares);
        self.step.clear();
        self.step.resize(states.len(), 0.0);
        for (row, share) in self.rows.list.iter().zip(&self.shares) {
            row.slopes().for_each(|(state, slope)| self.step[state] += of(slope) * share);
        }
        for ((state, step), unit) in states.iter_mut().zip(&self.step).zip(&self.units) {
            let change = unit * unit * step;
            if change.is_finite() {
                *state -= change;
            }
        }
    }

    /// Finds in what corrections of the states are measured, where the functions have been evaluated.
    fn set_units(&mut self, states: &[f64], system: &Compiled, scales: &Scales) {
        self.units.clear();
        self.units.extend((0..states.len()).map(|state| {
            let scale = scales.of(system.group(state));
            if scale == 0.0 { 1.0 } else { scale }
        }));
        self.is_coarse.clear();
        self.is_coarse.resize(states.len(), false);
        for row in &self.rows.list {
            let size = scales.of(row.group);
            for (state, output) in row.slopes().filter(|_| size > 0.0) {
                let slope = self.values.value_of(output).abs();
                self.is_coarse[state] |= slope * f64::EPSILON * states[state].abs() > TOO_COARSE * size;
                if slope * self.units[state] > size {
                    self.units[state] = size / slope;
                }
            }
        }
        let coarse = self.units.iter_mut().zip(&self.is_coarse).filter(|(_, is_coarse)| **is_coarse);
        coarse.for_each(|(unit, _)| *unit *= HELD);
    }
}
