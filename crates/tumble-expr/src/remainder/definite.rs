//! How small a symmetric matrix can be along a step: a lower bound of all its eigenvalues that holds everywhere.
//!
//! With the matrix scaled to S, whose diagonal begins at 1, and any number l, elimination with series finds polynomials L and D with
//!
//! ```text
//! S(s) - l = L(s) D(s) L(s)^T + E(s)
//! ```
//!
//! where E is what the series leave out and rounding, entry by entry. Where D is positive along all of the step, `L D L^T` is positive
//! however badly conditioned L is, so no eigenvalue of S is below `l - |E|`. An error e with `S e = r` then has `|e| <= |r| / (l - |E|)`, both
//! Euclidean. Long chains are seen to be regular in this way, although they change by more than the inverse of any one of
//! their matrices bears. A first guess of l is what inverse iteration finds in the middle of the step; it proves nothing and need not.
//!
//! Source: Rump, Verification methods, Acta Numerica 19 (2010), 10.8 (with numbers and not with series).

use super::least;
use crate::ops::elimination::{Column, Symmetric};

/// What is tried first, in units of the guess, and what it is multiplied with where it does not hold, so many times.
const FIRST: f64 = 0.5;
const LESS: f64 = 1.0 / 8.0;
const TRIES: usize = 3;
/// The matrix is known to be regular if what is left out is at most this part of the number.
const LEFT_OUT: f64 = 0.5;

/// A matrix along a step, scaled: coefficients times powers of the step's length, by place one row after the other.
pub(super) struct Definite<'a> {
    plan: &'a Symmetric,
    rows: Vec<f64>,
    /// How far each row is from the entry that it stands for.
    rests: Vec<f64>,
    /// By unknown, one over the root of the diagonal's first coefficient.
    pub(super) scales: Vec<f64>,
    orders: usize,
}

/// Where it is eliminated in.
struct Work {
    rows: Vec<f64>,
    /// By unknown, the sum of its row of |E|.
    errors: Vec<f64>,
    /// By row below the pivot: its entry, and its factor.
    entries: Vec<Sized>,
    factors: Vec<Sized>,
    /// What each quotient leaves over.
    left_over: Vec<f64>,
    pivot: Sized,
}

/// A series, and the sums of the sizes of its coefficients from each on; beyond the last that is nothing.
#[derive(Clone, Default)]
struct Sized {
    series: Vec<f64>,
    tails: Vec<f64>,
}

impl Sized {
    fn set(&mut self, series: &[f64]) {
        self.series.clear();
        self.series.extend_from_slice(series);
    }

    fn measure(&mut self) {
        self.tails.clear();
        self.tails.resize(self.series.len() + 1, 0.0);
        for (k, c) in self.series.iter().enumerate().rev() {
            self.tails[k] = self.tails[k + 1] + c.abs();
        }
    }

    fn size(&self) -> f64 {
        self.tails[0]
    }

    /// Terms of the product beyond the last order.
    fn left_out(&self, other: &Self) -> f64 {
        let tails = other.tails[1..self.series.len()].iter().rev();
        self.series[1..].iter().zip(tails).map(|(c, tail)| c.abs() * tail).sum()
    }

    fn divide(&mut self, by: &Self) {
        for i in 0..self.series.len() {
            let (known, rest) = self.series.split_at_mut(i + 1);
            known[i] /= by.series[0];
            rest.iter_mut().zip(&by.series[1..]).for_each(|(c, d)| *c -= known[i] * d);
        }
    }

    /// Takes the product with another out of a series.
    fn take_from(&self, other: &Self, target: &mut [f64]) {
        for (i, c) in self.series.iter().enumerate() {
            target[i..].iter_mut().zip(&other.series).for_each(|(sum, d)| *sum -= c * d);
        }
    }
}

impl<'a> Definite<'a> {
    /// Of entries with their rests; `None` where the diagonal does not begin above zero.
    pub(super) fn new(
        plan: &'a Symmetric,
        entries: &[Vec<f64>],
        rests: &[f64],
        orders: usize,
    ) -> Option<Self> {
        let mut rows = vec![0.0; plan.room * orders];
        let mut placed = vec![0.0; plan.room];
        let entries = entries.iter().zip(rests).zip(&plan.places);
        for ((entry, rest), place) in
            entries.filter_map(|(entry, place)| place.map(|place| (entry, place as usize)))
        {
            rows[place * orders..][..entry.len()].copy_from_slice(entry);
            placed[place] = *rest;
        }
        let mut scales = vec![0.0; plan.columns.len()];
        plan.columns
            .iter()
            .for_each(|column| scales[column.unknown] = 1.0 / rows[column.first * orders].sqrt());
        let mut own = Self { plan, rows, rests: placed, scales, orders };
        own.scale();
        own.scales.iter().all(|scale| scale.is_finite() && *scale > 0.0).then_some(own)
    }

    fn scale(&mut self) {
        for column in &self.plan.columns {
            let own = self.scales[column.unknown];
            let unknowns =
                std::iter::once(column.unknown).chain(column.below.iter().map(|row| *row as usize));
            for (place, unknown) in (column.first..).zip(unknowns) {
                let by = own * self.scales[unknown];
                self.rows[place * self.orders..][..self.orders].iter_mut().for_each(|c| *c *= by);
                self.rests[place] *= by;
            }
        }
    }

    /// A lower bound of the eigenvalues, by a guess of the least of them.
    pub(super) fn least_eigenvalue(&self, guess: f64) -> Option<f64> {
        let bounds = std::iter::successors(Some(guess * FIRST), |bound| Some(bound * LESS));
        bounds.take(TRIES).find_map(|bound| self.is_above(bound))
    }

    /// What all eigenvalues are above for certain, if they are above `bound` but for what is left out.
    fn is_above(&self, bound: f64) -> Option<f64> {
        let mut work = Work {
            rows: self.rows.clone(),
            errors: self.errors(),
            entries: vec![],
            factors: vec![],
            left_over: vec![],
            pivot: Sized::default(),
        };
        for column in &self.plan.columns {
            work.rows[column.first * self.orders] -= bound;
            self.eliminate(column, &mut work)?;
        }
        let left_out = work.errors.into_iter().fold(0.0, f64::max);
        (left_out <= LEFT_OUT * bound).then_some(bound - left_out)
    }

    /// What the entries themselves are off by, by unknown.
    fn errors(&self) -> Vec<f64> {
        let mut errors = vec![0.0; self.plan.columns.len()];
        let off = |place: usize| {
            self.rests[place] + self.rounding() * self.row(place).iter().map(|c| c.abs()).sum::<f64>()
        };
        for column in &self.plan.columns {
            errors[column.unknown] += off(column.first);
            for (place, row) in column.entries().zip(&column.below) {
                errors[column.unknown] += off(place);
                errors[*row as usize] += off(place);
            }
        }
        errors
    }

    fn row(&self, place: usize) -> &[f64] {
        &self.rows[place * self.orders..][..self.orders]
    }

    /// Rounding errors of a sum of products, in units of the sum of their sizes.
    fn rounding(&self) -> f64 {
        (self.orders + 2) as f64 * f64::EPSILON
    }

    /// Takes an unknown out of the rows below; `None` where its pivot may not be positive.
    fn eliminate(&self, column: &Column, work: &mut Work) -> Option<()> {
        work.pivot.set(&work.rows[column.first * self.orders..][..self.orders]);
        if !(work.pivot.series[0] > 0.0 && least(work.pivot.series.iter().copied()) > 0.0) {
            return None;
        }
        work.pivot.measure();
        self.divide(column, work);
        let mut targets = column.targets.iter();
        for early in 0..column.below.len() {
            for late in early..column.below.len() {
                let target = *targets.next()? as usize * self.orders;
                let off = self.take(
                    &mut work.rows[target..][..self.orders],
                    &work.factors[late],
                    &work.entries[early],
                );
                let off = off + work.factors[late].size() * work.left_over[early];
                work.errors[column.below[early] as usize] += off;
                if late > early {
                    work.errors[column.below[late] as usize] += off;
                }
            }
        }
        Some(())
    }

    /// Finds the factors of the rows below.
    fn divide(&self, column: &Column, work: &mut Work) {
        let Work { rows, errors, entries, factors, left_over, pivot } = work;
        let count = column.below.len();
        for all in [&mut *entries, &mut *factors] {
            all.resize_with(all.len().max(count), Sized::default);
        }
        left_over.clear();
        let both = entries.iter_mut().zip(factors);
        for (((entry, factor), place), row) in both.zip(column.entries()).zip(&column.below) {
            for sized in [&mut *entry, &mut *factor] {
                sized.set(&rows[place * self.orders..][..self.orders]);
            }
            factor.divide(pivot);
            entry.measure();
            factor.measure();
            let off =
                factor.left_out(pivot) + self.rounding() * (factor.size() * pivot.size() + entry.size());
            left_over.push(off);
            errors[column.unknown] += off;
            errors[*row as usize] += off;
        }
    }

    /// Takes the product of a factor and an entry out of a row; what that leaves out.
    fn take(&self, target: &mut [f64], factor: &Sized, entry: &Sized) -> f64 {
        factor.take_from(entry, target);
        let size: f64 = target.iter().map(|c| c.abs()).sum();
        factor.left_out(entry) + self.rounding() * (factor.size() * entry.size() + size)
    }
}
