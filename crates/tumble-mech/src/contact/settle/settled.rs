//! What lasts once impacts are over: it is looked at again until what was made to stand lets nothing fall or close.

use std::collections::BTreeSet;

use tumble_ode::Reason;

use super::ending::Ending;
use super::{Lasting, STANDS, Settling, Touched};
use crate::contact::complementarity::standing;
use crate::contact::zeno::flight;
use crate::mode::Mode;
use crate::record::Jump;

impl Settling<'_> {
    /// What lasts, and impacts that end by themselves. What stands only since rates of others were taken away, or would be back within the shortest
    /// step, is held too: its guard would see it neither go nor come.
    pub(super) fn settled(
        &mut self,
        touched: &Touched,
        jump: &mut Jump<Mode>,
    ) -> Result<(Lasting, Option<Ending>), Reason> {
        let mut held = BTreeSet::new();
        loop {
            let zeno = self.zeno();
            let slow = zeno.iter().flat_map(|zeno| &zeno.slow.pairs);
            let stopped = touched.stopped.iter().filter(|pair| !self.is_carried_on(**pair)).chain(slow);
            let stopped = stopped.copied().collect();
            let touched = &Touched { stopped, ..touched.clone() };
            // Bounces that go on are ended first, which may leave other slips.
            let is_over = zeno.is_none() || self.is_ended;
            if is_over && self.impacts_without_collision(zeno.as_ref(), touched, jump)? {
                self.impacts(touched, jump)?;
                continue;
            }
            let others = jump.record.others.len();
            let Some(lasting) = self.lasting(touched, zeno.as_ref(), jump)? else { continue };
            if self.pass_ends(&lasting, touched, jump)? {
                jump.record.others.truncate(others);
                continue;
            }
            let mut falling = if zeno.is_none() { self.falling_back(&lasting, touched) } else { vec![] };
            falling.retain(|position| held.insert(*position));
            if zeno.is_some() || self.is_ended {
                self.stop_with(&lasting, touched, jump)?;
                self.move_ahead(&lasting, jump)?;
            }
            let is_struck = falling.is_empty() && self.impacts(touched, jump)?;
            if falling.is_empty() && !is_struck {
                self.rub_meanwhile(&lasting, zeno.as_ref(), jump)?;
                // Friction of what slides is ahead of the forces that open these.
                let opens = |position: &usize| self.then[*position] > self.zero();
                let ahead: Vec<usize> = self.about_to_close(touched).into_iter().filter(opens).collect();
                self.take_for_still(&ahead);
                return Ok((lasting, zeno));
            }
            jump.record.others.truncate(others);
            self.take_for_still(&falling);
            self.take_part(falling);
        }
    }

    /// The rates of these are none.
    pub(super) fn take_for_still(&mut self, some: &[usize]) {
        for &position in some {
            self.speed[position] = self.speed[position].max(2.0 * self.touch.rate[position].abs() / STANDS);
        }
    }

    /// Takes away the rates of what closes only since impacts that end by themselves were ended at once: struck, it would set these going again,
    /// and so on without end. Velocities are projected on those with which all of it stands, which takes energy and never gives any.
    fn stop_with(
        &mut self,
        lasting: &Lasting,
        touched: &Touched,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let mut kept = lasting.held();
        loop {
            let closing = self.about_to_close(touched);
            if closing.is_empty() || closing.iter().any(|position| kept.contains(position)) {
                return Ok(());
            }
            kept.extend(closing);
            // What depends on others is struck.
            let Some(stop) = standing(&self.touch.response, &self.rates(), &kept) else { return Ok(()) };
            self.stop(&stop, jump)?;
        }
    }

    /// Whether a slip that came to its stop at the instant of an impact goes on with what that made of it.
    fn is_carried_on(&self, pair: usize) -> bool {
        let Some(slip) = self.touch.slips.pairs.iter().position(|known| *known == pair) else { return false };
        let row = self.touch.pairs.len() + slip;
        let change = self.touch.response.row(row).transpose().dot(&self.impulses);
        change.abs() > self.still(slip)
    }

    /// Contacts that are not held and close at once: they stand, or open for less than the shortest step.
    fn falling_back(&self, lasting: &Lasting, touched: &Touched) -> Vec<usize> {
        let rate = &self.touch.rate;
        let falls_back = |position: &usize| {
            let (position, then) = (*position, self.then[*position]);
            let is_short = rate[position] > 0.0 && flight(0.0, rate[position], then) <= self.shortest();
            let falls = then < -self.zero() && (self.stands(position) || is_short);
            falls && !lasting.has(position) && self.may_touch(position, touched)
        };
        (0..rate.len()).filter(falls_back).collect()
    }
}
