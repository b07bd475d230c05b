//! Bodies that fly: how high, how far, what the air does to it.

use tumble_expr::Expr;
use tumble_mech::{Gravity, Law};
use tumble_ode::Side;

use super::contacts;
use super::said::{Said, with_digits};
use super::seen::Seen;
use crate::fill::names::quantity;
use crate::report::Text;
use crate::results::CaseError;

/// More of one kind are counted, not listed.
const MOST_LISTED: usize = 2;
/// Part of the weight that is left over of it and the air at terminal speed.
const BALANCED: f64 = 0.01;
/// Part of the farthest it gets that it is away at the end where that is told.
pub(super) const FARTHEST: f64 = 0.9;
/// Part of the way from which on it matters what the air did to it.
const MATTERS: f64 = 1e-3;

/// `vy` passes zero downwards; the first [`MOST_LISTED`] times.
pub(super) fn apex(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let motion = seen.body.kinematics();
    let tops = seen.falls_through_zero(motion.velocity().y())?;
    let place = |time: &f64| {
        let height = seen.known(*time, motion.position().y(), "m")?;
        // Below the origin it is no height, but a coordinate.
        let is_below = seen.at(*time, motion.position().y())? < 0.0;
        let height = if is_below { seen.symbol("y").and("\u{a0}=\u{a0}").and(height) } else { height };
        Ok((height, seen.instant(*time, motion.velocity().y())?))
    };
    let listed: Vec<(Text, Text)> =
        tops.iter().take(MOST_LISTED).map(place).collect::<Result<_, CaseError>>()?;
    let Some(((first, _), others)) = listed.split_first() else { return Ok(None) };
    let are_alike = others.iter().all(|(height, _)| height.to_plain() == first.to_plain());
    let words = match (others.is_empty(), are_alike) {
        (true, _) => "a highest point, ",
        (false, true) => "its highest point, ",
        (false, false) => "highest points, ",
    };
    let one = |(index, (height, time)): (usize, &(Text, Text))| match are_alike && index > 0 {
        true => Text::from("at ").and(time.clone()),
        false => height.clone().and(" at ").and(time.clone()),
    };
    let value = listed.iter().enumerate().map(one).reduce(|all, next| all.and(", ").and(next));
    let more = match tops.len().saturating_sub(MOST_LISTED) {
        0 => Text::default(),
        // Bounces that are not followed to their end reach infinitely many.
        _ if seen.bounces_without_end() => ", and others".into(),
        1 => ", and once more".into(),
        more => format!(", and {more} times more").into(),
    };
    let before = format!("The centre of {} reaches {words}", seen.called());
    Ok(value.map(|value| Said::new(before, value.and(more))))
}

/// It is farther from its start, to the side or along the incline that it lies on, than its own size, and about as far as it has ever been:
/// what swings is anywhere at the end.
pub(super) fn range(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let place = seen.body.kinematics().position();
    let (x, sides) = match contacts::incline(seen)? {
        Some((surface, up)) => {
            let along = place.x() * Expr::from(up[0]) + place.y() * Expr::from(up[1]);
            (along, ["up", "down"].map(|way| format!("farther {way} {surface} than")))
        }
        None => (place.x().clone(), ["right", "left"].map(|side| format!("to the {side} of where"))),
    };
    let distance = seen.at(seen.end(), &x)? - seen.at(0.0, &x)?;
    let size = seen.study.number(&(seen.body.reach() * 2))?;
    let start = seen.at(0.0, &x)?;
    let farthest = seen.values(&x)?.iter().map(|(_, at)| (at - start).abs()).fold(0.0, f64::max);
    let side = &sides[usize::from(distance < 0.0)];
    let value = with_digits(distance.abs(), seen.error(seen.end(), &x)?, "m");
    let said = Said::new(format!("{} ends {side} it began, by ", seen.called()), value).trailing();
    let is_far = distance.abs() > size.max(f64::MIN_POSITIVE) && distance.abs() >= FARTHEST * farthest;
    Ok(is_far.then_some(said))
}

/// Nothing but weight and air acts from the start to the first contact: beside it the parabola of the same throw.
pub(super) fn without_air(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let Gravity::Vertical(g) = &seen.study.model.gravity else { return Ok(None) };
    let (g, until) = (seen.study.number(g)?, seen.first_jump()?);
    let laws = seen.laws(until)?;
    if laws.len() != 2 || !laws.contains("air") || !laws.contains("weight") {
        return Ok(None);
    }
    let motion = seen.body.kinematics();
    let (place, velocity) = (motion.position(), motion.velocity());
    let off = |at: &Expr, rate: &Expr, fallen: f64| -> Result<(f64, f64), CaseError> {
        let free = seen.at(0.0, at)? + seen.at(0.0, rate)? * until - fallen;
        Ok((seen.at(until, at)? - free, free - seen.at(0.0, at)?))
    };
    let (x, wide) = off(place.x(), velocity.x(), 0.0)?;
    let (y, high) = off(place.y(), velocity.y(), 0.5 * g * until * until)?;
    let way = wide.abs().max(high.abs());
    let mut parts = vec![];
    if x.abs() > MATTERS * way {
        let side = if x * wide > 0.0 {
            " ahead"
        } else if wide != 0.0 {
            " behind"
        } else {
            " to the side"
        };
        parts.push(with_digits(x.abs(), seen.error(until, place.x())?, "m").and(side));
    }
    if y.abs() > MATTERS * way {
        let side = if y > 0.0 { " higher" } else { " lower" };
        parts.push(with_digits(y.abs(), seen.error(until, place.y())?, "m").and(side));
    }
    let said = parts.into_iter().reduce(|all, next| all.and(" and ").and(next));
    let when = Text::from(" after ").and(quantity(until, "s"));
    let before = format!("Compared with the same throw without air, the centre of {} is ", seen.called());
    Ok(said.map(|value| Said::new(before, value.and(when)).leading()))
}

/// At the end of its flight the air bears its weight.
pub(super) fn terminal_speed(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let until = seen.first_jump()?;
    let forces = seen.forces(until, Side::Before)?;
    let of = |law: Law| forces.iter().filter(move |force| force.law == law).map(|force| force.force);
    let is_flight = forces.iter().all(|force| matches!(force.law, Law::Weight | Law::Drag | Law::Lift));
    let (Some(weight), Some(_), true) = (of(Law::Weight).next(), of(Law::Drag).next(), is_flight) else {
        return Ok(None);
    };
    let sum = forces.iter().fold([0.0; 2], |sum, force| [sum[0] + force.force[0], sum[1] + force.force[1]]);
    let (left, size) = (sum[0].hypot(sum[1]), weight[0].hypot(weight[1]));
    if left.is_nan() || left > BALANCED * size {
        return Ok(None);
    }
    let speed = seen.body.kinematics().velocity().norm();
    let value = seen.known(until, &speed, "m/s")?.and(", after ").and(quantity(until, "s"));
    let part = quantity(left / size * 100.0, "");
    let before = format!("{} has come to its terminal speed, the air bears its weight: ", seen.called());
    Ok(Some(Said::new(before, value.and("; ").and(part).and(" % of the weight are left"))))
}
