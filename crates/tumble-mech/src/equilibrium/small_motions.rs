//! Small motions about a pose of equilibrium: whether they stay small, and how fast they are.

use nalgebra::{Complex, ComplexField, DMatrix, DVector};

use super::Linearised;
use crate::product::product;

/// Squares of frequencies below this part of the largest stiffness over its mass are none: rounding leaves a thousandth of it.
const NEUTRAL: f64 = 1e-10;
/// Singular values of the conditions' gradients below this part of the largest add nothing.
const DEPENDENT: f64 = 1e-9;

/// What becomes of small motions.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallMotions {
    /// Frequencies of those that swing, rad/s, from the lowest.
    pub frequencies: Vec<f64>,
    /// Those that grow.
    pub growing: Vec<Growth>,
    /// In how many ways nothing pulls back and nothing drives away, to first order.
    pub neutral: usize,
}

/// A small motion that grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// It grows by a factor of e in the inverse of this, 1/s.
    pub rate: f64,
    /// Frequency with which it swings as it grows, rad/s; 0 where it does not.
    pub frequency: f64,
}

/// In one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// All small motions stay small.
    Stable,
    /// There is a small motion that grows.
    Unstable,
    /// None grows, and in some way nothing pulls back.
    Neutral,
    /// Joints and contacts leave no motion.
    Fixed,
}

impl Stability {
    /// `stable`, `unstable`, `neutral` or `fixed`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Neutral => "neutral",
            Self::Fixed => "fixed",
        }
    }
}

impl SmallMotions {
    /// What they come to, in one word.
    pub fn stability(&self) -> Stability {
        match (self.growing.len(), self.neutral, self.frequencies.len()) {
            (1.., _, _) => Stability::Unstable,
            (0, 1.., _) => Stability::Neutral,
            (0, 0, 0) => Stability::Fixed,
            (0, 0, _) => Stability::Stable,
        }
    }

    pub(crate) fn of(linear: &Linearised) -> Self {
        let free = kernel(linear);
        let across = free.transpose();
        let mass = product(&(&across * DMatrix::from_diagonal(&linear.mass)), &free);
        let stiffness = -product(&product(&across, &linear.stiffness), &free);
        let mut found = Self { frequencies: vec![], growing: vec![], neutral: 0 };
        let Some(factor) = mass.cholesky().map(|factors| factors.l()) else {
            found.neutral = free.ncols();
            return found;
        };
        let scaled = factor.solve_lower_triangular(&stiffness).map(|part| part.transpose());
        let scaled = scaled.and_then(|part| factor.solve_lower_triangular(&part)).unwrap_or(stiffness);
        let (unit, _) = linear.units();
        let size = (DMatrix::from_diagonal(&unit) * &linear.stiffness * DMatrix::from_diagonal(&unit)).amax();
        for square in squares(scaled, size) {
            found.sort_in(square, size);
        }
        found.frequencies.sort_by(f64::total_cmp);
        found.growing.sort_by(|a, b| b.rate.total_cmp(&a.rate));
        found
    }

    /// A motion as exp(i w t), by w^2.
    fn sort_in(&mut self, square: Complex<f64>, size: f64) {
        let none = NEUTRAL * size;
        if ComplexField::modulus(square) <= none {
            self.neutral += 1;
        } else if square.im.abs() <= none && square.re > 0.0 {
            self.frequencies.push(libm::sqrt(square.re));
        } else {
            let root = ComplexField::sqrt(square);
            self.growing.push(Growth {
                rate: root.im.abs(),
                frequency: if square.im.abs() > none { root.re } else { 0.0 },
            });
        }
    }
}

/// Eigenvalues; real ones where forces come from an energy, but for rounding.
fn squares(matrix: DMatrix<f64>, size: f64) -> Vec<Complex<f64>> {
    if matrix.ncols() == 0 || matrix.iter().any(|value| !value.is_finite()) {
        return vec![];
    }
    let turned = (&matrix - matrix.transpose()).amax();
    match turned <= NEUTRAL * size {
        true => {
            let even = (&matrix + matrix.transpose()) / 2.0;
            even.symmetric_eigenvalues().iter().map(|value| Complex::new(*value, 0.0)).collect()
        }
        false => matrix.complex_eigenvalues().iter().copied().collect(),
    }
}

/// Ways to move that all conditions leave, in units in which masses are one.
fn kernel(linear: &Linearised) -> DMatrix<f64> {
    let n = linear.mass.len();
    let (unit, size) = linear.units();
    let rows = DMatrix::from_diagonal(&size) * &linear.gradient * DMatrix::from_diagonal(&unit);
    let mut kept: Vec<DVector<f64>> = vec![];
    let mut free = vec![];
    let conditions = rows.row_iter().map(|row| row.transpose());
    let axes = (0..n).map(|axis| DVector::from_fn(n, |place, _| f64::from(u8::from(place == axis))));
    for (index, whole) in conditions.chain(axes).enumerate() {
        let mut rest = whole.clone();
        for _ in 0..2 {
            kept.iter().for_each(|other| rest.axpy(-other.dot(&rest), other, 1.0));
        }
        if rest.norm() > DEPENDENT * whole.norm() {
            rest.normalize_mut();
            kept.push(rest.clone());
            if index >= rows.nrows() {
                free.push(unit.component_mul(&rest));
            }
        }
    }
    if free.is_empty() { DMatrix::zeros(n, 0) } else { DMatrix::from_columns(&free) }
}
