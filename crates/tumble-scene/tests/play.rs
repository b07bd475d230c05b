//! What a reader of the page may change: ranges, presets, and starts that are set.

use tumble_scene::{Knob, Override, Study, read};

const SCENE: &str = r#"
    version = 1
    world.gravity = "9.81 m/s^2"
    run.until = "2 s"

    [parameters]
    L = "1 m"
    m = "250 g"
    n = 3
    I = "m*L^2/3"

    [body.rod]
    rod = { from = [0, 0], to = [0, "-L"] }
    mass = "m"
    start = { angle = "30 deg" }

    [pivot.hinge]
    body = "rod"
    point = [0, 0]
    world = [0, 0]

    [body.stone]
    point = {}
    mass = "n*m"
    start = { at = ["2 m", 0], velocity = [0, "5 m/s"] }
"#;

fn study(more: &str, set: &[(&str, &str)]) -> Result<Study, String> {
    let set: Vec<Override> = set
        .iter()
        .map(|(name, text)| Override { name: (*name).to_owned(), text: (*text).to_owned() })
        .collect();
    read("scene.toml", &format!("{SCENE}{more}"), &set).map_err(|mistakes| mistakes.to_string())
}

fn knob<'s>(study: &'s Study, name: &str) -> &'s Knob {
    study.play.knobs.iter().find(|knob| knob.name == name).expect(name)
}

fn first(study: &Study) -> Vec<&str> {
    study.play.knobs.iter().filter(|knob| knob.is_first).map(|knob| knob.name.as_str()).collect()
}

#[test]
fn quantities_and_stated_starts_come_first() {
    let study = study("", &[]).expect("a scene");
    let starts = ["rod.start.angle", "stone.start.x", "stone.start.y", "stone.start.vx", "stone.start.vy"];
    assert_eq!(first(&study), [&["L", "m", "n"][..], &starts].concat());
    let rest: Vec<_> =
        study.play.knobs.iter().filter(|knob| !knob.is_first).map(|knob| &*knob.name).collect();
    // A pivot places the rod: it may be turned, not moved.
    assert_eq!(rest, ["I", "rod.start.omega", "stone.start.angle", "stone.start.omega"]);
}

#[test]
fn ranges_go_from_zero_to_twice_the_value_in_its_unit() {
    let study = study("", &[]).expect("a scene");
    let mass = knob(&study, "m");
    assert_eq!((mass.text.as_str(), mass.unit.as_str()), ("250 g", "g"));
    assert!((mass.value - 250.0).abs() < 1e-9 && (mass.range[1] - 500.0).abs() < 1e-9, "{mass:?}");
    assert_eq!(knob(&study, "stone.start.y").range, [-1.0, 1.0]);
    assert_eq!(knob(&study, "stone.start.angle").range, [-180.0, 180.0]);
}

#[test]
fn ranges_hold_what_a_sweep_takes() {
    let study = study("[sweep]\nn = [1, 2, 40]", &[]).expect("a scene");
    assert_eq!(knob(&study, "n").range, [0.0, 40.0]);
}

#[test]
fn a_scene_says_what_is_played_with_and_how_far() {
    let play = r#"
    [play]
    n = { from = 1, to = 1000, spacing = "linear" }
    rod.start.angle = ["-90 deg", "90 deg"]
    L = ["1 cm", "10 m"]
    [play.presets.long]
    label = "A long rod"
    text = "It swings slowly."
    set = { L = "4 m", rod.start.angle = "5 deg" }
    "#;
    let study = study(play, &[]).expect("a scene");
    assert_eq!(first(&study), ["n", "rod.start.angle", "L"]);
    assert!(!knob(&study, "n").is_log && knob(&study, "L").is_log);
    assert_eq!(knob(&study, "rod.start.angle").range.map(f64::round), [-90.0, 90.0]);
    let [preset] = &study.play.presets[..] else { panic!("one preset") };
    assert_eq!((preset.label.as_str(), preset.text.as_str()), ("A long rod", "It swings slowly."));
    let set = [("L", "4 m"), ("rod.start.angle", "5 deg")].map(|(a, b)| (a.to_owned(), b.to_owned()));
    assert_eq!(preset.set, set);
}

#[test]
fn mistakes_of_ranges_and_presets_are_told() {
    let said = |play: &str| study(play, &[]).expect_err("a mistake");
    assert!(said("[play]\nK = [0, 1]").contains("E0540: nothing that could be changed is named `K`"));
    assert!(
        said("[play]\nL = [\"2 m\", \"1 m\"]").contains("E0530: a range goes from a value to a greater one")
    );
    assert!(said("[play]\nL = { from = 0, to = \"1 m\", spacing = \"log\" }").contains("E0530"));
    assert!(said("[play]\nL = [\"1 s\", \"2 s\"]").contains("a time"));
    assert!(said("[play.presets.a]\nlabel = \"a\"").contains("E0513: `set` is missing"));
    assert!(said("[play.presets.a]\nset = { q = 1 }").contains("E0540"));
}

#[test]
fn starts_are_set_like_parameters() {
    let set = study("", &[("rod.start.angle", "45 deg"), ("stone.start.vx", "1 km/h")]).expect("a scene");
    assert_eq!(knob(&set, "rod.start.angle").text, "45 deg");
    let start = set.model.start_of("stone");
    let velocity = start.velocity.expect("it was stated");
    assert!((set.number(velocity.x()).expect("a number") - 1.0 / 3.6).abs() < 1e-15);
    assert_eq!(set.number(velocity.y()).expect("a number"), 5.0);
    // What was not stated can be set too.
    let set = study("", &[("rod.start.omega", "1 rad/s")]).expect("a scene");
    assert_eq!(set.number(&set.model.start_of("rod").omega.expect("it was set")).expect("a number"), 1.0);
}

#[test]
fn settings_of_starts_that_make_no_sense_are_told() {
    let said = |name: &str, text: &str| study("", &[(name, text)]).expect_err("a mistake");
    assert!(said("rod.start.angle", "1 m").starts_with("--set rod.start.angle=1 m:1:17: E"));
    assert!(said("rod.start.width", "1 m").contains("E0540"));
    assert!(said("cat.start.angle", "1 rad").contains("E0540"));
    assert!(said("rod.start.x", "1 m").contains("E0537: `rod` has no place at its start"));
}
