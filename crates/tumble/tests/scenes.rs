//! Every scene of the repository runs, and what it claims holds.

use std::path::Path;

use crate::common::{failures, folder, read, scenes};
use serde_json::Value;
use tumble::pipeline::{self, Options, Outcome};

fn run(scene: &Path, out: &Path) -> Outcome {
    let options = Options { out: out.to_owned(), ..Options::default() };
    pipeline::run(scene, &options).unwrap_or_else(|error| panic!("{}: {error}", scene.display()))
}

fn summary(outcome: &Outcome) -> Value {
    serde_json::from_str(&read(&outcome.folder.join("summary.json"))).expect("JSON")
}

/// Runs one scene of the repository and returns its summary.
fn summary_of(name: &str) -> Value {
    let out = folder();
    let (_, scene) = scenes().into_iter().find(|(found, _)| found == name).expect("there is such a scene");
    summary(&run(&scene, out.path()))
}

#[test]
fn every_claim_of_every_scene_holds() {
    let out = folder();
    for (name, scene) in scenes() {
        let outcome = run(&scene, out.path());
        assert!(outcome.is_success(), "{name}: {:#?}", failures(&outcome));
        assert!(outcome.cases.iter().all(|case| !case.checks.is_empty()), "{name} claims nothing");
        assert_eq!(outcome.folder, out.path().join(&name));
    }
}

#[test]
fn every_scene_has_its_files() {
    let out = folder();
    for (name, scene) in scenes() {
        let outcome = run(&scene, out.path());
        let pictures =
            outcome.figures.iter().flat_map(|figure| [format!("{figure}.svg"), format!("{figure}.png")]);
        let folders = outcome.cases.iter().map(|case| case.folder());
        let tables =
            folders.flat_map(|run| ["trajectory", "events"].map(|table| format!("{run}/{table}.csv")));
        for file in pictures.chain(tables) {
            let length = std::fs::metadata(outcome.folder.join(&file)).map(|about| about.len());
            assert!(length.is_ok_and(|length| length > 0), "{name}: {file}");
        }
        assert!(!outcome.figures.is_empty(), "{name} shows nothing");
    }
}

#[test]
fn every_summary_says_what_came_out() {
    let out = folder();
    for (name, scene) in scenes() {
        let summary = summary(&run(&scene, out.path()));
        assert_eq!(summary["schema"], "tumble-summary", "{name}");
        assert_eq!(summary["complete"], true, "{name}");
        for (run, number) in runs(&summary).iter().zip(1..) {
            assert_eq!(run["folder"], format!("run-{number:03}"), "{name}");
            let checks = run["checks"].as_array().expect("a list");
            assert!(checks.iter().all(|check| check["holds"] == true), "{name}: {checks:#?}");
        }
    }
}

fn runs(summary: &Value) -> &[Value] {
    summary["runs"].as_array().expect("a list")
}

/// The sum over nodes that stands for the air along the rod is refined until it is as good as asked for.
#[test]
fn the_air_along_the_rod_is_settled() {
    let summary = summary_of("02-thrown-rod");
    assert!(runs(&summary).iter().all(|run| run["numerics"]["quadrature"]["settled"] == true));
}

/// One step during the kick and one after it.
#[test]
fn the_kicked_ball_is_two_exact_steps() {
    let summary = summary_of("04-kicked-ball");
    let numerics = &runs(&summary)[0]["numerics"];
    assert_eq!((&numerics["steps"], &numerics["exact_steps"]), (&2.into(), &2.into()));
}

/// A value on the command line takes the place of a sweep.
#[test]
fn what_is_set_is_not_swept() {
    let out = folder();
    let (_, scene) = scenes().into_iter().find(|(name, _)| name.starts_with("01-")).expect("present");
    let set = vec![("T".to_owned(), "3s".to_owned())];
    let options = Options { out: out.path().to_owned(), set, ..Options::default() };
    let outcome = pipeline::run(&scene, &options).expect("a motion");
    assert_eq!(outcome.cases.len(), 1);
    assert_eq!(outcome.cases[0].label, "");
}

/// Rows of the table: the samples, and both sides of each event.
#[test]
fn the_table_has_both_sides_of_the_end_of_the_kick() {
    let out = folder();
    let (_, scene) = scenes().into_iter().find(|(name, _)| name == "04-kicked-ball").expect("present");
    let table = read(&run(&scene, out.path()).folder.join("run-001/trajectory.csv"));
    let at_the_end = |line: &&str| line.starts_with("0.01,");
    let phases: Vec<_> = table.lines().filter(at_the_end).map(|line| line.split(',').nth(1)).collect();
    assert_eq!(phases, [Some("0"), Some("1")]);
}
