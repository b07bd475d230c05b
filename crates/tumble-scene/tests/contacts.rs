//! Surfaces, contacts and free-body diagrams in scenes: what is read, and what is a mistake.

#[path = "common/beside.rs"]
mod beside;
#[path = "common/rows.rs"]
mod rows;

use rows::{Row, table};
use tumble_mech::{ContactLaw, Release};
use tumble_scene::read;

const SCENE: &str = r#"version = 1
[parameters]
k = "1e4 N/m"
e = 0.7
[world]
gravity = "9.81 m/s^2"
impacts = "in turn"
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
    ("impacts = \"in turn\"", "impacts = \"at random\"", "E0518 \"at random\"", "\"together\""),
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
    ("[surface.wall]", "[surface.rod]", "E0523 rod | rod", "the name of a surface and of a body"),
];

#[test]
fn mistakes() {
    table(SCENE, MISTAKES);
}
