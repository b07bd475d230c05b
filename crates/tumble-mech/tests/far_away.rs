//! Collisions far from the origin: places have fewer digits there, and with them normals. Errors that are stated have to know; momentum and energy
//! do not suffer.

use std::ops::ControlFlow;

use crate::common::{at, disk, model, rod, start};
use tumble_expr::Expr;
use tumble_mech::{At, BodyContact, Friction, Model, Run};
use tumble_ode::{Accuracy, Side};

/// Two bodies that meet obliquely, at a place; all numbers have few binary digits, so that nothing but the place differs from that at the origin.
fn meeting(far: f64, is_round: bool, e: f64, mu: f64) -> Model {
    let second = if is_round { disk("b", 0.125, 2.0) } else { rod("b", 0.5, 0.0625, 2.0) };
    let first = (disk("a", 0.125, 1.0), start([far, far], 0.0, [1.0, 0.25], 2.0));
    let mut model =
        model(0.0, vec![first, (second, start([far + 0.75, far + 0.125], 1.0, [-0.5, 0.0], -1.0))]);
    let contact = BodyContact::of_all("hit", Expr::from(e));
    model.contact(if mu > 0.0 { contact.with_friction(Friction::new(mu)) } else { contact });
    model
}

fn quantities(run: &Run) -> Vec<Expr> {
    let bodies = run.equations.model().bodies.iter().map(|body| body.kinematics());
    let of = bodies.map(|known| [known.velocity().x().clone(), known.velocity().y().clone(), known.omega()]);
    of.flatten().collect()
}

fn energy_and_momentum(run: &Run, time: f64) -> [f64; 3] {
    let bodies = &run.equations.model().bodies;
    let energy = bodies.iter().map(|body| body.kinetic_energy()).reduce(|a, b| a + b).expect("bodies");
    let masses = [1.0, 2.0].map(|m| m * tumble_expr::units::KG);
    let momentum = |axis: usize| {
        let own = bodies.iter().zip(&masses).map(|(body, m)| m * body.kinematics().velocity()[axis].clone());
        own.reduce(|a, b| a + b).expect("bodies")
    };
    at(run, time, [energy, momentum(0), momentum(1)])
}

/// What rounding makes of numbers of size one.
const ROUNDING: f64 = 1e-15;

/// Velocities after an impact, and how far they are from those at the origin, in parts of the error stated.
fn off(model: &Model, known: &[f64]) -> (Run, f64) {
    let go = |_| ControlFlow::Continue(());
    let (run, trust) = Run::trusted(model, &model.parameters, 1.0, Accuracy::DEFAULT, go).expect("a motion");
    let instant = At { time: 1.0, side: Side::Before, off: 0.0 };
    let part = |(formula, known): (Expr, &f64)| {
        let error = trust.error_at(&run, &formula, instant).expect("an error").expect("it has digits");
        (at(&run, 1.0, [formula])[0] - known).abs() / error.max(ROUNDING)
    };
    let worst = quantities(&run).into_iter().zip(known).map(part).fold(0.0, f64::max);
    (run, worst)
}

/// At 2^10, 2^20 and 2^30 m of two bodies of some 0.2 m; disks at 2^36 m too, where places are known to 8 micrometres. Places that rounding cannot
/// hold are carried along, so normals are known much better than that.
#[test]
fn collisions_far_away_are_those_at_the_origin_within_what_is_stated() {
    for (is_round, most) in [(true, 36), (false, 30)] {
        for (e, mu) in [(1.0, 0.0), (0.5, 0.0), (0.5, 0.25), (0.5, 2.0)] {
            let run = comes_to(&meeting(0.0, is_round, e, mu));
            let known: Vec<f64> =
                quantities(&run).into_iter().map(|formula| at(&run, 1.0, [formula])[0]).collect();
            let [before, after] = [0.0, 1.0].map(|time| energy_and_momentum(&run, time));
            for exponent in [10, 20, 30, 36].into_iter().filter(|exponent| *exponent <= most) {
                let (run, worst) = off(&meeting(f64::from(exponent).exp2(), is_round, e, mu), &known);
                assert!(worst <= 2.0, "{is_round} {e} {mu} 2^{exponent}: {worst} times the error stated");
                let found = energy_and_momentum(&run, 1.0);
                assert!((found[0] - after[0]).abs() < 1e-12 * before[0], "{found:?} {after:?}");
                let kept = (1..3).all(|axis| (found[axis] - before[axis]).abs() < 1e-15);
                assert!(kept, "2^{exponent}: {found:?} {before:?}");
            }
        }
    }
}

/// So far away that nothing can be said of the touch of a rod's side, it is refused.
#[test]
fn what_is_too_far_away_is_refused() {
    let run = meeting(36.0_f64.exp2(), false, 0.5, 0.25).simulate_to(
        &[],
        1 * tumble_expr::units::S,
        Accuracy::DEFAULT,
    );
    assert!(run.is_err());
}

fn comes_to(model: &Model) -> Run {
    let run = model.simulate_to(&[], 1 * tumble_expr::units::S, Accuracy::DEFAULT);
    run.map_err(|error| error.to_string()).expect("a motion")
}
