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

use nalgebra::{DMatrix, DVector};

/// Singular values below this part of the largest are zero: rows that depend on each other share what they do.
const SINGULAR: f64 = 1e-12;

/// Changes of velocities and impulses of the rows, a column for each column of `impulses` and `rates`.
///
/// Where rows depend on each other their impulses are the least ones; `None` with numbers that are not finite.
pub(crate) fn respond(
    mass: &DVector<f64>,
    rows: &DMatrix<f64>,
    impulses: &DMatrix<f64>,
    rates: &DMatrix<f64>,
) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let (n, m) = (mass.len(), rows.nrows());
    // Unknowns in units that make every entry a pure number of the size of one.
    let root = mass.map(|mass| if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 0.0 });
    let unit = DVector::from_fn(n, |i, _| match root[i] > 0.0 {
        true => root[i],
        false => 1.0 / rows.column(i).amax().max(f64::MIN_POSITIVE) * least(&root, rows, i),
    });
    let scaled = rows * DMatrix::from_diagonal(&unit);
    let size = DVector::from_fn(m, |row, _| 1.0 / scaled.row(row).norm().max(f64::MIN_POSITIVE));
    let scaled = DMatrix::from_diagonal(&size) * scaled;
    let mut matrix = DMatrix::zeros(n + m, n + m);
    (0..n).for_each(|i| matrix[(i, i)] = mass[i] * unit[i] * unit[i]);
    matrix.view_mut((n, 0), (m, n)).copy_from(&scaled);
    matrix.view_mut((0, n), (n, m)).copy_from(&-scaled.transpose());
    let mut right = DMatrix::zeros(n + m, impulses.ncols());
    right.rows_mut(0, n).copy_from(&(DMatrix::from_diagonal(&unit) * impulses));
    right.rows_mut(n, m).copy_from(&(DMatrix::from_diagonal(&size) * rates));
    if matrix.iter().chain(right.iter()).any(|value| !value.is_finite()) {
        return None;
    }
    let solution = solved(matrix, &right)?;
    let changes = DMatrix::from_diagonal(&unit) * solution.rows(0, n);
    let shares = DMatrix::from_diagonal(&size) * solution.rows(n, m);
    Some((changes, shares))
}

/// The unit of a rate that has no mass, beside those that have one in the same rows: of them the largest part.
fn least(root: &DVector<f64>, rows: &DMatrix<f64>, column: usize) -> f64 {
    let shared = rows.row_iter().filter(|row| row[column] != 0.0);
    let parts = shared
        .flat_map(|row| row.iter().zip(root).map(|(slope, root)| slope.abs() * root).collect::<Vec<_>>());
    let largest = parts.fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

fn solved(matrix: DMatrix<f64>, right: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let factors = matrix.clone().full_piv_lu();
    let pivots = factors.u();
    let largest = pivots[(0, 0)].abs();
    let is_regular = (0..pivots.nrows()).all(|i| pivots[(i, i)].abs() > SINGULAR * largest);
    if is_regular { factors.solve(right) } else { least_solution(matrix, right, SINGULAR) }
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

    /// A point of 2 kg on a massless rod that is held 1 m above it: pushed across it moves as if free, along it not at all.
    #[test]
    fn a_massless_rod_turns_with_its_point() {
        let mass = DVector::from_row_slice(&[2.0, 2.0, 0.0]);
        let rows = DMatrix::from_row_slice(2, 3, &[1.0, 0.0, -1.0, 0.0, 1.0, 0.0]);
        let push = DMatrix::from_column_slice(3, 2, &[4.0, 0.0, 0.0, 0.0, 4.0, 0.0]);
        let (changes, shares) = respond(&mass, &rows, &push, &DMatrix::zeros(2, 2)).expect("finite");
        let expected = DMatrix::from_column_slice(3, 2, &[2.0, 0.0, 2.0, 0.0, 0.0, 0.0]);
        assert!((changes - expected).amax() < 1e-15);
        assert!((shares - DMatrix::from_column_slice(2, 2, &[0.0, 0.0, 0.0, -4.0])).amax() < 1e-15);
    }

    /// The same row twice: each bears half.
    #[test]
    fn what_holds_twice_shares_the_impulse() {
        let (mass, rows) = (DVector::from_element(1, 3.0), DMatrix::from_element(2, 1, 1.0));
        let (changes, shares) =
            respond(&mass, &rows, &DMatrix::from_element(1, 1, 6.0), &DMatrix::zeros(2, 1)).expect("finite");
        assert!(changes.amax() < 1e-15 && (shares.add_scalar(3.0)).amax() < 1e-14);
    }
}
