//! Rows as numbers, at one state of a mode after the other.

use std::sync::Arc;

use nalgebra::DVector;
use tumble_expr::{Branches, Jets, Rounded};
use tumble_ode::Reason;

use crate::assembly::Rows;
use crate::equations::Equations;
use crate::link::{InstantTape, Measured, RowOf};
use crate::mode::Mode;
use crate::restrained::Gradients;

/// Some rows in a mode, ready to be evaluated.
pub(crate) struct Gauge {
    indices: Vec<usize>,
    velocities: Vec<usize>,
    coordinates: Vec<usize>,
    tape: Arc<InstantTape>,
    values: Jets<Rounded>,
}

impl Gauge {
    /// Of some rows, each with an index.
    pub(crate) fn of(
        equations: &Equations,
        mode: &Mode,
        rows: &[(usize, RowOf)],
        inputs: &[f64],
    ) -> Result<Self, Reason> {
        let bodies = || mode.bodies.iter().copied();
        let (indices, rows) = rows.iter().copied().unzip();
        let tape = equations.rows_tape(mode, rows)?;
        Ok(Self {
            indices,
            velocities: equations.velocities_of(mode, &mode.bodies),
            coordinates: bodies().flat_map(|body| equations.coordinate_states(mode, body)).collect(),
            values: Jets::new(Arc::clone(&tape.tape), 0, &computed(inputs)),
            tape,
        })
    }

    /// Their numbers there.
    pub(crate) fn at(&mut self, time: f64, states: &[f64]) -> Rows {
        self.values.start(Rounded::leaf(time), &computed(states), Branches::Free);
        let Self { indices, velocities, coordinates, tape, values } = self;
        let value = |output: usize| values.value_of(output);
        let slopes =
            |row: &Measured| row.slopes().map(|(place, slope)| (place, value(slope).value)).collect();
        let gradient = Gradients { rows: tape.rows.iter().map(slopes).collect(), columns: velocities.len() };
        let mass = DVector::from_fn(velocities.len(), |place, _| value(tape.bodies + place).value);
        Rows {
            indices: indices.clone(),
            position: tape.rows.iter().map(|row| value(row.position)).collect(),
            rate: tape.rows.iter().map(|row| value(row.rate())).collect(),
            gradient,
            mass,
            velocities: velocities.clone(),
            coordinates: coordinates.clone(),
        }
    }
}

fn computed(values: &[f64]) -> Vec<Rounded> {
    values.iter().map(|value| Rounded::computed(*value)).collect()
}
