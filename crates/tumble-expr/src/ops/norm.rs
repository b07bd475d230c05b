//! Length of a vector, also where all its components vanish at the point of expansion.
//!
//! With m the lowest order at which any component is not zero, `a = s^m b` and `|a| = s^m |b|` for s >= 0, where |b|
//! is smooth at s = 0: the series of |b| follows from `|b|^2 = sum of b_j^2` as a square root's does. So the speed of a
//! body released from rest has its exact series, `g s + ...`, and not the one of a singular root. Where a motion passes
//! through zero, rounding leaves a vector of some ulps: whoever knows that it is zero says so, and order 0 is not read.

use super::arithmetic::half_square;
use super::{Series, Slot};
use crate::Lanewise;

pub(crate) fn value<S: Lanewise>(series: &Series<'_, S>, parts: u32) -> S {
    if series.vanishing[parts as usize] {
        return S::zero();
    }
    let parts = &series.tape.norms[parts as usize];
    S::from_lanes(|lane| length(parts.iter().map(|part| series.first(*part).lane(lane))))
}

pub(crate) fn coefficient<S: Lanewise>(
    series: &Series<'_, S>,
    parts: u32,
    (slot, of_square): (Slot, S),
    k: usize,
) -> S {
    let lowest = usize::from(series.vanishing[parts as usize]);
    let first = series.first(slot);
    // Away from zero in every lane there is nothing to factor out.
    if lowest == 0 && (0..S::LANES).all(|lane| first.lane(lane) != 0.0) {
        return (of_square - series.arena.inner_square(slot, k)) / (S::splat(2.0) * first);
    }
    let parts = &series.tape.norms[parts as usize];
    S::from_lanes(|lane| of_lane(series, parts, series.of(slot), lowest..=k, lane))
}

fn of_lane<S: Lanewise>(
    series: &Series<'_, S>,
    parts: &[Slot],
    c: &[S],
    orders: std::ops::RangeInclusive<usize>,
    lane: usize,
) -> f64 {
    let k = *orders.end();
    let at = |part: Slot, order: usize| series.of(part)[order].lane(lane);
    let vanishes = |order: usize| parts.iter().all(|part| at(*part, order) == 0.0);
    let Some(m) = orders.clone().find(|order| !vanishes(*order)) else { return 0.0 };
    let j = k - m;
    if j == 0 {
        return length(parts.iter().map(|part| at(*part, m)));
    }
    // Order j of the sum of squares of b, newest terms last.
    let squares = parts.iter().fold(0.0, |sum, part| {
        let b: Vec<f64> = (m..=k).map(|order| at(*part, order)).collect();
        sum + half_square(&b, j)
    });
    let newest = parts.iter().fold(0.0, |sum, part| sum + at(*part, m) * at(*part, k));
    let c: Vec<f64> = (m..k).map(|order| c[order].lane(lane)).chain([0.0]).collect();
    (squares - half_square(&c, j) + 2.0 * newest) / (2.0 * c[0])
}

/// Scaled by the largest component, so that squares neither overflow nor vanish.
fn length(parts: impl Iterator<Item = f64> + Clone) -> f64 {
    let largest = parts.clone().fold(0.0, |largest: f64, part| largest.max(part.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return if parts.clone().any(f64::is_nan) { f64::NAN } else { largest };
    }
    // A power of two scales without rounding.
    let (_, exponent) = libm::frexp(largest);
    let squares = parts.fold(0.0, |sum, part| {
        let scaled = libm::ldexp(part, -exponent);
        sum + scaled * scaled
    });
    libm::ldexp(squares.sqrt(), exponent)
}
