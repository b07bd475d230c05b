//! Friction that is shared anew where contacts hold bodies together that fewer could hold; and impulses of friction, as they are told.
//!
//! How much each of them has is not determined, and a mode gives it to few. Where one of these comes to its cone, nothing slips as long as
//! others can take over: of all choices of who has none, or all that it can have, that is taken in which those that hold have most to spare; the
//! normals that are found bear, or else any set of them.

use nalgebra::DVector;

use super::Settling;
use crate::contact::complementarity::following;
use crate::contact::grip::{Grip, Way};
use crate::contact::sticking::{MOST_TRIED, Patch, Pushes, Rough};
use crate::mode::Mode;

/// Who holds has this part of its friction to spare at least, else it is about to slip too.
const SPARE: f64 = 1e-6;
/// An impulse of friction beyond its cone by less than this part is at its border, but for rounding.
const FULL: f64 = 1e-9;
/// With more patches than this not all choices are tried: there are two for each.
const MOST_SHARING: usize = 8;

/// A patch that has come to its cone, and the way in which it is about to slip.
type Broken = (usize, Way);
/// The normals that bear; `None` are those that are found.
type Bearing = Option<Vec<usize>>;

impl Settling<'_> {
    /// Pushes with which nothing begins to slip, though some patches have come to their cones; `forced` are the patches with the ways in which
    /// these are about to slip. First without those that others make up for; else with all the friction that they can have.
    pub(super) fn shared(
        &self,
        some: &[usize],
        patches: &[Patch],
        forced: &[Patch],
        before: &Mode,
    ) -> Option<Pushes> {
        let still: Vec<usize> = (0..patches.len()).filter(|index| patches[*index].slips.is_none()).collect();
        let is_broken = |index: &&usize| forced[**index].slips.is_some();
        let alone = still.iter().filter(is_broken).count() == still.len();
        if alone || still.len() > MOST_SHARING {
            return None;
        }
        let rough = self.forces(some, patches);
        let broken: Vec<Broken> =
            still.iter().filter_map(|index| Some((*index, forced[*index].slips?))).collect();
        let with = |strained: &[Broken], sets: &[Bearing]| {
            let is_open = |index: &usize| strained.iter().all(|(own, _)| own != index);
            let open: Vec<usize> = still.iter().copied().filter(is_open).collect();
            self.most_to_spare(&rough, &open, (&broken, strained), sets)
        };
        let or_before = || -> Vec<Broken> {
            let way = |index: usize| forced[index].slips.or(self.strained_before(&patches[index], before));
            still.iter().filter_map(|index| Some((*index, way(*index)?))).collect()
        };
        let is_small = some.len() <= MOST_TRIED;
        let ways = |sets: &[Bearing]| {
            let with = |strained: &[Broken]| with(strained, sets);
            with(&[]).or_else(|| with(&broken)).or_else(|| with(&or_before()))
        };
        // Which normals bear may be open too.
        let sets = || -> Vec<_> { rough.all_sets().into_iter().map(Some).collect() };
        ways(&[None]).or_else(|| is_small.then(|| ways(&sets())).flatten())
    }

    /// The way that a patch was held with all the friction that it could have.
    fn strained_before(&self, patch: &Patch, before: &Mode) -> Option<Way> {
        let grips = patch.contacts.iter().filter_map(|(_, row)| before.grip(self.slipping(*row)));
        grips.into_iter().find_map(|grip| if let Grip::Strains(way) = grip { Some(way) } else { None })
    }

    /// Of all choices of who of `open` has no friction, and of these sets of normals that bear, that in which those that hold have most to spare.
    fn most_to_spare(
        &self,
        rough: &Rough<'_>,
        open: &[usize],
        (broken, strained): (&[Broken], &[Broken]),
        sets: &[Bearing],
    ) -> Option<Pushes> {
        let choice = |free: usize| -> Vec<Grip> {
            let place = |index: usize| open.iter().position(|known| *known == index);
            let grip = |(index, patch): (usize, &Patch)| match (patch.slips, place(index)) {
                (Some(way), _) => Grip::Slides(way),
                (None, Some(place)) if free >> place & 1 == 1 => Grip::Follows,
                (None, Some(_)) => Grip::Sticks,
                (None, None) => strained
                    .iter()
                    .find(|(own, _)| *own == index)
                    .map_or(Grip::Sticks, |(_, way)| Grip::Strains(*way)),
            };
            rough.patches.iter().enumerate().map(grip).collect()
        };
        let choices = (0..1_usize << open.len()).map(choice);
        let all = choices.flat_map(|grips| sets.iter().map(move |held| (grips.clone(), held)));
        let tried = all.filter_map(|(grips, held)| {
            let found = match held {
                None => rough.attempt(&grips)?,
                Some(held) => rough.stopped(&grips, held).filter(|found| rough.pushes_apart(found))?,
            };
            // Where loads only begin, nothing moves yet that is not held either.
            let loose = rough.patches.iter().zip(&found.grips).filter(|(_, grip)| is_loose(**grip));
            let free = rough.contacts.iter().filter(|contact| !found.held.contains(contact)).copied();
            let mut rows = loose.map(|(patch, _)| patch.row()).chain(free);
            let are_held = rows.all(|row| found.then[row] > self.zero() || follows(rough, &found, row));
            let has_load = |(index, _): &Broken| {
                found.grips[*index] != Grip::Sticks || rough.has_load(&rough.patches[*index], &found.pushes)
            };
            let is_sound = are_held && broken.iter().all(has_load);
            Some((self.spare(rough, &found).filter(|_| is_sound)?, found))
        });
        let best = tried.max_by(|(one, _), (other, _)| one.total_cmp(other))?;
        (best.0 > SPARE).then_some(best.1)
    }

    /// Impulses of friction. Of several points of a body that slip alike one is given what the others have: where that is more than its cone
    /// lets it have, it is told as the impulses along their normals share the load.
    pub(super) fn shared_by_normals(&self, impulses: &DVector<f64>) -> DVector<f64> {
        let first = self.touch.pairs.len();
        let mut along = impulses.rows(first, self.touch.slips.of.len()).into_owned();
        for patch in self.patches(&self.part, false) {
            let [static_friction, _] = patch.friction;
            let is_beyond = |(position, row): &(usize, usize)| {
                impulses[*row].abs() > (1.0 + FULL) * static_friction * impulses[*position]
            };
            let whole: f64 = patch.contacts.iter().map(|(position, _)| impulses[*position]).sum();
            if whole <= 0.0 || patch.contacts.len() < 2 || !patch.contacts.iter().any(is_beyond) {
                continue;
            }
            let friction: f64 = patch.contacts.iter().map(|(_, row)| impulses[*row]).sum();
            for (position, row) in &patch.contacts {
                along[*row - first] = friction * (impulses[*position] / whole);
            }
        }
        along
    }

    /// The least that any patch that holds has to spare, as a part of its friction; `None` where one slips that is to stand still.
    fn spare(&self, rough: &Rough<'_>, found: &Pushes) -> Option<f64> {
        let mut least = f64::INFINITY;
        let still = rough.patches.iter().zip(&found.grips).filter(|(patch, _)| patch.slips.is_none());
        for (patch, grip) in still {
            if found.then[patch.row()].abs() > self.zero() {
                return None;
            }
            let most = patch.friction[0] * rough.normal_of(patch, &found.pushes);
            // What has all that it can have has nothing to spare, and need not.
            if found.pushes[patch.row()] != 0.0 && !matches!(grip, Grip::Strains(_)) {
                least = least.min(1.0 - found.pushes[patch.row()].abs() / most);
            }
        }
        Some(least)
    }
}

/// Whether what has such a grip is kept in its place by others.
fn is_loose(grip: Grip) -> bool {
    matches!(grip, Grip::Follows | Grip::Strains(_))
}

/// Whether a row cannot move while those that are held do not.
fn follows(rough: &Rough<'_>, found: &Pushes, row: usize) -> bool {
    !following(rough.response, found.held.iter().chain(&found.holding).copied(), &[row]).is_empty()
}
