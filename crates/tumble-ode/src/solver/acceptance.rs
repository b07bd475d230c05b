//! How long a step may be: what is proposed, checked, and shortened until all of it is known.

use tumble_expr::Row;

use super::Solver;
use super::step::{Step, shrink};
use crate::Reason;
use crate::check::Verdict;
use crate::engine::Engine;
use crate::expansion::Expansion;
use crate::hybrid::Hybrid;
use crate::invariants::Slack;
use crate::polynomial;
use crate::whole::{Demand, Doubt, Stretch, Unknown};

/// Where no coefficient limits a step, it is at most this part of the run.
const BLIND_PART: f64 = 1.0 / 8.0;
/// Steps shorter than this part of the run are not shortened for what drifts along them: it is projected out.
const SHORT_PART: f64 = 1e-6;
/// Shorter than this many units in the last place of the time, a step is stuck.
const SHORTEST_STEP_ULPS: f64 = 4.0;

impl<H: Hybrid> Solver<'_, H> {
    /// How far a step is known, if not to its end.
    pub(super) fn unknown(
        &mut self,
        mode: usize,
        expansion: &Expansion,
        step: &Step,
    ) -> Result<Option<Unknown>, Reason> {
        if self.time < self.not_enclosed {
            return Ok(None);
        }
        let stretch = Stretch { expansion, length: step.length, hits: &step.hits };
        let demand = Demand {
            scales: &self.scales,
            tolerance: self.tolerance,
            accuracy: self.accuracy,
            noise: &self.noise,
        };
        self.engines[mode].unknown(stretch, &demand, self.is_proved, &mut self.trajectory.work)
    }

    /// The longest step up to `end` that passes the check, cut where something happens.
    pub(super) fn accepted_step(
        &mut self,
        mode: usize,
        expansion: &mut Expansion,
        end: f64,
    ) -> Result<Step, Reason> {
        let exact = self.engines[mode].system.exact_degree.is_some();
        let length = if exact { end - self.time } else { self.proposal(mode, expansion) };
        let ahead = (self.reach, self.compensation.as_slice());
        let mut length = self.engines[mode].approach(expansion, length, ahead, &mut self.trajectory.work)?;
        let expansion = &*expansion;
        loop {
            let step = self.cut(mode, expansion, length, end);
            if step.length == 0.0 && step.hits.is_empty() {
                let state = self.engines[mode].narrowest(expansion, &self.scales);
                return Err(Reason::Stalled { step: length, state });
            }
            if step.length == 0.0 {
                return Ok(step);
            }
            let verdict = self.verdict(mode, expansion, &step);
            let changes_too_fast;
            (length, changes_too_fast) = if verdict.excess <= 1.0 {
                match self.unknown(mode, expansion, &step)? {
                    None => {
                        self.trajectory.work.exact_steps += u64::from(exact);
                        return Ok(self.polished(mode, expansion, step, end));
                    }
                    Some(unknown) => {
                        self.trajectory.work.cuts += 1;
                        (self.shorter(expansion, &step, unknown.length), unknown.of)
                    }
                }
            } else {
                (step.length * shrink(verdict.excess, expansion.order()), Doubt::Leaf(verdict.state))
            };
            self.trajectory.work.rejected += 1;
            if self.is_stuck(expansion, length) {
                let state = self.engines[mode].name_of_doubt(changes_too_fast);
                return Err(Reason::Stalled { step: length, state });
            }
        }
    }

    pub(super) fn proposal(&self, mode: usize, expansion: &Expansion) -> f64 {
        let radius = self.engines[mode].radius(expansion, &self.scales);
        if radius.is_finite() { radius * self.reach } else { self.span * self.stride * BLIND_PART }
    }

    /// Whether a step is good enough: its states, what it watches, and what it must keep.
    pub(super) fn verdict(&mut self, mode: usize, expansion: &Expansion, step: &Step) -> Verdict {
        let exact = self.engines[mode].system.exact_degree.is_some();
        let fine = Verdict { excess: 0.0, state: 0 };
        let states = if exact { fine } else { self.check(mode, expansion, step) };
        let Engine { system, lazy_guards, invariants, .. } = &mut self.engines[mode];
        let watched = lazy_guards.excess(expansion, step.length, &self.scales, self.tolerance);
        let mut verdict = states.or(Verdict { excess: watched, state: 0 });
        if !invariants.is_empty() && step.end - self.time > self.span * SHORT_PART {
            let end: Row =
                expansion.states.iter().map(|series| polynomial::value(series, step.length)).collect();
            let mut scales = self.scales.clone();
            scales.watch(system, &end);
            let moved = self.moved_by_rounding(mode, step.length);
            let slack = Slack { tolerance: self.tolerance, moved: &moved, rounding: f64::EPSILON };
            let Engine { invariants, .. } = &mut self.engines[mode];
            let drift = invariants.excess_of_step(step.end, &end, &scales, &slack);
            verdict = verdict.or(Verdict { excess: drift, state: 0 });
        }
        verdict
    }

    /// What rounding of the rates may move each state by in a step of that length: a place whose rate is a velocity is moved by what the
    /// acceleration is off by too, though both are zero where it starts.
    fn moved_by_rounding(&self, mode: usize, length: f64) -> Row {
        let off = |state: usize| {
            let drawn = self.off.get(state).map_or(0.0, |off| off.abs());
            drawn.max(self.noise.rates[state])
        };
        let tape = &self.engines[mode].system.tape;
        let moved = |state: usize| {
            let rate = tape.outputs()[state] as usize;
            let along = if rate < tape.states() { 0.5 * length * off(rate) } else { 0.0 };
            (off(state) + along) * length
        };
        (0..self.states.len()).map(moved).collect()
    }

    fn check(&mut self, mode: usize, expansion: &Expansion, step: &Step) -> Verdict {
        let demand = Demand {
            scales: &self.scales,
            tolerance: self.tolerance,
            accuracy: self.accuracy,
            noise: &self.noise,
        };
        self.engines[mode].check(expansion, step.length, &demand, &mut self.trajectory.work)
    }

    fn is_stuck(&self, expansion: &Expansion, length: f64) -> bool {
        let advance = expansion.time.as_ref().map_or(length, |series| polynomial::increment(series, length));
        advance <= SHORTEST_STEP_ULPS * f64::EPSILON * self.time.abs().max(f64::MIN_POSITIVE)
    }
}
