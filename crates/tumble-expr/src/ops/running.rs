//! Lengths, quotients that vanish and linear systems with their rounding errors; of order 0 only.

use super::kernels::Kernels;
use super::solve::{factors_of, inverse};
use super::{Series, Slot};
use crate::{Rounded, Scalar};

type Errors<'a> = Series<'a, Rounded>;

impl Kernels for Rounded {
    fn norm(series: &Errors<'_>, parts: u32) -> Self {
        let parts = series.tape.norms[parts as usize].iter().map(|part| series.first(*part));
        let hypot = |of: fn(&Self) -> f64| parts.clone().map(|part| of(&part)).fold(0.0, libm::hypot);
        let value = hypot(|part| part.value);
        let error = hypot(|part| part.error);
        Self { value, error: error + if error == 0.0 && value == 0.0 { 0.0 } else { value } }
    }

    fn norm_coefficient(_: &Errors<'_>, _: u32, _: (Slot, Self), _: usize) -> Self {
        Self::zero()
    }

    fn square_over(series: &Errors<'_>, (of, by, _): (Slot, Slot, u32)) -> Self {
        let (a, b) = (series.first(of), series.first(by));
        if a.value == 0.0 && b.value == 0.0 { Self::zero() } else { a * a / b }
    }

    fn square_over_coefficient(_: &Errors<'_>, _: (Slot, Slot, u32), _: &[Self], _: usize) -> Self {
        Self::zero()
    }

    /// The inverse, then the entries of the matrix.
    fn factors(series: &Errors<'_>, matrix: u32) -> Vec<Self> {
        let matrix = &series.tape.matrices[matrix as usize];
        let entries: Vec<Self> = matrix.entries.iter().map(|entry| series.first(*entry)).collect();
        let inverse = inverse(matrix.n, entries.iter().map(|entry| entry.value).collect());
        let mut all: Vec<Self> = inverse.into_iter().map(Self::splat).chain(entries).collect();
        all.resize(matrix.room(), Self::zero());
        all
    }

    fn forward(series: &Errors<'_>, system: u32, row: u32, k: usize) -> Self {
        series.of(series.tape.systems[system as usize].residuals[row as usize])[k]
    }

    /// `x = C r`, off by `|C|` times what r and the matrix are off by.
    fn solution(series: &Errors<'_>, system: u32, row: u32, k: usize) -> Self {
        let system = &series.tape.systems[system as usize];
        let (n, factors) = (system.n, factors_of(series, system));
        let right = |j: usize| series.of(system.forward + j as Slot)[k];
        let unknown = |i: usize| (0..n).map(|j| factors[i * n + j].value * right(j).value).sum::<f64>();
        let x: Vec<f64> = (0..n).map(unknown).collect();
        let off = |j: usize| {
            let row = factors[n * n + j * n..][..n].iter().zip(&x);
            let by_matrix: f64 = row.map(|(entry, x)| (entry.error + entry.value.abs()) * x.abs()).sum();
            right(j).error + by_matrix
        };
        let row = row as usize;
        let error = (0..n).map(|j| factors[row * n + j].value.abs() * off(j)).sum();
        Self { value: x[row], error }
    }
}
