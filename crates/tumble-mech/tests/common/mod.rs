//! What the tests of the laws share.
#![allow(dead_code)]

use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, Gravity, Model, Run};
use tumble_ode::Accuracy;

/// Integrates a model from time 0.
pub(crate) fn run(model: Model, until: f64, accuracy: f64) -> Run {
    let accuracy = Accuracy::new(accuracy).expect("an accuracy that can be asked for");
    let until = until * tumble_expr::units::S;
    let run = model.simulate_to(&[], until, accuracy).map_err(|error| error.to_string());
    run.expect("a motion without singularities")
}

/// Values of formulas at a time.
pub(crate) fn at<const N: usize>(run: &Run, time: f64, formulas: [Expr; N]) -> [f64; N] {
    let values = run.at(time).and_then(|instant| instant.values(formulas));
    values.map_err(|error| error.to_string()).expect("within the run")
}

/// Asserts that two numbers agree to `tolerance`, relative to the larger of 1 and the expected one.
#[track_caller]
pub(crate) fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected.abs().max(1.0), "{found:?} is not {expected:?}");
}

/// A uniform rod, 1 kg and 1 m, held at its end by `hinge`, hanging down at angle zero in gravity.
pub(crate) fn hinged_rod() -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    model.pivot_at("hinge", &rod, [0 * M, 0 * M], [0 * M, 0 * M]);
    (model, rod)
}
