//! The scene's claims, held against the motion.

use tumble_mech::{Run, RunError};
use tumble_ode::Side;
use tumble_scene::{Check, Study};

use crate::pipeline::PipelineError;

/// A claim with what was found.
#[derive(Clone, Debug)]
pub struct CheckResult {
    /// Its name in the scene.
    pub name: String,
    /// What was looked at, as the user wrote it.
    pub that: String,
    /// When, s.
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

pub(crate) fn evaluate(study: &Study, run: &Run) -> Result<Vec<CheckResult>, PipelineError> {
    study.checks.iter().map(|check| one(study, run, check)).collect()
}

fn one(study: &Study, run: &Run, check: &Check) -> Result<CheckResult, PipelineError> {
    let at = study.number(check.at.as_ref().unwrap_or(&study.until))?;
    let within = study.number(&check.within)?;
    let formulas = [check.that.quantity.formula.clone(), check.equals.clone()];
    let values = run.observe(&formulas).map_err(RunError::from)?.at(at, Side::After);
    let (found, expected) = values.map_or((f64::NAN, f64::NAN), |values| (values[0], values[1]));
    let holds = (found - expected).abs() <= within;
    let (name, that) = (check.name.clone(), check.that.text.clone());
    Ok(CheckResult { name, that, at, found, expected, within, holds })
}
