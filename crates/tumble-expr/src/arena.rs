//! Where an evaluator keeps its series: one row of coefficients after the other, and each row backwards as well.
//!
//! A product's coefficient of order k is the sum of `a_i b_(k-i)`: of a row and a row that runs backwards it is one straight sum over
//! two stretches of memory. Four sums run side by side, of which none waits for another; then come those that are left over,
//! and the outer two terms, which hold the newest coefficients, last: so all else is done before these are known. The order is the
//! same for every scalar and width. Nothing is fused.

use crate::Scalar;
use crate::ops::Slot;

/// Sums side by side.
const WIDTH: usize = 4;

/// Rows of coefficients.
#[derive(Clone, Debug)]
pub(crate) struct Arena<S> {
    /// Length of a row: one more than the highest order.
    stride: usize,
    /// `[row][order]`
    data: Vec<S>,
    /// The same, each row from its highest order down.
    backwards: Vec<S>,
}

impl<S: Scalar> Arena<S> {
    pub(crate) fn new(rows: usize, order: usize) -> Self {
        let stride = order + 1;
        let zeros = vec![S::zero(); rows * stride];
        Self { stride, backwards: zeros.clone(), data: zeros }
    }

    /// Length of a row.
    pub(crate) fn stride(&self) -> usize {
        self.stride
    }

    #[inline(always)]
    pub(crate) fn row(&self, slot: Slot) -> &[S] {
        &self.data[slot as usize * self.stride..][..self.stride]
    }

    #[inline(always)]
    pub(crate) fn at(&self, slot: Slot, k: usize) -> S {
        self.data[slot as usize * self.stride + k]
    }

    #[inline(always)]
    pub(crate) fn put(&mut self, slot: Slot, k: usize, value: S) {
        let row = slot as usize * self.stride;
        self.data[row + k] = value;
        self.backwards[row + self.stride - 1 - k] = value;
    }

    pub(crate) fn fill(&mut self, slot: Slot, value: S) {
        let row = slot as usize * self.stride..(slot as usize + 1) * self.stride;
        self.data[row.clone()].fill(value);
        self.backwards[row].fill(value);
    }

    /// Sum of `a_i b_(k-i)` over i from 1 to k - 1.
    #[inline(always)]
    pub(crate) fn inner(&self, a: Slot, b: Slot, k: usize) -> S {
        self.stretch(a, b, k, k - 1)
    }

    /// Sum of the first `count` of these.
    #[inline(always)]
    fn stretch(&self, a: Slot, b: Slot, k: usize, count: usize) -> S {
        let (a, b) = (a as usize * self.stride, (b as usize + 1) * self.stride);
        let x = &self.data[a + 1..][..count];
        let y = &self.backwards[b - k..][..count];
        straight(x, y)
    }

    /// Terms of `a^2` at order k >= 1 that hold neither `a_0` nor `a_k`: equal pairs, and the middle one where k is even.
    #[inline(always)]
    pub(crate) fn inner_square(&self, a: Slot, k: usize) -> S {
        let pairs = self.stretch(a, a, k, (k - 1) / 2);
        let twice = S::splat(2.0) * pairs;
        if k.is_multiple_of(2) { twice + self.at(a, k / 2).square() } else { twice }
    }
}

/// Sum of products of two slices of one length.
#[inline(always)]
fn straight<S: Scalar>(x: &[S], y: &[S]) -> S {
    let mut sums = [S::zero(); WIDTH];
    let ((x, x_left), (y, y_left)) = (x.as_chunks::<WIDTH>(), y.as_chunks::<WIDTH>());
    for (x, y) in x.iter().zip(y) {
        for i in 0..WIDTH {
            sums[i] = sums[i] + x[i] * y[i];
        }
    }
    // By their number, so that the sums need not be in memory.
    for (i, sum) in sums.iter_mut().enumerate() {
        if let (Some(x), Some(y)) = (x_left.get(i), y_left.get(i)) {
            *sum = *sum + *x * *y;
        }
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_the_formula() {
        let order = 13;
        let mut arena = Arena::new(2, order);
        for k in 0..=order {
            arena.put(0, k, (3 * k + 1) as f64);
            arena.put(1, k, (k * k) as f64 - 7.0);
        }
        for k in 1..=order {
            let inner = |a: Slot, b: Slot| (1..k).map(|i| arena.at(a, i) * arena.at(b, k - i)).sum::<f64>();
            assert_eq!(arena.inner(0, 1, k), inner(0, 1), "order {k}");
            assert_eq!(arena.inner_square(1, k), inner(1, 1), "order {k}");
        }
    }
}
