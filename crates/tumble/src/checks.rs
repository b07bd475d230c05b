//! The scene's claims, held against the motion.

use tumble_expr::Expr;
use tumble_ode::Side;
use tumble_scene::{Check, Study, When};

use crate::case::Case;
use crate::digits;
use crate::moments::Moments;
use crate::pipeline::PipelineError;
use crate::works;

/// A claim with what was found.
#[derive(Clone, Debug)]
pub struct CheckResult {
    /// Its name in the scene.
    pub name: String,
    /// What was looked at, as the user wrote it.
    pub that: String,
    /// SI unit of what was looked at; empty where it has none.
    pub unit: String,
    /// When, s; not a number where it is an event that did not happen.
    pub at: f64,
    /// What was found, SI units; not a number where the motion does not reach that time.
    pub found: f64,
    /// What was claimed, SI units.
    pub expected: f64,
    /// Largest difference allowed, SI units.
    pub within: f64,
    /// Error stated of what was found less what was claimed, SI units; `None` where nothing is known of it.
    pub error: Option<f64>,
    /// Whether the claim holds.
    pub holds: bool,
}

impl CheckResult {
    /// Whether the motion is known well enough to say that the claim holds.
    pub fn is_sure(&self) -> bool {
        self.error.is_some_and(|error| error <= self.within)
    }
}

/// Holds every claim against a motion.
pub(crate) fn evaluate(study: &Study, case: &Case) -> Result<Vec<CheckResult>, PipelineError> {
    study.checks.iter().map(|check| one(study, case, check)).collect()
}

fn one(study: &Study, case: &Case, check: &Check) -> Result<CheckResult, PipelineError> {
    let within = study.number(&check.within)?;
    let moments = Moments::of(study, &case.run);
    let formulas = [moments.known(&check.that.quantity.formula), moments.known(&check.equals)];
    let at = match &formulas[0] {
        Some(that) => instant(case, &moments, check, that)?,
        None => None,
    };
    let found = match (at, formulas) {
        (Some(at), [Some(that), Some(equals)]) => values(case, [that, equals], at)?,
        _ => None,
    };
    let Found { found, expected, error } = found.unwrap_or(Found::NOTHING);
    let at = at.map_or(f64::NAN, |(time, _)| time);
    let holds = (found - expected).abs() <= within;
    let (name, that, unit) = (check.name.clone(), check.that.text.clone(), check.that.quantity.unit.clone());
    Ok(CheckResult { name, that, unit, at, found, expected, within, error, holds })
}

/// What a check sees, SI units.
struct Found {
    found: f64,
    expected: f64,
    error: Option<f64>,
}

impl Found {
    const NOTHING: Self = Self { found: f64::NAN, expected: f64::NAN, error: None };
}

/// When a check looks, and on which side of an event; `None` where that does not come in this motion.
fn instant(
    case: &Case,
    moments: &Moments<'_>,
    check: &Check,
    that: &Expr,
) -> Result<Option<(f64, Side)>, PipelineError> {
    let after = |time: Option<f64>| time.map(|time| (time, Side::After));
    Ok(match &check.at {
        // A motion that an event has stopped ends there; one that was refused has no end to look at.
        When::End => after(case.run.trajectory.end().filter(|_| case.refusal.is_none())),
        When::At(instant) => after(moments.time(instant)?),
        When::Extreme { which, during } => {
            // What is greatest in a motion that was refused, nobody knows.
            let window = moments.window(during.as_ref())?;
            let Some(window) = window.filter(|_| case.refusal.is_none()) else { return Ok(None) };
            case.run.extreme(that, *which, window)?.map(|peak| (peak.time, peak.side))
        }
    })
}

/// What was found and what was claimed at an instant, and the error stated of their difference.
fn values(
    case: &Case,
    [that, equals]: [Expr; 2],
    (time, side): (f64, Side),
) -> Result<Option<Found>, PipelineError> {
    let claims =
        [works::known(case, that.clone(), (time, side))?, works::known(case, equals.clone(), (time, side))?];
    let [Some(that), Some(equals)] = claims else { return Ok(None) };
    let off = |formula: &Expr| formula - &equals.formula;
    let difference = off(&that.formula);
    let others =
        that.variants.iter().map(off).chain(equals.variants.iter().map(|other| &that.formula - other));
    let formulas: Vec<Expr> =
        [&that.formula, &equals.formula, &difference].into_iter().cloned().chain(others).collect();
    let Some(values) = case.run.observe(&formulas)?.at(time, side) else { return Ok(None) };
    let of_works: f64 = values[3..].iter().map(|other| (other - values[2]).abs()).sum();
    let error = digits::error(case, &difference, time)?.filter(|_| that.is_sure && equals.is_sure);
    Ok(Some(Found { found: values[0], expected: values[1], error: error.map(|error| error + of_works) }))
}
