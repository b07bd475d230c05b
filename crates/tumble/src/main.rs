//! The `tumble` command.

mod commands;
mod told;
mod tools;

use std::process::ExitCode;

use clap::Parser;
use commands::Ending;
use tools::say::tell;
use tumble_scene::printable_lines;

fn main() -> ExitCode {
    match commands::Command::try_parse() {
        Ok(command) => command.run(),
        Err(error) => refuse(&error),
    }
}

/// Says what is wrong with a command line, or gives the help that was asked for.
fn refuse(error: &clap::Error) -> ExitCode {
    let text = error.render().to_string();
    // It quotes what was typed, and is left to itself only where a terminal may have that.
    if printable_lines(&text) == text {
        error.exit();
    }
    tell!("{}", text.trim_end());
    ExitCode::from(Ending::Mistake as u8)
}
