//! What lengths, quotients that vanish and linear systems are for each kind of scalar.

use super::solve::{Bench, Matrix, System};
use super::{Series, Slot, norm, solve, square_over};
use crate::{Lanewise, Scalar};

/// Operations that one scalar does in another way than the others: all else is arithmetic.
pub trait Kernels: Scalar {
    /// Length of a vector.
    fn norm(series: &Series<'_, Self>, parts: u32) -> Self;
    /// Its coefficient of an order above 0; `found` is its slot, and the coefficient of its square.
    fn norm_coefficient(series: &Series<'_, Self>, parts: u32, found: (Slot, Self), k: usize) -> Self;
    /// `a^2 / b` that may vanish.
    fn square_over(series: &Series<'_, Self>, which: (Slot, Slot, u32)) -> Self;
    /// Its coefficient of an order above 0.
    fn square_over_coefficient(
        series: &Series<'_, Self>,
        which: (Slot, Slot, u32),
        c: &[Self],
        k: usize,
    ) -> Self;
    /// Factors of a matrix, its own way for each scalar.
    fn factor(series: &Series<'_, Self>, matrix: &Matrix, bench: &mut Bench<Self>, factors: &mut [Self]);
    /// The unknowns of a system, `x`, by its right sides of an order.
    fn solve(series: &Series<'_, Self>, system: &System, bench: &mut Bench<Self>);
}

impl<S: Lanewise> Kernels for S {
    fn norm(series: &Series<'_, S>, parts: u32) -> S {
        norm::value(series, parts)
    }
    fn norm_coefficient(series: &Series<'_, S>, parts: u32, found: (Slot, S), k: usize) -> S {
        norm::coefficient(series, parts, found, k)
    }
    fn square_over(series: &Series<'_, S>, (of, by, vanishing): (Slot, Slot, u32)) -> S {
        square_over::value(series, of, by, vanishing)
    }
    fn square_over_coefficient(series: &Series<'_, S>, which: (Slot, Slot, u32), c: &[S], k: usize) -> S {
        square_over::coefficient(series, which, c, k)
    }
    fn factor(series: &Series<'_, S>, matrix: &Matrix, bench: &mut Bench<S>, factors: &mut [S]) {
        solve::factor(series, matrix, bench, factors);
    }
    fn solve(series: &Series<'_, S>, system: &System, Bench { right, x, .. }: &mut Bench<S>) {
        series.matrix(system).plan.substitute(series.factors_of(system), right, x);
    }
}
