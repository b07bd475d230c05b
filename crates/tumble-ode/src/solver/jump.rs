//! Where a flow ends: what the system makes of it, and how the motion goes on.

use super::Solver;
use crate::Reason;
use crate::compiled::Limit;
use crate::hybrid::{Cause, Crossing, Hybrid};
use crate::program::Plan;
use crate::trajectory::{Occurrence, Trajectory};

/// Jumps this many units in the last place apart are of one instant: between two of them rounding alone decides what comes next.
const AT_ONCE_ULPS: f64 = 64.0;
/// Jumps leave a state as it is if they change it by this part of what states of its kind have been: rounding of what is made to stand.
const UNCHANGED: f64 = 1e-12;

impl<H: Hybrid> Solver<'_, H> {
    pub(super) fn jump_if_due(
        &mut self,
        mode: usize,
        guards: Vec<usize>,
        at_end: bool,
    ) -> Result<(), Reason> {
        let latest = self.just_after();
        let schedule = self.engines[mode].system.schedule.iter().enumerate();
        let due = schedule.filter(|(_, time)| at_end && self.time <= **time && **time <= latest);
        let scheduled = due.map(|(index, _)| Cause::Scheduled(index));
        let waking = self.wakes.iter().any(|wake| *wake <= self.time).then_some(Cause::Wake);
        let tape_guards = self.engines[mode].system.guards;
        let crossed = guards.into_iter().map(|guard| match guard.checked_sub(tape_guards) {
            None => Cause::Guard(guard),
            Some(lazy_guard) => Cause::LazyGuard(lazy_guard),
        });
        let causes: Vec<Cause> = scheduled.chain(waking).chain(crossed).collect();
        self.wakes.retain(|wake| *wake > self.time);
        if causes.is_empty() { Ok(()) } else { self.jump(mode, causes, true) }
    }

    /// See [`Crossing::around`].
    fn around(&self, mode: usize) -> Vec<(&H::Mode, &[Cause])> {
        let Trajectory { events, modes, .. } = &self.trajectory;
        let earliest = self.time - AT_ONCE_ULPS * f64::EPSILON * self.time.abs();
        let is_same = |event: &&Occurrence<H::Record>| earliest <= event.time && self.leaves_states(event);
        let last = events.iter().rev().take_while(is_same);
        // A jump that stays in its mode is no circle, if there is one.
        let leaves = |event: &Occurrence<H::Record>| event.mode_before == mode && event.mode_after != mode;
        let stays = |event: &Occurrence<H::Record>| event.mode_before == mode;
        let Some(length) = last.clone().position(leaves).or_else(|| last.clone().position(stays)) else {
            return vec![];
        };
        let around = last.take(length + 1).map(|event| (&modes[event.mode_before], &event.causes[..]));
        let mut around: Vec<_> = around.collect();
        around.reverse();
        around
    }

    fn leaves_states(&self, event: &Occurrence<H::Record>) -> bool {
        let Some(engine) = self.engines.get(event.mode_before) else { return event.before == event.after };
        let zero = |state: usize| UNCHANGED * self.scales.of(engine.system.group(state));
        let mut changes = event.before.iter().zip(&event.after).enumerate();
        event.before.len() == event.after.len() && changes.all(|(state, (a, b))| (a - b).abs() <= zero(state))
    }

    /// Asks the system what it makes of causes. Guards that have been located are zero now; others have been carried across zero by a jump.
    pub(super) fn jump(&mut self, mode: usize, causes: Vec<Cause>, are_located: bool) -> Result<(), Reason> {
        let jump = self.system.jump(&Crossing {
            time: self.time,
            since: self.since(),
            mode: &self.trajectory.modes[mode],
            states: &self.states,
            compensation: &self.compensation,
            inputs: &self.inputs,
            causes: &causes,
            scales: self.scales.all(),
            around: self.around(mode),
        })?;
        let crossed_at = self.engines[mode].crossed_values(&causes, (self.time, &self.states));
        let system = &self.engines[mode].system;
        let Plan { guard_names, guards, .. } = &**system;
        let is_zero = |guard: usize| are_located && !matches!(system.guard_limits[guard], Limit::Kept(_));
        let crossed = |cause: &Cause| match cause {
            Cause::Guard(guard) => is_zero(*guard).then(|| (guard_names[*guard].clone(), 1)),
            Cause::LazyGuard(lazy_guard) => Some((guard_names[guards + lazy_guard].clone(), 1)),
            Cause::Scheduled(_) | Cause::Wake => None,
        };
        let zeros: Vec<(String, usize)> = causes.iter().filter_map(crossed).chain(jump.zeros).collect();
        self.wakes.extend(jump.wake);
        let before = self.states.clone();
        // An event that changes nothing does not disturb the branch signs of the motion.
        self.stopped = jump.stop;
        let unchanged = jump.mode == self.trajectory.modes[mode] && jump.states == before;
        let mode_after = if unchanged { mode } else { self.enter(jump.mode, jump.states, &zeros)? };
        if !unchanged {
            self.engines[mode_after].carry_away(&crossed_at, (self.time, &self.states));
        }
        if !unchanged && !self.rounding.is_nearest() {
            self.round_anew((mode, mode_after), &before, &causes);
        }
        let event = Occurrence {
            time: self.time,
            causes,
            record: jump.record,
            before,
            after: self.states.clone(),
            blur: self.blur.time + jump.early,
            mode_before: mode,
            mode_after,
        };
        self.memory.hold_event(&event, H::held_by(&event.record));
        self.trajectory.events.push(event);
        Ok(())
    }
}
