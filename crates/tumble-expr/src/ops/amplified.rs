//! What errors of the right sides, and of the matrix, make of the unknowns of a linear system: `|A^-1| w`, w by row.
//!
//! A small matrix has this row by row, from the columns of its inverse C. A large one is L U with the factors of its elimination, and
//! entry by entry `|U^-1| <= M(U)^-1`, with M what has the sizes of the diagonal and of all else less than nothing; so is it for L. Two
//! substitutions then bound `|A^-1| w`. Where only what rounding errors add up to that know nothing of each other is asked for, it is read off
//! unknowns whose right sides are random, `s w`: over signs s, the mean of the squares of an unknown is the sum of `(C_ij w_j)^2`.
//!
//! Sources: Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, 8.2, for the comparison; Hutchinson, Commun. Stat.
//! Simul. Comput. 19 (1990), for the signs.

use super::elimination::Plan;

/// Of a matrix of up to so many rows the columns of the inverse are found.
const SMALL: usize = 16;
/// Of a larger one, unknowns for so many right sides: a mean of so many squares is less than what it stands for by
const PROBES: usize = 16;
/// so much less than once in a thousand times.
const SAFE: f64 = 4.0;
/// Rounding of a bound, which is a sum without signs of so many parts at most.
const ROUNDED: f64 = 1.0 + 1e-9;
/// How often an error bound is put into itself until it is large enough.
const REPEATS: usize = 12;
/// So much wider than what is put in a bound has to be to hold.
const WIDER: f64 = 1.1;

/// Whether bounds for so many unknowns are exact but for rounding.
pub(crate) fn is_small(n: usize) -> bool {
    n <= SMALL
}

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
        if is_small(errors.len()) {
            return self.exact(errors);
        }
        let squares = self.mean_squares(errors);
        squares.into_iter().map(|square| SAFE * square.sqrt()).collect()
    }

    /// A bound of them whatever the signs of the errors.
    pub(crate) fn most(&self, errors: &[f64]) -> Vec<f64> {
        if is_small(errors.len()) {
            return self.exact(errors);
        }
        let compared = self.plan.compared(self.factors);
        let sizes = Amplifier { plan: self.plan, factors: &compared };
        sizes.solve(errors.to_vec()).into_iter().map(|size| ROUNDED * size).collect()
    }

    /// The columns of the inverse, each times its number.
    pub(crate) fn columns(&self, by: &[f64]) -> impl Iterator<Item = Vec<f64>> {
        (0..by.len()).map(|column| {
            let own = |row: usize| if row == column { by[row] } else { 0.0 };
            self.solve((0..by.len()).map(own).collect())
        })
    }

    fn exact(&self, errors: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; errors.len()];
        for x in self.columns(errors) {
            sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x.abs());
        }
        sums
    }

    /// Means of the squares of the unknowns whose right sides are the errors with random signs.
    fn mean_squares(&self, errors: &[f64]) -> Vec<f64> {
        let sign = |bits: u64| if bits >> 63 == 1 { -1.0 } else { 1.0 };
        let mut sums = vec![0.0; errors.len()];
        for probe in 0..PROBES {
            let drawn = |(row, error): (usize, &f64)| error * sign(bits(row * PROBES + probe));
            let x = self.solve(errors.iter().enumerate().map(drawn).collect());
            sums.iter_mut().zip(x).for_each(|(sum, x)| *sum += x * x / PROBES as f64);
        }
        sums
    }

    /// Some d with `|A^-1| (first + change(d)) <= d`, entry by entry, of a matrix whose errors change what the rows give by `change`.
    pub(crate) fn enclosed(&self, first: &[f64], change: impl Fn(&[f64]) -> Vec<f64>) -> Option<Vec<f64>> {
        widened(&self.most(first), |bounds| self.most(&change(bounds)))
    }
}

/// Some d with `own + more(d) <= d`, entry by entry.
pub(crate) fn widened(own: &[f64], more: impl Fn(&[f64]) -> Vec<f64>) -> Option<Vec<f64>> {
    let again =
        |bounds: &[f64]| -> Vec<f64> { own.iter().zip(more(bounds)).map(|(own, more)| own + more).collect() };
    let mut next = again(own);
    for _ in 0..REPEATS {
        let bounds: Vec<f64> = next.iter().map(|bound| WIDER * bound).collect();
        let after = again(&bounds);
        if after.iter().zip(&bounds).all(|(after, bound)| after <= bound) {
            return Some(bounds);
        }
        next = after;
    }
    None
}

/// Mixed bits of a counter (Steele, Lea and Flood, OOPSLA 2014): the same in every run.
pub(crate) fn bits(counter: usize) -> u64 {
    let mut bits = (counter as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ops::elimination::Workspace;

    /// Of a matrix with diagonals 3, -1, -1, beside the columns of its inverse one by one.
    #[test]
    fn large_matrices_have_bounds_that_hold_and_are_not_far_off() {
        let n = 200;
        let row = |i: usize| (i.saturating_sub(1)..n.min(i + 2)).map(|j| j as u32).collect::<Vec<_>>();
        let entries: Vec<f64> = (0..n)
            .flat_map(|i| row(i).into_iter().map(move |j| if i == j as usize { 3.0 } else { -1.0 }))
            .collect();
        let plan = Plan::new(&(0..n).map(row).collect::<Vec<_>>());
        let mut factors = vec![0.0; plan.room];
        plan.factor(|entry| entries[entry], &mut Workspace::default(), &mut factors);
        let inverse = Amplifier { plan: &plan, factors: &factors };
        let errors: Vec<f64> = (0..n).map(|row| 1.0 + libm::sin(row as f64)).collect();
        let exact = inverse.exact(&errors);
        let square = |row: usize| {
            let unit = |other: usize| if other == row { errors[row] } else { 0.0 };
            inverse.solve((0..n).map(unit).collect()).iter().map(|x| x * x).collect::<Vec<_>>()
        };
        let mut squares = vec![0.0; n];
        (0..n).for_each(|row| squares.iter_mut().zip(square(row)).for_each(|(sum, x)| *sum += x));
        let roots: Vec<f64> = squares.into_iter().map(f64::sqrt).collect();
        for (found, known) in [(inverse.most(&errors), exact), (inverse.likely(&errors), roots)] {
            for (row, (found, known)) in found.iter().zip(&known).enumerate() {
                assert!((1.0..16.0).contains(&(found / known)), "{row}: {found} {known}");
            }
        }
    }
}
