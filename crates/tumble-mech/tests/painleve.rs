//! Painleve's configuration where others hold the body too: refused by its name, with the coefficient from which on no force holds it up,
//! against closed forms.

mod common;

use common::{close, rigid};
use tumble_expr::Expr;
use tumble_expr::units::{KG, M, S};
use tumble_mech::{Body, Friction, Gravity, Model, Start, Surface};

const G: f64 = 9.81;

/// A rod of 1 m that leans to the right, with its foot at the origin.
fn add(model: &mut Model, tan: f64, [vx, vy, omega]: [f64; 3]) {
    let (sin, cos) = tan.atan().sin_cos();
    let start = Start::default().at([0.5 * cos * M, 0.5 * sin * M]).angle(Expr::from(tan.atan()));
    model.starts.push(("rod".into(), start.velocity([vx * M / S, vy * M / S]).omega(omega / S)));
    model.add(Body::rod("rod", [0 * M, 0 * M], [1 * M, 0 * M]).mass(1 * KG));
}

fn world() -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model
}

fn floor(model: &mut Model, mu: f64) {
    model.surface(Surface::floor("floor", 0 * M, rigid(0.0)).with_friction(Friction::new(mu)));
}

fn comes_to(model: Model) -> Result<Option<f64>, String> {
    let accuracy = tumble_ode::Accuracy::new(1e-12).expect("an accuracy");
    model.simulate_to(&[], 0.1 * S, accuracy).map(|run| run.end()).map_err(|error| error.to_string())
}

/// Refused just above this coefficient, which it names; not just below, nor the other way round.
fn check(least: f64, of: impl Fn(f64, f64) -> Model) {
    let refused = comes_to(of(least * (1.0 + 1e-5), -1.0)).expect_err("it is wedged");
    assert!(refused.contains("Painleve") && refused.contains(" rad: from "), "{refused}");
    let from = refused.split("from ").nth(1).and_then(|rest| rest.split(' ').next());
    close(from.and_then(|number| number.parse().ok()).expect("a coefficient"), least, 1e-12);
    for (mu, speed) in [(least * (1.0 - 1e-5), -1.0), (least * (1.0 + 1e-5), 1.0)] {
        assert_eq!(comes_to(of(mu, speed)), Ok(Some(0.1)), "{mu} {speed}");
    }
}

/// A rod whose top slides down a smooth wall while its foot is ahead: `2 (1 + tan^2)/(3 tan)` with the wall, and `(4 + tan^2)/(3 tan)`
/// without. From the lesser of the two on there may be no forces, or several.
#[test]
fn between_a_floor_and_a_wall() {
    for tan in [1.1_f64, 1.3, 2.0] {
        let (with, without) = (2.0 * (1.0 + tan * tan) / (3.0 * tan), (4.0 + tan * tan) / (3.0 * tan));
        check(with.min(without), |mu, speed| {
            let mut model = world();
            let (sin, cos) = tan.atan().sin_cos();
            // The foot goes along the floor and the top along the wall.
            let omega = speed / sin;
            add(&mut model, tan, [0.5 * speed, 0.5 * omega * cos, omega]);
            floor(&mut model, mu);
            model.surfaces[0].on = Some(vec!["rod.from".into()]);
            let wall = Surface::new("wall", [cos * M, 0 * M], [-1 * Expr::one(), Expr::zero()], rigid(0.0));
            model.surface(Surface { on: Some(vec!["rod.to".into()]), ..wall });
            model
        });
    }
}
