//! Quantities that jump, or have no value, elsewhere in the run.

use std::f64::consts::PI;

use super::ask::{are, flight, force, scene};

/// The point goes round the origin once in 2 pi s.
const CIRCLE: &str = r#"
[body.p]
point = {}
mass = "1 kg"
start = { at = ["1 m", 0], velocity = [0, "1 m/s"] }
[spring.cord]
between = ["p.cm", { world = [0, 0] }]
stiffness = "1 N/m"
rest_length = 0
"#;

#[test]
fn what_is_singular_at_the_start_is_known_at_the_end() {
    are(
        &flight("").ask(["p.vx/t", "p.x/t", "sin(t/(1 s))/t at 3.3 s"]),
        [0.1, 1.0, 3.3_f64.sin() / 3.3],
        1e-12,
    );
    let found = flight(&force("sin(t/(1 s))*(1 N)")).ask(["p.vx/t", "p.x/t"]);
    are(&found, [(2.0 - 10.0_f64.cos()) / 10.0, 2.0 - 10.0_f64.sin() / 10.0], 1e-9);
    let found = flight(&force("-(4 N/m)*p.x")).ask(["p.vx/t", "p.x/t"]);
    are(&found, [20.0_f64.cos() / 10.0, 20.0_f64.sin() / 20.0], 1e-9);
}

#[test]
fn what_is_singular_at_the_end_is_known_before() {
    let found = flight(&force("-(4 N/m)*p.x")).ask(["p.vx/(10 s - t) at 5 s", "1/(10 s - t) at 7.5 s"]);
    are(&found, [10.0_f64.cos() / 5.0, 0.4], 1e-9);
}

/// At the event the motion and its check runs may be on either side of the jump.
const WEST: &str = "[event.west]\nwhen = \"p.y falls through 0 m\"\n";

#[test]
fn an_angle_that_jumps_elsewhere() {
    let angle = ["atan2(p.y, p.x)", "atan2(p.y, p.x) at 2 s", "atan2(p.y, p.x) at 3.15 s"];
    for sections in [CIRCLE.to_owned(), format!("{CIRCLE}{WEST}")] {
        are(&scene(&sections).ask(angle), [10.0 - 4.0 * PI, 2.0, 3.15 - 2.0 * PI], 1e-9);
    }
}

#[test]
fn a_choice() {
    let asked = [
        "if(p.x < 0.5 m, p.y, p.x)",
        "if(p.y < 0 m, p.x, 2 m)",
        "if(p.y < 0 m, p.x, 2 m) at 2 s",
        "if(p.x < 2 m, p.vy, 3 m/s) at 7 s",
        "if(p.x < 0 m, 1 m, 2 m)",
    ];
    let (ten, seven) = (10.0_f64.sin_cos(), 7.0_f64.cos());
    for sections in [CIRCLE.to_owned(), format!("{CIRCLE}{WEST}")] {
        are(&scene(&sections).ask(asked), [ten.0, ten.1, 2.0, seven, 1.0], 1e-9);
    }
    are(&flight("").ask(["if(p.x < 3.3 m, p.x, 2*p.x)"]), [20.0], 1e-9);
}
