//! Small linear complementarity problems: `w = b + A z`, `w >= 0`, `z >= 0`, `w . z = 0`, A symmetric, not negative.

use nalgebra::{DMatrix, DVector};

/// A planar body has three freedoms: more than three contacts never push independently.
const MOST_INDEPENDENT: usize = 3;
/// What is negative by less than this part of the largest b is zero but for rounding.
const ZERO: f64 = 1e-11;
/// Contacts whose responses are dependent to this relative size of a pivot are not told apart.
const DEPENDENT: f64 = 1e-9;

/// A solution z. Every subset of at most three contacts is tried, the largest first: the w are the same for all
/// solutions, and so is the motion. `None` if none fits, which happens only with numbers that are not finite.
pub(crate) fn solve(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    pushing(a, b).map(|(_, z)| z)
}

/// A largest set of contacts that push independently, and the solution with their pushes.
pub(crate) fn pushing(a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(Vec<usize>, DVector<f64>)> {
    let n = b.len();
    let zero = ZERO * b.amax();
    for size in (0..=n.min(MOST_INDEPENDENT)).rev() {
        for set in subsets(n, size) {
            if let Some(z) = by_set(a, b, &set, zero) {
                return Some((set, z));
            }
        }
    }
    None
}

/// The solution in which just these contacts stand still.
fn by_set(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize], zero: f64) -> Option<DVector<f64>> {
    let still = standing(a, b, set)?;
    let w = b + a * &still;
    // A push is a velocity or acceleration over a response.
    let allowed = |i: usize| zero / a[(i, i)].max(f64::MIN_POSITIVE);
    let pushes = set.iter().all(|i| still[*i] >= -allowed(*i));
    let opens = w.iter().all(|w| *w >= -zero);
    (pushes && opens).then(|| still.map(|z| z.max(0.0)))
}

/// Pushes at these contacts, of either sign, with which they stand still; `None` if they are not independent.
pub(crate) fn standing(a: &DMatrix<f64>, b: &DVector<f64>, set: &[usize]) -> Option<DVector<f64>> {
    // Without the rounding of a square root: one contact is by far the most frequent.
    if let [only] = set {
        let mut all = DVector::zeros(b.len());
        all[*only] = -b[*only] / a[(*only, *only)];
        return (a[(*only, *only)] > 0.0).then_some(all);
    }
    let part = DMatrix::from_fn(set.len(), set.len(), |i, j| a[(set[i], set[j])]);
    let right = DVector::from_fn(set.len(), |i, _| -b[set[i]]);
    let factors = part.clone().cholesky()?;
    let is_independent = |i: usize| {
        let pivot = factors.l_dirty()[(i, i)];
        pivot * pivot > DEPENDENT * part[(i, i)]
    };
    if !(0..set.len()).all(is_independent) {
        return None;
    }
    let pushes = factors.solve(&right);
    let mut all = DVector::zeros(b.len());
    for (index, contact) in set.iter().enumerate() {
        all[*contact] = pushes[index];
    }
    Some(all)
}

/// Subsets of `0..n` of that size, in order.
fn subsets(n: usize, size: usize) -> Vec<Vec<usize>> {
    if size == 0 {
        return vec![vec![]];
    }
    let smaller = subsets(n, size - 1).into_iter();
    let grown = smaller.flat_map(|set| {
        let from = set.last().map_or(0, |last| last + 1);
        (from..n).map(move |next| [set.as_slice(), &[next]].concat())
    });
    grown.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn three_supports_in_a_line_push_by_two() {
        // Ends and middle of a rod: the third row is the mean of the others.
        let rows = [[1.0, -0.5], [1.0, 0.5], [1.0, 0.0]];
        let a = DMatrix::from_fn(3, 3, |i, j| rows[i][0] * rows[j][0] + 12.0 * rows[i][1] * rows[j][1]);
        let b = DVector::from_element(3, -9.81);
        let (set, z) = pushing(&a, &b).expect("a solution");
        assert_eq!(set.len(), 2);
        assert!((b + a * z).amax() < 1e-12);
    }

    proptest! {
        /// Random bodies with up to five contacts: every condition holds.
        #[test]
        fn the_conditions_hold(
            rows in proptest::collection::vec(proptest::array::uniform3(-1.0f64..1.0), 1..6),
            b in proptest::collection::vec(-5.0f64..5.0, 6),
        ) {
            let n = rows.len();
            let a = DMatrix::from_fn(n, n, |i, j| (0..3).map(|k| rows[i][k] * rows[j][k]).sum());
            // A motion of the body: otherwise contacts could be asked to part in ways that no body can.
            let b = DVector::from_fn(n, |i, _| (0..3).map(|k| rows[i][k] * b[k]).sum());
            let z = solve(&a, &b);
            prop_assume!(z.is_some());
            let z = z.expect("just seen");
            let w = &b + &a * &z;
            prop_assert!(z.iter().all(|z| *z >= 0.0));
            prop_assert!(w.iter().all(|w| *w >= -1e-9), "{}", w);
            prop_assert!(w.component_mul(&z).amax() < 1e-8, "{} {}", w, z);
        }
    }
}
