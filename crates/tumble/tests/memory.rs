//! That a sweep takes no more memory the more runs it has.

mod common;

use common::{folder, write};
use peak_alloc::PeakAlloc;
use tumble::{Options, ReportForm, pipeline};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// Runs that are over at once.
const THROWS: &str = r#"
version = 1
world.gravity = "9.81 m/s^2"
run.until = "0.2 s"
output.every = "0.2 s"

[parameters]
v = "1 m/s"

[body.stone]
point = {}
mass = "1 kg"
start = { velocity = ["v", "2 m/s"] }

[sweep]
v = { from = "1 m/s", to = "5 m/s", count = RUNS }
"#;

/// By so many runs there is no more room for what is built for several of them.
const FEW: usize = 2100;
const MANY: usize = 2800;
/// Bytes that are kept of a run: names and hashes of its files.
const MOST: f64 = 300.0;

#[test]
fn memory_does_not_grow_with_the_number_of_runs() {
    let folder = folder();
    let scene = folder.path().join("throws.toml");
    write(&scene, &THROWS.replace("RUNS", &MANY.to_string()));
    let (out, report) = (folder.path().join("out"), ReportForm::None);
    let options = Options { out, report, no_figures: true, ..Options::default() };
    let mut taken = vec![];
    let outcome = pipeline::run_telling(&scene, &options, |_| {
        taken.push(HEAP.current_usage() as f64);
        HEAP.reset_peak_usage();
        Ok(())
    });
    let at_last = HEAP.peak_usage() as f64;
    assert!(outcome.expect("motions").is_success());
    assert_eq!(taken.len(), MANY);
    let most = |runs: usize| taken[..runs].iter().copied().fold(0.0, f64::max);
    let each = (most(MANY) - most(FEW)) / (MANY - FEW) as f64;
    assert!(each < MOST, "{each:.0} bytes a run: {} bytes, then {}", most(FEW), most(MANY));
    let each = (at_last - most(MANY)) / MANY as f64;
    assert!(each < MOST, "{each:.0} bytes a run when all are made: {at_last} bytes");
}
