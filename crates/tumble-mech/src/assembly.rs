//! Bodies at the start brought to where their joints hold, and rows of joints that follow from others.
//!
//! The correction of a gap g is what an impulse at the joints would do to rates that are to change by `-g` (Newton's method): as little
//! mass as possible is moved.

use nalgebra::{DMatrix, DVector};
use tumble_expr::Rounded;
use tumble_ode::Reason;

use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::error::{ModelError, ModelErrors};
use crate::gauge::Gauge;
use crate::link::RowOf;
use crate::mode::Mode;
use crate::restrained::{Gradients, respond};

/// Places and rates that fit within so many times their rounding error fit.
const FITS: f64 = 64.0;
/// Newton's method doubles its digits near the answer; what has none by then has none.
const CORRECTIONS: usize = 60;
/// Gradients that are this small once those before are taken out of them, in parts of what they were, are sums of those: eight
/// digits are more than starts are usually given with, and less than rounding leaves.
const DEPENDENT: f64 = 1e-9;
/// Rows that are so near to being sums of others have brought a motion to an end that cannot go on.
const NEARLY: f64 = 1e-3;

/// Rows that are so many times farther from depending on each other than is asked are not looked at one by one.
const CLEARLY: f64 = 1e3;

/// rad; a correction that turns a body farther leads to another branch of its angle, or nowhere.
const MOST_TURN: f64 = 1.0;

/// All rows of joints at one instant.
pub(crate) struct Rows {
    /// Index of each.
    pub(crate) indices: Vec<usize>,
    /// m or rad; and what it is but for rounding.
    pub(crate) position: Vec<Rounded>,
    /// m/s or rad/s
    pub(crate) rate: Vec<Rounded>,
    /// By row and velocity.
    pub(crate) gradient: Gradients,
    /// By velocity, kg or kg m^2.
    pub(crate) mass: DVector<f64>,
    /// States that the velocities are, and the coordinates that they are rates of.
    pub(crate) velocities: Vec<usize>,
    pub(crate) coordinates: Vec<usize>,
}

impl Equations {
    /// Brings the states to where all joints that hold do, where they are not; finds what is redundant.
    pub(crate) fn assemble(
        &self,
        mode: &mut Mode,
        states: &mut [f64],
        compensation: &mut [f64],
        inputs: &[f64],
    ) -> Result<(), ModelErrors> {
        if self.joint_rows(mode).next().is_none() {
            return Ok(());
        }
        let rows = |states: &[f64]| self.rows_at(mode, 0.0, states, inputs);
        let given = rows(states).map_err(|reason| unusable(&reason))?;
        let mistakes = self.misfits(mode, &given);
        if !mistakes.is_empty() {
            return Err(ModelErrors(mistakes));
        }
        let before = states.to_vec();
        let mut now = given;
        for _ in 0..CORRECTIONS {
            if now.position.iter().all(|value| is_none(*value)) {
                break;
            }
            let off = DVector::from_iterator(now.indices.len(), now.position.iter().map(|value| value.value));
            let step = now.correction(&off);
            let part = self.part_of(&step);
            now.coordinates.iter().zip(&step).for_each(|(state, step)| states[*state] -= part * step);
            now = rows(states).map_err(|reason| unusable(&reason))?;
        }
        if let Some(mistake) = self.not_closed(mode, &now) {
            return Err(mistake.into());
        }
        let off = DVector::from_iterator(now.indices.len(), now.rate.iter().map(|value| value.value));
        if !now.rate.iter().all(|value| value.value == 0.0) {
            let step = now.correction(&off);
            now.velocities.iter().zip(&step).for_each(|(state, step)| states[*state] -= step);
        }
        let moved = states.iter().zip(&before).map(|(now, before)| now != before);
        moved.zip(compensation).filter(|(moved, _)| *moved).for_each(|(_, left)| *left = 0.0);
        if let Some(branches) = self.only_here(mode, 0.0, states, inputs) {
            return Err(ModelError::StartsSingular { branches }.into());
        }
        mode.redundant = now.redundant();
        Ok(())
    }

    /// How much of a correction by coordinate is taken, so that no body turns far at once: near a pose that no correction leads away
    /// from they grow beyond all bounds, and what has turned very far has no place left but for rounding.
    pub(crate) fn part_of(&self, step: &DVector<f64>) -> f64 {
        let bodies = (0..self.model().bodies.len()).flat_map(|body| self.coordinate_measures(body));
        let turns = bodies.zip(step).filter(|(measure, _)| *measure == Measure::Angle);
        let most = turns.map(|(_, step)| step.abs()).fold(0.0, f64::max);
        if most > MOST_TURN { MOST_TURN / most } else { 1.0 }
    }

    /// The rows of all joints that hold in a mode, redundant ones included.
    pub(crate) fn rows_at(
        &self,
        mode: &Mode,
        time: f64,
        states: &[f64],
        inputs: &[f64],
    ) -> Result<Rows, Reason> {
        self.numbers_of(mode, &self.rows_by_joint(mode), time, states, inputs)
    }

    /// Numbers of some rows, each with an index.
    pub(crate) fn numbers_of(
        &self,
        mode: &Mode,
        rows: &[(usize, RowOf)],
        time: f64,
        states: &[f64],
        inputs: &[f64],
    ) -> Result<Rows, Reason> {
        Ok(Gauge::of(self, mode, rows, inputs)?.at(time, states))
    }

    /// Joints that are not to be assembled and do not fit.
    fn misfits(&self, mode: &Mode, rows: &Rows) -> Vec<ModelError> {
        let off = |joint: usize, values: &[Rounded]| {
            let own = self.places_of(mode, joint, rows);
            let wrong = own.clone().any(|place| !is_none(values[place]));
            let size = own.map(|place| values[place].value).fold(0.0, libm::hypot);
            wrong.then_some(size)
        };
        let mut mistakes = vec![];
        let is_assembled = self.assembled(mode);
        for (index, joint) in self.model().joints.iter().enumerate() {
            let bodies = &self.joints()[index].bodies;
            if !self.holds(mode, index) || bodies.iter().any(|body| is_assembled[*body]) {
                continue;
            }
            let name = || joint.name.clone();
            match (off(index, &rows.position), off(index, &rows.rate)) {
                (Some(gap), _) => mistakes.push(ModelError::JointOpen { joint: name(), gap }),
                (None, Some(rate)) => mistakes.push(ModelError::JointMoves { joint: name(), rate }),
                (None, None) => {}
            }
        }
        mistakes
    }

    /// By body, whether joints that hold it are to be closed by moving bodies: one of its own, or one that it is joined to by others.
    fn assembled(&self, mode: &Mode) -> Vec<bool> {
        let joints = self.model().joints.iter().zip(self.joints()).filter(|(joint, _)| joint.assemble);
        let bodies: Vec<usize> = joints.flat_map(|(_, known)| known.bodies.iter().copied()).collect();
        let mut is_assembled = vec![false; self.model().bodies.len()];
        self.islands(mode, &bodies).into_iter().flatten().for_each(|body| is_assembled[body] = true);
        is_assembled
    }

    /// Names of the joints whose rows come to depend on each other near these states, redundant ones left out; none where there are
    /// none.
    pub(crate) fn singular_joints(
        &self,
        mode: &Mode,
        time: f64,
        states: &[f64],
        inputs: &[f64],
    ) -> Option<String> {
        let rows = self.rows_at(mode, time, states, inputs).ok()?;
        let dependent = rows.without(&mode.redundant).dependent(NEARLY);
        (!dependent.is_empty()).then(|| self.named_joints(&dependent))
    }

    /// That joints leave a gap which nothing closes.
    fn not_closed(&self, mode: &Mode, rows: &Rows) -> Option<ModelError> {
        let is_open = |joint: &usize| {
            self.holds(mode, *joint)
                && self.places_of(mode, *joint, rows).any(|place| !is_none(rows.position[place]))
        };
        let open: Vec<usize> = (0..self.joints().len()).filter(is_open).collect();
        let gap = rows.position.iter().fold(0.0, |gap: f64, value| gap.max(value.value.abs()));
        let joints = open.iter().map(|joint| self.model().joints[*joint].name.clone()).collect();
        (!open.is_empty()).then_some(ModelError::JointsDoNotClose { joints, gap })
    }

    /// How far apart a joint's points are, m.
    pub(crate) fn gap_of(&self, mode: &Mode, joint: usize, rows: &Rows) -> f64 {
        let places = self.places_of(mode, joint, rows).take(2);
        places.map(|place| rows.position[place].value).fold(0.0, libm::hypot)
    }

    /// Places of a joint's rows among those that hold.
    fn places_of(&self, mode: &Mode, joint: usize, rows: &Rows) -> std::ops::Range<usize> {
        let first: usize = self.joints()[..joint].iter().map(|joint| joint.rows.len()).sum();
        let after = first + self.joints()[joint].rows.len();
        let place = |index: usize| rows.indices.partition_point(|known| *known < index);
        if self.holds(mode, joint) { place(first)..place(after) } else { 0..0 }
    }
}

impl Rows {
    /// What takes this out of the rows, by velocity or coordinate.
    fn correction(&self, off: &DVector<f64>) -> DVector<f64> {
        let (rates, impulses) = (DMatrix::from_column_slice(off.len(), 1, off.as_slice()), self.mass.len());
        let found = respond(&self.mass, &self.gradient, &DMatrix::zeros(impulses, 1), &rates);
        found.map_or_else(|| DVector::zeros(impulses), |(changes, _)| changes.column(0).into_owned())
    }

    /// What impulses on the velocities change while all rows come to hold, and the impulses of the rows.
    pub(crate) fn respond(&self, pushes: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let rates = DMatrix::from_fn(self.rate.len(), 1, |row, _| -self.rate[row].value);
        respond(&self.mass, &self.gradient, pushes, &rates)
    }

    /// The same without some rows, by index.
    pub(crate) fn without(mut self, left_out: &[usize]) -> Self {
        let places = (0..self.indices.len()).filter(|place| !left_out.contains(&self.indices[*place]));
        let places: Vec<usize> = places.collect();
        self.gradient.rows =
            places.iter().map(|place| std::mem::take(&mut self.gradient.rows[*place])).collect();
        self.indices = places.iter().map(|place| self.indices[*place]).collect();
        self.position = places.iter().map(|place| self.position[*place]).collect();
        self.rate = places.iter().map(|place| self.rate[*place]).collect();
        self
    }

    /// Rows that are sums of others, by index: of several that are, the later ones.
    pub(crate) fn redundant(&self) -> Vec<usize> {
        self.dependent(DEPENDENT)
    }

    /// The same of rows that are so but for this part of them.
    fn dependent(&self, part: f64) -> Vec<usize> {
        if self.gradient.independence() > CLEARLY * part {
            return vec![];
        }
        let gradient = self.gradient.dense();
        let mut kept: Vec<DVector<f64>> = vec![];
        let mut redundant = vec![];
        for (place, index) in self.indices.iter().enumerate() {
            let whole = gradient.row(place).transpose();
            let mut rest = whole.clone();
            for _ in 0..2 {
                for other in &kept {
                    rest.axpy(-other.dot(&rest), other, 1.0);
                }
            }
            match rest.norm() <= part * whole.norm() {
                true => redundant.push(*index),
                false => kept.push(rest.normalize()),
            }
        }
        redundant
    }
}

fn is_none(value: Rounded) -> bool {
    value.value.abs() <= FITS * value.noise()
}

fn unusable(reason: &Reason) -> ModelErrors {
    ModelError::Start { body: "joints".into(), problem: reason.to_string() }.into()
}
