//! What motions hand over to others that go on from them: where two systems become one, or one becomes several.

use std::cell::Cell;
use std::rc::Rc;

use super::memory::Held;
use super::{InitialState, Motion, Solver};
use crate::coefficients::Coefficients;
use crate::hybrid::Hybrid;
use crate::scale::Scales;
use crate::trajectory::Piece;
use crate::{Accuracy, Reason};

/// Where a motion has come to.
#[derive(Clone, Debug)]
pub struct Handover<Mode> {
    /// The instant, as a start.
    pub start: InitialState<Mode>,
    /// What is known of the way to it.
    pub carried: Carried,
}

/// What is known of the way to an instant.
#[derive(Clone, Debug)]
pub struct Carried {
    /// What rounding left out of the time, s.
    left_out: f64,
    scales: Scales,
    /// Times at which jumps have asked to be woken, s.
    wakes: Vec<f64>,
    /// Events since time last passed.
    at_once: u64,
    guards: GuardSigns,
    /// What all motions beside each other hold.
    held: Rc<Cell<Held>>,
}

/// What is known of guards, by name.
#[derive(Clone, Debug, Default)]
pub(super) struct GuardSigns {
    /// Signs where the last step ended.
    sides: Vec<(String, f64)>,
    /// How many first coefficients are zero now.
    zeros: Vec<(String, usize)>,
}

impl Carried {
    /// What several motions know of one instant that they have come to.
    ///
    /// # Panics
    /// If there are none.
    pub fn joined(all: &[&Self]) -> Self {
        let mut joined = (*all.first().expect("motions that are joined")).clone();
        for other in &all[1..] {
            if joined.left_out == 0.0 {
                joined.left_out = other.left_out;
            }
            joined.scales.join(&other.scales);
            joined.wakes.extend(&other.wakes);
            joined.at_once = joined.at_once.max(other.at_once);
            joined.guards.sides.extend(other.guards.sides.iter().cloned());
            joined.guards.zeros.extend(other.guards.zeros.iter().cloned());
        }
        joined
    }

    /// The same of a motion that has asked for no time.
    #[must_use]
    pub fn without_wakes(self) -> Self {
        Self { wakes: vec![], ..self }
    }
}

impl<'a, H: Hybrid> Solver<'a, H> {
    /// Ends this motion where it is: a step that was proposed is forgotten. One that has not moved has a piece of no length, by which its
    /// states are known.
    pub fn hand_over(mut self) -> (Motion<H>, Handover<H::Mode>) {
        let guards = match self.mode {
            Some(mode) => GuardSigns { sides: self.engines[mode].sides(), zeros: self.engines[mode].zeros() },
            None => self.first_guards.clone(),
        };
        let start = InitialState {
            time: self.time,
            mode: self
                .mode
                .map_or_else(|| self.first_mode.clone(), |mode| self.trajectory.modes[mode].clone()),
            states: self.states.clone(),
            compensation: self.compensation.clone(),
            inputs: self.inputs.clone(),
            causes: self.first_causes.clone(),
            rounding: self.rounding,
            is_proved: self.is_proved,
            stride: self.stride,
        };
        let carried = Carried {
            left_out: self.time_left_out,
            scales: self.scales.clone(),
            wakes: self.wakes.clone(),
            at_once: self.at_once,
            guards,
            held: self.memory.held(),
        };
        if self.trajectory.pieces.is_empty() && self.trajectory.events.is_empty() {
            self.stand();
        }
        (self.finish(), Handover { start, carried })
    }

    fn stand(&mut self) {
        let mode = self.mode.unwrap_or_else(|| {
            self.trajectory.modes = vec![self.first_mode.clone()];
            0
        });
        self.trajectory.pieces.push(Piece {
            start: self.time,
            left_out: self.time_left_out,
            end: self.time,
            mode,
            length: 0.0,
            states: Coefficients::of(self.states.chunks(1)),
            time_series: None,
        });
    }

    /// A motion that goes on from where others have come to.
    pub fn resumed(
        system: &'a H,
        Handover { start, carried }: Handover<H::Mode>,
        until: f64,
        accuracy: Accuracy,
    ) -> Self {
        let Carried { left_out, scales, wakes, at_once, guards, held } = carried;
        let mut resumed = Self::new(system, start, until, accuracy);
        resumed.span = scales.span();
        resumed.scales = scales;
        resumed.time_left_out = left_out;
        resumed.wakes = wakes;
        resumed.at_once = at_once;
        resumed.first_guards = guards;
        resumed.memory.share_held(held);
        resumed
    }

    /// Enters the mode that it starts in.
    pub(super) fn enter_first(&mut self) -> Result<usize, Reason> {
        let GuardSigns { sides, zeros } = std::mem::take(&mut self.first_guards);
        let mode = self.enter(self.first_mode.clone(), self.states.clone(), &zeros)?;
        if !sides.is_empty() {
            self.engines[mode].carry_sides(&sides);
        }
        Ok(mode)
    }
}
