//! Events that come and go within a small part of a step.

use super::ask::{are, flight};

/// Where the steps and bumps are, m, and when the point is there, s.
const PLACE: f64 = 3.3;

fn event(when: &str, action: &str) -> String {
    format!("[event.there]\nwhen = \"{when}\"\naction = \"{action}\"\n")
}

#[test]
fn steep_steps_are_met() {
    let tanh = PLACE + 0.03 * 0.5_f64.atanh();
    for (step, when) in [
        ("tanh((p.x - 3.3 m)/(3 cm))", tanh),
        ("1/(1 + exp(-(p.x - 3.3 m)/(3 cm)))", PLACE),
        ("1/(1 + exp(-(p.x - 3.3 m)/(0.1 mm)))", PLACE),
    ] {
        let scene = flight(&event(&format!("{step} rises through 0.5"), "record"));
        are(&scene.ask(["t at there", "p.x at there", "there"]), [when; 3], 1e-12);
    }
}

/// Bumps with their half widths where they are half as high, m.
const BUMPS: [(&str, f64); 2] = [
    ("exp(-((p.x - 3.3 m)/(30 cm))^2)", 0.249_766_383_347_309_13), // 0.3 sqrt(ln 2)
    ("1/(1 + ((p.x - 3.3 m)/(30 cm))^2)", 0.3),
];

#[test]
fn bumps_stop_a_motion_on_either_side() {
    for (bump, half) in BUMPS {
        for (way, when) in [("rises", PLACE - half), ("falls", PLACE + half)] {
            let scene = flight(&event(&format!("{bump} {way} through 0.5"), "stop"));
            are(&scene.ask(["t", "p.x"]), [when; 2], 1e-12);
        }
    }
}

#[test]
fn bumps_are_passed_up_and_down() {
    for (bump, half) in BUMPS {
        let scene = flight(&event(&format!("{bump} passes through 0.5"), "record"));
        let found = scene.ask(["there[1]", "there[2]", "there[2] - there[1]"]);
        are(&found, [PLACE - half, PLACE + half, 2.0 * half], 1e-12);
        assert_eq!(scene.run(&[]).run.trajectory().events.len(), 2);
    }
}

/// What is infinite for most of the run does not hide where it is one.
#[test]
fn guards_that_overflow_are_met() {
    for (guard, when) in [
        ("exp((p.x/(5 cm))^2) rises through 2", 0.05 * 2.0_f64.ln().sqrt()),
        ("exp(p.x/(1 mm)) rises through 1e20", 0.02 * 10.0_f64.ln()),
        ("exp((p.x - 9 m)/(1 mm)) rises through 1", 9.0),
    ] {
        let scene = flight(&event(guard, "record"));
        are(&scene.ask(["t at there", "p.x at there"]), [when; 2], 1e-12);
    }
}

#[test]
fn the_top_of_a_narrow_peak_is_known() {
    let peak = "exp(-((p.x - 3.3 m)/(1 cm))^2)";
    let question = format!("{peak} at its greatest");
    let case = flight("").run(&[&question]);
    let top = &case.finds[0];
    assert!((top.at - PLACE).abs() < 1e-12, "{top:?}");
    flight("").ask([&question])[0].is(1.0, 1e-12);
}
