//! Scales that errors are measured against.

use crate::compiled::Compiled;
use crate::whole::Noise;

/// Running maxima of each group of states, by index.
#[derive(Clone, Debug)]
pub(crate) struct Scales {
    largest: Vec<f64>,
    /// The largest rate of each group.
    rates: Vec<f64>,
    /// What rounding errors of the rates do to each group within the run, if they add up: less than that is no motion.
    rounding: Vec<f64>,
    /// Length of the run, s.
    span: f64,
}

impl Scales {
    /// Nothing has moved yet in a run of that length, s.
    pub(crate) fn new(span: f64) -> Self {
        Self { largest: vec![], rates: vec![], rounding: vec![], span }
    }

    /// A new mode may have other groups, and larger floors.
    pub(crate) fn raise(&mut self, floors: &[f64]) {
        let groups = floors.len().max(self.largest.len());
        for all in [&mut self.largest, &mut self.rates, &mut self.rounding] {
            all.resize(groups, 0.0);
        }
        for (scale, floor) in self.largest.iter_mut().zip(floors) {
            *scale = scale.max(floor.abs());
        }
    }

    /// Counts what another has seen of the same groups.
    pub(crate) fn join(&mut self, other: &Self) {
        let own = [&mut self.largest, &mut self.rates, &mut self.rounding];
        for (own, its) in own.into_iter().zip([&other.largest, &other.rates, &other.rounding]) {
            own.resize(own.len().max(its.len()), 0.0);
            own.iter_mut().zip(its).for_each(|(own, its)| *own = own.max(*its));
        }
    }

    pub(crate) fn watch(&mut self, system: &Compiled, states: &[f64]) {
        for (state, value) in states.iter().enumerate() {
            let scale = &mut self.largest[system.group(state)];
            *scale = scale.max(value.abs());
        }
    }

    /// Rates with their rounding errors, by state.
    pub(crate) fn watch_rates(&mut self, system: &Compiled, noise: &Noise) {
        for (state, (rate, error)) in noise.values.iter().zip(&noise.rates).enumerate() {
            let group = system.group(state);
            let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
            self.rates[group] = self.rates[group].max(finite(rate.abs()));
            self.rounding[group] = self.rounding[group].max(finite(error * self.span));
        }
    }

    /// Scale of a group; zero while nothing in it has moved and no rounding could have moved it.
    pub(crate) fn of(&self, group: usize) -> f64 {
        self.largest[group].max(self.rounding[group])
    }

    /// Length of the run, s.
    pub(crate) fn span(&self) -> f64 {
        self.span
    }

    /// Scale of a group, or, while nothing in it is other than zero, of the way that its rates go in the run.
    pub(crate) fn of_way(&self, group: usize) -> f64 {
        if self.of(group) > 0.0 { self.of(group) } else { self.rates[group] * self.span }
    }

    /// Scale of the rates of a group.
    pub(crate) fn of_rate(&self, group: usize) -> f64 {
        self.rates[group].max(self.largest[group] / self.span)
    }

    /// What rounding errors of the rates may do to each group.
    pub(crate) fn rounding(&self) -> &[f64] {
        &self.rounding
    }

    pub(crate) fn all(&self) -> &[f64] {
        &self.largest
    }
}
