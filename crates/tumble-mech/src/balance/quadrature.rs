//! Integrals along a piece, to rounding.
//!
//! Along a piece everything is smooth: the integrator ends it where a branch changes its sign. At Gauss nodes inside it
//! each branch therefore has the piece's own sign, and what has no derivative at an end does no harm. The expansion in
//! Legendre polynomials through the nodes shows whether they are enough; where they are not, the piece is halved.

use crate::gauss;

/// Work, impulse along x and y, and angular impulse: integrals of power, force and torque.
pub(super) type Amounts = [f64; 4];

/// Nodes on a stretch: a Taylor step's functions are resolved to rounding by them.
const NODES: usize = 16;
/// Coefficients at the end of the expansion that tell how fast it falls off; three, since symmetric functions lack
/// some.
const TAIL: usize = 3;
/// An error below this part of the integrals of absolute values is rounding.
const RESOLVED: f64 = 1e-15;
/// A piece is halved at most that many times in a row. Where this is met, the residuals of the balances show it.
const MOST_HALVINGS: u32 = 12;

/// An instant that no node is to be near lies in this gap between nodes, counted from the end: so few nodes behind it, since steps end
/// soon behind such an instant, and as wide a stretch as can be.
const OVER_GAPS: usize = 2;

/// Integrands at one instant.
#[derive(Default)]
pub(super) struct Sample {
    /// By line.
    pub(super) rates: Vec<Amounts>,
    /// Largest sizes of what the rates are sums of: rounding in them is relative to these.
    pub(super) sizes: Amounts,
}

/// A rule with the last Legendre polynomials at its nodes.
pub(super) struct Quadrature {
    nodes: Vec<(f64, f64, [f64; TAIL])>,
}

/// A line whose power, force or torque is infinite or not a number.
#[derive(Debug)]
pub(super) struct NotFinite {
    pub(super) line: usize,
    /// Parameter at the start of the stretch on which it is.
    pub(super) from: f64,
}

/// Integrals over a stretch, by line, and their error in units of what is allowed.
struct Stretch {
    integrals: Vec<Amounts>,
    excess: f64,
}

impl Quadrature {
    pub(super) fn new() -> Self {
        let node =
            |(x, weight)| (x, weight, std::array::from_fn(|index| projection(NODES - TAIL + index, x)));
        Self { nodes: gauss::rule(NODES).into_iter().map(node).collect() }
    }

    /// Adds the integrals of what `sample` gives at each value of the parameter, by line, to what `add` keeps.
    pub(super) fn integrate(
        &self,
        [from, to]: [f64; 2],
        sample: &mut impl FnMut(f64) -> Sample,
        add: &mut impl FnMut(usize, &Amounts),
    ) -> Result<(), NotFinite> {
        let mut pending = vec![(from, to, 0)];
        while let Some((from, to, halvings)) = pending.pop() {
            let Stretch { integrals, excess } = self.finite([from, to], sample)?;
            let middle = 0.5 * (from + to);
            if excess > 1.0 && halvings < MOST_HALVINGS && from < middle && middle < to {
                pending.extend([(middle, to, halvings + 1), (from, middle, halvings + 1)]);
            } else {
                integrals.iter().enumerate().for_each(|(line, amounts)| add(line, amounts));
            }
        }
        Ok(())
    }

    /// Integrals over a stretch, if they are numbers.
    fn finite(
        &self,
        [from, to]: [f64; 2],
        sample: &mut impl FnMut(f64) -> Sample,
    ) -> Result<Stretch, NotFinite> {
        let stretch = self.stretch([from, to], sample);
        let is_finite = |amounts: &Amounts| amounts.iter().all(|amount| amount.is_finite());
        match stretch.integrals.iter().position(|amounts| !is_finite(amounts)) {
            Some(line) => Err(NotFinite { line, from }),
            None => Ok(stretch),
        }
    }

    /// The same over an instant at which nothing is known, from a length before it to another after it: its last part is one stretch,
    /// in which the instant lies between two nodes. What is smooth there is known by the others.
    pub(super) fn over(
        &self,
        [before, after]: [f64; 2],
        sample: &mut impl FnMut(f64) -> Sample,
        add: &mut impl FnMut(usize, &Amounts),
    ) -> Result<(), NotFinite> {
        let whole = before + after;
        // Rules are symmetric, so their nodes come in either order.
        let mut places: Vec<f64> = self.nodes.iter().map(|(x, ..)| *x).collect();
        places.sort_by(f64::total_cmp);
        let between = |gap: usize| 0.5 * (places[NODES - gap] + places[NODES - gap - 1]);
        let part = |gap: usize| 2.0 * after / (1.0 - between(gap));
        let gap = (OVER_GAPS..NODES / 2).find(|gap| part(*gap) <= whole);
        let from = gap.map_or(0.0, |gap| whole - part(gap));
        self.integrate([0.0, from], sample, add)?;
        let Stretch { integrals, .. } = self.finite([from, whole], sample)?;
        integrals.iter().enumerate().for_each(|(line, amounts)| add(line, amounts));
        Ok(())
    }

    fn stretch(&self, [from, to]: [f64; 2], sample: &mut impl FnMut(f64) -> Sample) -> Stretch {
        let half = 0.5 * (to - from);
        let samples: Vec<Sample> = self.nodes.iter().map(|(x, ..)| sample(from + half * (1.0 + x))).collect();
        let lines = samples.first().map_or(0, |first| first.rates.len());
        let integrals = (0..lines).map(|line| {
            std::array::from_fn(|which| half * self.sum(&samples, |sample| sample.rates[line][which]))
        });
        let integrals = integrals.collect();
        let sizes: Amounts =
            std::array::from_fn(|which| samples.iter().map(|s| s.sizes[which]).fold(0.0, f64::max));
        let error = |line: usize, which: usize| self.error(&samples, |sample| sample.rates[line][which]);
        let excess = |line: usize| {
            (0..4)
                .map(|which| error(line, which) / (RESOLVED * sizes[which]).max(f64::MIN_POSITIVE))
                .fold(0.0, f64::max)
        };
        Stretch { integrals, excess: (0..lines).map(excess).fold(0.0, f64::max) }
    }

    fn sum(&self, samples: &[Sample], of: impl Fn(&Sample) -> f64) -> f64 {
        self.nodes.iter().zip(samples).map(|((_, weight, _), sample)| weight * of(sample)).sum()
    }

    /// Mean error of the sum. Coefficients fall off geometrically and the sum misses those beyond twice the nodes, so
    /// it is the square of the last ones seen, relative to the largest value.
    fn error(&self, samples: &[Sample], of: impl Fn(&Sample) -> f64) -> f64 {
        let largest = samples.iter().map(|sample| of(sample).abs()).fold(0.0, f64::max);
        let coefficient = |index: usize| -> f64 {
            let nodes = self.nodes.iter().zip(samples);
            nodes.map(|((_, weight, tail), sample)| weight * tail[index] * of(sample)).sum()
        };
        let tail = (0..TAIL).map(|index| coefficient(index).abs()).fold(0.0, f64::max);
        if tail == 0.0 { 0.0 } else { tail * (tail / largest).min(1.0) }
    }
}

/// What a value is multiplied by, besides its weight, to give the coefficient of the Legendre polynomial of degree n.
fn projection(n: usize, x: f64) -> f64 {
    let (mut before, mut here) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, here) = (here, ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k);
    }
    (n as f64 + 0.5) * here
}

/// A sum with what rounding has left out of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    sum: f64,
    compensation: f64,
}

impl Sum {
    /// After Neumaier: whichever is larger keeps its digits.
    pub(super) fn add(&mut self, value: f64) {
        let sum = self.sum + value;
        self.compensation += match self.sum.abs() >= value.abs() {
            true => (self.sum - sum) + value,
            false => (value - sum) + self.sum,
        };
        self.sum = sum;
    }

    pub(super) fn of(sum: f64) -> Self {
        Self { sum, compensation: 0.0 }
    }

    pub(super) fn value(self) -> f64 {
        self.sum + self.compensation
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(f: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> (f64, usize) {
        let (mut sum, mut samples) = (Sum::default(), 0);
        let mut sample = |s: f64| {
            samples += 1;
            Sample { rates: vec![[f(s); 4]], sizes: [f(s).abs(); 4] }
        };
        let found =
            Quadrature::new().integrate([from, to], &mut sample, &mut |_, amounts| sum.add(amounts[0]));
        found.expect("finite");
        (sum.value(), samples)
    }

    #[test]
    fn one_stretch_is_enough_for_a_step_and_many_are_taken_for_more() {
        let (value, samples) = integral(libm::exp, [0.0, 1.0]);
        assert!((value - (std::f64::consts::E - 1.0)).abs() < 1e-15 && samples == NODES, "{value} {samples}");
        let (value, samples) = integral(|s| libm::cos(100.0 * s), [0.0, 3.0]);
        assert!((value - libm::sin(300.0) / 100.0).abs() < 1e-15 && samples > 8 * NODES, "{value} {samples}");
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        let mut sample = |s: f64| Sample { rates: vec![[1.0 / (s - s); 4]], sizes: [1.0; 4] };
        assert!(Quadrature::new().integrate([0.0, 1.0], &mut sample, &mut |_, _| ()).is_err());
    }

    #[test]
    fn small_terms_are_kept() {
        let mut sum = Sum::default();
        [1.0, 1e-17, 1e100, 1e-17, -1e100].into_iter().for_each(|value| sum.add(value));
        assert_eq!(sum.value(), 1.0);
        let mut sum = Sum::default();
        (0..1_000_000).for_each(|_| sum.add(0.1));
        assert!((sum.value() - 1e5).abs() < 1e-10 * 1e-5);
    }
}
