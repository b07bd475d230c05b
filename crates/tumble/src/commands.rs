//! What the command can do, and what it says.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use tumble::Case;
use tumble::gallery::{self, Shown};
use tumble::pipeline::{self, Options, Outcome, PipelineError};

const EXIT_CODES: &str = "Exit codes: 0 all went well, 1 a check of the scene does not hold, 2 the scene or the \
command line has mistakes, 3 the motion was refused on the way, 4 a file cannot be read or written.";

/// A rigid-body mechanics laboratory: state the bodies and the forces, get the motion.
#[derive(Parser)]
#[command(version, after_help = EXIT_CODES)]
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
        /// Give a parameter another value for this time, such as T=2s.
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
}

#[derive(Args)]
struct Settings {
    /// Give a parameter another value for this run, such as T=2s.
    #[arg(long, value_name = "NAME=VALUE", value_parser = assignment)]
    set: Vec<(String, String)>,
    /// Where results go: a folder of the scene's name is made in it.
    #[arg(long, default_value = "out")]
    out: PathBuf,
    /// Write tables and the summary only.
    #[arg(long)]
    no_figures: bool,
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
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Ending {
    Success = 0,
    CheckFailed = 1,
    Mistake = 2,
    Refused = 3,
    File = 4,
}

impl Command {
    pub(crate) fn run(self) -> ExitCode {
        let ending = match self.task {
            Task::Run { scene, settings } => {
                let Settings { set, out, no_figures } = settings;
                let options = Options { set, out, no_figures, progress: true };
                report(&Shown { result: pipeline::run(&scene, &options), scene })
            }
            Task::Check { scene, set } => {
                let options = Options { set, ..Options::default() };
                check(&scene, &options)
            }
            Task::Gallery { scenes, out } => {
                gallery(&scenes, Options { out, progress: true, ..Options::default() })
            }
        };
        ExitCode::from(ending as u8)
    }
}

fn check(scene: &std::path::Path, options: &Options) -> Ending {
    match pipeline::check(scene, options) {
        Ok(study) => {
            println!("{}: {} has no mistakes", study.title, scene.display());
            Ending::Success
        }
        Err(error) => complain(scene, &error),
    }
}

fn gallery(scenes: &std::path::Path, options: Options) -> Ending {
    let mut worst = Ending::Success;
    match gallery::run(scenes, &options, |shown| worst = worst.max(report(shown))) {
        Ok(page) => println!("\nthe gallery is {}", page.display()),
        Err(error) => {
            eprintln!("error: {error}");
            worst = Ending::File;
        }
    }
    worst
}

/// Says what a scene came to.
fn report(shown: &Shown) -> Ending {
    match &shown.result {
        Ok(outcome) => {
            describe(outcome);
            if outcome.cases.iter().any(|case| case.refusal.is_some()) {
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

fn describe(outcome: &Outcome) {
    println!("{}", outcome.study.title);
    outcome.cases.iter().for_each(describe_case);
    if !outcome.figures.is_empty() {
        println!("  figures: {}", outcome.figures.join(", "));
    }
    println!("  results: {}", outcome.folder.display());
}

fn describe_case(case: &Case) {
    let (trajectory, work) = (&case.run.trajectory, case.run.trajectory.work);
    let label = if case.label.is_empty() { String::new() } else { format!("{}: ", case.label) };
    let exact = if work.exact_steps == work.steps { ", all exact" } else { "" };
    let end = trajectory.end().unwrap_or(0.0);
    let (steps, events) = (count(work.steps, "step"), count(trajectory.events.len() as u64, "event"));
    println!("  {label}{end} s in {steps}{exact}, {events}");
    if let Some(found) = case.run.quadrature.filter(|found| !found.settled) {
        println!("  the sum over {} nodes along a line is only good to {:.0e}", found.nodes, found.change);
    }
    for check in &case.checks {
        if at_nothing(check) {
            println!("  check {}: FAILS, its event or its time was not reached", check.name);
            continue;
        }
        let verdict = if check.holds { "holds" } else { "FAILS" };
        let (that, at) = (&check.that, check.at);
        print!("  check {}: {that} = {} at {at} s {verdict}", check.name, check.found);
        if check.holds {
            println!()
        } else {
            println!(", expected {} within {:?}", check.expected, check.within)
        }
    }
    if let Some(refusal) = &case.refusal {
        println!("  incomplete: {refusal}");
    }
}

/// Whether a claim is about a time that the motion does not have.
fn at_nothing(check: &tumble::CheckResult) -> bool {
    check.at.is_nan()
}

/// `1 step`, `2 steps`
fn count(number: u64, what: &str) -> String {
    format!("{number} {what}{}", if number == 1 { "" } else { "s" })
}

fn complain(scene: &std::path::Path, error: &PipelineError) -> Ending {
    match error {
        PipelineError::Scene(diagnostics) => {
            let stream = std::io::stderr();
            let colour =
                stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
            eprintln!("{}", diagnostics.render(colour, terminal_width()));
            Ending::Mistake
        }
        PipelineError::Model(_) => {
            eprintln!("error: {}: {error}", scene.display());
            Ending::Mistake
        }
        PipelineError::Run(_) => {
            eprintln!("error: {}: {error}", scene.display());
            Ending::Refused
        }
        PipelineError::Read { .. } | PipelineError::Output(_) => {
            eprintln!("error: {error}");
            Ending::File
        }
    }
}

/// Columns of the terminal; what is not a terminal is as wide as a page.
fn terminal_width() -> usize {
    const PAGE: usize = 100;
    std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok()).unwrap_or(PAGE)
}
