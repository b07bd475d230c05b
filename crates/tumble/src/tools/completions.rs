//! `tumble completions SHELL`: what a shell needs to complete the command.

use clap::CommandFactory;
use clap_complete::Shell;

use super::say;
use crate::commands::{Command, Ending};

/// Prints the script of a shell.
pub(crate) fn run(shell: Shell) -> Ending {
    let mut script = vec![];
    clap_complete::generate(shell, &mut Command::command(), "tumble", &mut script);
    say::script(String::from_utf8_lossy(&script).trim_end());
    Ending::Success
}
