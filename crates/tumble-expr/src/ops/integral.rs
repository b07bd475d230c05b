//! Functions known by their derivative: every elementary function but powers.
//!
//! Two shapes cover them all. `c' = a' g` with a companion series g: exp (g = c), sin (g = cos), cos (g = -sin), sinh,
//! cosh, tan (g = 1 + c^2), tanh (g = 1 - c^2). `c' g = n'` with a denominator g: log (g = a), asin and acos
//! (g = sqrt(1 - a^2)), atan (g = 1 + a^2), atan2 (g = x^2 + y^2).

use super::arithmetic::WIDTH;
use crate::Scalar;

/// `c' = a' g`: comparing orders, `k c_k = sum over i from 1 to k of i a_i g_(k-i)`.
pub(crate) fn along<S: Scalar>(a: &[S], g: &[S], k: usize) -> S {
    weighted(&a[1..=k], &g[..k]) / order(k)
}

/// `c' g = n'` for given `n_k`: `k c_k g_0 = k n_k - sum over i from 1 to k-1 of i c_i g_(k-i)`.
pub(crate) fn against<S: Scalar>(n: S, g: &[S], c: &[S], k: usize) -> S {
    (n - weighted(&c[1..k], &g[1..k]) / order(k)) / g[0]
}

/// `n' = x y' - y x'`, the numerator of the angle of (x, y).
pub(crate) fn sweep<S: Scalar>(x: &[S], y: &[S], k: usize) -> S {
    (weighted(&y[1..=k], &x[..k]) - weighted(&x[1..=k], &y[..k])) / order(k)
}

/// Sum of `i a_i g_(n-i)` over i from 1 to n, the first slice beginning with a_1 and the second ending with g_(n-1): four sums side
/// by side, and then what is left over.
fn weighted<S: Scalar>(a: &[S], g: &[S]) -> S {
    let mut sums = [S::zero(); WIDTH];
    let mut weights: [f64; WIDTH] = [1.0, 2.0, 3.0, 4.0];
    let (blocks, rest) = a.as_chunks::<WIDTH>();
    let (rest_of_g, blocks_of_g) = g.as_rchunks::<WIDTH>();
    for (x, y) in blocks.iter().zip(blocks_of_g.iter().rev()) {
        for i in 0..WIDTH {
            sums[i] = sums[i] + S::splat(weights[i]) * x[i] * y[WIDTH - 1 - i];
            weights[i] += WIDTH as f64;
        }
    }
    let left = rest.iter().zip(rest_of_g.iter().rev()).zip(weights);
    let left = left.fold(S::zero(), |sum, ((x, y), weight)| sum + S::splat(weight) * *x * *y);
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + left
}

fn order<S: Scalar>(k: usize) -> S {
    S::splat(k as f64)
}
