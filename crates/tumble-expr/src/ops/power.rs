//! Powers with an exponent that does not change with time.

use crate::Scalar;

/// `c = a^p`, from `a c' = p c a'`: `k a_0 c_k = sum over i < k of (p (k-i) - i) a_(k-i) c_i`.
pub(crate) fn power<S: Scalar>(a: &[S], p: S, c: &[S], k: usize) -> S {
    let term = |i: usize| (p * S::splat((k - i) as f64) - S::splat(i as f64)) * a[k - i] * c[i];
    let sum = (1..k).fold(S::zero(), |sum, i| sum + term(i)) + term(0);
    sum / (S::splat(k as f64) * a[0])
}
