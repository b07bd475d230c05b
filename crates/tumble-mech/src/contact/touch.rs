//! The numbers of an island's pairs at an instant: what impacts and lasting contacts are found from.
//!
//! With M the masses, J the gradients of the gaps' rates and B those of the joints' rows, impulses P at the pairs change velocities by
//! `M^-1 (J^T P + B^T Q)`, with `Q = -(B M^-1 B^T)^-1 B M^-1 J^T P` so that the joints hold.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Branches, Expr, Jets, Layout, Rounded, Rounding, Tape};
use tumble_ode::Reason;

use crate::cache::Cache;
use crate::contact::complementarity::DEPENDENT;
use crate::contact::settle::BALANCED;
use crate::contact::slip::Slips;
use crate::coordinates::Measure;
use crate::equations::{Definitions, Equations};
use crate::mode::Mode;
use crate::restrained::{Gradients, respond};
use crate::surface::ContactLaw;
use crate::term::Term;

/// Where and when.
#[derive(Clone, Copy)]
pub(crate) struct Now<'a> {
    pub(crate) time: f64,
    pub(crate) inputs: &'a [f64],
    /// What rounding has left out of the states.
    pub(crate) compensation: &'a [f64],
    /// Largest values that each kind of state has had, by [`Measure`].
    pub(crate) scales: &'a [f64],
}

/// Rounding may leave of a velocity that came to rest this part of the largest there was, in units of what `STANDS`
/// makes of it.
const LEFT: f64 = 1e-3;

/// Impulses whose sum is this part of their sizes balance each other.
const BALANCES: f64 = 64.0 * f64::EPSILON;
/// Gaps of one body that are zero within so many times their rounding error close at one instant.
const ONE_INSTANT: f64 = 16.0;

/// An island's pairs at an instant, by their order among its own.
pub(crate) struct Touch {
    /// Largest extent of a body, m; zero where none has any.
    pub(crate) size: f64,
    /// Index of each among all pairs.
    pub(crate) pairs: Vec<usize>,
    /// m
    pub(crate) gap: DVector<f64>,
    /// Gaps below this are zero but for rounding, m.
    pub(crate) blur: DVector<f64>,
    /// m/s
    pub(crate) rate: DVector<f64>,
    /// Rounding in a rate is relative to this, m/s.
    pub(crate) speed: DVector<f64>,
    /// Accelerations of the gaps without lasting contacts of this island, m/s^2.
    pub(crate) free: DVector<f64>,
    /// Rounding in accelerations is relative to this: what all forces would do if none were against another, m/s^2.
    pub(crate) strength: f64,
    /// Restitution of each; zero where the surface is compliant.
    pub(crate) restitution: DVector<f64>,
    /// Of those with friction, along their surfaces.
    pub(crate) slips: Slips,
    /// Change of rate i by a unit impulse at j, 1/kg; rates of gaps come first, then those of slips.
    pub(crate) response: DMatrix<f64>,
    /// Change of each velocity state by a unit impulse at j.
    kicks: DMatrix<f64>,
    /// Index of each velocity state.
    velocities: Vec<usize>,
    /// The rows of joints that hold.
    pub(crate) joints: Joined,
}

/// Rows of joints at an instant, which impulses of their own keep.
pub(crate) struct Joined {
    /// Index of each among all rows of joints.
    pub(crate) rows: Vec<usize>,
    /// Impulse of each by a unit impulse at a pair.
    pub(crate) share: DMatrix<f64>,
}

/// Tapes by the first body of an island, mode and how numbers are rounded.
pub(crate) type TouchTapes = Cache<((usize, Mode), Rounding), Tape>;

/// Outputs a pair before its row of the Jacobian: gap, rate, acceleration, restitution.
const BEFORE_ROW: usize = 4;

impl Touch {
    /// Adds impulses at the pairs, and then along the surfaces, to the velocities. Where they balance but for rounding nothing changes: what falls flat stays
    /// flat.
    pub(crate) fn kick(&self, impulses: &DVector<f64>, states: &mut [f64]) {
        let changes = (&self.kicks * impulses, self.kicks.abs() * impulses.abs());
        for (index, (change, size)) in changes.0.iter().zip(&changes.1).enumerate() {
            if change.abs() > BALANCES * size {
                states[self.velocities[index]] += change;
            }
        }
    }

    /// Takes rounding out of what joints keep where it is: no push moves it. `free` is the response without joints.
    fn clear(&mut self, free: &DMatrix<f64>) {
        let zero = BALANCED * self.strength;
        let accelerations = self.free.iter_mut().chain(&mut self.slips.free);
        for (row, acceleration) in accelerations.enumerate() {
            if self.response[(row, row)] <= DEPENDENT * free[(row, row)] {
                self.response.fill_row(row, 0.0);
                self.response.fill_column(row, 0.0);
                *acceleration = if acceleration.abs() <= zero { 0.0 } else { *acceleration };
            }
        }
    }

    /// Position of a pair among the island's own.
    pub(crate) fn position(&self, pair: usize) -> Option<usize> {
        self.pairs.iter().position(|known| *known == pair)
    }
}

impl Equations {
    /// The numbers of the pairs of the island that a body belongs to.
    pub(crate) fn touch(
        &self,
        body: usize,
        mode: &Mode,
        states: &[f64],
        now: Now<'_>,
    ) -> Result<Touch, Reason> {
        let island = self.island_of(mode, body);
        let pairs: Vec<usize> = island.iter().flat_map(|body| self.pair_list().of_body(*body)).collect();
        let velocities: Vec<usize> =
            island.iter().flat_map(|body| self.velocity_states(mode, *body)).collect();
        let mut jets = Jets::new(self.touch_tape(&island, mode, &pairs)?, 1, now.inputs);
        jets.start(now.time, states, Branches::Free);
        // Gaps are differences of much larger numbers: what the carries add to them is found to first order.
        for (leaf, compensation) in now.compensation.iter().take(states.len()).enumerate() {
            jets.set(leaf, 1, *compensation);
        }
        jets.set(states.len(), 1, 0.0);
        jets.extend(1);
        let (n, dofs) = (pairs.len(), velocities.len());
        let joint_rows = self.independent_rows_of(mode, &island).into_iter().map(|(index, _)| index);
        let joint_rows: Vec<usize> = joint_rows.collect();
        let first_joint = n * (BEFORE_ROW + dofs);
        let after_rows = first_joint + joint_rows.len() * dofs;
        let value = |pair: usize, which: usize| jets.value_of(pair * (BEFORE_ROW + dofs) + which);
        let column = |which: usize| DVector::from_fn(n, |pair, _| value(pair, which));
        let after_all = after_rows + 2 * dofs + 1 + if joint_rows.is_empty() { 0 } else { dofs };
        let (slips, along) =
            Slips::read(&self.rough_among(&pairs), dofs, |which| jets.value_of(after_all + which));
        let gaps = DMatrix::from_fn(n, dofs, |pair, dof| value(pair, BEFORE_ROW + dof));
        let rows = stacked(gaps, &along);
        let inverse = DVector::from_fn(dofs, |dof, _| jets.value_of(after_rows + dof));
        let joint_value = |row: usize, which: usize| jets.value_of(first_joint + row * dofs + which);
        let slopes = DMatrix::from_fn(joint_rows.len(), dofs, joint_value);
        let (kicks, joints) = match joint_rows.is_empty() {
            true => {
                let kicks = DMatrix::from_diagonal(&inverse) * rows.transpose();
                (kicks, Joined { rows: vec![], share: DMatrix::zeros(0, rows.nrows()) })
            }
            false => {
                let mass = DVector::from_fn(dofs, |dof, _| jets.value_of(after_rows + 2 * dofs + 1 + dof));
                let none = DMatrix::zeros(joint_rows.len(), rows.nrows());
                let (kicks, share) = respond(&mass, &Gradients::of(&slopes), &rows.transpose(), &none)
                    .ok_or_else(|| self.not_independent(&island))?;
                (kicks, Joined { rows: joint_rows, share })
            }
        };
        let pushed = DVector::from_fn(dofs, |dof, _| jets.value_of(after_rows + dofs + dof));
        let measures: Vec<Measure> =
            island.iter().flat_map(|body| self.velocity_measures(*body)).copied().collect();
        let speed = |row: usize, rate: f64| -> f64 {
            let own = |dof: usize| rows[(row, dof)] * states[velocities[dof]];
            let left = |dof: usize| rows[(row, dof)].abs() * LEFT * now.scales[measures[dof] as usize];
            let surface = rate - (0..dofs).map(own).sum::<f64>();
            (0..dofs).map(|dof| own(dof).abs() + left(dof)).sum::<f64>() + surface.abs()
        };
        let mut touch = Touch {
            size: jets.value_of(after_rows + 2 * dofs),
            gap: DVector::from_fn(n, |pair, _| {
                let series = jets.output(pair * (BEFORE_ROW + dofs));
                series[0] + series[1]
            }),
            blur: self.blur(jets.tape(), n, dofs, (states, now)),
            rate: column(1),
            speed: DVector::from_fn(n, |pair, _| speed(pair, value(pair, 1))),
            strength: (rows.abs() * inverse.component_mul(&pushed)
                + stacked_column(&column(2), &slips.free).abs())
            .max(),
            free: column(2),
            restitution: column(3),
            response: &rows * &kicks,
            slips: Slips {
                speed: DVector::from_fn(along.nrows(), |slip, _| speed(n + slip, slips.rate[slip])),
                ..slips
            },
            pairs,
            kicks,
            velocities,
            joints,
        };
        touch.clear(&(&rows * DMatrix::from_diagonal(&inverse) * rows.transpose()));
        let slips = touch.slips.rate.iter().chain(&touch.slips.free);
        match touch.rate.iter().chain(&touch.free).chain(slips).all(|value| value.is_finite()) {
            true => Ok(touch),
            false => Err(Reason::Model(format!(
                "where `{}` touches, its velocity or acceleration is not a finite number",
                self.model().bodies[body].name
            ))),
        }
    }

    /// What rounding leaves of gaps that are zero: that of the gap itself, and what its rate makes of that of the time.
    fn blur(
        &self,
        tape: &Arc<Tape>,
        n: usize,
        dofs: usize,
        (states, now): (&[f64], Now<'_>),
    ) -> DVector<f64> {
        let rounded = |values: &[f64]| values.iter().map(|value| Rounded::leaf(*value)).collect::<Vec<_>>();
        let mut jets = Jets::new(tape.clone(), 0, &rounded(now.inputs));
        jets.start(Rounded::leaf(now.time), &rounded(states), Branches::Free);
        DVector::from_fn(n, |pair, _| {
            let [gap, rate] = [0, 1].map(|which| jets.value_of(pair * (BEFORE_ROW + dofs) + which));
            ONE_INSTANT * (gap.noise() + rate.value.abs() * f64::EPSILON * now.time)
        })
    }

    fn touch_tape(&self, island: &[usize], mode: &Mode, pairs: &[usize]) -> Result<Arc<Tape>, Reason> {
        if let Some(twin) = self.twin(mode).filter(|twin| twin.bodies().len() == island.len()) {
            let pairs: Vec<usize> = pairs.iter().map(|pair| twin.pair(*pair)).collect();
            return self.touch_tape(twin.bodies(), &twin.mode(mode), &pairs);
        }
        let key = (island[0], mode.without_support(self.pairs(), island));
        let build = |(_, mode): &(usize, Mode)| self.build_touch_tape(island, mode, pairs);
        self.built().touch_tapes.get_rounded(key, self.rounding(), build, Tape::rounded)
    }

    fn build_touch_tape(&self, island: &[usize], mode: &Mode, pairs: &[usize]) -> Result<Tape, Reason> {
        let layout = Layout { rounding: Rounding::NEAREST, ..self.layout(mode) };
        let velocities: Vec<_> = island.iter().flat_map(|body| self.velocity_states(mode, *body)).collect();
        let velocities: Vec<_> = velocities.into_iter().map(|state| layout.states[state].clone()).collect();
        let definitions = self.definitions_about(mode, island);
        let mut outputs: Vec<Expr> = vec![];
        for pair in pairs.iter().map(|pair| &self.pairs()[*pair]) {
            let restitution = match &pair.law {
                ContactLaw::Rigid { restitution } => restitution.clone(),
                _ => Expr::zero(),
            };
            let rate = definitions.apply(&pair.gap_rate());
            outputs.push(definitions.apply(&pair.gap()));
            outputs.push(rate.clone());
            outputs.push(definitions.apply(&pair.gap_acceleration()));
            outputs.push(definitions.apply(&restitution));
            outputs.extend(velocities.iter().map(|velocity| rate.derivative(velocity)));
        }
        let joints = self.independent_rows_of(mode, island);
        for (_, row) in &joints {
            let rate = definitions.apply(&row.rate);
            outputs.extend(velocities.iter().map(|velocity| rate.derivative(velocity)));
        }
        let inverse = island.iter().flat_map(|body| self.inverse_masses(*body));
        outputs.extend(inverse.map(|formula| definitions.apply(&formula)));
        outputs.extend(island.iter().flat_map(|body| self.pushes(*body, mode, &definitions)));
        let reaches = island.iter().map(|body| self.model().bodies[*body].reach() * 2);
        let size = reaches.reduce(|far, next| Expr::binary(tumble_expr::Binary::Max, far, next));
        outputs.extend(size);
        if !joints.is_empty() {
            let masses = island.iter().flat_map(|body| self.masses(mode, *body));
            outputs.extend(masses.map(|formula| definitions.apply(&formula)));
        }
        for slip in self.rough_among(pairs) {
            outputs.extend(self.pairs()[pairs[slip]].slip_outputs(&definitions, &velocities));
        }
        Ok(Tape::compile(&layout, &outputs)?)
    }

    fn not_independent(&self, island: &[usize]) -> Reason {
        let names: Vec<&str> = island.iter().map(|body| self.model().bodies[*body].name.as_str()).collect();
        Reason::Model(format!("the joints of {} do not determine their impulses here", names.join(", ")))
    }

    /// Positions of those of some pairs that have friction.
    fn rough_among(&self, pairs: &[usize]) -> Vec<usize> {
        (0..pairs.len()).filter(|place| self.pairs()[pairs[*place]].friction.is_some()).collect()
    }

    /// What kind each velocity of a body is of.
    fn velocity_measures(&self, body: usize) -> &'static [Measure] {
        match self.pivot_arm(body) {
            None => &[Measure::Speed, Measure::Speed, Measure::AngularRate],
            Some(_) => &[Measure::AngularRate],
        }
    }

    /// Sizes of all forces and torques on a body, lasting contacts left out, added up without signs: one for each
    /// velocity.
    fn pushes(&self, body: usize, mode: &Mode, definitions: &Definitions) -> Vec<Expr> {
        let terms = self.terms_on(mode, body, definitions);
        let total =
            |of: &dyn Fn(&Term) -> Expr| terms.iter().fold(Expr::zero(), |sum, term| sum + of(term).abs());
        match self.pivot_arm(body) {
            None => vec![
                total(&|term| term.force.x().clone()),
                total(&|term| term.force.y().clone()),
                total(&Term::torque),
            ],
            Some((_, arm)) => {
                let arm = arm.map(|part| definitions.apply(part));
                vec![total(&|term| term.torque_about(&(&term.arm - &arm)))]
            }
        }
    }
}

/// Rows of one matrix, then of another.
fn stacked(first: DMatrix<f64>, then: &DMatrix<f64>) -> DMatrix<f64> {
    let (before, all) = (first.nrows(), first.nrows() + then.nrows());
    let mut rows = first.resize_vertically(all, 0.0);
    rows.rows_mut(before, all - before).copy_from(then);
    rows
}

/// Entries of one vector, then of another.
pub(super) fn stacked_column(first: &DVector<f64>, then: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(first.len() + then.len(), first.iter().chain(then).copied())
}
