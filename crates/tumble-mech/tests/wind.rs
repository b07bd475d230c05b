//! Air resistance written as forces with a kink: |u| u, whose sign changes are located and never stepped over.

use crate::common::{at, close, number, reference, run, wind_pendulum};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Relation, Vector};
use tumble_mech::PointRef;
use tumble_mech::{Body, Gravity, Model, Start};

#[test]
fn the_pendulum_in_the_wind() {
    for (name, period) in [("0.5", 0.5), ("1.0", 1.0), ("2.0", 2.0), ("4.0", 4.0)] {
        let expected = &reference("wind_pendulum_tip")["runs"][name];
        let run = run(wind_pendulum(period), 20.0, 1e-13);
        let rod = run.equations.model().bodies[0].kinematics();
        let [theta, omega] = at(&run, 20.0, [rod.angle(), rod.omega()]);
        println!(
            "T = {period}: {:e} {:e}, {:?}",
            theta - number(&expected["theta"]),
            omega - number(&expected["omega"]),
            run.trajectory().work
        );
        // A perturbation of the start grows by `conditioning`; 1e-12 is asked for beyond that.
        let tolerance = 1e-12 + 1e-15 * number(&expected["conditioning"]);
        close(theta, number(&expected["theta"]), tolerance);
        close(omega, number(&expected["omega"]), tolerance);
        assert_eq!(run.trajectory().work.flips, number(&expected["sign_changes_of_u"]) as u64);
    }
}

/// A ball in quadratic air resistance: m v' = -m g - c |v| v.
fn falling(start: Start) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let ball = model.add(Body::point("ball").mass(2 * KG));
    let point: PointRef = ball.cm();
    let v = point.velocity();
    let force = v.map(|component| -(0.3 * KG / M * v.norm() * component));
    model.force("air", &point, force);
    model.starts.push(("ball".into(), start));
    model
}

const G: f64 = 9.81;

/// Terminal speed of the ball.
fn terminal() -> f64 {
    (2.0 * G / 0.3_f64).sqrt()
}

#[test]
fn released_from_rest_in_still_air() {
    let run = run(falling(Start::default().at([0 * M, 0 * M])), 3.0, 1e-13);
    let ball = run.equations.model().bodies[0].kinematics();
    for t in [0.1, 1.0, 3.0] {
        let [y, vy] = at(&run, t, [ball.position()[1].clone(), ball.velocity()[1].clone()]);
        let v = terminal();
        close(y, -v * v / G * (G * t / v).cosh().ln(), 1e-13);
        close(vy, -v * (G * t / v).tanh(), 1e-13);
    }
}

/// Straight up and down again: the velocity passes through the zero vector.
#[test]
fn thrown_straight_up() {
    let run = run(falling(Start::default().at([0 * M, 0 * M]).velocity([0 * M / S, 10 * M / S])), 3.0, 1e-13);
    let ball = run.equations.model().bodies[0].kinematics();
    let v = terminal();
    let rise = v / G * (10.0 / v).atan();
    let top = v * v / (2.0 * G) * (1.0 + 100.0 / (v * v)).ln();
    let [y] = at(&run, rise, [ball.position()[1].clone()]);
    close(y, top, 1e-13);
    let [y, vy] = at(&run, 3.0, [ball.position()[1].clone(), ball.velocity()[1].clone()]);
    close(y, top - v * v / G * (G * (3.0 - rise) / v).cosh().ln(), 1e-13);
    close(vy, -v * (G * (3.0 - rise) / v).tanh(), 1e-13);
}

/// Past the apex with almost no horizontal speed: |v| has a sharp turn there that no coefficient shows from afar.
#[test]
fn past_a_sharp_apex() {
    let straight =
        run(falling(Start::default().at([0 * M, 0 * M]).velocity([0 * M / S, 10 * M / S])), 3.0, 1e-13);
    let ball = straight.equations.model().bodies[0].kinematics();
    let quantities = || [ball.velocity()[0].clone(), ball.position()[1].clone(), ball.velocity()[1].clone()];
    let [_, y0, vy0] = at(&straight, 3.0, quantities());
    for vx in [1e-2, 1e-6, 1e-8, 1e-10, 1e-13] {
        let sideways = Start::default().at([0 * M, 0 * M]).velocity([vx * M / S, 10 * M / S]);
        let run = run(falling(sideways), 3.0, 1e-13);
        let [v, y, vy] = at(&run, 3.0, quantities());
        println!("vx = {vx:e}: {:e} {:e} {:e} {:?}", v / vx, y - y0, vy - vy0, run.trajectory().work);
        // Sideways motion changes the vertical one by its square; horizontally it decays as any small disturbance does.
        close(y, y0, 1e-13 + vx * vx * 10.0);
        close(vy, vy0, 1e-13 + vx * vx * 10.0);
        assert!(0.0 < v && v < vx);
    }
}

/// A force that turns round with the velocity and is no sign of it stops the block, and then neither side holds: said, with the time, and
/// not chattered through.
#[test]
fn friction_by_a_choice_is_refused_where_it_sticks() {
    let mut model = Model::new();
    let block = model.add(Body::point("block").mass(1 * KG));
    let v = block.cm().velocity();
    let backwards = Expr::compare(Relation::Less, v[0].clone(), 0 * M / S);
    let force = Expr::select(backwards, 3 * N, -(3 * N));
    model.force("friction", &block.cm(), Vector::planar(force, Expr::zero()));
    let start = Start::default().at([0 * M, 0 * M]).velocity([6 * M / S, 0 * M / S]);
    let error = model.simulate(&[(&block, start)], 5 * S).expect_err("it sticks at 2 s");
    let text = error.to_string();
    assert!(text.contains("stopped at t = 2 s") && text.contains("is zero and stays there"), "{text}");
}
