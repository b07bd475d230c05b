//! A ball kicked off-centre by a constant force for a short time: constant accelerations, then free motion.

use crate::common::{at, close, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{Body, Gravity, Load, Model, Place};

/// M = 0.43 kg, R = 0.11 m, F = (200, 0) N for 10 ms where the surface is y = 0.05 m from the centre, on the left.
/// `place` says whether that offset turns with the ball.
fn kicked(place: fn(&Body, Vector) -> Place) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Horizontal(9.81 * M / (S * S));
    let ball = Body::shell("ball", 0.11 * M).mass(0.43 * KG);
    let offset = Vector::planar(-(0.11 * M * (0.11 * M) - 0.05 * M * (0.05 * M)).sqrt(), 0.05 * M);
    let force = Vector::planar(200 * N, Expr::zero());
    let kick = Load::force("kick", "ball", place(&ball, offset), force).during(Expr::zero(), 0.01 * S);
    model.bodies.push(ball);
    model.loads.push(kick);
    model
}

#[test]
fn a_fixed_offset_gives_the_formulas() {
    let run = run(kicked(|_, offset| Place::FromCentre(offset)), 1.0, 1e-9);
    let ball = run.equations.model().bodies[0].kinematics();
    let quantities = || [ball.position()[0].clone(), ball.velocity()[0].clone(), ball.angle(), ball.omega()];
    let (force, mass, y, dt) = (200.0, 0.43, 0.05, 0.01);
    let inertia = 2.0 / 3.0 * mass * 0.11 * 0.11;
    // During the kick X = F t^2 / (2 M), theta = -y F t^2 / (2 I).
    for t in [0.0, 0.003, 0.009] {
        let [x, v, theta, omega] = at(&run, t, quantities());
        close(x, force * t * t / (2.0 * mass), 1e-15);
        close(v, force * t / mass, 1e-15);
        close(theta, -y * force * t * t / (2.0 * inertia), 1e-15);
        close(omega, -y * force * t / inertia, 1e-15);
    }
    // Then V = F dt / M and omega = -y F dt / I stay.
    let [x, v, theta, omega] = at(&run, 1.0, quantities());
    close(v, 4.651162790697675, 1e-15);
    close(omega, -28.829521429944272, 1e-15);
    close(x, 4.627906976744186, 1e-15);
    close(theta, -28.685373822794553, 1e-15);
    close(x, force * dt * dt / (2.0 * mass) + v * (1.0 - dt), 1e-15);
    assert_eq!((run.trajectory().work.steps, run.trajectory().work.exact_steps), (2, 2));
    assert_eq!(run.equations.names_of(&run.trajectory().events[0].record), ["kick.end"]);
}

#[test]
fn a_point_that_turns_with_the_ball_gives_another_rate() {
    let run = run(kicked(|ball, offset| Place::Material(ball.at(&offset))), 1.0, 1e-12);
    let ball = run.equations.model().bodies[0].kinematics();
    let [v, omega] = at(&run, 1.0, [ball.velocity()[0].clone(), ball.omega()]);
    close(v, 4.651162790697675, 1e-14);
    // The point climbs as the ball turns, and its arm with it.
    assert_eq!(format!("{omega:.2}"), "-31.55");
}
