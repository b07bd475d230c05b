//! Forces that act for a small part of the run, or along a small part of the way.

use std::f64::consts::PI;

use super::ask::{are, flight, force};

const SPRING: &str = r#"
[spring.cord]
between = ["p.cm", { world = [0, 0] }]
stiffness = "4 N/m"
rest_length = 0
"#;

/// Its impulse is 1000 N 1 ms sqrt(pi).
const PULSE: &str = "(1000 N)*exp(-((t - 3.3 s)/(1 ms))^2)";

/// The energy grows by 20 N 5 cm sqrt(pi).
#[test]
fn a_bump_along_the_way() {
    let scene = flight(&force("(20 N)*exp(-((p.x - 3.3 m)/(5 cm))^2)"));
    let work = PI.sqrt();
    let found = scene.ask(["p.vx", "push.work", "p.kinetic"]);
    are(&found, [(1.0 + 2.0 * work).sqrt(), work, 0.5 + work], 1e-9);
}

#[test]
fn a_pulse_in_a_flight() {
    let kick = PI.sqrt();
    let found = flight(&force(PULSE)).ask(["p.vx", "p.x", "p.vx at 3.2 s"]);
    are(&found, [1.0 + kick, 10.0 + 6.7 * kick, 1.0], 1e-8);
}

/// The flight is exact along y, and would be one step.
#[test]
fn a_pulse_across_a_fall() {
    let kick = PI.sqrt();
    let found = flight(&force(PULSE)).heavy().ask(["p.vx", "p.y", "p.vy"]);
    are(&found, [1.0 + kick, -490.5, -98.1], 1e-8);
}

/// A pulse that is over leaves the swing of an impulse at its centre, less exp(-(w 1 ms)^2/4).
#[test]
fn a_pulse_on_a_spring() {
    let kick = PI.sqrt() * (-(2e-3_f64).powi(2) / 4.0).exp();
    let (x, vx) = (20.0_f64.sin() + kick * 13.4_f64.sin(), 20.0_f64.cos() + kick * 13.4_f64.cos());
    let found = flight(&format!("{SPRING}{}", force(PULSE))).ask(["p.x", "p.vx"]);
    are(&found, [x / 2.0, vx], 1e-8);
}

/// The swing is too small and too slow to bend the steps where the pulse comes.
#[test]
fn a_pulse_beside_a_soft_spring() {
    let soft = SPRING.replace("4 N/m", "1e-4 N/m");
    let kick = PI.sqrt() * (-(1e-5_f64).powi(2) / 4.0).exp();
    let vx = 0.1_f64.cos() + kick * 0.067_f64.cos();
    flight(&format!("{soft}{}", force(PULSE))).ask(["p.vx"])[0].is(vx, 1e-8);
}

/// Far less than a millionth of all rates, and far more than the digits that are told.
#[test]
fn a_weak_narrow_force() {
    let kick = 5e-2 * PI.sqrt();
    for accuracy in [1e-3, 1e-6, 1e-12] {
        for weak in [1e-4, 5e-8, 1e-11] {
            let scene = flight(&force(&format!("({weak:e} N)*exp(-((t - 3.3 s)/(50 ms))^2)")));
            scene.accuracy(accuracy).ask(["p.vx"])[0].is(1.0 + weak * kick, (1e-2 * accuracy).max(1e-14));
        }
    }
}

/// The integral of ((1 + cos t)/2)^30 over five periods is 10 pi times a sixtieth row's middle binomial over 4^30.
#[test]
fn a_weak_force_by_a_high_power() {
    let middle: f64 = (1..=30).map(|k| (2 * k - 1) as f64 / (2 * k) as f64).product();
    for weak in [1e-3, 1e-11] {
        let scene = flight(&force(&format!("({weak:e} N)*((1 + cos(t/(1 s)))/2)^30"))).until("10*pi*(1 s)");
        scene.accuracy(1e-12).ask(["p.vx"])[0].is(1.0 + weak * 10.0 * PI * middle, 1e-13);
    }
}

/// A power of what is zero at the start is no singularity there.
#[test]
fn a_high_power_of_zero() {
    flight(&force("(1 N)*(t/(10 s))^199")).ask(["p.vx"])[0].is(1.0 + 10.0 / 200.0, 1e-10);
}

/// A force that an event begins and a time ends does not begin once that time has come.
#[test]
fn a_force_that_begins_after_its_end_does_not_act() {
    for (end, speed) in [("3 s", 1.0), ("5 s", 1.0), ("7 s", 3.0)] {
        let pushed = format!(
            "[event.there]\nwhen = \"p.x rises through 5 m\"\n{}during = [\"there\", \"{end}\"]\n",
            force("1 N")
        );
        flight(&pushed).ask(["p.vx"])[0].is(speed, 1e-12);
    }
}
