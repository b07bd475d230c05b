//! Velocities under impulses while rows hold.
//!
//! With M the masses, B the gradients of the rows' rates, J impulses and b wanted changes of those rates, the changes v of the
//! velocities and the impulses Q of the rows solve
//!
//! ```text
//! M v - B^T Q = J
//! B v         = b
//! ```
//!
//! which stands also where a body has no moment of inertia and only its joints say how it turns.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use tumble_expr::SparseSystem;

/// Singular values, and pivots, below this part of the largest are zero: rows that depend on each other share what they do.
const SINGULAR: f64 = 1e-12;

/// The least of some numbers stands out after so many, to a few parts in a hundred.
const INVERSE_ITERATIONS: usize = 8;

/// Gradients of rows by velocities: each has few, those of its own bodies.
#[derive(Clone, Debug, Default)]
pub(crate) struct Gradients {
    /// By row, slopes with their velocities, in order.
    pub(crate) rows: Vec<Vec<(usize, f64)>>,
    /// How many velocities there are.
    pub(crate) columns: usize,
}

impl Gradients {
    /// As a matrix.
    pub(crate) fn dense(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.rows.len(), self.columns);
        for (row, slopes) in self.rows.iter().enumerate() {
            slopes.iter().for_each(|(column, slope)| matrix[(row, *column)] = *slope);
        }
        matrix
    }

    /// About the least length of a sum of the rows, each of length one, with parts whose squares add up to one: no row is nearer to
    /// being a sum of the others. 0 where they depend on each other within rounding.
    pub(crate) fn independence(&self) -> f64 {
        let columns = self.by_column();
        let norms: Vec<f64> = self
            .rows
            .iter()
            .map(|row| row.iter().map(|(_, slope)| slope * slope).sum::<f64>().sqrt())
            .collect();
        let (mut pattern, mut entries) = (vec![], vec![]);
        for (row, norm) in self.rows.iter().zip(&norms) {
            let mut own: BTreeMap<usize, f64> = BTreeMap::new();
            for (column, slope) in row {
                for (other, other_slope) in &columns[*column] {
                    *own.entry(*other).or_default() += slope * other_slope / (norm * norms[*other]);
                }
            }
            pattern.push(own.keys().map(|other| *other as u32).collect());
            entries.extend(own.into_values());
        }
        let mut products = SparseSystem::new(pattern);
        if products.factor(&entries) == 0.0 {
            return 0.0;
        }
        // Inverse iteration, from parts of which none stands out.
        let mut parts: Vec<f64> = (0..norms.len()).map(|row| libm::sin((row + 1) as f64)).collect();
        let mut grown = vec![0.0; parts.len()];
        let mut least = f64::INFINITY;
        for _ in 0..INVERSE_ITERATIONS {
            let norm = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
            parts.iter_mut().for_each(|part| *part /= norm);
            products.solve(&parts, &mut grown);
            least = 1.0 / grown.iter().map(|part| part * part).sum::<f64>().sqrt();
            std::mem::swap(&mut parts, &mut grown);
        }
        least.sqrt()
    }

    /// By velocity, slopes with their rows.
    pub(crate) fn by_column(&self) -> Vec<Vec<(usize, f64)>> {
        let mut columns = vec![vec![]; self.columns];
        for (row, slopes) in self.rows.iter().enumerate() {
            slopes.iter().for_each(|(column, slope)| columns[*column].push((row, *slope)));
        }
        columns
    }
}

/// Changes of velocities and impulses of the rows, a column for each column of `impulses` and `rates`.
///
/// Where rows depend on each other their impulses are the least ones; `None` with numbers that are not finite.
pub(crate) fn respond(
    mass: &DVector<f64>,
    rows: &Gradients,
    impulses: &DMatrix<f64>,
    rates: &DMatrix<f64>,
) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let (n, m) = (mass.len(), rows.rows.len());
    // Unknowns in units that make every entry a pure number of the size of one.
    let unit = units(mass, rows);
    let norm =
        |row: &Vec<(usize, f64)>| row.iter().map(|(i, slope)| (slope * unit[*i]).powi(2)).sum::<f64>().sqrt();
    let size = DVector::from_iterator(m, rows.rows.iter().map(|row| 1.0 / norm(row).max(f64::MIN_POSITIVE)));
    let slope = |row: usize, column: usize, slope: f64| slope * unit[column] * size[row];
    let of_velocity = |(column, slopes): (usize, Vec<(usize, f64)>)| {
        let own = (mass[column] > 0.0).then(|| (column, mass[column] * unit[column] * unit[column]));
        let impulses = slopes.into_iter().map(|(row, own)| (n + row, -slope(row, column, own)));
        own.into_iter().chain(impulses).collect()
    };
    let of_row = |(row, slopes): (usize, &Vec<(usize, f64)>)| {
        slopes.iter().map(|(column, own)| (*column, slope(row, *column, *own))).collect()
    };
    let velocities = rows.by_column().into_iter().enumerate().map(of_velocity);
    let matrix = Gradients {
        rows: velocities.chain(rows.rows.iter().enumerate().map(of_row)).collect(),
        columns: n + m,
    };
    let mut right = DMatrix::zeros(n + m, impulses.ncols());
    right.rows_mut(0, n).copy_from(&(DMatrix::from_diagonal(&unit) * impulses));
    right.rows_mut(n, m).copy_from(&(DMatrix::from_diagonal(&size) * rates));
    let entries = matrix.rows.iter().flatten().map(|(_, entry)| entry);
    if entries.chain(right.iter()).any(|value| !value.is_finite()) {
        return None;
    }
    let solution = solved(&matrix, &right)?;
    let changes = DMatrix::from_diagonal(&unit) * solution.rows(0, n);
    let shares = DMatrix::from_diagonal(&size) * solution.rows(n, m);
    Some((changes, shares))
}

/// Of each velocity, that in which its mass is one. Of one without mass, that of the largest part of those that have one in
/// the same rows.
fn units(mass: &DVector<f64>, rows: &Gradients) -> DVector<f64> {
    let root = |column: usize| if mass[column] > 0.0 { 1.0 / libm::sqrt(mass[column]) } else { 0.0 };
    let columns = rows.by_column();
    DVector::from_fn(mass.len(), |i, _| match root(i) {
        0.0 => {
            let shared = columns[i].iter().flat_map(|(row, _)| &rows.rows[*row]);
            let largest = shared.map(|(column, slope)| slope.abs() * root(*column)).fold(0.0, f64::max);
            let own = columns[i].iter().map(|(_, slope)| slope.abs()).fold(f64::MIN_POSITIVE, f64::max);
            if largest > 0.0 { largest / own } else { 1.0 / own }
        }
        root => root,
    })
}

fn solved(matrix: &Gradients, right: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let columns = |row: &Vec<(usize, f64)>| row.iter().map(|(column, _)| *column as u32).collect();
    let mut system = SparseSystem::new(matrix.rows.iter().map(columns).collect());
    let entries: Vec<f64> = matrix.rows.iter().flatten().map(|(_, entry)| *entry).collect();
    if system.factor(&entries) <= SINGULAR {
        return least_solution(matrix.dense(), right, SINGULAR);
    }
    let mut solution = right.clone();
    for (right, mut x) in right.column_iter().zip(solution.column_iter_mut()) {
        system.solve(right.as_slice(), x.as_mut_slice());
    }
    Some(solution)
}

/// The least solution of equations that may depend on each other, or contradict each other a little; singular values below that part
/// of the largest are zero.
pub(crate) fn least_solution(
    matrix: DMatrix<f64>,
    right: &DMatrix<f64>,
    singular: f64,
) -> Option<DMatrix<f64>> {
    let parts = matrix.svd(true, true);
    let least = singular * parts.singular_values.max();
    parts.solve(right, least).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gradients(matrix: &DMatrix<f64>) -> Gradients {
        let row = |row: usize| {
            matrix.row(row).iter().copied().enumerate().filter(|(_, slope)| *slope != 0.0).collect()
        };
        Gradients { rows: (0..matrix.nrows()).map(row).collect(), columns: matrix.ncols() }
    }

    /// A point of 2 kg on a massless rod that is held 1 m above it: pushed across it moves as if free, along it not at all.
    #[test]
    fn a_massless_rod_turns_with_its_point() {
        let mass = DVector::from_row_slice(&[2.0, 2.0, 0.0]);
        let rows = DMatrix::from_row_slice(2, 3, &[1.0, 0.0, -1.0, 0.0, 1.0, 0.0]);
        let push = DMatrix::from_column_slice(3, 2, &[4.0, 0.0, 0.0, 0.0, 4.0, 0.0]);
        let (changes, shares) =
            respond(&mass, &gradients(&rows), &push, &DMatrix::zeros(2, 2)).expect("finite");
        let expected = DMatrix::from_column_slice(3, 2, &[2.0, 0.0, 2.0, 0.0, 0.0, 0.0]);
        assert!((changes - expected).amax() < 1e-15);
        assert!((shares - DMatrix::from_column_slice(2, 2, &[0.0, 0.0, 0.0, -4.0])).amax() < 1e-15);
    }

    /// The same row twice: each bears half.
    #[test]
    fn what_holds_twice_shares_the_impulse() {
        let (mass, rows) = (DVector::from_element(1, 3.0), DMatrix::from_element(2, 1, 1.0));
        let (changes, shares) =
            respond(&mass, &gradients(&rows), &DMatrix::from_element(1, 1, 6.0), &DMatrix::zeros(2, 1))
                .expect("finite");
        assert!(changes.amax() < 1e-15 && (shares.add_scalar(3.0)).amax() < 1e-14);
    }
}
