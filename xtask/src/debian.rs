//! Programs that a fresh machine lacks, installed from Debian's packages.

use std::env;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use crate::command::{Process, find};
use crate::workspace::Workspace;

/// The file of `program`; `package` is installed first when the program is missing.
pub(crate) fn program(program: &str, package: &str, workspace: &Workspace) -> Result<PathBuf> {
    if let Some(file) = find(program) {
        return Ok(file);
    }
    println!("`{program}` is missing");
    install(package, workspace)?;
    find(program).with_context(|| {
        format!("package `{package}` is installed but `{program}` is not on the search path")
    })
}

/// Installs a package, as root or through sudo, and says so.
pub(crate) fn install(package: &str, workspace: &Workspace) -> Result<()> {
    if find("apt-get").is_none() {
        bail!("there is no apt-get here: install what Debian calls `{package}` and run this again");
    }
    println!("installing Debian's package `{package}`");
    apt(workspace)?.args(["update", "-q"]).run()?;
    apt(workspace)?.args(["install", "-y", "-q", package]).run()
}

fn apt(workspace: &Workspace) -> Result<Process> {
    let environment = "DEBIAN_FRONTEND=noninteractive";
    let process = match (is_root(workspace)?, find("sudo")) {
        (true, _) => Process::new("env", workspace.root()),
        (false, Some(sudo)) => Process::new(sudo, workspace.root()).args(["--non-interactive", "env"]),
        (false, None) => bail!("installing a package needs root or sudo"),
    };
    Ok(process.args([environment, "apt-get"]))
}

fn is_root(workspace: &Workspace) -> Result<bool> {
    Ok(Process::new("id", workspace.root()).arg("-u").output()?.trim() == "0")
}

/// A program named by an environment variable, else found or installed as by [`program`].
pub(crate) fn chosen(variable: &str, name: &str, package: &str, workspace: &Workspace) -> Result<PathBuf> {
    match env::var_os(variable) {
        Some(file) => Ok(PathBuf::from(file)),
        None => program(name, package, workspace),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_there_is_not_installed() {
        let workspace = Workspace::find().unwrap();
        assert!(program("sh", "no-such-package", &workspace).unwrap().is_file());
    }
}
