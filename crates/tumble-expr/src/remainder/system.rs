//! How far the series of the unknowns of a linear system are from its solution, along a step.
//!
//! With X the series of the unknowns, what they leave over, `r = b - A X`, begins beyond the order, and `A (x - X) = r`. About the
//! middle of a part of the step, where A is A_m and C its inverse, any d with
//!
//! ```text
//! |C| (|r| + D d) <= d
//! ```
//!
//! entry by entry bounds `|x - X|`, with D what A changes by within the part. Parts are halved until
//! there is one. A large matrix, as that of a long chain, soon changes by more than its inverse bears: forces along a chain turn with
//! it. One that is symmetric is therefore seen to be positive along the whole step ([`definite`](super::definite)), and what its errors are
//! follows from its least eigenvalue. Source: Rump, Verification methods, Acta Numerica 19 (2010), section 10.

use super::definite::Definite;
use super::inverse::Inverse;
use super::{ROUNDING, Remainders};
use crate::Stage;
use crate::ops::Slot;
use crate::ops::amplified::{Amplifier, bits, is_small};
use crate::ops::elimination::Workspace;
use crate::ops::solve::{Matrix, System};

/// Halvings of a step before it is given up: a matrix that changes by much within a tenth of a step has no bound worth its cost.
const MOST_PARTS: usize = 16;
/// Where in a step its least eigenvalue is guessed, after so many steps of inverse iteration.
const MIDDLE: f64 = 0.5;
const GUESSES: usize = 6;
/// What rounding makes of the unknowns elsewhere in a step is no more than so many times that in the middle.
const BETWEEN: f64 = 2.0;
/// Rounding of a Euclidean norm.
const ROUNDED: f64 = 1.0 + 1e-9;

/// What the unknowns leave over, by row.
struct Left {
    /// Beyond the order.
    orders: Vec<f64>,
    /// By rounding, which knows nothing of other rows.
    rounding: Vec<f64>,
}

/// What a large system leaves out but for rounding, by row, and bounds of what that makes of its unknowns.
#[derive(Clone, Debug, Default)]
pub(super) struct LeftOut {
    rows: Vec<f64>,
    bounds: Option<Vec<f64>>,
}

impl Left {
    fn len(&self) -> usize {
        self.orders.len()
    }
}

/// The matrix of a system along a step.
struct Along<'a> {
    matrix: &'a Matrix,
    /// By entry, the coefficients times powers of the step's length; short where the entry does not change.
    entries: Vec<Vec<f64>>,
    /// How fast each changes at most, over the step's length.
    slopes: Vec<f64>,
    /// How far each series is from its entry.
    rests: Vec<f64>,
    /// How many coefficients there are, at most.
    orders: usize,
}

impl super::Along<'_> {
    /// Bounds of all unknowns of a system, which are found together.
    pub(super) fn unknowns(&mut self, system: u32) {
        let tape = self.jets.tape().clone();
        let number = system as usize;
        let system = &tape.systems[number];
        let matrix = &tape.matrices[system.matrix as usize];
        let left = self.left_over(system, matrix);
        let along = self.matrix(matrix);
        let bounds = match matrix.symmetric.is_some() {
            true => self.of_large(number, &left, &along),
            // Steps that follow each other are much alike.
            false => along.bounds(&left, &mut self.found.parts).or_else(|| along.by_inverse(&left)),
        };
        let bounds = bounds.unwrap_or_else(|| vec![f64::INFINITY; system.right.len()]);
        self.found.rests[system.unknowns as usize..][..bounds.len()].copy_from_slice(&bounds);
    }

    /// Those of a large symmetric matrix: what is left out by its least eigenvalue, which is found without rounding and kept, and what
    /// rounding is likely to make of it by the matrix in the middle. One that is not positive is looked at as others are.
    fn of_large(&mut self, system: usize, left: &Left, matrix: &Along<'_>) -> Option<Vec<f64>> {
        let Remainders { left_out: known, parts, .. } = &mut *self.found;
        if self.rounding == 0.0 {
            known.resize_with(known.len().max(system + 1), Default::default);
            let bounds = matrix.by_eigenvalue(&left.orders);
            known[system] = LeftOut { rows: left.orders.clone(), bounds: bounds.clone() };
            return bounds;
        }
        let LeftOut { rows, bounds } = std::mem::take(&mut known[system]);
        let Some(mut bounds) = bounds else { return matrix.bounds(left, parts) };
        let by_rounding = left.rounding.iter().zip(left.orders.iter().zip(&rows));
        let by_rounding: Vec<f64> =
            by_rounding.map(|(own, (all, left_out))| own + (all - left_out)).collect();
        let likely = matrix.likely(&by_rounding)?;
        bounds.iter_mut().zip(likely).for_each(|(bound, likely)| *bound += BETWEEN * likely);
        Some(bounds)
    }

    /// What the unknowns leave over of each row.
    fn left_over(&mut self, system: &System, matrix: &Matrix) -> Left {
        let row = |row: usize| {
            let right = system.right[row];
            let (mut left, mut rounding) = (self.rest(right), self.rounding * self.size(right));
            for (entry, column) in matrix.shape.entries_of(row) {
                let entry = matrix.entries[entry];
                let (size, unknown) = (self.size(entry), system.unknowns + column as Slot);
                let most = self.size(unknown);
                left += self.rest(entry) * most;
                rounding += self.rounding * size * most;
                if self.jets.tape().stage(entry) == Stage::Varying {
                    left += self.left_out(entry, unknown);
                }
            }
            (left + f64::MIN_POSITIVE, rounding)
        };
        let (orders, rounding) = (0..matrix.shape.size()).map(row).unzip();
        Left { orders, rounding }
    }

    fn matrix<'a>(&self, matrix: &'a Matrix) -> Along<'a> {
        let powers = &self.found.powers[..=self.order];
        let series = |entry: &Slot| -> Vec<f64> {
            let row = self.arena().row(*entry);
            match self.jets.tape().stage(*entry) == Stage::Varying {
                true => row.iter().zip(powers).map(|(c, power)| c * power).collect(),
                false => vec![row[0]],
            }
        };
        let entries: Vec<Vec<f64>> = matrix.entries.iter().map(series).collect();
        let slope = |row: &Vec<f64>| row.iter().enumerate().map(|(k, c)| k as f64 * c.abs()).sum();
        let slopes = entries.iter().map(slope).collect();
        let rests = matrix.entries.iter().map(|entry| self.rest(*entry)).collect();
        Along { matrix, entries, slopes, rests, orders: self.order + 1 }
    }
}

impl Along<'_> {
    /// Bounds of the errors by what is left over of each row. `known` is in how many parts there was one before.
    fn bounds(&self, left: &Left, known: &mut usize) -> Option<Vec<f64>> {
        let worst = |all: &[Vec<f64>]| -> Vec<f64> {
            (0..left.len()).map(|i| all.iter().map(|bounds| bounds[i]).fold(0.0, f64::max)).collect()
        };
        let mut parts = (*known / 2).max(1);
        while parts <= MOST_PARTS {
            let all: Option<Vec<Vec<f64>>> = (0..parts).map(|part| self.within(left, part, parts)).collect();
            if let Some(all) = all {
                *known = parts;
                return Some(worst(&all));
            }
            parts *= 2;
        }
        None
    }

    /// Those of a large matrix that is positive along the step.
    fn by_eigenvalue(&self, left_out: &[f64]) -> Option<Vec<f64>> {
        let plan = self.matrix.symmetric.as_ref()?;
        let definite = Definite::new(plan, &self.entries, &self.rests, self.orders)?;
        let (_, factors) = self.factored(MIDDLE)?;
        let inverse = Amplifier { plan: &self.matrix.plan, factors: &factors };
        let scales = &definite.scales;
        let least = definite.least_eigenvalue(guess(&inverse, scales))?;
        let squares: f64 =
            left_out.iter().zip(scales).map(|(own, scale)| (own * scale) * (own * scale)).sum();
        let error = ROUNDED * squares.sqrt() / least;
        Some(scales.iter().map(|scale| scale * error).collect())
    }

    /// Those of a small one by the series of its inverse, where it changes by more than its inverse at one place bears.
    fn by_inverse(&self, left: &Left) -> Option<Vec<f64>> {
        let (n, shape) = (left.len(), &self.matrix.shape);
        if !is_small(n) {
            return None;
        }
        let (_, factors) = self.factored(0.0)?;
        let start = Amplifier { plan: &self.matrix.plan, factors: &factors };
        let mut first = vec![0.0; n * n];
        for (column, own) in start.columns(&vec![1.0; n]).enumerate() {
            own.into_iter().enumerate().for_each(|(row, c)| first[row * n + column] = c);
        }
        let mut rests = vec![0.0; n * n];
        let mut matrix = vec![vec![0.0; n * n]; self.orders];
        for row in 0..n {
            for (entry, column) in shape.entries_of(row) {
                rests[row * n + column] = self.rests[entry];
                let series = self.entries[entry].iter().enumerate();
                series.for_each(|(k, c)| matrix[k][row * n + column] = *c);
            }
        }
        let both: Vec<f64> = left.orders.iter().zip(&left.rounding).map(|(own, more)| own + more).collect();
        Inverse::of(&matrix, &rests, first)?.bounds(&both)
    }

    /// What errors that know nothing of each other add up to in the middle of the step.
    fn likely(&self, errors: &[f64]) -> Option<Vec<f64>> {
        let (_, factors) = self.factored(MIDDLE)?;
        Some(Amplifier { plan: &self.matrix.plan, factors: &factors }.likely(errors))
    }

    /// Those within one of so many equal parts.
    fn within(&self, left: &Left, part: usize, parts: usize) -> Option<Vec<f64>> {
        let half = 0.5 / parts as f64;
        let (middle, factors) = self.factored((2 * part + 1) as f64 * half)?;
        let Matrix { shape, plan, .. } = self.matrix;
        let rounding = left.len() as f64 * ROUNDING;
        let off = |of: usize| self.slopes[of] * half + self.rests[of] + rounding * middle[of].abs();
        let change = |bounds: &[f64]| -> Vec<f64> {
            let row = |row: usize| shape.entries_of(row).map(|(of, column)| off(of) * bounds[column]).sum();
            (0..bounds.len()).map(row).collect()
        };
        let both: Vec<f64> = left.orders.iter().zip(&left.rounding).map(|(own, more)| own + more).collect();
        Amplifier { plan, factors: &factors }.enclosed(&both, change)
    }

    /// The matrix at a place, and its factors; `None` where it is singular.
    fn factored(&self, place: f64) -> Option<(Vec<f64>, Vec<f64>)> {
        let value = |series: &Vec<f64>| series.iter().rev().fold(0.0, |sum, c| sum * place + c);
        let entries: Vec<f64> = self.entries.iter().map(value).collect();
        let plan = &self.matrix.plan;
        let mut factors = vec![0.0; plan.room];
        let least = plan.factor(|entry| entries[entry], &mut Workspace::default(), &mut factors);
        (least > 0.0).then_some((entries, factors))
    }
}

/// About the least eigenvalue of the matrix, scaled.
fn guess(inverse: &Amplifier<'_>, scales: &[f64]) -> f64 {
    let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let sign = |row: usize| if bits(row) >> 63 == 1 { -1.0 } else { 1.0 };
    let mut x: Vec<f64> = (0..scales.len()).map(sign).collect();
    for _ in 0..GUESSES {
        let size = norm(&x);
        let right = x.iter().zip(scales).map(|(x, scale)| x / (size * scale)).collect();
        x = inverse.solve(right);
        x.iter_mut().zip(scales).for_each(|(x, scale)| *x /= scale);
    }
    1.0 / norm(&x)
}
