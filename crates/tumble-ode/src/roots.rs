//! All roots of a polynomial in an interval, in order.
//!
//! A cheap bound says at once that most guards stay away from zero. Otherwise the polynomial is put in Bernstein form and
//! halved until each part has at most one change of sign (Descartes' rule), and a bracketed Newton iteration finds the root.
//! Roots that stay together down to [`CLUSTER`] of the interval, or a dip to zero that is smaller than rounding, are
//! one touch if the polynomial has one sign on both sides, and one crossing if it has two.

use smallvec::{SmallVec, smallvec};
use tumble_expr::{Bernstein, Row};

use crate::polynomial;
use crate::signs::leading;

/// Parts of the interval below which roots are not told apart: a double root of a polynomial known to rounding is
/// spread over about its square root.
const CLUSTER: f64 = 1e-9;
/// A polynomial that begins with less than this part of its terms at the far end has its beginning searched by itself, ...
const SMALL: f64 = 1e-6;
/// ... and that is this part of the interval.
const BEGINNING: f64 = 1.0 / 1024.0;
/// Newton steps; each that fails is a bisection, and sixty of these exhaust a double.
const REFINEMENTS: usize = 120;

/// A root in the open-closed interval (0, length].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    pub(crate) at: f64,
    /// Sign beyond the root where the polynomial crosses zero; `None` where it touches and turns back.
    pub(crate) crosses_to: Option<f64>,
}

/// Roots of one polynomial: seldom are there more than some.
pub(crate) type Roots = SmallVec<[Root; 4]>;

/// Roots in (0, length], in order, of a polynomial by its coefficients of powers. One at 0 is not counted.
pub(crate) fn roots(powers: &[f64], length: f64) -> Roots {
    // Over a long interval its high powers overflow, though their coefficients are zero.
    let degree = powers.iter().rposition(|c| *c != 0.0).unwrap_or(0);
    let powers = &powers[..powers.len().min(degree + 1)];
    if keeps_away(powers, length) {
        return smallvec![];
    }
    let size = size_of(powers, length);
    let mut found = inside(powers, length, size);
    found.extend(at_end(powers, length, size));
    found
}

/// The sum of the sizes of all terms at the end of the interval.
fn size_of(powers: &[f64], length: f64) -> f64 {
    powers.iter().rev().fold(0.0, |sum, c| sum * length + c.abs())
}

/// A root at the end of the interval, but for rounding: signs within it do not tell of that one.
fn at_end(powers: &[f64], length: f64, size: f64) -> Option<Root> {
    if polynomial::value(powers, length).abs() > noise_of(powers, size) || !size.is_finite() {
        return None;
    }
    let ahead = polynomial::shifted(powers, length);
    let order = 1 + leading(&ahead[1..])?;
    let crosses = !order.is_multiple_of(2);
    Some(Root { at: length, crosses_to: crosses.then(|| ahead[order].signum()) })
}

/// What rounding makes of a value that is the sum of terms of that size.
fn noise_of(powers: &[f64], size: f64) -> f64 {
    powers.len() as f64 * f64::EPSILON * size
}

/// Roots in (0, length), as far as signs on both sides tell of them.
///
/// Rounding is relative to the largest terms, which are those at the far end: where the polynomial is much smaller at
/// its beginning, that is searched by itself.
fn inside(powers: &[f64], length: f64, size: f64) -> Roots {
    let (first, near) = (powers[0].abs(), length * BEGINNING);
    if first == 0.0 || first > SMALL * size || near < f64::MIN_POSITIVE {
        return search(powers, length);
    }
    let size = size_of(powers, near);
    let mut found = inside(powers, near, size);
    found.extend(at_end(powers, near, size));
    let rest = search(&polynomial::shifted(powers, near), length - near);
    found.extend(rest.into_iter().map(|root| Root { at: near + root.at, ..root }));
    found
}

/// Where the slope of a polynomial, by its coefficients of powers, is zero in (0, length], in order.
pub fn turns(coefficients: &[f64], length: f64) -> Vec<f64> {
    roots(&polynomial::derivative(coefficients), length).into_iter().map(|root| root.at).collect()
}

fn search(powers: &[f64], length: f64) -> Roots {
    let mut power = 1.0;
    let scaled: Row = powers
        .iter()
        .map(|c| {
            let term = c * power;
            power *= length;
            term
        })
        .collect();
    let size: f64 = scaled.iter().map(|c| c.abs()).sum();
    if !size.is_finite() || size == 0.0 {
        return smallvec![];
    }
    let noise = noise_of(&scaled, size);
    let mut search = Search { scaled: &scaled, noise, found: smallvec![] };
    search.interval(&Bernstein::new(scaled.iter().copied()), 0.0, 1.0);
    search.found.iter().map(|root| Root { at: root.at * length, ..*root }).collect()
}

/// Whether the lowest terms outweigh all others on the interval, and not by rounding alone.
fn keeps_away(powers: &[f64], length: f64) -> bool {
    let terms = powers.iter().skip(1).rev();
    let others = terms.fold(0.0, |sum: f64, c| (sum + c.abs()) * length);
    powers.first().is_none_or(|first| first.abs() - others > noise_of(powers, first.abs()))
}

struct Search<'a> {
    scaled: &'a [f64],
    noise: f64,
    found: Roots,
}

impl Search<'_> {
    /// Roots in (low, high].
    fn interval(&mut self, part: &Bernstein, low: f64, high: f64) {
        match part.sign_changes(self.noise) {
            0 => {}
            1 => self.crossing(part, low, high),
            _ if high - low < CLUSTER => self.cluster(part, low, high),
            _ => self.split(part, low, high),
        }
    }

    fn split(&mut self, part: &Bernstein, low: f64, high: f64) {
        let (left, right) = part.halves();
        let middle = 0.5 * (low + high);
        self.interval(&left, low, middle);
        // A root on the cut is seen by neither half.
        if right.0[0].abs() <= self.noise
            && let (Some(before), Some(after)) = (self.last_sign(&left), self.first_sign(&right))
            && before != after
        {
            self.found.push(Root { at: middle, crosses_to: Some(after) });
        }
        self.interval(&right, middle, high);
    }

    /// Exactly one root: between the ends, which have opposite signs but for noise.
    fn crossing(&mut self, part: &Bernstein, low: f64, high: f64) {
        let after = self.last_sign(part).unwrap_or(1.0);
        let at = self.refine(low, high, after);
        // What lies within rounding of the left end was counted there.
        self.found.push(Root { at, crosses_to: Some(after) });
    }

    fn cluster(&mut self, part: &Bernstein, low: f64, high: f64) {
        let (before, after) = (self.first_sign(part), self.last_sign(part));
        let at = 0.5 * (low + high);
        self.found.push(Root { at, crosses_to: if before == after { None } else { after } });
    }

    fn first_sign(&self, part: &Bernstein) -> Option<f64> {
        part.0.iter().find(|b| b.abs() > self.noise).map(|b| b.signum())
    }

    fn last_sign(&self, part: &Bernstein) -> Option<f64> {
        part.0.iter().rev().find(|b| b.abs() > self.noise).map(|b| b.signum())
    }

    /// The root in a bracket by Newton's method, falling back to halving the bracket.
    fn refine(&self, mut low: f64, mut high: f64, sign_after: f64) -> f64 {
        let mut at = 0.5 * (low + high);
        for _ in 0..REFINEMENTS {
            let value = polynomial::value(self.scaled, at) * sign_after;
            if value == 0.0 {
                return at;
            }
            if value > 0.0 {
                high = at
            } else {
                low = at
            }
            let newton = at - value / (polynomial::slope(self.scaled, at) * sign_after);
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if next == at || next <= low || next >= high {
                return next;
            }
            at = next;
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn over_a_long_interval_zero_coefficients_hide_nothing() {
        let mut powers = vec![0.16, -8e-12];
        powers.resize(26, 0.0);
        let found = roots(&powers, 2.4e12);
        assert_eq!(found.len(), 1);
        assert!((found[0].at - 2e10).abs() < 1e-4, "{}", found[0].at);
    }

    /// Coefficients of the product of (s - r) over the roots, times `lead`.
    fn with_roots(lead: f64, roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![lead], |p, r| {
            let mut product = vec![0.0; p.len() + 1];
            for (k, c) in p.iter().enumerate() {
                product[k + 1] += c;
                product[k] -= r * c;
            }
            product
        })
    }

    fn crossings(p: &[f64], length: f64) -> Vec<f64> {
        roots(p, length).into_iter().filter(|root| root.crosses_to.is_some()).map(|root| root.at).collect()
    }

    #[track_caller]
    fn same(found: &[f64], expected: &[f64], tolerance: f64) {
        assert_eq!(found.len(), expected.len(), "{found:?} for {expected:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < tolerance, "{found:?} for {expected:?}");
        }
    }

    #[test]
    fn separated_roots_come_in_order_with_their_direction() {
        let p = with_roots(2.0, &[0.3, 0.1, 0.75, 1.4, -0.2]);
        same(&crossings(&p, 1.0), &[0.1, 0.3, 0.75], 1e-14);
        let signs: Vec<_> = roots(&p, 1.0).iter().map(|root| root.crosses_to).collect();
        assert_eq!(signs, [Some(-1.0), Some(1.0), Some(-1.0)]);
    }

    #[test]
    fn roots_at_the_ends() {
        // At 0 it is not counted, at the end it is.
        same(&crossings(&with_roots(1.0, &[0.0, 1.0]), 1.0), &[1.0], 1e-15);
        same(&crossings(&[-0.125, 1.0], 0.125), &[0.125], 1e-17);
        same(&crossings(&[-0.1, 1.0], 0.1), &[0.1], 1e-17);
        same(&crossings(&with_roots(1.0, &[1.0, 1.0]), 1.0), &[], 1e-15);
        same(&crossings(&with_roots(1.0, &[1.0, 1.0, 1.0]), 1.0), &[1.0], 1e-4);
        same(&crossings(&with_roots(1.0, &[0.5, 1.0 - 1e-12]), 1.0), &[0.5, 1.0], 2e-12);
        same(&crossings(&with_roots(1.0, &[1e-14]), 1.0), &[1e-14], 1e-20);
    }

    /// A root far closer to the beginning than the rounding of the terms at the end.
    #[test]
    fn the_beginning_is_seen() {
        for first in [1e-9, 1e-13, 1e-16, 1e-22, 1e-30] {
            // first - 1e-7 s - 5 s^2 + s^20
            let mut p = vec![0.0; 21];
            (p[0], p[1], p[2], p[20]) = (first, -1e-7, -5.0, 1.0);
            let inside: f64 = 1e-14 + 20.0 * first;
            let expected = 2.0 * first / (1e-7 + inside.sqrt());
            same(&crossings(&p, 1.0), &[expected], 1e-14 * expected);
        }
    }

    #[test]
    fn a_root_on_the_first_cut() {
        same(&crossings(&with_roots(1.0, &[0.5]), 1.0), &[0.5], 1e-16);
        same(&crossings(&with_roots(1.0, &[0.5, 0.25, 0.75]), 1.0), &[0.25, 0.5, 0.75], 1e-14);
    }

    #[test]
    fn a_double_root_touches() {
        for at in [0.3, 0.5, 0.123456789] {
            let p = with_roots(1.0, &[at, at]);
            assert_eq!(crossings(&p, 1.0), [] as [f64; 0], "at {at}: {:?}", roots(&p, 1.0));
        }
    }

    /// Two roots some ulps apart: seen as both or as none, never as one, which would flip a sign for good.
    #[test]
    fn near_double_roots_are_an_even_number() {
        for gap in [1e-16, 4e-16, 1e-15, 1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-3] {
            for at in [0.3, 0.5, 0.7371, 0.9] {
                for others in [&[][..], &[-0.3, 1.7], &[2.0, 3.0, -4.0]] {
                    let all: Vec<f64> = [at, at + gap].iter().chain(others).copied().collect();
                    let found = crossings(&with_roots(1.0, &all), 1.0);
                    assert!(found.len().is_multiple_of(2), "{found:?} for {at} and {gap:e}");
                    assert!(gap < 1e-6 || found.len() == 2, "{found:?} for {at} and {gap:e}");
                }
            }
        }
    }

    #[test]
    fn a_triple_root_crosses_once() {
        let p = with_roots(1.0, &[0.4, 0.4, 0.4]);
        let found = crossings(&p, 1.0);
        assert_eq!(found.len() % 2, 1, "{found:?}");
        assert!((found[0] - 0.4).abs() < 1e-4);
    }

    #[test]
    fn nothing_to_find() {
        assert!(roots(&[0.0; 5], 1.0).is_empty());
        assert!(roots(&[], 1.0).is_empty());
        assert!(roots(&[1.0, f64::NAN], 1.0).is_empty());
        assert!(roots(&[1.0, -0.5, 0.1], 1.0).is_empty());
    }

    proptest! {
        /// Against the roots the polynomial was made from, degrees 2 to 30.
        #[test]
        fn every_separated_root_is_found(
            inside in proptest::collection::vec(0.001f64..0.999, 0..7),
            outside in proptest::collection::vec(prop_oneof![-3.0f64..-0.3, 1.3f64..4.0], 2..24),
            length in 1e-6f64..1e6,
        ) {
            let mut inside = inside;
            inside.sort_by(f64::total_cmp);
            inside.dedup_by(|a, b| (*a - *b).abs() < 0.02);
            let all: Vec<f64> = inside.iter().chain(&outside).copied().collect();
            let p = with_roots(1.0, &all);
            let stretched: Vec<f64> = p.iter().enumerate().map(|(k, c)| c / length.powi(k as i32)).collect();
            // The coefficients only know the roots to the polynomial's own noise.
            let found = crossings(&stretched, length);
            let size: f64 = p.iter().map(|c| c.abs()).sum();
            for r in &inside {
                let slope = polynomial::slope(&p, *r).abs();
                let blur = 100.0 * f64::EPSILON * size / slope;
                prop_assume!(blur < 1e-3);
                prop_assert!(found.iter().any(|f| (f / length - r).abs() < blur + 1e-14), "{} in {:?}", r, found);
            }
            prop_assert_eq!(found.len(), inside.len());
        }

        /// A sign that differs at both ends is a crossing, whatever the polynomial.
        #[test]
        fn crossings_agree_with_the_ends(p in proptest::collection::vec(-1.0f64..1.0, 2..30)) {
            let (start, end) = (p[0], polynomial::value(&p, 1.0));
            prop_assume!(start.abs() > 1e-10 && end.abs() > 1e-10);
            let odd = crossings(&p, 1.0).len() % 2 == 1;
            prop_assert_eq!(odd, start * end < 0.0);
        }
    }
}
