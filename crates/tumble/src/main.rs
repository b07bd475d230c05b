//! The `tumble` command.

mod commands;
mod tools;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match commands::Command::try_parse() {
        Ok(command) => command.run(),
        Err(error) => commands::explain(&error),
    }
}
