//! Generated pages opened in headless Chromium: a screenshot each, no console error, no request to a network.
//!
//! The checking itself is `xtask/browser/check.mjs`. Before it is believed it has to pass a good page and to refuse
//! bad ones, those in `xtask/browser/selftest/`.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, bail};

use crate::command::{Process, find};
use crate::dead_links;
use crate::debian;
use crate::workspace::{Workspace, copy, read};

/// Copied next to the installed packages, so that the script finds them and the repository stays clean.
const SCRIPT_FILES: [&str; 10] = [
    "access.mjs",
    "bench.mjs",
    "check.mjs",
    "common.mjs",
    "engine.mjs",
    "play.mjs",
    "scene.mjs",
    "package.json",
    "package-lock.json",
    ".npmrc",
];

/// The status of `check.mjs` for pages with faults; any other failure is the tool's own.
const FAULTY: i32 = 1;

/// Checks the checker, then the pages of the gallery.
pub(crate) fn run(workspace: &Workspace) -> Result<()> {
    let checker = Checker::prepare(workspace)?;
    checker.check_itself(workspace)?;
    let folder = gallery(workspace)?;
    let pages = pages_below(&folder)?;
    if pages.is_empty() {
        bail!("`tumble gallery` wrote no page");
    }
    dead_links::refuse(&folder, &pages)?;
    let status = checker.check(&pages)?;
    println!("screenshots are in {}", checker.screenshots.display());
    if status != Some(0) {
        bail!("a generated page is at fault, see above");
    }
    Ok(())
}

/// Chromium, and the scripts with what they need.
pub(crate) struct Checker {
    folder: PathBuf,
    chromium: PathBuf,
    screenshots: PathBuf,
}

impl Checker {
    /// Installs what is missing.
    pub(crate) fn prepare(workspace: &Workspace) -> Result<Self> {
        let chromium = debian::chosen("CHROMIUM", "chromium", "chromium", workspace)?;
        let folder = install_script(workspace)?;
        let screenshots = workspace.empty_scratch("screenshots")?;
        Ok(Self { folder, chromium, screenshots })
    }

    /// A script, to be run.
    pub(crate) fn node(&self, script: &str) -> Process {
        Process::new("node", &self.folder).arg(script)
    }

    pub(crate) fn chromium(&self) -> &Path {
        &self.chromium
    }

    /// The exit status for these pages; 0 says they are good.
    fn check(&self, pages: &[PathBuf]) -> Result<Option<i32>> {
        let status =
            self.node("check.mjs").arg(&self.chromium).arg(&self.screenshots).args(pages).status()?;
        Ok(status.code())
    }

    fn check_itself(&self, workspace: &Workspace) -> Result<()> {
        for page in pages_below(&workspace.path("xtask/browser/selftest"))? {
            let expected = if page.ends_with("good.html") { 0 } else { FAULTY };
            let status = self.check(std::slice::from_ref(&page))?;
            if status != Some(expected) {
                bail!("{}: expected status {expected}, got {status:?}", page.display());
            }
        }
        println!("the checker passes the good page and refuses the bad ones");
        Ok(())
    }
}

fn install_script(workspace: &Workspace) -> Result<PathBuf> {
    for program in ["node", "npm"] {
        find(program)
            .with_context(|| format!("`{program}` is missing: install Node.js 20.15 or later with npm"))?;
    }
    let folder = workspace.scratch("browser")?;
    let installed = is_installed(&folder, workspace);
    for file in SCRIPT_FILES {
        copy(&workspace.path("xtask/browser").join(file), &folder.join(file))?;
    }
    if !installed {
        Process::new("npm", &folder).args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]).run()?;
    }
    Ok(folder)
}

/// Whether the packages in `folder` are those of the committed lock file.
fn is_installed(folder: &Path, workspace: &Workspace) -> bool {
    let lock = "package-lock.json";
    let wanted = read(&workspace.path("xtask/browser").join(lock)).ok();
    let have = read(&folder.join(lock)).ok();
    folder.join("node_modules/.package-lock.json").is_file() && wanted.is_some() && wanted == have
}

/// Where the gallery is; generated once, whoever asks first.
pub(crate) fn gallery(workspace: &Workspace) -> Result<PathBuf> {
    static DONE: AtomicBool = AtomicBool::new(false);
    if DONE.swap(true, Ordering::Relaxed) {
        return workspace.scratch("gallery");
    }
    let folder = workspace.empty_scratch("gallery")?;
    let tumble = ["run", "--quiet", "--locked", "--package", "tumble", "--", "gallery", "--out"];
    workspace.cargo(tumble).arg(&folder).run()?;
    Ok(folder)
}

fn pages_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut pages = Vec::new();
    collect_pages(folder, &mut pages)?;
    pages.sort();
    Ok(pages)
}

fn collect_pages(folder: &Path, pages: &mut Vec<PathBuf>) -> Result<()> {
    let entries = fs::read_dir(folder).with_context(|| format!("cannot list {}", folder.display()))?;
    for entry in entries {
        let path = entry.with_context(|| format!("cannot list {}", folder.display()))?.path();
        if path.is_dir() {
            collect_pages(&path, pages)?;
        } else if path.extension() == Some(OsStr::new("html")) {
            pages.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_selftest_has_a_good_page_and_bad_ones() {
        let workspace = Workspace::find().unwrap();
        let pages = pages_below(&workspace.path("xtask/browser/selftest")).unwrap();
        assert!(pages.len() >= 3);
        assert_eq!(pages.iter().filter(|page| page.ends_with("good.html")).count(), 1);
    }
}
