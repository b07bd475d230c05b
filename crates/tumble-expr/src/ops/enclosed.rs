//! Lengths, quotients that vanish and linear systems on intervals.
//!
//! **Vanishing.** Where a series a is zero at the beginning of an interval of places, `a = s b` with s the way from there,
//! and the coefficients of b are enclosed by those of a, one order up: `b(s)` is the mean of a' from 0 to s, so that
//! `b^(k)/k!` lies in the hull of `a^(k+1)/(k+1)!` over the way. So `|a| = s |b|`, and its derivative is `b . a' / |b|`, which
//! holds no zero; `a^2/b = s p^2/q` with p and q such series. Orders not known yet are those of the evaluation before.
//!
//! **Linear systems.** With C the inverse of A_m, the matrix in the middle, and x_m some numbers, `x - x_m = C (r - A x_m) - C (A - A_m)
//! (x - x_m)` for all x of a matrix A with a right side r: any d with `|C| (|r - A x_m| + |A - A_m| d) <= d` bounds `|x - x_m|`, each
//! unknown by its own. Source: Neumaier, Interval Methods for Systems of Equations, 4.1.

use std::ops::Add;

use super::amplified::Amplifier;
use super::kernels::Kernels;
use super::solve::{Bench, Matrix, System};
use super::{Series, Slot};
use crate::{Interval, Scalar};

type Boxes<'a> = Series<'a, Interval>;

impl Kernels for Interval {
    fn norm(series: &Boxes<'_>, parts: u32) -> Self {
        let parts_of = &series.tape.norms[parts as usize];
        let all = length(parts_of.iter().map(|part| series.first(*part)));
        if !series.vanishing[parts as usize] {
            return all;
        }
        // Order 1 is that of the evaluation before; a single number has none.
        let slopes = parts_of.iter().filter_map(|part| series.of(*part).get(1).copied());
        all.both(series.elapsed * length(slopes))
    }

    fn norm_coefficient(series: &Boxes<'_>, parts: u32, (slot, _): (Slot, Self), k: usize) -> Self {
        let c = series.of(slot);
        let is_vanishing = series.vanishing[parts as usize];
        let parts = &series.tape.norms[parts as usize];
        let slope = match is_vanishing {
            true => vanishing_slope(&parts.iter().map(|part| series.of(*part)).collect::<Vec<_>>(), k),
            false => slope(parts.iter().map(|part| series.of(*part)), c, k),
        };
        let found = slope / Self::splat(k as f64);
        // A length changes no faster than its vector, wherever that is.
        if k == 1 {
            found.both(Self::around_zero(length(parts.iter().map(|part| series.of(*part)[1])).high))
        } else {
            c[0].smooth(found)
        }
    }

    fn square_over(series: &Boxes<'_>, (of, by, vanishing): (Slot, Slot, u32)) -> Self {
        if !series.vanishing[vanishing as usize] {
            return series.first(of).square() / series.first(by);
        }
        match (series.of(of).get(1), series.of(by).get(1)) {
            (Some(a), Some(b)) => series.elapsed * (a.square() / *b),
            _ => Self::ENTIRE,
        }
    }

    fn square_over_coefficient(
        series: &Boxes<'_>,
        (of, by, vanishing): (Slot, Slot, u32),
        c: &[Self],
        k: usize,
    ) -> Self {
        let (a, b) = (series.of(of), series.of(by));
        if !series.vanishing[vanishing as usize] {
            return over(a, b, c, k);
        }
        if k + 1 >= a.len() {
            return Self::ENTIRE;
        }
        let mut ratio: Vec<Self> = vec![];
        for j in 0..=k {
            let next = if j == 0 { a[1].square() / b[1] } else { over(&a[1..], &b[1..], &ratio, j) };
            ratio.push(next);
        }
        series.elapsed * ratio[k] + ratio[k - 1]
    }

    /// Those of the matrix in the middle.
    fn factor(series: &Boxes<'_>, matrix: &Matrix, bench: &mut Bench<Self>, factors: &mut [Self]) {
        let Bench { numbers, lanes, .. } = bench;
        lanes.resize(factors.len(), 0.0);
        matrix.plan.factor(|entry| series.first(matrix.entries[entry]).middle(), numbers, lanes);
        factors.iter_mut().zip(lanes).for_each(|(factor, value)| *factor = Self::point(*value));
    }

    fn solve(series: &Boxes<'_>, system: &System, Bench { right, x, .. }: &mut Bench<Self>) {
        let Matrix { shape, entries, plan, .. } = series.matrix(system);
        let factors: Vec<f64> = series.factors_of(system).iter().map(|factor| factor.low).collect();
        let inverse = Amplifier { plan, factors: &factors };
        let middle = inverse.solve(right.iter().map(|right| right.middle()).collect());
        x.fill(Self::ENTIRE);
        if !middle.iter().all(|x| x.is_finite()) {
            return;
        }
        let entry = |entry: usize| series.first(entries[entry]);
        let left = |row: usize| {
            let terms = shape.entries_of(row).map(|(of, column)| entry(of) * Self::point(middle[column]));
            terms.fold(right[row], |rest, term| rest - term).magnitude()
        };
        let left: Vec<f64> = (0..right.len()).map(left).collect();
        let rounding = left.len() as f64 * f64::EPSILON;
        let off = |of: usize| entry(of).reach() + rounding * entry(of).magnitude();
        let change = |bounds: &[f64]| -> Vec<f64> {
            let row = |row: usize| shape.entries_of(row).map(|(of, column)| off(of) * bounds[column]).sum();
            (0..bounds.len()).map(row).collect()
        };
        if let Some(bounds) = inverse.enclosed(&left, change) {
            let found = middle.iter().zip(bounds);
            let found =
                found.map(|(middle, bound)| Self::point(*middle) + Self::around_zero(bound.next_up()));
            x.iter_mut().zip(found).for_each(|(x, found)| *x = found);
        }
    }
}

/// Coefficient of order k - 1 of the derivative of c, the length of a: `c c' = a . a'`.
fn slope<'a>(parts: impl Iterator<Item = &'a [Interval]>, c: &[Interval], k: usize) -> Interval {
    let right = sum(parts.map(|a| sum((1..=k).map(|i| a[k - i] * of_slope(a, i)))));
    (right - sum((1..k).map(|i| of_slope(c, i) * c[k - i]))) / c[0]
}

/// The same of a vector `a = s b` that vanishes at s = 0, with e the derivative: `e |b| = b . a'`.
fn vanishing_slope(parts: &[&[Interval]], k: usize) -> Interval {
    // The length of b, up to order k - 1.
    let mut lengths = vec![length(parts.iter().map(|a| a[1]))];
    for j in 1..k {
        let squares = sum(parts.iter().map(|a| super::arithmetic::square(&a[1..], j)));
        lengths.push(Interval::zero());
        let before = super::arithmetic::half_square(&lengths, j);
        lengths[j] = (squares - before) / (Interval::splat(2.0) * lengths[0]);
    }
    let mut slopes: Vec<Interval> = vec![];
    for j in 0..k {
        let dot = |a: &&[Interval]| sum((0..=j).map(|i| a[1 + i] * of_slope(a, j - i + 1)));
        let right = sum(parts.iter().map(dot));
        let taken = sum((0..j).map(|i| slopes[i] * lengths[j - i]));
        slopes.push((right - taken) / lengths[0]);
    }
    slopes[k - 1]
}

/// `i a_i`: a coefficient of a derivative.
fn of_slope(a: &[Interval], i: usize) -> Interval {
    Interval::splat(i as f64) * a[i]
}

fn sum(terms: impl Iterator<Item = Interval>) -> Interval {
    terms.fold(Interval::zero(), Interval::add)
}

/// Coefficient of order k >= 1 of `a^2 / b`.
fn over(a: &[Interval], b: &[Interval], c: &[Interval], k: usize) -> Interval {
    let taken = (0..k).fold(Interval::zero(), |sum, i| sum + c[i] * b[k - i]);
    (super::arithmetic::square(a, k) - taken) / b[0]
}

fn length(parts: impl Iterator<Item = Interval> + Clone) -> Interval {
    let mut all = parts.clone();
    // One component: no square, which might overflow.
    if let (Some(only), None) = (all.next(), all.next()) {
        let most = only.magnitude();
        return Interval::new(
            if only.contains(0.0) { 0.0 } else { only.low.abs().min(only.high.abs()) },
            most,
        );
    }
    parts.fold(Interval::zero(), |sum, part| sum + part.square()).sqrt()
}
