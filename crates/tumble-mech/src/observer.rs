//! Quantities along a motion: any formula of the bodies' motion, accelerations included.

use std::sync::Arc;

use tumble_expr::{Expr, Jets};
use tumble_ode::{Cursor, Motion, MotionState, Piece, Reason, Side};

use crate::equations::Equations;
use crate::evaluator::{evaluate, evaluate_in};
use crate::mode::Mode;
use crate::record::Happening;
use crate::run::Run;

/// Evaluates formulas at any time of one run, each along the motion that it reads.
pub struct Observer {
    parts: Vec<Part>,
    formulas: usize,
    /// When each event of the run is at which something happens, s.
    events: Vec<f64>,
    /// Values of one part.
    values: Vec<f64>,
}

/// The formulas that read one motion.
struct Part {
    along: Along,
    /// Indices of the formulas.
    places: Vec<usize>,
    /// Of each of those events, its index among those of the motion; `None` of others' events.
    own_events: Vec<Option<usize>>,
}

impl Observer {
    pub(crate) fn new(run: &Run, formulas: &[Expr]) -> Result<Self, Reason> {
        let tracks = run.all_tracks();
        let part = |(groups, places): (Vec<usize>, Vec<usize>)| {
            let own = places.iter().map(|index| formulas[*index].clone()).collect();
            let motion = run.part(&groups).motion();
            let along = Along::new(&run.equations, motion, &run.inputs, own)?;
            Ok(Part { along, places, own_events: tracks.own_events(&groups) })
        };
        let parts = run.grouped(formulas).into_iter().map(part).collect::<Result<_, Reason>>()?;
        let events = run.events().map(|event| event.time).collect();
        Ok(Self { parts, formulas: formulas.len(), events, values: vec![] })
    }

    /// Values of the formulas at `time`, in their order; `None` outside the motion.
    pub fn at(&mut self, time: f64, side: Side) -> Option<Vec<f64>> {
        let mut values = vec![];
        self.at_into(time, side, &mut values).then_some(values)
    }

    /// The same put into `values`; whether there are any. Many times are best asked for in order.
    pub fn at_into(&mut self, time: f64, side: Side, values: &mut Vec<f64>) -> bool {
        values.clear();
        if let [only] = &mut self.parts[..] {
            return only.along.at_into(time, side, values);
        }
        values.resize(self.formulas, f64::NAN);
        for part in &mut self.parts {
            if !part.along.at_into(time, side, &mut self.values) {
                values.clear();
                return false;
            }
            part.places.iter().zip(&self.values).for_each(|(place, value)| values[*place] = *value);
        }
        true
    }

    /// Values of the formulas just before and just after an event, by its index among those of the run.
    pub fn at_event(&mut self, index: usize) -> Option<[Vec<f64>; 2]> {
        let Self { parts, formulas, events, .. } = self;
        let time = *events.get(index)?;
        let mut found = [vec![f64::NAN; *formulas], vec![f64::NAN; *formulas]];
        for part in parts {
            let values = match part.own_events[index] {
                Some(own) => part.along.at_event(own)?,
                None => [part.along.at(time, Side::Before)?, part.along.at(time, Side::After)?],
            };
            for (all, own) in found.iter_mut().zip(values) {
                part.places.iter().zip(own).for_each(|(place, value)| all[*place] = value);
            }
        }
        Some(found)
    }
}

/// Evaluates formulas along one motion.
struct Along {
    motion: Arc<Motion<Equations>>,
    tapes: Tapes,
    cursor: Cursor,
    states: Vec<f64>,
    /// Instants at which forces and accelerations have no value, and which formulas read such.
    singular: Vec<f64>,
    is_forced: Vec<bool>,
    /// The time and the place of the piece that the tape of its mode was evaluated at last.
    last: Option<(f64, usize)>,
}

impl Along {
    fn new(
        equations: &Equations,
        motion: Arc<Motion<Equations>>,
        inputs: &[f64],
        formulas: Vec<Expr>,
    ) -> Result<Self, Reason> {
        let singular =
            motion.events.iter().filter(|event| event.record.happened.contains(&Happening::Singular));
        let singular: Vec<f64> = singular.map(|event| event.time).collect();
        let is_forced =
            formulas.iter().map(|formula| !singular.is_empty() && equations.reads_forces(formula));
        let is_forced = is_forced.collect();
        let tapes = Tapes::new(equations, inputs, formulas, &motion.modes)?;
        let (cursor, states) = (Cursor::default(), vec![]);
        Ok(Self { motion, tapes, cursor, states, singular, is_forced, last: None })
    }

    fn at(&mut self, time: f64, side: Side) -> Option<Vec<f64>> {
        let mut values = vec![];
        self.at_into(time, side, &mut values).then_some(values)
    }

    fn at_into(&mut self, time: f64, side: Side, values: &mut Vec<f64>) -> bool {
        values.clear();
        let Some(spot) = self.motion.spot_at(time, side, &mut self.cursor) else { return false };
        let Some(tape) = self.tapes.of(spot.mode, &self.motion.modes) else { return false };
        // Within a piece both sides of an instant are one.
        let here = spot.piece().map(|piece| (time, address(piece)));
        if here.is_none() || here != self.last {
            self.states.clear();
            spot.states_into(time, &mut self.states);
            evaluate_in(tape, spot.piece(), time, &self.states);
            self.last = here;
        }
        values.extend((0..tape.tape().outputs().len()).map(|index| tape.value_of(index)));
        self.leave_out(time, values);
        true
    }

    /// Values just before and just after an event, by its index among those of the motion.
    fn at_event(&mut self, index: usize) -> Option<[Vec<f64>; 2]> {
        let motion = Arc::clone(&self.motion);
        let events = &motion.events;
        let event = events.get(index)?;
        let others = [index.checked_sub(1).and_then(|before| events.get(before)), events.get(index + 1)];
        let [before, after] =
            [(Side::Before, event.mode_before, &event.before), (Side::After, event.mode_after, &event.after)]
                .map(|(side, mode, states)| MotionState {
                    mode,
                    time: event.time,
                    states: states.clone(),
                    // Between two events of one instant there is no piece.
                    piece: match others[side as usize] {
                        Some(other) if other.time == event.time => None,
                        _ => motion.place_at(event.time, side).and_then(|place| place.piece),
                    },
                });
        let mut sides = [self.values(&before)?, self.values(&after)?];
        sides.iter_mut().for_each(|values| self.leave_out(event.time, values));
        Some(sides)
    }

    /// Takes out what has no value at a singular instant: rows that say nothing there are divided by next to nothing.
    fn leave_out(&self, time: f64, values: &mut [f64]) {
        if self.singular.contains(&time) {
            let forced = values.iter_mut().zip(&self.is_forced).filter(|(_, is_forced)| **is_forced);
            forced.for_each(|(value, _)| *value = f64::NAN);
        }
    }

    fn values(&mut self, place: &MotionState<'_>) -> Option<Vec<f64>> {
        let tape = self.tapes.of(place.mode, &self.motion.modes)?;
        self.last = None;
        evaluate(tape, place);
        Some((0..tape.tape().outputs().len()).map(|index| tape.value_of(index)).collect())
    }
}

/// Formulas in the modes of a motion: one is compiled when it is first asked for, since a pile of bodies has thousands.
struct Tapes {
    equations: Equations,
    inputs: Vec<f64>,
    formulas: Vec<Expr>,
    by_mode: Vec<Option<Jets<f64>>>,
}

impl Tapes {
    /// Formulas that cannot be compiled cannot be in any mode: the first tells.
    fn new(
        equations: &Equations,
        inputs: &[f64],
        formulas: Vec<Expr>,
        modes: &[Mode],
    ) -> Result<Self, Reason> {
        let first = modes.first().map(|mode| equations.evaluator(mode, &formulas, inputs)).transpose()?;
        let mut by_mode: Vec<Option<Jets<f64>>> = modes.iter().map(|_| None).collect();
        by_mode.iter_mut().zip(first).for_each(|(own, first)| *own = Some(first));
        Ok(Self { equations: equations.clone(), inputs: inputs.to_vec(), formulas, by_mode })
    }

    fn of(&mut self, mode: usize, modes: &[Mode]) -> Option<&mut Jets<f64>> {
        let Self { equations, inputs, formulas, by_mode } = self;
        if by_mode[mode].is_none() {
            by_mode[mode] = equations.evaluator(&modes[mode], formulas, inputs).ok();
        }
        by_mode[mode].as_mut()
    }
}

/// By which a piece of one motion is known.
fn address(piece: &Piece) -> usize {
    std::ptr::from_ref(piece).addr()
}
