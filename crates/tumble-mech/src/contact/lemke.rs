//! Linear complementarity problems of any matrix: `w = q + M z`, `w >= 0`, `z >= 0`, `w . z = 0`, by complementary pivoting.
//!
//! A pull z0 on all rows at once makes `w = q + z0` allowed; then one pair after the other is exchanged until z0 is zero (Lemke 1965). Of
//! rows that bound a step alike the lexicographically least leaves, so no basis comes twice. Where M is copositive, as it is of contacts with
//! friction in the plane, it ends with a solution if bodies can be stopped at all (Cottle and Dantzig 1968, Stewart and Trinkle 1996).

use std::cmp::Ordering;

use nalgebra::{DMatrix, DVector};

use crate::linear_program::exchange;

/// In rows scaled to 1, what is below this is zero but for rounding of some exchanges.
const ZERO: f64 = 1e-11;
/// Exchanges for each row, before rounding is taken to go around in circles.
const ROUNDS: usize = 50;

/// A solution z; `None` if pivoting comes to none.
pub(crate) fn solve(m: &DMatrix<f64>, q: &DVector<f64>) -> Option<DVector<f64>> {
    let largest = q.amax().max(f64::MIN_POSITIVE);
    let unit = |i: usize| if m[(i, i)] > 0.0 { 1.0 / libm::sqrt(m[(i, i)]) } else { 1.0 };
    let units = DVector::from_fn(q.len(), |i, _| unit(i));
    let scaled = DMatrix::from_fn(q.len(), q.len(), |i, j| units[i] * m[(i, j)] * units[j]);
    let z = pivoted(&scaled, &(q.component_mul(&units) / largest))?;
    Some(z.component_mul(&units) * largest)
}

fn pivoted(m: &DMatrix<f64>, q: &DVector<f64>) -> Option<DVector<f64>> {
    let n = q.len();
    if q.iter().all(|q| *q >= 0.0) {
        return Some(DVector::zeros(n));
    }
    let mut table = Table::new(m, q);
    let mut row = table.first();
    let mut entering = table.pull();
    for _ in 0..ROUNDS * n {
        let leaving = table.exchange(row, entering);
        if leaving == table.pull() {
            return Some(table.solution());
        }
        entering = table.other_of(leaving);
        row = table.bounding(entering)?;
    }
    None
}

/// Rows `w - M z - z0 = q` in terms of a basis. Columns: w, z, z0, and the right side.
struct Table {
    rows: DMatrix<f64>,
    basis: Vec<usize>,
}

impl Table {
    fn new(m: &DMatrix<f64>, q: &DVector<f64>) -> Self {
        let n = q.len();
        let rows = DMatrix::from_fn(n, 2 * n + 2, |i, j| match j {
            w if w < n => f64::from(u8::from(i == w)),
            z if z < 2 * n => -m[(i, z - n)],
            z0 if z0 == 2 * n => -1.0,
            _ => q[i],
        });
        Self { rows, basis: (0..n).collect() }
    }

    fn size(&self) -> usize {
        self.basis.len()
    }

    /// Column of z0.
    fn pull(&self) -> usize {
        2 * self.size()
    }

    fn other_of(&self, column: usize) -> usize {
        let n = self.size();
        if column < n { column + n } else { column - n }
    }

    /// The row that asks for the strongest pull.
    fn first(&self) -> usize {
        let least = (0..self.size()).min_by(|i, j| self.compare((*i, 1.0), (*j, 1.0)));
        least.unwrap_or_default()
    }

    /// The row that bounds what a column may grow by; `None` where nothing does. z0 leaves where it may.
    fn bounding(&self, column: usize) -> Option<usize> {
        let bounding = (0..self.size()).filter(|row| self.rows[(*row, column)] > ZERO);
        let part = |row: usize| (row, self.rows[(row, column)]);
        let least = bounding.min_by(|i, j| self.compare(part(*i), part(*j)))?;
        let right = self.pull() + 1;
        let limit = |row: usize| self.rows[(row, right)] / self.rows[(row, column)];
        let pull = self.basis.iter().position(|own| *own == self.pull());
        let ends = |row: &usize| {
            self.rows[(*row, column)] > ZERO && limit(*row) <= limit(least) + ZERO * limit(least).abs()
        };
        Some(pull.filter(ends).unwrap_or(least))
    }

    /// Two rows in parts of these numbers: by the right side, and where that is the same by the columns of w.
    fn compare(&self, (i, a): (usize, f64), (j, b): (usize, f64)) -> Ordering {
        let columns = [self.pull() + 1].into_iter().chain(0..self.size());
        let differ = |column: usize| {
            let (one, other) = (self.rows[(i, column)] / a, self.rows[(j, column)] / b);
            let same = (one - other).abs() <= ZERO * (one.abs() + other.abs());
            (!same).then(|| one.total_cmp(&other))
        };
        columns.filter_map(differ).next().unwrap_or(Ordering::Equal)
    }

    /// Brings a column into the basis in place of that of a row, which is given back.
    fn exchange(&mut self, row: usize, column: usize) -> usize {
        exchange(&mut self.rows, row, column);
        std::mem::replace(&mut self.basis[row], column)
    }

    fn solution(&self) -> DVector<f64> {
        let (n, right) = (self.size(), self.pull() + 1);
        let mut z = DVector::zeros(n);
        for (row, column) in self.basis.iter().enumerate().filter(|(_, column)| (n..2 * n).contains(*column))
        {
            z[column - n] = self.rows[(row, right)].max(0.0);
        }
        z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_nothing_asks_for_is_nothing() {
        let z = solve(&DMatrix::identity(2, 2), &DVector::from_element(2, 1.0));
        assert_eq!(z, Some(DVector::zeros(2)));
    }

    #[test]
    fn where_nothing_helps_there_is_none() {
        let m = DMatrix::from_row_slice(2, 2, &[1.0, -1.0, -1.0, 1.0]);
        assert_eq!(solve(&m, &DVector::from_element(2, -1.0)), None);
    }

    proptest! {
        /// Matrices that are a sum of a positive and a skew one: neither symmetric nor diagonally dominant.
        #[test]
        fn the_conditions_hold(
            n in 1_usize..12,
            parts in proptest::collection::vec(-1.0f64..1.0, 144),
            skew in proptest::collection::vec(-1.0f64..1.0, 144),
            q in proptest::collection::vec(-5.0f64..5.0, 12),
        ) {
            let root = DMatrix::from_fn(n, n, |i, j| parts[12 * i + j]);
            let turned = DMatrix::from_fn(n, n, |i, j| skew[12 * i + j] - skew[12 * j + i]);
            let m = &root * root.transpose() + turned + 0.01 * DMatrix::identity(n, n);
            let q = DVector::from_row_slice(&q[..n]);
            let z = solve(&m, &q).expect("a solution");
            let w = &q + &m * &z;
            let size = 1.0 + (m.abs() * &z).amax();
            prop_assert!(z.iter().all(|z| *z >= 0.0));
            prop_assert!(w.iter().all(|w| *w >= -1e-8 * size), "{w}");
            prop_assert!((0..n).all(|i| z[i] * w[i].abs() <= 1e-8 * size * size), "{z} {w}");
        }
    }
}
