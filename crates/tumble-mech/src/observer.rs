//! Quantities along a motion: any formula of the bodies' motion, accelerations included.

use std::sync::Arc;

use tumble_expr::{Expr, Jets};
use tumble_ode::{Cursor, Motion, MotionState, Piece, Reason, Side};

use crate::equations::Equations;
use crate::evaluator::{evaluate, evaluate_in};
use crate::record::Happening;
use crate::run::Run;
use crate::tracks::Tracks;

/// Evaluates formulas at any time of one run, each along the motion that it reads.
pub struct Observer {
    parts: Vec<Part>,
    formulas: usize,
    tracks: Tracks,
    /// Values of one part.
    values: Vec<f64>,
}

/// The formulas that read one motion.
struct Part {
    along: Along,
    /// Indices of the formulas.
    places: Vec<usize>,
    groups: Vec<usize>,
}

impl Observer {
    pub(crate) fn new(run: &Run, formulas: &[Expr]) -> Result<Self, Reason> {
        let part = |(groups, places): (Vec<usize>, Vec<usize>)| {
            let own: Vec<Expr> = places.iter().map(|index| formulas[*index].clone()).collect();
            let motion = run.part(&groups).motion();
            let along = Along::new(&run.equations, motion, &run.inputs, &own)?;
            Ok(Part { along, places, groups })
        };
        let parts = run.grouped(formulas).into_iter().map(part).collect::<Result<_, Reason>>()?;
        let tracks = run.all_tracks().clone();
        Ok(Self { parts, formulas: formulas.len(), tracks, values: vec![] })
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
        let Self { parts, formulas, tracks, .. } = self;
        let place = tracks.events().nth(index)?;
        let (of, time) = (place.0, tracks.event(place).time);
        let mut found = [vec![f64::NAN; *formulas], vec![f64::NAN; *formulas]];
        for part in parts {
            // Of a run that is one motion its events are all.
            let each = tracks.each();
            let is_own = |group: &usize| part.groups.binary_search(group).is_ok();
            let is_of = |of: usize| each.len() == 1 || each[of].groups.iter().any(is_own);
            let values = match is_of(of) {
                true => {
                    let before = tracks.all_events().iter().take_while(|event| **event != place);
                    let before = before.filter(|(of, _)| is_of(*of)).count();
                    part.along.at_event(before)?
                }
                false => [part.along.at(time, Side::Before)?, part.along.at(time, Side::After)?],
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
    /// By mode of the motion.
    tapes: Vec<Jets<f64>>,
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
        formulas: &[Expr],
    ) -> Result<Self, Reason> {
        let modes = motion.modes.iter();
        let tapes =
            modes.map(|mode| equations.evaluator(mode, formulas, inputs)).collect::<Result<_, _>>()?;
        let singular =
            motion.events.iter().filter(|event| event.record.happened.contains(&Happening::Singular));
        let singular: Vec<f64> = singular.map(|event| event.time).collect();
        let is_forced =
            formulas.iter().map(|formula| !singular.is_empty() && equations.reads_forces(formula));
        let is_forced = is_forced.collect();
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
        let tape = &mut self.tapes[spot.mode];
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
        let mut sides = [self.values(&before), self.values(&after)];
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

    fn values(&mut self, place: &MotionState<'_>) -> Vec<f64> {
        let tape = &mut self.tapes[place.mode];
        self.last = None;
        evaluate(tape, place);
        (0..tape.tape().outputs().len()).map(|index| tape.value_of(index)).collect()
    }
}

/// By which a piece of one motion is known.
fn address(piece: &Piece) -> usize {
    std::ptr::from_ref(piece).addr()
}
