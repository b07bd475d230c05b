//! Long chains: linear systems of hundreds of unknowns.

use crate::common::chain::{G, chain, named};
use tumble_expr::Expr;
use tumble_expr::units::S;
use tumble_mech::{Anchor, Run};
use tumble_ode::{Accuracy, Side};

fn values(run: &Run, time: f64, formulas: &[Expr]) -> Vec<f64> {
    run.observe(formulas).expect("formulas").at(time, Side::Before).expect("within")
}

/// At rest each joint bears what hangs from it, and nothing moves.
#[test]
fn a_hundred_links_hang_at_rest() {
    const LINKS: usize = 100;
    let (model, bodies) = chain([0.0; LINKS], |_| 1);
    let forces: Vec<Expr> =
        model.joints.iter().map(|joint| Expr::from(joint.multipliers()[1].clone())).collect();
    let run = model.simulate(&[], 1 * S).unwrap_or_else(|error| panic!("{error}"));
    for (index, force) in values(&run, 1.0, &forces).into_iter().enumerate() {
        let weight = (LINKS - index) as f64 * G;
        assert!((force.abs() - weight).abs() < 1e-12 * LINKS as f64 * G, "{index}: {force} {weight}");
    }
    let end = run.at(1.0).expect("within");
    for (index, body) in bodies.iter().enumerate() {
        let [x, y] = end.position(&body.cm()).expect("finite");
        assert!(x.abs() < 1e-13 && (y + index as f64 + 0.5).abs() < 1e-11, "{index}: {x} {y}");
    }
}

/// Let go from all angles: the energy stays, to what the comparison with another run says, and the joints stay closed.
#[test]
fn sixty_links_keep_their_energy_and_their_joints() {
    let (model, bodies) = chain((0..60).map(|index| 2.0 * f64::from(index).sin()), |_| 1);
    let energy = bodies.iter().map(|body| body.kinetic_energy() + body.potential_energy(&model.gravity));
    let energy = energy.reduce(|sum, own| sum + own).expect("bodies");
    let apart = bodies.windows(2).flat_map(|pair| {
        let [tip, top] = [named(&pair[0], "tip"), named(&pair[1], "top")].map(|end| match end {
            Anchor::Material(point) => point.position(),
            Anchor::World(place) => place,
        });
        (tip - top).components().to_vec()
    });
    let formulas: Vec<Expr> = std::iter::once(energy).chain(apart).collect();
    let run = model
        .simulate_to(&[], 0.3 * S, Accuracy::new(1e-12).expect("positive"))
        .unwrap_or_else(|error| panic!("{error}"));
    let [start, end] = [0.0, 0.3].map(|time| {
        run.observe(&formulas)
            .expect("formulas")
            .at(time, if time > 0.0 { Side::Before } else { Side::After })
    });
    let (start, end) = (start.expect("within"), end.expect("within"));
    assert!((end[0] - start[0]).abs() < 1e-12 * start[0].abs(), "{} {}", start[0], end[0]);
    let gap = end[1..].iter().fold(0.0, |gap: f64, apart| gap.max(apart.abs()));
    assert!(gap < 1e-13 * 60.0, "{gap:e}");
}
