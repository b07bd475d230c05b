//! Compliant contacts of bodies in scenes: who says it, and what is a mistake.

#[path = "common/beside.rs"]
mod beside;
#[path = "common/rows.rs"]
mod rows;

use rows::{Row, table};
use tumble_scene::read;

const SCENE: &str = r#"version = 1
[world]
gravity = "9.81 m/s^2"
[body.ball]
ball = { radius = "10 cm" }
mass = "1 kg"
start = { at = [0, "80 cm"] }
[body.box]
box = { width = "30 cm", height = "20 cm" }
mass = "1 kg"
start = { at = [0, "40 cm"] }
[surface.floor]
through = [0, 0]
rigid = { restitution = 0.5 }
[surface.post]
circle = { centre = ["2 m", 0], radius = "20 cm" }
hertz = { stiffness = "1e6 N/m^(3/2)", damping = 0 }
[surface.ledge]
polygon = [["-3 m", 0], ["-2 m", 0], ["-2 m", "1 m"], ["-3 m", "1 m"]]
spring = { stiffness = "1e5 N/m", damping = 0 }
[contact.pads]
between = ["ball", "box"]
spring = { stiffness = "1e4 N/m", damping = "10 kg/s", friction = 0.4 }
[run]
until = "1 s"
"#;

#[test]
fn bodies_circles_and_polygons_yield() {
    let study = read("scene.toml", SCENE, &[]).map_err(|mistakes| mistakes.to_string()).expect("a study");
    for pair in study.model.pairs() {
        assert_eq!(pair.is_rigid(), pair.name.starts_with("floor."), "{}", pair.name);
        assert_eq!(pair.friction.is_some(), pair.name.starts_with("pads."), "{}", pair.name);
    }
    let beside = SCENE.replace(", friction = 0.4 }", " }\nfriction = 0.4");
    let study = read("scene.toml", &beside, &[]).map_err(|mistakes| mistakes.to_string()).expect("a study");
    assert!(study.model.contacts[0].friction.is_some());
}

const MISTAKES: &[Row] = &[
    ("stiffness = \"1e4 N/m\"", "stiffness = \"-1e4 N/m\"", "E0530 \"-1e4 N/m\"", "positive"),
    ("stiffness = \"1e4 N/m\"", "stiffness = \"1e4 N\"", "E0404 1e4 N", ""),
    ("damping = \"10 kg/s\"", "damping = \"-10 kg/s\"", "E0530 \"-10 kg/s\"", "negative"),
    ("friction = 0.4", "friction = -0.4", "E0530 -0.4", "must not be negative"),
    (
        "friction = 0.4 }",
        "friction = 0.4 }\nrigid = { restitution = 0.5 }",
        "E0519 spring | rigid",
        "a second law",
    ),
    ("friction = 0.4 }", "friction = 0.4 }\nfriction = 0.3", "E0519 friction", "leave one of them out"),
    ("friction = 0.4 }", "friction = 0.4 }\ncapture = true", "E0538 pads", "leave one of the two out"),
    ("friction = 0.4", "friction = 0.4, release = \"at the surface\"", "E0538 pads", "what pulls"),
    ("[\"ball\", \"box\"]", "[\"floor\", \"box\"]", "E0538 pads", "has a law of its own"),
    (
        "[run]",
        "[contact.again]\nbetween = \"all\"\nrigid = { restitution = 1 }\n[run]",
        "E0538 again",
        "a second rule",
    ),
];

#[test]
fn mistakes() {
    table(SCENE, MISTAKES);
}
