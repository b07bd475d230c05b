//! The motions that contacts with friction allow where there may be none or several: every choice of who pushes, sticks and slides is tried.

use nalgebra::DVector;

use super::Settling;
use crate::contact::grip::{Grip, Way};
use crate::contact::rough::{Patch, Pushes};

/// With more contacts than this not all choices are tried: there are up to four for each.
const MOST_EXAMINED: usize = 6;
/// Motions whose accelerations differ by less than this part are one.
const ONE: f64 = 1e-9;

impl Settling<'_> {
    /// What some contacts may do, for a message.
    pub(super) fn possible_motions(&self, some: &[usize], patches: &[Patch]) -> String {
        if some.len() > MOST_EXAMINED {
            return format!(
                "Which of these it is was not examined: more than {MOST_EXAMINED} contacts take part"
            );
        }
        let found = self.motions(some, patches);
        let listed: Vec<String> = found.iter().map(|motion| self.told(some, patches, motion)).collect();
        match listed.len() {
            0 => "No motion without an impact is possible".into(),
            1 => format!("One motion is possible: {}", listed[0]),
            count => format!("{count} motions are possible: {}", listed.join("; or ")),
        }
    }

    /// Every motion once.
    fn motions(&self, some: &[usize], patches: &[Patch]) -> Vec<Pushes> {
        let rough = self.forces(some, patches);
        let mut found: Vec<Pushes> = vec![];
        for grips in choices(patches) {
            for set in 0..1_usize << some.len() {
                let held: Vec<usize> = (0..some.len()).filter(|index| set >> index & 1 == 1).collect();
                let Some(motion) = rough.with_held(&grips, &held) else { continue };
                let size = motion.then.amax().max(self.touch.strength);
                let is_known = |known: &Pushes| (&known.then - &motion.then).amax() <= ONE * size;
                if !found.iter().any(is_known) {
                    found.push(motion);
                }
            }
        }
        found
    }

    fn told(&self, some: &[usize], patches: &[Patch], motion: &Pushes) -> String {
        let each = some.iter().map(|position| {
            let name = &self.equations.pairs()[self.touch.pairs[*position]].name;
            let grip = patches.iter().zip(&motion.grips).find_map(|(patch, grip)| {
                let (_, row) = patch.contacts.iter().find(|(contact, _)| contact == position)?;
                Some((grip, motion.then[*row]))
            });
            if !motion.held.contains(position) {
                return format!("`{name}` opens with {} m/s^2", motion.then[*position]);
            }
            let pushed = format!("the normal force {} N", motion.pushes[*position]);
            match grip {
                None => format!("`{name}` stays closed with {pushed}"),
                Some((Grip::Slides(way), change)) => {
                    let way = if *way == Way::Forward { "forward" } else { "backward" };
                    format!("`{name}` slides {way} with {pushed}, its slip changing by {change} m/s^2")
                }
                Some(_) => format!("`{name}` sticks with {pushed}"),
            }
        });
        each.collect::<Vec<_>>().join(", ")
    }
}

/// All choices of grips; what slips already goes on to.
fn choices(patches: &[Patch]) -> Vec<Vec<Grip>> {
    let free = [Grip::Sticks, Grip::Slides(Way::Forward), Grip::Slides(Way::Backward)];
    patches.iter().fold(vec![vec![]], |choices, patch| {
        let own = patch.slips.map_or(free.to_vec(), |way| vec![Grip::Slides(way)]);
        choices.iter().flat_map(|known| own.iter().map(|grip| [&known[..], &[*grip]].concat())).collect()
    })
}

/// Pushes at these indices of a matrix with which what they are of stands still, of either sign.
pub(in crate::contact) fn held_still(
    matrix: &nalgebra::DMatrix<f64>,
    without: &DVector<f64>,
    held: &[usize],
) -> Option<DVector<f64>> {
    if held.is_empty() {
        return Some(DVector::zeros(without.len()));
    }
    let part = nalgebra::DMatrix::from_fn(held.len(), held.len(), |i, j| matrix[(held[i], held[j])]);
    let right = DVector::from_fn(held.len(), |i, _| -without[held[i]]);
    let own = part.lu().solve(&right).filter(|own| own.iter().all(|push| push.is_finite()))?;
    let mut all = DVector::zeros(without.len());
    held.iter().zip(&own).for_each(|(index, push)| all[*index] = *push);
    Some(all)
}
