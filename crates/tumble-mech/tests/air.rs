//! Air resistance along lines and lift, against closed forms and the reference.

use std::ops::ControlFlow;

use crate::common::{at, close, run};
use tumble_expr::units::{KG, M, RAD, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Component, Drag, DragPlace, Gravity, Magnus, Model, Pivot, Shape, Start, Wind};

const G: f64 = 9.81;

fn rod(length: f64, mass: f64) -> Body {
    Body::rod("rod", [-length / 2.0 * M, 0 * M], [length / 2.0 * M, 0 * M]).mass(mass * KG)
}

fn along(body: &Body, quadratic: f64, component: Component) -> Drag {
    let half = body.parts[0].shape.clone();
    let tumble_mech::Shape::Rod { from, to, .. } = half else { unreachable!("a rod") };
    let lines = vec![[body.at(&from), body.at(&to)]];
    let quadratic = Some(quadratic * KG / (M * M));
    Drag { name: "air".into(), on: DragPlace::Lines { lines, component }, linear: None, quadratic }
}

/// `thrown_rod_air` of `reference/systems.json`: eight Gauss nodes.
#[test]
fn the_thrown_rod_in_air() {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let rod = model.add(rod(1.0, 0.5));
    model.interact(along(&rod, 0.02, Component::Full));
    let start = Start::default()
        .at([0 * M, 1 * M])
        .velocity([8 * M / S, 6 * M / S])
        .angle(0.5 * RAD)
        .omega(6 * RAD / S);
    model.starts.push(("rod".into(), start));
    let equations = tumble_mech::Equations::new(model.clone()).expect("sound");
    let accuracy = tumble_ode::Accuracy::new(1e-13).expect("allowed");
    let eight =
        tumble_mech::Run::new(equations, &model.parameters, 1.2, accuracy, |_| ControlFlow::Continue(()))
            .expect("smooth");
    let (k, p, v) = (rod.kinematics(), rod.kinematics().position(), rod.kinematics().velocity());
    let quantities = [p[0].clone(), p[1].clone(), v[0].clone(), v[1].clone(), k.angle(), k.omega()];
    let text = include_str!("../../tumble/tests/reference/systems.json");
    let json: serde_json::Value = serde_json::from_str(text).expect("valid JSON");
    let reference = json["thrown_rod_air"]["state"].as_array().expect("a list").clone();
    for (found, expected) in at(&eight, 1.2, quantities.clone()).into_iter().zip(&reference) {
        close(found, expected.as_str().expect("text").parse().expect("a number"), 1e-13);
    }
    // Left to itself it takes as many nodes as the accuracy needs, and says so.
    let refined = run(model, 1.2, 1e-9);
    assert!(refined.quadrature.is_some_and(|quadrature| quadrature.settled && quadrature.nodes >= 16));
    for (found, expected) in at(&refined, 1.2, quantities).into_iter().zip(&reference) {
        close(found, expected.as_str().expect("text").parse().expect("a number"), 1e-4);
    }
}

/// A rod that falls flat: every piece of it falls alike, m v' = -m g + c L v^2.
#[test]
fn a_rod_falling_flat() {
    let (length, mass, c) = (2.0, 0.5, 0.3);
    let v = (mass * G / (c * length)).sqrt();
    for component in [Component::Normal, Component::Full] {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(G * M / (S * S));
        let rod = model.add(rod(length, mass));
        model.interact(along(&rod, c, component));
        model.starts.push(("rod".into(), Start::default().at([0 * M, 0 * M])));
        let run = run(model, 2.0, 1e-12);
        let [y, angle] = at(&run, 2.0, [rod.kinematics().position()[1].clone(), rod.kinematics().angle()]);
        close(y, -v * v / G * (G * 2.0 / v).cosh().ln(), 1e-12);
        close(angle, 0.0, 1e-15);
    }
}

/// A rod spinning about its centre: I omega' = -c L^4 omega^2 / 32, so 1/omega grows evenly.
#[test]
fn a_spinning_rod() {
    let (length, mass, c) = (2.0, 0.5, 0.3);
    for component in [Component::Normal, Component::Full] {
        let mut model = Model::new();
        let rod = model.add(rod(length, mass));
        model.interact(along(&rod, c, component));
        model.starts.push(("rod".into(), Start::default().at([0 * M, 0 * M]).omega(-7 * RAD / S)));
        let run = run(model, 3.0, 1e-12);
        let inertia = mass * length * length / 12.0;
        let rate = c * length.powi(4) / 32.0 / inertia;
        let [omega] = at(&run, 3.0, [rod.kinematics().omega()]);
        // The full vector is summed over nodes, and |v| has a corner in the middle: that the digits asked for are not
        // reached is said, with how many are.
        let tolerance = match run.quadrature {
            Some(quadrature) => {
                assert!(!quadrature.settled);
                4.0 * quadrature.change
            }
            None => 1e-13,
        };
        assert_eq!(run.quadrature.is_some(), component == Component::Full);
        close(omega, -7.0 / (1.0 + 7.0 * rate * 3.0), tolerance);
    }
}

/// A box in air that brings it to rest: what rounding has left of its velocity is larger than what is left of its turning, and
/// hides it. It moves ever less, and so do its steps become ever longer.
#[test]
fn what_has_stopped_turning_is_not_followed_in_small_steps() {
    let [width, height, mass, linear] = [9.3, 1.0, 2.8e5, 90.0];
    let mut model = Model::new();
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: width * M, height: height * M };
    let body = model.add(Body::of_shape("box", shape).mass(mass * KG));
    let corner = |x: f64, y: f64| body.at(&Vector::planar(x * width / 2.0 * M, y * height / 2.0 * M));
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (1.0, 1.0)].map(|(x, y)| corner(x, y));
    let lines = corners.windows(2).map(|ends| [ends[0].clone(), ends[1].clone()]).collect();
    model.interact(Drag {
        name: "air".into(),
        on: DragPlace::Lines { lines, component: Component::Normal },
        linear: Some(linear * KG / (M * S)),
        quadratic: Some(260 * KG / (M * M)),
    });
    model.starts.push(("box".into(), Start::default().at([0 * M, 0 * M]).omega(-0.002576 * RAD / S)));
    let run = run(model, 1.96e4, 4.6e-5);
    assert!(run.trajectory().work.steps < 1000, "{:?}", run.trajectory().work);
}

/// The closed form along the rod against many Gauss nodes, with the change of sign anywhere on it or beyond.
#[test]
fn a_sign_change_along_the_rod() {
    for (speed, omega) in
        [(0.0, 3.0), (0.3, 3.0), (1.4, 3.0), (1.6, 3.0), (-0.7, -2.0), (5.0, 0.0), (1.5, 3.0)]
    {
        let mut model = Model::new();
        let rod = model.add(rod(1.0, 0.5));
        model.interact(along(&rod, 0.3, Component::Normal));
        let start =
            Start::default().at([0 * M, 0 * M]).velocity([0 * M / S, speed * M / S]).omega(omega * RAD / S);
        model.starts.push(("rod".into(), start));
        let run = run(model, 0.01, 1e-9);
        let k = rod.kinematics();
        let [ay, alpha] = at(&run, 0.0, [k.acceleration()[1].clone(), k.alpha()]);
        let n = 200_000;
        let (mut force, mut torque) = (0.0, 0.0);
        for i in 0..n {
            let s = (f64::from(i) + 0.5) / f64::from(n) - 0.5;
            let u = -(speed + omega * s);
            force += 0.3 * u.abs() * u / f64::from(n);
            torque += 0.3 * u.abs() * u * s / f64::from(n);
        }
        close(ay, force / 0.5, 1e-9);
        close(alpha, torque / (0.5 / 12.0), 1e-9);
    }
}

/// A rod on a pivot in its middle, released from rest by a torsion spring: both ends start and turn together, so the
/// quotient in the closed form is 0/0 at the start and at every turning point.
#[test]
fn a_torsion_pendulum_in_air_passes_its_turning_points() {
    let swing = |component| {
        let mut model = Model::new();
        let rod = model.add(rod(2.0, 3.0));
        model.pivot(&rod, [0 * M, 0 * M]);
        model.interact(along(&rod, 0.5, component));
        model.interact(tumble_mech::Torsion {
            name: "wire".into(),
            body: rod.kinematics(),
            stiffness: 4 * KG * M * M / (S * S),
            rest_angle: Expr::zero(),
            damping: Expr::zero(),
        });
        model.starts.push(("rod".into(), Start::default().angle(2 * RAD)));
        let run = run(model, 20.0, 1e-11);
        (at(&run, 20.0, [rod.kinematics().angle(), rod.kinematics().omega()]), run.trajectory().work)
    };
    let ([angle, omega], work) = swing(Component::Normal);
    // The same law as one torque: I omega' = -4 theta - c L^4 |omega| omega / 32 with I = 1.
    let mut model = Model::new();
    let body = model.add(rod(2.0, 3.0));
    model.pivot(&body, [0 * M, 0 * M]);
    let k = body.kinematics();
    let unit = KG * M * M;
    let torque = -(4 * unit / (S * S) * k.angle()) - 0.25 * unit * k.omega().abs() * k.omega();
    model.torque("both", &body, torque);
    model.starts.push(("rod".into(), Start::default().angle(2 * RAD)));
    let whole = run(model, 20.0, 1e-11);
    let [a, o] = at(&whole, 20.0, [k.angle(), k.omega()]);
    println!("{:e} {:e} {work:?}", angle - a, omega - o);
    close(angle, a, 1e-11);
    close(omega, o, 1e-11);
}

/// In a wind that changes across the rod the closed form does not hold, and nodes are summed.
#[test]
fn an_uneven_wind_is_summed() {
    let [x, _] = tumble_mech::place_symbols();
    let x = Expr::from(x);
    let mut model = Model::new();
    let rod = model.add(rod(2.0, 0.5));
    model.wind = Wind(Vector::planar(Expr::zero(), &x * &x / (M * S)));
    model.interact(along(&rod, 0.3, Component::Normal));
    model.starts.push(("rod".into(), Start::default().at([0 * M, 0 * M])));
    assert!(model.has_quadrature());
    let run = run(model, 0.01, 1e-9);
    let [ay] = at(&run, 0.0, [rod.kinematics().acceleration()[1].clone()]);
    // The integral of 0.3 x^4 from -1 to 1.
    close(ay, 0.3 * 0.4 / 0.5, 1e-12);
}

/// A wind with a corner is not linear although each of its sides is: abs(y) blows as the root of y^2 does.
#[test]
fn a_wind_with_a_corner_is_summed() {
    let swing = |size: fn(Expr) -> Expr| {
        let [_, y] = tumble_mech::place_symbols();
        let mut model = Model::new();
        let rod = model.add(rod(1.0, 1.0));
        model.pivot(&rod, [0 * M, 0 * M]);
        model.wind = Wind(Vector::planar(3 * size(y.into()) / S, Expr::zero()));
        model.interact(along(&rod, 0.5, Component::Normal));
        model.starts.push(("rod".into(), Start::default().angle(0.4 * RAD).omega(1 * RAD / S)));
        assert!(model.has_quadrature());
        let run = run(model, 2.0, 1e-9);
        at(&run, 2.0, [rod.kinematics().angle()])[0]
    };
    let (absolute, root) = (swing(|y| y.abs()), swing(|y| (&y * &y).sqrt()));
    close(absolute, 1.529_496_67, 1e-7);
    close(root, absolute, 1e-9);
}

/// Lift alone turns the velocity at the constant rate S omega / m: the ball flies a circle.
#[test]
fn lift_alone_makes_a_circle() {
    let mut model = Model::new();
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(0.5 * KG));
    model.interact(Magnus { name: "lift".into(), at: ball.cm(), factor: 0.02 * KG });
    let start = Start::default().at([0 * M, 0 * M]).velocity([3 * M / S, 0 * M / S]).omega(50 * RAD / S);
    model.starts.push(("ball".into(), start));
    let run = run(model, 2.0, 1e-13);
    let k = ball.kinematics();
    let [vx, vy, x, y] = at(
        &run,
        2.0,
        [k.velocity()[0].clone(), k.velocity()[1].clone(), k.position()[0].clone(), k.position()[1].clone()],
    );
    let rate: f64 = 0.02 * 50.0 / 0.5;
    close(vx, 3.0 * (rate * 2.0).cos(), 1e-13);
    close(vy, 3.0 * (rate * 2.0).sin(), 1e-13);
    close(x, 3.0 / rate * (rate * 2.0).sin(), 1e-13);
    close(y, 3.0 / rate * (1.0 - (rate * 2.0).cos()), 1e-13);
}

/// With a pivot held in a wind, drag at the centre is what the user would write by hand.
#[test]
fn drag_at_a_point_is_the_written_force() {
    let wind =
        |t: Expr| Vector::planar(10 * M / S * (1 + (2 * Expr::pi() * t / (1 * S)).cos()), Expr::zero());
    let model = |by_hand: bool| {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(9.81 * M / (S * S));
        let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(1 * KG));
        let origin = Vector::planar(0 * M, 0 * M);
        model.pivots.push(Pivot {
            name: "hinge".into(),
            body: "rod".into(),
            point: origin.clone(),
            world: origin,
        });
        model.wind = Wind(wind(tumble_mech::time()));
        let d = 0.02 * KG / M;
        if by_hand {
            let u = wind(tumble_mech::time()) - rod.cm().velocity();
            model.force("air", &rod.cm(), d * u.norm() * u);
        } else {
            let on = DragPlace::Point(rod.cm());
            model.interact(Drag { name: "air".into(), on, linear: None, quadratic: Some(d) });
        }
        model
    };
    let [a, b] = [true, false].map(|by_hand| run(model(by_hand), 20.0, 1e-12));
    let angle = || [a.equations.model().bodies[0].kinematics().angle()];
    assert_eq!(at(&a, 20.0, angle())[0].to_bits(), at(&b, 20.0, angle())[0].to_bits());
}

#[test]
fn wrong_coefficients_are_refused() {
    let mut model = Model::new();
    let rod = model.add(rod(1.0, 0.5));
    let mut drag = along(&rod, 0.3, Component::Normal);
    drag.quadratic = Some(0.3 * KG / M);
    model.interact(drag);
    let errors = tumble_mech::Equations::new(model.clone()).expect_err("a coefficient at a point");
    assert!(errors.to_string().contains("quadratic of `air`: expected a quantity in kg/m^2"), "{errors}");
    model.interactions.clear();
    model.interact(along(&rod, -0.3, Component::Normal));
    let equations = tumble_mech::Equations::new(model).expect("dimensions fit");
    let errors = equations.start(&equations.model().parameters).expect_err("negative");
    assert!(errors.to_string().contains("must not be negative"), "{errors}");
}
