//! Contacts whose force has come down to zero while little else acts: whether they open is seen a moment later, since what is left of their
//! acceleration now is what rounding has left of the time.

use tumble_expr::Expr;
use tumble_ode::Reason;

use super::{Settling, Touched};
use crate::contact::complementarity::{following, moved, pushing};
use crate::contact::contact_mode::ContactMode;
use crate::contact::sticking::Pushes;
use crate::contact::touch::Now;
use crate::mode::Mode;
use crate::record::Jump;

/// What a moment makes of an acceleration is all there is of it, but for this part.
const NOTHING: f64 = 1e-2;

/// And it is one only beyond this part of what the forces would do without each other: a few of their roundings. What nothing presses on, nor
/// leads away, stays as it is.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// What comes of contacts a moment later.
#[derive(Default)]
struct Parted {
    opening: Vec<usize>,
    /// Those that would close if they did not bear.
    closing: Vec<usize>,
    /// Idle ones in whose place friction holds.
    loose: Vec<usize>,
    /// Whether that is more than rounding, for all whose force has come to zero.
    is_seen: bool,
}

impl<'a> Settling<'a> {
    /// Of those that stand still the ones that may bear from now on: a contact whose force has just come to zero does so if it would close otherwise.
    pub(super) fn bearing(&mut self, members: &[usize], touched: &Touched, jump: &Jump<Mode>) -> Vec<usize> {
        // An impact at the same instant changes what the forces go on to do: that one was falling says nothing then.
        let is_calm = self.impulses.amax() == 0.0;
        let is_lifted = |position: &usize| is_calm && touched.lifted.contains(&self.touch.pairs[*position]);
        let (lifted, mut bearing): (Vec<usize>, Vec<usize>) =
            members.iter().partition(|position| is_lifted(position));
        // Others that bear nothing may open with them, or where friction gives way: else each would seem to take over for no time.
        let is_idle = |position: &usize| is_calm && self.bears_nothing(*position, &jump.mode);
        let idle: Vec<usize> = bearing.iter().copied().filter(is_idle).collect();
        if lifted.is_empty() && (idle.is_empty() || touched.broken.is_empty()) {
            return bearing;
        }
        let Parted { opening, closing, loose, .. } =
            self.a_moment_later([&lifted, &idle], &bearing, touched, jump);
        bearing.retain(|position| !opening.contains(position) && !loose.contains(position));
        let goes = |position: &usize| opening.contains(position) || closing.contains(position);
        let stays: Vec<usize> = lifted.into_iter().filter(|position| !goes(position)).collect();
        self.staying = following(self.touch.pushes(), bearing.iter().copied(), &stays);
        self.opening = opening;
        // What was found to close, and of which nothing more is seen, does not open: else it would close again at once.
        let closes = |position: &usize| touched.closed.contains(&self.touch.pairs[*position]);
        bearing.extend(
            stays.into_iter().filter(|position| closes(position) && !self.staying.contains(position)),
        );
        bearing.extend(closing);
        bearing.sort_unstable();
        bearing
    }

    /// Whether a rigid contact touches, and had no force so far.
    fn bears_nothing(&self, position: usize, mode: &Mode) -> bool {
        let pair = self.touch.pairs[position];
        self.equations.pairs()[pair].is_rigid()
            && mode.contact_mode(pair).is_none_or(|contact_mode| contact_mode == ContactMode::Idle)
    }

    /// Of some contacts whose force has just come to zero, and of idle ones among the others, those that open a moment later, if the others bear what
    /// there is to bear; of the former those that would close; and of the latter those in whose place friction holds. By the first moment at which what
    /// they do is more than rounding.
    fn a_moment_later(
        &self,
        some: [&[usize]; 2],
        others: &[usize],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Parted {
        let mut found = Parted::default();
        for now in self.now.moments() {
            let Some(parted) = self.parted_at(now, some, others, (touched, jump)) else { break };
            found = parted;
            if found.is_seen {
                break;
            }
        }
        found
    }

    fn parted_at(
        &self,
        now: Now<'a>,
        [lifted, idle]: [&[usize]; 2],
        others: &[usize],
        (touched, jump): (&Touched, &Jump<Mode>),
    ) -> Option<Parted> {
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
            return later.parted([lifted, idle], others, held);
        }
        let mut then = later.touch.free.clone();
        if !others.is_empty() {
            // A push that is across a surface now may lead off it then.
            let (_, push) = pushing(&later.pushes(others), &later.some(others, &then))?;
            let pushes = later.whole(others, &push);
            then =
                moved(later.touch.pushes(), &later.accelerations(), &pushes).rows(0, then.len()).into_owned();
        }
        let is_all = |position: &&usize| {
            let then = then[**position].abs();
            self.touch.free[**position].abs() <= NOTHING * then && then > ROUNDED * later.touch.strength
        };
        let is_seen = lifted.iter().all(|position| then[*position].abs() > later.zero());
        let (mut opening, closing): (Vec<usize>, Vec<usize>) =
            lifted.iter().filter(is_all).partition(|position| then[**position] > 0.0);
        opening.extend(idle.iter().filter(is_all).filter(|position| then[**position] > 0.0));
        Some(Parted { opening, closing, loose: vec![], is_seen })
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

    /// Of some contacts those that friction and the others let open, and those that press. What does not press and is not kept by others opens,
    /// however slowly: its force was seen to come down to zero. Where others may hold what they hold, they do.
    fn parted(
        &self,
        [lifted, idle]: [&[usize]; 2],
        others: &[usize],
        held: impl Fn(&[usize]) -> Option<Pushes>,
    ) -> Option<Parted> {
        let zero = self.zero();
        let closes = |found: &Pushes| lifted.iter().any(|position| found.then[*position] < -zero);
        let mut all = [lifted, others].concat();
        all.sort_unstable();
        let found = held(others).filter(|found| !closes(found)).or_else(|| held(&all))?;
        let pressed = |position: usize| found.pushes[position] * self.touch.pushes()[(position, position)];
        let is_seen = lifted.iter().all(|position| found.then[*position].max(pressed(*position)) > zero);
        let (closing, free): (Vec<usize>, Vec<usize>) =
            lifted.iter().partition(|position| found.held.contains(position));
        let (leaving, still): (Vec<usize>, Vec<usize>) = idle
            .iter()
            .filter(|position| !found.held.contains(position))
            .partition(|position| found.then[**position] > zero);
        let (seen, slow): (Vec<usize>, Vec<usize>) = free
            .into_iter()
            .filter(|position| found.then[*position] > 0.0)
            .partition(|position| found.then[*position] > zero);
        let kept = following(&self.touch.response, found.held.iter().copied(), &[&slow[..], &still].concat());
        let slow = slow.into_iter().filter(|position| !kept.contains(position));
        let opening = seen.into_iter().chain(slow).chain(leaving).collect();
        let loose = still.into_iter().filter(|position| !kept.contains(position)).collect();
        Some(Parted { opening, closing, loose, is_seen })
    }
}
