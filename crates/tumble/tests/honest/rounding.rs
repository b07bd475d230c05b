//! Motions that make much of rounding errors: what is stated grows with what they come to.

use std::f64::consts::SQRT_2;

use crate::ask::{are, flight, force, scene};

/// The times of the window are known to 9 digits of its length.
#[test]
fn a_short_window_of_a_great_force() {
    let window =
        |from: &str, to: &str| flight(&(force("1e6 N") + &format!("during = [\"{from}\", \"{to}\"]\n")));
    for (from, to) in [("3.3 s", "3.3 s + 1 us"), ("3.3 s", "3.300001 s")] {
        let found = window(from, to).ask(["p.vx", "p.x", "push.work"]);
        are(&found, [2.0, 16.7 - 0.5e-6, 1.5], 1e-6);
    }
}

/// sin(20000) and cos(20000), to 17 digits.
const SWUNG: [f64; 2] = [0.581_984_761_994_295, 0.813_199_690_608_920_4];

#[test]
fn a_swing_for_a_long_time() {
    let found = flight(&force("-(4 N/m)*p.x")).until("1e4 s").ask(["p.x", "p.vx"]);
    are(&found, [SWUNG[0] / 2.0, SWUNG[1]], 1e-10);
}

/// x'' = 2 x on its way to the origin: what is rounded at the start grows by exp(sqrt(2) t).
#[test]
fn towards_an_unstable_rest() {
    let start = "[body.p]\npoint = {}\nmass = \"1 kg\"\n\
                 start = { at = [\"1 m\", 0], velocity = [\"-sqrt(2)*(1 m/s)\", 0] }\n";
    let leaving = scene(&format!("{start}{}", force("(2 N/m)*p.x")));
    for (until, most) in [("5 s", 1e-11), ("10 s", 1e-7), ("14 s", 1e-5), ("15 s", 1e-4)] {
        let time: f64 = until.trim_end_matches(" s").parse().expect("a number");
        let x = (-SQRT_2 * time).exp();
        are(&leaving.clone().until(until).ask(["p.x", "p.vx"]), [x, -SQRT_2 * x], most);
    }
}

const ROOM: &str = r#"
[surface.left]
through = ["-0.7 m", 0]
normal = [1, 0]
rigid = { restitution = 1 }
[surface.right]
through = ["0.7 m", 0]
normal = [-1, 0]
rigid = { restitution = 1 }
"#;

/// To and fro in 2.8 s: 10000.7 s are 3571 times and 1.9 s.
#[test]
fn equal_flights_between_walls() {
    let found = flight(ROOM).until("1e4 s").ask(["p.x", "p.vx", "right.contact[3000].start"]);
    are(&found, [0.2, -1.0, 0.7 + 2999.0 * 2.8], 1e-6);
}

/// y and vy after 1e4 s, and the time of the 10000th impact, (2 n - 1) sqrt(2/g), computed with 50 digits.
const BOUNCED: [f64; 3] = [0.414_148_067_841_281, 3.390_341_414_806_784_3, 9_030.021_296_073_632];

const BOUNCING: &str = r#"
[body.p]
point = {}
mass = "1 kg"
start = { at = [0, "1 m"] }
[surface.floor]
through = [0, 0]
rigid = { restitution = 1 }
"#;

/// Flights of 2 sqrt(2/g), of which each passes on what is rounded in the ones before it.
#[test]
fn equal_flights_above_a_floor() {
    let found = scene(BOUNCING).heavy().until("1e4 s").ask(["p.y", "p.vy", "floor.contact[10000].start"]);
    are(&found, BOUNCED, 1e-2);
}
