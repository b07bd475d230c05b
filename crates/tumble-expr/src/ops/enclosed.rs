//! Lengths, quotients that vanish and linear systems on intervals.
//!
//! **Vanishing.** Where a series a is zero at the beginning of an interval of places, `a = s b` with s the way from there,
//! and the coefficients of b are enclosed by those of a, one order up: `b(s)` is the mean of a' from 0 to s, so that
//! `b^(k)/k!` lies in the hull of `a^(k+1)/(k+1)!` over the way. So `|a| = s |b|`, and its derivative is `b . a' / |b|`, which
//! holds no zero; `a^2/b = s p^2/q` with p and q such series. Orders not known yet are those of the evaluation before.
//!
//! **Linear systems.** With C the inverse of the matrix in the middle, `x = C r + (I - C A) x`: all x of a matrix A with a
//! right side r lie in `C r` widened by `m/(1-m)` of its largest, where m < 1 bounds the rows of `I - C A`; put into the right
//! side once more, each unknown has its own width. Source: Neumaier, Interval Methods for Systems of Equations, 4.1.

use std::ops::Add;

use super::kernels::Kernels;
use super::solve::{factors_of, inverse};
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

    /// The inverse of the middle, the entries of `I - C A`, and the bound of its rows.
    fn factors(series: &Boxes<'_>, matrix: u32) -> Vec<Self> {
        let matrix = &series.tape.matrices[matrix as usize];
        let n = matrix.n;
        let entries: Vec<Self> = matrix.entries.iter().map(|entry| series.first(*entry)).collect();
        let middle = inverse(n, entries.iter().map(|entry| 0.5 * (entry.low + entry.high)).collect());
        let middle: Vec<Self> = middle.into_iter().map(Self::point).collect();
        let residual = |index: usize| {
            let (row, column) = (index / n, index % n);
            let terms = (0..n).map(|j| middle[row * n + j] * entries[j * n + column]);
            Self::splat(f64::from(u8::from(row == column))) - terms.fold(Self::zero(), |sum, term| sum + term)
        };
        let residuals: Vec<Self> = (0..n * n).map(residual).collect();
        let rows = residuals.chunks(n).map(|row| row.iter().map(|entry| entry.magnitude()).sum::<f64>());
        let bound = rows.fold(0.0, f64::max);
        middle.into_iter().chain(residuals).chain([Self::point(bound)]).collect()
    }

    fn forward(series: &Boxes<'_>, system: u32, row: u32, k: usize) -> Self {
        series.of(series.tape.systems[system as usize].residuals[row as usize])[k]
    }

    fn solution(series: &Boxes<'_>, system: u32, row: u32, k: usize) -> Self {
        let system = &series.tape.systems[system as usize];
        let (n, factors) = (system.n, factors_of(series, system));
        let bound = factors[2 * n * n].high;
        if bound.is_nan() || bound >= 1.0 {
            return Self::ENTIRE;
        }
        let sum = |terms: &mut dyn Iterator<Item = Self>| terms.fold(Self::zero(), |sum, term| sum + term);
        let right = |j: usize| series.of(system.forward + j as Slot)[k];
        let near = |i: usize| sum(&mut (0..n).map(|j| factors[i * n + j] * right(j)));
        let near: Vec<Self> = (0..n).map(near).collect();
        let most = near.iter().map(|x| x.magnitude()).fold(0.0, f64::max);
        let wide = Self::around_zero((most / (1.0 - bound)).next_up());
        let row = row as usize;
        near[row] + sum(&mut (0..n).map(|j| factors[n * n + row * n + j] * wide))
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
