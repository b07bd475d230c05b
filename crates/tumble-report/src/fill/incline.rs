//! Bodies that touch one inclined plane and do not turn by it: their acceleration along it, as it is written on a board.
//!
//! With n the normal and t the direction along the plane, what stays on it has `A n = 0`, so its normal forces are `N = -F n` with the other
//! forces F; friction that slides is `f = c N`, and `m A t = F t + f`.

use tumble_expr::{Expr, Vector, is_identically_zero};
use tumble_mech::{Law, Pair};
use tumble_notation::{Left, Notation};

use super::motion::{Line, Setting};
use super::names::side;
use super::{conditions, sum};
use crate::figures::symbols;

/// The equation along the plane, and the condition across it.
pub(super) struct Incline {
    pub(super) along: Line,
    pub(super) across: Line,
}

/// `None` where a body does not slide on one inclined plane alone.
pub(super) fn of(setting: &Setting<'_>, body: usize, notation: &Notation) -> Option<Incline> {
    let Setting { study, case, mode, .. } = *setting;
    let equations = &case.run.equations;
    let pairs = conditions::on_one_plane(study, equations, mode, body)?;
    let is_tilted = pairs[0].normal.components().iter().take(2).all(|part| !is_identically_zero(part));
    let is_alone = conditions::lies(study, equations, mode, body) || pairs[0].is_round();
    let kinematics = study.model.bodies[body].kinematics();
    if !is_tilted || !is_alone || study.model.pivot_of(&study.model.bodies[body].name).is_some() {
        return None;
    }
    let normal = &pairs[0].normal;
    let tangent = Vector::planar(normal.y().clone(), -normal.x());
    let [ax, ay] = kinematics.acceleration_symbols().map(Expr::from);
    let acceleration = |way: &Vector| &ax * way.x() + &ay * way.y();
    let is_of_plane = |load: &str| pairs.iter().any(|pair| pair.name == symbols::rubbed(load));
    let terms = equations.shown_terms(mode).into_iter().filter(|term| term.body == body);
    let (own, others): (Vec<_>, Vec<_>) = terms.partition(|term| is_of_plane(&term.load));
    if others.iter().any(|term| matches!(term.law, Law::Reaction | Law::Contact | Law::Friction))
        || own.is_empty()
    {
        return None;
    }
    let force =
        |way: &Vector| sum(others.iter().map(|term| term.force.x() * way.x() + term.force.y() * way.y()));
    let friction = sliding(setting, &pairs)? * -force(normal);
    let mass = &equations.mass_properties(body).mass;
    let line = |way: &Vector, right: Expr| {
        let is = acceleration(way);
        Line { left: Left::symbol(side(notation, &is)), right, is }
    };
    let across = Line {
        left: Left::symbol(tumble_notation::Math::Number("0".to_owned())),
        right: acceleration(normal),
        is: Expr::zero(),
    };
    Some(Incline { along: line(&tangent, (force(&tangent) + friction) / mass), across })
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
