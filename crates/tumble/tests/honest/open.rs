//! Forces that rigid bodies leave open: said to be so, with what they may be, and never with digits.

use tumble::{Case, FindResult};

use crate::ask::{Found, Scene, scene};

/// 3 kg on three feet in a line, 1 m apart from each other.
const BENCH: &str = r#"
[body.bench]
parts = [
    { disk = { centre = ["-1 m", 0], radius = "0.1 m" }, mass = "1 kg" },
    { disk = { radius = "0.1 m" }, mass = "1 kg" },
    { disk = { centre = ["1 m", 0], radius = "0.1 m" }, mass = "1 kg" },
]
start = { at = [0, "0.1 m"] }
[surface.floor]
through = [0, 0]
rigid = { restitution = 0 }
"#;
const WEIGHT: f64 = 3.0 * 9.81;

fn bench(more: &str) -> Scene {
    scene(&format!("{BENCH}{more}")).heavy().until("1 s")
}

#[track_caller]
fn is_between(find: &FindResult, least: f64, greatest: f64) {
    let spread = find.spread.expect("it is not unique");
    println!("{} {:?}", find.that, find.open());
    assert!((spread.least - least).abs() < 1e-12 && (spread.greatest - greatest).abs() < 1e-12, "{spread:?}");
    assert_eq!((find.status(), find.error), ("not unique", None));
}

#[test]
fn of_three_feet_only_the_sum_is_known() {
    let feet = ["floor.bench.part1.rim.normal", "floor.bench.part2.rim.normal", "floor.normal"];
    let case = bench("").run(&feet);
    is_between(&case.finds[0], 0.0, WEIGHT / 2.0);
    is_between(&case.finds[1], 0.0, WEIGHT);
    assert!(case.finds[2].spread.is_none());
    Found::of(&case.finds[2]).is(WEIGHT, 1e-12);
}

/// It was the greatest that could be told of the times when it is known.
#[test]
fn a_greatest_value_of_what_is_open_is_open() {
    let find = "[find.most]\nthat = \"floor.bench.part2.rim.normal\"\nat = \"its greatest\"\n";
    let case = bench(find).run(&[]);
    let spread = case.finds[0].spread.expect("it is not unique");
    assert_eq!((spread.least, spread.greatest), (f64::NEG_INFINITY, f64::INFINITY));
}

fn check(that: &str, equals: &str) -> String {
    format!("[check.claim]\nthat = \"{that}\"\nequals = \"{equals}\"\nwithin = \"1e-9 N\"\n")
}

#[test]
fn claims_of_it_fail_and_claims_of_the_sum_hold() {
    let claim = |that: &str, equals: &str| -> Case { bench(&check(that, equals)).run(&[]) };
    // What the equations give the foot that they leave out.
    let case = claim("floor.bench.part2.rim.normal", "0 N");
    let [only] = &case.checks[..] else { panic!("one check") };
    assert!(!only.holds && only.spread.is_some() && only.error.is_none(), "{only:?}");
    let case = claim("floor.bench.part2.rim.normal + 2*floor.bench.part1.rim.normal", "3*9.81 N");
    assert!(case.checks[0].holds && case.checks[0].is_sure(), "{:?}", case.checks);
}

/// In the air and on two feet there is nothing to be left open.
#[test]
fn two_feet_are_known() {
    let two = BENCH.replace("    { disk = { radius = \"0.1 m\" }, mass = \"1 kg\" },\n", "");
    let case = scene(&two).heavy().until("1 s").run(&["floor.bench.part1.rim.normal"]);
    assert!(case.finds[0].spread.is_none());
    Found::of(&case.finds[0]).is(9.81, 1e-12);
}
