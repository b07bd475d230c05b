//! Studies of models made in Rust: what they hold, and every mistake told at once.

use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, Gravity, Model};
use tumble_scene::{Instant, Plan, When};

fn model() -> (Model, Body) {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(9.81 * M / (S * S));
    let ball = model.add(Body::ball("ball", 0.1 * M).mass(1 * KG));
    (model, ball)
}

#[test]
fn a_plan_becomes_a_study() {
    let (model, ball) = model();
    let height = ball.kinematics().position().y().clone();
    let study = Plan::of("A stone", model, 2 * S)
        .plot("fall", [("height", height.clone())])
        .find("end", height, When::End)
        .study()
        .map_err(|mistakes| mistakes.to_string())
        .expect("no mistakes");
    assert_eq!((study.title.as_str(), study.plots.len(), study.finds.len()), ("A stone", 1, 1));
    assert_eq!(study.plots[0].y[0].quantity.unit, "m");
    assert!(study.quantities.contains_key("ball.vx"));
}

#[test]
fn all_mistakes_of_a_plan_are_told_at_once() {
    let (model, ball) = model();
    let motion = ball.kinematics();
    let height = motion.position().y().clone();
    let mistakes = Plan::of("A stone", model, -1 * S)
        .plot("../fall", [("height", height.clone()), ("angle", motion.angle())])
        .plot("twice", [("height", height.clone())])
        .plot("Twice", [("height", height.clone())])
        .free_body("forces", &Body::point("moon"), [Instant::event("apex")])
        .find("odd", &height + 1 * S, When::At(Instant::contact_start("floor", 1)))
        .check("bad", height, When::At(Instant::of("soon", 1 * M)), Expr::zero(), 1 * KG)
        .study()
        .expect_err("mistakes");
    let codes: Vec<&str> = mistakes.list.iter().map(|mistake| mistake.code.as_str()).collect();
    for code in ["E0556", "E0527", "E0523", "E0520", "E0547", "E0530"] {
        assert!(codes.contains(&code), "{code}: {codes:?}");
    }
    assert!(
        mistakes.render(false, 80).contains("there is no event or contact for `floor.contact[1].start`"),
        "{mistakes}"
    );
}
