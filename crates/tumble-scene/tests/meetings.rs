//! Bodies that meet each other and polygons, in scenes: what is read, and what is a mistake.

#[path = "common/beside.rs"]
mod beside;
#[path = "common/rows.rs"]
mod rows;

use rows::{Row, table};
use tumble_scene::read;

const SCENE: &str = r#"version = 1
[world]
gravity = "9.81 m/s^2"
[body.crate]
box = { width = "0.4 m", height = "0.2 m" }
mass = "1 kg"
start = { at = [0, "0.6 m"] }
[body.wedge]
polygon = { corners = [[0, 0], ["0.3 m", 0], [0, "0.3 m"]] }
mass = "2 kg"
start = { at = [0, "1 m"] }
[body.ball]
ball = { radius = "5 cm" }
mass = "0.3 kg"
restitution = 0.9
start = { at = ["-1 m", "1 m"] }
[body.bar]
rod = { from = [0, 0], to = ["1 m", 0], end_radius = "1 cm" }
mass = "0.2 kg"
start = { at = [0, "2 m"] }
[surface.ledge]
polygon = [["-1 m", 0], ["1 m", 0], ["1 m", "0.5 m"], ["-1 m", "0.5 m"]]
rigid = { restitution = 0.5, friction = { static = 0.4, kinetic = 0.3 } }
on = ["crate", "wedge", "ball"]
[surface.drum]
circle = { centre = ["5 m", 0], radius = "0.3 m" }
rigid = { restitution = 0 }
[surface.bowl]
circle = { centre = [0, 0], radius = "9 m", inside = true }
rigid = { restitution = 0 }
on = "ball"
[contact.heap]
between = ["crate", "wedge", "bar"]
rigid = { restitution = 0.2, friction = 0.6 }
[contact.hits]
between = ["ball", "crate"]
[run]
until = "1 s"
"#;

#[test]
fn everything_is_read() {
    let study = read("scene.toml", SCENE, &[]).map_err(|mistakes| mistakes.to_string()).expect("a study");
    let names: Vec<String> = study.model.pairs().into_iter().map(|pair| pair.name).collect();
    let of = |start: &str| names.iter().filter(|name| name.starts_with(start)).count();
    // Corners on sides and sides on corners; the ball's rim on sides and corners.
    assert_eq!(of("ledge.crate."), 4 * 4 + 4 * 4);
    assert_eq!(of("ledge.ball."), 4 + 4);
    assert_eq!(of("drum.bar."), 2 + 2);
    assert_eq!(of("heap.crate.wedge."), 4 * 3 + 3 * 4);
    // Two ends and two sides, four corners and four sides.
    assert_eq!(of("heap.crate.bar."), 2 * 4 + 2 * 4 + 2 * 4);
    assert_eq!(of("hits.ball.crate."), 4 + 4);
    assert!(names.contains(&"ledge.crate.corner1.side3".to_owned()));
    assert!(names.contains(&"drum.bar.side2".to_owned()));
}

const MISTAKES: &[Row] = &[
    (
        "[run]",
        "[find.x]\nthat = \"ball.x\"\nat = \"hits.slides\"\n[run]",
        "E0521 hits.slides",
        "it has no friction",
    ),
    (
        "[run]",
        "[find.x]\nthat = \"ball.x\"\nat = \"ledge.crate.rolls\"\n[run]",
        "E0521 ledge.crate.rolls",
        "`ledge.crate.slides`",
    ),
    (
        "[run]",
        "[find.x]\nthat = \"ball.x\"\nat = \"ledge.crate.slide\"\n[run]",
        "E0301 ledge.crate.slide",
        "did you mean the event \"ledge.crate.slides\"?",
    ),
    (
        "[run]",
        "[find.x]\nthat = \"hits.crate.ball.normal\"\n[run]",
        "E0301 hits.crate.ball.normal",
        "did you mean `hits.ball.crate.normal`?",
    ),
    ("[body.bar]", "[body.шар]", "E0501 шар", "[body.\"шар\"]"),
    ("mass = \"2 kg\"", "mass = \"1e308 kg\"", "E0545 \"9.81 m/s^2\"", "a force must be a finite number"),
    ("on = \"ball\"", "on = []", "E0530 []", "leave `on` out"),
    (
        "restitution = 0.9",
        "restitution = -1e-300",
        "E0530 -1e-300",
        "is -1e-300: it must lie between 0 and 1",
    ),
    ("friction = 0.6", "friction = -0.6", "E0530 -0.6", "must not be negative"),
    ("kinetic = 0.3", "kinetic = 0.5", "E0530 0.4", "one number for both"),
    ("friction = 0.6", "friction = 0.6, rolling = \"-1 mm\"", "E0530 \"-1 mm\"", "must not be negative"),
    ("friction = 0.6", "friction = 0.6, rolling = 0.1", "E0516 0.1", "m"),
    ("friction = 0.6", "rolling = \"1 mm\"", "E0519 rolling", "add `friction"),
    (
        "friction = 0.6",
        "friction = 0.6, rolling_resistance = \"1 mm\"",
        "E0511 rolling_resistance",
        "rolling = ",
    ),
    ("restitution = 0.2", "restitution = 1.2", "E0530 1.2", "between 0 and 1"),
    ("[\"ball\", \"crate\"]", "[\"ball\", \"crater\"]", "E0520 \"crater\"", "crate"),
    ("[\"ball\", \"crate\"]", "[\"ball\", \"ball\"]", "E0519 \"ball\"", "name each of them once"),
    (
        "[\"ball\", \"crate\"]",
        "[\"ball\", \"crate\", \"bar\"]",
        "E0538 hits && E0538 hits",
        "leave one of the two out",
    ),
    ("[\"ball\", \"crate\"]", "[\"ball\", \"crate\"]\ncapture = 1", "E0514 1", "true"),
    (
        "[\"ball\", \"crate\"]",
        "[\"ball\", \"crate\"]\ncapture = true\nrigid = { friction = 0.2 }",
        "E0538 hits",
        "leave one of the two out",
    ),
    ("[\"ball\", \"crate\"]", "[\"ledge\", \"crate\"]\ncapture = true", "E0538 hits", "[weld.NAME]"),
    (
        "[contact.hits]",
        "[contact.again]\nbetween = [\"ledge\", \"crate\"]\n[contact.all]\nbetween = [\"ball\", \"crate\", \"ledge\"]\n[contact.hits]",
        "E0538 all && E0538 hits",
        "leave one of the two out",
    ),
    ("[\"ball\", \"crate\"]", "[\"ledge\", \"bar\"]", "E0538 hits", "add the body to `on`"),
    ("[\"ball\", \"crate\"]", "[\"ledge\", \"drum\", \"crate\"]", "E0538 hits", "name one surface"),
    ("[\"ball\", \"crate\"]", "[\"ledgee\", \"crate\"]", "E0520 \"ledgee\"", "ledge"),
    ("restitution = 0.9", "restitution = 0.9\nfriction = -0.1", "E0530 -0.1", "must not be negative"),
    (
        "restitution = 0.9",
        "restitution = 0.9\nfriction = { static = 0.1, kinetic = 0.2 }",
        "E0530 0.1",
        "one number for both",
    ),
    (
        "[[0, 0], [\"0.3 m\", 0], [0, \"0.3 m\"]]",
        "[[0, 0], [\"0.3 m\", 0], [\"0.1 m\", \"0.1 m\"], [0, \"0.3 m\"]]",
        "E0530 [[0, 0], [\"0.3 m\", 0], [\"0.1 m\", \"0.1 m\"], [0, \"0.3 m\"]]",
        "convex parts",
    ),
    (
        "[[\"-1 m\", 0], [\"1 m\", 0], [\"1 m\", \"0.5 m\"], [\"-1 m\", \"0.5 m\"]]",
        "[[\"-1 m\", 0], [\"1 m\", 0], [\"1 m\", 0], [\"-1 m\", \"0.5 m\"]]",
        "E0530 [[\"-1 m\", 0], [\"1 m\", 0], [\"1 m\", 0], [\"-1 m\", \"0.5 m\"]]",
        "each corner once",
    ),
    (
        "[[0, 0], [\"0.3 m\", 0], [0, \"0.3 m\"]]",
        "[[0, 0], [0, \"0.3 m\"], [\"0.3 m\", 0]]",
        "E0530 [[0, 0], [0, \"0.3 m\"], [\"0.3 m\", 0]]",
        "the other way round",
    ),
    (
        "[[\"-1 m\", 0], [\"1 m\", 0], [\"1 m\", \"0.5 m\"], [\"-1 m\", \"0.5 m\"]]",
        "[[\"-1 m\", 0], [\"-1 m\", \"0.5 m\"], [\"1 m\", \"0.5 m\"], [\"1 m\", 0]]",
        "E0530 [[\"-1 m\", 0], [\"-1 m\", \"0.5 m\"], [\"1 m\", \"0.5 m\"], [\"1 m\", 0]]",
        "the other way round",
    ),
    (
        "[[\"-1 m\", 0], [\"1 m\", 0], [\"1 m\", \"0.5 m\"], [\"-1 m\", \"0.5 m\"]]",
        "[[\"-1 m\", 0], [\"1 m\", 0]]",
        "E0515 [[\"-1 m\", 0], [\"1 m\", 0]]",
        "3 corners or more",
    ),
    (
        "polygon = [[\"-1 m\", 0]",
        "through = [0, 0]\npolygon = [[\"-1 m\", 0]",
        "E0519 through | polygon",
        "leave one",
    ),
    ("start = { at = [0, \"0.6 m\"] }", "start = { at = [0, \"0.59 m\"] }", "E0539 start", "m farther out"),
    ("start = { at = [0, \"1 m\"] }", "start = { at = [0, \"0.7 m\"] }", "E0539 start", "m farther apart"),
    ("radius = \"9 m\"", "radius = \"4 cm\"", "E0530 \"4 cm\"", "make the bowl larger"),
    ("radius = \"9 m\"", "radius = \"5 cm\"", "E0530 \"5 cm\"", ": 0 m are lacking"),
];

/// Quantities and instants of friction are those of whoever has it: the ball alone on the bowl, the bar alone on the drum.
#[test]
fn friction_of_bodies_and_pairs_has_names() {
    let own = SCENE.replace("restitution = 0.9", "restitution = 0.9\nfriction = 0.1");
    let own = own
        .replace("[run]", "[contact.pads]\nbetween = [\"drum\", \"bar\"]\nrigid = { friction = 0.2 }\n[run]");
    let asks = |that: &str| {
        let find = format!("[find.asked]\nthat = \"{that}\"\nat = \"1 s\"\n[run]");
        read("scene.toml", &own.replace("[run]", &find), &[])
            .map(drop)
            .map_err(|mistakes| mistakes.to_string())
    };
    for known in [
        "bowl.ball.rim.friction",
        "bowl.friction",
        "drum.friction",
        "drum.bar.side1.friction",
        "heap.crate.bar.friction",
        "drum.ball.rim.slip",
    ] {
        assert_eq!(asks(known), Ok(()), "{known}");
    }
    for unknown in ["drum.crate.corner1.friction", "heap.crate.friction"] {
        assert!(asks(unknown).is_err(), "{unknown}");
    }
}

#[test]
fn mistakes() {
    table(SCENE, MISTAKES);
}

const RODS: &str = r#"version = 1
[world]
gravity = "0 m/s^2"
[body.one]
rod = { from = [0, 0], to = ["1 m", 0], end_radius = "1 mm" }
mass = "1 kg"
start = { at = [0, 0] }
[body.other]
rod = { from = [0, 0], to = ["1 m", 0] }
mass = "1 kg"
start = { at = [0, "1 m"] }
[contact.hits]
between = "all"
rigid = { restitution = 1 }
[run]
until = "1 s"
"#;

/// On which side of a rod without thickness a point is, nothing says.
#[test]
fn rods_without_thickness() {
    table(RODS, &[(", end_radius = \"1 mm\"", "", "E0538 hits", "end_radius")]);
    assert!(read("scene.toml", RODS, &[]).is_ok());
}
