//! Whose restitution and friction count where two touch: the pair's, then a body's own, then the surface's; against closed forms.

use crate::common::{at, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector, is_identically_zero};
use tumble_mech::{
    Body, BodyContact, Equations, Friction, Gravity, Model, ModelErrors, Restitution, Shape, Start, Surface,
};

const G: f64 = 9.81;
const SPEED: f64 = 2.0;

/// A plate that slides to the right on a floor through the origin.
fn sliding(model: &mut Model, name: &str, x: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    let plate = Shape::Box { centre, width: 0.4 * M, height: 0.2 * M };
    let start = Start::default().at([x * M, 0.1 * M]).velocity([SPEED * M / S, 0 * M / S]);
    model.starts.push((name.to_owned(), start));
    Body::of_shape(name, plate).mass(2.0 * KG)
}

/// Of the floor, of the body and of the pair; how far it comes until it stands is `v^2/(2 mu g)`.
fn comes(floor: Option<f64>, body: Option<f64>, pair: Option<f64>) -> f64 {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    let plate = sliding(&mut model, "plate", 0.0);
    model.add(Body { friction: body.map(Friction::new), ..plate });
    let friction = floor.map(Friction::new);
    model.surface(Surface { friction, ..Surface::floor("floor", 0 * M, rigid(0.0)) });
    if let Some(pair) = pair {
        let contact = BodyContact::new("pads", ["floor", "plate"], 0.0);
        model.contact(contact.with_friction(Friction::new(pair)));
    }
    let run = run(model, 4.0, 1e-13);
    at(&run, 4.0, [run.equations.model().bodies[0].kinematics().position().x().clone()])[0]
}

#[test]
fn the_pair_comes_before_the_body_and_the_body_before_the_surface() {
    let until = |mu: f64| SPEED * SPEED / (2.0 * mu * G);
    for (floor, body, pair, mu) in [
        (Some(0.2), None, None, 0.2),
        (Some(0.2), Some(0.5), None, 0.5),
        (None, Some(0.5), None, 0.5),
        (Some(0.2), Some(0.5), Some(0.3), 0.3),
        (None, None, Some(0.3), 0.3),
    ] {
        let far = comes(floor, body, pair);
        assert!((far - until(mu)).abs() < 1e-12, "{far} {}", until(mu));
    }
    // What is said to be smooth is.
    assert_eq!(comes(Some(0.2), Some(0.5), Some(0.0)), 4.0 * SPEED);
}

/// A ball of its own restitution falls on a floor, and on another ball.
#[test]
fn restitution_is_found_in_the_same_order() {
    for (own, pair, e) in [(None, None, 0.3), (Some(0.6), None, 0.6), (Some(0.6), Some(0.9), 0.9)] {
        let mut model = Model::new();
        let ball = Body::ball("ball", 0.1 * M).mass(1 * KG);
        model.add(Body { restitution: own.map(Expr::from), ..ball });
        let start = Start::default().at([0 * M, 0.5 * M]).velocity([0 * M / S, -1 * M / S]);
        model.starts.push(("ball".into(), start));
        model.surface(Surface::floor("floor", 0 * M, rigid(0.3)));
        if let Some(pair) = pair {
            model.contact(BodyContact::new("hard", ["floor", "ball"], pair));
        }
        let run = run(model, 1.0, 1e-13);
        let v = at(&run, 1.0, [run.equations.model().bodies[0].kinematics().velocity().y().clone()])[0];
        assert!((v - e).abs() < 1e-14, "{v} {e}");
    }
}

/// Two disks side by side, of which one slides past the other: they change speeds by the friction of an impact, the lesser of their own.
#[test]
fn of_two_bodies_the_lesser_counts() {
    let along = |own: [Option<f64>; 2], pair: Option<f64>| {
        let mut model = Model::new();
        for (name, friction, x, v) in [("a", own[0], 0.0, [0.0, 0.0]), ("b", own[1], 0.3, [-1.0, 2.0])] {
            let shape = Shape::Disk { centre: Vector::planar(0 * M, 0 * M), radius: 0.1 * M };
            let disk = Body::of_shape(name, shape).mass(1 * KG);
            model.add(Body { friction: friction.map(Friction::new), ..disk });
            let [vx, vy] = v.map(|v| v * M / S);
            model
                .starts
                .push((name.into(), Start::default().at([x * M, -0.2 * x / 0.3 * M]).velocity([vx, vy])));
        }
        let contact = BodyContact::new("hits", ["a", "b"], 0.5);
        model.contact(BodyContact { friction: pair.map(Friction::new), ..contact });
        let run = run(model, 0.3, 1e-13);
        at(&run, 0.3, [run.equations.model().bodies[0].kinematics().velocity().y().clone()])[0]
    };
    // They meet where the line of centres is level: the second has risen by 0.2 m. The impulse along it is (1 + e) m v/2; the slip of
    // 2 m/s does not stop.
    for (own, pair, mu) in [
        ([Some(0.1), Some(0.2)], None, 0.1),
        ([Some(0.3), None], None, 0.3),
        ([Some(0.1), Some(0.2)], Some(0.25), 0.25),
        ([None, None], None, 0.0),
    ] {
        let v = along(own, pair);
        assert!((v - mu * 0.75).abs() < 1e-12, "{v} {mu}");
    }
}

/// What a restitution is the ratio of is looked for in the same order, whoever says how rough it is.
#[test]
fn the_law_of_impacts_comes_from_whoever_says_it() {
    let mut model = Model::new();
    let plate = sliding(&mut model, "plate", 0.0);
    model.add(Body { friction: Some(Friction::new(0.5)), ..plate });
    let stronge = Friction::new(0.2).restitution(Restitution::Stronge);
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)).with_friction(stronge));
    let friction = model.pairs().remove(0).friction.expect("it is rough");
    assert_eq!(friction.restitution, Some(Restitution::Stronge));
    assert!(is_identically_zero(&(friction.kinetic - 0.5)));
}

fn mistakes(change: impl FnOnce(&mut Model)) -> String {
    let mut model = Model::new();
    let plate = sliding(&mut model, "plate", 0.0);
    model.add(plate);
    model.surface(Surface::floor("floor", 0 * M, rigid(0.5)));
    model.surface(Surface { on: Some(vec![]), ..Surface::floor("cellar", -1 * M, rigid(0.5)) });
    change(&mut model);
    Equations::new(model)
        .map(drop)
        .map_err(|mistakes: ModelErrors| mistakes.to_string())
        .expect_err("a mistake")
}

#[test]
fn what_cannot_be_said_is_refused() {
    let pads = |between: &[&str]| {
        let between = Some(between.iter().map(|name| (*name).to_owned()).collect());
        BodyContact { between, ..BodyContact::of_all("pads", 0.5) }
    };
    let said = mistakes(|model| {
        model.contacts =
            vec![pads(&["floor", "plate"]), BodyContact { name: "other".into(), ..pads(&["plate", "floor"]) }]
    });
    assert!(
        said.contains("`other` is a second rule for `floor` and `plate`, of which `pads` is the first"),
        "{said}"
    );
    let said = mistakes(|model| model.contacts = vec![pads(&["floor", "cellar"])]);
    assert!(said.contains("two surfaces"), "{said}");
    let said = mistakes(|model| model.contacts = vec![pads(&["cellar", "plate"])]);
    assert!(said.contains("do not meet"), "{said}");
    let said = mistakes(|model| {
        let law = tumble_mech::ContactLaw::Hertz { stiffness: Expr::from(1.0), damping: Expr::from(0.0) };
        model.surfaces[0].law = law;
        model.contacts = vec![pads(&["floor", "plate"])];
    });
    assert!(said.contains("`pads` has a restitution and is of `floor`, which is compliant"), "{said}");
}
