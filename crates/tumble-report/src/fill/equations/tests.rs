//! Printed equations are those that were integrated.

use super::*;
use crate::fill::motion::Line;
use crate::scenes::{motions_in, motions_of};
use tumble_expr::{Dimension, Substitution};
use tumble_mech::Mode;
use tumble_ode::Side;

/// Rounding of formulas in another order of operations.
const ROUNDING: f64 = 1e-9;

/// Two contacts that last.
const LADDER: &str = r#"version = 1
    world.gravity = "9.81 m/s^2"
    run.until = "1 s"
    [body.ladder]
    rod = { from = [0, "2 m"], to = [0, "-2 m"] }
    mass = "12 kg"
    start = { at = ["1 m", "sqrt(3)*(1 m)"], angle = "30 deg" }
    [surface.floor]
    through = [0, 0]
    rigid = { restitution = 0 }
    [surface.wall]
    through = [0, 0]
    normal = [1, 0]
    rigid = { restitution = 0 }
"#;

/// Two legs on two sides of one polygon: it turns as it slides down, though both stay on it.
const SADDLE: &str = r#"version = 1
    world.gravity = "9.81 m/s^2"
    run.until = "0.3 s"
    [parameters]
    b = "3 m"
    [body.saddle]
    parts = [
        { rod = { from = [0, 0], to = ["-1 m", "-1.2 m"] }, mass = "1 kg" },
        { rod = { from = [0, 0], to = ["1 m", "-1.2 m"] }, mass = "2 kg" },
    ]
    start.at = ["(1/6)*(1 m)", "-0.4 m"]
    [surface.wedge]
    polygon = [["-b", "-3 m"], ["b", "-3 m"], [0, 0]]
    rigid = { restitution = 0 }
"#;

/// A block and a disk slide down a plane that is shaken across itself, pushed along: it takes them with it.
const SHAKEN: &str = r#"version = 1
    world.gravity = "9.81 m/s^2"
    run.until = "0.3 s"
    [body.block]
    box = { width = "20 cm", height = "10 cm" }
    mass = "2 kg"
    start = { at = ["-5 cm*sin(0.6)", "5 cm*cos(0.6)"], angle = "0.6 rad", velocity = ["-2 m/s*cos(0.6) - 0.14 m/s*sin(0.6)", "-2 m/s*sin(0.6) + 0.14 m/s*cos(0.6)"] }
    [body.disk]
    disk = { radius = "10 cm" }
    mass = "1 kg"
    start = { at = ["1 m*cos(0.6) - 10 cm*sin(0.6)", "1 m*sin(0.6) + 10 cm*cos(0.6)"], velocity = ["-2 m/s*cos(0.6) - 0.14 m/s*sin(0.6)", "-2 m/s*sin(0.6) + 0.14 m/s*cos(0.6)"] }
    [surface.plane]
    through = ["-(2 cm)*sin((7 rad/s)*t)*sin(0.6)", "(2 cm)*sin((7 rad/s)*t)*cos(0.6)"]
    slope = "0.6 rad"
    rigid = { restitution = 0, friction = 0.2 }
    [force.push]
    on = "disk"
    at = "disk.cm"
    force = ["(1 N/s)*t", "2 N"]
"#;

/// In every scene and mode, what is printed has the value of what was integrated, along the motion itself.
#[test]
fn printed_equations_are_those_that_were_integrated() {
    let scenes = crate::scenes::all();
    let mut compared = 0;
    let [ladder, saddle, shaken] =
        [LADDER, SADDLE, SHAKEN].map(|scene| motions_in("scene", scene.as_bytes(), &tumble_scene::NoFiles));
    let others = [ladder, saddle, shaken, crate::scenes::laws()];
    for (study, cases) in scenes.map(|scene| motions_of(&scene)).chain(others) {
        let study = study.with(&cases[0].parameters);
        let names = Names::of(&study).expect("names");
        for Passed { case, mode } in passed::lasting(&cases).iter().take(MOST_MODES) {
            for motion in (Setting { study: &study, names: &names, case, mode }).motions() {
                compared += compare(case, mode, &motion);
            }
        }
    }
    assert!(compared > 20, "{compared}");
}

fn compare(case: &Case, mode: &Mode, motion: &Motion) -> usize {
    let trajectory = &case.run.trajectory();
    let number = trajectory.modes.iter().position(|other| other == mode).expect("a mode of the run");
    let shown = motion.shown().expect("it can be shown");
    let pieces: Vec<_> = trajectory.pieces.iter().filter(|piece| piece.mode == number).take(20).collect();
    let seats = seats_of(case, mode, pieces.first().copied());
    let mut compared = 0;
    for (line, Line { left, is, .. }) in shown.lines.iter().zip(&motion.lines) {
        let right = case.run.equations.in_states(mode, is);
        let integrated = left.factor.as_ref().map_or_else(|| right.clone(), |factor| factor * &right);
        // Places of joints are states of this mode alone.
        let both = [&line.formula, &integrated].map(|formula| seats.apply(formula));
        let mut both = case.run.observe(&both).expect("formulas of the states");
        for piece in &pieces {
            let middle = 0.5 * (piece.start + piece.end);
            let values = both.at(middle, Side::After).expect("within the run");
            let scale = values[1].abs().max(1e-3);
            assert!((values[0] - values[1]).abs() <= ROUNDING * scale, "{values:?}: {}", shown.text());
            compared += 1;
        }
    }
    compared
}

/// The numbers that the places of joints are in a mode.
fn seats_of(case: &Case, mode: &Mode, piece: Option<&tumble_ode::Piece>) -> Substitution {
    let symbols = case.run.equations.states(mode);
    let values = piece.map(|piece| piece.states_at(piece.end)).unwrap_or_default();
    let mut seats = Substitution::default();
    let places = symbols
        .into_iter()
        .zip(values)
        .filter(|(symbol, _)| symbol.dimension == Dimension::LENGTH && symbol.name.contains(".seat_"));
    places.for_each(|(symbol, value)| seats.insert(symbol, value * tumble_expr::units::M));
    seats
}

/// Of two corners on a slope the conditions are how the middle moves and how the body turns, beside the laws.
#[test]
fn conditions_of_two_contacts_are_added_up() {
    let (study, cases) = crate::scenes::motions_called("17-block");
    let study = study.with(&cases[0].parameters);
    let names = Names::of(&study).expect("names");
    let passed = passed::lasting(&cases[..1]).remove(0);
    let motion = Setting { study: &study, names: &names, case: passed.case, mode: &passed.mode }.motion(0);
    let lines: Vec<String> =
        motion.shown().expect("short").lines.iter().map(|line| math(&line.math()).text).collect();
    assert!(lines.contains(&"α = 0".to_owned()), "{lines:?}");
    assert!(lines.contains(&"A_x cos β + A_y sin β = −g sin β − μ_k g cos β".to_owned()), "{lines:?}");
    assert!(!motion.by_law.is_empty() && lines.len() == 3, "{lines:?}");
}

#[test]
fn conditions_say_once_what_they_are() {
    let (study, cases) = crate::scenes::motions_called("13-four-bar-linkage");
    let names = Names::of(&study).expect("names");
    let told = crate::fill::model::of(&study, &names, &cases).expect("a model").modes;
    let blocks = told.iter().flat_map(|mode| &mode.equations);
    let said = blocks.flat_map(|block| &block.definitions).filter(|one| one.symbol.text == "\u{2026} = 0");
    assert_eq!(said.map(|one| one.meaning.to_plain()).collect::<Vec<_>>(), [STAYS]);
}

#[test]
fn conditions_of_contacts_say_their_own_reasons() {
    let reasons = |scene: &str| {
        let (study, cases) = crate::scenes::motions_called(scene);
        let study = study.with(&cases[0].parameters);
        let names = Names::of(&study).expect("names");
        let told = crate::fill::model::of(&study, &names, &cases).expect("a model").modes;
        let lines = told.iter().flat_map(|mode| &mode.equations).flat_map(|block| &block.lines);
        let reason = |text: &str| {
            text.split_once("\u{2003}since ").map(|(left, why)| (left.to_owned(), why.to_owned()))
        };
        lines.filter_map(|line| reason(&line.text)).collect::<Vec<_>>()
    };
    let has = |scene: &str, left: &str, why: &str| {
        let all = reasons(scene);
        assert!(all.iter().any(|(line, reason)| line.starts_with(left) && reason == why), "{all:?}");
    };
    has("20-rolling-down", "A_y cos β − A_x sin β = 0", "the disk stays on the incline");
    has("28-painleve-rod", "A_y = ", "the foot stays on the floor");
    has("28-painleve-rod", "A_x = ", "the foot does not slip on the floor");
    has("17-block-on-a-slope", "α = 0", "the block does not turn");
    let slip = "corners 1 and 2 of the block do not slip on the incline";
    has("17-block-on-a-slope", "A_x cos β + A_y sin β = 0", slip);
}

#[test]
fn a_force_that_others_could_bear_is_said_to_be_a_choice() {
    let (study, cases) = crate::scenes::motions_called("16-bench-on-three-feet");
    let names = Names::of(&study).expect("names");
    let told = crate::fill::model::of(&study, &names, &cases).expect("a model").modes;
    let definitions = || told.iter().flat_map(|mode| &mode.equations).flat_map(|block| &block.definitions);
    let choice = definitions().find(|one| one.meaning.to_plain() == ONE_CHOICE).expect("it is said");
    assert_eq!(choice.symbol.text, "N_middle = 0");
    assert!(!told[0].name.to_plain().contains("without"), "{told:?}");
}
