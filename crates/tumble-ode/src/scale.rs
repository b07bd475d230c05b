//! Scales that errors are measured against.

use crate::compiled::Compiled;

/// Running maxima of each group of states, by index.
#[derive(Clone, Debug)]
pub(crate) struct Scales {
    largest: Vec<f64>,
}

impl Scales {
    pub(crate) fn new(floors: &[f64]) -> Self {
        Self { largest: floors.iter().map(|floor| floor.abs()).collect() }
    }

    /// A new mode may have other groups, and larger floors.
    pub(crate) fn raise(&mut self, floors: &[f64]) {
        self.largest.resize(floors.len().max(self.largest.len()), 0.0);
        for (scale, floor) in self.largest.iter_mut().zip(floors) {
            *scale = scale.max(floor.abs());
        }
    }

    pub(crate) fn watch(&mut self, system: &Compiled, states: &[f64]) {
        for (state, value) in states.iter().enumerate() {
            let scale = &mut self.largest[system.group(state)];
            *scale = scale.max(value.abs());
        }
    }

    /// Scale of a group; zero while nothing in it has moved.
    pub(crate) fn of(&self, group: usize) -> f64 {
        self.largest[group]
    }

    pub(crate) fn all(&self) -> &[f64] {
        &self.largest
    }
}
