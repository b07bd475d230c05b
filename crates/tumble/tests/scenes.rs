//! Every scene of the repository runs, and what it claims holds.

use crate::common::{failures, folder, gallery, read, scenes};
use serde_json::Value;
use tumble::pipeline::{self, Options, Outcome};

fn summary(outcome: &Outcome) -> Value {
    serde_json::from_str(&read(&outcome.folder.join("summary.json"))).expect("JSON")
}

fn outcome_of(name: &str) -> &'static Outcome {
    let mut found = gallery().iter().filter(|(known, _)| known == name);
    found.next().map(|(_, outcome)| outcome).expect("there is such a scene")
}

#[test]
fn every_claim_of_every_scene_holds() {
    for (name, outcome) in gallery() {
        assert!(outcome.is_success(), "{name}: {:#?}", failures(outcome));
        assert!(outcome.cases.iter().all(|case| !case.checks.is_empty()), "{name} claims nothing");
        assert!(outcome.folder.ends_with(name), "{name}: {}", outcome.folder.display());
    }
}

#[test]
fn every_scene_has_its_files() {
    for (name, outcome) in gallery() {
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
    for (name, outcome) in gallery() {
        let summary = summary(outcome);
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
    let summary = summary(outcome_of("02-thrown-rod"));
    assert!(runs(&summary).iter().all(|run| run["numerics"]["quadrature"]["settled"] == true));
}

/// One step during the kick and one after it.
#[test]
fn the_kicked_ball_is_two_exact_steps() {
    let summary = summary(outcome_of("04-kicked-ball"));
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
    let table = read(&outcome_of("04-kicked-ball").folder.join("run-001/trajectory.csv"));
    let at_the_end = |line: &&str| line.starts_with("0.01,");
    let phases: Vec<_> = table.lines().filter(at_the_end).map(|line| line.split(',').nth(1)).collect();
    assert_eq!(phases, [Some("0"), Some("1")]);
}
