//! The scene's claims, held against the motion.

use tumble_mech::Spread;
use tumble_scene::{Check, Question, Study};

use crate::results::questions::{Answer, NOT_REACHED, answer};
use crate::results::{Case, CaseError, open};

/// A claim with what was found.
#[derive(Clone, Debug)]
pub struct CheckResult {
    /// Its name in the scene.
    pub name: String,
    /// What was looked at, as the user wrote it.
    pub that: String,
    /// Unit of the numbers below, SI where the scene asks for no other; empty where there is none.
    pub unit: String,
    /// When, s; not a number where it is an event that did not happen.
    pub at: f64,
    /// What was found; not a number where the motion does not reach that time.
    pub found: f64,
    /// What was claimed.
    pub expected: f64,
    /// Largest difference allowed.
    pub within: f64,
    /// Error stated of what was found less what was claimed; `None` where nothing is known of it.
    pub error: Option<f64>,
    /// Where what was found is not unique, what it may be: no claim holds then.
    pub spread: Option<Spread>,
    /// Whether the claim holds.
    pub holds: bool,
}

impl CheckResult {
    /// Whether there is anything to hold the claim against: the motion reaches its time, and its event happens.
    pub fn is_reached(&self) -> bool {
        self.at.is_finite()
    }

    /// What becomes of the claim, in a word or two.
    pub fn status(&self) -> &'static str {
        match self.holds {
            true => "holds",
            false if self.is_reached() => "fails",
            false => NOT_REACHED,
        }
    }

    /// What is said instead of what was found, where it is not unique or there is none.
    pub fn open(&self) -> Option<String> {
        open::instead_of(self.found, self.spread.as_ref(), &self.unit)
    }

    /// Whether the motion is known well enough to say that the claim holds.
    pub fn is_sure(&self) -> bool {
        self.error.is_some_and(|error| error <= self.within)
    }
}

/// Holds every claim against a motion.
pub(crate) fn evaluate(study: &Study, case: &Case) -> Result<Vec<CheckResult>, CaseError> {
    let answered = |check: &Check| {
        one(study, case, check).map_err(|error: CaseError| error.of_question(study, &check.question))
    };
    study.checks.iter().map(answered).collect()
}

fn one(study: &Study, case: &Case, check: &Check) -> Result<CheckResult, CaseError> {
    let within = study.number(&check.within)?;
    let Question { name, that, .. } = &check.question;
    let Answer { at, found, expected, error, spread } =
        answer(study, case, &check.question, Some(&check.equals))?;
    Ok(CheckResult {
        name: name.clone(),
        that: that.text.clone(),
        unit: that.quantity.unit.clone(),
        at,
        found,
        expected,
        within,
        error,
        spread,
        holds: spread.is_none() && (found - expected).abs() <= within,
    })
}
