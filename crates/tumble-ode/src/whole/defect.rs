//! Whether a polynomial obeys the equations along a part of a step, by a bound of its defect.
//!
//! The bound is an interval's, of the fifth order in the length of the part: where the defect is smooth it shrinks by some such
//! power where the part is halved. What is narrower than the part keeps its size in the half that it lies in. So what is too weak
//! to be seen by its size is seen by how its bound shrinks.

use tumble_expr::Row;

use super::halvings::halves;
use super::{Demand, Doubt};
use crate::enclosure::{Enclosure, Path};
use crate::engine::Engine;
use crate::work::Work;

/// A part of the scale of a rate that a force may have and still not be seen.
const VISIBLE: f64 = 1e-6;
/// What a defect may do to a state in the whole run, in units of the state's scale, and not be looked at closer: a rounding error.
const HARMLESS: f64 = 4.0 * f64::EPSILON;
/// The bound of a smooth defect shrinks at least so many times where a part is halved, by the fifth power of its length but for
/// what intervals lose; that of a narrow bump does not.
const SHRINKS: f64 = 8.0;
/// Rounding errors of a defect, in units of that of the rate.
const DEFECT_ROUNDING: f64 = 64.0;

impl Engine {
    /// What does not obey the equations along a part by its polynomial, if there is such a state, or the time.
    pub(super) fn disobeys(
        &self,
        enclosure: &Enclosure,
        [low, high]: [f64; 2],
        demand: &Demand<'_>,
    ) -> Option<Doubt> {
        let visible = VISIBLE.max(demand.accuracy);
        let obeys = |state: &usize| {
            self.obeys(
                *state,
                [enclosure.defect(*state, *state), enclosure.slope(*state)],
                high - low,
                demand,
            )
        };
        let time = self.system.len();
        let time_passes = || {
            let size = enclosure.output(time).range(0).magnitude();
            enclosure.defect(time, time) <= visible * size
        };
        match (0..time).find(|state| !obeys(state)) {
            Some(state) => Some(Doubt::Leaf(state)),
            None if self.system.transformed && !time_passes() => Some(Doubt::Leaf(time)),
            None => None,
        }
    }

    /// Whether a state with such a defect and such a slope, at most, along a part of that length obeys the equations.
    pub(super) fn obeys(
        &self,
        state: usize,
        [defect, slope]: [f64; 2],
        length: f64,
        demand: &Demand<'_>,
    ) -> bool {
        let group = self.system.group(state);
        // What moves for the first time has the scale of this step.
        let scale = demand.scales.of_rate(group).max(slope);
        let allowed = VISIBLE.max(demand.accuracy) * scale + DEFECT_ROUNDING * demand.noise.rates[state];
        defect <= allowed || self.is_of_tolerance(state, defect, length, demand)
    }

    /// Whether what a defect could do within the part is less than what every step may do.
    pub(super) fn is_of_tolerance(
        &self,
        state: usize,
        defect: f64,
        length: f64,
        demand: &Demand<'_>,
    ) -> bool {
        defect * length <= demand.tolerance * demand.scales.of(self.system.group(state))
    }

    /// Whether a defect could not do more within the run than a rounding error.
    pub(super) fn is_harmless(&self, state: usize, defect: f64, demand: &Demand<'_>) -> bool {
        let scale = demand.scales.of_way(self.system.group(state));
        defect <= HARMLESS * scale / demand.scales.span()
    }

    /// A state along whose part something is hidden: too small to be seen in the defect, and too narrow for the coefficients to
    /// know of it, so that no check run would.
    pub(super) fn hides(
        &self,
        enclosure: &mut Enclosure,
        path: Path<'_>,
        part: [f64; 2],
        demand: &Demand<'_>,
        work: &mut Work,
    ) -> Option<Doubt> {
        let harms = |state: usize, defect: f64| !self.is_harmless(state, defect, demand);
        // Rounding errors are as large in a half as in the whole.
        let of = |enclosure: &Enclosure, state: usize| {
            let size = demand.noise.rates[state] + f64::EPSILON * enclosure.slope(state);
            (enclosure.defect(state, state) - 2.0 * DEFECT_ROUNDING * size).max(0.0)
        };
        let whole: Row = (0..self.system.len()).map(|state| of(enclosure, state)).collect();
        if !whole.iter().enumerate().any(|(state, defect)| harms(state, *defect)) {
            return None;
        }
        let mut found = None;
        for half in halves(part) {
            work.enclosures += 1;
            enclosure.look(path, half, self.signs(), None);
            let is_hidden = |(state, whole): &(usize, &f64)| {
                let defect = of(enclosure, *state);
                harms(*state, defect) && defect > *whole / SHRINKS
            };
            found = found.or(whole.iter().enumerate().find(is_hidden).map(|(state, _)| state));
        }
        found.map(Doubt::Leaf)
    }
}
