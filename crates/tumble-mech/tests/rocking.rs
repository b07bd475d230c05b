//! The balance of a box that falls flat: impacts of its two corners a rounding error apart.

use crate::common::{rigid, run};
use tumble_expr::units::{KG, M, N, S};
use tumble_expr::{Expr, Relation, Vector};
use tumble_mech::{Body, Gravity, Model, RunBalance, Shape, Start, Surface, time};

/// Each event adds the impulses that it had: found anew with other rounding errors, those of a corner might be those of
/// both.
#[test]
fn impacts_a_rounding_error_apart_are_counted_as_they_were() {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let shape = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 1 * M, height: 0.5 * M };
    let body = model.add(Body::of_shape("box", shape).mass(1 * KG));
    let start = Start::default().at([0 * M, 1.25 * M]).velocity([-1 * M / S, 0 * M / S]);
    model.starts.push(("box".into(), start.angle(-Expr::pi() / 2)));
    let late = Expr::compare(Relation::Less, time() / S, Expr::from(0.5));
    let force = Expr::select(late, -10 * (4 * time() / S).sin(), Expr::from(-5)) * N;
    model.force("push", &body.cm(), Vector::planar(0 * N, force));
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    for accuracy in [1e-6, 1e-9, 1e-12] {
        let run = run(model.clone(), 2.0, accuracy);
        assert!(run.trajectory().events.len() > 20);
        let balance = RunBalance::of(&run, [0.0; 2]).expect("finite");
        assert!(balance.relative() < f64::max(1e-10, accuracy), "{accuracy}: {:e}", balance.relative());
    }
}
