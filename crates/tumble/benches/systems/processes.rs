//! What a user waits for: from a scene's text to equations, cold processes, large sweeps and their memory.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{fs, thread};

use crate::measure::{Patience, in_turn, timed};
use tempfile::TempDir;

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/01-pendulum-in-the-wind/scene.toml");
/// The sweep in that scene, which a larger one takes the place of.
const ITS_SWEEP: &str = r#"T = ["0.5 s", "1 s", "2 s", "4 s"]"#;
const LARGE_SWEEP: &str = r#"T = { from = "0.5 s", to = "4 s", count = 500 }"#;
/// Runs of the cold process.
const COLD_RUNS: u32 = 20;
/// Clock ticks a second in /proc, fixed by Linux's interface.
const TICKS: f64 = 100.0;
/// How often a process is asked for its memory.
const LOOK: Duration = Duration::from_millis(2);
/// Targets: ms from text to equations, s of processor time of the large sweep.
const MOST_MILLIS: f64 = 0.3;
const MOST_SECONDS: f64 = 1.0;

pub(crate) fn tables(is_long: bool) {
    println!();
    to_equations(Patience::of(is_long));
    cold();
    if is_long {
        large_sweep();
        memory();
    }
}

/// A scene's text to a study with its equations.
fn to_equations(patience: Patience) {
    let text = fs::read_to_string(SCENE).expect("the scene");
    let work = || {
        let study = tumble_scene::read("scene", &text, &[]).expect("a scene without mistakes");
        study.equations().clone()
    };
    let [time] = in_turn(patience, [&mut || timed(work)]);
    let millis = time.as_secs_f64() * 1e3;
    println!("text of the wind pendulum to equations: {millis:.2} ms (target {MOST_MILLIS})");
}

/// Processor time of the command from a cold start to its tables, figures left out.
fn cold() {
    let out = folder();
    let spent = processor_time(|| {
        for _ in 0..COLD_RUNS {
            run(Path::new(SCENE), out.path()).wait().expect("the command ends");
        }
    });
    tell(spent, |spent| {
        let each = 1e3 * spent / f64::from(COLD_RUNS);
        format!(
            "cold process, four runs of the wind pendulum with their tables: {each:.1} ms of processor time"
        )
    });
}

/// Processor time of a sweep of 500 periods with its tables.
fn large_sweep() {
    let out = folder();
    let text = fs::read_to_string(SCENE).expect("the scene");
    assert!(text.contains(ITS_SWEEP), "the sweep of the scene is another one");
    let scene = written(&out, &text.replace(ITS_SWEEP, LARGE_SWEEP));
    let spent = processor_time(|| {
        run(&scene, out.path()).wait().expect("the command ends");
    });
    tell(spent, |spent| {
        format!(
            "500 periods of the wind pendulum with their tables: {spent:.2} s of processor time (target {MOST_SECONDS})"
        )
    });
}

/// The greatest memory of sweeps of more and more short runs.
fn memory() {
    for runs in [100, 1000, 10_000] {
        let out = folder();
        let scene = written(&out, &SHORT_THROWS.replace("RUNS", &runs.to_string()));
        match peak(&mut run(&scene, out.path())) {
            Some(kilobytes) => println!("memory of a sweep of {runs:>5} runs: {:.1} MB", kilobytes / 1e3),
            None => return println!("the memory of processes is only measured on Linux"),
        }
    }
}

const SHORT_THROWS: &str = r#"
version = 1
[parameters]
v = "1 m/s"
[world]
gravity = "9.81 m/s^2"
[body.stone]
point = {}
mass = "1 kg"
start = { velocity = ["v", "2 m/s"] }
[drag.air]
at = "stone.cm"
quadratic = "0.01 kg/m"
[run]
until = "0.2 s"
[output]
every = "0.1 s"
[sweep]
v = { from = "1 m/s", to = "5 m/s", count = RUNS }
[find.height]
that = "stone.y"
at = "its greatest"
"#;

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn written(folder: &TempDir, scene: &str) -> PathBuf {
    let path = folder.path().join("scene.toml");
    fs::write(&path, scene).expect("writable");
    path
}

/// The command on a scene, without figures, on two cores.
fn run(scene: &Path, out: &Path) -> std::process::Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tumble"));
    command.args(["run", "--no-figures", "--jobs", "2"]).arg(scene).arg("--out").arg(out.join("out"));
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the command starts")
}

/// Most memory that a process ever has, kB; it is waited for.
fn peak(process: &mut std::process::Child) -> Option<f64> {
    let status = format!("/proc/{}/status", process.id());
    let mut most = None;
    while process.try_wait().expect("the command ends").is_none() {
        // A process that has just ended has none any more.
        most = fs::read_to_string(&status).ok().and_then(|text| high_water(&text)).or(most);
        thread::sleep(LOOK);
    }
    most
}

fn high_water(status: &str) -> Option<f64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}

fn tell(spent: Option<f64>, words: impl FnOnce(f64) -> String) {
    println!("{}", spent.map_or("processor time is only measured on Linux".to_owned(), words));
}

/// Processor time, s, of the processes that some work has started and waited for.
fn processor_time(work: impl FnOnce()) -> Option<f64> {
    let before = children_seconds();
    work();
    Some(children_seconds()? - before?)
}

/// User and system time of finished children, s.
fn children_seconds() -> Option<f64> {
    let stat = fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |index: usize| fields.get(index)?.parse::<f64>().ok();
    Some((ticks(13)? + ticks(14)?) / TICKS)
}
