//! Flight without air: a parabola while the body turns evenly.

use crate::common::{at, close, run};
use tumble_expr::units::{KG, M, N, RAD, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Frame, Gravity, Load, Model, Place, Start};

fn thrown(gravity: Gravity) -> Model {
    let mut model = Model::new();
    model.gravity = gravity;
    // The origin is off the centre, so that the centre's path is not the origin's.
    model.bodies.push(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(0.5 * KG));
    let start = Start::default()
        .at([0 * M, 1 * M])
        .velocity([8 * M / S, 6 * M / S])
        .angle(0.5 * RAD)
        .omega(6 * RAD / S);
    model.starts.push(("rod".into(), start));
    model
}

#[test]
fn a_thrown_rod_is_exact_in_one_step() {
    let run = run(thrown(Gravity::Vertical(9.81 * M / (S * S))), 1.2, 1e-9);
    let rod = run.equations.model().bodies[0].kinematics();
    let p = rod.position();
    let v = rod.velocity();
    let quantities = [p[0].clone(), p[1].clone(), v[0].clone(), v[1].clone(), rod.angle(), rod.omega()];
    let found = at(&run, 1.2, quantities);
    for (found, expected) in found.into_iter().zip([9.6, 1.1368, 8.0, -5.772, 7.7, 6.0]) {
        close(found, expected, 1e-15);
    }
    assert_eq!((run.trajectory().work.steps, run.trajectory().work.exact_steps), (1, 1));
}

/// An end of the rod goes round the centre: its distance to it stays, and its acceleration is centripetal plus gravity.
#[test]
fn the_end_turns_about_the_centre() {
    let run = run(thrown(Gravity::Vertical(9.81 * M / (S * S))), 1.2, 1e-9);
    let body = run.equations.model().bodies[0].clone();
    let end = body.at(&Vector::planar(1 * M, 0 * M));
    for t in [0.0, 0.31, 1.2] {
        let arm = end.position() - body.kinematics().position();
        let [distance, ax, ay] =
            at(&run, t, [arm.norm(), end.acceleration()[0].clone(), end.acceleration()[1].clone()]);
        let angle: f64 = 0.5 + 6.0 * t;
        close(distance, 0.5, 1e-15);
        close(ax, -18.0 * angle.cos(), 1e-14);
        close(ay, -18.0 * angle.sin() - 9.81, 1e-14);
    }
}

#[test]
fn without_gravity_it_turns_for_ever() {
    let run = run(thrown(Gravity::None), 1e6, 1e-9);
    let rod = run.equations.model().bodies[0].kinematics();
    let [x, angle, omega] = at(&run, 1e6, [rod.position()[0].clone(), rod.angle(), rod.omega()]);
    assert_eq!([x, angle, omega], [8e6, 6e6 + 0.5, 6.0]);
}

/// A rocket fixed to the body: in body axes the force turns with it, so the velocity turns on a circle.
#[test]
fn a_force_in_body_axes_turns_with_the_body() {
    let mut model = Model::new();
    let ball = Body::ball("ball", 0.1 * M).mass(2 * KG);
    let place = Place::Material(ball.cm());
    let mut rocket = Load::force("rocket", "ball", place, Vector::planar(3 * N, 0 * N));
    if let tumble_mech::Application::Force { frame, .. } = &mut rocket.application {
        *frame = Frame::Body;
    }
    model.bodies.push(ball);
    model.loads.push(rocket);
    model.starts.push(("ball".into(), Start::default().omega(4 * RAD / S)));
    let run = run(model, 3.0, 1e-12);
    let ball = run.equations.model().bodies[0].kinematics();
    let [vx, vy] = at(&run, 3.0, [ball.velocity()[0].clone(), ball.velocity()[1].clone()]);
    // a = (3/2) (cos 4t, sin 4t)
    close(vx, 0.375 * 12.0_f64.sin(), 1e-13);
    close(vy, 0.375 * (1.0 - 12.0_f64.cos()), 1e-13);
}

/// A force at a fixed place of the world works on whatever material is there: its torque is that of the place.
#[test]
fn a_force_at_a_place_of_the_world() {
    let mut model = Model::new();
    let rod = Body::rod("rod", [-1 * M, 0 * M], [1 * M, 0 * M]).mass(3 * KG);
    let place = Place::World(Vector::planar(2 * M, 0 * M));
    model.loads.push(Load::force("push", "rod", place, Vector::planar(0 * N, 1 * N)));
    model.bodies.push(rod);
    let run = run(model, 1.0, 1e-9);
    let rod = run.equations.model().bodies[0].kinematics();
    let [alpha, omega] = at(&run, 1.0, [rod.alpha(), rod.omega()]);
    // x stays 0, so tau = 2 m * 1 N and I = 3 * 4 / 12 = 1.
    close(alpha, 2.0, 1e-15);
    close(omega, 2.0, 1e-15);
}

#[test]
fn mistakes_are_all_reported() {
    let mut model = thrown(Gravity::Vertical(9.81 * M));
    model.bodies[0].parts[0].mass = 0.5 * M;
    model.loads.push(Load::torque("twist", "stick", Expr::one()));
    let errors = tumble_mech::Equations::new(model).expect_err("three mistakes");
    let text = errors.to_string();
    for part in ["gravity: expected an acceleration", "mass of `rod`: expected a mass", "no body `stick`"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn values_that_cannot_be_are_refused() {
    let mut model = thrown(Gravity::None);
    let m = model.parameters.set("m", -1 * KG).expect("a mass");
    model.bodies[0].parts[0].mass = m;
    let equations = tumble_mech::Equations::new(model).expect("dimensions are right");
    let errors = equations.start(&equations.model().parameters).expect_err("negative");
    assert_eq!(errors.to_string(), "mass of `rod` is -1 kg: it must be positive");
}

#[test]
fn a_point_cannot_be_turned() {
    let mut model = Model::new();
    model.bodies.push(Body::point("p").mass(1 * KG));
    model.loads.push(Load::torque("twist", "p", 1 * N * M));
    let errors = tumble_mech::Equations::new(model).expect_err("no inertia");
    assert!(errors.to_string().contains("has no moment of inertia"), "{errors}");
}
