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
//! it. Then `|A^-1| |r|` is found at some places of the step; that is no proof between them. Source: Rump, Verification methods, Acta Numerica 19 (2010), section 10.

use super::ROUNDING;
use crate::Stage;
use crate::ops::Slot;
use crate::ops::amplified::{Amplifier, is_small};
use crate::ops::elimination::Workspace;
use crate::ops::solve::{Matrix, System};

/// Halvings of a step before it is given up: a matrix that changes by much within a tenth of a step has no bound worth its cost.
const MOST_PARTS: usize = 16;
/// Places along a step, in parts of it, where a large matrix is looked at, and how many times larger bounds may be between them.
const PLACES: [f64; 3] = [0.0, 0.5, 1.0];
const BETWEEN: f64 = 2.0;

/// What the unknowns leave over, by row.
struct Left {
    /// Beyond the order.
    orders: Vec<f64>,
    /// By rounding, which knows nothing of other rows.
    rounding: Vec<f64>,
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
}

impl super::Along<'_> {
    /// Bounds of all unknowns of a system, which are found together.
    pub(super) fn unknowns(&mut self, system: u32) {
        let tape = self.jets.tape().clone();
        let system = &tape.systems[system as usize];
        let matrix = &tape.matrices[system.matrix as usize];
        let left = self.left_over(system, matrix);
        let matrix = self.matrix(matrix);
        // Steps that follow each other are much alike.
        let bounds = matrix.bounds(&left, &mut self.found.parts);
        let bounds = bounds.unwrap_or_else(|| vec![f64::INFINITY; left.len()]);
        self.found.rests[system.unknowns as usize..][..left.len()].copy_from_slice(&bounds);
    }

    /// What the unknowns leave over of each row.
    fn left_over(&mut self, system: &System, matrix: &Matrix) -> Left {
        let row = |row: usize| {
            let right = system.right[row];
            let (mut left, mut rounding) = (self.rest(right), ROUNDING * self.size(right));
            for (entry, column) in matrix.shape.entries_of(row) {
                let entry = matrix.entries[entry];
                let (size, unknown) = (self.size(entry), system.unknowns + column as Slot);
                let most = self.size(unknown);
                left += self.rest(entry) * most;
                rounding += ROUNDING * size * most;
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
        Along { matrix, entries, slopes, rests }
    }
}

impl Along<'_> {
    /// Bounds of the errors by what is left over of each row. `known` is in how many parts there was one before.
    fn bounds(&self, left: &Left, known: &mut usize) -> Option<Vec<f64>> {
        let worst = |all: &[Vec<f64>]| -> Vec<f64> {
            (0..left.len()).map(|i| all.iter().map(|bounds| bounds[i]).fold(0.0, f64::max)).collect()
        };
        if !is_small(left.len()) {
            let all: Option<Vec<Vec<f64>>> = PLACES.iter().map(|place| self.at(left, *place)).collect();
            return Some(worst(&all?).into_iter().map(|bound| BETWEEN * bound).collect());
        }
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

    /// Those at one place.
    fn at(&self, left: &Left, place: f64) -> Option<Vec<f64>> {
        let (_, factors) = self.factored(place)?;
        let inverse = Amplifier { plan: &self.matrix.plan, factors: &factors };
        let both = inverse.most(&left.orders).into_iter().zip(inverse.likely(&left.rounding));
        Some(both.map(|(orders, rounding)| orders + rounding).collect())
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
