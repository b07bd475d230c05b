//! Why a study has no results.

use thiserror::Error;
use tumble_mech::{ModelErrors, RunError};
use tumble_ode::AccuracyError;
use tumble_scene::Diagnostics;

/// Why a run, or what is asked of it, has no result.
#[derive(Debug, Error)]
pub enum CaseError {
    /// The scene has mistakes.
    #[error("the scene has mistakes")]
    Scene(Box<Diagnostics>),
    /// The model's values do not fit.
    #[error(transparent)]
    Model(#[from] ModelErrors),
    /// The motion cannot be begun, or a question to it has no answer.
    #[error("the motion was refused")]
    Refused(Box<Diagnostics>),
    /// A formula cannot be evaluated along the motion.
    #[error(transparent)]
    Run(#[from] Box<RunError>),
    /// A sweep of the accuracy has a value that cannot be asked for.
    #[error(transparent)]
    Accuracy(#[from] AccuracyError),
    /// No more was wanted before the motion was found.
    #[error("interrupted: nothing was finished, and nothing is written")]
    Interrupted,
}

impl CaseError {
    /// Whether it is none of its own: no more was wanted.
    pub fn is_interruption(&self) -> bool {
        matches!(self, Self::Interrupted)
    }
}

impl From<tumble_ode::Reason> for CaseError {
    fn from(reason: tumble_ode::Reason) -> Self {
        RunError::from(reason).into()
    }
}

impl From<RunError> for CaseError {
    fn from(error: RunError) -> Self {
        Self::Run(Box::new(error))
    }
}
