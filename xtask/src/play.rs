//! Pages that play: the engine of the repository and one that is built afresh against the native program, in Node, and the panel of
//! reports in headless Chromium and Firefox.

use std::path::Path;

use anyhow::Result;

use crate::browser::{self, Checker};
use crate::debian;
use crate::lab;
use crate::steps::Step;
use crate::workspace::Workspace;

/// What holds them against the program, in `xtask/browser`.
const ENGINE: &str = "engine.mjs";
/// How a page unpacks the engine.
const UNPACK: &str = "crates/tumble-report/src/report/assets/lab-unpack.js";
/// Moves sliders of every scene, in every browser.
const PLAY: &str = "play.mjs";
/// Edits a scene, and takes away what can be saved.
const EDIT: &str = "scene.mjs";
/// Whether everybody can use them.
const ACCESS: &str = "access.mjs";
/// How long it takes.
const BENCH: &str = "bench.mjs";

/// Runs all of them.
pub(crate) fn run(workspace: &Workspace) -> Result<()> {
    lab::refuse_stale(workspace)?;
    let checker = Checker::prepare(workspace)?;
    engines(workspace, &checker)?;
    pages(workspace)
}

/// The command `cargo xtask play`: pages alone, or how long they take.
pub(crate) fn steps(bench: bool) -> Vec<Step> {
    match bench {
        true => vec![Step { name: "bench", run: measured }],
        false => vec![Step { name: "pages", run: pages }],
    }
}

/// Reports in browsers.
fn pages(workspace: &Workspace) -> Result<()> {
    let checker = Checker::prepare(workspace)?;
    let firefox = debian::chosen("FIREFOX", "firefox-esr", "firefox-esr", workspace)?;
    let gallery = browser::gallery(workspace)?;
    workspace.cargo(["build", "--quiet", "--locked", "--package", "tumble"]).run()?;
    let (tumble, scenes) = (workspace.target().join("debug/tumble"), workspace.path("scenes"));
    let browsers = [checker.chromium(), &firefox];
    checker.node(PLAY).args([&tumble, &gallery, &scenes]).args(browsers).run()?;
    checker.node(ACCESS).arg(checker.chromium()).arg(&gallery).run()?;
    let folder = workspace.empty_scratch("play")?;
    checker.node(EDIT).arg(checker.chromium()).args([&tumble, &folder, &scenes]).run()
}

/// How long a page takes from a slider to its picture and to its numbers, and how large it is; of the program as it is released.
fn measured(workspace: &Workspace) -> Result<()> {
    let checker = Checker::prepare(workspace)?;
    let folder = workspace.empty_scratch("bench")?;
    let tumble = ["run", "--quiet", "--release", "--locked", "--package", "tumble", "--", "gallery", "--out"];
    workspace.cargo(tumble).arg(&folder).run()?;
    checker.node(BENCH).arg(checker.chromium()).arg(&folder).run()
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
