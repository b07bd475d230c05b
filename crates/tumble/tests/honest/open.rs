//! Forces that rigid bodies leave open: said to be so, with what they may be, and never with digits.

use tumble::{Case, FindResult};

use super::ask::{Found, Scene, scene};

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

/// Two cranks of unlike masses, parallel until they lie in one line with the coupler.
const CRANKS: &str = r#"
[body.crank0]
rod = { from = [0, 0], to = ["0.3 m", 0] }
mass = "1 kg"
points.tip = ["0.3 m", 0]
start = { angle = "-0.5 rad", omega = "6 rad/s" }
[body.crank1]
rod = { from = [0, 0], to = ["0.3 m", 0] }
mass = "3 kg"
points.tip = ["0.3 m", 0]
start = { angle = "-0.5 rad", omega = "6 rad/s" }
[body.coupler]
rod = { from = [0, 0], to = ["0.5 m", 0] }
mass = "1 kg"
points.a = [0, 0]
points.b = ["0.5 m", 0]
start = { at = ["0.3 m*cos(-0.5) + 0.25 m", "0.3 m*sin(-0.5)"], velocity = ["-0.3 m*sin(-0.5)*(6 s^-1)", "0.3 m*cos(-0.5)*(6 s^-1)"] }
[pivot.A0]
body = "crank0"
point = [0, 0]
world = [0, 0]
[pivot.A1]
body = "crank1"
point = [0, 0]
world = ["0.5 m", 0]
[pin.B0]
between = ["crank0.tip", "coupler.a"]
assemble = true
[pin.B1]
between = ["crank1.tip", "coupler.b"]
assemble = true
"#;

/// Where joints leave them open forces have no value, and no error of one; places and velocities have both.
#[test]
fn forces_at_a_singular_instant_have_no_value() {
    let find = |name: &str, that: &str| format!("[find.{name}]\nthat = \"{that}\"\nat = \"singular[1]\"\n");
    let check = check("B0.fx", "1 N") + "at = \"singular[1]\"\n";
    let more =
        find("force", "B0.fx") + &find("angle", "crank0.angle") + &find("omega", "crank0.omega") + &check;
    let case = scene(&format!("{CRANKS}{more}")).until("0.2 s").run(&[]);
    assert_eq!(case.finds[0].status(), "no value");
    assert_eq!(case.finds[0].open().expect("words"), "has no value");
    assert_eq!((case.checks[0].holds, case.checks[0].open().as_deref()), (false, Some("has no value")));
    Found::of(&case.finds[1]).is(0.0, 1e-12);
    Found::of(&case.finds[2]).is(6.0, 2e-11);
}
