//! The report as PDF, read back with Poppler: it says what the summary says, and what a scene calls itself.
#![cfg(feature = "pdf")]

mod common;

use std::path::Path;
use std::process::Command;

use common::{folder, read, repository, text, write};
use serde_json::Value;
use tumble::ReportForm;
use tumble::pipeline::{self, Options, Outcome};

/// A file that is mailed.
const LARGEST: u64 = 2 << 20;

fn run(scene: &Path, out: &Path) -> Outcome {
    let options = Options { out: out.to_owned(), report: ReportForm::Pdf, ..Options::default() };
    pipeline::run(scene, &options).expect("a motion and its report")
}

/// What a program of Poppler says of the report.
fn poppler(program: &str, outcome: &Outcome) -> String {
    let mut command = Command::new(program);
    command.arg(outcome.folder.join("report.pdf"));
    if program == "pdftotext" {
        command.arg("-");
    }
    let output = command.output().unwrap_or_else(|error| panic!("{program} of poppler-utils: {error}"));
    assert!(output.status.success(), "{program}: {}", text(&output.stderr));
    text(&output.stdout)
}

/// Without blanks: lines break anywhere.
fn joined(text: &str) -> String {
    text.split_whitespace().collect()
}

/// The first scenes, each with a piece of its equations as a PDF holds them: in letters for mathematics.
const SCENES: [(&str, &str); 4] = [
    ("01-pendulum-in-the-wind", "sin𝜃"),
    ("02-thrown-rod", "𝑀𝐴𝑥=𝐹air,x"),
    ("03-bouncing-rod", "𝑚𝐴𝑦=−𝑚𝑔"),
    ("04-kicked-ball", "𝑀𝐴𝑥=𝐹"),
];

#[test]
fn it_says_what_the_summary_says() {
    for (scene, equation) in SCENES {
        let out = folder();
        let outcome = run(&repository(&format!("scenes/{scene}/scene.toml")), out.path());
        let size = outcome.folder.join("report.pdf").metadata().expect("a file").len();
        assert!(size < LARGEST, "{scene}: {size} bytes");
        let shown = joined(&poppler("pdftotext", &outcome));
        for words in [&outcome.study.title, "1 Identify", "2 Model", "3 Solve", "4 Analyze", equation] {
            assert!(shown.contains(&joined(words)), "{scene}: {words}");
        }
        let summary: Value = serde_json::from_str(&read(&outcome.folder.join("summary.json"))).expect("JSON");
        let run = &summary["runs"][0];
        let steps = run["numerics"]["steps"].as_u64().expect("steps");
        assert!(shown.contains(&format!("Steps{steps}")), "{scene}: {steps} steps");
        for check in run["checks"].as_array().expect("checks") {
            let found = format!("{:?}", check["found"].as_f64().expect("a number")).replace('-', "−");
            assert!(shown.contains(&found), "{scene}: {found}");
        }
    }
}

#[test]
fn it_has_a_title_tags_and_pages_of_a4() {
    let out = folder();
    let outcome = run(&repository("scenes/04-kicked-ball/scene.toml"), out.path());
    let info = poppler("pdfinfo", &outcome);
    let has = |key: &str, value: &str| info.lines().any(|line| line.starts_with(key) && line.contains(value));
    assert!(has("Title:", &outcome.study.title), "{info}");
    assert!(has("Tagged:", "yes") && has("Page size:", "(A4)"), "{info}");
    assert!(!info.contains("CreationDate"), "equal runs give equal files: {info}");
}

#[test]
fn what_a_scene_calls_itself_is_shown_and_not_run() {
    let evil = "#panic(x) <script> $ * _ @ ~ = //";
    let scene = read(&repository("scenes/04-kicked-ball/scene.toml"));
    let scene = scene.replacen("title = \"", &format!("title = \"{evil}"), 2);
    let place = folder();
    let file = place.path().join("scene.toml");
    write(&file, &scene);
    let outcome = run(&file, place.path());
    assert!(outcome.study.title.starts_with(evil));
    let shown = joined(&poppler("pdftotext", &outcome));
    assert!(shown.contains(&joined(evil)), "{shown}");
}
