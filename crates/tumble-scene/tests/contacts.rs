//! Surfaces, contacts and free-body diagrams in scenes: what is read, and what is a mistake.

#[path = "common/beside.rs"]
mod beside;
#[path = "common/rows.rs"]
mod rows;

use rows::{Row, table};
use tumble_mech::{ContactLaw, Extreme, Release};
use tumble_scene::{When, read};

const SCENE: &str = r#"version = 1
[parameters]
k = "1e4 N/m"
e = 0.7
[world]
gravity = "9.81 m/s^2"
impacts = "sequential"
[body.rod]
rod = { from = ["-0.5 m", 0], to = ["0.5 m", 0], end_radius = "1 cm" }
mass = "0.5 kg"
restitution = 0.5
points.tip = ["0.5 m", 0]
start = { at = [0, "2 m"] }
[surface.floor]
through = [0, 0]
rigid = { restitution = "e" }
[surface.wall]
through = ["3 m", 0]
normal = [-1, 0]
spring = { stiffness = "k", damping = "2 kg/s", release = "at the surface" }
[surface.slope]
through = ["-9 m", 0]
slope = "-30 deg"
hertz = { stiffness = "1e6 N/m^(3/2)", damping = 0 }
on = ["rod"]
[event.apex]
when = "rod.vy falls through 0 m/s"
[run]
until = "1 s"
[plot.push]
y = ["floor.normal", "floor.rod.tip.normal"]
during = ["floor.contact[1].start - 5 ms", "floor.rod.tip.contact.end + 5 ms"]
[plot.gap]
y = "floor.rod.from.gap"
[free_body.sheet]
body = "rod"
at = ["0 s", "floor.contact[2].at(50%)", { at = "apex[2] + 1 ms", label = "later" }]
[check.time]
that = "floor.contact[1].duration"
equals = 0
at = "floor.rod.contact[1].start"
within = "1e-9 s"
"#;

#[test]
fn everything_is_read() {
    let study = read("scene.toml", SCENE, &[]).map_err(|mistakes| mistakes.to_string()).expect("a study");
    let pairs: Vec<String> = study.model.pairs().into_iter().map(|pair| pair.name).collect();
    assert_eq!(pairs.len(), 6);
    assert_eq!(pairs[..2], ["floor.rod.from", "floor.rod.tip"]);
    let laws: Vec<&ContactLaw> = study.model.surfaces.iter().map(|surface| &surface.law).collect();
    assert!(matches!(laws[0], ContactLaw::Rigid { .. }));
    assert!(matches!(laws[1], ContactLaw::Spring { release: Release::AtSurface, .. }));
    assert!(matches!(laws[2], ContactLaw::Hertz { .. }));
    assert_eq!(study.free_bodies[0].at.len(), 3);
    assert_eq!(study.free_bodies[0].at[2].1, "later");
    let symbols = study.free_bodies[0].at[1].0.time.symbols();
    let mut names: Vec<&str> = symbols.iter().map(|symbol| &*symbol.name).collect();
    names.sort_unstable();
    assert_eq!(names, ["floor.contact[2].duration", "floor.contact[2].start"]);
}

#[test]
fn a_surface_may_meet_single_points() {
    let pairs = |on: &str| -> Vec<String> {
        let scene = SCENE.replace("on = [\"rod\"]", on);
        let study = read("scene.toml", &scene, &[]).map_err(|mistakes| mistakes.to_string());
        let pairs = study.expect("a study").model.pairs().into_iter().map(|pair| pair.name);
        pairs.filter(|name| name.starts_with("slope")).collect()
    };
    assert_eq!(pairs("on = \"rod.tip\""), ["slope.rod.tip"]);
    assert_eq!(pairs("on = [\"rod.tip\", \"rod.from\"]"), ["slope.rod.from", "slope.rod.tip"]);
    assert_eq!(pairs("on = \"rod\""), ["slope.rod.from", "slope.rod.tip"]);
}

#[test]
fn greatest_values_and_works_are_read() {
    let read = |from: &str, to: &str| {
        let scene = SCENE.replace(from, to);
        read("scene.toml", &scene, &[]).map_err(|mistakes| mistakes.to_string()).expect("a study")
    };
    let at = "at = \"floor.rod.contact[1].start\"";
    let study = read(at, "at = \"its least\"\nduring = [\"0.1 s\", \"floor.contact[1].end\"]");
    let When::Extreme { which: Extreme::Least, during: Some([from, _]) } = &study.checks[0].question.at
    else {
        panic!("{:?}", study.checks[0].question.at)
    };
    assert_eq!(from.text, "0.1 s");
    let study = read(
        CHECKED,
        "that = \"floor.work + gravity.work + floor.rod.tip.work\"\nequals = \"0 J\"\nwithin = \"1 J\"",
    );
    assert_eq!(study.checks[0].question.that.quantity.unit, "J");
    let labelled = "y = [{ value = \"floor.rod.from.gap in cm\", label = \"left\" }, \"rod.y in cm\"]";
    let study = read("y = \"floor.rod.from.gap\"", labelled);
    assert_eq!(study.plots[1].y[0].label.as_deref(), Some("left"));
    assert_eq!(study.plots[1].y[0].quantity.unit, "cm");
}

/// What the check of the scene looks at and claims.
const CHECKED: &str = "that = \"floor.contact[1].duration\"\nequals = 0
at = \"floor.rod.contact[1].start\"
within = \"1e-9 s\"";

const MISTAKES: &[Row] = &[
    ("{ restitution = \"e\" }", "{ restitution = 1.5 }", "E0530 1.5", "between 0 and 1"),
    ("restitution = 0.5", "restitution = -1", "E0530 -1", "between 0 and 1"),
    ("{ restitution = \"e\" }", "{ restitution = \"1 m\" }", "E0404 1 m", "is a pure number"),
    ("stiffness = \"k\"", "stiffness = \"1 N\"", "E0404 1 N", "a stiffness"),
    ("stiffness = \"k\"", "stiffness = \"0 N/m\"", "E0530 \"0 N/m\"", "positive"),
    (
        "damping = \"2 kg/s\", ",
        "",
        "E0513 { stiffness = \"k\", release = \"at the surface\" }",
        "add `damping",
    ),
    ("\"at the surface\"", "\"never\"", "E0518 \"never\"", "\"at zero force\""),
    ("rigid = { restitution = \"e\" }", "", "E0513 floor", "add `rigid"),
    ("slope = \"-30 deg\"", "slope = \"-30 deg\"\nnormal = [0, 1]", "E0519 slope | normal", "leave one"),
    ("slope = \"-30 deg\"", "slope = 30", "E0516 30", "30 deg"),
    ("on = [\"rod\"]", "on = [\"rood\"]", "E0520 \"rood\"", "rod"),
    ("impacts = \"sequential\"", "impacts = \"at random\"", "E0518 \"at random\"", "\"simultaneous\""),
    ("at = [0, \"2 m\"]", "at = [0, \"-0.1 m\"]", "E0539 start", "start it"),
    ("floor.contact[2].at(50%)", "floor.contact[2].at(50%", "E0530 \"floor.contact[2].at(50%\"", "at(50%)"),
    ("floor.contact[1].duration\"", "flor.contact[1].duration\"", "E0521 flor.contact[1].duration", ""),
    (
        "floor.contact[1].duration\"",
        "floor.contact[1].middle\"",
        "E0530 floor.contact[1].middle",
        ".duration",
    ),
    (
        "floor.contact[1].duration\"",
        "floor.rood.contact[1].end\"",
        "E0521 floor.rood.contact[1].end",
        "floor.rod",
    ),
    ("floor.contact[1].duration\"", "floor.contact[0].end\"", "E0530 floor.contact[0].end", "contact[1]"),
    (
        "k = \"1e4 N/m\"",
        "k = \"1e4 N/m\"\nq = \"floor.contact[1].start\"",
        "E0528 floor.contact[1].start",
        "checks",
    ),
    ("[plot.gap]", "[plot.sheet]", "E0523 sheet | sheet", "two figures"),
    ("body = \"rod\"\nat", "body = \"ball\"\nat", "E0520 \"ball\"", "rod"),
    ("on = [\"rod\"]", "on = [\"rod.tap\"]", "E0521 \"rod.tap\"", "did you mean \"rod.tip\"?"),
    ("on = [\"rod\"]", "on = \"rood.tip\"", "E0520 \"rood.tip\"", ""),
    ("at = \"floor.rod.contact[1].start\"", "during = [0, \"1 s\"]", "E0519 during", "its greatest"),
    (
        "at = \"floor.rod.contact[1].start\"",
        "at = \"its least\"\nduring = [\"2 s\", \"3 s\"]",
        "E0533 [\"2 s\", \"3 s\"]",
        "outside of the run",
    ),
    ("at = \"floor.rod.contact[1].start\"", "at = \"its largest\"", "E0110 largest | its", ""),
    ("y = \"floor.rod.from.gap\"", "y = \"floor.work\"", "E0528 floor.work", "a check at an instant"),
    ("y = \"floor.rod.from.gap\"", "y = \"flor.work\"", "E0301 flor.work", ""),
    (
        "equals = 0\nat = \"floor.rod.contact[1].start\"",
        "equals = \"(1 s)*floor.work/(1 J)\"\nat = \"its greatest\"",
        "E0528 floor.work",
        "at an instant",
    ),
    ("y = \"floor.rod.from.gap\"", "y = { value = \"rod.y\" }", "E0513 { value = \"rod.y\" }", "add `label"),
    ("[surface.wall]", "[surface.rod]", "E0523 rod | rod", "the name of a surface and of a body"),
];

#[test]
fn mistakes() {
    table(SCENE, MISTAKES);
}
