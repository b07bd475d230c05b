//! A step over an instant at which the equations say nothing, though the motion goes on through it.
//!
//! A linear system of the equations may be singular at one instant of a motion that is analytic there. The series of the motion about
//! an instant before it reaches beyond it all the same: what is computed of it is off by rounding errors over the distance to the
//! singular instant, and these grow like a series whose radius is that distance r. At `r + h` they have grown to
//! `(1 + h/r)^order` of what they were, so that a step which ends a tenth of r behind the instant has lost one digit or two. What
//! the model knows of the instant, it says: when it is, and whether there is one motion through it.

use tumble_expr::Row;

use super::{Motion, Solver, Step};
use crate::Reason;
use crate::engine::Hit;
use crate::expansion::Expansion;
use crate::hybrid::Hybrid;
use crate::polynomial::{shifted, value};
use crate::trajectory::{Occurrence, Piece};

/// A last term of this part of the scale of its state is small: what a series leaves out is less, and most of the term is what has grown
/// of rounding errors. How much it is, check runs tell, which step over the instant from elsewhere.
const LAST_TERM: f64 = 1e-10;

/// An instant that a step goes over.
#[derive(Clone, Debug)]
pub struct Over<Record> {
    /// When, s.
    pub instant: f64,
    /// By how much rounding may have moved it, s.
    pub blur: f64,
    /// What happens then, in the model's terms; nothing that is told of, where there is none.
    pub record: Option<Record>,
    /// End of the step, s.
    pub end: f64,
    /// Up to this time steps are held to their defect and to what they must keep alone, s: enclosures of what is solved for are wider
    /// than the numbers themselves near the instant, and would cut them without end.
    pub near: f64,
}

impl<H: Hybrid> Solver<'_, H> {
    /// The motion so far.
    pub fn trajectory(&self) -> &Motion<H> {
        &self.trajectory
    }

    /// Scales that errors are relative to, one a group of states.
    pub fn scales(&self) -> &[f64] {
        self.scales.all()
    }

    /// Goes back to an earlier time, s. What was found after it is found again, events that only record included; `false` where
    /// others have happened since, and where the motion has another parameter than the time.
    pub fn go_back(&mut self, time: f64) -> bool {
        if time == self.time {
            return true;
        }
        let pieces = &self.trajectory.pieces;
        let first = pieces.partition_point(|piece| piece.end <= time);
        let Some(mode) = self.mode.filter(|_| !self.stopped) else { return false };
        let is_own = |piece: &Piece| piece.mode == mode && piece.time_series.is_none();
        let is_changed = |event: &Occurrence<H::Record>| {
            event.mode_before != event.mode_after || event.before != event.after
        };
        let later = self.trajectory.events.partition_point(|event| event.time <= time);
        let is_within = pieces.get(first).is_some_and(|piece| piece.start <= time);
        if !is_within
            || !pieces[first..].iter().all(is_own)
            || self.trajectory.events[later..].iter().any(is_changed)
        {
            return false;
        }
        self.trajectory.events.truncate(later);
        let mut cut = self.trajectory.pieces.swap_remove(first);
        self.trajectory.pieces.truncate(first);
        self.states = cut.states_at(time);
        self.compensation.fill(0.0);
        self.time_left_out = 0.0;
        self.time = time;
        if time > cut.start {
            cut.length = cut.parameter_at(time);
            cut.end = time;
            self.trajectory.pieces.push(cut);
        }
        let engine = &mut self.engines[mode];
        let sides = engine.sides();
        engine.enter(time, &self.states, &[]);
        engine.carry_sides(&sides);
        true
    }

    /// The motion from now on, by its series at this instant; `None` where they have another parameter than the time.
    pub fn ahead(&mut self) -> Result<Option<Piece>, Reason> {
        let Some(mode) = self.mode else { return Ok(None) };
        let mut expansion = std::mem::take(&mut self.expansion);
        self.watch_rates(mode);
        let found = self.expand(mode, &mut expansion);
        let piece = Piece {
            start: self.time,
            left_out: 0.0,
            end: self.time,
            mode,
            length: 0.0,
            states: expansion.states.clone(),
            time_series: None,
        };
        let is_in_time = expansion.time.is_none();
        self.expansion = expansion;
        found?;
        Ok(is_in_time.then_some(piece))
    }

    /// Whether the last terms of these series are small at a time, s, and what may happen up to then is seen.
    pub fn reaches(&mut self, time: f64) -> bool {
        let Some(mode) = self.mode else { return false };
        let length = time - self.time;
        let is_small = |(state, series): (usize, &[f64])| {
            let scale = self.scales.of(self.engines[mode].system.group(state));
            let last = series.iter().enumerate().skip(series.len().saturating_sub(2));
            let mut terms = last.map(|(k, c)| c.abs() * libm::pow(length, k as f64));
            terms.all(|term| term <= LAST_TERM * scale)
        };
        let is_known = self.expansion.states.iter().enumerate().all(is_small);
        let near = (self.reach, self.compensation.as_slice());
        let work = &mut self.trajectory.work;
        let seen = self.engines[mode].approach(&mut self.expansion, length, near, work);
        is_known && seen.is_ok_and(|seen| seen >= length)
    }

    /// Takes the step that [`Solver::ahead`] has found, without the checks that an ordinary step has to pass. It ends early at what
    /// changes the motion on its way.
    pub fn step_over(&mut self, over: Over<H::Record>) -> Result<(), Reason> {
        let Some(mode) = self.mode else { return Ok(()) };
        let mut expansion = std::mem::take(&mut self.expansion);
        self.not_enclosed = over.near;
        let changes = |events: &[Occurrence<H::Record>]| {
            events
                .last()
                .is_some_and(|event| event.mode_before != event.mode_after || event.before != event.after)
        };
        loop {
            let is_before = self.time < over.instant;
            let stop = if is_before { over.instant } else { over.end };
            let due = self.next_stop(mode);
            let stop = stop.min(due);
            let step = self.cut(mode, &expansion, stop - self.time, stop);
            let known = self.trajectory.events.len();
            self.land_on(mode, &mut expansion, &step, [over.end, due])?;
            if is_before && self.time >= over.instant {
                self.tell(mode, &over);
            }
            let is_turned = step.hits.iter().any(|hit| !matches!(hit, Hit::Guard(_)));
            let is_changed = changes(&self.trajectory.events[known..]);
            if is_changed {
                self.not_enclosed = self.time;
            }
            if is_turned || is_changed || self.stopped || self.time >= over.end.min(self.until) {
                break;
            }
            expansion = expansion.after(step.length);
        }
        self.expansion = expansion;
        Ok(())
    }

    /// Ends a part of the step where something happens, or where it ends: only there is rounding taken out of what is to stay zero,
    /// which next to the instant would be divided by next to nothing.
    fn land_on(
        &mut self,
        mode: usize,
        expansion: &mut Expansion,
        step: &Step,
        [end, due]: [f64; 2],
    ) -> Result<(), Reason> {
        self.pass(mode, step, expansion)?;
        if step.length > 0.0 {
            self.move_along(mode, expansion, step)?;
        }
        if step.length > 0.0 && step.end == end {
            self.project(mode, expansion, step);
        }
        let now = (self.time, self.states.as_slice());
        let left_out = Row::from_slice(&self.compensation);
        self.blur = self.engines[mode].blur(&step.hits, expansion, step.length, now, &left_out)?;
        let ends_flow = self.engines[mode].fired(&step.hits, now, &mut self.trajectory.work);
        self.record(mode, (expansion, 0.0), step);
        self.jump_if_due(mode, ends_flow?, step.end == due)
    }

    /// Keeps the instant that was gone over as an event that changes nothing.
    fn tell(&mut self, mode: usize, over: &Over<H::Record>) {
        let Some(record) = over.record.clone() else { return };
        let event = Occurrence {
            time: self.time,
            causes: vec![],
            record,
            before: self.states.clone(),
            after: self.states.clone(),
            blur: over.blur,
            mode_before: mode,
            mode_after: mode,
        };
        self.memory.hold_event(&event, H::held_by(&event.record));
        self.trajectory.events.push(event);
    }
}

impl Expansion {
    /// The same polynomials from a later parameter on.
    fn after(mut self, by: f64) -> Self {
        self.start += by;
        let mut all = [&mut self.states, &mut self.branches, &mut self.arguments, &mut self.guards];
        for series in all.iter_mut().flat_map(|all| all.iter_mut()) {
            series.copy_from_slice(&shifted(series, by));
        }
        for turn in &mut self.turnings {
            turn.square = shifted(&turn.square, by).into_vec();
            turn.components.iter_mut().for_each(|series| series.copy_from_slice(&shifted(series, by)));
        }
        for near in &mut self.near {
            let all = std::iter::once(&mut near.series).chain(&mut near.conditions);
            all.for_each(|series| *series = shifted(series, by));
        }
        debug_assert!(self.states.iter().all(|series| value(series, 0.0).is_finite()));
        self
    }
}
