//! What the tests of the laws share.

pub(crate) mod chain;

use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Anchor, Body, ContactLaw, Gravity, Model, Release, Run, RunBalance, RunError, Shape, Spring, Start,
    Surface, time,
};
use tumble_ode::Accuracy;

/// Integrates a model from time 0.
pub(crate) fn run(model: Model, until: f64, accuracy: f64) -> Run {
    let accuracy = Accuracy::new(accuracy).expect("an accuracy that can be asked for");
    let until = until * tumble_expr::units::S;
    let run = model.simulate_to(&[], until, accuracy).map_err(|error| error.to_string());
    run.expect("a motion without singularities")
}

/// When a motion is refused, s, and what is said.
#[track_caller]
pub(crate) fn refused(found: Result<Run, RunError>) -> (f64, String) {
    let Err(error) = found else { panic!("a motion, where there is to be none") };
    let time = match &error {
        RunError::Refused { refusal, .. } => refusal.time,
        _ => 0.0,
    };
    println!("{error}");
    (time, error.to_string())
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

/// One system of `reference/systems.json`.
pub(crate) fn reference(system: &str) -> serde_json::Value {
    let text = include_str!("../../../tumble/tests/reference/systems.json");
    let json: serde_json::Value = serde_json::from_str(text).expect("valid JSON");
    json[system].clone()
}

pub(crate) fn number(value: &serde_json::Value) -> f64 {
    value.as_str().map_or_else(|| value.as_f64(), |text| text.parse().ok()).expect("a number")
}

/// `wind_pendulum_tip` of `reference/systems.json`: the wind acts on the tip, across the rod.
pub(crate) fn wind_pendulum(period: f64) -> Model {
    let (mut model, rod) = hinged_rod();
    let length = 1 * M;
    let phase = 2 * Expr::pi() * time() / (period * S);
    let wind = 0.5 * (20 * M / S) * (1 + phase.cos());
    let kinematics = rod.kinematics();
    let u = wind * kinematics.angle().cos() - &length * kinematics.omega();
    let drag = 0.03 * KG / M * u.abs() * u;
    model.torque("air", &rod, length * drag);
    model
}

/// `bouncing_rod` of `reference/systems.json`, on a floor of that kind.
pub(crate) fn bouncing_rod(law: ContactLaw) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = Body::rod("rod", [-0.5 * M, 0 * M], [0.5 * M, 0 * M]).mass(0.5 * KG);
    let rod = rod.with_point("minus", [-0.5 * M, 0 * M]).with_point("plus", [0.5 * M, 0 * M]);
    let start = Start::default().at([0 * M, 2 * M]).velocity([2 * M / S, 0 * M / S]);
    model.starts.push(("rod".into(), start.angle(Expr::from(0.6)).omega(2 / S)));
    model.add(rod);
    model.surface(Surface::floor("floor", 0 * M, law));
    model
}

pub(crate) fn spring() -> ContactLaw {
    ContactLaw::Spring { stiffness: 1e4 * N / M, damping: 0 * N * S / M, release: Release::AtZeroForce }
}

pub(crate) fn rigid(e: f64) -> ContactLaw {
    ContactLaw::Rigid { restitution: Expr::from(e) }
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

/// A uniform disk, m and kg.
pub(crate) fn disk(name: &str, radius: f64, mass: f64) -> Body {
    Body::of_shape(name, Shape::Disk { centre: place([0.0, 0.0]), radius: radius * M }).mass(mass * KG)
}

/// A uniform box, m and kg.
pub(crate) fn plate(name: &str, [width, height]: [f64; 2], mass: f64) -> Body {
    let shape = Shape::Box { centre: place([0.0, 0.0]), width: width * M, height: height * M };
    Body::of_shape(name, shape).mass(mass * KG)
}

/// A uniform rod along x about its middle, m and kg.
pub(crate) fn rod(name: &str, length: f64, end_radius: f64, mass: f64) -> Body {
    let [from, to] = [-0.5, 0.5].map(|end| place([end * length, 0.0]));
    Body::of_shape(name, Shape::Rod { from, to, end_radius: end_radius * M }).mass(mass * KG)
}

/// In m.
pub(crate) fn place([x, y]: [f64; 2]) -> Vector {
    Vector::planar(x * M, y * M)
}

/// In m, rad, m/s and rad/s.
pub(crate) fn start(place: [f64; 2], angle: f64, velocity: [f64; 2], omega: f64) -> Start {
    let start = Start::default().at(place.map(|x| x * M)).velocity(velocity.map(|v| v * M / S));
    start.angle(Expr::from(angle)).omega(omega / S)
}

/// Bodies where they start, in gravity, m/s^2.
pub(crate) fn model(gravity: f64, bodies: Vec<(Body, Start)>) -> Model {
    let mut model = Model::new();
    if gravity > 0.0 {
        model.gravity = Gravity::Vertical(gravity * M / (S * S));
    }
    for (body, start) in bodies {
        model.starts.push((body.name.clone(), start));
        model.add(body);
    }
    model
}

/// x, y, angle, vx, vy, omega
pub(crate) fn motion(run: &Run, body: usize, time: f64) -> [f64; 6] {
    let body = run.equations.model().bodies[body].kinematics();
    let (p, v) = (body.position(), body.velocity());
    at(run, time, [p[0].clone(), p[1].clone(), body.angle(), v[0].clone(), v[1].clone(), body.omega()])
}

/// The balance about a point that nothing is at, every part of which must close.
#[track_caller]
pub(crate) fn balanced(run: &Run, tolerance: f64) -> RunBalance {
    let balance = RunBalance::of(run, [0.3, -0.2]).expect("a balance");
    println!("{:#?}", balance.contributions);
    assert!(balance.energy.relative() < tolerance, "{:e}", balance.energy.relative());
    assert!(balance.relative() < tolerance, "{:e}", balance.relative());
    balance
}

/// The same bodies as one motion: springs of no stiffness couple them.
pub(crate) fn as_one(model: &Model) -> Model {
    let mut model = model.clone();
    for (index, two) in model.bodies.clone().windows(2).enumerate() {
        model.interact(Spring {
            name: format!("nothing{index}"),
            ends: [Anchor::Material(two[0].cm()), Anchor::Material(two[1].cm())],
            stiffness: 0 * N / M,
            rest_length: 0 * M,
            damping: 0 * N * S / M,
        });
    }
    model
}
