//! Friction of what slides while impacts end that are too low to be followed.
//!
//! Their impulses along the normal come to `N T - m v`: N is the force that will hold the contact, T the time that they take, and m v the
//! momentum with which it now rises, which gravity takes away. Friction is mu of that, and done at once, as in any impact: so the
//! energy only falls. If only what is missing of `mu N T` came now, it would push what slides on at first: the energy would rise for as long as T.
//! Until T has passed the surfaces have no friction; what is left out is of the order of its square.

use nalgebra::DVector;
use tumble_ode::Reason;

use super::ending::Ending;
use super::rubbing::Rubbing;
use super::{Lasting, Settling};
use crate::contact::complementarity::standing;
use crate::contact::contact_mode::ContactMode;
use crate::contact::grip::Grip;
use crate::mode::Mode;
use crate::record::Jump;

/// A slip that is left with less than this part of what friction takes of it meanwhile stops: what is left out is much less.
const LEFT: f64 = 1e-6;

impl Settling<'_> {
    /// For how long impacts go on that are not followed, s; `None` where nothing does, or where it is no time among those of numbers.
    pub(super) fn meanwhile(&self, zeno: Option<&Ending>) -> Option<f64> {
        zeno.map(|zeno| zeno.time).filter(|time| self.now.time + time > self.now.time)
    }

    /// Lets friction of what slides do at once what it does until the impacts have ended.
    pub(super) fn rub_meanwhile(
        &mut self,
        lasting: &Lasting,
        zeno: Option<&Ending>,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let (Some(time), Some(rubbing)) = (self.meanwhile(zeno), &lasting.rubbing) else { return Ok(()) };
        // Where such impacts go on already, a part of it has been done.
        let goes_on = |position: &usize| {
            jump.mode.contact_mode(self.touch.pairs[*position]) == Some(ContactMode::Settling)
        };
        if rubbing.found.held.iter().any(goes_on) {
            jump.early = time.max(jump.early);
        }
        let rubbed = self.rubbed(rubbing, &lasting.held(), time).ok_or_else(|| self.unsolved("contact"))?;
        self.stop(&rubbed, jump)
    }

    /// What friction of what slides does in a time, N s, with what keeps standing what stands.
    fn rubbed(
        &self,
        Rubbing { patches, found, .. }: &Rubbing,
        kept: &[usize],
        time: f64,
    ) -> Option<DVector<f64>> {
        let mut along = DVector::zeros(found.pushes.len());
        let sliding = patches.iter().zip(&found.grips).filter(|(_, grip)| matches!(grip, Grip::Slides(_)));
        for (position, row) in sliding.flat_map(|(patch, _)| &patch.contacts) {
            if found.held.contains(position) {
                along[*row] = found.pushes[*row] * time;
            }
        }
        let without = &self.touch.response * &along;
        // What friction of what slides makes independent may not be so without it.
        let with_friction = || {
            let rough = self.rough(&found.held, patches, without.clone());
            Some(rough.stopped(&found.grips, &found.held)?.pushes)
        };
        Some(standing(&self.touch.response, &without, kept).or_else(with_friction)? + along)
    }

    /// Pairs that slip and will have stopped when a time has passed.
    pub(super) fn stopping_within(&self, Rubbing { patches, found, .. }: &Rubbing, time: f64) -> Vec<usize> {
        let stops = |row: usize, grip: &Grip| match grip {
            Grip::Slides(way) => {
                let now = self.touch.slips.rate[row - self.touch.pairs.len()];
                let rubbed = (found.pushes[row] * self.touch.response[(row, row)] * time).abs();
                f64::from(way.sign()) * (now + found.then[row] * time) <= LEFT * rubbed
            }
            _ => false,
        };
        let slip = patches.iter().zip(&found.grips).filter(|(patch, _)| patch.slips.is_some());
        let stopping = slip.filter(|(patch, grip)| stops(patch.row(), grip));
        stopping.flat_map(|(patch, _)| patch.contacts.iter().map(|(_, row)| self.slipping(*row))).collect()
    }
}
