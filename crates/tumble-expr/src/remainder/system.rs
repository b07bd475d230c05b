//! How far the series of the unknowns of a linear system are from its solution, along a step.
//!
//! With X the series of the unknowns, what they leave over, `r = b - A X`, begins beyond the order, and `A (x - X) = r`. About the
//! middle of a part of the step, where A is A_m and C about its inverse,
//!
//! ```text
//! |x - X| <= |C| |r| + E |x - X|,   E = |C| D + |1 - C A_m|
//! ```
//!
//! entry by entry, with D what A changes by within the part. Any d > 0 with `|C| |r| + E d <= d` is a bound. Parts are halved until
//! there is one. Source: Rump, Verification methods, Acta Numerica 19 (2010), section 10.

use super::{Along, ROUNDING};
use crate::Stage;
use crate::ops::Slot;
use crate::ops::solve::{System, inverse};

/// Halvings of a step before it is given up: a matrix that changes by much within a tenth of a step has no bound worth its cost.
const MOST_PARTS: usize = 16;
/// How often an error bound is put into itself until it is large enough.
const REPEATS: usize = 12;

/// So much wider than what is put in a bound has to be to hold.
const WIDER: f64 = 1.1;

/// The matrix of a system along a step.
struct Matrix {
    n: usize,
    /// By entry, the coefficients times powers of the step's length; short where the entry does not change.
    entries: Vec<Vec<f64>>,
    /// How fast each changes at most, over the step's length.
    slopes: Vec<f64>,
    /// How far each series is from its entry.
    rests: Vec<f64>,
}

impl Along<'_> {
    /// Bounds of all unknowns of a system, which are found together.
    pub(super) fn unknowns(&mut self, system: u32) {
        let tape = self.jets.tape().clone();
        let system = &tape.systems[system as usize];
        let entries = &tape.matrices[system.matrix as usize].entries;
        let left = self.left_over(system, entries);
        let matrix = self.matrix(system.n, entries);
        // Steps that follow each other are much alike.
        let bounds = matrix.bounds(&left, &mut self.found.parts);
        for row in 0..system.n {
            let bound = bounds.as_ref().map_or(f64::INFINITY, |bounds| bounds[row]);
            self.found.rests[system.solution as usize - row] = bound;
        }
    }

    /// What the unknowns leave over of each row.
    fn left_over(&mut self, system: &System, entries: &[Slot]) -> Vec<f64> {
        let row = |row: usize| {
            let right = system.right[row];
            let mut left = self.rest(right) + ROUNDING * self.size(right);
            for (column, &entry) in entries[row * system.n..][..system.n].iter().enumerate() {
                let (size, unknown) = (self.size(entry), system.solution - column as Slot);
                if size == 0.0 {
                    continue;
                }
                let most = self.size(unknown);
                left += (self.rest(entry) + ROUNDING * size) * most;
                if self.jets.tape().stage(entry) == Stage::Varying {
                    left += self.left_out(entry, unknown);
                }
            }
            left + f64::MIN_POSITIVE
        };
        (0..system.n).map(row).collect()
    }

    fn matrix(&mut self, n: usize, entries: &[Slot]) -> Matrix {
        let powers = &self.found.powers[..=self.order];
        let series = |entry: &Slot| -> Vec<f64> {
            let row = self.arena().row(*entry);
            match self.jets.tape().stage(*entry) == Stage::Varying {
                true => row.iter().zip(powers).map(|(c, power)| c * power).collect(),
                false => vec![row[0]],
            }
        };
        let series: Vec<Vec<f64>> = entries.iter().map(series).collect();
        let slope = |row: &Vec<f64>| row.iter().enumerate().map(|(k, c)| k as f64 * c.abs()).sum();
        let slopes = series.iter().map(slope).collect();
        let rests = entries.iter().map(|entry| self.rest(*entry)).collect();
        Matrix { n, entries: series, slopes, rests }
    }
}

impl Matrix {
    /// Bounds of the errors by what is left over of each row. `known` is in how many parts there was one before.
    fn bounds(&self, left: &[f64], known: &mut usize) -> Option<Vec<f64>> {
        let mut parts = (*known / 2).max(1);
        while parts <= MOST_PARTS {
            let all: Option<Vec<Vec<f64>>> = (0..parts).map(|part| self.within(left, part, parts)).collect();
            if let Some(all) = all {
                *known = parts;
                let worst = |i: usize| all.iter().map(|bounds| bounds[i]).fold(0.0, f64::max);
                return Some((0..self.n).map(worst).collect());
            }
            parts *= 2;
        }
        None
    }

    /// Those within one of so many equal parts.
    fn within(&self, left: &[f64], part: usize, parts: usize) -> Option<Vec<f64>> {
        let n = self.n;
        let half = 0.5 / parts as f64;
        let place = (2 * part + 1) as f64 * half;
        let value = |series: &Vec<f64>| series.iter().rev().fold(0.0, |sum, c| sum * place + c);
        let middle: Vec<f64> = self.entries.iter().map(value).collect();
        let solver = inverse(n, middle.clone());
        if solver.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        let first: Vec<f64> =
            (0..n).map(|i| (0..n).map(|j| solver[i * n + j].abs() * left[j]).sum()).collect();
        // Most entries are zero: bodies have few neighbours.
        let column = |j: usize| {
            let entry = |k: usize| {
                let (index, a) = (k * n + j, middle[k * n + j]);
                let off = self.slopes[index] * half + self.rests[index] + n as f64 * ROUNDING * a.abs();
                (a != 0.0 || off != 0.0).then_some((k, a, off))
            };
            (0..n).filter_map(entry).collect::<Vec<_>>()
        };
        let columns: Vec<Vec<(usize, f64, f64)>> = (0..n).map(column).collect();
        let change = |i: usize, j: usize| {
            let mut sum = if i == j { -1.0 } else { 0.0 };
            let mut rest = ROUNDING;
            for (k, a, off) in &columns[j] {
                let c = solver[i * n + k];
                sum += c * a;
                rest += c.abs() * off;
            }
            sum.abs() + rest
        };
        let changes: Vec<f64> = (0..n * n).map(|index| change(index / n, index % n)).collect();
        let again = |bounds: &[f64], i: usize| {
            first[i]
                + changes[i * n..][..n].iter().zip(bounds).map(|(change, bound)| change * bound).sum::<f64>()
        };
        let mut bounds = first.clone();
        for _ in 0..REPEATS {
            let next: Vec<f64> = (0..n).map(|i| WIDER * again(&bounds, i)).collect();
            if (0..n).all(|i| again(&next, i) <= next[i]) {
                return Some(next);
            }
            bounds = (0..n).map(|i| again(&bounds, i)).collect();
        }
        None
    }
}
