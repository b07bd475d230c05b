//! What an instant changes where surfaces have friction: who sticks and who slides.

use nalgebra::{DMatrix, DVector};
use tumble_ode::Reason;

use super::ending::Ending;
use super::meanwhile::Ended;
use super::{Lasting, STANDS, Settling, Touched};
use crate::contact::change::Change;
use crate::contact::complementarity::{independent, standing};
use crate::contact::contact_mode::ContactMode;
use crate::contact::grip::{Grip, Way};
use crate::contact::pair::Alike;
use crate::contact::sticking::{Patch, Pushes, Rough};
use crate::contact::touch::stacked_column;
use crate::contact::watched::Watched;
use crate::laws::impact::Painleve;
use crate::mode::Mode;
use crate::record::{Happening, Jump};

/// A contact follows from others that bear more than this part of what it would.
const FOLLOWS: f64 = 1e-6;

/// Contacts with friction that last.
pub(super) struct Rubbing {
    pub(super) patches: Vec<Patch>,
    /// By patch, the way that it slips, or has to from now on.
    pub(super) forced: Vec<Option<Way>>,
    pub(super) found: Pushes,
}

impl Settling<'_> {
    /// Whether any that takes part has friction.
    pub(super) fn is_rough(&self) -> bool {
        self.part.iter().any(|position| self.touch.slips.at(*position).is_some())
    }

    /// Index of what a row along a surface is of among all pairs.
    pub(super) fn slipping(&self, row: usize) -> usize {
        self.touch.slips.pairs[row - self.touch.pairs.len()]
    }

    /// Rates of all gaps and slips.
    pub(super) fn rates(&self) -> DVector<f64> {
        stacked_column(&self.touch.rate, &self.touch.slips.rate)
    }

    /// What slips alike of some contacts, and, where it has a part, what turns; none of it is known to.
    pub(super) fn patches(&self, some: &[usize], with_rolling: bool) -> Vec<Patch> {
        let mut patches: Vec<(Alike, Patch)> = vec![];
        let slips = some.iter().flat_map(|position| self.touch.slips.all_at(*position));
        for slip in slips.filter(|slip| with_rolling || !self.touch.slips.rolls[*slip]) {
            let (index, position) = (self.touch.slips.pairs[slip], self.touch.slips.of[slip]);
            let of = self.equations.pairs()[index].slips_with(index);
            let contact = (position, self.touch.pairs.len() + slip);
            match patches.iter_mut().find(|(known, _)| *known == of) {
                Some((_, patch)) => patch.contacts.push(contact),
                None => {
                    let friction = self.touch.slips.friction[slip];
                    patches.push((of, Patch { contacts: vec![contact], friction, slips: None }));
                }
            }
        }
        patches.into_iter().map(|(_, patch)| patch).collect()
    }

    /// A slip that is none: rounding.
    pub(super) fn still(&self, slip: usize) -> f64 {
        STANDS * self.touch.slips.speed[slip].max(self.pushed(self.touch.pairs.len() + slip))
    }

    /// Rows of a group whose rates are known after an impact, but for rounding: what sticks.
    pub(super) fn standing_slips(&self) -> Vec<usize> {
        let slips = &self.touch.slips;
        let stands = |slip: &usize| {
            let has_part = self.part.contains(&slips.of[*slip]) && !slips.rolls[*slip];
            has_part && slips.rate[*slip].abs() <= self.still(*slip)
        };
        (0..slips.of.len()).filter(stands).map(|slip| self.touch.pairs.len() + slip).collect()
    }

    /// Who sticks and who slides of some contacts that stand still, by a choice that is likely before all are tried; `None` where no forces are found, or one of `all` would close.
    fn rub(
        &self,
        [some, all]: [&[usize]; 2],
        likely: &[Grip],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Result<Option<Rubbing>, Reason> {
        let patches = self.slipping_patches(some, touched, jump);
        self.refuse_wedged(some, &patches, touched, jump)?;
        let beginning = self.slipping_from_the_start(some, &patches, jump);
        let forced = self.forced(&patches, touched, &beginning, jump);
        let zero = self.zero();
        let closes = |found: &Pushes| all.iter().any(|position| found.then[*position] < -zero);
        let shared = forced.as_ref().and_then(|forced| self.shared(some, &patches, forced, &jump.mode));
        if let Some(found) = shared.filter(|found| !closes(found)) {
            let forced = patches.iter().map(|patch| patch.slips).collect();
            return Ok(Some(Rubbing { patches, forced, found }));
        }
        let moves_as_forced = |rough: &Rough<'_>, found: &Pushes| {
            let mut ways = rough.patches.iter().zip(&patches).filter(|(_, own)| own.slips.is_none());
            ways.all(|(patch, _)| {
                patch.slips.is_none_or(|way| f64::from(way.sign()) * found.then[patch.row()] >= -zero)
            })
        };
        let rough = |patches: &[Patch]| self.forces(some, patches);
        let found = forced.as_ref().and_then(|forced| {
            let rough = rough(forced);
            rough.solve_or(likely).filter(|found| moves_as_forced(&rough, found))
        });
        let forced = forced.filter(|_| found.is_some()).unwrap_or_else(|| patches.clone());
        let found = found.or_else(|| rough(&patches).solve_or(likely));
        self.refuse_wedged_among(some, &patches, found.as_ref(), touched, jump)?;
        let Some(found) = found else { return Ok(None) };
        let closes = closes(&found);
        let forced = forced.iter().map(|patch| patch.slips).collect();
        Ok((!closes).then_some(Rubbing { patches, forced, found }))
    }

    /// The same of `some`, or else of all.
    fn rub_some_or_all<'b>(
        &self,
        [some, all]: [&'b [usize]; 2],
        likely: &[Grip],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Result<Option<(&'b [usize], Rubbing)>, Reason> {
        if let Some(rubbing) = self.rub([some, all], likely, touched, jump)? {
            return Ok(Some((some, rubbing)));
        }
        Ok(self.rub([all, all], likely, touched, jump)?.map(|rubbing| (all, rubbing)))
    }

    /// Accelerations of all gaps and slips without forces of contacts that last.
    pub(super) fn accelerations(&self) -> DVector<f64> {
        stacked_column(&self.touch.free, &self.touch.slips.free)
    }

    /// What slips alike of some contacts and of all that is pressed, with the ways that it slips before anything is settled.
    pub(super) fn slipping_patches(
        &self,
        some: &[usize],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Vec<Patch> {
        let patches = self.patches(&[some, &self.pressed(jump)].concat(), true).into_iter();
        patches.map(|patch| Patch { slips: self.slips_now(&patch, touched), ..patch }).collect()
    }

    /// The way that a patch slips before anything is settled, if it does.
    pub(super) fn slips_now(&self, patch: &Patch, touched: &Touched) -> Option<Way> {
        let count = self.touch.pairs.len();
        let is_still = |(_, row): &(usize, usize)| {
            self.touch.slips.rate[row - count].abs() <= self.still(row - count)
                || touched.stopped.contains(&self.slipping(*row))
        };
        let is_still = patch.contacts.iter().any(is_still);
        (!is_still).then(|| Way::of(self.touch.slips.rate[patch.row() - count]))
    }

    /// The patches with those that could not hold any more, or cannot from the start, made to slide the way they were about to.
    fn forced(
        &self,
        patches: &[Patch],
        touched: &Touched,
        beginning: &[(usize, Way)],
        jump: &Jump<Mode>,
    ) -> Option<Vec<Patch>> {
        let way = |patch: &Patch| {
            let broken = |(_, row): &(usize, usize)| {
                let pair = self.slipping(*row);
                let mut broken = touched.broken.iter().chain(beginning);
                broken.find(|(known, _)| *known == pair).map(|(_, way)| *way)
            };
            let mut contacts = patch.contacts.iter().filter(|_| !self.is_spent(patch, jump));
            patch.slips.or_else(|| contacts.find_map(broken))
        };
        let forced: Vec<Patch> =
            patches.iter().map(|patch| Patch { slips: way(patch), ..patch.clone() }).collect();
        let changes = forced.iter().zip(patches).any(|(new, old)| new.slips != old.slips);
        changes.then_some(forced)
    }

    /// Which contacts last, with friction: `some` of `all` that stand still, or all where one would close otherwise.
    pub(super) fn lasting_with_friction(
        &mut self,
        [some, all]: [&[usize]; 2],
        zeno: Option<&Ending>,
        touched: &Touched,
        jump: &mut Jump<Mode>,
    ) -> Result<Option<Lasting>, Reason> {
        let ended = zeno.filter(|_| !self.is_ended).and_then(|zeno| self.ended(all, zeno, touched, jump));
        // A model that refuses what no forces hold is told of it first.
        let is_refused = self.equations.model().painleve == Painleve::Refused;
        if let Some(ended) = ended.as_ref().filter(|ended| !is_refused && !self.may_last(all, ended)) {
            self.end_at_once(ended, jump)?;
            return Ok(None);
        }
        let likely = ended.as_ref().map_or(&[][..], Ended::grips);
        let rubbing = self.rub_some_or_all([some, all], likely, touched, jump);
        let lasts = |ended: &Ended| match &rubbing {
            Ok(Some((_, rubbing))) => ended.is_as(&rubbing.found),
            _ => is_refused,
        };
        if let Some(ended) = ended.filter(|ended| !lasts(ended)) {
            self.end_at_once(&ended, jump)?;
            return Ok(None);
        }
        let (some, rubbing) = rubbing?.ok_or_else(|| self.without_forces(all, touched, jump))?;
        self.refuse_undetermined(some, &rubbing)?;
        let others = self.other_motions(some, &rubbing, jump)?;
        let modes = self.held_by_friction(some, &rubbing, jump)?;
        // What was left of the rates is gone: a slip that was as small may have turned round with it, and has come to zero then.
        let turned = self.turned(&rubbing);
        if turned.iter().any(|pair| !touched.stopped.contains(pair)) {
            let mut touched = touched.clone();
            touched.stopped.extend(turned);
            return self.lasting_with_friction([some, all], zeno, &touched, jump);
        }
        jump.record.others.extend(others);
        Ok(Some(Lasting { modes, rubbing: Some(rubbing) }))
    }

    /// Refuses what slides with different friction along one edge, or on several feet, where more contacts bear it than are needed: what each of
    /// them bears is open, and with it the motion.
    fn refuse_undetermined(
        &self,
        some: &[usize],
        Rubbing { patches, found, .. }: &Rubbing,
    ) -> Result<(), Reason> {
        let zero = self.zero();
        let kinetic = |position: usize| {
            let mut own = patches.iter().zip(&found.grips);
            let (patch, grip) =
                own.find(|(patch, _)| patch.contacts.iter().any(|(known, _)| *known == position))?;
            match grip {
                Grip::Slides(_) => Some(patch.friction[1]),
                _ => None,
            }
        };
        let response = |row: usize, column: usize| self.touch.pushes()[(row, column)];
        let held = &found.held;
        if held.is_empty() {
            return Ok(());
        }
        let idle = some.iter().filter(|position| !held.contains(position) && found.then[**position] <= zero);
        for &idle in idle {
            let Some(own) = kinetic(idle) else { continue };
            let among = DMatrix::from_fn(held.len(), held.len(), |i, j| response(held[i], held[j]));
            let Some(shares) =
                among.lu().solve(&DVector::from_fn(held.len(), |i, _| response(held[i], idle)))
            else {
                continue;
            };
            let mut bearing = held.iter().zip(&shares).filter(|(_, share)| share.abs() > FOLLOWS);
            if let Some((other, _)) =
                bearing.find(|(other, _)| kinetic(**other).is_some_and(|other| other != own))
            {
                let [one, other] =
                    [idle, *other].map(|position| &self.equations.pairs()[self.touch.pairs[position]].name);
                return Err(Reason::Model(format!(
                    "`{one}` and `{other}` slide with different friction, and more places bear the load than are needed: how much each of them \
                     bears is not determined, and the motion depends on it. Take one friction for both, or let one place less touch"
                )));
            }
        }
        Ok(())
    }

    /// Pairs that slipped and slip no more, or against the way in which they were found to slide.
    fn turned(&self, Rubbing { patches, found, .. }: &Rubbing) -> Vec<usize> {
        let slips = &self.touch.slips;
        let is_turned = |patch: &Patch, grip: &Grip| match (patch.slips, grip) {
            (Some(_), Grip::Slides(way)) => {
                let slip = patch.row() - self.touch.pairs.len();
                f64::from(way.sign()) * slips.rate[slip] <= self.still(slip)
            }
            _ => false,
        };
        let turned = patches.iter().zip(&found.grips).filter(|(patch, grip)| is_turned(patch, grip));
        turned.flat_map(|(patch, _)| patch.contacts.iter().map(|(_, row)| self.slipping(*row))).collect()
    }

    /// The problem of some contacts with what they would do without pushes.
    pub(super) fn rough(&self, some: &[usize], patches: &[Patch], without: DVector<f64>) -> Rough<'_> {
        Rough {
            response: &self.touch.response,
            without,
            contacts: some.to_vec(),
            patches: patches.to_vec(),
            given: DVector::zeros(self.touch.response.nrows()),
            loads: DVector::zeros(self.touch.response.nrows()),
            zero: self.zero(),
        }
    }

    /// The problem of the forces of some contacts.
    pub(super) fn forces(&self, some: &[usize], patches: &[Patch]) -> Rough<'_> {
        Rough {
            response: self.touch.pushes(),
            loads: self.loads(),
            ..self.rough(some, patches, self.accelerations())
        }
    }

    /// Contact modes of what was found for some contacts; velocities are made to stand.
    fn held_by_friction(
        &mut self,
        some: &[usize],
        rubbing: &Rubbing,
        jump: &mut Jump<Mode>,
    ) -> Result<Vec<(usize, ContactMode)>, Reason> {
        let Rubbing { patches, found, .. } = rubbing;
        self.then = found.then.clone();
        let zero = self.zero();
        let contact_mode = |position: &usize| match found.held.contains(position) {
            true => Some((*position, ContactMode::Resting)),
            false if found.then[*position] <= zero => Some((*position, ContactMode::Idle)),
            false => None,
        };
        let staying = self.staying.iter().filter(|position| !some.contains(position));
        let modes = some.iter().chain(staying).filter_map(contact_mode).collect();
        let stop = self.rough(&found.held, patches, self.rates());
        let stop = stop.stopped(&found.grips, &found.held).ok_or_else(|| self.unsolved("contact"))?;
        self.stop(&stop.pushes, jump)?;
        self.stop_against(rubbing, jump)?;
        Ok(modes)
    }

    /// Takes away what is left of slips that were taken to have stopped, where they are to slide on against it: they have come to zero first.
    fn stop_against(
        &mut self,
        Rubbing { patches, found, .. }: &Rubbing,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let mut kept = [&found.held[..], &found.holding].concat();
        loop {
            let is_against = |(patch, grip): &(&Patch, &Grip)| match grip {
                Grip::Slides(way) if patch.slips.is_none() => {
                    let slip = patch.row() - self.touch.pairs.len();
                    f64::from(way.sign()) * self.touch.slips.rate[slip] < -self.still(slip)
                }
                _ => false,
            };
            let against = patches.iter().zip(&found.grips).filter(is_against).map(|(patch, _)| patch.row());
            let more: Vec<usize> = against.filter(|row| !kept.contains(row)).collect();
            if more.is_empty() {
                return Ok(());
            }
            kept.extend(more);
            let response = &self.touch.response;
            let stop = standing(response, &self.rates(), &independent(response, kept.iter().copied()));
            self.stop(&stop.ok_or_else(|| self.unsolved("contact"))?, jump)?;
        }
    }

    /// Writes how contacts are held along their surfaces into the jump.
    pub(super) fn arrange_grips(&self, rubbing: Option<&Rubbing>, jump: &mut Jump<Mode>) {
        let before = jump.mode.grips.clone();
        for &pair in &self.touch.pairs {
            self.equations.pair_list().rubbing(pair).for_each(|own| jump.mode.set_grip(own, None));
            jump.mode.still.retain(|body| !self.equations.pairs()[pair].has(*body));
        }
        let Some(Rubbing { patches, found, .. }) = rubbing else { return };
        for (patch, grip) in patches.iter().zip(&found.grips) {
            let holds = patch.contacts.iter().any(|(_, row)| found.holding.contains(row));
            let touches = |position: &usize| {
                found.held.contains(position) || jump.mode.is_pressed(self.touch.pairs[*position])
            };
            let held: Vec<&(usize, usize)> =
                patch.contacts.iter().filter(|(position, _)| touches(position)).collect();
            for (index, (_, row)) in held.into_iter().enumerate() {
                let own = match grip {
                    Grip::Sticks if index > 0 || !holds => Grip::Follows,
                    other => *other,
                };
                jump.mode.set_grip(self.slipping(*row), Some(own));
                if index == 0 {
                    self.tell_grip(*row, patch, *grip, &before, jump);
                }
            }
        }
        self.keep_still(found, jump);
    }

    /// Says when a patch begins to stick, to roll or to slide, and where its slip begins at zero.
    fn tell_grip(
        &self,
        row: usize,
        patch: &Patch,
        grip: Grip,
        before: &[(usize, Grip)],
        jump: &mut Jump<Mode>,
    ) {
        let pair = self.slipping(row);
        let own = |pair: usize| patch.contacts.iter().any(|(_, row)| self.slipping(*row) == pair);
        let known = before.iter().find(|(other, _)| own(*other)).map(|(_, grip)| *grip);
        let rolls = self.equations.pairs()[pair].is_rolling();
        let change = match (grip, known) {
            (Grip::Slides(way), Some(Grip::Slides(before))) if way == before => None,
            (Grip::Slides(_), _) if rolls => Some(Change::Turns),
            (Grip::Slides(_), _) => Some(Change::Slides),
            (_, Some(known)) if known.is_still() => None,
            _ if rolls => Some(Change::Stops),
            _ if self.equations.pairs()[pair].is_round() => Some(Change::Rolls),
            _ => Some(Change::Sticks),
        };
        jump.record.happened.extend(change.map(|change| Happening::Contact { pair, change }));
        if let (Grip::Slides(_), None) = (grip, patch.slips) {
            let zeros = self.zeros_of_slip(patch.row(), jump);
            jump.zeros.push((self.equations.pairs()[pair].guard_name(Watched::Slip), zeros));
        }
    }

    /// What is held so that it cannot move is not integrated: it does not creep by what rounding leaves of its forces.
    fn keep_still(&self, found: &Pushes, jump: &mut Jump<Mode>) {
        // What nothing presses does not hold by friction.
        let touches = |position: &usize| {
            found.held.contains(position) || jump.mode.is_pressed(self.touch.pairs[*position])
        };
        let is_pressed = |row: &&usize| touches(&self.touch.slips.of[**row - self.touch.pairs.len()]);
        let holding: Vec<usize> = found.holding.iter().filter(is_pressed).copied().collect();
        let held = [&found.held[..], &holding].concat();
        let sticks = |position: usize| {
            let mut own = self.touch.slips.all_at(position);
            own.any(|slip| holding.contains(&(self.touch.pairs.len() + slip)))
        };
        let holds = |position: &usize| found.held.contains(position) || sticks(*position);
        let mut holding = (0..self.touch.pairs.len()).filter(holds);
        let is_fixed = holding.all(|position| self.equations.pairs()[self.touch.pairs[position]].is_fixed());
        let of = |body: &usize| self.equations.free_velocity_states(&jump.mode, *body, &jump.states);
        let velocities: Vec<usize> = self.island.iter().flat_map(of).collect();
        let is_free = self.equations.independent_rows_of(&jump.mode, &self.island).is_empty();
        let is_carried = self.island.iter().any(|body| self.equations.is_carried(*body));
        if !(is_free && is_fixed && held.len() == velocities.len() && !is_carried) {
            return;
        }
        velocities.into_iter().for_each(|state| jump.states[state] = 0.0);
        jump.mode.still.extend(&self.island);
        jump.mode.still.sort_unstable();
    }
}
