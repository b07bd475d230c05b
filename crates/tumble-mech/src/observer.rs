//! Quantities along a trajectory: any formula of the bodies' motion, accelerations included.

use tumble_expr::{Expr, Jets};
use tumble_ode::{Cursor, Motion, Piece, Place, Reason, Side};

use crate::equations::Equations;
use crate::evaluator::{evaluate, evaluate_in};

/// Evaluates formulas at any time of one trajectory.
pub struct Observer<'a> {
    trajectory: &'a Motion<Equations>,
    /// By mode of the trajectory.
    tapes: Vec<Jets<f64>>,
    cursor: Cursor,
    states: Vec<f64>,
    /// The time and the piece that the tape of its mode was evaluated at last.
    last: Option<(f64, &'a Piece)>,
}

impl<'a> Observer<'a> {
    /// Prepares `formulas` for every mode of the trajectory; `inputs` are the values it was found with.
    pub fn new(
        equations: &Equations,
        trajectory: &'a Motion<Equations>,
        inputs: &[f64],
        formulas: &[Expr],
    ) -> Result<Self, Reason> {
        let modes = trajectory.modes.iter();
        let tapes =
            modes.map(|mode| equations.evaluator(mode, formulas, inputs)).collect::<Result<_, _>>()?;
        Ok(Self { trajectory, tapes, cursor: Cursor::default(), states: vec![], last: None })
    }

    /// Values of the formulas at `time`, in their order; `None` outside the trajectory.
    pub fn at(&mut self, time: f64, side: Side) -> Option<Vec<f64>> {
        let mut values = vec![];
        self.at_into(time, side, &mut values).then_some(values)
    }

    /// The same put into `values`; whether there are any. Many times are best asked for in order.
    pub fn at_into(&mut self, time: f64, side: Side, values: &mut Vec<f64>) -> bool {
        values.clear();
        let Some(spot) = self.trajectory.spot_at(time, side, &mut self.cursor) else { return false };
        let tape = &mut self.tapes[spot.mode];
        // Within a piece both sides of an instant are one.
        let here = spot.piece().map(|piece| (time, piece));
        let is_known = matches!((here, self.last), (Some((time, here)), Some((known, last)))
            if time == known && std::ptr::eq(here, last));
        if !is_known {
            self.states.clear();
            spot.states_into(time, &mut self.states);
            evaluate_in(tape, spot.piece(), time, &self.states);
            self.last = here;
        }
        values.extend((0..tape.tape().outputs().len()).map(|index| tape.value_of(index)));
        true
    }

    /// Values of the formulas just before and just after an event, by its index.
    pub fn at_event(&mut self, index: usize) -> Option<[Vec<f64>; 2]> {
        let events = &self.trajectory.events;
        let event = events.get(index)?;
        let others = [index.checked_sub(1).and_then(|before| events.get(before)), events.get(index + 1)];
        let [before, after] =
            [(Side::Before, event.mode_before, &event.before), (Side::After, event.mode_after, &event.after)]
                .map(|(side, mode, states)| Place {
                    mode,
                    time: event.time,
                    states: states.clone(),
                    // Between two events of one instant there is no piece.
                    piece: match others[side as usize] {
                        Some(other) if other.time == event.time => None,
                        _ => self.trajectory.place_at(event.time, side).and_then(|place| place.piece),
                    },
                });
        Some([self.values(&before), self.values(&after)])
    }

    fn values(&mut self, place: &Place<'_>) -> Vec<f64> {
        let tape = &mut self.tapes[place.mode];
        self.last = None;
        evaluate(tape, place);
        (0..tape.tape().outputs().len()).map(|index| tape.value_of(index)).collect()
    }
}
