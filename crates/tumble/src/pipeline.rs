//! The way from a scene to results, as one readable function.

use std::path::{Path, PathBuf};

use thiserror::Error;
use tumble_mech::{ModelErrors, RunError};
use tumble_scene::{Diagnostics, Override, Study};

use crate::balance::CaseBalance;
use crate::case::{self, Case};
use crate::figures;
use crate::output::{Folder, OutputError};
use crate::report;
use crate::summary::{self, Source};
use crate::tables;

/// How a scene is run, beyond what it says itself.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Parameters given another formula: `("T", "2 s")`.
    pub set: Vec<(String, String)>,
    /// Where results go: a folder of the scene's name is made in it.
    pub out: PathBuf,
    /// Whether figures are left out, for numbers only.
    pub no_figures: bool,
    /// Which form of report is written.
    pub report: report::Form,
    /// Whether a bar may be drawn for work over a second.
    pub progress: bool,
}

/// What the runs of a scene came to.
#[derive(Debug)]
pub struct Outcome {
    /// The study that was run.
    pub study: Study,
    /// Where the results are.
    pub folder: PathBuf,
    /// Names of the figures, without ending.
    pub figures: Vec<String>,
    /// The runs: one, or one for every combination of swept parameters.
    pub cases: Vec<Case>,
}

impl Outcome {
    /// What its user should know: warnings of the scene and of its runs, and why a run stopped early.
    pub fn said(&self) -> Diagnostics {
        let mut said = self.study.warnings();
        self.cases.iter().for_each(|case| said.extend(case.said.clone()));
        said
    }

    /// Whether every motion reached its end and every claim holds.
    pub fn is_success(&self) -> bool {
        self.cases.iter().all(Case::is_success)
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
    /// The motion cannot be begun, or a question to it has no answer.
    #[error("the motion was refused")]
    Refused(Box<Diagnostics>),
    /// A formula cannot be evaluated along the motion.
    #[error(transparent)]
    Run(#[from] Box<RunError>),
    /// Results cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// An animation cannot be written.
    #[error("cannot write {}: {reason}", path.display())]
    Animation {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// An animation cannot be drawn.
    #[cfg(feature = "png")]
    #[error(transparent)]
    Gif(#[from] tumble_report::GifError),
    /// A report as PDF was asked for, and this build has no typesetter.
    #[error("this build writes no PDF: build it with `cargo build --release --features pdf`")]
    WithoutPdf,
    /// A report cannot be set.
    #[cfg(feature = "pdf")]
    #[error(transparent)]
    Pdf(#[from] tumble_report::report::PdfError),
}

/// Runs a scene file: scene, study, cases (equations and trajectory each), tables, figures, summary.
///
/// A motion that is refused on the way is no error: what was found is written, marked incomplete, and the outcome says
/// why.
pub fn run(path: &Path, options: &Options) -> Result<Outcome, PipelineError> {
    options.report.check()?;
    let source = Source::read(path)?;
    let study = read(&source, options)?;
    let folder = Folder::begin(&options.out, &source.name)?;
    let placed = |error: PipelineError| error.placed(&study);
    let mut cases = vec![];
    for (index, values) in case::combinations(&study).map_err(placed)?.into_iter().enumerate() {
        let mut case = Case::run(&study, index + 1, values, options.progress)?;
        tables::write(&study, &case, &folder).map_err(placed)?;
        if !options.no_figures {
            case.balance = CaseBalance::of(&case).map_err(placed)?;
            case.balance.iter().try_for_each(|balance| balance.write(&case, &folder))?;
        }
        cases.push(case);
    }
    let figures =
        if options.no_figures { vec![] } else { figures::write(&study, &cases, &folder).map_err(placed)? };
    report::write(&source, &study, &cases, &folder, options.report).map_err(placed)?;
    summary::write(&source, &study, &cases, &figures, &folder)?;
    Ok(Outcome { folder: folder.finish()?, study, figures, cases })
}

/// Runs a scene that is given as text, and writes nothing.
///
/// The cases hold what the scene asks for and claims; figures and tables are not made, and tables of measured values,
/// which are files, cannot be read. `name` is what messages call the scene.
///
/// ```
/// let scene = r#"
///     version = 1
///     world.gravity = "9.81 m/s^2"
///     run.until = "2 s"
///
///     [body.stone]
///     point = {}
///     mass = "1 kg"
///
///     [find.depth]
///     that = "-stone.y"
/// "#;
/// let cases = tumble::pipeline::run_text("stone", scene).expect("a scene without mistakes");
/// let depth = &cases[0].finds[0];
/// let error = depth.error.expect("a motion that is known");
/// assert!((depth.value - 19.62).abs() <= error);
/// ```
pub fn run_text(name: &str, text: &str) -> Result<Vec<Case>, PipelineError> {
    let study = tumble_scene::read(name, text, &[]).map_err(mistaken)?;
    let values = case::combinations(&study)?.into_iter().enumerate();
    values.map(|(index, values)| Case::run(&study, index + 1, values, false)).collect()
}

fn mistaken(diagnostics: Diagnostics) -> PipelineError {
    PipelineError::Scene(Box::new(diagnostics))
}

/// How an animation is drawn.
#[cfg(feature = "png")]
#[derive(Clone, Debug)]
pub struct AnimationOptions {
    /// Which run of a sweep, counted from 1.
    pub run: usize,
    /// Pixels across.
    pub width: u32,
    /// Frames a second.
    pub rate: f64,
    /// The file to write; by the scene's name, in the folder of the results, where there is none.
    pub to: Option<PathBuf>,
}

/// Runs a scene and writes its motion as an animated GIF; the path of the file.
#[cfg(feature = "png")]
pub fn animate(path: &Path, options: &Options, how: &AnimationOptions) -> Result<PathBuf, PipelineError> {
    let source = Source::read(path)?;
    let study = read(&source, options)?;
    let placed = |error: PipelineError| error.placed(&study);
    let mut cases = vec![];
    for (index, values) in case::combinations(&study).map_err(placed)?.into_iter().enumerate() {
        cases.push(Case::run(&study, index + 1, values, options.progress)?);
    }
    let animation = report::animation(&study, &cases)?;
    let gif = tumble_report::animation_gif(&animation, how.run.wrapping_sub(1), how.width, how.rate)?;
    let to = how.to.clone().unwrap_or_else(|| options.out.join(format!("{}.gif", source.name)));
    let failed =
        |error: std::io::Error| PipelineError::Animation { path: to.clone(), reason: error.to_string() };
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder).map_err(failed)?;
    }
    std::fs::write(&to, gif).map_err(failed)?;
    Ok(to)
}

/// Reads a scene and reports its mistakes, without running it.
pub fn check(path: &Path, options: &Options) -> Result<Study, PipelineError> {
    read(&Source::read(path)?, options)
}

fn read(source: &Source, options: &Options) -> Result<Study, PipelineError> {
    let overrides: Vec<Override> =
        options.set.iter().map(|(name, text)| Override { name: name.clone(), text: text.clone() }).collect();
    let beside = tumble_scene::Folder::of(&source.path);
    let mut study =
        tumble_scene::read_bytes_in(&source.path.display().to_string(), &source.bytes, &overrides, &beside)
            .map_err(mistaken)?;
    if study.title.is_empty() {
        study.title.clone_from(&source.name);
    }
    Ok(study)
}

impl From<tumble_ode::Reason> for PipelineError {
    fn from(reason: tumble_ode::Reason) -> Self {
        RunError::from(reason).into()
    }
}

impl From<RunError> for PipelineError {
    fn from(error: RunError) -> Self {
        Self::Run(Box::new(error))
    }
}
