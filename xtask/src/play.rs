//! Pages that play: the engine of the repository and one that is built afresh against the native program, in Node, and the panel of
//! reports in headless Chromium.

use std::path::Path;

use anyhow::Result;

use crate::browser::Checker;
use crate::lab;
use crate::workspace::Workspace;

/// What holds them against the program, in `xtask/browser`.
const ENGINE: &str = "engine.mjs";
/// How a page unpacks the engine.
const UNPACK: &str = "crates/tumble-report/src/report/assets/lab-unpack.js";
/// Moves sliders, and edits scenes, in a browser.
const PAGES: [&str; 2] = ["play.mjs", "scene.mjs"];

/// Runs all of them.
pub(crate) fn run(workspace: &Workspace) -> Result<()> {
    lab::refuse_stale(workspace)?;
    let checker = Checker::prepare(workspace)?;
    engines(workspace, &checker)?;
    workspace.cargo(["build", "--quiet", "--locked", "--package", "tumble"]).run()?;
    let (tumble, scenes) = (workspace.target().join("debug/tumble"), workspace.path("scenes"));
    for page in PAGES {
        let folder = workspace.empty_scratch("play")?;
        checker.node(page).arg(checker.chromium()).args([&tumble, &folder, &scenes]).run()?;
    }
    Ok(())
}

/// Every number of every scene is the same natively, in the engine of the repository, and in one of today.
fn engines(workspace: &Workspace, checker: &Checker) -> Result<()> {
    let folder = workspace.empty_scratch("messages")?;
    let native = ["run", "--quiet", "--locked", "--package", "tumble-lab", "--example", "messages", "--"];
    workspace.cargo(native).args([&workspace.path("scenes"), &folder]).run()?;
    let unpack = workspace.path(UNPACK);
    let compare = |engine: &Path| checker.node(ENGINE).args([engine, &folder, &unpack]).run();
    compare(&workspace.path(lab::ENGINE))?;
    compare(&lab::build(workspace)?)
}
