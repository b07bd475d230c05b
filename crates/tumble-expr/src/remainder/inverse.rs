//! Bounds of the errors of a small system's unknowns by the series of its inverse.
//!
//! With C the series of the inverse of A along the step, `C A = I - E`, where E is what the product has beyond the order, and rounding. It is
//! small though A changes by much more than its inverse at any one place bears, as that of a light body between heavy ones does: its inverse is
//! as large as the heavy masses, while its entries change by what levers do to the light one. From `A e = r` follows `e = C r + E e`, so any d with
//!
//! ```text
//! |C| |r| + |E| d <= d
//! ```
//!
//! entry by entry bounds `|e|`. Source: Rump, Verification methods, Acta Numerica 19 (2010), section 10, with series in the place of numbers.

use crate::ops::amplified::widened;

/// An inverse that changes by more than this part of itself is that of a system on its way to where it has none: steps become short there.
const STEADY: f64 = 0.5;

/// The series of an inverse, and how far it is from one.
pub(super) struct Inverse {
    n: usize,
    /// Sums of the sizes of its coefficients, row by row.
    sizes: Vec<f64>,
    /// |E|
    left_over: Vec<f64>,
}

impl Inverse {
    /// Of a matrix by order, row by row, each times a power of the step's length, with how far its entries are from their series, and of the
    /// inverse at the start; none of one that is not steady.
    pub(super) fn of(matrix: &[Vec<f64>], rests: &[f64], first: Vec<f64>) -> Option<Self> {
        let (orders, n) = (matrix.len(), rests.len().isqrt());
        let changes: Vec<usize> = (1..orders).filter(|k| matrix[*k].iter().any(|c| *c != 0.0)).collect();
        let mut inverse = vec![first];
        for k in 1..orders {
            let mut sum = vec![0.0; n * n];
            changes.iter().filter(|j| **j <= k).for_each(|j| add(&mut sum, &inverse[k - j], &matrix[*j], n));
            let mut own = vec![0.0; n * n];
            add(&mut own, &sum, &inverse[0], n);
            own.iter_mut().for_each(|c| *c = -*c);
            inverse.push(own);
        }
        if !is_steady(&inverse, n) {
            return None;
        }
        let [sizes, of_matrix] = [&inverse[..], matrix].map(sizes);
        let mut left_over = vec![0.0; n * n];
        // Each sum has so many products, and each coefficient of the inverse was such a sum.
        let rounding = 2.0 * (orders * n) as f64 * f64::EPSILON;
        let off: Vec<f64> = rests.iter().zip(&of_matrix).map(|(rest, size)| rest + rounding * size).collect();
        add(&mut left_over, &sizes, &off, n);
        for k in 0..2 * orders - 1 {
            let mut product = vec![0.0; n * n];
            if k == 0 {
                (0..n).for_each(|i| product[i * n + i] = -1.0);
            }
            let factors = std::iter::once(0).chain(changes.iter().copied());
            let factors = factors.filter(|j| *j <= k && k - j < orders);
            factors.for_each(|j| add(&mut product, &inverse[k - j], &matrix[j], n));
            left_over.iter_mut().zip(product).for_each(|(sum, c)| *sum += c.abs());
        }
        Some(Self { n, sizes, left_over })
    }

    /// Bounds of the unknowns' errors by what is left over of each row; `None` where there are none.
    pub(super) fn bounds(&self, left: &[f64]) -> Option<Vec<f64>> {
        widened(&self.times(&self.sizes, left), |bounds| self.times(&self.left_over, bounds))
    }

    fn times(&self, matrix: &[f64], by: &[f64]) -> Vec<f64> {
        matrix.chunks(self.n).map(|row| row.iter().zip(by).map(|(a, b)| a * b).sum()).collect()
    }
}

/// Adds the product of two matrices.
fn add(sum: &mut [f64], a: &[f64], b: &[f64], n: usize) {
    for (row, sums) in sum.chunks_mut(n).enumerate() {
        for (inner, factor) in a[row * n..][..n].iter().enumerate() {
            sums.iter_mut().zip(&b[inner * n..][..n]).for_each(|(sum, b)| *sum += factor * b);
        }
    }
}

/// Whether no row of a series changes by much of itself.
fn is_steady(series: &[Vec<f64>], n: usize) -> bool {
    let sums =
        |part: &[Vec<f64>]| -> Vec<f64> { sizes(part).chunks(n).map(|row| row.iter().sum()).collect() };
    sums(&series[1..]).iter().zip(sums(&series[..1])).all(|(change, own)| *change <= STEADY * own)
}

/// By entry, the sum of the sizes of its coefficients.
fn sizes(series: &[Vec<f64>]) -> Vec<f64> {
    let mut sums = vec![0.0; series[0].len()];
    series.iter().for_each(|own| sums.iter_mut().zip(own).for_each(|(sum, c)| *sum += c.abs()));
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A heavy body on a light plank that slides on, on a floor: `1/M + (1 + s)^2/m`, `-(1 + s)/m` and `1/m`, with the determinant `1/(M m)`
    /// everywhere. Errors of the rows reach the unknowns as the inverse at each place says, and are not far from what is stated.
    #[test]
    fn what_changes_by_more_than_its_inverse_bears_has_bounds() {
        for heavy in [1.0, 1e2, 1e4, 1e6] {
            let constant = vec![1.0 / heavy + 1.0, -1.0, -1.0, 1.0];
            let mut matrix = vec![vec![0.0; 4]; 12];
            matrix[0] = constant;
            matrix[1] = vec![0.5, -0.25, -0.25, 0.0];
            matrix[2] = vec![0.0625, 0.0, 0.0, 0.0];
            let first = vec![heavy, heavy, heavy, heavy + 1.0];
            let left = [1e-12, 2e-12];
            let bounds = Inverse::of(&matrix, &[0.0; 4], first).and_then(|inverse| inverse.bounds(&left));
            let bounds = bounds.expect("bounds");
            for place in 0..=10 {
                let lever = 1.0 + 0.025 * f64::from(place);
                let own = [
                    heavy * (left[0] + lever * left[1]),
                    heavy * lever * left[0] + (1.0 + heavy * lever * lever) * left[1],
                ];
                for (own, bound) in own.into_iter().zip(&bounds) {
                    assert!(own <= *bound && *bound < 10.0 * own, "{heavy} {place}: {own} {bound}");
                }
            }
        }
    }
}
