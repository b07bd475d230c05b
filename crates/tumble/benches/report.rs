//! What a report costs beyond the numbers: `cargo bench -p tumble --bench report`.
//!
//! For each of the four systems, of 20, 1.2, 5 and 1 s, some of them with several runs: the least time of some runs with tables only, with the
//! figures and the balance, and with the report too.

use std::path::Path;
use std::time::{Duration, Instant};

use tumble::ReportForm;
use tumble::pipeline::{self, Options};

/// Runs of each measurement: the least time is the one least disturbed.
const RUNS: usize = 7;

const SCENES: [&str; 4] = ["01-pendulum-in-the-wind", "02-thrown-rod", "03-bouncing-rod", "04-kicked-ball"];

fn main() {
    println!("{:<26} {:>11} {:>11} {:>11} {:>10}", "scene", "numbers ms", "figures ms", "report ms", "bytes");
    for scene in SCENES {
        let time = |no_figures, form| least(scene, no_figures, form);
        let (numbers, _) = time(true, ReportForm::None);
        let (figures, _) = time(false, ReportForm::None);
        let (all, bytes) = time(false, ReportForm::Html);
        let more = |than: Duration, time: Duration| millis(time) - millis(than);
        println!(
            "{scene:<26} {:>11.1} {:>11.1} {:>11.1} {bytes:>10}",
            millis(numbers),
            more(numbers, figures),
            more(figures, all)
        );
    }
}

/// The least time of a scene's runs, and the size of its report.
fn least(scene: &str, no_figures: bool, report: ReportForm) -> (Duration, u64) {
    let path = format!("{}/../../scenes/{scene}/scene.toml", env!("CARGO_MANIFEST_DIR"));
    let out = tempfile::tempdir().expect("a temporary folder");
    let options = Options { out: out.path().to_owned(), no_figures, report, ..Options::default() };
    let mut best = Duration::MAX;
    for _ in 0..RUNS {
        let began = Instant::now();
        let outcome = pipeline::run(Path::new(&path), &options).expect("a motion");
        assert!(outcome.is_success());
        best = best.min(began.elapsed());
    }
    let page = out.path().join(scene).join("report.html");
    (best, page.metadata().map_or(0, |about| about.len()))
}

fn millis(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
