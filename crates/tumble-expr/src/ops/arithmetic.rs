//! Squares and sums of products of series that are no rows of an arena.

use crate::Scalar;

/// `c = a^2`: the product's terms in equal pairs, and the middle one where k is even.
pub(crate) fn square<S: Scalar>(a: &[S], k: usize) -> S {
    half_square(a, k) + S::splat(2.0) * (a[0] * a[k])
}

/// Terms of `a^2` at order k that hold neither `a_0` nor `a_k`.
pub(crate) fn half_square<S: Scalar>(a: &[S], k: usize) -> S {
    let below = k.div_ceil(2).max(1);
    let pairs = convolution(&a[1..below], &a[k + 1 - below..k]);
    let twice = S::splat(2.0) * pairs;
    if k.is_multiple_of(2) && k > 0 { twice + a[k / 2].square() } else { twice }
}

/// Sum of `a_i b_(n-1-i)` over two slices of one length n.
pub(crate) fn convolution<S: Scalar>(a: &[S], b: &[S]) -> S {
    side_by_side(a, b, |_, x, y| x * y)
}

/// Sum of what `term` makes of i, `a_i` and `b_(n-1-i)`: four sums side by side, of which none waits for another, and then what is
/// left over. The order is the same for every scalar.
pub(crate) fn side_by_side<S: Scalar>(a: &[S], b: &[S], term: impl Fn(usize, S, S) -> S) -> S {
    let mut sums = [S::zero(); WIDTH];
    let (blocks, rest) = a.as_chunks::<WIDTH>();
    let (rest_of_b, blocks_of_b) = b.as_rchunks::<WIDTH>();
    for (block, (x, y)) in blocks.iter().zip(blocks_of_b.iter().rev()).enumerate() {
        for i in 0..WIDTH {
            sums[i] = sums[i] + term(block * WIDTH + i, x[i], y[WIDTH - 1 - i]);
        }
    }
    let left = rest.iter().zip(rest_of_b.iter().rev()).zip(a.len() - rest.len()..);
    let left = left.fold(S::zero(), |sum, ((x, y), i)| sum + term(i, *x, *y));
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + left
}

/// Sums side by side.
const WIDTH: usize = 4;
