//! Reference numbers: computed by scripts in `references/`, committed, and computed again here.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};

use crate::command::Process;
use crate::debian;
use crate::workspace::{Workspace, copy, read};

/// A script and the file its output is committed as.
const REFERENCES: &[(&str, &str)] = &[
    ("references/elliptic.py", "crates/tumble/tests/reference/elliptic.json"),
    ("references/elastic.py", "crates/tumble/tests/reference/elastic.json"),
    ("references/chains.py", "crates/tumble/tests/reference/chains.json"),
    ("references/linkages.py", "crates/tumble/tests/reference/linkages.json"),
    ("references/rough.py", "crates/tumble/tests/reference/rough.json"),
    ("references/painleve.py", "crates/tumble/tests/reference/painleve.json"),
    ("references/pin_friction.py", "crates/tumble/tests/reference/pin_friction.json"),
];

const REQUIREMENTS: &str = "references/requirements.txt";

/// Runs every script and fails if an output differs from the committed file.
pub(crate) fn compare(workspace: &Workspace) -> Result<()> {
    let python = python(workspace)?;
    for (script, committed) in REFERENCES {
        let computed = Process::new(&python, workspace.root()).arg(script).output()?;
        same(&computed, &read(&workspace.path(committed))?)
            .with_context(|| format!("{script} does not give {committed}"))?;
        println!("{script} gives {committed}");
    }
    Ok(())
}

/// Runs every script and writes its output over the committed file.
pub(crate) fn write(workspace: &Workspace) -> Result<()> {
    let python = python(workspace)?;
    for (script, committed) in REFERENCES {
        let computed = Process::new(&python, workspace.root()).arg(script).output()?;
        let file = workspace.path(committed);
        std::fs::write(&file, computed).with_context(|| format!("cannot write {}", file.display()))?;
        println!("{committed} written");
    }
    Ok(())
}

/// The interpreter of a virtual environment that has the pinned requirements.
fn python(workspace: &Workspace) -> Result<PathBuf> {
    let folder = workspace.scratch("python")?;
    let python = folder.join("bin/python");
    let installed = folder.join("requirements.txt");
    let wanted = read(&workspace.path(REQUIREMENTS))?;
    if python.is_file() && read(&installed).is_ok_and(|have| have == wanted) {
        return Ok(python);
    }
    create(&workspace.empty_scratch("python")?, workspace)?;
    Process::new(&python, workspace.root())
        .args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "--requirement",
            REQUIREMENTS,
        ])
        .run()?;
    copy(&workspace.path(REQUIREMENTS), &installed)?;
    Ok(python)
}

fn create(folder: &std::path::Path, workspace: &Workspace) -> Result<()> {
    let python = debian::program("python3", "python3", workspace)?;
    let has_pip = Process::new(&python, workspace.root()).args(["-c", "import ensurepip, venv"]).status()?;
    if !has_pip.success() {
        println!("Python's module `venv` is missing");
        debian::install("python3-venv", workspace)?;
    }
    Process::new(&python, workspace.root()).args(["-m", "venv"]).arg(folder).run()
}

fn same(computed: &str, committed: &str) -> Result<()> {
    let mut pairs = computed.lines().zip(committed.lines()).zip(1..);
    if let Some(((new, old), line)) = pairs.find(|((new, old), _)| new != old) {
        bail!("line {line}\n  computed:  {}\n  committed: {}", new.trim(), old.trim());
    }
    if computed != committed {
        bail!("{} lines computed, {} committed", computed.lines().count(), committed.lines().count());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn difference_names_the_line() {
        assert!(same("a\nb\n", "a\nb\n").is_ok());
        assert!(same("a\nb\n", "a\nc\n").unwrap_err().to_string().starts_with("line 2"));
        assert!(same("a\n", "a\nb\n").unwrap_err().to_string().starts_with("1 lines"));
    }
}
