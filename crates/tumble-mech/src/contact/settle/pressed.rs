//! Friction on compliant surfaces at an instant: what presses is known there.

use nalgebra::DVector;

use super::{BALANCED, STANDS, Settling};
use crate::contact::grip::{Grip, Way};
use crate::contact::sticking::{Patch, Rough};
use crate::contact::touch::Touch;
use crate::coordinates::Measure;
use crate::mode::Mode;
use crate::record::Jump;

/// A Hertzian contact whose depth has a root below this part of the largest there was presses by a millionth of a millionth of the most
/// and less: what it keeps from slipping is rounding of the roots by which such an instant is found.
const SPENT: f64 = 1e-4;

impl Settling<'_> {
    /// Positions of the contacts with friction that are pressed into compliant surfaces.
    pub(super) fn pressed(&self, jump: &Jump<Mode>) -> Vec<usize> {
        let is_pressed = |position: &usize| {
            jump.mode.is_pressed(self.touch.pairs[*position]) && self.touch.slips.at(*position).is_some()
        };
        (0..self.touch.pairs.len()).filter(is_pressed).collect()
    }

    /// What presses the contacts, by the rows of the response, N.
    pub(super) fn loads(&self) -> DVector<f64> {
        self.loads_by(|position| self.touch.loads[position])
    }

    fn loads_by(&self, load: impl Fn(usize) -> f64) -> DVector<f64> {
        let count = self.touch.pairs.len();
        DVector::from_fn(self.touch.response.nrows(), |row, _| if row < count { load(row) } else { 0.0 })
    }

    /// Whether nothing presses a patch any more that is about to be let go of: it has no friction to break then.
    pub(super) fn is_spent(&self, patch: &Patch, jump: &Jump<Mode>) -> bool {
        let is_spent = |(position, _): &(usize, usize)| {
            let pair = self.touch.pairs[*position];
            jump.mode.is_pressed(pair)
                && self.is_falling(*position, jump)
                && (self.is_unloaded(*position) || self.is_flat(pair, jump))
        };
        patch.contacts.iter().all(is_spent)
    }

    /// Whether the force of a contact becomes less.
    fn is_falling(&self, position: usize, jump: &Jump<Mode>) -> bool {
        let (pair, Touch { rate, free, .. }) =
            (&self.equations.pairs()[self.touch.pairs[position]], &self.touch);
        let Some((stiffness, damping)) = pair.law.coefficients().filter(|_| !pair.is_hertzian()) else {
            return rate[position] > 0.0;
        };
        let coefficients = [stiffness.clone(), damping.clone()];
        let values =
            self.equations.values(&coefficients, &jump.mode, self.now.time, &jump.states, self.now.inputs);
        values.is_ok_and(|values| values[0] * rate[position] + values[1] * free[position] > 0.0)
    }

    /// Whether what presses a contact is nothing beside the other forces.
    fn is_unloaded(&self, position: usize) -> bool {
        self.touch.loads[position] * self.touch.response[(position, position)]
            <= BALANCED * self.touch.strength
    }

    fn is_flat(&self, pair: usize, jump: &Jump<Mode>) -> bool {
        let roots = self.equations.roots(&jump.mode);
        let base = jump.states.len() - roots.len();
        let place = roots.iter().position(|known| *known == pair);
        place
            .is_some_and(|place| jump.states[base + place] <= SPENT * self.now.scales[Measure::Root as usize])
    }

    /// Of what is pressed from now on and does not slip yet, whoever slips from the start, with its way: a compliant surface presses with
    /// nothing at first, and what counts is how its force and the friction that is needed grow.
    pub(super) fn slipping_from_the_start(
        &self,
        some: &[usize],
        patches: &[Patch],
        jump: &Jump<Mode>,
    ) -> Vec<(usize, Way)> {
        let begins =
            |position: usize| jump.mode.is_pressed(self.touch.pairs[position]) && self.is_unloaded(position);
        let growth = self.loads_by(|position| if begins(position) { self.closing(position) } else { 0.0 });
        if growth.amax() == 0.0 {
            return vec![];
        }
        let without = &self.touch.response * &growth;
        let zero = BALANCED * without.amax();
        let growing = Rough { loads: growth, zero, ..self.rough(some, patches, without) };
        let Some(found) = growing.solve() else { return vec![] };
        let slips = patches.iter().zip(&found.grips).filter(|(patch, _)| patch.slips.is_none());
        let begun = slips.filter(|(patch, _)| patch.contacts.iter().all(|(position, _)| begins(*position)));
        let way = |(patch, grip): (&Patch, &Grip)| match grip {
            Grip::Slides(way) | Grip::Strains(way) => Some((self.slipping(patch.row()), *way)),
            Grip::Sticks | Grip::Follows => None,
        };
        begun.filter_map(way).collect()
    }

    /// How fast a gap closes, or begins to; zero where it opens.
    fn closing(&self, position: usize) -> f64 {
        let rate = self.touch.rate[position];
        let stands = rate.abs() <= STANDS * self.touch.speed[position];
        (if stands { -self.touch.free[position] } else { -rate }).max(0.0)
    }

    /// How many derivatives of a slip that begins are zero now, itself included. Where a Hertzian contact begins, they are by a parameter of
    /// which the time is the square at first, and the friction the fourth power's.
    pub(super) fn zeros_of_slip(&self, row: usize, jump: &Jump<Mode>) -> usize {
        let roots = self.equations.roots(&jump.mode).len();
        let begins = jump.states[jump.states.len() - roots..].contains(&0.0);
        let moves = self.then[row].abs() > BALANCED * self.touch.strength;
        match (begins, moves) {
            (false, true) => 1,
            (false, false) | (true, true) => 2,
            (true, false) => 5,
        }
    }
}
