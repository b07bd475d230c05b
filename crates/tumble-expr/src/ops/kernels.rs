//! What lengths, quotients that vanish and linear systems are for each kind of scalar.

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
    /// What of a matrix is kept for solving, its own way for each scalar.
    fn factors(series: &Series<'_, Self>, matrix: u32) -> Vec<Self>;
    /// A right side on its way to the unknowns.
    fn forward(series: &Series<'_, Self>, system: u32, row: u32, k: usize) -> Self;
    /// An unknown.
    fn solution(series: &Series<'_, Self>, system: u32, row: u32, k: usize) -> Self;
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
    fn factors(series: &Series<'_, S>, matrix: u32) -> Vec<S> {
        solve::factors(series, matrix)
    }
    fn forward(series: &Series<'_, S>, system: u32, row: u32, k: usize) -> S {
        solve::forward(series, system, row, k)
    }
    fn solution(series: &Series<'_, S>, system: u32, row: u32, k: usize) -> S {
        solve::solution(series, system, row, k)
    }
}
