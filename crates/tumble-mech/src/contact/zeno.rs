//! Impacts that follow each other ever faster: how long they still go on.
//!
//! Once all bounces that are left are lower than [`LOWEST`] of the body's size, the accelerations of the gaps and the
//! responses to impulses are constants over what is left of it, so the rest is arithmetic: for one contact a geometric
//! series, for several the same impacts in miniature, down to nothing. What is left out by holding them constant is of
//! the order of the square of the time left, which the lowness bounds.

use nalgebra::{DMatrix, DVector};

use crate::contact::complementarity::solve;
use crate::laws::impact::{MultipleImpacts, impulses};

/// Bounces lower than this part of the body's size are not followed one by one. The time left is then about 1e-8 of
/// the time that the body takes to fall its own size, and the square of that is rounding.
pub(crate) const LOWEST: f64 = 1e-15;
/// The miniature ends when all speeds are this part of what they were. What is left is taken to be the whole once more, smaller by
/// it: that is exact where impacts repeat themselves, and where they do not it is off by less than this part of the time.
const ENDED: f64 = 1e-12;
/// It may end before, where times are known no better, but not before that.
const SMALL: f64 = 1e-3;
/// Bounces in miniature, by the cube of the number of contacts, before they are too many to be followed: a bounce of many contacts takes
/// as much longer.
const MOST_BOUNCES: usize = 1_600_000;
/// An acceleration that is this part of the largest is none: rounding of what many contacts do to it. A contact without a push stays, and what
/// opens does not come back.
const IDLE: f64 = 1e-10;
/// A flight so many times as long as any of them would bounce alone is none: what stands by what others bear is left with a rate that is rounding.
const TOO_LONG: f64 = 1e3;
/// In miniature, what differs from rest or from its own rebound by less than this part of the fastest after a hit is that: rounding
/// of the hit.
const STANDS: f64 = 1e-12;
/// Hits in miniature closer than this part of the flight are one.
const SIMULTANEOUS: f64 = 1e-12;

/// Contacts of one body, close to a surface and to rest.
pub(crate) struct ZenoSequence<'a> {
    pub(crate) rule: MultipleImpacts,
    pub(crate) response: &'a DMatrix<f64>,
    pub(crate) restitution: &'a DVector<f64>,
    /// Accelerations of the gaps, m/s^2.
    pub(crate) free: &'a DVector<f64>,
    /// No gap may grow beyond this, m.
    pub(crate) lowest: f64,
    /// Times are known to this, s: what is left of it is not followed.
    pub(crate) resolution: f64,
}

impl ZenoSequence<'_> {
    /// Time until all gaps are closed for good, s; `None` if this is no such motion. Contacts that stand have no gap
    /// and no rate. Where several sets of forces would hold them in the end, `pushes` are those that they were chosen by.
    pub(crate) fn remaining(
        &self,
        gap: &DVector<f64>,
        rate: &DVector<f64>,
        pushes: &DVector<f64>,
    ) -> Option<f64> {
        let moves = |i: &usize| gap[*i] != 0.0 || rate[*i] != 0.0;
        let moving: Vec<usize> = (0..gap.len()).filter(moves).collect();
        let loses = self.restitution.iter().all(|e| *e < 1.0);
        let falls = falls(self.response, self.free, pushes);
        let is_low = |i: usize| is_low(gap[i], rate[i], falls[i], self.lowest);
        if moving.is_empty() || !(loses && moving.iter().copied().all(is_low)) {
            return None;
        }
        let longest = || Some(self.longest(gap, rate, &falls));
        match gap.len() {
            1 => longest(),
            _ => self.several(gap, rate, &falls).unwrap_or_else(|Endless| longest()),
        }
    }

    /// The longest that any which moves would bounce alone, s; infinite where one would not come down.
    fn longest(&self, gap: &DVector<f64>, rate: &DVector<f64>, falls: &DVector<f64>) -> f64 {
        let moving = (0..gap.len()).filter(|i| gap[*i] != 0.0 || rate[*i] != 0.0);
        let times = moving.map(|i| alone(gap[i], rate[i], falls[i], self.restitution[i]));
        times.fold(0.0, |most: f64, time| if time.is_nan() { f64::INFINITY } else { most.max(time) })
    }

    /// The same impacts in miniature; no time where contacts part or rise.
    fn several(
        &self,
        gap: &DVector<f64>,
        rate: &DVector<f64>,
        falls: &DVector<f64>,
    ) -> Result<Option<f64>, Endless> {
        let (mut gap, mut rate) = (gap.map(|g| g.max(0.0)), rate.clone());
        let fastest = self.fastest(&gap, &rate).max(f64::MIN_POSITIVE);
        let mut time = 0.0;
        let patience = self.patience();
        let (mut known, mut until) = (1.0, patience);
        let too_long = TOO_LONG * self.longest(&gap, &rate, falls);
        let mut held: Option<(Vec<bool>, DVector<f64>)> = None;
        for bounces in 0..MOST_BOUNCES / gap.len().pow(3) {
            let left = self.fastest(&gap, &rate) / fastest;
            let stands: Vec<bool> = (0..gap.len()).map(|i| gap[i] == 0.0 && rate[i] == 0.0).collect();
            let is_known = left <= SMALL && self.longest(&gap, &rate, falls) <= self.resolution;
            if left <= ENDED || is_known {
                return Ok(Some(time / (1.0 - left)));
            }
            if left <= 0.5 * known {
                (known, until) = (left, bounces as f64 + patience);
            } else if bounces as f64 > until {
                return Err(Endless);
            }
            if held.as_ref().is_none_or(|(known, _)| *known != stands) {
                let Some(free) = self.with_held(&stands) else { return Ok(None) };
                held = Some((stands, free));
            }
            let Some((stands, free)) = &held else { return Ok(None) };
            let Some(flown) = fly((&mut gap, &mut rate), free, stands) else { return Ok(None) };
            if flown > too_long {
                return Err(Endless);
            }
            time += flown;
            let is_solved = self.bounce(&gap, &mut rate).is_some();
            if !is_solved || gap.max() > 4.0 * self.lowest {
                return Ok(None);
            }
        }
        Err(Endless)
    }

    /// Bounces after which all speeds are halved, if contacts lose speed at their hits and nowhere gain it: `ln 2/(1 - e)` hits of the fastest do
    /// it, and between two of these each of the others bounces `ln(1/STANDS)/(1 - e)` times before it stands.
    fn patience(&self) -> f64 {
        let lost = 1.0 - self.restitution.iter().fold(0.0, |most: f64, e| most.max(*e));
        let between = self.restitution.len() as f64 * libm::log(1.0 / STANDS) / lost;
        between * (1.0 + std::f64::consts::LN_2 / lost)
    }

    /// The greatest speed that any of them comes down with: one that is let go has none yet.
    fn fastest(&self, gap: &DVector<f64>, rate: &DVector<f64>) -> f64 {
        let falls = |i: usize| libm::hypot(rate[i], libm::sqrt(2.0 * self.free[i].abs() * gap[i]));
        (0..gap.len()).map(falls).fold(0.0, f64::max)
    }

    /// Accelerations while those contacts that stand are held.
    fn with_held(&self, stands: &[bool]) -> Option<DVector<f64>> {
        let held: Vec<usize> = (0..stands.len()).filter(|i| stands[*i]).collect();
        let push = self.on(&held, solve, self.free)?;
        let none = IDLE * self.free.amax();
        Some((self.free + self.response * push).map(|a| if a.abs() <= none { 0.0 } else { a }))
    }

    fn bounce(&self, gap: &DVector<f64>, rate: &mut DVector<f64>) -> Option<()> {
        let touching: Vec<usize> = (0..gap.len()).filter(|i| gap[*i] == 0.0).collect();
        let e = DVector::from_fn(touching.len(), |i, _| self.restitution[touching[i]]);
        let push = self.on(&touching, |a, v| impulses(self.rule, a, v, &e), rate)?;
        let fastest = rate.amax();
        let before = rate.clone();
        *rate += self.response * push;
        for i in touching {
            // What is known but for rounding: that of many contacts would let them part.
            let rebound = -self.restitution[i] * before[i];
            let known = [0.0, rebound].into_iter().find(|known| (rate[i] - known).abs() <= STANDS * fastest);
            rate[i] = known.unwrap_or(rate[i]);
        }
        Some(())
    }

    /// Solves a problem of some contacts only; the others get nothing.
    fn on(
        &self,
        some: &[usize],
        solved: impl Fn(&DMatrix<f64>, &DVector<f64>) -> Option<DVector<f64>>,
        given: &DVector<f64>,
    ) -> Option<DVector<f64>> {
        let mut all = DVector::zeros(given.len());
        if some.is_empty() {
            return Some(all);
        }
        let part = DMatrix::from_fn(some.len(), some.len(), |i, j| self.response[(some[i], some[j])]);
        let given = DVector::from_fn(some.len(), |i, _| given[some[i]]);
        for (index, push) in solved(&part, &given)?.iter().enumerate() {
            all[some[index]] = *push;
        }
        Some(all)
    }
}

/// Impacts in miniature that do not end before patience does: bodies in a pile pass what is left on to each other. How long they go on
/// is then what the slowest contact would take alone. Only the time depends on it: however the impulses come, they leave contacts at rest
/// and what is across them as it was, and places change by less than the bounces are high.
struct Endless;

/// What contacts fall with, m/s^2, if those pushes hold them: each is pressed in the end, on the way perhaps by others that themselves still
/// bounce. One that bears nothing, since others bear its load, and yet stays, falls as it would without them; what parts does not fall.
pub(crate) fn falls(response: &DMatrix<f64>, free: &DVector<f64>, pushes: &DVector<f64>) -> DVector<f64> {
    let (then, most) = (free + response * pushes, free.amax());
    DVector::from_fn(free.len(), |i, _| match pushes[i] > 0.0 {
        true => response[(i, i)] * pushes[i],
        false if then[i].abs() <= IDLE * most => -free[i],
        false => 0.0,
    })
}

/// Time of one contact that falls with a: flights shrink by its restitution.
pub(crate) fn alone(gap: f64, rate: f64, a: f64, e: f64) -> f64 {
    let first = flight(gap.max(0.0), rate, -a);
    let impact = a * first - rate;
    first + 2.0 * e * impact / (a * (1.0 - e))
}

/// Moves those that do not stand to where the first of them hits; the time that it takes, s, `None` if none does.
fn fly(
    (gap, rate): (&mut DVector<f64>, &mut DVector<f64>),
    free: &DVector<f64>,
    stands: &[bool],
) -> Option<f64> {
    let flights = DVector::from_fn(gap.len(), |i, _| match stands[i] {
        true => f64::INFINITY,
        false => flight(gap[i], rate[i], free[i]),
    });
    let first = flights.min();
    if !first.is_finite() {
        return None;
    }
    for i in (0..gap.len()).filter(|i| !stands[*i]) {
        let hits = flights[i] <= first * (1.0 + SIMULTANEOUS);
        gap[i] = if hits { 0.0 } else { (gap[i] + rate[i] * first + 0.5 * free[i] * first * first).max(0.0) };
        rate[i] += free[i] * first;
    }
    Some(first)
}

/// Whether what falls with a does not rise above a height.
pub(crate) fn is_low(gap: f64, rate: f64, a: f64, height: f64) -> bool {
    a > 0.0 && gap + 0.5 * rate * rate / a <= height
}

/// Time until `gap + rate t + free t^2 / 2` comes back to zero, s; infinite if it does not.
pub(crate) fn flight(gap: f64, rate: f64, free: f64) -> f64 {
    let root = rate * rate - 2.0 * free * gap;
    if free >= 0.0 && (rate >= 0.0 || root < 0.0) {
        return f64::INFINITY;
    }
    // Of the two forms of the root the one without cancellation.
    let root = libm::sqrt(root);
    if rate > 0.0 { (rate + root) / -free } else { 2.0 * gap / (root - rate) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn remaining(response: &[f64], e: f64, gap: &[f64], rate: &[f64]) -> Option<f64> {
        let n = gap.len();
        let (response, free) = (DMatrix::from_row_slice(n, n, response), DVector::from_element(n, -10.0));
        let zeno = ZenoSequence {
            rule: MultipleImpacts::Simultaneous,
            response: &response,
            restitution: &DVector::from_element(n, e),
            free: &free,
            lowest: 1.0,
            resolution: 0.0,
        };
        let pushes = solve(&response, &free)?;
        zeno.remaining(&DVector::from_row_slice(gap), &DVector::from_row_slice(rate), &pushes)
    }

    #[test]
    fn a_geometric_series() {
        // Up with 2 m/s: 0.4 s, then a half of it, ...
        let time = remaining(&[1.0], 0.5, &[0.0], &[2.0]).expect("a Zeno sequence");
        assert!((time - 0.8).abs() < 1e-15);
        // From 0.05 m at rest: 0.1 s down, then 0.1 s, 0.05 s, ...
        let time = remaining(&[1.0], 0.5, &[0.05], &[0.0]).expect("a Zeno sequence");
        assert!((time - 0.3).abs() < 1e-15, "{time}");
    }

    /// Two that do not touch each other are as one.
    #[test]
    fn several_contacts_agree_with_one() {
        let two = remaining(&[1.0, 0.0, 0.0, 1.0], 0.5, &[0.0, 0.0], &[2.0, 1.0]).expect("a Zeno sequence");
        assert!((two - 0.8).abs() < 1e-14, "{two}");
        let two = remaining(&[1.0, 0.0, 0.0, 1.0], 0.5, &[0.05, 0.05], &[0.0, 0.0]).expect("a Zeno sequence");
        assert!((two - 0.3).abs() < ENDED * two, "{two}");
        let rod = remaining(&[4.0, -2.0, -2.0, 4.0], 0.7, &[0.0, 0.0], &[2.0, 2.0]).expect("a Zeno sequence");
        assert!((rod - 0.4 / 0.3).abs() < 1e-14, "{rod}");
    }

    /// One that stands is none of the bounces, and holds as much as its coupling to the other asks for.
    #[test]
    fn one_stands_and_the_other_bounces() {
        let time =
            remaining(&[1.0, -0.5, -0.5, 1.0], 0.5, &[0.0, 0.0], &[0.0, 2.0]).expect("a Zeno sequence");
        // While the first is held, the second falls with 10 + 5 m/s^2.
        assert!((time - 8.0 / 15.0).abs() < 1e-14, "{time}");
    }

    /// What is left when times are no better known changes the time by no more than that.
    #[test]
    fn times_are_as_good_as_they_are_known() {
        let (response, e) =
            (DMatrix::from_row_slice(2, 2, &[4.0, -1.0, -1.0, 3.0]), DVector::from_element(2, 0.6));
        let (free, rule) = (DVector::from_element(2, -10.0), MultipleImpacts::Simultaneous);
        let remaining = |resolution: f64| {
            let (response, restitution, free) = (&response, &e, &free);
            let zeno = ZenoSequence { rule, response, restitution, free, lowest: 1.0, resolution };
            let (rate, pushes) =
                (DVector::from_row_slice(&[2.0, 1.0]), solve(response, free).expect("forces"));
            zeno.remaining(&DVector::zeros(2), &rate, &pushes).expect("a Zeno sequence")
        };
        let exact = remaining(0.0);
        for resolution in [1e-12, 1e-6, 1e-3] {
            let off = exact - remaining(resolution);
            // Each takes so long alone; what they pass on to each other comes to as much again.
            assert!(off.abs() <= 2.0 * resolution, "{resolution}: {off}");
        }
        assert!(remaining(1e-3) != exact);
    }

    /// One hangs over the floor by next to nothing, held by another at the same place, and sinks at a rate that is rounding: it would be down
    /// after a year. It is down as soon as it would fall.
    #[test]
    fn what_another_bears_is_not_waited_for() {
        let (response, free) = (DMatrix::from_element(2, 2, 1.0), DVector::from_element(2, -10.0));
        let zeno = ZenoSequence {
            rule: MultipleImpacts::Simultaneous,
            response: &response,
            restitution: &DVector::from_element(2, 0.5),
            free: &free,
            lowest: 1e-14,
            resolution: 0.0,
        };
        let [gap, rate, pushes] =
            [[4e-15, 0.0], [-1e-22, 0.0], [0.0, 10.0]].map(|of| DVector::from_row_slice(&of));
        let time = zeno.remaining(&gap, &rate, &pushes).expect("a Zeno sequence");
        assert!((time - 3.0 * libm::sqrt(8e-15 / 10.0)).abs() < 1e-6 * time, "{time}");
    }

    #[test]
    fn what_does_not_come_to_rest_is_none() {
        assert_eq!(remaining(&[1.0], 1.0, &[0.0], &[2.0]), None);
        assert_eq!(remaining(&[1.0], 0.5, &[0.0], &[20.0]), None);
    }
}
