//! One step, before it is taken.

use crate::engine::Hit;

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
    pub(super) hits: Vec<Hit>,
}
