//! What falls on something rigid, again and again.

use super::real::Real;

/// Bounces that are followed one by one.
const MOST: usize = 1100;
/// A time is clear of impacts if it is so far from both ends of its flight, in parts of the flight, ...
const CLEAR: &str = "0.05";
/// ... the flight is no shorter than this part of the time, ...
const SHORTEST: &str = "1e-4";
/// ... and after the last of infinitely many impacts it is later by this part of the time.
const PAST: &str = "1e-2";

/// The gap between a body and a surface that it falls on, under a constant acceleration.
#[derive(Clone, Debug)]
pub(crate) struct Bounces {
    gravity: Real,
    gap: Real,
    rate: Real,
    restitution: Real,
    hits: Vec<Hit>,
}

/// An impact: when, and the speeds before and after it.
#[derive(Clone, Debug)]
pub(crate) struct Hit {
    pub(crate) time: Real,
    pub(crate) before: Real,
    pub(crate) after: Real,
}

impl Bounces {
    /// From the gap and its rate at the start; without gravity the rate is negative.
    pub(crate) fn new(gravity: Real, gap: Real, rate: Real, restitution: Real) -> Self {
        let before = (rate.squared() + &gravity * &gap * 2).sqrt();
        // Both are the same: each is used where it is no difference of what may be nearly equal.
        let leaves = rate.sign() >= 0 && !gravity.is_zero();
        let time = if leaves { (&rate + &before) / &gravity } else { &gap * 2 / (&before - &rate) };
        let after = &before * &restitution;
        let mut bounces = Self { gravity, gap, rate, restitution, hits: vec![Hit { time, before, after }] };
        bounces.follow();
        bounces
    }

    fn follow(&mut self) {
        while self.hits.len() < MOST && !self.gravity.is_zero() && !self.restitution.is_zero() {
            let last = &self.hits[self.hits.len() - 1];
            let time = &last.time + &last.after * 2 / &self.gravity;
            let (before, after) = (last.after.clone(), &last.after * &self.restitution);
            self.hits.push(Hit { time, before, after });
        }
    }

    pub(crate) fn hits(&self) -> &[Hit] {
        &self.hits
    }

    /// When the last of infinitely many impacts is over; `None` where they go on.
    pub(crate) fn limit(&self) -> Option<Real> {
        let rest = 1 - &self.restitution;
        if rest.sign() <= 0 || self.gravity.is_zero() {
            return None;
        }
        let first = &self.hits[0];
        Some(&first.time + &first.after * 2 / &self.gravity / rest)
    }

    /// The impacts before a time.
    pub(crate) fn before(&self, time: &Real) -> &[Hit] {
        &self.hits[..self.hits.partition_point(|hit| hit.time < *time)]
    }

    fn is_at_rest(&self, time: &Real) -> bool {
        self.limit().is_some_and(|limit| *time >= limit)
    }

    /// Gap and rate at a time that is no impact.
    pub(crate) fn at(&self, time: &Real) -> [Real; 2] {
        if self.is_at_rest(time) {
            return [Real::zero(), Real::zero()];
        }
        let (since, gap, rate) = match self.before(time).last() {
            None => (time.clone(), self.gap.clone(), self.rate.clone()),
            Some(hit) => (time - &hit.time, Real::zero(), hit.after.clone()),
        };
        let fallen = &self.gravity * &since;
        [gap + (&rate - &fallen / 2) * &since, rate - fallen]
    }

    /// Whether a time is so far from every impact that its side of them is beyond doubt.
    pub(crate) fn is_clear(&self, time: &Real) -> bool {
        if let Some(limit) = self.limit().filter(|limit| time >= limit) {
            return time - &limit > limit * Real::read(PAST);
        }
        let count = self.before(time).len();
        let from = if count == 0 { Real::zero() } else { self.hits[count - 1].time.clone() };
        let Some(to) = self.hits.get(count).map(|hit| &hit.time) else { return self.gravity.is_zero() };
        let (flight, edge) = (to - &from, (to - &from) * Real::read(CLEAR));
        flight > time * Real::read(SHORTEST) && time - &from > edge && to - time > edge
    }

    /// The energy that the impacts before a time have taken, for a mass of one.
    pub(crate) fn lost(&self, time: &Real) -> Real {
        let first = self.hits[0].before.squared();
        if self.is_at_rest(time) {
            return first / 2;
        }
        let last = self.before(time).last().map_or(first.clone(), |hit| hit.after.squared());
        (first - last) / 2
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(restitution: &str) -> Bounces {
        let [gravity, gap, rate] = ["10", "1.25", "0"].map(Real::read);
        Bounces::new(gravity, gap, rate, Real::read(restitution))
    }

    #[test]
    fn a_ball_from_a_height() {
        let half = of("0.5");
        // It falls for half a second, and each flight takes half the time of the one before.
        let times: Vec<f64> = half.hits()[..3].iter().map(|hit| hit.time.to_f64()).collect();
        assert_eq!(times, [0.5, 1.0, 1.25]);
        assert_eq!(half.limit().expect("it comes to rest").to_f64(), 1.5);
        assert_eq!(half.at(&Real::read("0.75")).map(|part| part.to_f64()), [0.3125, 0.0]);
        assert_eq!(half.lost(&Real::from(2)).to_f64(), 12.5);
        assert_eq!(half.lost(&Real::read("0.75")).to_f64(), 12.5 * 0.75);
    }

    #[test]
    fn clear_times() {
        let elastic = of("1");
        assert!(elastic.is_clear(&Real::from(1)) && elastic.limit().is_none());
        assert!(!elastic.is_clear(&Real::read("1.51")));
        let half = of("0.5");
        assert!(!half.is_clear(&Real::read("1.501")) && half.is_clear(&Real::from(2)));
    }
}
