//! Rods and a block on a rough floor against independent motions: `references/rough.py` from impact to impact, `references/painleve.py` by
//! published equations of a rod that slides towards where there is no motion.

use crate::common;

use crate::common::{at, close, number, rigid};
use serde_json::Value;
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Friction, Gravity, Model, Run, Shape, Start, Surface};
use tumble_ode::Accuracy;

const G: f64 = 9.81;

fn rough() -> Value {
    let text = include_str!("../../tumble/tests/reference/rough.json");
    serde_json::from_str(text).expect("valid JSON")
}

/// One body on a floor at y = 0.
fn on_floor(body: Body, start: Start, restitution: f64, friction: f64) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push((body.name.clone(), start));
    model.add(body);
    model.surface(
        Surface::floor("floor", 0 * M, rigid(restitution)).with_friction(Friction::new(Expr::from(friction))),
    );
    model
}

/// x, y, vx, vy, angle, omega.
fn state(run: &Run, time: f64) -> [f64; 6] {
    let body = run.equations.model().bodies[0].kinematics();
    let (c, v) = (body.position(), body.velocity());
    at(run, time, [c.x().clone(), c.y().clone(), v.x().clone(), v.y().clone(), body.angle(), body.omega()])
}

/// Times of all events after the start.
fn times(run: &Run) -> Vec<f64> {
    run.events().map(|event| event.time).filter(|time| *time > 0.0).collect()
}

/// Every impact in time and the state between them, to what nine impacts make of rounding.
#[test]
fn rods_bounce_on_a_rough_floor() {
    for (name, speed, rate) in [("turns", 2.0, 2.0), ("slips", 5.0, -2.0)] {
        let end_radius = 0.05 * M;
        let [from, to] = [-0.5, 0.5].map(|x| Vector::planar(x * M, 0 * M));
        let rod = Body::of_shape("rod", Shape::Rod { from, to, end_radius }).mass(0.5 * KG);
        let start = Start::default().at([0 * M, 2.05 * M]).velocity([speed * M / S, 0 * M / S]);
        let model = on_floor(rod, start.angle(Expr::from(0.6)).omega(rate / S), 0.7, 0.1);
        let run = common::run(model, 2.5, 1e-13);
        let expected = &rough()["rods"][name];
        let impacts = expected["impacts"].as_array().expect("impacts");
        let found = times(&run);
        assert_eq!(found.len(), impacts.len(), "{name}: {found:?}");
        found.iter().zip(impacts).for_each(|(time, impact)| close(*time, number(&impact["t"]), 1e-12));
        for (time, states) in expected["states"].as_object().expect("states") {
            let found = state(&run, time.parse().expect("a time"));
            let expected = states.as_array().expect("a state").iter().map(number);
            found.iter().zip(expected).for_each(|(found, expected)| close(*found, expected, 1e-11));
        }
    }
}

/// Housner's block from edge to edge: when, and at what rate it goes on.
#[test]
fn a_block_rocks() {
    let (b, h) = (0.1_f64, 0.4_f64);
    let tilt = 0.5 * (b / h).atan();
    let (sin, cos) = tilt.sin_cos();
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 2.0 * b * M, height: 2.0 * h * M };
    let place = [(-b + b * cos - h * sin) * M, (b * sin + h * cos) * M];
    let start = Start::default().at(place).angle(Expr::from(tilt));
    let run =
        common::run(on_floor(Body::of_shape("block", shape).mass(100 * KG), start, 0.0, 0.8), 2.8, 1e-13);
    let expected = rough()["block"]["impacts"].as_array().expect("impacts").clone();
    let found = times(&run);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (time, impact) in found.iter().zip(&expected) {
        close(*time, number(&impact["t"]), 1e-12);
        close(state(&run, *time)[5], number(&impact["rate"]), 1e-12);
    }
}

fn painleve() -> Value {
    let text = include_str!("../../tumble/tests/reference/painleve.json");
    let json: Value = serde_json::from_str(text).expect("valid JSON");
    json["cases"].clone()
}

/// A rod whose foot is at the origin and slides to the left.
fn sliding(case: &Value) -> Result<Run, String> {
    let [mu, tan, rate, speed] = ["mu", "tan", "rate", "speed"].map(|key| number(&case[key]));
    let (sin, cos) = tan.atan().sin_cos();
    let start = Start::default().at([0.5 * cos * M, 0.5 * sin * M]).angle(Expr::from(tan.atan()));
    let velocity = [(speed - 0.5 * rate * sin) * M / S, 0.5 * rate * cos * M / S];
    let rod = Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(1 * KG);
    let model = on_floor(rod, start.velocity(velocity).omega(rate / S), 0.0, mu);
    let accuracy = Accuracy::new(1e-13).expect("an accuracy");
    model.simulate_to(&[], 1.5 * number(&case["t"]) * S, accuracy).map_err(|error| error.to_string())
}

/// The foot's velocity along the floor.
fn foot([_, _, vx, _, angle, omega]: [f64; 6]) -> f64 {
    vx + 0.5 * omega * angle.sin()
}

/// The foot stops, or lifts off, where it is to.
#[test]
fn a_rod_slides_until_its_foot_stops_or_lifts_off() {
    for name in ["stops", "stops_low", "lifts_off"] {
        let case = &painleve()[name];
        let run = sliding(case).expect("it slides");
        let found = times(&run)[0];
        close(found, number(&case["t"]), 1e-16);
        let after = state(&run, found);
        close(after[4], number(&case["angle"]), 1e-15);
        close(after[5], number(&case["end_rate"]), 1e-15);
        close(foot(after), number(&case["end_speed"]), 1e-14);
    }
}

/// How near to the singular point a sliding is followed, in s and rad: up to a part of 1e-6 in the coefficient of friction.
const NEAR: f64 = 1e-6;

/// The singular point is named where it is reached, and where the foot lifts off next to it.
#[test]
fn a_rod_that_slides_to_the_singular_point_is_refused_there() {
    for name in ["lifts_off_late", "singular"] {
        let case = &painleve()[name];
        let refused = sliding(case).map(|run| run.end()).expect_err("there is no motion from there on");
        assert!(refused.contains("Painleve"), "{refused}");
        let after = |word: &str| {
            let number = refused.split(word).nth(1).and_then(|rest| rest.trim().split(' ').next());
            number.and_then(|number| number.parse::<f64>().ok()).expect("a number")
        };
        let (time, angle) = (after("t = "), after("`rod` is at"));
        assert!((time - number(&case["t"])).abs() < NEAR, "{name}: {refused}");
        assert!((angle - number(&case["angle"])).abs() < NEAR, "{name}: {refused}");
    }
}
