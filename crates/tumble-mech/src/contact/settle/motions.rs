//! The motions that contacts with friction allow where there may be none or several: told, and refused where none of them is the one before.

use tumble_ode::Reason;

use super::Settling;
use super::rubbing::Rubbing;
use crate::contact::contact_mode::ContactMode;
use crate::contact::grip::{Grip, Way};
use crate::contact::possible::Motions;
use crate::contact::sticking::{Patch, Pushes};
use crate::mode::Mode;
use crate::others::{Beyond, Others, PossibleChange, PossibleContact, PossibleMotions};
use crate::record::Jump;

/// With more contacts, or surfaces, than this not all choices are tried: there are up to four for each.
const MOST_EXAMINED: usize = 6;

impl Settling<'_> {
    /// What some contacts may do, for a message.
    pub(super) fn possible_motions(&self, some: &[usize], patches: &[Patch]) -> String {
        match self.motions_of(some, patches) {
            Some(motions) => self.listed(some, patches, &motions, None).told(self.equations),
            None => {
                format!("Which of these it is was not examined: more than {MOST_EXAMINED} contacts take part")
            }
        }
    }

    /// Whether there are motions without an impact; `None` where they are too many to be examined.
    pub(super) fn has_motions(&self, some: &[usize], patches: &[Patch]) -> Option<bool> {
        self.motions_of(some, patches).map(|motions| !motions.found.is_empty() || motions.is_unbounded)
    }

    /// What else may be possible than what was found for some contacts; refused where what was found does not go on as before.
    pub(super) fn other_motions(
        &self,
        some: &[usize],
        rubbing: &Rubbing,
        jump: &Jump<Mode>,
    ) -> Result<Option<Others>, Reason> {
        let Rubbing { patches, forced, found } = rubbing;
        let freedoms = self.touch.freedoms();
        if !self.touch.is_fed() && self.forces(some, patches).is_certain(freedoms) {
            return Ok(None);
        }
        // Impacts of others leave open what was open before.
        let goes_on = self.goes_on(some, patches, found, &jump.mode);
        if goes_on && self.rounds > 0 {
            return Ok(None);
        }
        let Some(motions) = self.motions(some, patches, forced) else { return Ok(Some(Others::Unexamined)) };
        if motions.found.len() < 2 && !motions.is_unbounded {
            return Ok(None);
        }
        let motions = self.listed(some, patches, &motions, Some(found));
        if goes_on {
            return Ok(Some(Others::Possible(motions)));
        }
        Err(Reason::Model(format!(
            "how {} goes on is not determined by rigid bodies with friction. {}. Leave a gap, take less friction, or a compliant surface, on \
             which it counts how hard bodies are pressed",
            self.equations.body_names(&self.island),
            motions.told(self.equations)
        )))
    }

    /// The motions in which what slips goes on so; `None` where they are too many.
    fn motions_of(&self, some: &[usize], patches: &[Patch]) -> Option<Motions> {
        let forced: Vec<Option<Way>> = patches.iter().map(|patch| patch.slips).collect();
        self.motions(some, patches, &forced)
    }

    /// `None` where they are too many.
    fn motions(&self, some: &[usize], patches: &[Patch], forced: &[Option<Way>]) -> Option<Motions> {
        let are_few = some.len() <= MOST_EXAMINED && patches.len() <= MOST_EXAMINED;
        are_few.then(|| self.forces(some, patches).motions(forced))
    }

    /// Whether what was found holds each contact as it was held before this instant.
    fn goes_on(&self, some: &[usize], patches: &[Patch], found: &Pushes, before: &Mode) -> bool {
        let lasts = |position: &usize| {
            let lasted =
                before.contact_mode(self.touch.pairs[*position]).is_some_and(ContactMode::is_lasting);
            lasted == (found.then[*position] <= self.zero())
        };
        let slips = |(patch, grip): (&Patch, &Grip)| {
            let mut own = patch.contacts.iter().map(|(_, row)| self.slipping(*row));
            let known = own.find_map(|pair| before.grip(pair));
            known.is_some_and(|known| known == *grip || (known.is_still() && grip.is_still()))
        };
        some.iter().all(lasts) && patches.iter().zip(&found.grips).all(slips)
    }

    /// What each contact does in each motion; `taken` is the one that goes on.
    fn listed(
        &self,
        some: &[usize],
        patches: &[Patch],
        found: &Motions,
        taken: Option<&Pushes>,
    ) -> PossibleMotions {
        let motions = found.found.iter().map(|motion| self.each(some, patches, motion)).collect();
        let off = |motion: &Pushes, taken: &Pushes| (&motion.then - &taken.then).amax();
        let taken = taken.and_then(|taken| {
            let numbered = found.found.iter().enumerate().map(|(index, motion)| (index, off(motion, taken)));
            numbered.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
        });
        let beyond = match (found.is_unbounded, found.is_between) {
            (true, _) => Beyond::LargerForces,
            (false, true) => Beyond::Between,
            (false, false) => Beyond::None,
        };
        PossibleMotions { motions, taken, beyond }
    }

    fn each(&self, some: &[usize], patches: &[Patch], motion: &Pushes) -> Vec<PossibleContact> {
        let each = some.iter().map(|position| {
            let pair = self.touch.pairs[*position];
            PossibleContact { pair, does: self.does(*position, patches, motion) }
        });
        each.collect()
    }

    fn does(&self, position: usize, patches: &[Patch], motion: &Pushes) -> PossibleChange {
        let number = |value: f64| if value.abs() <= self.zero() { 0.0 } else { value };
        let acceleration = number(motion.then[position]);
        if !motion.held.contains(&position) && acceleration > 0.0 {
            return PossibleChange::Opens { acceleration };
        }
        let push = motion.pushes[position];
        let patch = patches.iter().zip(&motion.grips).find_map(|(patch, grip)| {
            let (_, row) = patch.contacts.iter().find(|(contact, _)| *contact == position)?;
            Some((patch, grip, number(motion.then[*row])))
        });
        match patch {
            None => PossibleChange::Stays { push },
            Some((patch, Grip::Slides(way), change)) => {
                let is_without = patch.slips.is_none() && push == 0.0;
                let way = if is_without { Way::of(change) } else { *way };
                PossibleChange::Slides { way, push, change }
            }
            Some(_) => PossibleChange::Sticks { push },
        }
    }
}
