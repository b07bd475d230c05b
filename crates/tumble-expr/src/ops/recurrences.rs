//! Kernels: coefficients of order `k >= 1` of sums, products, quotients, roots and functions known by their derivative.
//!
//! `c = a b`: Cauchy's product. `c = a / b`, from `c b = a`: `c_k b_0 = a_k - sum over i < k of c_i b_(k-i)`. `c = sqrt(a)`, from
//! `c^2 = a`. `c' = a' g` with a companion series g: comparing orders, `k c_k = sum over i from 1 to k of i a_i g_(k-i)`, of which the last
//! term, divided, is `a_k g_0`. What holds a new coefficient is added last, so that all else is done before that is known. So are exp (g = c), sin
//! (g = cos), cos (g = -sin), sinh, cosh, tan (g = 1 + c^2), tanh (g = 1 - c^2).

use super::Slot;
use crate::Scalar;
use crate::arena::Arena;
use crate::resolved::{By, Term};

impl<S: Scalar> Arena<S> {
    /// Order 0 of a sum of multiples.
    pub(crate) fn first_sum(&self, terms: &[Term]) -> S {
        let (first, others) = terms.split_first().expect("a sum has terms");
        let start = if first.is_taken { -self.first_term(first) } else { self.first_term(first) };
        others.iter().fold(start, |sum, term| {
            let value = self.first_term(term);
            if term.is_taken { sum - value } else { sum + value }
        })
    }

    fn first_term(&self, term: &Term) -> S {
        self.scaled(self.at(term.of, 0), term.by)
    }

    /// Multiplied with or divided by what does not change with time.
    #[inline(always)]
    pub(crate) fn scaled(&self, value: S, by: By) -> S {
        match by {
            By::One => value,
            By::Times(by) => value * self.at(by, 0),
            By::Over(by) => value / self.at(by, 0),
        }
    }

    /// What a term is multiplied with or divided by at other orders, with its sign.
    pub(crate) fn multiplier(&self, term: &Term) -> S {
        let size = match term.by {
            By::One => S::one(),
            By::Times(by) | By::Over(by) => self.at(by, 0),
        };
        if term.is_taken { -size } else { size }
    }

    /// A sum of multiples at other orders.
    #[inline(always)]
    pub(crate) fn sum(&self, terms: &[Term], multipliers: &[S], k: usize) -> S {
        let mut terms = terms.iter().zip(multipliers);
        let (first, by) = terms.next().expect("a sum has terms");
        let mut sum = self.term(first, *by, k);
        for (term, by) in terms {
            sum = sum + self.term(term, *by, k);
        }
        sum
    }

    /// A reciprocal that is rounded once would be off by the same at every step, and what is conserved would drift.
    #[inline(always)]
    fn term(&self, term: &Term, by: S, k: usize) -> S {
        let value = self.at(term.of, k);
        match term.by {
            By::One if term.is_taken => -value,
            By::One => value,
            By::Times(_) => value * by,
            By::Over(_) => value / by,
        }
    }

    #[inline(always)]
    pub(crate) fn product(&self, a: Slot, b: Slot, k: usize) -> S {
        self.inner(a, b, k) + self.at(a, 0) * self.at(b, k) + self.at(a, k) * self.at(b, 0)
    }

    #[inline(always)]
    pub(crate) fn square(&self, a: Slot, k: usize) -> S {
        self.inner_square(a, k) + S::splat(2.0) * self.at(a, 0) * self.at(a, k)
    }

    /// Of `a |a|`, with the sign of a.
    #[inline(always)]
    pub(crate) fn directed_square(&self, a: Slot, sign: S, k: usize) -> S {
        sign * self.inner_square(a, k) + sign * S::splat(2.0) * self.at(a, 0) * self.at(a, k)
    }

    /// Of the sum of squares of some rows.
    #[inline(always)]
    pub(crate) fn squares(&self, parts: &[Slot], k: usize) -> S {
        let (first, others) = parts.split_first().expect("a length has components");
        others.iter().fold(self.square(*first, k), |sum, part| sum + self.square(*part, k))
    }

    #[inline(always)]
    pub(crate) fn quotient(&self, a: Slot, b: Slot, c: Slot, k: usize) -> S {
        (self.at(a, k) - (self.inner(c, b, k) + self.at(c, 0) * self.at(b, k))).over(self.at(b, 0))
    }

    #[inline(always)]
    pub(crate) fn root(&self, a: Slot, c: Slot, k: usize) -> S {
        (self.at(a, k) - self.inner_square(c, k)) / (S::splat(2.0) * self.at(c, 0))
    }

    /// Of `c' = a' g`, with the slope of a.
    #[inline(always)]
    pub(crate) fn along(&self, (of, slope): (Slot, Slot), factor: Slot, k: usize) -> S {
        self.inner(slope, factor, k) / S::splat(k as f64) + self.at(of, k) * self.at(factor, 0)
    }

    /// Sine and cosine; of an argument that is linear in the parameter one term is left.
    #[inline(always)]
    pub(crate) fn wave(
        &self,
        of: (Slot, Slot),
        (sin, cos): (Slot, Slot),
        k: usize,
        is_linear: bool,
    ) -> [S; 2] {
        if is_linear {
            let rate = self.at(of.0, 1) / S::splat(k as f64);
            return [rate * self.at(cos, k - 1), -(rate * self.at(sin, k - 1))];
        }
        [self.along(of, cos, k), -self.along(of, sin, k)]
    }
}
