//! Child processes whose failure names the command that failed.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

use anyhow::{Context, Result, bail};

/// A child process. It reads nothing; it writes to our own output unless [`Process::output`] captures it.
pub(crate) struct Process(Command);

impl Process {
    /// `program` run in `folder`.
    pub(crate) fn new(program: impl AsRef<OsStr>, folder: &Path) -> Self {
        let mut command = Command::new(program);
        command.current_dir(folder).stdin(Stdio::null());
        Self(command)
    }

    /// With one more argument.
    pub(crate) fn arg(mut self, argument: impl AsRef<OsStr>) -> Self {
        self.0.arg(argument);
        self
    }

    /// With more arguments.
    pub(crate) fn args(mut self, arguments: impl IntoIterator<Item = impl AsRef<OsStr>>) -> Self {
        self.0.args(arguments);
        self
    }

    /// With an environment variable.
    pub(crate) fn env(mut self, name: &str, value: &str) -> Self {
        self.0.env(name, value);
        self
    }

    /// Runs to the end; a status other than 0 is an error.
    pub(crate) fn run(self) -> Result<()> {
        let text = self.text();
        succeeded(self.status()?, &text)
    }

    /// Runs to the end and returns the status, whatever it is.
    pub(crate) fn status(mut self) -> Result<ExitStatus> {
        let text = self.text();
        self.0.status().with_context(|| format!("cannot start `{text}`"))
    }

    /// Runs to the end and returns what was written to the standard output.
    pub(crate) fn output(mut self) -> Result<String> {
        let text = self.text();
        self.0.stderr(Stdio::inherit());
        let output = self.0.output().with_context(|| format!("cannot start `{text}`"))?;
        succeeded(output.status, &text)?;
        String::from_utf8(output.stdout).with_context(|| format!("output of `{text}` is not UTF-8"))
    }

    fn text(&self) -> String {
        let words = std::iter::once(self.0.get_program()).chain(self.0.get_args());
        words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
    }
}

fn succeeded(status: ExitStatus, text: &str) -> Result<()> {
    if !status.success() {
        bail!("`{text}`: {status}");
    }
    Ok(())
}

/// The file that `program` names on the search path.
pub(crate) fn find(program: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(program)).find(|file| file.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failure_names_the_command() {
        let error = Process::new("sh", Path::new(".")).args(["-c", "exit 3"]).run().unwrap_err();
        assert!(error.to_string().contains("`sh -c exit 3`"), "{error}");
    }

    #[test]
    fn output_is_captured() {
        let text = Process::new("sh", Path::new(".")).args(["-c", "echo one"]).output().unwrap();
        assert_eq!(text, "one\n");
    }

    #[test]
    fn search_path() {
        assert!(find("sh").is_some());
        assert!(find("no-such-program-anywhere").is_none());
    }
}
