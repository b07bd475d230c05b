//! Bodies on pivots: what turns them, and what their centres do.

use tumble_expr::{Expr, Substitution, Vector};
use tumble_mech::{Anchor, Pivot, Term, rotated};
use tumble_scene::Study;

use super::sum;
use crate::results::Case;

/// Torque of terms on a body about its pivot, less `M r x A_P` where that is moved.
pub(super) fn torque(case: &Case, (body, pivot): (usize, &Pivot), terms: &[Term]) -> Expr {
    let equations = &case.run.equations;
    let kinematics = equations.model().bodies[body].kinematics();
    let mass = equations.mass_properties(body);
    let arm = rotated(&(&mass.centre - &pivot.point), &kinematics.angle());
    let own = terms.iter().filter(|term| term.load != pivot.name);
    let torque = sum(own.map(|term| term.torque_about(&(&arm + &term.arm))));
    torque - &mass.mass * arm.cross_planar(&acceleration(pivot))
}

/// Of the point that a pivot holds.
fn acceleration(pivot: &Pivot) -> Vector {
    let rate = |path: Vector| Anchor::World(path).velocity();
    rate(rate(pivot.world.clone()))
}

/// Accelerations of the centres of bodies on pivots, by how the bodies turn.
pub(super) fn accelerations(study: &Study, case: &Case) -> Substitution {
    let mut all = Substitution::default();
    for (index, body) in study.model.bodies.iter().enumerate() {
        let Some(pivot) = study.model.pivot_of(&body.name) else { continue };
        let kinematics = body.kinematics();
        let centre = &case.run.equations.mass_properties(index).centre;
        let arm = rotated(&(centre - &pivot.point), &kinematics.angle());
        let omega = kinematics.omega();
        let turning = kinematics.alpha() * arm.perpendicular() - (&omega * &omega) * &arm;
        let centre = acceleration(pivot) + turning;
        for (symbol, component) in kinematics.acceleration_symbols().into_iter().zip(centre.components()) {
            all.insert(symbol, component.clone());
        }
    }
    all
}

/// Moment of inertia of a body about its pivot.
pub(super) fn inertia(case: &Case, body: usize, pivot: &Pivot) -> Expr {
    let mass = case.run.equations.mass_properties(body);
    let away = &mass.centre - &pivot.point;
    &mass.inertia + &mass.mass * sum(away.components().iter().map(|part| part * part))
}
