//! Products of matrices, with the same bits wherever they are computed.

use nalgebra::DMatrix;

/// The product of two matrices, column by column, each a sum in order. The operator of the library is the same for small ones, but with its
/// feature `std`, which any other crate of a build may turn on, it gives large ones to kernels that fuse and reorder sums as the processor can.
/// Not needed where one of the two is diagonal: sums of one number have no order.
pub(crate) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(a.nrows(), b.ncols());
    for (mut column, right) in all.column_iter_mut().zip(b.column_iter()) {
        column.gemv(1.0, a, &right, 0.0);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the tests of the workspace the library's own operator is another.
    #[test]
    fn sums_are_in_order() {
        let n = 12;
        let [a, b] =
            [7, 13].map(|k| DMatrix::from_fn(n, n, |i, j| libm::sin((k * i * i + 3 * j * j + 1) as f64)));
        let found = product(&a, &b);
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let sum = (0..n).fold(0.0, |sum, k| sum + a[(i, k)] * b[(k, j)]);
            assert_eq!(found[(i, j)].to_bits(), sum.to_bits(), "{i} {j}");
        }
    }
}
