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

/// Nodes and weights of Gauss and Legendre on (-1, 1), the positive half.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];
/// Panels of an integral: with ten nodes each, a smooth function is integrated to rounding.
const PANELS: usize = 64;

/// Integral of a smooth function.
pub(crate) fn integral(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let half = 0.5 * (to - from) / PANELS as f64;
    let panel = |index: usize| {
        let middle = from + half * (2 * index + 1) as f64;
        let nodes = GAUSS.iter().map(|(s, w)| w * (f(middle - half * s) + f(middle + half * s)));
        half * nodes.sum::<f64>()
    };
    (0..PANELS).map(panel).sum()
}
