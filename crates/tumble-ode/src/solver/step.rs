//! One step, before it is taken: how long it is, and when it ends.

use tumble_expr::rounded_sum;

use super::{SIMULTANEOUS_ULPS, Solver};
use crate::engine::{Hit, Hits};
use crate::expansion::Expansion;
use crate::hybrid::Hybrid;
use crate::polynomial;
use crate::trajectory::invert;

/// A rejected step is shortened at least to this part and at most to that.
pub(super) const SHRINK: (f64, f64) = (0.1, 0.8);

/// By how much a step is shortened whose error is so many times what is allowed.
pub(super) fn shrink(excess: f64, order: usize) -> f64 {
    let shrink = libm::pow(excess, -1.0 / order as f64);
    // An excess that is not a number means the step ran into a singularity: shrink hard.
    if shrink.is_nan() { SHRINK.0 } else { shrink.clamp(SHRINK.0, SHRINK.1) }
}

/// A step from now.
#[derive(Clone)]
pub(super) struct Step {
    /// In units of the parameter; zero where something happens at once.
    pub(super) length: f64,
    /// Time at its end, s.
    pub(super) end: f64,
    /// What rounding left out of that.
    pub(super) left_out: f64,
    /// What ends it, where it is not the check or the schedule.
    pub(super) hits: Hits,
}

impl<H: Hybrid> Solver<'_, H> {
    /// A length that is shorter than a step's by more than the rounding of times.
    pub(super) fn shorter(&self, expansion: &Expansion, step: &Step, length: f64) -> f64 {
        let is_shorter = self.fit(expansion, length, step.end).length < step.length;
        if is_shorter { length } else { step.length * SHRINK.1 }
    }

    /// Ends a step at `end` at the latest, and at a time that is a number, from what rounding left out of its start. What comes to
    /// the same instant as `end` ends there: what is due then would be over after it.
    pub(super) fn fit(&self, expansion: &Expansion, length: f64, end: f64) -> Step {
        let due = end - SIMULTANEOUS_ULPS * f64::EPSILON * end.abs();
        let left_out = |end| self.mode.map_or(0.0, |mode| self.engines[mode].system.left_out_of(end));
        let (length, end) = match &expansion.time {
            None if self.time + length >= due => {
                (end - self.time + (left_out(end) - self.time_left_out), end)
            }
            None if self.time + length == self.time => (0.0, self.time),
            None => ((self.time + length) - self.time - self.time_left_out, self.time + length),
            Some(series) => {
                let reached = self.time + polynomial::increment(series, length);
                if reached >= due {
                    (invert(series, end - self.time, length), end)
                } else {
                    (length, reached)
                }
            }
        };
        Step { length, end, left_out: left_out(end), hits: Hits::new() }
    }

    /// Ends a step where something happens: what its time loses by rounding is kept, since as many events as there are would lose
    /// it again and again, and always in the same direction where all is as it was before.
    fn land(&self, expansion: &Expansion, length: f64, end: f64, hits: Hits) -> Step {
        let fitted = self.fit(expansion, length, end);
        let (time, left_out) = rounded_sum(self.time, length + self.time_left_out);
        let is_exact = expansion.time.is_none() && fitted.end < end && time > self.time;
        if is_exact { Step { length, end: time, left_out, hits } } else { Step { hits, ..fitted } }
    }

    /// Cuts a step where the first of the watched functions crosses zero.
    pub(super) fn cut(&self, mode: usize, expansion: &Expansion, length: f64, end: f64) -> Step {
        let step = self.fit(expansion, length, end);
        match self.engines[mode].first_hits(expansion, step.length, &self.scales) {
            None => step,
            // Up to what happens first the time runs forwards; beyond, it need not, so the step is fitted anew.
            Some((at, hits)) => self.land(expansion, at.min(step.length), end, hits),
        }
    }

    /// A step to where the guard that cuts it is zero by its value.
    pub(super) fn polished(&mut self, mode: usize, expansion: &Expansion, step: Step, end: f64) -> Step {
        let guard = |hit: &Hit| if let Hit::Guard(guard) = hit { Some(*guard) } else { None };
        let hit = step.hits.iter().find_map(guard);
        let known = (&self.scales, &self.compensation[..]);
        match hit.and_then(|guard| self.engines[mode].delay(guard, expansion, step.length, known)) {
            None => step,
            Some(delay) => self.land(expansion, step.length + delay, end, step.hits),
        }
    }
}
