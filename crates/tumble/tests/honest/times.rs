//! Times of events and contacts, and what is looked at when they come.

use std::f64::consts::{FRAC_PI_6, PI};

use tumble::Case;

use super::ask::{Found, Scene, are, flight, force, scene};

const G: f64 = 9.81;
/// Accuracies with the largest errors that are of use at them: what was asked for is met with a reserve.
const ACCURACIES: [(f64, f64); 2] = [(1e-3, 1e-4), (1e-6, 1e-7)];

/// A ball that falls for 1 m.
const BALL: &str = r#"
[body.p]
point = {}
mass = "1 kg"
start = { at = [0, "1 m"] }
"#;

fn falling(surface: &str) -> Scene {
    scene(&format!("{BALL}[surface.floor]\nthrough = [0, 0]\n{surface}")).heavy().until("5 s")
}

/// Complete elliptic integral of the first kind, by the arithmetic-geometric mean.
fn quarter(modulus: f64) -> f64 {
    let mean = |(a, b): (f64, f64)| (0.5 * (a + b), (a * b).sqrt());
    let both = (0..20).fold((1.0, (1.0 - modulus * modulus).sqrt()), |both, _| mean(both));
    PI / (2.0 * both.0)
}

#[test]
fn of_impacts() {
    let scene = falling("rigid = { restitution = 0.5 }\n");
    let first = (2.0 / G).sqrt();
    let asked = [
        "floor.contact[1].start",
        "floor.contact[3].start",
        "floor.contact[2].start - floor.contact[1].start",
    ];
    for (accuracy, _) in ACCURACIES {
        are(&scene.clone().accuracy(accuracy).ask(asked), [first, 2.5 * first, first], 1e-12);
    }
}

/// Pressed, x = -g/k (1 - cos w t) - v/w sin w t, which is zero again where tan(w t/2) = -v w/g.
#[test]
fn of_contacts_with_a_spring() {
    let scene = falling("spring = { stiffness = \"1e4 N/m\", damping = 0 }\n");
    let fall = (2.0 / G).sqrt();
    let lasts = 2.0 / 100.0 * (PI - (100.0 * fall).atan());
    let asked = [
        "floor.contact[1].start",
        "floor.contact[1].end",
        "floor.contact[1].duration",
        "floor.contact[2].start - floor.contact[1].end",
        "floor.contact[3].duration",
    ];
    for (accuracy, most) in ACCURACIES {
        let found = scene.clone().accuracy(accuracy).ask(asked);
        are(&found, [fall, fall + lasts, lasts, 2.0 * fall, lasts], most);
    }
}

const PENDULUM: &str = r#"
[body.p]
rod = { from = [0, 0], to = [0, "-1 m"] }
mass = "1 kg"
start = { angle = "2 rad" }
[pivot.hinge]
body = "p"
point = [0, 0]
world = [0, 0]
[event.back]
when = "p.omega passes through 0 rad/s"
"#;

/// Half a period is 2 K(sin(a/2)) over the frequency of small swings, and sin(a/2) is that of 1 rad.
#[test]
fn of_a_pendulum_s_turns() {
    let half = 2.0 * quarter(1.0_f64.sin()) / (1.5 * G).sqrt();
    let scene = scene(PENDULUM).heavy().until("5 s");
    let asked = ["back", "back[2]", "back[2] - back[1]", "p.angle at back", "p.angle at back[2]"];
    for (accuracy, most) in ACCURACIES {
        are(&scene.clone().accuracy(accuracy).ask(asked), [half, 2.0 * half, half, -2.0, 2.0], most);
    }
}

#[test]
fn of_a_swing_s_passings_and_what_is_then() {
    let swing = force("-(1 N/m)*p.x") + "[event.up]\nwhen = \"p.x rises through 0.5 m\"\n";
    let asked = ["up[5]", "p.vx at up[5]", "p.x at up[5]", "p.kinetic at up[5]"];
    let truth = [FRAC_PI_6 + 8.0 * PI, 0.75_f64.sqrt(), 0.5, 0.375];
    for (accuracy, most) in ACCURACIES {
        are(&flight(&swing).until("30 s").accuracy(accuracy).ask(asked), truth, most);
    }
}

/// Start of the contact that lasts to the end.
fn rest(case: &Case) -> Found {
    let contacts = case.run.contacts();
    let time = contacts.last().expect("a contact").start;
    let error = case.trust.as_ref().and_then(|trust| trust.event_error(&case.run, time));
    Found { what: "rest".into(), value: time, error: error.unwrap_or(f64::INFINITY) }
}

/// The bounces end 35 m down the slope: u (1 + 2 e/(1 - e)) over the gravity across it.
#[test]
fn of_the_limit_of_bounces_down_a_slope() {
    let scene = falling("slope = \"-30 deg\"\nrigid = { restitution = 0.8 }\n");
    let across = G * FRAC_PI_6.cos();
    let speed = FRAC_PI_6.cos() * (2.0 * G).sqrt();
    for (accuracy, _) in ACCURACIES {
        let case = scene.clone().accuracy(accuracy).run(&[]);
        rest(&case).is(9.0 * speed / across, 1e-5);
    }
}

/// Late bounces are lower than the rounding of their place, which is the same at all of them: their times are known all the same.
#[test]
fn of_bounces_lower_than_their_place_is_known() {
    let (gravity, fall) = (9.1e-10, 1.6_f64);
    // Both ends of the rod strike at once.
    let shapes = [("point = {}", 15), ("rod = { from = [0, 0], to = [\"0.3 m\", 0] }", 29)];
    for (shape, contact) in shapes {
        let scene = scene(&format!(
            "[parameters]\nheight = \"46.221 m\"\n[body.p]\n{shape}\nmass = \"1 kg\"\n\
             start = {{ at = [0, \"height + 1.6 m\"] }}\n\
             [surface.floor]\nthrough = [0, \"height\"]\nrigid = {{ restitution = 0.5 }}\n\
             [force.weight]\non = \"p\"\nat = \"p.cm\"\nforce = [0, \"-9.1e-10 N\"]\n"
        ));
        let first = (2.0 * fall / gravity).sqrt();
        let case = scene.until("2e5 s").accuracy(1e-7).run(&[&format!("floor.contact[{contact}].start")]);
        Found::of(&case.finds[0]).is(first * (1.0 + 2.0 * (1.0 - 0.5_f64.powi(14))), 1e-8);
        rest(&case).is(3.0 * first, 1e-8);
    }
}

/// A claim that is not known to hold says so, also of a time.
#[test]
fn a_claim_on_a_time_is_doubted() {
    let sure = |scene: &str, accuracy: f64| {
        let scene = self::scene(scene).heavy().until("5 s").accuracy(accuracy);
        let check = scene.run(&[]).checks.remove(0);
        (check.holds, check.is_sure())
    };
    let coarse = scene(PENDULUM).heavy().until("5 s").accuracy(1e-3).ask(["back"]);
    let claim = |time: f64| {
        format!("{PENDULUM}[check.half]\nthat = \"back\"\nequals = \"{time:?} s\"\nwithin = \"1e-9 s\"\n")
    };
    assert_eq!(sure(&claim(coarse[0].value), 1e-3), (true, false));
    let half = 2.0 * quarter(1.0_f64.sin()) / (1.5 * G).sqrt();
    assert_eq!(sure(&claim(half), 1e-9), (true, true));
}
