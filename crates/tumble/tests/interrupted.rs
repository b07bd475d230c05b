//! Runs that are given up, killed, or made twice at once: what was finished is there, and nothing is in the way.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::common::{folder, read, write};
use tumble::gallery::{self, GalleryError};
use tumble::{CaseError, Options, PipelineError, pipeline};

/// A sweep whose first two runs are over at once and whose third one takes for ever.
const SWING: &str = r#"
version = 1
title = "A swing"
world.gravity = "9.81 m/s^2"
run.until = "end"

[parameters]
end = "1 s"

[sweep]
end = ["1 s", "2 s", "1e6 s", "3 s"]

[body.rod]
rod = { from = [0, 0], to = [0, "-1 m"] }
mass = "1 kg"
start = { angle = "170 deg" }

[pivot.hinge]
body = "rod"
point = [0, 0]
world = [0, 0]

[plot.angle]
y = "rod.angle"
"#;

fn swing() -> tempfile::TempDir {
    let folder = folder();
    write(&folder.path().join("swing.toml"), SWING);
    folder
}

/// Runs a scene, one run after the other, and wants no more once a file is there.
fn until_there(folder: &Path, scene: &str, file: &str) -> Result<tumble::Outcome, PipelineError> {
    let options = Options { out: folder.join("out"), jobs: NonZeroUsize::new(1), ..Options::default() };
    let (stop, begun) = (Arc::clone(&options.stop), Arc::new(AtomicBool::new(true)));
    std::thread::scope(|scope| {
        let going = Arc::clone(&begun);
        scope.spawn(move || {
            while going.load(Ordering::Relaxed) && !is_being_written(&folder.join("out"), file) {
                std::thread::yield_now();
            }
            stop.store(true, Ordering::Relaxed);
        });
        let outcome = pipeline::run(&folder.join(scene), &options);
        begun.store(false, Ordering::Relaxed);
        outcome
    })
}

/// Whether a folder that is not finished has a file.
fn is_being_written(out: &Path, file: &str) -> bool {
    let entries = fs::read_dir(out).into_iter().flatten().flatten();
    entries
        .map(|entry| entry.path())
        .any(|path| path.extension().is_some_and(|ending| ending == "partial") && path.join(file).exists())
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<_> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_str(&read(&folder.join("out/swing/summary.json"))).expect("JSON")
}

#[test]
fn finished_runs_of_a_sweep_are_kept() {
    let folder = swing();
    let outcome = until_there(folder.path(), "swing.toml", "run-002/balance.csv").expect("two runs");
    assert!(!outcome.is_success());
    assert_eq!(outcome.cases.len(), 2);
    let missing: Vec<_> = outcome.missing.iter().map(|run| (run.number, run.label.as_str())).collect();
    assert_eq!(missing, [(3, "end = 1e6 s"), (4, "end = 3 s")]);
    let summary = summary(folder.path());
    assert_eq!(summary["complete"], false);
    assert_eq!(summary["interrupted"]["finished"], 2);
    assert_eq!(summary["interrupted"]["not_made"][0]["folder"], "run-003");
    assert_eq!(summary["interrupted"]["not_made"][1]["label"], "end = 3 s");
    assert_eq!(summary["runs"].as_array().map(Vec::len), Some(2));
    assert!(summary["runs"][1]["complete"].as_bool().expect("a truth"), "this one was finished");
    let written = names(&folder.path().join("out/swing"));
    assert!(
        written.contains(&"run-002".to_owned()) && !written.contains(&"run-003".to_owned()),
        "{written:?}"
    );
    assert!(
        read(&folder.path().join("out/swing/report.html")).contains("Interrupted: 2 of 4 runs were made")
    );
    assert_eq!(names(&folder.path().join("out")), ["swing"]);
}

#[test]
fn without_a_finished_run_the_last_results_stay() {
    let folder = swing();
    let options = Options {
        out: folder.path().join("out"),
        set: vec![("end".to_owned(), "1 s".to_owned())],
        no_figures: true,
        ..Options::default()
    };
    pipeline::run(&folder.path().join("swing.toml"), &options).expect("a run");
    let before = read(&folder.path().join("out/swing/summary.json"));
    options.stop.store(true, Ordering::Relaxed);
    let interrupted = pipeline::run(&folder.path().join("swing.toml"), &options);
    assert!(matches!(interrupted, Err(PipelineError::Case(CaseError::Interrupted))));
    assert_eq!(read(&folder.path().join("out/swing/summary.json")), before);
    assert_eq!(names(&folder.path().join("out")), ["swing"]);
}

#[test]
fn a_gallery_keeps_its_page() {
    let folder = folder();
    for name in ["01-swing", "02-swing"] {
        write(&folder.path().join("scenes").join(name).join("scene.toml"), SWING);
    }
    let options = Options { out: folder.path().join("out"), ..Options::default() };
    options.stop.store(true, Ordering::Relaxed);
    let mut seen = 0;
    let gallery = gallery::run(&folder.path().join("scenes"), &options, |_| seen += 1);
    let Err(GalleryError::Interrupted { run, all, .. }) = gallery else { panic!("went on") };
    assert_eq!((run, all, seen), (0, 2, 1));
    assert!(names(&folder.path().join("out")).is_empty());
}

#[cfg(unix)]
mod signals {
    use std::process::{Child, Command, Stdio};
    use std::time::{Duration, Instant};

    use crate::common::{text, tumble};

    use super::*;

    /// Longer than anything here takes on a machine that has much else to do.
    const PATIENCE: Duration = Duration::from_secs(120);

    /// The command, running on so many cores, and as far as this file.
    fn started(folder: &Path, jobs: &str, file: &str) -> Child {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tumble"));
        let arguments = ["run", "--jobs", jobs, "swing.toml"];
        command.current_dir(folder).args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped());
        let child = command.spawn().expect("the command starts");
        let begun = Instant::now();
        while !is_being_written(&folder.join("out"), file) {
            assert!(begun.elapsed() < PATIENCE, "{file} is not written");
            std::thread::sleep(Duration::from_millis(5));
        }
        child
    }

    fn signal(child: &Child, name: &str) {
        let status = Command::new("kill").args([name, &child.id().to_string()]).status();
        assert!(status.expect("there is kill").success());
    }

    /// What is said of runs that Ctrl-C ends when they are as far as this file.
    fn interrupted(folder: &Path, jobs: &str, file: &str) -> String {
        let child = started(folder, jobs, file);
        signal(&child, "-INT");
        let output = child.wait_with_output().expect("it ends");
        let said = text(&output.stdout);
        assert_eq!(output.status.code(), Some(130), "{said}");
        said
    }

    #[test]
    fn control_c_says_what_is_kept_and_what_is_not() {
        let folder = swing();
        let said = interrupted(folder.path(), "1", "run-002/balance.csv");
        let says = "  interrupted: 2 of 4 runs finished; results: out/swing; 2 runs were not made\n";
        assert!(said.ends_with(says), "{said}");
        assert_eq!(summary(folder.path())["interrupted"]["finished"], 2);
        assert_eq!(names(&folder.path().join("out")), ["swing"]);
    }

    #[test]
    fn control_c_keeps_what_any_core_has_finished() {
        let folder = swing();
        let said = interrupted(folder.path(), "2", "run-004/balance.csv");
        let says = "  interrupted: 3 of 4 runs finished; results: out/swing; 1 run was not made\n";
        assert!(said.ends_with(says), "{said}");
    }

    #[test]
    fn control_c_before_anything_is_finished() {
        let folder = folder();
        write(
            &folder.path().join("swing.toml"),
            &SWING.replace("end = [\"1 s\", ", "end = [\"1e6 s\", ").replace(", \"1e6 s\", \"3", ", \"3"),
        );
        let child = started(folder.path(), "1", ".tumble-output");
        signal(&child, "-INT");
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(130));
        let said = text(&output.stderr);
        assert!(
            said.ends_with("swing.toml: interrupted: nothing was finished, and nothing is written\n"),
            "{said}"
        );
        assert!(names(&folder.path().join("out")).is_empty());
    }

    #[test]
    fn a_second_run_of_the_same_results_is_refused_while_the_first_goes_on() {
        let folder = swing();
        let mut child = started(folder.path(), "1", "run-002/balance.csv");
        let output = tumble(folder.path(), &["run", "swing.toml", "--set", "end=1s"]);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(4), "{said}");
        assert!(
            said.contains("is writing out/swing: wait until it has ended, or choose another place"),
            "{said}"
        );
        #[cfg(target_os = "linux")]
        assert!(said.contains(&format!("another tumble (process {})", child.id())), "{said}");
        assert!(is_being_written(&folder.path().join("out"), "run-002/balance.csv"), "the first one goes on");
        let elsewhere = ["run", "swing.toml", "--set", "end=1s", "--no-figures", "--out", "other"];
        assert_eq!(tumble(folder.path(), &elsewhere).status.code(), Some(0));
        child.kill().expect("it ends");
        child.wait().expect("it ends");
    }

    #[test]
    fn what_a_killed_run_leaves_is_gone_after_the_next() {
        let folder = swing();
        let child = started(folder.path(), "1", "run-002/balance.csv");
        signal(&child, "-KILL");
        child.wait_with_output().expect("it ends");
        let left = names(&folder.path().join("out"));
        assert!(left.iter().any(|name| name.ends_with(".partial")), "{left:?}");
        let output = tumble(folder.path(), &["run", "swing.toml", "--set", "end=1s", "--no-figures"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        assert_eq!(names(&folder.path().join("out")), ["swing"]);
    }
}
