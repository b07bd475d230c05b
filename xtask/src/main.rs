//! `cargo xtask`: what developers and the continuous integration run.
//!
//! The subcommands are lists of [`steps::Step`]; to add a check to the project, add an entry to a list in `plan.rs`.

mod bless;
mod browser;
mod command;
mod dead_links;
mod debian;
mod lab;
mod plan;
mod play;
mod references;
mod release;
mod steps;
mod tidy;
mod workspace;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::workspace::Workspace;

/// The developer's commands of the tumble workspace.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Formatting and lints: the quick look before a commit.
    Check,
    /// Formatting, lints, all Rust tests, documentation, tidy.
    Test {
        /// Also the pages in headless Chromium and the Python references.
        #[arg(long)]
        all: bool,
        /// Only these steps, by the names of the table.
        #[arg(long, value_name = "STEP", value_parser = plan::step_names())]
        only: Vec<String>,
    },
    /// The invariants of ARCHITECTURE.md and the house rules that a program can check.
    Tidy,
    /// The program, linked with nothing of the system, in an archive with its licences.
    Release,
    /// Play with the reports of the gallery in headless Chromium and Firefox.
    Play {
        /// How long it takes instead: from a slider to the picture and to all numbers, frames a second, sizes.
        #[arg(long)]
        bench: bool,
    },
    /// Build the engine of pages that play, as it stands in the repository.
    Lab,
    /// Regenerate snapshots, figures and references; review the difference before committing it.
    Bless {
        /// What to regenerate; everything when nothing is named.
        parts: Vec<bless::Part>,
    },
}

fn main() -> ExitCode {
    let task = Cli::parse().task;
    match Workspace::find() {
        Ok(workspace) => run(task, &workspace),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(task: Task, workspace: &Workspace) -> ExitCode {
    let steps = match task {
        Task::Check => plan::check(),
        Task::Test { only, .. } if !only.is_empty() => plan::only(&only),
        Task::Test { all: true, .. } => plan::test_all(),
        Task::Test { all: false, .. } => plan::test(),
        Task::Tidy => plan::tidy(),
        Task::Release => plan::release(),
        Task::Play { bench } => play::steps(bench),
        Task::Lab => lab::steps(),
        Task::Bless { parts } => bless::steps(&parts),
    };
    steps::run_all(&steps, workspace)
}
