//! Functions known by their derivative: every elementary function but powers.
//!
//! Two shapes cover them all. `c' = a' g` with a companion series g: exp (g = c), sin (g = cos), cos (g = -sin), sinh,
//! cosh, tan (g = 1 + c^2), tanh (g = 1 - c^2). `c' g = n'` with a denominator g: log (g = a), asin and acos
//! (g = sqrt(1 - a^2)), atan (g = 1 + a^2), atan2 (g = x^2 + y^2).

use super::arithmetic::side_by_side;
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

/// Sum of `i a_i g_(n-i)` over i from 1 to n, the first slice beginning with a_1 and the second ending with g_(n-1).
fn weighted<S: Scalar>(a: &[S], g: &[S]) -> S {
    side_by_side(a, g, |i, x, y| S::splat((i + 1) as f64) * x * y)
}

fn order<S: Scalar>(k: usize) -> S {
    S::splat(k as f64)
}
