//! Friction of what slides while impacts end that are too low to be followed.
//!
//! Their impulses along the normal come to `N T - m v`: N is the force that will hold the contact, T the time that they take, and m v the
//! momentum with which it now rises, which gravity takes away. Friction is mu of that, and done at once, as in any impact: so the
//! energy only falls. If only what is missing of `mu N T` came now, it would push what slides on at first: the energy would rise for as long as T.
//! Until T has passed the surfaces have no friction; what is left out is of the order of its square.
//!
//! That friction may stop what slides, or turn it round, and others press then. Impulses that went on as if nothing had stopped would push slips on
//! against friction, and give energy. So where contacts come to press, stick or slide otherwise, all is done as one impact: compression of
//! several with `w = u + a T + A z`, u the rates now, a what forces do without contacts, and T long enough that nothing bounces any more.

use nalgebra::DVector;
use tumble_ode::Reason;

use super::ending::Ending;
use super::rubbing::Rubbing;
use super::{Lasting, Settling, Touched};
use crate::contact::complementarity::{independent, standing};
use crate::contact::contact_mode::ContactMode;
use crate::contact::grip::Grip;
use crate::contact::sticking::{Patch, Pushes, Rough};
use crate::mode::Mode;
use crate::record::Jump;

/// Impacts that are not followed are looked at for as many times the time that they were found to take, each twice the one before.
const LONGER: u32 = 10;

/// How impacts end that are not followed, as one impact.
pub(super) struct Ended {
    patches: Vec<Patch>,
    /// Impulses until then, with those of forces that act meanwhile, and the rates that are left.
    found: Pushes,
    /// Time until then, s.
    time: f64,
}

impl Ended {
    /// Who sticks and who slides then, by patch.
    pub(super) fn grips(&self) -> &[Grip] {
        &self.found.grips
    }

    /// Whether contacts press, stick and slide then as in what lasts.
    pub(super) fn is_as(&self, lasting: &Pushes) -> bool {
        self.found.grips == lasting.grips && self.found.held == lasting.held
    }
}

impl Settling<'_> {
    /// For how long impacts go on that are not followed, s; `None` where nothing does, or where it is no time among those of numbers.
    pub(super) fn meanwhile(&self, zeno: Option<&Ending>) -> Option<f64> {
        self.resolved(zeno?.time)
    }

    /// A time, if it is one among those of numbers.
    pub(super) fn resolved(&self, time: f64) -> Option<f64> {
        (self.now.time + time > self.now.time).then_some(time)
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

    /// What opens or slides from now on may turn back until impacts have ended that were ended at once, since what slides has no friction until
    /// then: a gap would close and be struck, a slip would stop, impacts be ended at once again, and so on. It moves now as that friction
    /// would make it move.
    pub(super) fn move_ahead(&mut self, lasting: &Lasting, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        let (Some(time), Some(rubbing)) = (self.resolved(self.bounced), &lasting.rubbing) else {
            return Ok(());
        };
        let mut kept = lasting.held();
        let Some(rubbed) = self.rubbed(rubbing, &kept, time) else { return Ok(()) };
        let (mut rates, gained, then) = (self.rates(), &self.touch.response * rubbed, &rubbing.found.then);
        let turns_back = |(row, sign, none): (usize, f64, f64)| {
            let at_its_end = rates[row] + then[row] * time - gained[row];
            (sign * gained[row] > none && sign * at_its_end < 0.0).then_some(row)
        };
        let moving: Vec<usize> =
            self.opening_now(lasting).chain(self.sliding_now(rubbing)).filter_map(turns_back).collect();
        if moving.is_empty() {
            return Ok(());
        }
        moving.iter().for_each(|row| rates[*row] -= gained[*row]);
        kept.extend(moving);
        // What depends on others is left to turn back.
        let Some(ahead) = standing(&self.touch.response, &rates, &kept) else { return Ok(()) };
        self.stop(&ahead, jump)
    }

    /// Rows of the gaps that open from now on, with the sign of their rates and a rate that is none.
    fn opening_now(&self, lasting: &Lasting) -> impl Iterator<Item = (usize, f64, f64)> {
        let opens = |position: &usize| !lasting.has(*position) && self.then[*position] > self.zero();
        let open = self.part.iter().copied().filter(opens);
        open.map(|position| (position, 1.0, self.no_rate(position)))
    }

    /// The same of slips.
    fn sliding_now(
        &self,
        Rubbing { patches, found, .. }: &Rubbing,
    ) -> impl Iterator<Item = (usize, f64, f64)> {
        patches.iter().zip(&found.grips).filter_map(|(patch, grip)| match grip {
            Grip::Slides(way) => {
                let slip = patch.row() - self.touch.pairs.len();
                Some((patch.row(), f64::from(way.sign()), self.still(slip)))
            }
            _ => None,
        })
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

    /// How impacts of some contacts end that are not followed. They may go on for longer than was said, where others press then than those that the
    /// time was found with.
    pub(super) fn ended(
        &self,
        some: &[usize],
        zeno: &Ending,
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Option<Ended> {
        let patches = self.slipping_patches(some, touched, jump);
        let times = (0..LONGER).map(|doubled| zeno.time * f64::from(1 << doubled));
        let mut each = times.map_while(|time| Some((self.pushes_within(some, &patches, time)?, time)));
        let first = each.next()?;
        let is_over = |(found, time): &(Pushes, f64)| {
            let bounces = |position: &usize| found.then[*position] > time * self.zero();
            !some.iter().any(|position| bounces(position) && !self.stands(*position))
        };
        let over = if is_over(&first) { None } else { each.find(is_over) };
        let (found, time) = over.unwrap_or(first);
        Some(Ended { patches, found, time })
    }

    /// Whether forces may hold some contacts as their impacts end.
    pub(super) fn may_last(&self, some: &[usize], ended: &Ended) -> bool {
        let found = self.forces(some, &ended.patches).chosen(&ended.found.grips);
        found.is_some_and(|found| ended.is_as(&found))
    }

    /// Ends impacts that are not followed at once.
    pub(super) fn end_at_once(&mut self, ended: &Ended, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        self.count_round()?;
        let impulses = self.without_forces_meanwhile(ended).ok_or_else(|| self.unsolved("contact"))?;
        self.bounced += ended.time;
        self.is_ended = true;
        self.stop(&impulses, jump)
    }

    /// Rates of all gaps and slips, of which what is taken to have stopped does not slip.
    pub(super) fn rates_slipping(&self, patches: &[Patch]) -> DVector<f64> {
        let mut rates = self.rates();
        let still = patches.iter().filter(|patch| patch.slips.is_none());
        still.flat_map(|patch| &patch.contacts).for_each(|(_, row)| rates[*row] = 0.0);
        rates
    }

    /// Impulses of some contacts with which nothing closes when a time has passed, N s. Friction is taken as in any impact of several: what it
    /// stops, it stops, and does not push on.
    fn pushes_within(&self, some: &[usize], patches: &[Patch], time: f64) -> Option<Pushes> {
        let free: Vec<Patch> = patches.iter().map(|patch| Patch { slips: None, ..patch.clone() }).collect();
        let forces = self.forces(some, &free);
        let without = self.rates_slipping(patches) + &forces.without * time;
        Rough { without, loads: &forces.loads * time, zero: forces.zero * time, ..forces }.solve_directly()
    }

    /// Impulses of impacts that end, but for what forces along the normals do meanwhile: friction of what slides, with what makes stand what is to
    /// stand.
    fn without_forces_meanwhile(&self, Ended { patches, found, .. }: &Ended) -> Option<DVector<f64>> {
        let mut along = DVector::zeros(found.pushes.len());
        let sliding = patches.iter().zip(&found.grips).filter(|(_, grip)| matches!(grip, Grip::Slides(_)));
        for (position, row) in sliding.flat_map(|(patch, _)| &patch.contacts) {
            if found.held.contains(position) {
                along[*row] = found.pushes[*row];
            }
        }
        let rates = self.rates() + &self.touch.response * &along;
        let kept = independent(&self.touch.response, [&found.held[..], &found.holding].concat());
        Some(standing(&self.touch.response, &rates, &kept)? + along)
    }
}
