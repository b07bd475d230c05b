//! The way from a scene to results, as one readable function.

use std::cell::RefCell;
use std::io;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

#[cfg(feature = "png")]
use tumble_drawing::gif;
use tumble_report::results::{Case, CaseBalance, CaseError, Finished, Missing, Runs, Surveyor, Tally};
use tumble_scene::{Diagnostics, Files, Override, Study};

use crate::figure_files;
pub use crate::outcome::{Outcome, PipelineError};
use crate::output::{Folder, Placed};
#[cfg(feature = "png")]
use crate::output::{Kind, Single};
use crate::summary::{self, Source};
use crate::{report_file, runs, tables};

/// How a scene is run, beyond what it says itself.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Parameters given another formula, `("T", "2 s")`, and the accuracy, `("accuracy", "1e-6")`.
    pub set: Vec<(String, String)>,
    /// Where results go: a folder of the scene's name is made in it.
    pub out: PathBuf,
    /// Whether figures are left out, for numbers only.
    pub no_figures: bool,
    /// Which form of report is written.
    pub report: report_file::Form,
    /// Whether its page is without the engine, and only shows.
    pub no_play: bool,
    /// The site that the report stands in, if it does.
    pub site: Option<report_file::InSite>,
    /// How many runs are made at once; as many as there are cores where nothing is said. What comes out is the same.
    pub jobs: Option<NonZeroUsize>,
    /// Whether it may be told how far work over a second is.
    pub progress: bool,
    /// Set by whoever wants no more runs: the run that is being made stops at its next step, and what was finished before
    /// is written.
    pub stop: Arc<AtomicBool>,
}

/// Runs a scene file: scene, study, cases (equations and trajectory each), tables, figures, summary.
///
/// A motion that is refused on the way is no error: what was found is written, marked incomplete, and the outcome says
/// why. If no more runs are wanted, those that were finished are written, and the outcome has the others.
pub fn run(path: &Path, options: &Options) -> Result<Outcome, PipelineError> {
    keeping(|keep| run_telling(path, options, keep))
}

/// The outcome with all that its runs came to.
fn keeping(
    run: impl FnOnce(&mut (dyn FnMut(Finished) -> io::Result<()> + Send)) -> Result<Outcome, PipelineError>,
) -> Result<Outcome, PipelineError> {
    let mut cases = vec![];
    let outcome = run(&mut |case| {
        cases.push(case);
        Ok(())
    })?;
    Ok(Outcome { cases, ..outcome })
}

/// The same for more runs than memory should hold: `tell` is given each, in order, once its tables are written.
///
/// What it came to may still be refused: only when this returns is anything in its place.
pub fn run_telling(
    path: &Path,
    options: &Options,
    tell: impl FnMut(Finished) -> io::Result<()> + Send,
) -> Result<Outcome, PipelineError> {
    let mut source = Source::read(path)?;
    let study = read(&mut source, options)?;
    written(&source, &study, &source.needed(), options, tell)
}

/// Runs a study of a model that was made in Rust, and writes what a scene's run does, into a folder of that name.
///
/// `set` of the options has no part in it: the model has its parameters.
///
/// ```
/// use tumble::prelude::*;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut model = Model::new();
/// model.gravity = Gravity::Vertical(9.81 * M / (S * S));
/// let rod = model.add(Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).mass(2 * KG));
/// model.pivot(&rod, [0 * M, 0 * M]);
/// model.starts.push(("rod".into(), Start::default().angle(0.3.into())));
/// let angle = rod.kinematics().angle();
/// let study = Plan::of("A pendulum", model, 4 * S)
///     .plot("swing", [("angle", angle.clone())])
///     .free_body("forces", &rod, [Instant::at(0.5)])
///     .find("widest", angle, When::greatest())
///     .study()
///     .map_err(|mistakes| mistakes.to_string())?;
/// # let out = std::env::temp_dir().join("tumble-doc-run-study");
/// let options = Options { out, ..Options::default() };
/// let outcome = tumble::pipeline::run_study(&study, "pendulum", &options)?;
/// assert!(outcome.folder.join("report.html").is_file());
/// assert!((outcome.cases[0].finds[0].value - 0.3).abs() < 1e-12);
/// # Ok(())
/// # }
/// ```
pub fn run_study(study: &Study, name: &str, options: &Options) -> Result<Outcome, PipelineError> {
    let source = Source::of_program(name)?;
    let mut study = study.clone();
    if study.title.is_empty() {
        study.title = source.shown_name();
    }
    keeping(|keep| written(&source, &study, &[], options, keep))
}

/// Runs a scene that is given as text, and writes what that of a file does, into a folder of that name.
pub(crate) fn run_scene(name: &str, text: &str, options: &Options) -> Result<Outcome, PipelineError> {
    let mut source = Source::of_text(name, text);
    let study = read(&mut source, options)?;
    written(&source, &study, &[], options, |_| Ok(()))
}

/// Makes the runs of a study and puts their results in place; no result takes the place of what was needed.
fn written(
    source: &Source,
    study: &Study,
    needed: &[PathBuf],
    options: &Options,
    tell: impl FnMut(Finished) -> io::Result<()> + Send,
) -> Result<Outcome, PipelineError> {
    let folder = Folder::begin(&options.out, &source.name, needed)?;
    let outcome = write(source, study, options, &folder, tell).map_err(|error| error.placed(study))?;
    let Placed { folder, notes } = folder.finish()?;
    Ok(Outcome { folder, notes, ..outcome })
}

/// Makes the runs and all that is told of them, in a folder that is not in its place yet.
///
/// A motion is dropped as soon as its tables are written, unless something is still to be drawn or told of it, and what it
/// came to as soon as that is told: memory does not grow with the number of runs.
fn write(
    source: &Source,
    study: &Study,
    options: &Options,
    folder: &Folder,
    mut tell: impl FnMut(Finished) -> io::Result<()> + Send,
) -> Result<Outcome, PipelineError> {
    let write = |mut case: Case| {
        tables::write(study, &case, folder)?;
        if !options.no_figures {
            case.balance = CaseBalance::of(&case)?;
            tables::write_balance(&case, folder)?;
        }
        let finished = Finished::of(&case);
        let page = folder.towards(summary::FILE, summary::page(study, &finished))?;
        Ok((finished, page, still_needed(study, options, case)))
    };
    let (mut tally, mut of_runs, mut cases) = (Tally::default(), Diagnostics::default(), vec![]);
    let mut pages = folder.spool();
    let mut sweep = tables::begin_sweep(study, folder)?;
    let mut surveyor = Surveyor::of(study, wants_pictures(options))?;
    let keep = |(finished, page, case): (Finished, String, Option<Case>)| {
        tally.add(&finished);
        surveyor.add(&finished);
        sweep.iter_mut().try_for_each(|tables| tables.add(&finished))?;
        of_runs.extend(finished.said.clone());
        cases.extend(case);
        Ok(folder.towards(summary::FILE, pages.add(&page).and_then(|()| tell(finished)))?)
    };
    let missing = runs::all(study, options, write, keep)?;
    sweep.map_or(Ok(()), tables::end_sweep)?;
    let located = if missing.is_empty() { runs::located(study, options, &surveyor)? } else { vec![] };
    let survey = surveyor.end(located);
    let runs = Runs { cases: &cases, missing: &missing, survey: &survey };
    let figures = if options.no_figures { vec![] } else { figure_files::write(study, runs, folder)? };
    let (lead, motion) = report_file::write(source, study, runs, folder, options)?;
    drop(cases);
    let (study, located, cases) = (study.clone(), survey.located, vec![]);
    let outcome = Outcome {
        study,
        folder: PathBuf::new(),
        figures,
        cases,
        tally,
        of_runs,
        missing,
        located,
        lead,
        motion,
        notes: vec![],
    };
    summary::write(source, &outcome, pages, folder)?;
    Ok(outcome)
}

/// Whether anything is to be drawn or told beyond numbers.
fn wants_pictures(options: &Options) -> bool {
    !options.no_figures || options.report != report_file::Form::None
}

/// What figures and the report will read of a run, if anything.
fn still_needed(study: &Study, options: &Options, case: Case) -> Option<Case> {
    let has_figures = !options.no_figures && tumble_report::figures::are_asked_for(study);
    match options.report {
        report_file::Form::None if !has_figures => None,
        report_file::Form::None => {
            let balance = case.balance.filter(|_| !study.balances.is_empty());
            // Only words and numbers say how far it can be trusted.
            Some(Case { trust: None, balance, ..case })
        }
        _ => Some(case),
    }
}

/// Runs a scene file and writes nothing: the study, and the runs with their motions.
pub fn motions(path: &Path, options: &Options) -> Result<(Study, Vec<Case>), PipelineError> {
    let study = read(&mut Source::read(path)?, options)?;
    let cases = all_motions(&study, options)?;
    Ok((study, cases))
}

fn all_motions(study: &Study, options: &Options) -> Result<Vec<Case>, PipelineError> {
    let (cases, missing) = kept(study, options).map_err(|error| error.placed(study))?;
    if missing.is_empty() { Ok(cases) } else { Err(CaseError::Interrupted.into()) }
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
    Ok(kept(&study, &Options::default())?.0)
}

/// The runs that were made, with their motions, and those that were not.
fn kept(study: &Study, options: &Options) -> Result<(Vec<Case>, Vec<Missing>), PipelineError> {
    let mut cases = vec![];
    let keep = |case| {
        cases.push(case);
        Ok(())
    };
    let missing = runs::all(study, options, Ok, keep)?;
    Ok((cases, missing))
}

fn mistaken(diagnostics: Diagnostics) -> PipelineError {
    CaseError::Scene(Box::new(diagnostics)).into()
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

/// Animations replace animations only.
#[cfg(feature = "png")]
const ANIMATION: Kind = Kind { seal: gif::ANIMATION_SEAL, option: "--to" };

/// Runs a scene and writes its motion as an animated GIF; the path of the file.
#[cfg(feature = "png")]
pub fn animate(path: &Path, options: &Options, how: &AnimationOptions) -> Result<PathBuf, PipelineError> {
    let mut source = Source::read(path)?;
    let study = read(&mut source, options)?;
    let to = how.to.clone().unwrap_or_else(|| options.out.join(format!("{}.gif", source.name)));
    let file = Single::begin(&to, ANIMATION)?;
    let cases = all_motions(&study, options)?;
    let animation = tumble_report::animation(&study, &cases)?;
    let gif = gif::animation_gif(&animation, how.run.wrapping_sub(1), how.width, how.rate)?;
    Ok(file.finish(&gif)?)
}

/// Reads a scene and reports its mistakes, without running it.
pub fn check(path: &Path, options: &Options) -> Result<Study, PipelineError> {
    read(&mut Source::read(path)?, options)
}

/// The files beside a scene, which notes what was read of them.
struct Noting {
    folder: tumble_scene::Folder,
    read: RefCell<Vec<(String, Vec<u8>)>>,
}

impl Files for Noting {
    fn read(&self, relative: &str) -> io::Result<Vec<u8>> {
        let bytes = self.folder.read(relative);
        let known = bytes.as_ref().map_or_else(|_| vec![], Clone::clone);
        self.read.borrow_mut().push((relative.to_owned(), known));
        bytes
    }
}

/// The study of a scene, which then has the files that it reads.
fn read(source: &mut Source, options: &Options) -> Result<Study, PipelineError> {
    let overrides: Vec<Override> =
        options.set.iter().map(|(name, text)| Override { name: name.clone(), text: text.clone() }).collect();
    let beside = Noting { folder: tumble_scene::Folder::of(&source.path), read: RefCell::default() };
    let mut study =
        tumble_scene::read_bytes_in(&source.path.display().to_string(), &source.bytes, &overrides, &beside)
            .map_err(mistaken)?;
    if study.title.is_empty() {
        study.title = source.shown_name();
    }
    source.beside = beside.read.into_inner();
    Ok(study)
}
