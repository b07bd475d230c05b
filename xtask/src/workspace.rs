//! Where the workspace is, and where generated things go.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use crate::command::Process;

/// The folders the steps work in.
pub(crate) struct Workspace {
    root: PathBuf,
    target: PathBuf,
}

impl Workspace {
    /// Searches upwards from the current folder.
    pub(crate) fn find() -> Result<Self> {
        let here = env::current_dir().context("no current folder")?;
        let root = here
            .ancestors()
            .find(|folder| folder.join("xtask/Cargo.toml").is_file())
            .with_context(|| format!("{} is not inside the tumble workspace", here.display()))?;
        Ok(Self { root: root.to_owned(), target: target(root) })
    }

    /// The root of the workspace.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Where cargo builds.
    pub(crate) fn target(&self) -> &Path {
        &self.target
    }

    /// A file or folder of the workspace.
    pub(crate) fn path(&self, relative: &str) -> PathBuf {
        self.root.join(relative)
    }

    /// A folder for what the steps install or generate, inside the target folder; created if missing.
    pub(crate) fn scratch(&self, name: &str) -> Result<PathBuf> {
        let folder = self.target.join("xtask").join(name);
        fs::create_dir_all(&folder).with_context(|| format!("cannot create {}", folder.display()))?;
        Ok(folder)
    }

    /// As [`Workspace::scratch`], emptied.
    pub(crate) fn empty_scratch(&self, name: &str) -> Result<PathBuf> {
        let folder = self.scratch(name)?;
        fs::remove_dir_all(&folder).with_context(|| format!("cannot empty {}", folder.display()))?;
        self.scratch(name)
    }

    /// A cargo command in the root of the workspace, by the cargo that runs us.
    pub(crate) fn cargo<const N: usize>(&self, arguments: [&str; N]) -> Process {
        let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        Process::new(cargo, &self.root).args(arguments)
    }
}

fn target(root: &Path) -> PathBuf {
    env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |folder| root.join(folder))
}

/// Reads a text file; an error names it.
pub(crate) fn read(file: &Path) -> Result<String> {
    fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))
}

/// Copies a file, creating the folder it goes to; an error names both.
pub(crate) fn copy(from: &Path, to: &Path) -> Result<()> {
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    }
    fs::copy(from, to).with_context(|| format!("cannot copy {} to {}", from.display(), to.display()))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn found_from_a_crate_folder() {
        let workspace = Workspace::find().unwrap();
        assert!(workspace.path("xtask/src/workspace.rs").is_file());
    }
}
