//! The lists of steps behind `check`, `test` and `tidy`.

use anyhow::Result;

use crate::steps::Step;
use crate::workspace::Workspace;
use crate::{browser, play, references, release, tidy};

const FORMATTING: Step = Step { name: "formatting", run: formatting };
const LINTS: Step = Step { name: "lints", run: lints };
const TESTS: Step = Step { name: "tests", run: tests };
const DOCUMENTATION: Step = Step { name: "documentation", run: documentation };
const TIDY: Step = Step { name: "tidy", run: tidy::run };
const REFERENCES: Step = Step { name: "references", run: references::compare };
const PACKAGES: Step = Step { name: "packages", run: release::packages };
const RELEASE: Step = Step { name: "release", run: release::program };
const PLAY: Step = Step { name: "play", run: play::run };
const BROWSER: Step = Step { name: "browser", run: browser::run };

/// The quick look before a commit.
pub(crate) fn check() -> Vec<Step> {
    vec![FORMATTING, LINTS]
}

/// What says whether the program does what it should.
pub(crate) fn test() -> Vec<Step> {
    vec![FORMATTING, TESTS, TIDY]
}

/// [`check()`], [`test()`] and what needs Python, Node and Chromium, or takes long.
pub(crate) fn test_all() -> Vec<Step> {
    let rust = vec![FORMATTING, LINTS, TESTS, DOCUMENTATION, TIDY];
    rust.into_iter().chain([PACKAGES, REFERENCES, BROWSER, PLAY]).collect()
}

/// The names that [`only`] knows.
pub(crate) fn step_names() -> Vec<&'static str> {
    test_all().iter().map(|step| step.name).collect()
}

/// The steps that are named.
pub(crate) fn only(names: &[String]) -> Vec<Step> {
    test_all().into_iter().filter(|step| names.iter().any(|name| name == step.name)).collect()
}

/// The program for others.
pub(crate) fn release() -> Vec<Step> {
    vec![RELEASE]
}

/// The house rules alone.
pub(crate) fn tidy() -> Vec<Step> {
    vec![TIDY]
}

fn formatting(workspace: &Workspace) -> Result<()> {
    workspace.cargo(["fmt", "--all", "--check"]).run()
}

/// Of the workspace, and of the facade without its features.
fn lints(workspace: &Workspace) -> Result<()> {
    workspace.cargo(["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"]).run()?;
    let bare = ["clippy", "-p", "tumble", "--no-default-features", "--all-targets", "--locked"];
    workspace.cargo(bare).args(["--", "-D", "warnings"]).run()
}

/// Unit, property, scene and document tests in one build.
fn tests(workspace: &Workspace) -> Result<()> {
    workspace.cargo(["test", "--workspace", "--locked", "--no-fail-fast"]).run()
}

fn documentation(workspace: &Workspace) -> Result<()> {
    workspace.cargo(["doc", "--workspace", "--no-deps", "--locked"]).env("RUSTDOCFLAGS", "-D warnings").run()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_chooses_one_step() {
        for name in step_names() {
            assert_eq!(only(&[name.to_owned()]).len(), 1, "{name}");
        }
    }
}
