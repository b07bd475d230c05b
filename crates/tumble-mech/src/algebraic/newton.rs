//! Forces that loads read otherwise than linearly, at an instant: Newton's method from several places.

use nalgebra::{DMatrix, DVector};
use tumble_expr::{Branches, Jets};
use tumble_ode::{Crossing, Reason};

use super::stated;
use crate::contact::WEDGED;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Jump;
use crate::uniqueness::Spot;

/// Steps of Newton's method, each halved as often, after which there is none to be found: from afar it may have to be damped a while.
const MOST_STEPS: usize = 100;
const MOST_HALVES: usize = 40;
/// What is left by a step that is this part of the forces is their rounding.
const CONVERGED: f64 = 8.0 * f64::EPSILON;
/// Where the forces were before is where they are still, if Newton's method moves them by no more than this part.
const STILL_THERE: f64 = 1e-6;
/// Solutions closer than this part are one.
const ONE: f64 = 1e-9;
/// Jumps of one instant, each with the forces that the one before has led to. Two are needed where these change what holds.
const MOST_JUMPS: usize = 8;
/// Places to begin with, in parts of what the forces are where the loads do not depend on them.
const BEGINNINGS: [f64; 6] = [1.0, 0.0, 0.1, 10.0, 1000.0, -1.0];

/// The forces at an instant.
struct Forces<'a> {
    jets: Jets<f64>,
    time: f64,
    states: &'a [f64],
    /// Where the states of each are.
    places: Vec<usize>,
}

/// A solution.
struct Found {
    values: DVector<f64>,
    /// Least part that the loads leave of what a unit of a force does to its own equation, and which force that is.
    left: f64,
    least: usize,
}

impl Equations {
    /// The jump that agrees with the forces which it leads to.
    pub(crate) fn jump_with_forces(&self, at: &Crossing<'_, Mode>) -> Result<Jump<Mode>, Reason> {
        let mut states = at.states.to_vec();
        let mut before: Option<Mode> = None;
        for _ in 0..MOST_JUMPS {
            let mut jump = self.jump_once(&Crossing { states: &states, around: at.around.clone(), ..*at })?;
            let guessed = jump.states[self.algebraic_places(&jump.mode)].to_vec();
            self.find_forces(&jump.mode, at.time, &mut jump.states, at.inputs)?;
            let found = &jump.states[self.algebraic_places(&jump.mode)];
            if found == guessed || before.as_ref() == Some(&jump.mode) {
                return Ok(jump);
            }
            states[self.algebraic_places(at.mode)].copy_from_slice(found);
            before = Some(jump.mode);
        }
        Err(Reason::Model(
            "what holds at this instant depends on forces that loads read, and these on what holds: no mode agrees with its own forces"
                .into(),
        ))
    }

    /// The states of a mode with the forces that loads read in it.
    pub(crate) fn with_forces(
        &self,
        mode: &Mode,
        time: f64,
        states: &[f64],
        inputs: &[f64],
    ) -> Result<Vec<f64>, Reason> {
        let mut states = states.to_vec();
        self.find_forces(mode, time, &mut states, inputs)?;
        Ok(states)
    }

    /// Puts the forces into the states that stand for them: those that were there before, if they still are a solution.
    pub(crate) fn find_forces(
        &self,
        mode: &Mode,
        time: f64,
        states: &mut [f64],
        inputs: &[f64],
    ) -> Result<(), Reason> {
        let implicit = self.implicit(mode);
        if implicit.is_empty() {
            return Ok(());
        }
        let (all, first) = (self.algebraic_in(mode), self.algebraic_places(mode).start);
        let place = |index: &usize| all.iter().position(|known| known == index).map(|place| first + place);
        let places: Vec<usize> = implicit.iter().filter_map(place).collect();
        let known = states.to_vec();
        let jets = Jets::new(self.residuals(mode)?, 0, inputs);
        let found = Forces { jets, time, states: &known, places: places.clone() }.settle();
        let found = found.map_err(|why| Reason::Model(self.unsettled(&implicit, why)))?;
        places.into_iter().zip(&found).for_each(|(place, value)| states[place] = *value);
        let now = Spot { mode, time, states, inputs };
        self.refuse_not_unique(now, &implicit)
    }

    /// Refuses loads that read forces which are not unique, where the load is not unique for that.
    fn refuse_not_unique(&self, at: Spot<'_>, implicit: &[usize]) -> Result<(), Reason> {
        for known in implicit.iter().map(|index| &self.algebraic()[*index]) {
            for load in &known.loads {
                let term = &self.loads()[*load];
                let read = std::slice::from_ref(&known.force);
                self.refuse_open(at, term, read, &stated(term).map(|part| self.in_coordinates(&part)))?;
            }
        }
        Ok(())
    }

    /// Why there are no forces, or several.
    fn unsettled(&self, implicit: &[usize], why: Unsettled) -> String {
        let named = |values: &DVector<f64>| {
            let each = implicit.iter().zip(values);
            let each =
                each.map(|(index, value)| format!("`{}` = {value}", self.algebraic()[*index].force.name));
            each.collect::<Vec<_>>().join(", ")
        };
        let known = |index: usize| &self.algebraic()[implicit[index]];
        match why {
            Unsettled::Several(all) => {
                let names: Vec<String> = all.iter().map(named).collect();
                format!(
                    "{} depends on forces that have several values here with which the motion obeys it: {}. Let it depend less on \
                     them, or begin where there is one",
                    self.load_names(&known(0).loads),
                    names.join("; or ")
                )
            }
            Unsettled::Undetermined { least, left, values } => {
                let known = known(least);
                format!(
                    "{}. That is at {}",
                    self.undetermined(&known.force.name, &known.loads, left),
                    named(&values)
                )
            }
            Unsettled::None => format!(
                "no value of `{}` obeys {}, which depends on it: whatever it is, the load makes it another (jamming). Let the load depend \
                 less on it",
                known(0).force.name,
                self.load_names(&known(0).loads)
            ),
        }
    }
}

/// Why there is not one solution.
enum Unsettled {
    Several(Vec<DVector<f64>>),
    /// The loads leave too little of one of the forces.
    Undetermined {
        least: usize,
        left: f64,
        values: DVector<f64>,
    },
    None,
}

impl Forces<'_> {
    fn settle(mut self) -> Result<DVector<f64>, Unsettled> {
        let before =
            DVector::from_iterator(self.places.len(), self.places.iter().map(|place| self.states[*place]));
        let mut found: Vec<Found> = vec![];
        if let Some(own) = self.newton(&before) {
            let is_there = (&own.values - &before).amax() <= STILL_THERE * own.values.amax();
            if is_there && own.left > WEDGED {
                return Ok(own.values);
            }
            found.push(own);
        }
        let alone = self.alone();
        for beginning in BEGINNINGS {
            if let Some(own) = self.newton(&(&alone * beginning)) {
                let is_known =
                    |known: &Found| (&known.values - &own.values).amax() <= ONE * own.values.amax();
                if !found.iter().any(is_known) {
                    found.push(own);
                }
            }
        }
        let (mut regular, others): (Vec<Found>, Vec<Found>) =
            found.into_iter().partition(|own| own.left > WEDGED);
        match (regular.len(), others.into_iter().next()) {
            (1, _) => Ok(regular.swap_remove(0).values),
            (0, None) => Err(Unsettled::None),
            (0, Some(Found { values, left, least })) => Err(Unsettled::Undetermined { least, left, values }),
            _ => Err(Unsettled::Several(regular.into_iter().map(|own| own.values).collect())),
        }
    }

    /// What the forces are where the loads read none.
    fn alone(&mut self) -> DVector<f64> {
        self.evaluate(&DVector::zeros(self.places.len())).0
    }

    /// Forces by the values that the loads read, and `1 - d lambda/d z`.
    fn evaluate(&mut self, values: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let mut states = self.states.to_vec();
        self.places.iter().zip(values).for_each(|(place, value)| states[*place] = *value);
        self.jets.start(self.time, &states, Branches::Free);
        let n = values.len();
        let forces = DVector::from_fn(n, |row, _| self.jets.value_of(row));
        let slopes = DMatrix::from_fn(n, n, |row, column| self.jets.value_of(n + row * n + column));
        (forces, DMatrix::identity(n, n) - slopes)
    }

    /// Damped, so that each step brings the forces closer to what the loads make of them; `None` where it does not converge.
    fn newton(&mut self, from: &DVector<f64>) -> Option<Found> {
        let mut values = from.clone();
        let (mut forces, mut matrix) = self.evaluate(&values);
        for _ in 0..MOST_STEPS {
            let off = &forces - &values;
            if off.amax() == 0.0 {
                return Some(Found::of(values, &matrix));
            }
            let step = matrix.clone().lu().solve(&off)?;
            let size = values.amax().max(forces.amax());
            if step.amax() <= CONVERGED * size {
                return Some(Found::of(values + step, &matrix));
            }
            let mut part = 1.0;
            (values, forces, matrix) = (0..MOST_HALVES).find_map(|_| {
                let next = &values + &step * part;
                let (forces, matrix) = self.evaluate(&next);
                part *= 0.5;
                let is_closer = (&forces - &next).norm() < off.norm();
                // Within rounding nothing comes closer.
                let is_as_good = step.amax() <= ONE * size && (&forces - &next).norm() <= 2.0 * off.norm();
                (is_closer || is_as_good).then_some((next, forces, matrix))
            })?;
        }
        None
    }
}

impl Found {
    fn of(values: DVector<f64>, matrix: &DMatrix<f64>) -> Self {
        let inverse = matrix.clone().try_inverse();
        let left = |index: usize| inverse.as_ref().map_or(0.0, |inverse| 1.0 / inverse[(index, index)]);
        let all = (0..values.len()).map(|index| (index, left(index)));
        // What is no number is the least.
        let key = |left: f64| if left.is_nan() { f64::NEG_INFINITY } else { left };
        let least = all.min_by(|a, b| key(a.1).total_cmp(&key(b.1)));
        let (least, left) = least.unwrap_or((0, 1.0));
        // Beyond an odd number of folds together the forces are no better off, whatever each does by itself.
        let determinant = matrix.determinant();
        let left = if determinant > 0.0 { left } else { left.min(determinant) };
        Self { values, left, least }
    }
}
