//! What came of a scene, or why nothing did.

use std::path::PathBuf;

use thiserror::Error;
use tumble_drawing::Animation;
#[cfg(feature = "png")]
use tumble_drawing::gif;
use tumble_report::report::Text;
use tumble_report::results::{CaseError, Finished, Located, Missing, Tally};
use tumble_scene::{Diagnostics, Study};

use crate::output::{OutputError, shown};

/// What the runs of a scene came to.
#[derive(Debug)]
pub struct Outcome {
    /// The study that was run.
    pub study: Study,
    /// Where the results are.
    pub folder: PathBuf,
    /// Names of the figures, without ending.
    pub figures: Vec<String>,
    /// The runs: one, or one for every combination of swept parameters. None where each was told of as it was made.
    pub cases: Vec<Finished>,
    /// How many runs ended how.
    pub tally: Tally,
    /// What a user should know of the runs.
    pub of_runs: Diagnostics,
    /// The runs that were not made, because no more were wanted.
    pub missing: Vec<Missing>,
    /// Where along a sweep of one parameter its answers are greatest and least.
    pub located: Vec<Located>,
    /// What was found, in a line; empty where no report was asked for.
    pub lead: Text,
    /// The motion as the report shows it, if it does.
    pub motion: Option<Animation>,
    /// What is left over beside the results and was not removed, with the reason.
    pub notes: Vec<String>,
}

impl Outcome {
    /// What its user should know: warnings of the scene and of its runs, and why a run stopped early.
    pub fn said(&self) -> Diagnostics {
        let mut said = self.study.warnings();
        tumble_report::figures::clashes(&self.study).into_iter().for_each(|alike| said.extend(alike));
        said.extend(self.of_runs.clone());
        said
    }

    /// Whether every run was made, every motion reached its end and every claim holds.
    pub fn is_success(&self) -> bool {
        self.missing.is_empty() && self.tally.refused + self.tally.refuted == 0
    }
}

/// Why a scene has no results at all.
#[derive(Debug, Error)]
pub enum PipelineError {
    /// The file cannot be read.
    #[error("cannot read {}: {error}", shown(path))]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// A study whose results cannot have a folder of that name.
    #[error("`{name}` cannot be the name of a folder: {fault}")]
    Name {
        /// The name.
        name: String,
        /// What is wrong with it.
        fault: String,
    },
    /// A run, or what is asked of it, has no result.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// Results cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// An animation cannot be drawn.
    #[cfg(feature = "png")]
    #[error(transparent)]
    Gif(#[from] gif::GifError),
}

impl PipelineError {
    /// The same with the place in the scene that it is about.
    pub(crate) fn placed(self, study: &Study) -> Self {
        match self {
            Self::Case(error) => Self::Case(error.placed(study)),
            other => other,
        }
    }

    /// Whether it is none of its own: no more was wanted.
    pub(crate) fn is_interruption(&self) -> bool {
        matches!(self, Self::Case(error) if error.is_interruption())
    }
}
