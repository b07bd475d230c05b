//! Runs that end at rest, and the instant at which a body comes to it; what waits for an event that does not come; and rods that may go on in
//! several ways.

use tumble::pipeline::run_text;

const BALLS: &str = r#"
    version = 1
    world.gravity = "9.8 m/s^2"
    run.until = { rest = true, at_most = "MOST" }

    [body.dull]
    ball = { radius = "10 cm" }
    mass = "1 kg"
    restitution = 0
    start = { at = [0, "1.1 m"] }

    [body.lively]
    ball = { radius = "10 cm" }
    mass = "1 kg"
    start = { at = ["1 m", "1.1 m"] }

    [surface.floor]
    through = [0, 0]
    rigid = { restitution = 0.5 }

    [check.first]
    that = "lively.y"
    at = "dull.rest"
    equals = "10 cm"
    within = "1e-12 m"

    [check.last]
    that = "t"
    at = "rest"
    equals = "3*sqrt(2*(1 m)/(9.8 m/s^2))"
    within = "1e-12 s"

    [check.lively]
    that = "t"
    at = "lively.rest"
    equals = "3*sqrt(2*(1 m)/(9.8 m/s^2))"
    within = "1e-12 s"
"#;

#[test]
fn a_run_ends_where_all_rests() {
    let cases = run_text("balls", &BALLS.replace("MOST", "60 s")).expect("a scene without mistakes");
    for check in &cases[0].checks {
        assert!(check.holds && check.is_sure(), "{check:?}");
    }
    assert!(cases[0].said.list.is_empty());
}

#[test]
fn what_does_not_rest_in_time_is_told() {
    let cases = run_text("balls", &BALLS.replace("MOST", "1 s")).expect("a scene without mistakes");
    let [dull, last, lively] = &cases[0].checks[..] else { panic!("three checks") };
    assert!(dull.holds && !last.is_reached() && !lively.is_reached());
    let said: Vec<&str> = cases[0].said.list.iter().map(|said| said.code.as_str()).collect();
    assert_eq!(said, ["W0606"]);
}

const HOOK: &str = r#"
    version = 1
    world.gravity = "9.8 m/s^2"
    run.until = "1 s"

    [body.stone]
    point = {}
    mass = "1 kg"
    start = { at = ["1 m", 0] }

    [pin.hook]
    between = ["stone.cm", { world = ["1 m", 0] }]
    until = "top"

    [event.top]
    when = "t rises through WHEN"

    [impulse.kick]
    on = "stone"
    at = "stone.cm"
    impulse = ["1 N*s", 0]
    when = "top"
"#;

/// A release and an impulse that never come, and the same that do.
#[test]
fn what_waits_for_an_event_that_does_not_happen_is_told() {
    for (when, told) in [("2 s", &["W0608", "W0608"][..]), ("0.5 s", &[])] {
        let cases = run_text("hook", &HOOK.replace("WHEN", when)).expect("a scene without mistakes");
        let said: Vec<&str> = cases[0].said.list.iter().map(|said| said.code.as_str()).collect();
        assert_eq!(said, told, "{when}");
    }
}

/// A rod that leans with friction 2 and stands while it is pressed along itself; then what pulls at it would let it stick, slide or lift off.
const LEANING: &str = include_str!("../../tumble-report/src/tests/leaning.toml");

/// It goes on to stick, which is told; where it did not stick before, nothing says that it does.
#[test]
fn motions_that_are_possible_besides_are_told() {
    let cases = run_text("rod", LEANING).expect("a scene without mistakes");
    let [said] = &cases[0].said.list[..] else { panic!("{:?}", cases[0].said.list) };
    assert_eq!(said.code.as_str(), "W0610");
    for words in [
        "from 0.25 s on",
        "3 motions are possible",
        "sticks with",
        "slides backward with",
        "opens with 0.3 m/s^2",
    ] {
        assert!(said.message.contains(words), "{}", said.message);
    }
    let alone = LEANING
        .replace("[\"0.25 s\", \"1 s\"]", "[0, \"1 s\"]")
        .replace("[0, \"0.25 s\"]", "[\"2 s\", \"3 s\"]");
    let refused = run_text("rod", &alone).map(drop).expect_err("nothing says that it sticks");
    assert!(format!("{refused:?}").contains("3 motions are possible"), "{refused:?}");
}
