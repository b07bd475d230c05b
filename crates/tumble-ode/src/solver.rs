//! The loop that takes steps: expand, propose, check, accept, and jump where a flow ends.

mod acceptance;
mod handover;
mod jump;
pub(crate) mod late;
mod memory;
mod modes;
mod over;
mod proposal;
mod step;

use std::collections::HashMap;

use step::Step;
use thiserror::Error;
use tumble_expr::{Rounding, Row, rounded_sum};

use crate::engine::Engine;
use crate::expansion::Expansion;
use crate::hybrid::{Cause, Crossing, Hybrid};
use crate::order::{order, reach};
use crate::polynomial;
use crate::scale::Scales;
use crate::trajectory::{Piece, Trajectory};
use crate::whole::{Blur, Noise};
use crate::{Accuracy, Reason, Refusal, Work};
use handover::GuardSigns;
pub use handover::{Carried, Handover};
use memory::Memory;
pub use over::Over;
use proposal::Proposal;

/// Scheduled times closer than this many units in the last place are one instant.
const SIMULTANEOUS_ULPS: f64 = 4.0;
/// What a check run adds to each state in a step, in units of eps times its change, which is added up with care.
const CHANGE_ROUNDING: f64 = 0.1;
/// A check run rests only where its rates are less than this part of their rounding errors: less than any number is moved by, so
/// that a balance that rounding would upset is not taken for rest.
const STILL_PART: f64 = 0.25;
/// More events than this without time passing are not going to end.
const MOST_AT_ONCE: u64 = 1000;

/// What a motion starts from.
#[derive(Clone, Debug)]
pub struct InitialState<Mode> {
    /// Time of the start, s.
    pub time: f64,
    /// The mode at the start.
    pub mode: Mode,
    /// States in the mode's order.
    pub states: Vec<f64>,
    /// What rounding left out of each state.
    pub compensation: Vec<f64>,
    /// Values of the inputs in the flows' order.
    pub inputs: Vec<f64>,
    /// What happens at the very start, before any step.
    pub causes: Vec<Cause>,
    /// How states are rounded that an event has set; see [`Rounding`].
    pub rounding: Rounding,
    /// Whether enclosures show of every step that nothing narrow was passed over, which a run that is to be trusted needs. Where
    /// formulas are of a kind that may be narrow, they do so anyway.
    pub is_proved: bool,
    /// Length of steps, in units of what they would have: a check run takes others than the motion does.
    pub stride: f64,
}

/// A motion of a system.
pub type Motion<H> = Trajectory<<H as Hybrid>::Mode, <H as Hybrid>::Record>;

/// A motion that was refused, with what was found before.
#[derive(Clone, Debug, Error)]
#[error("{refusal}")]
pub struct Stopped<Mode: std::fmt::Debug, Record: std::fmt::Debug = ()> {
    /// Why, and when.
    pub refusal: Refusal,
    /// The motion up to there.
    pub trajectory: Box<Trajectory<Mode, Record>>,
}

/// Integrates a motion to its end.
pub fn solve<H: Hybrid>(
    system: &H,
    start: InitialState<H::Mode>,
    until: f64,
    accuracy: Accuracy,
) -> Result<Motion<H>, Stopped<H::Mode, H::Record>> {
    let mut solver = Solver::new(system, start, until, accuracy);
    while !solver.is_done() {
        if let Err(refusal) = solver.advance() {
            return Err(Stopped { refusal, trajectory: Box::new(solver.finish()) });
        }
    }
    Ok(solver.finish())
}

/// Integrates a motion step by step.
pub struct Solver<'a, H: Hybrid> {
    system: &'a H,
    inputs: Vec<f64>,
    until: f64,
    span: f64,
    tolerance: f64,
    accuracy: f64,
    /// Rates at the start of the step, with their rounding errors.
    noise: Noise,
    rounding: Rounding,
    /// What each rate is off by in the step, if any are.
    off: Vec<f64>,
    /// The expansion of the last step: room for the next one.
    expansion: Expansion,
    /// What rounding may have made of the end of the last step.
    blur: Blur,
    /// Length of an ordinary step in units of the radius.
    reach: f64,
    stride: f64,
    time: f64,
    /// What rounding left out of the time, where it is a scheduled one or that of an event.
    time_left_out: f64,
    states: Vec<f64>,
    /// What rounding left out of the states so far: added back with the next step.
    compensation: Vec<f64>,
    mode: Option<usize>,
    first_mode: H::Mode,
    known: HashMap<H::Mode, usize>,
    engines: Vec<Engine>,
    scales: Scales,
    /// Times that jumps have asked to be woken at.
    wakes: Vec<f64>,
    /// What happens at the very start.
    first_causes: Vec<Cause>,
    /// What the motions knew of guards that it goes on from.
    first_guards: GuardSigns,
    /// The next step, where it is known.
    proposal: Option<Proposal>,
    /// Events since time last passed.
    at_once: u64,
    memory: Memory,
    /// Whether an event has ended the motion.
    stopped: bool,
    is_proved: bool,
    /// Enclosures tell nothing of steps that begin before this time, s.
    not_enclosed: f64,
    trajectory: Motion<H>,
}

impl<'a, H: Hybrid> Solver<'a, H> {
    /// A motion about to start. Nothing is evaluated yet.
    pub fn new(system: &'a H, start: InitialState<H::Mode>, until: f64, accuracy: Accuracy) -> Self {
        let tolerance = accuracy.local_tolerance();
        Self {
            system,
            until,
            span: until - start.time,
            tolerance,
            accuracy: accuracy.value(),
            noise: Noise::default(),
            rounding: start.rounding,
            off: vec![],
            expansion: Expansion::default(),
            blur: Blur::default(),
            reach: start.stride * reach(tolerance, order(tolerance)),
            stride: start.stride,
            time: start.time,
            time_left_out: 0.0,
            compensation: start.compensation,
            states: start.states,
            inputs: start.inputs,
            mode: None,
            first_mode: start.mode,
            known: HashMap::new(),
            engines: vec![],
            scales: Scales::new(until - start.time),
            wakes: vec![],
            first_causes: start.causes,
            first_guards: GuardSigns::default(),
            proposal: None,
            at_once: 0,
            memory: Memory::default(),
            stopped: false,
            is_proved: start.is_proved,
            not_enclosed: f64::NEG_INFINITY,
            trajectory: Trajectory {
                modes: vec![],
                pieces: vec![],
                events: vec![],
                work: Work::default(),
                order: order(tolerance),
                scales: vec![],
                rounding: vec![],
            },
        }
    }

    /// Counts the memory that another motion takes as its own: both go on beside each other.
    pub fn share_memory(&mut self, other: &Self) {
        self.memory.share_held(other.memory.held());
    }

    /// The instant that it has come to; `None` before the first step.
    pub fn now(&self) -> Option<Crossing<'_, H::Mode>> {
        Some(Crossing {
            time: self.time,
            since: self.since(),
            mode: &self.trajectory.modes[self.mode?],
            states: &self.states,
            compensation: &self.compensation,
            inputs: &self.inputs,
            causes: &[],
            scales: self.scales.all(),
            around: vec![],
        })
    }

    /// When the last event was, or the beginning, s.
    fn since(&self) -> f64 {
        let Trajectory { events, pieces, .. } = &self.trajectory;
        let last = events.last().map(|event| event.time);
        last.or(pieces.first().map(|piece| piece.start)).unwrap_or(self.time)
    }

    /// Whether an event has ended the motion.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// What the last event was, as data, if it happened just now.
    pub fn last_record(&self) -> Option<&H::Record> {
        self.trajectory.events.last().filter(|event| event.time == self.time).map(|event| &event.record)
    }

    /// Whether the end is reached.
    pub fn is_done(&self) -> bool {
        self.stopped || (self.mode.is_some() && self.time >= self.until)
    }

    /// Time reached, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The motion as far as it is found.
    pub fn finish(mut self) -> Motion<H> {
        self.trajectory.scales = self.scales.all().to_vec();
        self.trajectory.rounding = self.scales.rounding().to_vec();
        self.trajectory
    }

    /// The same of a motion that goes on.
    pub fn so_far(&self) -> Motion<H> {
        let (scales, rounding) = (self.scales.all().to_vec(), self.scales.rounding().to_vec());
        Trajectory { scales, rounding, ..self.trajectory.clone() }
    }

    /// Takes one step, and the jump at its end if there is one.
    pub fn advance(&mut self) -> Result<(), Refusal> {
        self.propose()?;
        self.take()
    }

    fn refused(&self) -> impl Fn(Reason) -> Refusal + use<H> {
        let time = self.time;
        move |reason| Refusal { time, reason }
    }

    /// The next time at which a step must end.
    fn next_stop(&self, mode: usize) -> f64 {
        let scheduled = self.engines[mode].system.next_scheduled(self.just_after());
        let wake = self.wakes.iter().copied().reduce(f64::min);
        [scheduled, wake].into_iter().flatten().fold(self.until, f64::min).max(self.time)
    }

    fn expand(&mut self, mode: usize, found: &mut Expansion) -> Result<(), Reason> {
        let now = (self.time, self.states.as_slice());
        self.engines[mode].expand(now, &self.off, &mut self.trajectory.work, found)
    }

    /// A step to `end`, or to where something happens, in which nothing moves but by rounding, if that is so.
    fn rest(&mut self, mode: usize, end: f64, expansion: &mut Expansion) -> Result<Option<Step>, Reason> {
        self.watch_rates(mode);
        let part = if self.rounding.is_nearest() { 1.0 } else { STILL_PART };
        let now = (self.time, self.states.as_slice());
        let Some(radius) = self.engines[mode].rest(now, &self.noise, (part, &self.off), expansion) else {
            return Ok(None);
        };
        let ahead = (self.reach, self.compensation.as_slice());
        let work = &mut self.trajectory.work;
        // What rests may do so for as long as nobody knows otherwise.
        let length = (end - self.time).min(radius * self.reach);
        let length = self.engines[mode].approach(expansion, length, ahead, work)?;
        let step = self.cut(mode, expansion, length, end);
        let holds = step.length > 0.0
            && self.verdict(mode, expansion, &step).excess <= 1.0
            && self.unknown(mode, expansion, &step)?.is_none();
        Ok(holds.then_some(step))
    }

    /// Finds the rates at the start of a step, with their rounding errors.
    fn watch_rates(&mut self, mode: usize) {
        let now = (self.time, self.states.as_slice(), self.compensation.as_slice());
        self.engines[mode].watch_noise(&mut self.noise, now);
        self.scales.watch_rates(&self.engines[mode].system, &self.noise);
        self.watch_off(mode);
    }

    /// Changes branch signs at the end of a step.
    fn pass(&mut self, mode: usize, step: &Step, expansion: &Expansion) -> Result<(), Reason> {
        let work = &mut self.trajectory.work;
        let engine = &mut self.engines[mode];
        engine.look_back(expansion, step.length);
        engine.refuse_beyond(expansion, (step.length, &step.hits), &self.scales)?;
        if step.length > 0.0 {
            self.at_once = 0;
            engine.leave_start();
        }
        self.at_once += step.hits.len() as u64;
        if self.at_once > MOST_AT_ONCE {
            return Err(Reason::Chatter { events: self.at_once });
        }
        engine.pass(&step.hits, expansion, step.length, work);
        Ok(())
    }

    /// Moves the time and the states to the end of a step, and rounding out of what is to stay zero.
    fn accept(&mut self, mode: usize, expansion: &mut Expansion, step: &Step) -> Result<(), Reason> {
        if step.length == 0.0 {
            return Ok(());
        }
        self.move_along(mode, expansion, step)?;
        self.project(mode, expansion, step);
        Ok(())
    }

    /// Moves the time and the states to the end of a step.
    fn move_along(&mut self, mode: usize, expansion: &mut Expansion, step: &Step) -> Result<(), Reason> {
        for (state, series) in expansion.states.iter_mut().enumerate() {
            let (before, exact) = (self.states[state], polynomial::increment(series, step.length));
            let error = CHANGE_ROUNDING * f64::EPSILON * exact.abs();
            let rounded = self.rounding.off(exact, error, state as u64);
            series[1] += (rounded - exact) / step.length;
            let (after, left_out) = rounded_sum(before, rounded + self.compensation[state]);
            if !after.is_finite() {
                return Err(Reason::NotFinite { state: self.engines[mode].system.names[state].clone() });
            }
            (self.states[state], self.compensation[state]) = (after, left_out);
        }
        let Engine { system, lazy_guards, .. } = &mut self.engines[mode];
        lazy_guards.moved(expansion, step.length, &self.states);
        self.scales.watch(system, &self.states);
        self.trajectory.work.steps += 1;
        self.time_left_out = step.left_out;
        self.time = step.end;
        Ok(())
    }

    /// Takes rounding out of what is to stay zero at the end of a step.
    fn project(&mut self, mode: usize, expansion: &mut Expansion, step: &Step) {
        let Engine { system, invariants, .. } = &mut self.engines[mode];
        if invariants.is_empty() {
            return;
        }
        let drifted = Row::from_slice(&self.states);
        invariants.project(step.end, &mut self.states, system, &self.scales);
        // The piece is to end where the next one begins.
        for (state, series) in expansion.states.iter_mut().enumerate() {
            series[1] += (self.states[state] - drifted[state]) / step.length;
        }
    }

    /// Keeps a step that was taken as a piece of the motion.
    fn record(&mut self, mode: usize, (expansion, left_out): (&Expansion, f64), step: &Step) {
        if step.length > 0.0 {
            let piece = Piece {
                start: expansion.start,
                left_out,
                end: step.end,
                mode,
                length: step.length,
                states: expansion.states.clone(),
                time_series: expansion.time.clone(),
            };
            self.memory.hold_piece(&piece);
            self.trajectory.pieces.push(piece);
        }
        self.memory.count(mode, &step.hits);
    }

    /// The latest time that is the same instant as now.
    fn just_after(&self) -> f64 {
        self.time + SIMULTANEOUS_ULPS * f64::EPSILON * self.time.abs()
    }
}
