//! The independent check of a step: does the polynomial satisfy the equations?
//!
//! The polynomial is put into the rates, evaluated as values and not as series. The defect `x'(s) - f(x(s))` at the end
//! and inside, times the step over the order, estimates the step's error: a term of order p+1 left out adds
//! `c h^(p+1)` to the state and `(p+1) c h^p` to the defect.

use tumble_expr::{Branches, Jets};

use crate::compiled::Compiled;
use crate::expansion::Expansion;
use crate::polynomial::{look, value};
use crate::whole::Demand;
use crate::work::Work;

/// Where in the step the defect is looked at.
const PLACES: &[f64] = &[0.618, 1.0];
/// The estimate may exceed the tolerance by this before the step is rejected: the order's rule aims at 1.
const SLACK: f64 = 4.0;
/// Rounding errors of an evaluation of the defect, in units of its largest term's last place.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Rounding errors of a rate within a step, in units of that at its start.
const NOISE: f64 = 4.0;

/// What a check found.
pub(crate) struct Verdict {
    /// Largest error found, in units of what is allowed: at most 1 in a step to accept.
    pub(crate) excess: f64,
    /// The state it was found in.
    pub(crate) state: usize,
}

impl Verdict {
    /// The worse of two; one that is not a number is worst of all.
    pub(crate) fn or(self, other: Self) -> Self {
        if self.excess.is_nan() || other.excess <= self.excess { self } else { other }
    }
}

pub(crate) struct Check<'a> {
    pub(crate) system: &'a Compiled,
    pub(crate) values: &'a mut Jets<f64>,
    pub(crate) demand: &'a Demand<'a>,
    /// The branch signs that hold in the step.
    pub(crate) signs: &'a [f64],
    /// Values, slopes and sizes of these, and the values alone: room that is used again.
    pub(crate) places: &'a mut Vec<[f64; 3]>,
    pub(crate) here: &'a mut Vec<f64>,
}

impl Check<'_> {
    pub(crate) fn step(&mut self, expansion: &Expansion, h: f64, work: &mut Work) -> Verdict {
        let mut worst = Verdict { excess: 0.0, state: 0 };
        for place in PLACES {
            work.checks += 1;
            let found = self.at(expansion, place * h, h);
            worst = worst.or(found);
        }
        worst
    }

    fn at(&mut self, expansion: &Expansion, s: f64, h: f64) -> Verdict {
        self.places.clear();
        self.places.extend(expansion.states.iter().map(|series| look(series, s)));
        self.here.clear();
        self.here.extend(self.places.iter().map(|[value, ..]| value));
        let time = expansion.time.as_ref().map_or(expansion.start + s, |series| value(series, s));
        self.values.start(time, self.here, Branches::Frozen(self.signs));
        let excess = |(state, (place, series)): (usize, (&[f64; 3], &[f64]))| Verdict {
            excess: self.excess(state, series, *place, h),
            state,
        };
        let all = self.places.iter().zip(expansion.states.iter()).enumerate().map(excess);
        all.fold(Verdict { excess: 0.0, state: 0 }, Verdict::or)
    }

    fn excess(&self, state: usize, series: &[f64], [here, slope, size]: [f64; 3], h: f64) -> f64 {
        let defect = (slope - self.values.value_of(state)).abs();
        let order = series.len() as f64;
        let scale = self.demand.scales.of(self.system.group(state)).max(here.abs()).max(series[0].abs());
        let allowed = SLACK * self.demand.tolerance * scale
            + ROUNDING * size * h
            + NOISE * self.demand.noise.rates[state] * h / order;
        let error = defect * h / order;
        if error == 0.0 { 0.0 } else { error / allowed }
    }
}
