//! Pins and welds between bodies: motions against references, reactions against both laws of motion of each body.

use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Anchor, Body, Gravity, Joint, Model, Start};
use tumble_ode::Accuracy;

fn g() -> Gravity {
    Gravity::Vertical(9.81 * M / (S * S))
}

fn quarter_turn() -> Expr {
    Expr::from(std::f64::consts::FRAC_PI_2)
}

/// A point mass at the end of a massless rod of 1 m that hangs from its point `top`.
fn bob(name: &str) -> Body {
    Body::point(name).mass(1 * KG).with_point("top", [0 * M, 1 * M]).with_point("bob", [0 * M, 0 * M])
}

/// Two point masses on massless rods, both horizontal at the start: public reference values of the second stage's design.
#[test]
fn a_double_pendulum_of_point_masses() {
    let mut model = Model::new();
    model.gravity = g();
    // A massless rod has no moment of inertia of its own, and its angle would be undetermined: the masses are joined as points of
    // bodies that have one, of which the second carries none of the motion.
    let upper = model.add(bob("upper"));
    let lower = model.add(bob("lower"));
    model.pivot(&upper, [0 * M, 1 * M]);
    let ends = [Anchor::Material(upper.named_point("bob").expect("given")), Anchor::Material(lower.named_point("top").expect("given"))];
    model.join(Joint::pin("elbow", ends));
    let starts = [&upper, &lower].map(|body| (body, Start::default().angle(quarter_turn())));
    let run = model.simulate_to(&starts, 10 * S, Accuracy::new(1e-13).expect("positive")).expect("a motion");
    let end = run.at(10.0).expect("within");
    let angles = [end.angle(&upper).expect("finite"), end.angle(&lower).expect("finite")];
    println!("{angles:?}");
    for (found, known) in angles.iter().zip([-0.568_474_664_015_950_2, -0.526_393_727_932_404_3]) {
        let wrapped = found - std::f64::consts::TAU * (found / std::f64::consts::TAU).round();
        assert!((wrapped - known).abs() < 1e-11, "{found} {wrapped} {known}");
    }
}
