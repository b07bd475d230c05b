//! Quantities along a trajectory: any formula of the bodies' motion, accelerations included.

use tumble_expr::{Branches, Expr, Jets};
use tumble_ode::{Reason, Side, Trajectory};

use crate::equations::Equations;
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
        let (mode, states) = self.trajectory.mode_and_states_at(time, side)?;
        Some(self.values(mode, time, &states))
    }

    /// Values of the formulas just before and just after an event, by its index.
    pub fn at_event(&mut self, event: usize) -> Option<[Vec<f64>; 2]> {
        let event = self.trajectory.events.get(event)?;
        let before = self.values(event.mode_before, event.time, &event.before);
        let after = self.values(event.mode_after, event.time, &event.after);
        Some([before, after])
    }

    fn values(&mut self, mode: usize, time: f64, states: &[f64]) -> Vec<f64> {
        let tape = &mut self.tapes[mode];
        tape.start(time, states, Branches::Free);
        (0..tape.tape().outputs().len()).map(|index| tape.value_of(index)).collect()
    }
}
