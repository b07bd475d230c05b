//! What errors of the right sides, and of the matrix, make of the unknowns of a linear system: `|A^-1| w`, w by row.
//!
//! A small matrix has this row by row, from the columns of its inverse. For a large one, errors of random signs are solved for: with
//! `A^-1 (s w)` over signs s, the mean of the squares of an unknown is `sum of (C_ij w_j)^2` with C the inverse, whose root
//! is what rounding errors add up to that know nothing of each other; whatever their signs, they are no more than the root of n
//! times that (Cauchy and Schwarz). So it costs some substitutions, not n.
//!
//! Source: Hutchinson, Commun. Stat. Simul. Comput. 19 (1990), for the signs.

use super::elimination::Plan;

/// Substitutions: columns of the inverse, or signs. The mean of the squares of so many is off by more than a factor of nine less than
/// once in a hundred thousand times.
const PROBES: usize = 16;
/// A root of such a mean is taken so many times.
const SAFE: f64 = 3.0;
/// How often an error bound is put into itself until it is large enough.
const REPEATS: usize = 12;
/// So much wider than what is put in a bound has to be to hold.
const WIDER: f64 = 1.1;

/// A matrix with its factors.
pub(crate) struct Amplifier<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) factors: &'a [f64],
}

impl Amplifier<'_> {
    pub(crate) fn solve(&self, mut right: Vec<f64>) -> Vec<f64> {
        let mut x = vec![0.0; right.len()];
        self.plan.substitute(self.factors, &mut right, &mut x);
        x
    }

    /// Errors of the unknowns by those of the rows, which have nothing to do with each other.
    pub(crate) fn likely(&self, errors: &[f64]) -> Vec<f64> {
        self.with(errors, SAFE)
    }

    /// The same whatever the signs of the errors.
    pub(crate) fn most(&self, errors: &[f64]) -> Vec<f64> {
        self.with(errors, SAFE * (errors.len() as f64).sqrt())
    }

    fn with(&self, errors: &[f64], factor: f64) -> Vec<f64> {
        let n = errors.len();
        let mut sums = vec![0.0; n];
        if n <= PROBES {
            for column in 0..n {
                let own = |row: usize| if row == column { errors[row] } else { 0.0 };
                let x = self.solve((0..n).map(own).collect());
                sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x.abs());
            }
            return sums;
        }
        for probe in 0..PROBES {
            let signed = |(row, error): (usize, &f64)| if is_negative(probe, row) { -error } else { *error };
            let x = self.solve(errors.iter().enumerate().map(signed).collect());
            sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x * x);
        }
        sums.into_iter().map(|sum| factor * (sum / PROBES as f64).sqrt()).collect()
    }

    /// Some d with `|A^-1| (first + change(d)) <= d`, entry by entry, of a matrix whose errors change what the rows give by `change`.
    pub(crate) fn enclosed(&self, first: &[f64], change: impl Fn(&[f64]) -> Vec<f64>) -> Option<Vec<f64>> {
        let own = self.most(first);
        let again = |bounds: &[f64]| -> Vec<f64> {
            own.iter().zip(self.most(&change(bounds))).map(|(own, more)| own + more).collect()
        };
        let mut bounds = own.clone();
        let mut next = again(&bounds);
        for _ in 0..REPEATS {
            bounds = next.iter().map(|bound| WIDER * bound).collect();
            let after = again(&bounds);
            if after.iter().zip(&bounds).all(|(after, bound)| after <= bound) {
                return Some(bounds);
            }
            next = after;
        }
        None
    }
}

/// Signs that no two rows or probes have in common (Steele, Lea and Flood's mixing of a counter).
fn is_negative(probe: usize, row: usize) -> bool {
    let mut bits = ((row * PROBES + probe + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits >> 63 == 1
}
