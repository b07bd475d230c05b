//! Contacts whose force is zero: what stays, and what is let go of.

mod common;

use common::{at, close, rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Relation, Vector};
use tumble_mech::{Body, Gravity, Model, Run, Shape, Start, Surface, time};

/// A box of 1 kg on a floor, lifted by a force in units of its weight, 10 N, for 1 s.
fn lifted(force: Expr) -> (Run, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(10 * M / (S * S));
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 2 * M, height: 1 * M };
    let body = model.add(Body::of_shape("box", shape).mass(1 * KG));
    model.starts.push(("box".into(), Start::default().at([0 * M, 0.5 * M])));
    model.force("lift", &body.cm(), Vector::planar(Expr::zero(), force * 10 * N));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    (run(model, 1.0, 1e-9), body)
}

fn height(run: &Run, body: &Body) -> f64 {
    let [height] = at(run, 1.0, [body.kinematics().position().y() - 0.5 * M]);
    height
}

/// It leaves the floor at once, whatever the first power of the time by which the force falls below zero: a floor does not
/// pull.
#[test]
fn a_floor_lets_go_of_what_is_lifted_from_no_force() {
    for power in 1..=4 {
        let (run, body) = lifted(1 + (time() / S).powi(power));
        close(height(&run, &body), 10.0 / f64::from((power + 1) * (power + 2)), 1e-12);
        assert!(run.contacts().iter().all(|contact| contact.end == 0.0), "{power}: {:?}", run.contacts());
    }
}

/// The other way round it is pressed on.
#[test]
fn a_floor_holds_what_is_pressed_on_it_from_no_force() {
    for power in 1..=4 {
        let (run, body) = lifted(1 - (time() / S).powi(power));
        close(height(&run, &body), 0.0, 1e-15);
        assert!(run.contacts().iter().all(|contact| contact.is_open), "{power}: {:?}", run.contacts());
    }
}

/// The force jumps to zero and falls from there, at an instant that is also the end of a step, and at another.
#[test]
fn a_floor_lets_go_where_its_force_jumps_to_zero() {
    for half in [0.5, 0.3] {
        let before = Expr::compare(Relation::Less, time() / S, Expr::from(half));
        let force = Expr::select(before, Expr::from(0.9), 1 + (time() / S - half));
        let (run, body) = lifted(force);
        close(height(&run, &body), 10.0 * (1.0_f64 - half).powi(3) / 6.0, 1e-12);
    }
}
