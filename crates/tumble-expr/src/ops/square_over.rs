//! `a^2 / b` where a and b may vanish together.
//!
//! With m the lowest order at which b is not zero, and a no earlier, `a = s^m p`, `b = s^m q` and `a^2/b = s^m p^2/q`:
//! the quotient's series follows from those of p and q and holds no order beyond its own. (The ratio a/b alone would.)
//! Where rounding has left something of a zero, whoever knows says so, as for a length.

use super::{Series, Slot};
use crate::Lanewise;
use crate::ops::arithmetic::{self, convolution, half_square};

pub(crate) fn value<S: Lanewise>(series: &Series<'_, S>, of: Slot, by: Slot, vanishing: u32) -> S {
    let known_zero = series.vanishing[vanishing as usize];
    let (a, b) = (series.first(of), series.first(by));
    S::from_lanes(|lane| {
        let (a, b) = (a.lane(lane), b.lane(lane));
        if known_zero || (a == 0.0 && b == 0.0) { 0.0 } else { a * a / b }
    })
}

pub(crate) fn coefficient<S: Lanewise>(
    series: &Series<'_, S>,
    (of, by, vanishing): (Slot, Slot, u32),
    c: &[S],
    k: usize,
) -> S {
    let lowest = usize::from(series.vanishing[vanishing as usize]);
    let (a, b) = (series.of(of), series.of(by));
    // Away from zero in every lane there is nothing to factor out.
    if lowest == 0 && (0..S::LANES).all(|lane| b[0].lane(lane) != 0.0) {
        return (arithmetic::square(a, k) - (convolution(&c[1..k], &b[1..k]) + c[0] * b[k])) / b[0];
    }
    S::from_lanes(|lane| of_lane(a, b, c, lowest..=k, lane))
}

fn of_lane<S: Lanewise>(
    a: &[S],
    b: &[S],
    c: &[S],
    orders: std::ops::RangeInclusive<usize>,
    lane: usize,
) -> f64 {
    let k = *orders.end();
    let zero = |series: &[S], order: usize| series[order].lane(lane) == 0.0;
    let Some(m) = orders.clone().find(|order| !zero(b, *order)) else {
        return if orders.clone().all(|order| zero(a, order)) { 0.0 } else { f64::NAN };
    };
    if orders.clone().take_while(|order| *order < m).any(|order| !zero(a, order)) {
        return f64::NAN;
    }
    let shifted = |series: &[S]| -> Vec<f64> { (m..=k).map(|order| series[order].lane(lane)).collect() };
    let (p, q, j) = (shifted(a), shifted(b), k - m);
    let square = if j == 0 { p[0] * p[0] } else { half_square(&p, j) + 2.0 * (p[0] * p[j]) };
    let c: Vec<f64> = (m..k).map(|order| c[order].lane(lane)).collect();
    (square - if j == 0 { 0.0 } else { convolution(&c, &q[1..]) }) / q[0]
}
