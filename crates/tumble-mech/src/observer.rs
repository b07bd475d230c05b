//! Quantities along a trajectory: any formula of the bodies' motion, accelerations included.

use tumble_expr::{Expr, Jets};
use tumble_ode::{Place, Reason, Side, Trajectory};

use crate::equations::Equations;
use crate::evaluator::evaluate;
use crate::mode::Mode;

/// Evaluates formulas at any time of one trajectory.
pub struct Observer<'a> {
    trajectory: &'a Trajectory<Mode>,
    /// By mode of the trajectory.
    tapes: Vec<Jets<f64>>,
}

impl<'a> Observer<'a> {
    /// Prepares `formulas` for every mode of the trajectory; `inputs` are the values it was found with.
    pub fn new(
        equations: &Equations,
        trajectory: &'a Trajectory<Mode>,
        inputs: &[f64],
        formulas: &[Expr],
    ) -> Result<Self, Reason> {
        let modes = trajectory.modes.iter();
        let tapes =
            modes.map(|mode| equations.evaluator(mode, formulas, inputs)).collect::<Result<_, _>>()?;
        Ok(Self { trajectory, tapes })
    }

    /// Values of the formulas at `time`, in their order; `None` outside the trajectory.
    pub fn at(&mut self, time: f64, side: Side) -> Option<Vec<f64>> {
        let place = self.trajectory.place_at(time, side)?;
        Some(self.values(&place))
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
        evaluate(tape, place);
        (0..tape.tape().outputs().len()).map(|index| tape.value_of(index)).collect()
    }
}
