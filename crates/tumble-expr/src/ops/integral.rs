//! Functions known by their derivative where that is a quotient: `c' g = n'` with a denominator g: log (g = a), asin and acos
//! (g = sqrt(1 - a^2)), atan (g = 1 + a^2), atan2 (g = x^2 + y^2). Those with `c' = a' g` are in [`super::recurrences`].

use super::arithmetic::side_by_side;
use crate::Scalar;

/// `c' g = n'` for given `n_k`: `k c_k g_0 = k n_k - sum over i from 1 to k-1 of i c_i g_(k-i)`.
pub(crate) fn against<S: Scalar>(n: S, g: &[S], c: &[S], k: usize) -> S {
    (n - weighted(&c[1..k], &g[1..k]) / order(k)) / g[0]
}

/// `n' = x y' - y x'`, the numerator of the angle of (x, y).
pub(crate) fn sweep<S: Scalar>(x: &[S], y: &[S], k: usize) -> S {
    (weighted(&y[1..=k], &x[..k]) - weighted(&x[1..=k], &y[..k])) / order(k)
}

/// Sum of `i a_i g_(n-i)` over i from 1 to n, the first slice beginning with a_1 and the second ending with g_(n-1).
fn weighted<S: Scalar>(a: &[S], g: &[S]) -> S {
    side_by_side(a, g, |i, x, y| S::splat((i + 1) as f64) * x * y)
}

fn order<S: Scalar>(k: usize) -> S {
    S::splat(k as f64)
}
