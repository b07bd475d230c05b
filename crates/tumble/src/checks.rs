//! The scene's claims, held against the motion.

use tumble_mech::Run;
use tumble_ode::Side;
use tumble_scene::{Check, Study};

use crate::moments::Moments;
use crate::pipeline::PipelineError;

/// A claim with what was found.
#[derive(Clone, Debug)]
pub struct CheckResult {
    /// Its name in the scene.
    pub name: String,
    /// What was looked at, as the user wrote it.
    pub that: String,
    /// When, s; not a number where it is an event that did not happen.
    pub at: f64,
    /// What was found, SI units; not a number where the motion does not reach that time.
    pub found: f64,
    /// What was claimed, SI units.
    pub expected: f64,
    /// Largest difference allowed, SI units.
    pub within: f64,
    /// Whether the claim holds.
    pub holds: bool,
}

/// Holds every claim against a motion; `complete` says whether it was found to its end.
pub(crate) fn evaluate(study: &Study, run: &Run, complete: bool) -> Result<Vec<CheckResult>, PipelineError> {
    study.checks.iter().map(|check| one(study, run, complete, check)).collect()
}

fn one(study: &Study, run: &Run, complete: bool, check: &Check) -> Result<CheckResult, PipelineError> {
    let within = study.number(&check.within)?;
    let moments = Moments::of(study, run);
    let formulas = [moments.known(&check.that.quantity.formula), moments.known(&check.equals)];
    let at = match &check.at {
        // A motion that an event has stopped ends there; one that was refused has no end to look at.
        None => run.trajectory.end().filter(|_| complete),
        Some(instant) => moments.time(instant)?,
    };
    let values = match (at, formulas) {
        (Some(at), [Some(found), Some(expected)]) => run.observe(&[found, expected])?.at(at, Side::After),
        _ => None,
    };
    let (found, expected) = values.map_or((f64::NAN, f64::NAN), |values| (values[0], values[1]));
    let holds = (found - expected).abs() <= within;
    let (name, that) = (check.name.clone(), check.that.text.clone());
    Ok(CheckResult { name, that, at: at.unwrap_or(f64::NAN), found, expected, within, holds })
}
