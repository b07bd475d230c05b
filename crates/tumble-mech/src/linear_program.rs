//! Linear programs with a known start: the simplex method on a dense table, for few unknowns.

use nalgebra::{DMatrix, DVector};

/// In columns scaled to 1, what is below this is zero but for rounding of some exchanges.
const ZERO: f64 = 1e-11;
/// Exchanges for each row and column. Bland's rule ends by itself, unless rounding goes around in circles.
const ROUNDS: usize = 50;

/// The greatest `d . x` of all `x >= 0` with `A x <= b`, where `b >= 0`; infinite where nothing bounds it.
pub(crate) fn greatest(d: &DVector<f64>, a: &DMatrix<f64>, b: &DVector<f64>) -> f64 {
    best(d, a, b).map_or(f64::INFINITY, |(greatest, _)| greatest)
}

/// The same with an x of which it is; `None` where nothing bounds it.
pub(crate) fn best(d: &DVector<f64>, a: &DMatrix<f64>, b: &DVector<f64>) -> Option<(f64, DVector<f64>)> {
    let (m, n) = a.shape();
    let mut table = DMatrix::zeros(m + 1, n + m + 1);
    let mut units = vec![1.0; n];
    for column in 0..n {
        let unit = 1.0 / a.column(column).iter().fold(f64::MIN_POSITIVE, |most, a| most.max(a.abs()));
        let unit = if unit.is_finite() { unit } else { 1.0 };
        units[column] = unit;
        (0..m).for_each(|row| table[(row, column)] = a[(row, column)] * unit);
        table[(m, column)] = -d[column] * unit;
    }
    (0..m).for_each(|row| {
        table[(row, n + row)] = 1.0;
        table[(row, n + m)] = b[row];
    });
    let worth = ZERO * table.row(m).amax();
    let mut basis: Vec<usize> = (n..n + m).collect();
    for _ in 0..ROUNDS * (n + m) {
        // Bland's rule: the first that gains, and of equals the first that leaves.
        let Some(entering) = (0..n + m).find(|column| table[(m, *column)] < -worth) else {
            let mut x = DVector::zeros(n);
            for (row, column) in basis.into_iter().enumerate().filter(|(_, column)| *column < n) {
                x[column] = table[(row, n + m)] * units[column];
            }
            return Some((table[(m, n + m)], x));
        };
        let bounding = (0..m).filter(|row| table[(*row, entering)] > ZERO);
        let limit = |row: usize| table[(row, n + m)] / table[(row, entering)];
        let first = bounding.min_by(|i, j| limit(*i).total_cmp(&limit(*j)).then(basis[*i].cmp(&basis[*j])));
        let leaving = first?;
        exchange(&mut table, leaving, entering);
        basis[leaving] = entering;
    }
    None
}

/// Makes the column that of an unknown which only this row holds.
pub(crate) fn exchange(table: &mut DMatrix<f64>, row: usize, column: usize) {
    let pivot = table.row(row) / table[(row, column)];
    for other in 0..table.nrows() {
        let part = table[(other, column)];
        if other != row && part != 0.0 {
            let changed = table.row(other) - &pivot * part;
            table.set_row(other, &changed);
        }
    }
    table.set_row(row, &pivot);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn of(d: &[f64], a: &[f64], b: &[f64]) -> f64 {
        let (a, d, b) = (
            DMatrix::from_row_slice(b.len(), d.len(), a),
            DVector::from_row_slice(d),
            DVector::from_row_slice(b),
        );
        if let Some((greatest, x)) = best(&d, &a, &b) {
            assert!((d.dot(&x) - greatest).abs() < 1e-9 * (1.0 + greatest.abs()));
            assert!(x.iter().all(|x| *x >= 0.0) && (&a * x - &b).iter().all(|over| *over < 1e-9));
        }
        greatest(&d, &a, &b)
    }

    #[test]
    fn corners() {
        assert_eq!(of(&[3.0, 5.0], &[1.0, 0.0, 0.0, 2.0, 3.0, 2.0], &[4.0, 12.0, 18.0]), 36.0);
        assert_eq!(of(&[1.0, 1.0], &[1.0, -1.0], &[1.0]), f64::INFINITY);
        assert_eq!(of(&[-1.0], &[], &[]), 0.0);
        assert_eq!(of(&[1.0], &[], &[]), f64::INFINITY);
    }

    /// Beale's example, which goes around in circles by the rule of the steepest gain.
    #[test]
    fn a_degenerate_corner_is_left() {
        let a = [0.25, -60.0, -1.0 / 25.0, 9.0, 0.5, -90.0, -1.0 / 50.0, 3.0, 0.0, 0.0, 1.0, 0.0];
        assert!((of(&[0.75, -150.0, 1.0 / 50.0, -6.0], &a, &[0.0, 0.0, 1.0]) - 0.05).abs() < 1e-15);
    }

    proptest! {
        /// In a plane: the best of all corners that two boundaries make.
        #[test]
        fn as_every_corner_tried(
            d in proptest::array::uniform2(-1.0f64..1.0),
            rows in proptest::collection::vec(proptest::array::uniform2(-1.0f64..1.0), 1..6),
            b in proptest::collection::vec(0.0f64..1.0, 6),
        ) {
            let box_of = [[1.0, 0.0, 10.0], [0.0, 1.0, 10.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
            let lines = rows.iter().zip(&b).map(|(row, b)| [row[0], row[1], *b]);
            let lines: Vec<[f64; 3]> = lines.chain(box_of).collect();
            let mut best = f64::NEG_INFINITY;
            for (i, p) in lines.iter().enumerate() {
                for q in &lines[..i] {
                    let det = p[0] * q[1] - p[1] * q[0];
                    let x = [(p[2] * q[1] - p[1] * q[2]) / det, (p[0] * q[2] - p[2] * q[0]) / det];
                    if lines.iter().all(|l| l[0] * x[0] + l[1] * x[1] <= l[2] + 1e-9) {
                        best = best.max(d[0] * x[0] + d[1] * x[1]);
                    }
                }
            }
            let inner = &lines[..lines.len() - 2];
            let a: Vec<f64> = inner.iter().flat_map(|line| [line[0], line[1]]).collect();
            let b: Vec<f64> = inner.iter().map(|line| line[2]).collect();
            prop_assert!((of(&d, &a, &b) - best).abs() < 1e-7);
        }
    }
}
