//! Friction that is shared anew where contacts hold bodies together that fewer could hold; and impulses of friction, as they are told.
//!
//! How much each of them has is not determined, and a mode gives it to few. Where one of these comes to its cone, nothing slips as long as
//! others can take over: of all choices of who has none, that is taken in which those that hold have most to spare.

use nalgebra::DVector;

use super::Settling;
use crate::contact::grip::Grip;
use crate::contact::sticking::{Patch, Pushes, Rough};

/// Who holds has this part of its friction to spare at least, else it is about to slip too.
const SPARE: f64 = 1e-6;
/// An impulse of friction beyond its cone by less than this part is at its border, but for rounding.
const FULL: f64 = 1e-9;
/// With more patches than this not all choices are tried: there are two for each.
const MOST_SHARING: usize = 8;

impl Settling<'_> {
    /// Pushes with which nothing begins to slip, though some patches have come to their cones; `forced` are the patches with the ways in which
    /// these are about to slip.
    pub(super) fn shared(&self, some: &[usize], patches: &[Patch], forced: &[Patch]) -> Option<Pushes> {
        let still: Vec<usize> = (0..patches.len()).filter(|index| patches[*index].slips.is_none()).collect();
        let is_broken = |index: &&usize| forced[**index].slips.is_some();
        let alone = still.iter().filter(is_broken).count() == still.len();
        if alone || still.len() > MOST_SHARING {
            return None;
        }
        let rough = self.forces(some, patches);
        let choice = |free: usize| -> Vec<Grip> {
            let place = |index: usize| still.iter().position(|known| *known == index);
            let grip = |(index, patch): (usize, &Patch)| match (patch.slips, place(index)) {
                (Some(way), _) => Grip::Slides(way),
                (None, Some(place)) if free >> place & 1 == 1 => Grip::Follows,
                (None, _) => Grip::Sticks,
            };
            patches.iter().enumerate().map(grip).collect()
        };
        let tried = (0..1_usize << still.len()).filter_map(|free| {
            let found = rough.attempt(&choice(free))?;
            Some((self.spare(&rough, &found)?, found))
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
        for patch in rough.patches.iter().filter(|patch| patch.slips.is_none()) {
            if found.then[patch.row()].abs() > self.zero() {
                return None;
            }
            let most = patch.friction[0] * rough.normal_of(patch, &found.pushes);
            if found.pushes[patch.row()] != 0.0 {
                least = least.min(1.0 - found.pushes[patch.row()].abs() / most);
            }
        }
        Some(least)
    }
}
