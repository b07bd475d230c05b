//! Lengths, quotients that vanish and linear systems with their rounding errors; of order 0 only.

use super::amplified::Amplifier;
use super::kernels::Kernels;
use super::solve::{Bench, Matrix, System};
use super::{Series, Slot};
use crate::Scalar;
use crate::scalar::{Inexact, RoundingError};

impl<E: RoundingError> Kernels for Inexact<E> {
    fn norm(series: &Series<'_, Self>, parts: u32) -> Self {
        let parts = series.tape.norms[parts as usize].iter().map(|part| series.first(*part));
        let value = parts.clone().map(|part| part.value).fold(0.0, libm::hypot);
        let error = E::of_length(value, parts);
        Self { value, error: if error.is_none() && value == 0.0 { error } else { error.rounded(value) } }
    }

    fn norm_coefficient(_: &Series<'_, Self>, _: u32, _: (Slot, Self), _: usize) -> Self {
        Self::zero()
    }

    fn square_over(series: &Series<'_, Self>, (of, by, _): (Slot, Slot, u32)) -> Self {
        let (a, b) = (series.first(of), series.first(by));
        if a.value == 0.0 && b.value == 0.0 { Self::zero() } else { a * a / b }
    }

    fn square_over_coefficient(_: &Series<'_, Self>, _: (Slot, Slot, u32), _: &[Self], _: usize) -> Self {
        Self::zero()
    }

    fn factor(series: &Series<'_, Self>, matrix: &Matrix, bench: &mut Bench<Self>, factors: &mut [Self]) {
        let Bench { numbers, lanes, .. } = bench;
        lanes.resize(factors.len(), 0.0);
        matrix.plan.factor(|entry| series.first(matrix.entries[entry]).value, numbers, lanes);
        factors.iter_mut().zip(lanes).for_each(|(factor, value)| *factor = Self::splat(*value));
    }

    /// Off by `A^-1` times what the right sides and the matrix are off by.
    fn solve(series: &Series<'_, Self>, system: &System, Bench { right, x, .. }: &mut Bench<Self>) {
        let Matrix { shape, entries, plan, .. } = series.matrix(system);
        let factors: Vec<f64> = series.factors_of(system).iter().map(|factor| factor.value).collect();
        let inverse = Amplifier { plan, factors: &factors };
        let found = inverse.solve(right.iter().map(|right| right.value).collect());
        let off = |row: usize| {
            let by_matrix = shape.entries_of(row).map(|(entry, column)| {
                let entry = series.first(entries[entry]);
                entry.error.rounded(entry.value).times(-found[column])
            });
            right[row].error.and(by_matrix.fold(E::NONE, E::and))
        };
        let rows = (0..right.len()).map(off).collect();
        let errors = E::of_unknowns(rows, |rows| inverse.solve(rows), |rows| inverse.likely(rows));
        let both = found.iter().zip(errors).map(|(value, error)| Self { value: *value, error });
        x.iter_mut().zip(both).for_each(|(x, found)| *x = found);
    }
}
