//! What the command can do, and what it says.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use tumble::gallery::{self, GalleryError, Shown};
#[cfg(feature = "png")]
use tumble::pipeline::AnimationOptions;
use tumble::pipeline::{self, Options, Outcome, PipelineError};
use tumble::{CaseError, ReportForm};
use tumble_report::results::count;
use tumble_scene::{Diagnostics, printable};

use crate::told::{Told, shown};
use crate::tools::new::Kind;
use crate::tools::say::{self, say, tell};
use crate::tools::stop::interruptible;
use crate::tools::{completions, explain, new, schema, units};

const EXIT_CODES: &str = "Exit codes: 0 all went well, 1 a check of the scene does not hold, 2 the scene or the \
command line has mistakes, 3 the motion was refused on the way, 4 a file cannot be read or written, 130 interrupted.";

/// A rigid-body mechanics laboratory: state the bodies and the forces, get the motion.
#[derive(Parser)]
#[command(version = env!("TUMBLE_VERSION"), after_help = EXIT_CODES)]
pub(crate) struct Command {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Run a scene and write its figures, tables and summary.
    Run {
        /// The scene file.
        scene: PathBuf,
        #[command(flatten)]
        settings: Settings,
    },
    /// Report the mistakes of a scene without running it.
    Check {
        /// The scene file.
        scene: PathBuf,
        /// Give a parameter, or the accuracy, another value for this time, such as T=2s.
        #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
        set: Vec<(String, String)>,
    },
    /// Run every scene of a folder and write a page that shows them.
    Gallery {
        /// The folder: each scene is a folder in it with a scene.toml.
        #[arg(default_value = "scenes")]
        scenes: PathBuf,
        /// Where results go.
        #[arg(long, default_value = "out")]
        out: PathBuf,
    },
    /// Run a scene and write its motion as an animated GIF.
    #[cfg(feature = "png")]
    Animate {
        /// The scene file.
        scene: PathBuf,
        /// Give a parameter, or the accuracy, another value for this time, such as T=2s.
        #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
        set: Vec<(String, String)>,
        /// Which run of a sweep, counted from 1.
        #[arg(long, default_value_t = 1)]
        run: usize,
        /// Pixels across.
        #[arg(long, default_value_t = 800)]
        width: u32,
        /// Frames a second.
        #[arg(long, default_value_t = 25.0)]
        rate: f64,
        /// The file to write; out/SCENE.gif where none is given.
        #[arg(long)]
        to: Option<PathBuf>,
    },
    /// Write a scene to start from into a new folder.
    New {
        /// Name of the scene, and of its folder.
        name: String,
        /// What it shows; asked for at a terminal, else a pendulum.
        #[arg(long)]
        kind: Option<Kind>,
    },
    /// Say what a code such as E0203 means, or list all codes.
    Explain {
        /// The code.
        code: Option<String>,
    },
    /// List the units, tell of one unit or measure, or convert a quantity.
    Units {
        /// A unit such as lbf, a measure such as force, or a quantity such as "3 ft/s".
        #[arg(allow_hyphen_values = true)]
        what: Vec<String>,
    },
    /// Print the JSON schema of scene files, for editors.
    Schema,
    /// Print a script that lets a shell complete this command.
    Completions {
        /// The shell.
        shell: Shell,
    },
}

#[derive(Args)]
struct Settings {
    /// Give a parameter, or the accuracy, another value for this run, such as T=2s.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    set: Vec<(String, String)>,
    /// Where results go: a folder of the scene's name is made in it.
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// Write tables and the summary only.
    #[arg(long)]
    no_figures: bool,
    /// What to write the report as.
    #[arg(long, value_enum, default_value = "html")]
    report: Form,
    /// Leave the engine out of the report: it shows, and does not play.
    #[arg(long)]
    no_play: bool,
    /// How many runs of a sweep are made at once [default: as many as there are cores].
    #[arg(long, value_name = "NUMBER")]
    jobs: Option<NonZeroUsize>,
}

/// Forms of a report.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Form {
    /// One page that opens in any browser.
    Html,
    /// Text with formulas and links to the figures.
    Markdown,
    /// What a browser makes of the page.
    #[value(hide = true)]
    Pdf,
    /// None.
    None,
}

/// That a browser makes pages to print of the report.
const NO_PDF: &str = "a browser prints report.html, on A4 as on a screen: open it and print to a file, or `chromium --headless \
     --no-pdf-header-footer --print-to-pdf=report.pdf report.html`";

impl TryFrom<Form> for ReportForm {
    type Error = &'static str;

    fn try_from(form: Form) -> Result<Self, Self::Error> {
        match form {
            Form::Html => Ok(Self::Html),
            Form::Markdown => Ok(Self::Markdown),
            Form::Pdf => Err(NO_PDF),
            Form::None => Ok(Self::None),
        }
    }
}

fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write it as NAME=VALUE, for instance T=2s".to_owned()),
    }
}

/// How a command ended, worst last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Ending {
    /// All went well.
    Success = 0,
    /// A check of the scene does not hold.
    CheckFailed = 1,
    /// The scene or the command line has mistakes.
    Mistake = 2,
    /// The motion was refused on the way.
    Refused = 3,
    /// A file or a stream cannot be read or written.
    File = 4,
    /// Ctrl-C has ended it. The number is that of shells.
    Interrupted = 130,
}

impl Command {
    pub(crate) fn run(self) -> ExitCode {
        let ending = self.task.run();
        let Some(error) = say::lost() else { return ExitCode::from(ending as u8) };
        tell!("error: cannot write to standard output: {error}");
        ExitCode::from(Ending::File as u8)
    }
}

impl Task {
    fn run(self) -> Ending {
        match self {
            Task::Run { scene, settings } => {
                let Settings { set, out, no_figures, report: form, no_play, jobs } = settings;
                let form = match ReportForm::try_from(form) {
                    Ok(form) if !no_figures => form,
                    Ok(_) => ReportForm::None,
                    Err(instead) => {
                        tell!("error: {instead}");
                        return Ending::Mistake;
                    }
                };
                let stop = interruptible();
                let options = Options {
                    set,
                    out,
                    no_figures,
                    report: form,
                    no_play,
                    site: None,
                    jobs,
                    progress: true,
                    stop,
                };
                let mut told = Told::beside(&options.out);
                let result = pipeline::run_telling(&scene, &options, |run| told.add(&run));
                report(&Shown { result, scene }, &mut told)
            }
            Task::Check { scene, set } => {
                let options = Options { set, ..Options::default() };
                check(&scene, &options)
            }
            Task::Gallery { scenes, out } => {
                let options = Options { out, progress: true, stop: interruptible(), ..Options::default() };
                gallery(&scenes, &options)
            }
            #[cfg(feature = "png")]
            Task::Animate { scene, set, run, width, rate, to } => {
                let stop = interruptible();
                let options = Options { set, out: "out".into(), progress: true, stop, ..Options::default() };
                match pipeline::animate(&scene, &options, &AnimationOptions { run, width, rate, to }) {
                    Ok(file) => {
                        say!("{}", shown(&file));
                        Ending::Success
                    }
                    Err(error) => complain(&scene, &error),
                }
            }
            Task::New { name, kind } => new::run(&name, kind),
            Task::Explain { code } => explain::run(code.as_deref()),
            Task::Units { what } => units::run(&what),
            Task::Schema => schema::run(),
            Task::Completions { shell } => completions::run(shell),
        }
    }
}

fn check(scene: &Path, options: &Options) -> Ending {
    match pipeline::check(scene, options) {
        Ok(study) => {
            draw(&study.warnings());
            say!("{}: {} has no mistakes", study.title, shown(scene));
            Ending::Success
        }
        Err(error) => complain(scene, &error),
    }
}

fn gallery(scenes: &Path, options: &Options) -> Ending {
    let mut worst = Ending::Success;
    match gallery::run(scenes, options, |shown| worst = worst.max(of_gallery(shown, &options.out))) {
        Ok(page) => say!("\nthe gallery is {}", shown(&page)),
        Err(error @ GalleryError::Interrupted { .. }) => {
            tell!("{error}");
            worst = Ending::Interrupted;
        }
        Err(error) => {
            tell!("error: {error}");
            worst = Ending::File;
        }
    }
    worst
}

/// Says what a scene of a gallery came to.
fn of_gallery(shown: &Shown, out: &Path) -> Ending {
    let mut told = Told::beside(out);
    let mut cases = shown.result.iter().flat_map(|outcome| &outcome.cases);
    match cases.try_for_each(|run| told.add(run)) {
        Ok(()) => report(shown, &mut told),
        Err(error) => unread(&error),
    }
}

/// Says what a scene came to.
fn report(shown: &Shown, told: &mut Told) -> Ending {
    match &shown.result {
        Ok(outcome) => {
            if let Err(error) = describe(outcome, told) {
                return unread(&error);
            }
            draw(&outcome.said());
            if !outcome.missing.is_empty() {
                Ending::Interrupted
            } else if outcome.tally.refused > 0 {
                Ending::Refused
            } else if outcome.is_success() {
                Ending::Success
            } else {
                Ending::CheckFailed
            }
        }
        Err(error) => complain(&shown.scene, error),
    }
}

/// What is to be said of the runs went to a disk and does not come back.
fn unread(error: &std::io::Error) -> Ending {
    tell!("error: cannot tell what the runs came to, which is in their results: {error}");
    Ending::File
}

fn describe(outcome: &Outcome, told: &mut Told) -> std::io::Result<()> {
    say!("{}", outcome.study.title);
    told.say()?;
    outcome.located.iter().for_each(|located| say!("{}", printable(&located.told())));
    if !outcome.figures.is_empty() {
        say!("  figures: {}", outcome.figures.join(", "));
    }
    outcome.notes.iter().for_each(|note| say!("  note: {note}"));
    let (made, missing) = (outcome.tally.made, outcome.missing.len());
    if missing == 0 {
        say!("  results: {}", shown(&outcome.folder));
    } else {
        let (all, were) = (made + missing, if missing == 1 { "was" } else { "were" });
        let missing = count(missing as u64, "run");
        let results = shown(&outcome.folder);
        say!("  interrupted: {made} of {all} runs finished; results: {results}; {missing} {were} not made");
    }
    Ok(())
}

/// Shows mistakes or warnings with their places, if there are any.
fn draw(diagnostics: &Diagnostics) {
    if !diagnostics.is_empty() {
        tell!("{}", diagnostics.render(say::colour(&std::io::stderr()), say::width()));
    }
}

fn complain(scene: &Path, error: &PipelineError) -> Ending {
    match error {
        #[cfg(feature = "png")]
        PipelineError::Gif(_) => {
            tell!("error: {}: {error}", shown(scene));
            Ending::Mistake
        }
        PipelineError::Name { .. } => {
            tell!("error: {error}");
            Ending::Mistake
        }
        PipelineError::Case(of_case) => complain_of_case(scene, of_case),
        PipelineError::Read { .. } | PipelineError::Output(_) => {
            tell!("error: {error}");
            Ending::File
        }
    }
}

fn complain_of_case(scene: &Path, error: &CaseError) -> Ending {
    match error {
        CaseError::Scene(diagnostics) | CaseError::Refused(diagnostics) => draw(diagnostics),
        CaseError::Interrupted => tell!("{}: {error}", shown(scene)),
        _ => tell!("error: {}: {error}", shown(scene)),
    }
    match error {
        CaseError::Scene(_) | CaseError::Model(_) | CaseError::Accuracy(_) => Ending::Mistake,
        CaseError::Refused(_) | CaseError::Run(_) => Ending::Refused,
        CaseError::Interrupted => Ending::Interrupted,
    }
}
