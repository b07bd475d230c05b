//! The way from a scene to results, as one readable function.

use std::path::{Path, PathBuf};

use thiserror::Error;
use tumble_mech::{Equations, ModelErrors, Parameters, Run, RunError};
use tumble_ode::Refusal;
use tumble_scene::{Diagnostics, Override, Study};

use crate::checks::{self, CheckResult};
use crate::figures;
use crate::output::{Folder, OutputError};
use crate::progress::Progress;
use crate::summary::{self, Source};
use crate::tables;

/// How a scene is run, beyond what it says itself.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Parameters given another formula: `("T", "2 s")`.
    pub set: Vec<(String, String)>,
    /// Where results go: a folder of the scene's name is made in it.
    pub out: PathBuf,
    /// Whether a bar may be drawn for work over a second.
    pub progress: bool,
}

/// What a run came to.
#[derive(Debug)]
pub struct Outcome {
    /// The study that was run.
    pub study: Study,
    /// Where the results are.
    pub folder: PathBuf,
    /// Names of the figures, without ending.
    pub figures: Vec<String>,
    /// The scene's claims, each with what was found.
    pub checks: Vec<CheckResult>,
    /// The motion, as far as it was found.
    pub run: Run,
    /// Why it stopped early, if it did.
    pub refusal: Option<Refusal>,
}

impl Outcome {
    /// Whether the motion reached its end and every claim holds.
    pub fn is_success(&self) -> bool {
        self.refusal.is_none() && self.checks.iter().all(|check| check.holds)
    }
}

/// Why a scene has no results at all.
#[derive(Debug, Error)]
pub enum PipelineError {
    /// The file cannot be read.
    #[error("cannot read {}: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// The scene has mistakes.
    #[error("the scene has mistakes")]
    Scene(Box<Diagnostics>),
    /// The model's values do not fit.
    #[error(transparent)]
    Model(#[from] ModelErrors),
    /// A formula cannot be evaluated along the motion.
    #[error(transparent)]
    Run(#[from] Box<RunError>),
    /// Results cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// Runs a scene file: scene, study, equations, trajectory, tables, figures, summary.
///
/// A motion that is refused on the way is no error: what was found is written, marked incomplete, and the outcome says
/// why.
pub fn run(path: &Path, options: &Options) -> Result<Outcome, PipelineError> {
    let source = Source::read(path)?;
    let study = read(&source, options)?;
    let (run, refusal) = integrate(&study, options)?;
    let checks = checks::evaluate(&study, &run)?;
    let folder = Folder::begin(&options.out, &source.name)?;
    tables::write(&study, &run, &folder)?;
    let figures = figures::write(&study, &run, &folder)?;
    summary::write(&source, &study, &run, &checks, &figures, refusal.as_ref(), &folder)?;
    Ok(Outcome { folder: folder.finish()?, study, figures, checks, run, refusal })
}

/// Reads a scene and reports its mistakes, without running it.
pub fn check(path: &Path, options: &Options) -> Result<Study, PipelineError> {
    read(&Source::read(path)?, options)
}

fn read(source: &Source, options: &Options) -> Result<Study, PipelineError> {
    let overrides: Vec<Override> = options.set.iter().map(|(name, text)| Override { name: name.clone(), text: text.clone() }).collect();
    tumble_scene::read_bytes(&source.path.display().to_string(), &source.bytes, &overrides)
        .map_err(|diagnostics| PipelineError::Scene(Box::new(diagnostics)))
}

fn integrate(study: &Study, options: &Options) -> Result<(Run, Option<Refusal>), PipelineError> {
    let equations = Equations::new(study.model.clone())?;
    let parameters: Parameters = study.model.parameters.clone();
    let until = study.number(&study.until)?;
    let progress = Progress::new(&study.title, until, options.progress);
    match Run::new(equations, &parameters, until, study.accuracy, |time| progress.reached(time)) {
        Ok(run) => Ok((run, None)),
        Err(RunError::Refused { refusal, partial }) if !partial.trajectory.pieces.is_empty() => {
            Ok((*partial, Some(refusal)))
        }
        Err(error) => Err(Box::new(error).into()),
    }
}

impl From<RunError> for PipelineError {
    fn from(error: RunError) -> Self {
        Self::Run(Box::new(error))
    }
}
