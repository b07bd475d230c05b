//! Friction of several points of a body that stick together, told point by point: each is within its cone, and the sum is what moves the body.

use crate::common::{close, rigid, run};
use tumble_expr::units::{KG, M, S};
use tumble_expr::{Expr, Vector};
use tumble_mech::{
    Body, ContributionKind, Force, Forces, Friction, Gravity, Law, Model, Run, RunBalance, Shape, Source,
    Start, Surface,
};
use tumble_ode::Side;

const G: f64 = 9.81;
const MASS: f64 = 2.3;
const MU: f64 = 0.45;

fn block(width: f64, height: f64) -> Body {
    let centre = Vector::planar(0 * M, 0 * M);
    Body::of_shape("block", Shape::Box { centre, width: width * M, height: height * M }).mass(MASS * KG)
}

fn on_slope(slope: f64, body: Body, start: Start) -> Model {
    let mut model = Model::new();
    model.gravity = Gravity::Vertical(G * M / (S * S));
    model.starts.push((body.name.clone(), start));
    model.add(body);
    let normal = [Expr::from(-slope.sin()), Expr::from(slope.cos())];
    let floor = Surface::new("floor", [0 * M, 0 * M], normal, rigid(0.0));
    model.surface(floor.with_friction(Friction::new(Expr::from(MU))));
    model
}

fn forces(run: &Run, law: Law) -> Vec<Force> {
    let all = Forces::of(run).at(0.5, Side::After).expect("numbers");
    all.into_iter().filter(|force| force.law == law).collect()
}

fn size(force: &Force) -> f64 {
    force.force[0].hypot(force.force[1])
}

/// Both corners press, the lower one more; one alone would need more friction than it can have.
#[test]
fn a_block_that_sticks_to_a_slope() {
    let (slope, [width, height]) = (0.37_f64, [0.5, 0.31]);
    let at = [-height / 2.0 * slope.sin() * M, height / 2.0 * slope.cos() * M];
    let start = Start::default().at(at).angle(Expr::from(slope));
    let run = run(on_slope(slope, block(width, height), start), 1.0, 1e-12);
    let (normals, frictions) = (forces(&run, Law::Contact), forces(&run, Law::Friction));
    assert_eq!((normals.len(), frictions.len()), (2, 2));
    let along = MASS * G * slope.sin();
    assert!(along > MU * size(&normals[0]).max(size(&normals[1])), "one alone could have it all");
    for friction in &frictions {
        let point = friction.load.trim_end_matches(".friction");
        let normal = normals.iter().find(|normal| normal.load == point).expect("a normal force");
        close(size(friction) / size(normal), slope.tan(), 1e-12);
        close(friction.arm[0], normal.arm[0], 1e-14);
    }
    close(frictions.iter().map(size).sum(), along, 1e-12);
    close(frictions.iter().map(|force| force.force[0]).sum(), along * slope.cos(), 1e-12);
    // All torques about the centre of mass together.
    close(normals.iter().chain(&frictions).map(Force::torque).sum(), 0.0, 1e-12);
    // The balance shares it in the same way.
    let balance = RunBalance::of(&run, [0.0; 2]).expect("a balance");
    for friction in &frictions {
        let mut impulses = balance.contributions.iter().filter(|part| part.load == friction.load);
        let total = impulses.next().expect("a contribution");
        assert!(impulses.next().is_none() && total.kind == ContributionKind::Work);
        close(total.impulse[0], friction.force[0], 1e-11);
        close(total.impulse[1], friction.force[1], 1e-11);
    }
}

/// Only the corner that strikes presses: the other, which leaves, has no friction.
#[test]
fn a_block_that_rocks() {
    let ([b, h], tilt) = ([0.1_f64, 0.4_f64], 0.12_f64);
    let at = [-b + b * tilt.cos() - h * tilt.sin(), b * tilt.sin() + h * tilt.cos()];
    let start = Start::default().at(at.map(|at| at * M)).angle(Expr::from(tilt));
    let mut model = on_slope(0.0, block(2.0 * b, 2.0 * h), start);
    model.surfaces[0].friction = Some(Friction::new(Expr::from(0.9)));
    let run = run(model, 0.6, 1e-12);
    let impact = run.events().find(|event| !event.record.impulses.is_empty()).expect("an impact");
    let of = |is_own: fn(&Source) -> Option<usize>| -> Vec<usize> {
        impact.record.impulses.iter().filter_map(|impulse| is_own(&impulse.source)).collect()
    };
    let pressed = of(|source| if let Source::Pair(pair) = source { Some(*pair) } else { None });
    let rubbed = of(|source| if let Source::Friction(pair) = source { Some(*pair) } else { None });
    assert_eq!(pressed.len(), 1);
    assert_eq!(rubbed, pressed);
}
