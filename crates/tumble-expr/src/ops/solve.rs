//! Unknowns of a linear system `A x = b`, of which A and b are series.
//!
//! Comparing orders, `A_0 x_k = b_k - sum over j from 1 to k of A_j x_(k-j)`: one matrix for all orders. It is factored
//! when the evaluator starts, lane by lane, so that a pivot chosen in one lane is no other's. Then each order is a
//! residual (the right side above), its elimination and the unknowns from the last to the first. Rows are exchanged for
//! the largest pivot in proportion to the row, so that the units of a row do not matter. A matrix that is singular
//! within rounding has factors that are no numbers, and so are all its unknowns.

use super::arithmetic::convolution;
use super::kernels::Kernels;
use super::{Parts, Series, Slot};
use crate::Lanewise;

/// A pivot of at most this many roundings (for each row) of what it was computed from is none: changing entries in their
/// last digits makes the matrix singular, and a solution would have no digit right.
const LOST: f64 = f64::EPSILON;

/// A matrix of a linear system.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    pub(crate) n: usize,
    /// Row by row.
    pub(crate) entries: Vec<Slot>,
    /// Where its factors begin in the evaluator's list.
    pub(crate) offset: usize,
}

impl Matrix {
    /// How many numbers its factors are at most: two squares, row by row, and one more.
    pub(crate) fn room(&self) -> usize {
        2 * self.n * self.n + 1
    }
}

/// A linear system on the tape.
#[derive(Clone, Debug)]
pub(crate) struct System {
    pub(crate) n: usize,
    pub(crate) matrix: u32,
    /// Slot of the matrix's factors.
    pub(crate) factor: Slot,
    /// By row: what changes with time.
    pub(crate) terms: Vec<Vec<Term>>,
    pub(crate) right: Vec<Slot>,
    pub(crate) residuals: Vec<Slot>,
    /// Slot of the first row after elimination; the others follow.
    pub(crate) forward: Slot,
    /// Slot of the first unknown; the others come before it.
    pub(crate) solution: Slot,
}

/// An entry that changes with time and the unknown it multiplies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    pub(crate) entry: Slot,
    pub(crate) unknown: Slot,
}

impl System {
    pub(crate) fn residual_parts(&self, row: u32) -> Parts {
        let terms = &self.terms[row as usize];
        terms.iter().map(|term| term.entry).chain([self.right[row as usize]]).collect()
    }

    /// Any row may be exchanged with any other.
    pub(crate) fn forward_parts(&self, row: u32) -> Parts {
        let before = self.forward..self.forward + row;
        self.residuals.iter().copied().chain(before).chain([self.factor]).collect()
    }

    pub(crate) fn solution_parts(&self, row: u32) -> Parts {
        let last = self.solution + 1 - self.n as Slot;
        (last..self.solution - row).chain([self.forward + row, self.factor]).collect()
    }
}

/// Order 0 of a residual.
pub(crate) fn right_side<S: Kernels>(series: &Series<'_, S>, system: u32, row: u32) -> S {
    series.first(series.tape.systems[system as usize].right[row as usize])
}

/// `b_k - sum over j from 1 to k of A_j x_(k-j)`, for one row.
pub(crate) fn residual<S: Kernels>(series: &Series<'_, S>, system: u32, row: u32, k: usize) -> S {
    let system = &series.tape.systems[system as usize];
    let taken = system.terms[row as usize].iter().fold(S::zero(), |sum, term| {
        let (a, x) = (series.of(term.entry), series.of(term.unknown));
        sum + (convolution(&x[1..k], &a[1..k]) + x[0] * a[k])
    });
    series.of(system.right[row as usize])[k] - taken
}

/// A row of the lower triangle: the row's residual less the rows before it.
pub(crate) fn forward<S: Lanewise>(series: &Series<'_, S>, system: u32, row: u32, k: usize) -> S {
    let (system, row) = (&series.tape.systems[system as usize], row as usize);
    let factors = factors_of(series, system);
    let source = factors[system.n * system.n + row];
    let residual = S::from_lanes(|lane| {
        let residual = system.residuals[source.lane(lane) as usize];
        series.of(residual)[k].lane(lane)
    });
    let before = factors[row * system.n..][..row].iter().enumerate();
    before.fold(residual, |rest, (column, factor)| {
        rest - *factor * series.of(system.forward + column as Slot)[k]
    })
}

/// A row of the upper triangle: the eliminated row less the unknowns after it, over the pivot.
pub(crate) fn solution<S: Lanewise>(series: &Series<'_, S>, system: u32, row: u32, k: usize) -> S {
    let (system, row) = (&series.tape.systems[system as usize], row as usize);
    let factors = &factors_of(series, system)[row * system.n..][..system.n];
    let eliminated = series.of(system.forward + row as Slot)[k];
    let after = factors.iter().enumerate().skip(row + 1);
    let rest = after.fold(eliminated, |rest, (column, factor)| {
        rest - *factor * series.of(system.solution - column as Slot)[k]
    });
    rest / factors[row]
}

pub(crate) fn factors_of<'a, S>(series: &Series<'a, S>, system: &System) -> &'a [S] {
    let matrix = &series.tape.matrices[system.matrix as usize];
    &series.factors[matrix.offset..][..matrix.room()]
}

/// Factors of a matrix at order 0.
pub(crate) fn factors<S: Lanewise>(series: &Series<'_, S>, matrix: u32) -> Vec<S> {
    let matrix = &series.tape.matrices[matrix as usize];
    let lane = |lane| {
        let entries = matrix.entries.iter().map(|entry| series.first(*entry).lane(lane));
        Elimination::new(matrix.n, entries.collect()).run()
    };
    let lanes: Vec<Vec<f64>> = (0..S::LANES).map(lane).collect();
    // Both triangles in one square, then the order of the rows.
    (0..matrix.n * matrix.n + matrix.n).map(|index| S::from_lanes(|lane| lanes[lane][index])).collect()
}

/// The inverse of a matrix of numbers, row by row; no numbers where it is singular within rounding.
pub(crate) fn inverse(n: usize, entries: Vec<f64>) -> Vec<f64> {
    let factors = Elimination::new(n, entries).run();
    let mut inverse = vec![0.0; n * n];
    for column in 0..n {
        let mut x: Vec<f64> =
            (0..n).map(|row| f64::from(u8::from(factors[n * n + row] as usize == column))).collect();
        for row in 0..n {
            x[row] = (0..row).fold(x[row], |rest, other| rest - factors[row * n + other] * x[other]);
        }
        for row in (0..n).rev() {
            let rest = (row + 1..n).fold(x[row], |rest, other| rest - factors[row * n + other] * x[other]);
            x[row] = rest / factors[row * n + row];
        }
        (0..n).for_each(|row| inverse[row * n + column] = x[row]);
    }
    inverse
}

/// A matrix on its way to its factors.
struct Elimination {
    n: usize,
    rows: Vec<Row>,
}

struct Row {
    /// Which row of the matrix this was.
    source: usize,
    /// Largest entry.
    scale: f64,
    entries: Vec<f64>,
    /// Sizes of what each entry was computed from: its rounding error is some ulps of them.
    sizes: Vec<f64>,
}

impl Elimination {
    fn new(n: usize, entries: Vec<f64>) -> Self {
        let row = |(source, entries): (usize, &[f64])| {
            let sizes: Vec<f64> = entries.iter().map(|entry| entry.abs()).collect();
            let scale = sizes.iter().fold(0.0, |largest: f64, size| largest.max(*size));
            Row { source, scale, entries: entries.to_vec(), sizes }
        };
        Self { n, rows: entries.chunks(n).enumerate().map(row).collect() }
    }

    fn run(mut self) -> Vec<f64> {
        for column in 0..self.n {
            let pivot = self.pivot(column);
            self.rows.swap(column, pivot);
            self.refuse_lost(column);
            self.eliminate(column);
        }
        let order = self.rows.iter().map(|row| row.source as f64);
        self.rows.iter().flat_map(|row| row.entries.iter().copied()).chain(order).collect()
    }

    /// The row with the largest pivot for its scale, the first of equals. (Comparisons with NaN fail: it is found later.)
    fn pivot(&self, column: usize) -> usize {
        let weight = |row: usize| self.rows[row].entries[column].abs() / self.rows[row].scale;
        (column + 1..self.n).fold(column, |best, row| if weight(row) > weight(best) { row } else { best })
    }

    fn refuse_lost(&mut self, column: usize) {
        let lost = self.n as f64 * LOST;
        let row = &mut self.rows[column];
        let (pivot, size) = (&mut row.entries[column], row.sizes[column]);
        // Infinite and undefined pivots fail the comparison too.
        let kept = pivot.abs() > lost * size;
        if !kept {
            *pivot = f64::NAN;
        }
    }

    fn eliminate(&mut self, column: usize) {
        let (above, below) = self.rows.split_at_mut(column + 1);
        let pivot = &above[column];
        for row in below {
            let factor = row.entries[column] / pivot.entries[column];
            row.entries[column] = factor;
            for other in column + 1..self.n {
                row.entries[other] -= factor * pivot.entries[other];
                row.sizes[other] += factor.abs() * pivot.sizes[other];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest entry of `L U - P A`, in ulps of |L| |U|.
    fn defect(n: usize, entries: &[f64]) -> f64 {
        let factors = Elimination::new(n, entries.to_vec()).run();
        let lower = |i: usize, m: usize| if i == m { 1.0 } else { factors[i * n + m] };
        let mut worst: f64 = 0.0;
        for (i, j) in (0..n * n).map(|index| (index / n, index % n)) {
            let source = factors[n * n + i] as usize;
            let terms = (0..=i.min(j)).map(|m| lower(i, m) * factors[m * n + j]);
            let (sum, size) =
                terms.fold((0.0, 0.0), |(sum, size): (f64, f64), term| (sum + term, size + term.abs()));
            worst = worst.max((sum - entries[source * n + j]).abs() / (size * f64::EPSILON));
        }
        worst
    }

    #[test]
    fn factors_multiply_to_the_matrix() {
        for n in 1..8 {
            let hilbert: Vec<f64> =
                (0..n * n).map(|index| 1.0 / (1 + index / n + index % n) as f64).collect();
            let mixed: Vec<f64> = (0..n * n).map(|index| libm::sin((index * index + 1) as f64)).collect();
            assert!(defect(n, &hilbert) <= n as f64, "{}", defect(n, &hilbert));
            assert!(defect(n, &mixed) <= n as f64, "{}", defect(n, &mixed));
        }
    }

    #[test]
    fn the_units_of_a_row_do_not_choose_the_pivot() {
        let order =
            |scale: f64| Elimination::new(2, vec![1.0 * scale, 1e9 * scale, 1.0, 1.0]).run()[4..].to_vec();
        assert_eq!(order(1.0), order(1e6));
        assert_eq!(order(1.0), [1.0, 0.0]);
    }

    #[test]
    fn rounding_is_told_from_a_small_pivot() {
        let lost = |entries: [f64; 4]| Elimination::new(2, entries.to_vec()).run()[3].is_nan();
        assert!(lost([0.1, 0.3, 0.3, 0.9]));
        assert!(!lost([0.1, 0.3, 0.3, 0.9 * (1.0 + 1e-14)]));
        assert!(!lost([1.0, 0.0, 0.0, 1e-300]));
    }
}
