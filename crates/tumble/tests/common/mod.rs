//! What several tests need: the files of the repository, a folder to work in, and the command.

// Each test uses a part of this.
#![allow(dead_code)]

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, OnceLock};

use tempfile::TempDir;
use tumble::ReportForm;
use tumble::pipeline::{self, Options, Outcome};

/// A file of the repository.
pub(crate) fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// Every scene of the repository, by the name of its folder.
pub(crate) fn scenes() -> Vec<(String, PathBuf)> {
    let folders =
        fs::read_dir(repository("scenes")).expect("scenes").map(|entry| entry.expect("readable").path());
    let scenes = folders.map(|folder| (name_of(&folder), folder.join("scene.toml")));
    let mut found: Vec<_> = scenes.filter(|(_, scene)| scene.is_file()).collect();
    found.sort();
    assert!(!found.is_empty(), "there are scenes");
    found
}

/// What came out of every scene of the repository, with its report: run once, on all processors, for all tests that look at it.
pub(crate) fn gallery() -> &'static [(String, Outcome)] {
    static GALLERY: OnceLock<Vec<(String, Outcome)>> = OnceLock::new();
    GALLERY.get_or_init(run_all)
}

fn run_all() -> Vec<(String, Outcome)> {
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gallery");
    // Nothing of an earlier run is to be taken for one of this.
    if out.exists() {
        fs::remove_dir_all(&out).expect("a folder of these tests");
    }
    let options = Options { out, report: ReportForm::Html, ..Options::default() };
    let scenes = scenes();
    let (left, found) = (Mutex::new(scenes.into_iter()), Mutex::new(vec![]));
    let next = || left.lock().expect("scenes").next();
    let run = || {
        while let Some((name, scene)) = next() {
            let outcome = pipeline::run(&scene, &options).unwrap_or_else(|error| panic!("{name}: {error}"));
            found.lock().expect("outcomes").push((name, outcome));
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, NonZero::get);
    std::thread::scope(|scope| (0..workers).for_each(|_| _ = scope.spawn(run)));
    let mut found = found.into_inner().expect("outcomes");
    found.sort_by(|(one, _), (other, _)| one.cmp(other));
    found
}

fn name_of(path: &Path) -> String {
    path.file_name().expect("a name").to_string_lossy().into_owned()
}

/// Copies every scene with the files beside it, lessons left out.
pub(crate) fn copy_scenes(to: &Path) {
    for (name, scene) in scenes() {
        let folder = scene.parent().expect("a folder");
        for entry in fs::read_dir(folder).expect("a folder") {
            let file = entry.expect("readable").path();
            if file.extension().is_some_and(|ending| ending != "md") {
                write(&to.join(&name).join(name_of(&file)), &read(&file));
            }
        }
    }
}

/// What is wrong with the runs of a scene: why each stopped early, and the checks that do not hold.
pub(crate) fn failures(outcome: &Outcome) -> Vec<String> {
    let of_case = |case: &tumble::Finished| {
        let refusal = case.refusal.iter().map(ToString::to_string);
        let checks = case.checks.iter().filter(|check| !check.holds).map(|check| format!("{check:?}"));
        let found: Vec<_> = refusal.chain(checks).collect();
        (!found.is_empty()).then(|| format!("{} {}: {}", case.folder(), case.label, found.join("; ")))
    };
    outcome.cases.iter().filter_map(of_case).collect()
}

/// An empty folder that is removed afterwards.
pub(crate) fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// Writes a file and the folders above it.
pub(crate) fn write(path: &Path, text: &str) {
    fs::create_dir_all(path.parent().expect("a folder")).expect("writable");
    fs::write(path, text).expect("writable");
}

/// Reads a file.
pub(crate) fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What the command writes, run in a folder with its output not on a terminal.
pub(crate) fn tumble(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tumble"));
    command.current_dir(folder).env_remove("COLUMNS").args(arguments);
    command.output().expect("the command starts")
}

/// Text of a stream.
pub(crate) fn text(stream: &[u8]) -> String {
    String::from_utf8(stream.to_vec()).expect("UTF-8")
}
