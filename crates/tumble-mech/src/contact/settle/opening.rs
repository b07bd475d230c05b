//! Contacts whose force has come down to zero while little else acts: whether they open is seen a moment later, since what is left of their
//! acceleration now is what rounding has left of the time.

use tumble_expr::Expr;
use tumble_ode::Reason;

use super::{Settling, Touched};
use crate::contact::complementarity::{independent, moved, pushing};
use crate::contact::sticking::Pushes;
use crate::contact::touch::Now;
use crate::mode::Mode;
use crate::record::Jump;

/// What a moment makes of an acceleration is all there is of it, but for this part.
const NOTHING: f64 = 1e-2;

/// And it is one only beyond this part of what the forces would do without each other: a few of their roundings. What nothing presses on, nor
/// leads away, stays as it is.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

impl Settling<'_> {
    /// Of some contacts whose force has just come to zero, and of idle ones among the others, those that open a moment later, if the others bear what
    /// there is to bear; of the former those that would close; and of the latter those in whose place friction holds.
    pub(super) fn a_moment_later(
        &self,
        [lifted, idle]: [&[usize]; 2],
        others: &[usize],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> [Vec<usize>; 3] {
        let nothing = || [(); 3].map(|()| vec![]);
        let now = self.now.a_moment_later();
        let states = self.accelerated(now.time - self.now.time, jump);
        let later = states.and_then(|states| self.equations.touch(&self.island, &jump.mode, &states, now));
        let Ok(later) = later else { return nothing() };
        if later.pairs != self.touch.pairs {
            return nothing();
        }
        let later = Self::before(self.equations, &self.island, later, now);
        if self.is_rough() {
            // What slips is as it is now: what sticks has no slip a moment later either.
            let held =
                |some: &[usize]| later.forces(some, &self.slipping_patches(some, touched, jump)).solve();
            return later.parted([lifted, idle], others, held).unwrap_or_else(nothing);
        }
        let mut then = later.touch.free.clone();
        if !others.is_empty() {
            // A push that is across a surface now may lead off it then.
            let bears = pushing(&later.pushes(others), &later.some(others, &then));
            let Some((_, push)) = bears else { return nothing() };
            let pushes = later.whole(others, &push);
            then =
                moved(later.touch.pushes(), &later.accelerations(), &pushes).rows(0, then.len()).into_owned();
        }
        let is_all = |position: &&usize| {
            let then = then[**position].abs();
            self.touch.free[**position].abs() <= NOTHING * then && then > ROUNDED * later.touch.strength
        };
        let (mut opens, closes): (Vec<usize>, Vec<usize>) =
            lifted.iter().filter(is_all).partition(|position| then[**position] > 0.0);
        opens.extend(idle.iter().filter(is_all).filter(|position| then[**position] > 0.0));
        [opens, closes, vec![]]
    }

    /// The states a moment later, as bodies move now and are accelerated by what acts, contacts included. How the acceleration of a gap goes on
    /// depends on both alike: it has squares of velocities in it.
    fn accelerated(&self, length: f64, jump: &Jump<Mode>) -> Result<Vec<f64>, Reason> {
        let (equations, Now { time, inputs, .. }) = (self.equations, self.now);
        let mut states = equations.moved(&self.island, length, jump);
        let velocities = equations.velocities_of(&jump.mode, &self.island);
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
        [lifted, idle]: [&[usize]; 2],
        others: &[usize],
        held: impl Fn(&[usize]) -> Option<Pushes>,
    ) -> Option<[Vec<usize>; 3]> {
        let closes = |found: &Pushes| lifted.iter().any(|position| found.then[*position] < -self.zero());
        let mut all = [lifted, others].concat();
        all.sort_unstable();
        let found = held(others).filter(|found| !closes(found)).or_else(|| held(&all))?;
        let presses = |position: &usize| found.held.contains(position);
        let opens = |position: &usize| found.then[*position] > 0.0;
        let (closes, others): (Vec<usize>, Vec<usize>) =
            lifted.iter().partition(|position| presses(position));
        let (leaving, still): (Vec<usize>, Vec<usize>) = idle
            .iter()
            .filter(|position| !presses(position))
            .partition(|position| found.then[**position] > self.zero());
        let is_borne = |position: &usize| {
            let response = &self.touch.response;
            let held = independent(response, found.held.iter().copied());
            independent(response, held.iter().copied().chain([*position])).len() == held.len()
        };
        let loose = still.into_iter().filter(|position| !is_borne(position)).collect();
        Some([others.into_iter().filter(opens).chain(leaving).collect(), closes, loose])
    }
}
