//! Rows as numbers, at one state of a mode after the other.

use std::collections::HashMap;

use nalgebra::DVector;
use tumble_expr::{Branches, Expr, Jets, Rounded, Symbol};
use tumble_ode::Reason;

use crate::assembly::Rows;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::restrained::Gradients;
use crate::row::Row;

/// Some rows in a mode, ready to be evaluated.
pub(crate) struct Gauge {
    indices: Vec<usize>,
    /// By row, the velocities that its rate depends on.
    used: Vec<Vec<usize>>,
    velocities: Vec<usize>,
    coordinates: Vec<usize>,
    /// Of each row its position, its rate and the slopes of that; then the masses.
    values: Jets<Rounded>,
}

impl Gauge {
    /// Of some rows, each with an index.
    pub(crate) fn of(
        equations: &Equations,
        mode: &Mode,
        rows: &[(usize, &Row)],
        inputs: &[f64],
    ) -> Result<Self, Reason> {
        let layout = equations.layout(mode);
        let bodies = || mode.bodies.iter().copied();
        let velocities: Vec<usize> =
            bodies().flat_map(|body| equations.velocity_states(mode, body)).collect();
        let coordinates = bodies().flat_map(|body| equations.coordinate_states(mode, body)).collect();
        let places: HashMap<&Symbol, usize> =
            velocities.iter().enumerate().map(|(place, state)| (&layout.states[*state], place)).collect();
        let definitions = equations.definitions_of(mode);
        let (mut outputs, mut indices, mut used) = (vec![], vec![], vec![]);
        for (index, row) in rows {
            indices.push(*index);
            let rate = definitions.apply(&row.rate);
            let symbols = rate.symbols();
            let mut own: Vec<usize> =
                symbols.iter().filter_map(|symbol| places.get(symbol).copied()).collect();
            own.sort_unstable();
            outputs.extend([definitions.apply(&row.position), rate.clone()]);
            outputs.extend(own.iter().map(|place| rate.derivative(&layout.states[velocities[*place]])));
            used.push(own);
        }
        let masses = bodies().flat_map(|body| equations.masses(mode, body));
        outputs.extend(masses.map(|mass: Expr| definitions.apply(&mass)));
        let tape = equations.compiled(mode, &outputs, inputs)?.tape().clone();
        Ok(Self { indices, used, velocities, coordinates, values: Jets::new(tape, 0, &computed(inputs)) })
    }

    /// Their numbers there.
    pub(crate) fn at(&mut self, time: f64, states: &[f64]) -> Rows {
        let jets = &mut self.values;
        jets.start(Rounded::leaf(time), &computed(states), Branches::Free);
        let (mut position, mut rate, mut rows, mut output) = (vec![], vec![], vec![], 0);
        for own in &self.used {
            position.push(jets.value_of(output));
            rate.push(jets.value_of(output + 1));
            let slopes = own.iter().zip(output + 2..);
            rows.push(slopes.map(|(place, slope)| (*place, jets.value_of(slope).value)).collect());
            output += 2 + own.len();
        }
        let gradient = Gradients { rows, columns: self.velocities.len() };
        let mass = DVector::from_fn(self.velocities.len(), |place, _| jets.value_of(output + place).value);
        let Self { indices, velocities, coordinates, .. } = self;
        let (indices, velocities, coordinates) = (indices.clone(), velocities.clone(), coordinates.clone());
        Rows { indices, position, rate, gradient, mass, velocities, coordinates }
    }
}

fn computed(values: &[f64]) -> Vec<Rounded> {
    values.iter().map(|value| Rounded::computed(*value)).collect()
}
