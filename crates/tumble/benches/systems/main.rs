//! Work and time on systems with known answers, beside a peer in the same run.
//!
//! `cargo bench -p tumble` prints, for each system and accuracy, the time of one run (the least of many, tape included),
//! steps, and the error against the reference; then the time of an eighth-order Runge-Kutta code without events at
//! tolerances tightened until its error is no larger, and the ratio. Then what the parts of an answer cost: building the
//! equations, the bare motion, the same with the enclosures of its steps and their share, and all with the check runs.
//! Last, the processor time of a cold process from a scene's text to its numbers.

mod peer;
mod problems;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use problems::Problem;

/// Runs of each measurement: the least time is the one least disturbed.
const RUNS: usize = 25;
/// Runs of the cold process.
const COLD_RUNS: u32 = 20;
/// Clock ticks a second in /proc, fixed by Linux's interface.
const TICKS: f64 = 100.0;

fn main() {
    println!(
        "{:<26} {:>8} {:>9} {:>6} {:>9} | {:>9} {:>9} {:>6}",
        "system", "accuracy", "us", "steps", "error", "peer us", "error", "ratio"
    );
    for problem in problems::all() {
        for accuracy in [1e-6, 1e-9, 1e-12] {
            row(&problem, accuracy);
        }
    }
    layers();
    cold();
}

/// What the parts of an answer cost: building, the bare motion, what its enclosures add, and the check runs.
fn layers() {
    println!(
        "\n{:<26} {:>8} {:>9} {:>9} {:>9} {:>10} {:>10}",
        "system", "accuracy", "build us", "bare us", "proved us", "enclosures", "trusted us"
    );
    for problem in problems::all() {
        for accuracy in [1e-6, 1e-9, 1e-12] {
            let (build, equations) = least(|| problem.equations());
            let (bare, _) = least(|| problem.states(&equations, accuracy, false));
            let (proved, _) = least(|| problem.states(&equations, accuracy, true));
            let (trusted, _) = least(|| problem.trusted(accuracy));
            println!(
                "{:<26} {accuracy:>8.0e} {:>9.0} {:>9.0} {:>9.0} {:>9.0}% {:>10.0}",
                problem.name,
                micros(build),
                micros(bare),
                micros(proved),
                100.0 * (1.0 - bare.as_secs_f64() / proved.as_secs_f64()),
                micros(trusted),
            );
        }
    }
}

fn row(problem: &Problem, accuracy: f64) {
    let (ours, (error, steps)) = least(|| {
        let run = problem.run(accuracy);
        (problem.error(&run), run.trajectory.work.steps)
    });
    let (theirs, their_error) = peer::at_error(problem, error.max(1e-15));
    println!(
        "{:<26} {accuracy:>8.0e} {:>9.0} {steps:>6} {error:>9.1e} | {:>9.0} {their_error:>9.1e} {:>6.2}",
        problem.name,
        micros(ours),
        micros(theirs),
        theirs.as_secs_f64() / ours.as_secs_f64(),
    );
}

/// The least time of many runs, with what the last one gave.
pub(crate) fn least<T>(mut work: impl FnMut() -> T) -> (Duration, T) {
    let mut timed = || {
        let began = Instant::now();
        let result = work();
        (began.elapsed(), result)
    };
    let first = timed();
    (1..RUNS).map(|_| timed()).fold(first, |best, next| (best.0.min(next.0), next.1))
}

fn micros(time: Duration) -> f64 {
    time.as_secs_f64() * 1e6
}

/// Processor time of the command from a cold start to its tables, figures left out.
fn cold() {
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/01-pendulum-in-the-wind/scene.toml");
    let out = tempfile::tempdir().expect("a temporary folder");
    let before = children_seconds();
    for _ in 0..COLD_RUNS {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tumble"));
        command.args(["run", "--no-figures", scene, "--out"]).arg(out.path()).stdout(Stdio::null());
        assert!(command.status().expect("the command starts").success());
    }
    match (before, children_seconds()) {
        (Some(before), Some(after)) => {
            let each = 1e3 * (after - before) / f64::from(COLD_RUNS);
            println!(
                "\ncold process, four runs of the wind pendulum with their tables: {each:.1} ms of processor time"
            );
        }
        _ => println!("\nprocessor time of the cold process is only measured on Linux"),
    }
}

/// User and system time of finished children, s.
fn children_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = stat.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |index: usize| fields.get(index)?.parse::<f64>().ok();
    Some((ticks(13)? + ticks(14)?) / TICKS)
}
