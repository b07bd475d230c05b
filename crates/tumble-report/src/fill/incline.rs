//! Bodies that touch one inclined plane and do not turn by it: their acceleration along it, as it is written on a board.
//!
//! With n the normal and t the direction along the plane, what stays on it has `A n = 0`, so its normal forces are `N = -F n` with the other
//! forces F; friction that slides is `f = c N`, and `m A t = F t + f`.

use tumble_expr::{Expr, Vector, is_identically_zero};
use tumble_mech::{Law, Pair, Term};
use tumble_notation::Left;

use super::motion::{Line, Setting, nothing};
use super::names::side;
use super::{conditions, sum};
use crate::figures::symbols;

/// The equation along the plane, and the condition across it.
pub(super) struct Incline {
    pub(super) along: Line,
    pub(super) across: Line,
}

/// `None` where a body does not slide on one inclined plane alone.
pub(super) fn of(setting: &Setting<'_>, body: usize) -> Option<Incline> {
    let Setting { study, case, mode, names } = *setting;
    let equations = &case.run.equations;
    let pairs = conditions::on_one_plane(study, equations, mode, body)?;
    let normal = &pairs[0].normal;
    let is_tilted = !is_identically_zero(normal.x()) && !is_identically_zero(normal.y());
    let stays_level = conditions::lies(study, equations, mode, body) || pairs[0].is_round();
    if !is_tilted || !stays_level {
        return None;
    }
    let kinematics = study.model.bodies[body].kinematics();
    let [ax, ay] = kinematics.acceleration_symbols().map(Expr::from);
    let acceleration = |way: &Vector| &ax * way.x() + &ay * way.y();
    let others = others(setting, body, &pairs)?;
    let force =
        |way: &Vector| sum(others.iter().map(|term| term.force.x() * way.x() + term.force.y() * way.y()));
    let tangent = Vector::planar(normal.y().clone(), -normal.x());
    let across = acceleration(normal);
    // A plane that moves takes the body with it.
    let own = conditions::without_turning(&kinematics, equations.shown_constraints(mode, body));
    let is_said = |condition: &Expr| {
        is_identically_zero(&(condition - &across)) || is_identically_zero(&(condition + &across))
    };
    if !own.iter().any(is_said) {
        return None;
    }
    let friction = sliding(setting, &pairs)? * -force(normal);
    let (is, notation) = (acceleration(&tangent), names.of_body(body).with_mass());
    let left = Left::symbol(side(notation.notation(), &is));
    let right = (force(&tangent) + friction) / &equations.mass_properties(body).mass;
    let along = Line { left, right, is };
    Some(Incline { along, across: Line { left: nothing(), right: across, is: Expr::zero() } })
}

/// What acts beside the contacts with the plane; `None` where anything else holds or touches the body.
fn others(setting: &Setting<'_>, body: usize, pairs: &[&Pair]) -> Option<Vec<Term>> {
    let is_of_plane = |term: &Term| pairs.iter().any(|pair| pair.name == symbols::rubbed(&term.load));
    let terms = setting.case.run.equations.shown_terms(setting.mode).into_iter();
    let others: Vec<Term> = terms.filter(|term| term.body == body && !is_of_plane(term)).collect();
    let holds = |term: &Term| matches!(term.law, Law::Reaction | Law::Contact | Law::Friction);
    (!others.iter().any(holds)).then_some(others)
}

/// What friction is of the normal forces, if it slides alike at all points; none where it has none.
fn sliding(setting: &Setting<'_>, pairs: &[&Pair]) -> Option<Expr> {
    let ties = setting.case.run.equations.shown_ties(setting.mode);
    let part = |pair: &&Pair| match &pair.friction {
        None => Some(Expr::zero()),
        Some(_) => {
            let (_, force) = ties.iter().find(|(symbol, _)| *symbol == pair.friction_symbol())?;
            Some(force.derivative(&pair.force_symbol()))
        }
    };
    let parts: Vec<Expr> = pairs.iter().map(part).collect::<Option<_>>()?;
    parts.iter().all(|other| is_identically_zero(&(other - &parts[0]))).then(|| parts[0].clone())
}
