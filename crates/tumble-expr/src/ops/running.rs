//! Lengths, quotients that vanish and linear systems with their rounding errors; of order 0 only.

use super::amplified::Amplifier;
use super::kernels::Kernels;
use super::solve::{Bench, Matrix, System};
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

    fn factor(series: &Errors<'_>, matrix: &Matrix, bench: &mut Bench<Self>, factors: &mut [Self]) {
        let Bench { numbers, lanes, .. } = bench;
        lanes.resize(factors.len(), 0.0);
        matrix.plan.factor(|entry| series.first(matrix.entries[entry]).value, numbers, lanes);
        factors.iter_mut().zip(lanes).for_each(|(factor, value)| *factor = Self::splat(*value));
    }

    /// Off by `|A^-1|` times what the right sides and the matrix are off by.
    fn solve(series: &Errors<'_>, system: &System, Bench { right, x, .. }: &mut Bench<Self>) {
        let Matrix { shape, entries, plan, .. } = series.matrix(system);
        let factors: Vec<f64> = series.factors_of(system).iter().map(|factor| factor.value).collect();
        let inverse = Amplifier { plan, factors: &factors };
        let found = inverse.solve(right.iter().map(|right| right.value).collect());
        let off = |row: usize| {
            let by_matrix = shape.entries_of(row).map(|(entry, column)| {
                let entry = series.first(entries[entry]);
                (entry.error + entry.value.abs()) * found[column].abs()
            });
            right[row].error + by_matrix.sum::<f64>()
        };
        let errors = inverse.likely(&(0..right.len()).map(off).collect::<Vec<_>>());
        let both = found.iter().zip(errors).map(|(value, error)| Self { value: *value, error });
        x.iter_mut().zip(both).for_each(|(x, found)| *x = found);
    }
}
