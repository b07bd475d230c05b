//! What rounding makes of the rates in a step, and of the states at an event, which comes a little early or late.

use tumble_expr::{LEFT_OUT, is_short, rounded_sum};

use super::Solver;
use crate::engine::Engine;
use crate::{Cause, Hybrid};

/// What a check run adds to each rate, in units of what rounding may have made of it.
const RATE_ROUNDING: f64 = 0.4;
/// What rounding makes of the place of a zero on a step, in ulps of its length.
const ROOT_ROUNDING: f64 = 1.0;
/// Key of the draw that puts an event off.
const LATE: u64 = u64::MAX;

impl<H: Hybrid> Solver<'_, H> {
    /// Finds what each rate is off by in this step, rounded in another way: a force that is off by it acts on all that follows from
    /// it.
    pub(super) fn watch_off(&mut self, mode: usize) {
        self.off.clear();
        if self.rounding.is_nearest() {
            return;
        }
        let Self { time, rounding, states, compensation, off, .. } = self;
        self.engines[mode].watch_off(off, *rounding, (*time, states, compensation));
        off.iter_mut().for_each(|off| *off *= RATE_ROUNDING);
    }

    /// Moves the states by what rounding may have made of them at this instant, and back to what is known to be zero.
    ///
    /// An event that rounding of its time, or of the function that was crossed, puts off by dt leaves the states off by
    /// `(rates before - rates after) dt`, all with one sign, and what jumps by as much more as the rate of the crossing grows.
    pub(super) fn round_anew(
        &mut self,
        (before, after): (usize, usize),
        states_before: &[f64],
        causes: &[Cause],
    ) {
        let exact = vec![0.0; states_before.len()];
        let rates_before = self.engines[before].noise(self.time, states_before, &exact).values;
        let same = self.engines[before].system.names == self.engines[after].system.names;
        let way = self.trajectory.pieces.last().map_or(0.0, |piece| piece.end - piece.start);
        let late = self.late(causes).clamp(-way, way);
        let engine = &mut self.engines[after];
        let rates = engine.noise(self.time, &self.states, &self.compensation).values;
        for (state, value) in self.states.iter_mut().enumerate() {
            // What is only reversed is not rounded.
            let is_reversed = states_before.get(state).is_some_and(|before| *value == -before);
            let is_exact = is_short(*value) || (same && is_reversed);
            let own = if is_exact { 0.0 } else { LEFT_OUT * f64::EPSILON * value.abs() };
            // What rounding left out of a state that stays is carried on.
            let (own, turned) = match rates_before.get(state).filter(|_| same) {
                Some(rate) if *value == states_before[state] => (0.0, rates[state] - rate),
                Some(rate) => (own, rates[state] - rate - self.blur.growth * (*value - states_before[state])),
                None => (own, rates[state]),
            };
            let moved = if turned.is_finite() { turned * late } else { 0.0 };
            let rounded = self.rounding.draw(*value, state as u64) * own;
            (*value, self.compensation[state]) =
                rounded_sum(*value, moved + rounded + self.compensation[state]);
        }
        let Engine { system, invariants, .. } = engine;
        if !invariants.is_empty() {
            invariants.project(self.time, &mut self.states, system, &self.scales);
        }
    }

    /// By how much an event comes late, s. Scheduled times are moved already. Where steps are in time what the number of a time
    /// loses stays in the step's length, and it is that which is rounded: equal flights are late by the same, and their errors add up.
    fn late(&self, causes: &[Cause]) -> f64 {
        let is_scheduled = causes.iter().all(|cause| matches!(cause, Cause::Scheduled(_)));
        let last = self.trajectory.pieces.last();
        let size = last.filter(|piece| piece.time_series.is_none()).map_or(self.time, |piece| piece.length);
        let rounded =
            if is_scheduled || is_short(self.time) { 0.0 } else { ROOT_ROUNDING * f64::EPSILON * size };
        LEFT_OUT
            * (self.rounding.draw(self.time, LATE) * self.blur.time
                + self.rounding.draw(size, LATE) * rounded)
    }
}
