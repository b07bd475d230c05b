//! The scene's claims, held against the motion.

use tumble_ode::Side;
use tumble_scene::{Check, Study};

use crate::case::Case;
use crate::digits;
use crate::moments::Moments;
use crate::pipeline::PipelineError;

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
    let (run, complete) = (&case.run, case.refusal.is_none());
    let within = study.number(&check.within)?;
    let moments = Moments::of(study, run);
    let formulas = [moments.known(&check.that.quantity.formula), moments.known(&check.equals)];
    let at = match &check.at {
        // A motion that an event has stopped ends there; one that was refused has no end to look at.
        None => run.trajectory.end().filter(|_| complete),
        Some(instant) => moments.time(instant)?,
    };
    let (values, error) = match (at, formulas) {
        (Some(at), [Some(found), Some(expected)]) => {
            let error = digits::error(case, &(&found - &expected), at)?;
            (run.observe(&[found, expected])?.at(at, Side::After), error)
        }
        _ => (None, None),
    };
    let (found, expected) = values.map_or((f64::NAN, f64::NAN), |values| (values[0], values[1]));
    let holds = (found - expected).abs() <= within;
    let (name, that, unit) = (check.name.clone(), check.that.text.clone(), check.that.quantity.unit.clone());
    Ok(CheckResult { name, that, unit, at: at.unwrap_or(f64::NAN), found, expected, within, error, holds })
}
