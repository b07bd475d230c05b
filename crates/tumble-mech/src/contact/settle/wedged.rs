//! Contacts that slip where no force of the surface, or more than one, would hold the body up: refused by name.

use nalgebra::{DMatrix, DVector};
use tumble_ode::Reason;

use super::{Settling, Touched};
use crate::contact::complementarity::DEPENDENT;
use crate::contact::grip::Grip;
use crate::contact::slip::WEDGED;
use crate::contact::sticking::{Patch, Pushes};
use crate::mode::Mode;
use crate::record::Jump;

/// A push that moves a contact away by less than this part of what friction moves it along does not move it: rounding.
const IMMOVABLE: f64 = 1e-12;

/// Masses that differ by more: contacts of a light body between heavy ones seem to depend on each other then, since what the heavy ones yield
/// is no more than that part of what the light one does. A tenth of it is left for levers.
const UNLIKE: f64 = 0.1 / DEPENDENT;

/// The way out where no forces are, for messages.
const BY_IMPACT: &str = "`painleve = \"impact\"`, by which an impulse stops what slips";

impl Settling<'_> {
    /// Refuses what slips so that friction takes all that a push would move (Painleve), of some contacts that pushes hold.
    pub(super) fn refuse_wedged(
        &self,
        some: &[usize],
        patches: &[Patch],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Result<(), Reason> {
        let slipping = patches.iter().filter_map(|patch| Some((patch, patch.slips?)));
        let alone =
            slipping.filter(|(patch, _)| matches!(patch.contacts[..], [(only, _)] if some.contains(&only)));
        for (patch, way) in alone {
            let (position, row) = patch.contacts[0];
            let response = self.touch.pushes();
            let (own, by) = (response[(position, position)], response[(position, row)]);
            if own <= IMMOVABLE * response[(row, row)] {
                return Err(self.immovable(position));
            }
            let left = own - f64::from(way.sign()) * patch.friction[1] * by;
            if left <= WEDGED * own || touched.wedged.contains(&self.touch.pairs[position]) {
                let motions = self.possible_motions(some, patches);
                return Err(self.wedged(position, [patch.friction[1], own / by.abs()], &motions, jump));
            }
        }
        Ok(())
    }

    /// The same where others hold its bodies too: of what was found, or, where nothing was, of what slips while all others hold.
    pub(super) fn refuse_wedged_among(
        &self,
        some: &[usize],
        patches: &[Patch],
        found: Option<&Pushes>,
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Result<(), Reason> {
        let guess = |patch: &Patch| patch.slips.map_or(Grip::Sticks, Grip::Slides);
        let grips: Vec<Grip> =
            found.map_or_else(|| patches.iter().map(guess).collect(), |found| found.grips.clone());
        let held = found.map_or(some, |found| &found.held);
        for (index, (patch, grip)) in patches.iter().zip(&grips).enumerate() {
            let (position, row) = patch.contacts[0];
            let is_one = patch.contacts.len() == 1 && held.len() > 1 && held.contains(&position);
            let own = &self.equations.pairs()[self.slipping(row)];
            if !(is_one && matches!(grip, Grip::Slides(_))) || own.is_rolling() || own.is_central() {
                continue;
            }
            let mut smooth = patches.to_vec();
            smooth[index].friction = [0.0; 2];
            let left = |patches: &[Patch]| self.yielding(held, position, patches, &grips);
            let Some((own, left)) = left(&smooth).zip(left(patches)) else { continue };
            if left <= WEDGED * own || touched.wedged.contains(&self.touch.pairs[position]) {
                let kinetic = patch.friction[1];
                let motions = self.possible_motions(some, patches);
                return Err(self.wedged(position, [kinetic, kinetic * own / (own - left)], &motions, jump));
            }
        }
        Ok(())
    }

    /// How much a push at one of some contacts moves it while the others hold, 1/kg.
    fn yielding(&self, held: &[usize], position: usize, patches: &[Patch], grips: &[Grip]) -> Option<f64> {
        let across = self.forces(held, patches).reduced(grips)?.matrix;
        let place = held.iter().position(|known| *known == position)?;
        let mut unit = DVector::zeros(held.len());
        unit[place] = 1.0;
        across.lu().solve(&unit).map(|push| 1.0 / push[place])
    }

    /// Refuses contacts whose force is fed back by loads that read it so much that it moves nothing away.
    pub(super) fn refuse_jammed(&self, some: &[usize], mode: &Mode) -> Result<(), Reason> {
        let part = |position: usize| {
            self.touch.pushes()[(position, position)] / self.touch.response[(position, position)]
        };
        let mut jammed = some.iter().map(|position| (*position, part(*position)));
        match jammed.find(|(_, left)| *left <= WEDGED) {
            Some((position, left)) => Err(self.jammed(position, left, mode)),
            None => Ok(()),
        }
    }

    /// Why some contacts have no forces: loads that read them feed back too much of them, friction leaves none, or else what nobody knows.
    pub(super) fn without_forces(&self, some: &[usize], touched: &Touched, jump: &Jump<Mode>) -> Reason {
        let own = |matrix: DMatrix<f64>| match matrix.try_inverse() {
            Some(inverse) => inverse.diagonal().map(|push| 1.0 / push),
            None => DVector::zeros(some.len()),
        };
        let left = own(self.pushes(some)).component_div(&own(self.response(some)));
        let least =
            (0..some.len()).filter(|i| left[*i] <= WEDGED).min_by(|i, j| left[*i].total_cmp(&left[*j]));
        match least {
            Some(index) if self.touch.is_fed() => self.jammed(some[index], left[index], &jump.mode),
            _ if self.touch.unlike > UNLIKE => self.too_unlike(),
            _ => self.paradox(some, touched, jump).unwrap_or_else(|| self.unsolved("contact")),
        }
    }

    /// Painleve's configuration of several contacts by its name: what slips goes on so, and whichever of them press, stick or begin to
    /// slide, no forces are as friction has them. `None` where some are.
    fn paradox(&self, some: &[usize], touched: &Touched, jump: &Jump<Mode>) -> Option<Reason> {
        let patches = self.slipping_patches(some, touched, jump);
        if self.has_motions(some, &patches)? {
            return None;
        }
        let slides = |patch: &Patch| {
            let name = &self.equations.pairs()[self.slipping(patch.slips.map(|_| patch.row())?)].name;
            Some(format!("`{name}` slides with the kinetic coefficient {}", patch.friction[1]))
        };
        let slides: Vec<String> = patches.iter().filter_map(slides).collect();
        (!slides.is_empty()).then(|| {
            Reason::Model(format!(
                "{}: no forces hold {} then, whichever of the contacts press, stick or open (Painleve's paradox, of several contacts). Take less \
                 friction, another speed, a compliant surface, or {BY_IMPACT}",
                slides.join(", "),
                self.equations.body_names(&self.island)
            ))
        })
    }

    /// Bodies whose masses differ so much that rounding says whether anything holds the light ones.
    fn too_unlike(&self) -> Reason {
        Reason::Model(format!(
            "masses of {} differ by a factor of {:.1e}, and they touch: what the heavy ones yield is lost in the rounding of what the light ones \
             do. Take masses that differ by less than {UNLIKE:.0e}, or a surface in the place of the heaviest body",
            self.equations.body_names(&self.island),
            self.touch.unlike
        ))
    }

    fn jammed(&self, position: usize, left: f64, mode: &Mode) -> Reason {
        let force = self.equations.pairs()[self.touch.pairs[position]].force_symbol();
        Reason::Model(self.equations.jammed(&force, mode, left))
    }

    /// What is held by others so that the surface cannot push it away.
    fn immovable(&self, position: usize) -> Reason {
        let pair = &self.equations.pairs()[self.touch.pairs[position]];
        let body = &self.equations.model().bodies[pair.body].name;
        Reason::Model(format!(
            "`{}` slips where joints or pivots hold `{body}` so that no push moves it away: how hard the two press on each other, and with it \
             the friction, is not determined. Leave a gap between them, or name those that the surface meets in `on`",
            pair.name
        ))
    }

    /// Painleve's configuration by its name.
    fn wedged(
        &self,
        position: usize,
        [friction, most]: [f64; 2],
        motions: &str,
        jump: &Jump<Mode>,
    ) -> Reason {
        let pair = &self.equations.pairs()[self.touch.pairs[position]];
        let body = &self.equations.model().bodies[pair.body];
        let formulas = [body.kinematics().angle()];
        let angle = self
            .equations
            .values(&formulas, &jump.mode, self.now.time, &jump.states, self.now.inputs)
            .map_or(f64::NAN, |values| values[0]);
        let ways_out = match self.touch.free[position] >= -self.zero() {
            true => "another speed, or a compliant surface".to_owned(),
            false => format!("another speed, a compliant surface, or {BY_IMPACT}"),
        };
        Reason::Model(format!(
            "`{}` slips with the kinetic coefficient {friction} while `{}` is at {angle} rad: from {most} on, friction takes all that a \
             push of the surface would move there, and no force holds the body up or several do (Painleve's paradox). {motions}. Take less \
             friction, another angle, {ways_out}",
            pair.name, body.name
        ))
    }
}
