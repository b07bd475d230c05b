//! Triangular factors of a matrix with few entries, and solutions by them.
//!
//! Rows are exchanged for the largest pivot in proportion to the row, so that the units of a row do not matter. A matrix that is
//! singular within rounding has factors that are no numbers, and so are all its solutions.

mod known;
mod plan;
mod symmetric;

pub(crate) use plan::Plan;
use plan::Step;
pub(crate) use symmetric::{Column, Symmetric};

use crate::Lanewise;

/// A pivot of at most this many rounding errors (for each row) of what it was computed from is none: changing entries in their
/// last digits makes the matrix singular, and a solution would have no digit right.
const LOST: f64 = f64::EPSILON;

/// A number, and the sizes of what it was computed from: its rounding error is some ulps of them.
type Sized = [f64; 2];

/// What an elimination is done in, kept to be used again.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace {
    /// Lines of the step, one after the other.
    front: Vec<Sized>,
    /// Lines between steps.
    waiting: Vec<Sized>,
    /// By place, the largest entry of the row that stands there.
    scales: Vec<f64>,
}

impl Plan {
    /// The factors of a matrix of these entries; how large the smallest pivot is beside what it was computed from, 0 where one is lost.
    pub(crate) fn factor(
        &self,
        entry: impl Fn(usize) -> f64,
        space: &mut Workspace,
        factors: &mut [f64],
    ) -> f64 {
        let mut least = if self.is_singular { 0.0 } else { 1.0_f64 };
        space.waiting.resize(self.waiting, [0.0; 2]);
        space.scales.resize(self.n, 0.0);
        for step in &self.steps {
            step.assemble(&entry, space);
            let pivot = step.pivot(space);
            step.exchange(pivot, space);
            least = least.min(step.keep(self.n as f64 * LOST, space));
            step.eliminate(space, &mut factors[step.factors..]);
            factors[step.factors] = pivot as f64;
        }
        least
    }

    /// The solution of right sides by row, which are used up, in `x` by column.
    pub(crate) fn substitute<S: Lanewise>(&self, factors: &[S], right: &mut [S], x: &mut [S]) {
        if self.is_singular {
            x.fill(S::splat(f64::NAN));
            return;
        }
        for step in &self.steps {
            step.forward(&factors[step.factors..], right);
        }
        for step in self.steps.iter().rev() {
            step.backward(&factors[step.factors..], right, x);
        }
    }

    /// Factors of the comparison matrices: the sizes of the pivots, and of all else less than nothing.
    pub(crate) fn compared(&self, factors: &[f64]) -> Vec<f64> {
        let mut compared: Vec<f64> = factors.iter().map(|factor| -factor.abs()).collect();
        for step in &self.steps {
            let own = step.factors..step.factors + 2;
            compared[own.clone()].iter_mut().zip(&factors[own]).for_each(|(sized, f)| *sized = f.abs());
        }
        compared
    }
}

impl Step {
    /// Brings the rows together.
    fn assemble(&self, entry: impl Fn(usize) -> f64, space: &mut Workspace) {
        let Workspace { front, waiting, scales } = space;
        let width = self.width();
        front.clear();
        front.resize(self.places.len() * width, [0.0; 2]);
        for own in &self.own {
            let line = &mut front[own.line * width..][..width];
            let mut scale = 0.0_f64;
            for (index, column) in own.entries.clone().zip(&own.columns) {
                let value = entry(index);
                line[*column as usize] = [value, value.abs()];
                scale = scale.max(value.abs());
            }
            scales[self.places[own.line] as usize] = scale;
        }
        for before in &self.inherited {
            let mut numbers = waiting[before.from..].iter();
            for line in &before.lines {
                let line = &mut front[*line as usize * width..][..width];
                before.columns.iter().zip(&mut numbers).for_each(|(column, n)| line[*column as usize] = *n);
            }
        }
    }

    /// The line with the largest pivot for its scale, the first of equals. (Comparisons with NaN fail: it is found later.)
    fn pivot(&self, space: &Workspace) -> usize {
        let weight = |line: usize| {
            space.front[line * self.width()][0].abs() / space.scales[self.places[line] as usize]
        };
        (1..self.places.len()).fold(0, |best, line| if weight(line) > weight(best) { line } else { best })
    }

    /// Puts the line with the pivot first.
    fn exchange(&self, pivot: usize, space: &mut Workspace) {
        if pivot > 0 {
            let (first, rest) = space.front.split_at_mut(self.width());
            first.swap_with_slice(&mut rest[(pivot - 1) * self.width()..][..self.width()]);
            space.scales.swap(self.places[0] as usize, self.places[pivot] as usize);
        }
    }

    /// How large the pivot is beside what it was computed from. One that is lost becomes no number.
    fn keep(&self, lost: f64, space: &mut Workspace) -> f64 {
        let [pivot, size] = &mut space.front[0];
        // Infinite and undefined pivots fail the comparison too.
        let is_kept = pivot.abs() > lost * *size;
        let part = if is_kept { pivot.abs() / *size } else { 0.0 };
        if !is_kept {
            *pivot = f64::NAN;
        }
        part
    }

    fn eliminate(&self, space: &mut Workspace, factors: &mut [f64]) {
        let Workspace { front, waiting, .. } = space;
        let (above, below) = front.split_at(self.width());
        let (upper, lower) = factors[1..].split_at_mut(self.width());
        above.iter().zip(upper).for_each(|([value, _], factor)| *factor = *value);
        let mut left = waiting[self.waits_at..].iter_mut();
        for (line, own) in below.chunks_exact(self.width()).zip(lower) {
            let factor = line[0][0] / above[0][0];
            *own = factor;
            let both = line[1..].iter().zip(&above[1..]);
            for (([value, size], [above, above_size]), left) in both.zip(&mut left) {
                *left = [value - factor * above, size + factor.abs() * above_size];
            }
        }
    }

    /// Takes the unknown out of the right sides of the other lines.
    fn forward<S: Lanewise>(&self, factors: &[S], right: &mut [S]) {
        let chosen = factors[0];
        let first = right[self.places[0] as usize];
        let pivot = S::from_lanes(|lane| right[self.places[chosen.lane(lane) as usize] as usize].lane(lane));
        let others = self.places.iter().enumerate().skip(1).zip(&factors[1 + self.width()..]);
        for ((line, place), factor) in others {
            let place = *place as usize;
            let is_exchanged = |lane: usize| chosen.lane(lane) as usize == line;
            let own =
                S::from_lanes(
                    |lane| {
                        if is_exchanged(lane) { first.lane(lane) } else { right[place].lane(lane) }
                    },
                );
            right[place] = own - *factor * pivot;
        }
        right[self.places[0] as usize] = pivot;
    }

    /// The row of the pivot less the unknowns after it, over the pivot.
    fn backward<S: Lanewise>(&self, factors: &[S], right: &[S], x: &mut [S]) {
        let known = self.right.iter().zip(&factors[2..]);
        let rest = known.fold(right[self.places[0] as usize], |rest, (column, factor)| {
            rest - *factor * x[*column as usize]
        });
        x[self.column] = rest / factors[1];
    }
}

#[cfg(test)]
mod tests;
