//! The physical pendulum against elliptic functions.

use crate::common::{at, close, hinged_rod, run};
use tumble_expr::units::{KG, M, RAD, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::Run;
use tumble_mech::{Body, Law, Model, Place, Start};

/// A uniform rod, 1 kg and 1 m, held at its end and hanging down at angle zero.
fn pendulum(angle: Expr) -> Model {
    let (mut model, _) = hinged_rod();
    model.starts.push(("rod".into(), Start::default().angle(angle)));
    model
}

/// Samples of `reference/elliptic.json` for one release, as (t, theta, omega).
fn samples(release: usize) -> Vec<[f64; 3]> {
    let text = include_str!("../../tumble/tests/reference/elliptic.json");
    let json: serde_json::Value = serde_json::from_str(text).expect("valid JSON");
    let number = |value: &serde_json::Value| value.as_str().expect("a string").parse().expect("a number");
    let samples = json["releases"][release]["samples"].as_array().expect("a list");
    samples.iter().map(|sample| ["t", "theta", "omega"].map(|key| number(&sample[key]))).collect()
}

fn state(run: &Run, t: f64) -> [f64; 2] {
    let rod = run.equations.model().bodies[0].kinematics();
    at(run, t, [rod.angle(), rod.omega()])
}

/// From exactly 90 degrees only every fourth coefficient of the angle's series is not zero: the known trap.
#[test]
fn released_at_a_right_angle() {
    let run = run(pendulum(Expr::pi() / 2), 10.0, 1e-13);
    for [t, theta, omega] in samples(0).into_iter().filter(|[t, ..]| *t <= 10.0) {
        let found = state(&run, t);
        // A time that is rounded to a double is off by an ulp, and the state with it.
        let rounding = 6.0 * t * f64::EPSILON;
        close(found[0], theta, 1e-13 + rounding);
        close(found[1], omega, 1e-13 + rounding);
    }
}

#[test]
fn released_near_the_top() {
    let run = run(pendulum(Expr::pi() * 5 / 6), 10.0, 1e-13);
    for [t, theta, omega] in samples(1).into_iter().filter(|[t, ..]| *t <= 10.0) {
        close(state(&run, t)[0], theta, 1e-12);
        close(state(&run, t)[1], omega, 1e-12);
    }
}

/// Rounding errors of n steps add up like a random walk in the energy, and its sum in the phase: n^1.5 ulps.
#[test]
fn a_thousand_periods_drift_no_more_than_rounding() {
    let samples: Vec<[f64; 3]> = samples(0).into_iter().filter(|[t, ..]| *t > 1900.0).collect();
    assert!(samples.len() >= 2, "the reference holds a thousand periods");
    let run = run(pendulum(Expr::pi() / 2), 1940.0, 1e-13);
    let steps = run.trajectory().work.steps as f64;
    let growth = steps.powf(1.5) * f64::EPSILON;
    let rod = run.equations.model().bodies[0].kinematics();
    for [t, theta, omega] in samples {
        let found = state(&run, t);
        println!(
            "t = {t}: theta off by {:e}, omega by {:e}, growth {growth:e}",
            found[0] - theta,
            found[1] - omega
        );
        close(found[0], theta, growth);
        close(found[1], omega, growth);
    }
    let energy = |t: f64| {
        let [omega, y] = at(&run, t, [rod.omega(), rod.position()[1].clone()]);
        omega * omega / 6.0 + 9.81 * y
    };
    let drift = (energy(1940.0) - energy(0.0)).abs();
    println!("energy off by {drift:e} after {steps} steps");
    assert!(drift < steps.sqrt() * 10.0 * f64::EPSILON, "{drift:e}");
}

/// The pivot's reaction is a term like any other: with it, forces sum to M A and torques about the centre to I alpha.
#[test]
fn the_reaction_closes_both_laws() {
    let run = run(pendulum(2 * RAD), 3.0, 1e-12);
    let rod = run.equations.model().bodies[0].kinematics();
    let mode = run.trajectory().modes[0].clone();
    let terms = run.equations.terms(&mode);
    assert!(terms.iter().any(|term| term.law == Law::Reaction && term.load == "hinge"));
    let sum = |part: &dyn Fn(&tumble_mech::Term) -> Expr| {
        terms.iter().map(part).reduce(|a, b| a + b).expect("terms")
    };
    for t in [0.0, 0.7, 2.9] {
        let [fx, fy, tau] = at(
            &run,
            t,
            [
                sum(&|term| term.force[0].clone()),
                sum(&|term| term.force[1].clone()),
                sum(&|term| term.torque()),
            ],
        );
        let [ax, ay, alpha] =
            at(&run, t, [rod.acceleration()[0].clone(), rod.acceleration()[1].clone(), rod.alpha()]);
        close(fx, ax, 1e-14);
        close(fy, ay, 1e-14);
        close(tau, alpha / 12.0, 1e-14);
    }
    // Hanging still, the reaction would be the weight; at the turning point it is along the rod and gravity's part.
    let hinge = terms.iter().find(|term| term.law == Law::Reaction).expect("present");
    let [at] = at(&run, 0.5, [(hinge.arm.clone() + rod.position()).norm()]);
    close(at, 0.0, 1e-15);
}

#[test]
fn a_body_is_held_once() {
    let mut model = pendulum(Expr::zero());
    let mut second = model.pivots[0].clone();
    second.name = "nail".into();
    model.pivots.push(second);
    let errors = tumble_mech::Equations::new(model).expect_err("two pivots");
    assert!(errors.to_string().contains("held by `hinge` and by `nail`"), "{errors}");
}

#[test]
fn a_pivot_says_where_its_body_is() {
    let mut model = pendulum(Expr::zero());
    model.starts[0].1.at = Some(Vector::planar(1 * M, 0 * M));
    assert!(tumble_mech::Equations::new(model).is_err());
}

/// A force may depend on another body's state; a material point of one is a place for a force on the other.
#[test]
fn forces_may_follow_another_body() {
    let mut model = pendulum(1 * RAD);
    let rod = model.bodies[0].clone();
    let ball = Body::point("ball").mass(2 * KG);
    let pull = 3 * KG / (S * S) * (rod.cm().position() - ball.kinematics().position());
    model.loads.push(tumble_mech::Load::force("pull", "ball", Place::Material(ball.cm()), pull));
    model.starts.push(("ball".into(), Start::default().at([0 * M, 0 * M])));
    model.bodies.push(ball);
    let run = run(model, 1.0, 1e-12);
    let ball = run.equations.model().bodies[1].kinematics();
    let rod = run.equations.model().bodies[0].kinematics();
    let [ax, x, rx] = at(
        &run,
        0.6,
        [ball.acceleration()[0].clone(), ball.position()[0].clone(), rod.position()[0].clone()],
    );
    close(ax, 1.5 * (rx - x), 1e-15);
}
