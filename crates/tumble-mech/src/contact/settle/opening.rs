//! Contacts whose force has come down to zero while little else acts: whether they open is seen a moment later, since what is left of their
//! acceleration now is what rounding has left of the time.

use tumble_expr::Expr;
use tumble_ode::Reason;

use super::{Settling, Touched};
use crate::contact::complementarity::pushing;
use crate::contact::sticking::Pushes;
use crate::contact::touch::Now;
use crate::mode::Mode;
use crate::record::Jump;

/// What a moment makes of an acceleration is all there is of it, but for this part.
const NOTHING: f64 = 1e-2;

/// And it is one only beyond this part of what the forces would do without each other: a few of their roundings. What nothing presses on, nor
/// leads away, stays as it is.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// Those that open, and those that close.
type Parted = [Vec<usize>; 2];

impl<'a> Settling<'a> {
    /// Of some contacts whose force has just come to zero, those that open a moment later, if some others bear what there is to bear, and those
    /// that would close; by the first moment at which what they do is more than rounding.
    pub(super) fn a_moment_later(
        &self,
        lifted: &[usize],
        others: &[usize],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Parted {
        let mut found = Parted::default();
        for now in self.now.moments() {
            let Some((parted, is_seen)) = self.parted_at(now, [lifted, others], touched, jump) else { break };
            found = parted;
            if is_seen {
                break;
            }
        }
        found
    }

    /// The same at one moment, with whether that can be seen of all of them.
    fn parted_at(
        &self,
        now: Now<'a>,
        [lifted, others]: [&[usize]; 2],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Option<(Parted, bool)> {
        let states = self.accelerated(now.time - self.now.time, jump).ok()?;
        let later = self.equations.touch(&self.island, &jump.mode, &states, now).ok()?;
        if later.pairs != self.touch.pairs {
            return None;
        }
        let later = Self::before(self.equations, &self.island, later, now);
        if self.is_rough() {
            // What slips is as it is now: what sticks has no slip a moment later either.
            let held =
                |some: &[usize]| later.forces(some, &self.slipping_patches(some, touched, jump)).solve();
            return later.parted(lifted, others, held);
        }
        let mut then = later.touch.free.clone();
        if !others.is_empty() {
            // A push that is across a surface now may lead off it then.
            let (_, push) = pushing(&later.pushes(others), &later.some(others, &then))?;
            then += (later.touch.pushes() * later.whole(others, &push)).rows(0, then.len());
        }
        let is_all = |position: &&usize| {
            let then = then[**position].abs();
            self.touch.free[**position].abs() <= NOTHING * then && then > ROUNDED * later.touch.strength
        };
        let is_seen = lifted.iter().all(|position| then[*position].abs() > later.zero());
        let (opens, closes) = lifted.iter().filter(is_all).partition(|position| then[**position] > 0.0);
        Some(([opens, closes], is_seen))
    }

    /// The states a moment later, as bodies move now and are accelerated by what acts, contacts included. How the acceleration of a gap goes on
    /// depends on both alike: it has squares of velocities in it. So do those that no contact joins to these, but forces do.
    fn accelerated(&self, length: f64, jump: &Jump<Mode>) -> Result<Vec<f64>, Reason> {
        let (equations, Now { time, inputs, .. }) = (self.equations, self.now);
        let mut states = equations.moved(length, jump);
        let velocities = equations.velocities_of(&jump.mode, &jump.mode.bodies);
        let rates = equations.state_rates(&jump.mode);
        let rates: Vec<Expr> = velocities.iter().map(|state| rates[*state].rate.clone()).collect();
        let accelerations = equations.values(&rates, &jump.mode, time, &jump.states, inputs)?;
        for (state, acceleration) in velocities.into_iter().zip(accelerations) {
            states[state] += length * acceleration;
        }
        Ok(states)
    }

    /// Of some contacts those that friction and the others let open, and those that press. What does not press opens, however slowly: its force
    /// was seen to come down to zero. Where others may hold what they hold, they do.
    fn parted(
        &self,
        lifted: &[usize],
        others: &[usize],
        held: impl Fn(&[usize]) -> Option<Pushes>,
    ) -> Option<(Parted, bool)> {
        let closes = |found: &Pushes| lifted.iter().any(|position| found.then[*position] < -self.zero());
        let mut all = [lifted, others].concat();
        all.sort_unstable();
        let found = held(others).filter(|found| !closes(found)).or_else(|| held(&all))?;
        let presses = |position: &usize| found.held.contains(position);
        let opens = |position: &usize| found.then[*position] > 0.0;
        let pressed = |position: usize| found.pushes[position] * self.touch.pushes()[(position, position)];
        let is_seen =
            lifted.iter().all(|position| found.then[*position].max(pressed(*position)) > self.zero());
        let (closes, others): (Vec<usize>, Vec<usize>) =
            lifted.iter().partition(|position| presses(position));
        Some(([others.into_iter().filter(opens).collect(), closes], is_seen))
    }
}
