//! Friction of compliant surfaces in scenes: who says it, what it is called, and what is a mistake.

#[path = "common/beside.rs"]
mod beside;
#[path = "common/rows.rs"]
mod rows;

use rows::{Row, table};
use tumble_expr::is_identically_zero;
use tumble_scene::read;

const SCENE: &str = r#"version = 1
[world]
gravity = "9.81 m/s^2"
[body.ball]
ball = { radius = "10 cm" }
mass = "1 kg"
start = { at = [0, "20 cm"] }
[surface.mat]
through = [0, 0]
spring = { stiffness = "1e4 N/m", damping = "10 kg/s", friction = 0.4 }
[surface.wall]
through = ["9 m", 0]
normal = [-1, 0]
hertz = { stiffness = "1e6 N/m^(3/2)", damping = 0, friction = { static = 0.3, kinetic = 0.25 } }
[run]
until = "1 s"
"#;

/// Whether the pairs of a scene have these kinetic coefficients, in percent.
#[track_caller]
fn have(scene: &str, percents: [Option<i32>; 2]) {
    let study = read("scene.toml", scene, &[]).map_err(|mistakes| mistakes.to_string()).expect("a study");
    let pairs = study.model.pairs();
    assert_eq!(pairs.len(), percents.len());
    for (pair, percent) in pairs.iter().zip(percents) {
        let off = pair.friction.as_ref().zip(percent).map(|(own, percent)| 100 * &own.kinetic - percent);
        assert_eq!(pair.friction.is_some(), percent.is_some(), "{}", pair.name);
        assert!(off.is_none_or(|off| is_identically_zero(&off)), "{}", pair.name);
    }
}

#[test]
fn the_pair_comes_before_the_body_and_the_body_before_the_surface() {
    have(SCENE, [Some(40), Some(25)]);
    let of_body = SCENE.replace("mass = \"1 kg\"", "mass = \"1 kg\"\nfriction = 0.1");
    have(&of_body, [Some(10), Some(10)]);
    let of_pair =
        of_body.replace("[run]", "[contact.pads]\nbetween = [\"mat\", \"ball\"]\nfriction = 0.7\n[run]");
    have(&of_pair, [Some(70), Some(10)]);
    let smooth = SCENE.replace(", friction = 0.4", "");
    have(&smooth, [None, Some(25)]);
}

#[test]
fn quantities_and_instants_have_names() {
    let asks = |that: &str, at: &str| {
        let find = format!("[find.asked]\nthat = \"{that}\"\nat = \"{at}\"\n[run]");
        let scene = SCENE.replace("[run]", &find);
        read("scene.toml", &scene, &[]).map(drop).map_err(|mistakes| mistakes.to_string())
    };
    for known in ["mat.ball.rim.friction", "mat.ball.rim.slip", "mat.friction", "wall.ball.rim.friction"] {
        assert_eq!(asks(known, "1 s"), Ok(()), "{known}");
    }
    for known in ["mat.ball.slides", "mat.ball.rolls", "mat.ball.sticks", "mat.slides"] {
        assert_eq!(asks("ball.x", known), Ok(()), "{known}");
    }
    assert!(asks("mat.ball.rim.rolling", "1 s").is_err());
}

const MISTAKES: &[Row] = &[
    ("friction = 0.4", "friction = -0.4", "E0530 -0.4", "must not be negative"),
    ("static = 0.3", "static = 0.2", "E0530 0.2", "one number for both"),
    ("friction = 0.4", "friction = \"0.4 N\"", "E0404 0.4 N", "pure number"),
    ("friction = 0.4", "friction = { static = 0.4 }", "E0513 { static = 0.4 }", "kinetic"),
    ("friction = 0.4", "friction = 0.4, rolling = \"1 mm\"", "E0511 rolling", "rigid"),
    ("friction = 0.4", "friction = 0.4, law = \"newton\"", "E0511 law", ""),
    ("friction = 0.4", "mu = 0.4", "E0511 mu", "friction"),
    ("friction = 0.4", "friction = 0.4, release = \"at the surface\"", "E0538 mat", "what pulls"),
    (
        "[run]",
        "[contact.pads]\nbetween = [\"mat\", \"ball\"]\nrigid = { friction = 0.3, rolling = \"1 mm\" }\n[run]",
        "E0538 mat",
        "only what is rigid resists rolling",
    ),
    (
        "[run]",
        "[contact.pads]\nbetween = [\"mat\", \"ball\"]\nrigid = { restitution = 0.5 }\n[run]",
        "E0538 pads",
        "leave `restitution` out",
    ),
    (
        "[run]",
        "[contact.pads]\nbetween = [\"mat\", \"ball\"]\nfriction = 0.2\nrigid = { friction = 0.3 }\n[run]",
        "E0519 friction",
        "leave one of them out",
    ),
];

#[test]
fn mistakes() {
    table(SCENE, MISTAKES);
}
