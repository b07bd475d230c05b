//! Bodies that turn: full turns, periods, small swings.

use std::f64::consts::TAU;

use tumble_expr::{Dimension, Expr, Node, Symbol, Unary, is_identically_zero};
use tumble_mech::{Extreme, Gravity};
use tumble_ode::Side;

use super::said::{Said, with_digits};
use super::seen::Seen;
use super::throw::FARTHEST;
use crate::fill::names::quantity_to;
use crate::fill::wind_at_origin;
use crate::report::Text;
use crate::results::CaseError;

/// Relative difference within which intervals are one period.
const REPEATS: f64 = 1e-7;
/// Relative difference within which the air is the same a period later: what rounding of the time makes of it.
const SAME_AIR: f64 = 1e-9;
/// Less than this, rad, is no swing: a body that hangs still turns by rounding.
const NO_SWING: f64 = 1e-9;
/// Digits of periods that a formula gives, and of their ratio.
const DIGITS: usize = 4;
const RATIO: usize = 3;

/// At least one full turn, and about as much as it has ever turned: what rolls to and fro is at any angle at the end.
pub(super) fn rotations(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let angle = seen.body.kinematics().angle();
    let turns = (seen.at(seen.end(), &angle)? - seen.at(0.0, &angle)?) / TAU;
    let way = if turns > 0.0 { "counter-clockwise" } else { "clockwise" };
    let error = seen.error(seen.end(), &angle)?.map(|error| error / TAU);
    let value = with_digits(turns.abs(), error, "rev");
    let said = Said::new(format!("{} turns {way} by ", seen.called()), value).trailing();
    let begins = seen.at(0.0, &angle)?;
    let farthest = seen.values(&angle)?.iter().map(|(_, at)| (at - begins).abs() / TAU).fold(0.0, f64::max);
    let matters = turns.abs() >= 1.0 && turns.abs() >= FARTHEST * farthest;
    Ok((turns != 0.0).then(|| said.where_it_matters(matters)))
}

/// How far a pivoted body swings to both sides, where it does not turn over.
pub(super) fn swings(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let angle = seen.body.kinematics().angle();
    let far = |which| -> Result<Option<(f64, Text)>, CaseError> {
        let Ok(Some(peak)) = seen.run.extreme(&angle, which, [0.0, seen.end()]) else { return Ok(None) };
        let error = seen.error(peak.time, &angle)?.map(f64::to_degrees);
        Ok(Some((peak.value, with_digits(peak.value.to_degrees(), error, "deg"))))
    };
    let (Some((low, least)), Some((high, greatest))) = (far(Extreme::Least)?, far(Extreme::Greatest)?) else {
        return Ok(None);
    };
    let said = Said::new(format!("{} swings between ", seen.called()), least.and(" and ").and(greatest));
    Ok((high - low > NO_SWING && high - low < TAU).then_some(said))
}

/// It turns back at intervals that agree to [`REPEATS`].
pub(super) fn period(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let omega = seen.body.kinematics().omega();
    let turns = seen.falls_through_zero(&omega)?;
    let intervals: Vec<f64> = turns.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let [first, rest @ ..] = &intervals[..] else { return Ok(None) };
    let repeats = !rest.is_empty() && rest.iter().all(|next| (next - first).abs() <= REPEATS * first);
    let mean = intervals.iter().sum::<f64>() / intervals.len() as f64;
    let last = seen.error_of_instant(*turns.last().unwrap_or(&0.0), &omega)?;
    // Of the first and the last turn, each may be off.
    let error = last.map(|error| 2.0 * error / intervals.len() as f64);
    let said =
        Said::new(format!("{} repeats its motion every ", seen.called()), with_digits(mean, error, "s"));
    Ok(repeats.then_some(said))
}

/// It hangs alone from a fixed pivot, with nothing but its weight, the pivot and the air on it.
pub(super) fn small_swings(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let Some(swing) = swing(seen)? else { return Ok(None) };
    let shown = |period: f64| quantity_to(period, DIGITS, "s");
    let air = if seen.laws(seen.end())?.contains("air") { ", without air," } else { "" };
    let before = format!("The period of small swings of {}{air} is ", seen.called());
    let before = Text::from(before).and(shown(swing));
    Ok(match gusts(seen)? {
        Some(gusts) => {
            let of = if gusts < swing { " of that period" } else { " times that period" };
            let times = quantity_to(gusts / swing, RATIO, "").and(of);
            Some(Said::new(before.and("; the wind repeats every "), shown(gusts).and(", ").and(times)))
        }
        None => Some(Said::new(before, "".into())),
    })
}

/// The period of small swings about the lowest position, s: 2 pi sqrt((I + m d^2)/(m g d)).
fn swing(seen: &Seen<'_>) -> Result<Option<f64>, CaseError> {
    let (model, own) = (&seen.study.model, seen.body.mass_properties());
    let (Gravity::Vertical(g), Some(pivot)) = (&model.gravity, model.pivot_of(seen.name())) else {
        return Ok(None);
    };
    let laws = seen.laws(seen.end())?;
    let time = Symbol::new("t", Dimension::TIME);
    let is_fixed = pivot.world.components().iter().all(|place| is_identically_zero(&place.derivative(&time)));
    if laws.contains("other") || !is_fixed || !model.joints.is_empty() {
        return Ok(None);
    }
    let arm = (&own.centre - &pivot.point).norm();
    let [inertia, mass, arm, g] =
        [&own.inertia, &own.mass, &arm, g].map(|formula| seen.study.number(formula));
    let (mass, arm, g) = (mass?, arm?, g?);
    let squared = (inertia? + mass * arm * arm) / (mass * g * arm);
    Ok((squared.is_finite() && squared > 0.0).then(|| TAU * squared.sqrt()))
}

/// The period of the wind at the origin, s, where it has one: that of the slowest sine or cosine of the time in it, if the wind is
/// the same a period later.
fn gusts(seen: &Seen<'_>) -> Result<Option<f64>, CaseError> {
    let wind = wind_at_origin(seen.study);
    let time = Symbol::new("t", Dimension::TIME);
    let mut rates = vec![];
    wind.components().iter().for_each(|component| angular_rates(component, &time, &mut rates));
    let mut period: Option<f64> = None;
    for rate in rates {
        // A rate that changes has no number.
        let Ok(rate) = seen.study.number(&rate) else { return Ok(None) };
        let own = TAU / rate.abs();
        period =
            Some(period.map_or(own, |longest: f64| longest.max(own))).filter(|period| period.is_finite());
    }
    let Some(period) = period.filter(|period| *period < seen.end()) else { return Ok(None) };
    Ok(repeats(seen, wind.components(), period)?.then_some(period))
}

/// The rates of all sines and cosines of the time.
fn angular_rates(formula: &Expr, time: &Symbol, found: &mut Vec<Expr>) {
    if let Node::Unary(Unary::Sin | Unary::Cos, angle) = formula.node() {
        let rate = angle.derivative(time);
        if !is_identically_zero(&rate) {
            found.push(rate);
            return;
        }
    }
    formula.children().into_iter().for_each(|part| angular_rates(part, time, found));
}

fn repeats(seen: &Seen<'_>, wind: &[Expr], period: f64) -> Result<bool, CaseError> {
    for component in wind {
        let values = seen.values(component)?;
        let mut observer = seen.run.observe(std::slice::from_ref(component))?;
        let mut later = |time: f64| observer.at(time + period, Side::After).map_or(f64::NAN, |at| at[0]);
        let most = values.iter().map(|(_, value)| value.abs()).fold(0.0, f64::max);
        for (time, value) in values.iter().take_while(|(time, _)| time + period <= seen.end()) {
            if (later(*time) - value).abs() > SAME_AIR * most {
                return Ok(false);
            }
        }
    }
    Ok(true)
}
