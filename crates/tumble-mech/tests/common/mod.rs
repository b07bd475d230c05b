//! What the tests of the laws share.
#![allow(dead_code)]

use tumble_expr::Expr;
use tumble_mech::{Equations, Mode, Model, Observer};
use tumble_ode::{Accuracy, Side, Trajectory, solve};

/// A motion with what it was computed from.
pub(crate) struct Run {
    pub(crate) equations: Equations,
    pub(crate) trajectory: Trajectory<Mode>,
    inputs: Vec<f64>,
}

/// Integrates a model from time 0.
pub(crate) fn run(model: Model, until: f64, accuracy: f64) -> Run {
    let equations = Equations::new(model).expect("a sound model");
    let start = equations.start(&equations.model().parameters.clone()).expect("sound values");
    let inputs = start.inputs.clone();
    let accuracy = Accuracy::new(accuracy).expect("an accuracy that can be asked for");
    let trajectory = solve(&equations, start, until, accuracy).expect("a motion without singularities");
    Run { equations, trajectory, inputs }
}

impl Run {
    /// Values of formulas at a time.
    pub(crate) fn at<const N: usize>(&self, time: f64, formulas: [Expr; N]) -> [f64; N] {
        let mut observer =
            Observer::new(&self.equations, &self.trajectory, &self.inputs, &formulas).expect("typed");
        observer.at(time, Side::After).expect("within the run").try_into().expect("one value a formula")
    }
}

/// Asserts that two numbers agree to `tolerance`, relative to the larger of 1 and the expected one.
#[track_caller]
pub(crate) fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found:?} is not {expected:?}");
}
