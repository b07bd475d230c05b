//! What a person sees of a mistake.

use tumble_scene::{Override, read};

const PENDULUM: &str = r#"version = 1
title = "Pendulum"

[parameters]
m = "1 kg"
L = "1 m"

[functions]
"w(t)" = "20 m/s*cos(t/(1 s))"

[world]
gravity = "9.81 m/s^2"

[body.rod]
rod = { from = [0, 0], to = [0, "-L"] }
mass = "m"
points.tip = [0, "-L"]
start = { angle = "10 deg" }

[pivot.hinge]
body = "rod"
point = [0, 0]
world = [0, 0]

[run]
until = "20 s"
"#;

fn shown(old: &str, new: &str) -> String {
    let scene = PENDULUM.replace(old, new);
    read("pendulum.toml", &scene, &[]).expect_err(new).render(false, 90)
}

/// What the scene, its name and a setting hold that a terminal obeys is shown as numbers, in its place.
#[test]
fn texts_that_a_terminal_would_obey() {
    let scene = PENDULUM.replace("\"1 kg\"", "\"1\u{202e} kg\"").replace("10 deg", "10 \u{9b}2J deg");
    let set = Override { name: "L\u{1b}[2J".into(), text: "1\rm".into() };
    let mistakes = read("evil\u{1b}[2J\n.toml", &scene, &[set]).expect_err("unseen");
    let (drawn, lines) = (mistakes.render(false, 90), mistakes.to_string());
    for text in [&drawn, &lines] {
        assert!(!text.contains(|c: char| c != '\n' && tumble_scene::is_unseen(c)), "{text:?}");
    }
    insta::assert_snapshot!(drawn);
    assert!(mistakes.render(true, 90).contains("\u{1b}["), "our own colours stay");
    assert_eq!(lines.lines().count(), mistakes.list.len());
}

#[test]
fn a_key_that_is_not_known() {
    insta::assert_snapshot!(shown("mass = \"m\"", "mass = \"m\"\ncolour = \"red\""));
}

#[test]
fn a_section_that_is_missing() {
    insta::assert_snapshot!(shown("[run]\nuntil = \"20 s\"\n", ""));
}

#[test]
fn a_length_and_a_mass() {
    insta::assert_snapshot!(shown("from = [0, 0]", "from = [0, \"L + m\"]"));
}

#[test]
fn a_number_without_its_unit() {
    insta::assert_snapshot!(shown("m = \"1 kg\"\n", "m = 1\n"));
}

#[test]
fn an_angle_without_its_unit() {
    insta::assert_snapshot!(shown("angle = \"10 deg\"", "angle = 10"));
}

#[test]
fn a_key_given_twice() {
    insta::assert_snapshot!(shown("L = \"1 m\"", "L = \"1 m\"\nm = \"2 kg\""));
}

#[test]
fn a_quantity_without_quotes() {
    insta::assert_snapshot!(shown("\"20 s\"", "20 s"));
}

#[test]
fn a_circle() {
    insta::assert_snapshot!(shown("L = \"1 m\"", "L = \"a/2\"\na = \"2*L\""));
}

#[test]
fn a_mistake_in_a_function() {
    insta::assert_snapshot!(shown("L = \"1 m\"", "L = \"w(2 m)*(1 s)\""));
}

#[test]
fn a_start_that_the_pivot_decides() {
    insta::assert_snapshot!(shown("angle = \"10 deg\"", "angle = \"10 deg\", at = [0, 0]"));
}

#[test]
fn what_an_event_makes_of_a_coefficient() {
    let event = "[event.back]\nwhen = \"rod.omega falls through 0 rad/s\"\naction = { set = { L = \"-L\" } }\n\n\
                 [torsion.wire]\non = \"rod\"\nstiffness = \"L*(2 N)\"\nrest_angle = 0\n\n[run]";
    insta::assert_snapshot!(shown("[run]", event));
}

/// What is said of a scene that can be run and most often has a slip.
fn warned(old: &str, new: &str) -> String {
    let study =
        read("pendulum.toml", &PENDULUM.replace(old, new), &[]).map_err(|mistakes| mistakes.to_string());
    study.expect("no mistakes").warnings().render(false, 90)
}

#[test]
fn a_start_that_is_faster_than_mechanics_goes() {
    insta::assert_snapshot!(warned("angle = \"10 deg\"", "angle = \"10 deg\", omega = \"3e8 rad/s\""));
    assert_eq!(warned("angle = \"10 deg\"", "angle = \"10 deg\", omega = \"1e8 rad/s\""), "");
}

#[test]
fn bodies_that_overlap() {
    let plate = |x: &str| {
        format!(
            "[body.plate]\ndisk = {{ radius = \"20 cm\" }}\nmass = \"1 kg\"\nstart = {{ at = [\"{x}\", \"-30 cm\"] }}\n\n[run]"
        )
    };
    insta::assert_snapshot!(warned("[run]", &plate("0 m")));
    assert_eq!(warned("[run]", &plate("3 m")), "");
    let pin = "[pin.pair]\nbetween = [\"rod.cm\", \"plate.cm\"]\nassemble = true\n\n[run]";
    assert_eq!(warned("[run]", &plate("0 m").replace("[run]", pin)), "");
}

#[test]
fn masses_that_are_too_unlike() {
    let moon = |mass: &str| {
        format!(
            "[body.moon]\nball = {{ radius = \"1 m\" }}\nmass = \"{mass}\"\nstart = {{ at = [\"9 m\", 0] }}\n\n[run]"
        )
    };
    insta::assert_snapshot!(warned("[run]", &moon("2e15 kg")));
    assert_eq!(warned("[run]", &moon("1e15 kg")), "");
}

#[test]
fn a_setting_of_another_dimension() {
    let set = Override { name: "L".into(), text: "2 s".into() };
    insta::assert_snapshot!(read("pendulum.toml", PENDULUM, &[set]).expect_err("a time").render(false, 90));
}

#[test]
fn colours_are_shown_only_on_request() {
    let mistakes = read("pendulum.toml", &PENDULUM.replace("\"m\"", "\"n\""), &[]).expect_err("no name");
    assert!(mistakes.render(true, 90).contains('\u{1b}'));
    assert!(!mistakes.render(false, 90).contains('\u{1b}'));
}
