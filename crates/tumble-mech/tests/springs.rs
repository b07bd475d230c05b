//! Springs, dampers and moving anchors against closed forms.

use std::ops::ControlFlow;

use crate::common::{at, close, run};
use tumble_expr::units::{KG, M, RAD, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Anchor, At, Body, Gravity, Model, Run, Spring, Start, Torsion, time};
use tumble_ode::{Accuracy, Side};

fn here(x: f64, y: f64) -> Vector {
    Vector::planar(x * M, y * M)
}

fn spring(ends: [Anchor; 2], stiffness: f64, rest_length: f64, damping: f64) -> Spring {
    let second = KG / S;
    Spring {
        name: "spring".into(),
        ends,
        stiffness: stiffness * KG / (S * S),
        rest_length: rest_length * M,
        damping: damping * second,
    }
}

/// A mass of 2 kg on a line, between a wall at 0 and its rest place at 1 m, started at 1.5 m.
fn on_a_line(damping: f64, wall: Vector) -> (Model, Body) {
    let mut model = Model::new();
    let ball = model.add(Body::point("ball").mass(2 * KG));
    model.interact(spring([Anchor::World(wall), Anchor::Material(ball.cm())], 8.0, 1.0, damping));
    model.starts.push(("ball".into(), Start::default().at([1.5 * M, 0 * M])));
    (model, ball)
}

#[test]
fn undamped_and_damped() {
    for damping in [0.0, 0.8] {
        let (model, ball) = on_a_line(damping, here(0.0, 0.0));
        let run = run(model, 10.0, 1e-12);
        let beta: f64 = damping / 4.0;
        let w = (4.0 - beta * beta).sqrt();
        let exact = |t: f64| 1.0 + 0.5 * (-beta * t).exp() * ((w * t).cos() + beta / w * (w * t).sin());
        for t in [0.3, 2.0, 10.0] {
            close(at(&run, t, [ball.kinematics().position()[0].clone()])[0], exact(t), 1e-12);
        }
    }
}

/// Driven through its moving anchor at another frequency: the sum of two cosines.
#[test]
fn a_shaken_anchor() {
    let shaken = Vector::planar(0.1 * M * (3 * time() / (1.0 * S)).sin(), Expr::zero());
    let (model, ball) = on_a_line(0.0, shaken);
    let run = run(model, 10.0, 1e-12);
    // x'' = -4 (x - 1 - 0.1 sin 3t), x(0) = 1.5, x'(0) = 0.
    let forced = 0.4 / (4.0 - 9.0);
    let exact =
        |t: f64| 1.0 + 0.5 * (2.0 * t).cos() - 1.5 * forced * (2.0 * t).sin() + forced * (3.0 * t).sin();
    for t in [0.3, 2.0, 10.0] {
        close(at(&run, t, [ball.kinematics().position()[0].clone()])[0], exact(t), 1e-12);
    }
}

/// Parametric: a spring that softens as 1/(1+t)^2 has x = sqrt(1+t) (cos(q ln(1+t)) + ...) with q^2 = k/m - 1/4.
#[test]
fn a_softening_spring() {
    let mut model = Model::new();
    let ball = model.add(Body::point("ball").mass(2 * KG));
    let mut softening = spring([Anchor::World(here(0.0, 0.0)), Anchor::Material(ball.cm())], 18.5, 0.0, 0.0);
    let age = 1 + time() / (1.0 * S);
    softening.stiffness = softening.stiffness / (&age * &age);
    model.interact(softening);
    model.starts.push(("ball".into(), Start::default().at([1 * M, 0 * M])));
    let run = run(model, 50.0, 1e-12);
    // q = 3; x(0) = 1 and x'(0) = 0 ask for 1/2 + q B = 0.
    for t in [0.5, 7.0, 50.0] {
        let t: f64 = t;
        let phase = 3.0 * (1.0 + t).ln();
        let exact = (1.0 + t).sqrt() * (phase.cos() - phase.sin() / 6.0);
        close(at(&run, t, [ball.kinematics().position()[0].clone()])[0], exact, 1e-12);
    }
}

/// Two bodies: their centre of mass stays, their distance swings with the reduced mass.
#[test]
fn two_bodies_and_a_spring() {
    let mut model = Model::new();
    let [a, b] = [("a", 2.0), ("b", 6.0)].map(|(name, mass)| model.add(Body::point(name).mass(mass * KG)));
    model.interact(spring([Anchor::Material(a.cm()), Anchor::Material(b.cm())], 6.0, 1.0, 0.0));
    model.starts.push(("a".into(), Start::default().at([0 * M, 0 * M])));
    model.starts.push(("b".into(), Start::default().at([1.2 * M, 0 * M])));
    let run = run(model, 7.0, 1e-12);
    let [xa, xb] =
        at(&run, 7.0, [a.kinematics().position()[0].clone(), b.kinematics().position()[0].clone()]);
    // Reduced mass 1.5 kg: omega = 2.
    close(xb - xa, 1.0 + 0.2 * 14.0_f64.cos(), 1e-12);
    close((2.0 * xa + 6.0 * xb) / 8.0, 0.9, 1e-14);
}

/// Without rest length the spring passes through zero length: an ellipse about the anchor.
#[test]
fn a_spring_through_zero_length() {
    let mut model = Model::new();
    let ball = model.add(Body::point("ball").mass(1 * KG));
    model.interact(spring([Anchor::World(here(0.0, 0.0)), Anchor::Material(ball.cm())], 9.0, 0.0, 0.0));
    model.starts.push(("ball".into(), Start::default().at([1 * M, 0 * M])));
    let run = run(model, 10.0, 1e-13);
    close(at(&run, 10.0, [ball.kinematics().position()[0].clone()])[0], 30.0_f64.cos(), 1e-13);
}

#[test]
fn a_damped_torsion_pendulum() {
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(3 * KG));
    model.pivot(&rod, [0 * M, 0 * M]);
    model.interact(Torsion {
        name: "wire".into(),
        body: rod.kinematics(),
        stiffness: 4 * KG * M * M / (S * S),
        rest_angle: 1 * RAD,
        damping: 0.4 * KG * M * M / S,
    });
    model.starts.push(("rod".into(), Start::default().angle(10 * RAD)));
    let run = run(model, 10.0, 1e-12);
    let (beta, w) = (0.2_f64, 3.96_f64.sqrt());
    let t = 10.0;
    let exact = 1.0 + 9.0 * (-beta * t).exp() * ((w * t).cos() + beta / w * (w * t).sin());
    close(at(&run, t, [rod.kinematics().angle()])[0], exact, 1e-12);
}

/// Small swings of a rod whose pivot is moved sideways: theta'' = -(3g/2L) theta - (3/2L) x_P'', linear in the shake.
#[test]
fn a_shaken_pivot() {
    let (epsilon, nu) = (1e-7, 2.0_f64);
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    let shaken = epsilon * M * (nu * time() / (1.0 * S)).sin();
    model.pivot_at("table", &rod, [0 * M, 0 * M], [shaken, Expr::zero()]);
    // At rest in the shaken frame's steady swing there is no transient: start with the matching rate.
    let w2 = 1.5 * 9.81;
    let amplitude = 1.5 * epsilon * nu * nu / (w2 - nu * nu);
    model.starts.push(("rod".into(), Start::default().omega(amplitude * nu * RAD / S)));
    let run = run(model, 10.0, 1e-13);
    let k = rod.kinematics();
    for t in [0.7, 3.0, 10.0] {
        let [theta, x, vx] = at(&run, t, [k.angle(), k.position()[0].clone(), k.velocity()[0].clone()]);
        close(theta / epsilon, amplitude * (nu * t).sin() / epsilon, 1e-5);
        close(x / epsilon, (nu * t).sin() + 0.5 * theta.sin() / epsilon, 1e-6);
        close(vx / epsilon, nu * (nu * t).cos() + 0.5 * at(&run, t, [k.omega()])[0] / epsilon, 1e-6);
    }
}

/// Kapitza: upside down, a pivot shaken fast enough up and down holds the pendulum up; at rest it falls.
#[test]
fn kapitzas_pendulum_stands() {
    let stands = |amplitude: f64| {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(9.81 * M / (S * S));
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
        let shaken = amplitude * M * (200 * time() / (1.0 * S)).cos();
        model.pivot_at("table", &rod, [0 * M, 0 * M], [Expr::zero(), shaken]);
        model.starts.push(("rod".into(), Start::default().angle(3.1 * RAD)));
        let run = run(model, 10.0, 1e-9);
        (0..=1000).all(|i| at(&run, 0.01 * f64::from(i), [rod.kinematics().angle()])[0] > 2.9)
    };
    // The threshold is a nu > sqrt(2 g l) with l = 2L/3: a = 0.018 m.
    assert!(stands(0.04));
    assert!(!stands(0.0));
    assert!(!stands(0.01));
}

/// A corner in a pivot's path is an impact that no force stands for.
#[test]
fn a_cornered_path_is_refused() {
    let mut model = Model::new();
    let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
    let path = 1 * M / S * (time() - 1 * S).abs();
    model.pivot_at("table", &rod, [0 * M, 0 * M], [path, Expr::zero()]);
    let errors = tumble_mech::Equations::new(model).expect_err("a corner at 1 s");
    assert!(errors.to_string().contains("path of pivot `table` has a branch"), "{errors}");
}

#[test]
fn springs_must_have_their_dimensions() {
    let (mut model, ball) = on_a_line(0.0, here(0.0, 0.0));
    model.interactions.clear();
    let mut bad = spring([Anchor::World(here(0.0, 0.0)), Anchor::Material(ball.cm())], 1.0, 1.0, 0.0);
    bad.stiffness = 1 * KG / S;
    model.interact(bad);
    let errors = tumble_mech::Equations::new(model).expect_err("a damping");
    assert!(errors.to_string().contains("stiffness of `spring`: expected a stiffness"), "{errors}");
}

/// A mass that swings on a spring, against an independent integration, `references/elastic.py`: what is stated of its errors covers
/// them, from one digit asked for to all.
#[test]
fn an_elastic_pendulum() {
    let json: serde_json::Value =
        serde_json::from_str(include_str!("../../tumble/tests/reference/elastic.json")).expect("valid JSON");
    let number = |value: &serde_json::Value| value.as_str().and_then(|text| text.parse::<f64>().ok());
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let bob = model.add(Body::point("bob").mass(1 * KG));
    let ends = [Anchor::World(here(0.0, 0.0)), Anchor::Material(bob.cm())];
    model.interact(spring(ends, 40.0, 1.0, 0.0));
    model.starts.push(("bob".into(), Start::default().at([1 * M, 0.2 * M])));
    let motion = bob.kinematics();
    let formulas = [motion.position().components(), motion.velocity().components()].concat();
    for accuracy in [1e-3, 1e-6, 1e-9, 1e-12] {
        let accuracy = Accuracy::new(accuracy).expect("an accuracy");
        let go = |_| ControlFlow::Continue(());
        let (run, trust) = Run::trusted(&model, &model.parameters, 10.0, accuracy, go).expect("a motion");
        for sample in json["samples"].as_array().expect("a list") {
            let time = number(&sample["t"]).expect("a time");
            let found = run.observe(&formulas).expect("formulas").at(time, Side::Before).expect("within");
            for ((formula, name), found) in formulas.iter().zip(["x", "y", "vx", "vy"]).zip(found) {
                let known = number(&sample[name]).expect("a number");
                let at = At { time, side: Side::Before, off: 0.0 };
                let stated = trust.error_at(&run, formula, at).expect("a formula").expect("known");
                assert!((found - known).abs() <= stated, "{name} at {time} s: {found}, {known}, {stated}");
                assert!(stated <= 10.0 * accuracy.value(), "{name} at {time} s is known to {stated}");
            }
        }
    }
}
