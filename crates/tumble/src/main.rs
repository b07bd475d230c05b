//! The `tumble` command.

mod commands;
mod tools;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    commands::Command::parse().run()
}
