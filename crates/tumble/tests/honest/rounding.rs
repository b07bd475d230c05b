//! Motions that make much of rounding errors: what is stated grows with what they come to.

use std::f64::consts::{PI, SQRT_2};

use super::ask::{are, flight, force, scene, walls};

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

/// To and fro in 2.8 s: 10000.7 s are 3571 times and 1.9 s.
#[test]
fn equal_flights_between_walls() {
    let found =
        flight(&walls("-0.7 m", "0.7 m")).until("1e4 s").ask(["p.x", "p.vx", "right.contact[3000].start"]);
    are(&found, [0.2, -1.0, 0.7 + 2999.0 * 2.8], 1e-6);
}

/// All flights lose the same by rounding, and the times of their ends in the same direction: hundreds of them add up. Between
/// their ends too a place is that of the time as it was before it was rounded.
#[test]
fn equal_flights_lose_nothing_of_their_ends() {
    // nm and um/s, so that the way is exact in times of whole ms.
    for (width, start, speed) in [(80_000_000_i64, 41_000_000, -19_332), (62_600_000, 31_300_000, 267_400)] {
        let at = format!("start = {{ at = [\"{start}e-9 m\", 0], velocity = [\"{speed}e-6 m/s\", 0] }}");
        let walls = walls("0 m", &format!("{width}e-9 m"));
        let body = format!("[body.p]\npoint = {{}}\nmass = \"1 kg\"\n{at}\n{walls}");
        let times = [17_000, 278_000, 431_500, 923_250, 1_429_750, 1_536_250, 2_031_200, 2_822_000];
        let questions = times.map(|time| format!("p.x at {time}e-3 s"));
        let found = scene(&body).until("3000 s").ask(questions.each_ref().map(String::as_str));
        for (found, time) in found.iter().zip(times) {
            let there = i64::rem_euclid(start + speed * time, 2 * width);
            found.is(there.min(2 * width - there) as f64 / 1e9, 1e-11);
        }
    }
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

/// Each window is known to what rounding leaves of both its ends, however these are written.
#[test]
fn both_ends_of_a_short_window_are_rounded() {
    for (from, to, length) in [
        ("1.1641 s", "1.16410013 s", "1.3e-7 s"),
        ("1.1641 s", "1.1641 s + 1.3e-7 s", "1.3e-7 s"),
        ("7937.8 us", "7937.801 us", "0.001 us"),
        ("0.02 s", "0.020000006431 s", "6.431e-3 us"),
        ("300 s", "300 s + 2.37e-6 s", "2.37e-6 s"),
        ("9870 s", "9870 s + 0.0138 s", "0.0138 s"),
        ("1e4 s", "10000.006 s", "6 ms"),
        ("428.646 s", "428.646 s + 6.92e-6 s", "6.92e-6 s"),
    ] {
        let window =
            force(&format!("(1 N)*(1 s)/({length})")) + &format!("during = [\"{from}\", \"{to}\"]\n");
        are(&flight(&window).until("12000 s").ask(["p.vx", "push.work"]), [2.0, 1.5], 1e-5);
    }
}

/// What is far from the origin starts an ulp off, also where its place is a sum of numbers, which is moved once.
#[test]
fn a_start_far_from_the_origin_is_rounded() {
    for floor in (0..80).map(|i| 28_000 + 137 * i) {
        let falling = format!(
            "[body.p]\npoint = {{}}\nmass = \"1 kg\"\n\
             start = {{ at = [0, \"({floor} m) + (0.1 m) + (0.519 m)\"], velocity = [0, \"-1 m/s\"] }}\n\
             [surface.floor]\nthrough = [0, \"{floor} m\"]\nrigid = {{ restitution = 1 }}\n"
        );
        let found = scene(&falling).ask(["floor.contact[1].start"]);
        found[0].is(0.619, 1e-9);
    }
}

/// A spring that begins to act far from the origin: its force has the rounding of the place through the last step as well.
/// Speeds are `v cos(w (T - x/v))`, computed with 40 digits.
#[test]
fn a_spring_far_from_the_origin_is_rounded() {
    let far = |at: &str, speed: &str, place: &str, stiffness: &str, mass: &str| {
        scene(&format!(
            "[parameters]\nstiffness = \"0 N/m\"\n[body.p]\npoint = {{}}\nmass = \"{mass}\"\n\
             start = {{ at = [\"{at}\", 0], velocity = [\"{speed}\", 0] }}\n\
             [event.there]\nwhen = \"p.x - ({at}) rises through {place}\"\n\
             action = {{ set = {{ stiffness = \"{stiffness}\" }} }}\n{}",
            force(&format!("-stiffness*(p.x - ({at}) - ({place}))"))
        ))
    };
    let near = far("-2e5 m", "1 m/s", "0.2 m", "9.8 N/m", "1 kg").until("0.36366 s");
    near.accuracy(8.7e-10).ask(["p.vx"])[0].is(0.871_601_333_971_249_5, 1e-7);
    let fast = far("-1.3e9 m", "4.6e4 m/s", "1.69e5 m", "0.4035 N/m", "10 kg").until("6.7111 s");
    fast.accuracy(7.8e-8).ask(["p.vx"])[0].is(37_701.459_614_461_28, 1e-5);
}

/// Numbers move by whole ulps, and two of them by as many: what is left out of the moves of a start is its own.
#[test]
fn a_start_by_numbers_is_rounded() {
    for number in 0..400 {
        let floor = format!("-22.{:04}", 3000 + 13 * number);
        let falling = format!(
            "[body.p]\npoint = {{}}\nmass = \"1 kg\"\n\
             start = {{ at = [0, \"({floor} m) + (213.968 mm)\"], velocity = [0, \"-1e-5 m/s\"] }}\n\
             [surface.floor]\nthrough = [0, \"{floor} m\"]\nrigid = {{ restitution = 1 }}\n"
        );
        let found = scene(&falling).until("22000 s").ask(["floor.contact[1].start"]);
        found[0].is(21_396.8, 1e-8);
    }
}

/// All runs round a place far away alike, and so do the forces of a spring there; their works have errors all the same.
#[test]
fn a_work_far_from_the_origin_is_rounded() {
    for number in 0..400 {
        let far = 2_661_200_000_u64 + 17 * number;
        let speed = 0.2 + 0.013 * number as f64;
        let spring = format!(
            "[body.p]\npoint = {{}}\nmass = \"1.63e-2 kg\"\n\
             start = {{ at = [\"{far} m + 30000 m\", 0], velocity = [\"-{speed} m/s\", 0] }}\n{}",
            force(&format!("-(2e-10 kg/s^2)*(p.x - {far} m)"))
        );
        let (omega, time) = ((2e-10_f64 / 1.63e-2).sqrt(), 3248.29_f64);
        let x = 3e4 * (omega * time).cos() - speed / omega * (omega * time).sin();
        let found = scene(&spring).until("3248.29 s").accuracy(4e-7).ask(["push.work"]);
        found[0].is(1e-10 * (9e8 - x * x), 1e-9);
    }
}

/// A window's ends are times that may be rounded alike in all runs: its length has an error of its own.
#[test]
fn the_work_within_a_short_window_is_rounded() {
    for number in 0..40 {
        let start = 692.333 + 1.7 * f64::from(number);
        let window = force("-1e5 N") + "during = [\"start\", \"start + 600 us\"]\n";
        let kicked = format!("[parameters]\nstart = \"{start} s\"\n{window}");
        let found = flight(&kicked).until("955.96 s").ask(["push.work"]);
        found[0].is(0.5 * (59.0_f64 * 59.0 - 1.0), 1e-5);
    }
}

/// What starts by a sum far away is rounded before the first step, and all that happens within that step with it.
#[test]
fn the_first_passing_of_a_spring_far_away_is_rounded() {
    let (omega, speed, place) = (5.2e-5_f64, -7.6e-5, -2.4314);
    for number in 0..100 {
        let offset = -2.2 - 0.001 * f64::from(number);
        let swing = format!(
            "[parameters]\nanchor = \"8800 m\"\noffset = \"{offset:.3} m\"\n\
             [body.p]\npoint = {{}}\nmass = \"1 kg\"\n\
             start = {{ at = [\"anchor + offset\", 0], velocity = [\"{speed} m/s\", 0] }}\n\
             [event.pass]\nwhen = \"p.x - anchor rises through {place} m\"\n{}",
            force("-(2.704e-9 kg/s^2)*(p.x - anchor)")
        );
        let (amplitude, late) = (offset.hypot(speed / omega), (speed / omega).atan2(offset));
        let time = (late.rem_euclid(2.0 * PI) - (place / amplitude).acos()) / omega;
        let found = scene(&swing).until("1e5 s").accuracy(1e-8).ask(["t at pass[1]", "p.vx at pass[1]"]);
        found[0].is(time, 1e-6);
        found[1].is(omega * (amplitude * amplitude - place * place).sqrt(), 1e-14);
    }
}

/// All runs round alike the places that two disks meet at, and what an impulse has of each direction is known as far as these are.
#[test]
fn an_impulse_far_from_the_origin_is_rounded() {
    let meeting = |far: u64| {
        let disk = |name: &str, start: &str| {
            format!("[body.{name}]\ndisk = {{ radius = \"1 m\" }}\nmass = \"1 kg\"\nstart = {{ {start} }}\n")
        };
        let first = disk("a", &format!("at = [\"{far} m - 3.1 m\", \"0.7 m\"], velocity = [\"1 m/s\", 0]"));
        let second = disk("b", &format!("at = [\"{far} m\", 0]"));
        let law = "[contact.rims]\nbetween = [\"a\", \"b\"]\nrigid = { restitution = 0.8, friction = 0.1 }\n";
        let asked = ["rims.contact[1].impulse.x", "rims.contact[1].impulse.y"];
        scene(&(first + &second + law)).ask(asked)
    };
    let known = meeting(0);
    are(&known, known.each_ref().map(|near| near.value), 1e-13);
    for number in 0..40 {
        let found = meeting(1_000_000_000 + 17 * number);
        are(&found, known.each_ref().map(|near| near.value), 1e-5);
    }
}

/// Far above the origin y cannot take up what keeps a disk on its slope, and x takes it, in all runs.
#[test]
fn what_rolls_far_above_the_origin_is_rounded() {
    let (slope, lever, speed) = (-0.0449796_f64, 7e-3, 1.045);
    let slows = ((-slope).sin() + lever * slope.cos()) * 2.0 / 3.0;
    let truth = -213.011 - slope.sin() - 0.5 * speed * speed / slows * slope.cos();
    for number in 0..120 {
        let foot = 617_300 + 17 * number;
        let rolling = format!(
            "[parameters]\nslope = \"-44.9796 mrad\"\nspeed = \"-1.045 m/s\"\nx = \"-213.011 m\"\n\
             [body.p]\ndisk = {{ radius = \"1 m\" }}\nmass = \"1 kg\"\n\
             [body.p.start]\nat = [\"x - (1 m)*sin(slope)\", \"({foot} m) + (1 m)*cos(slope)\"]\n\
             velocity = [\"speed*cos(slope)\", \"speed*sin(slope)\"]\nomega = \"-speed/(1 m)\"\n\
             [surface.floor]\nthrough = [\"x\", \"{foot} m\"]\nslope = \"slope\"\n\
             rigid = {{ restitution = 0, friction = 5, rolling = \"7e-3 m\" }}\n"
        );
        let found = scene(&rolling).gravity("1 m/s^2").until("81.19 s").accuracy(1.7e-4);
        found.ask(["p.x at floor.p.turns[2]"])[0].is(truth, 1e-9);
    }
}

/// Friction and what presses hold it, and what rounding leaves of their sum moves nothing: after a year its place is known as well as before.
#[test]
fn what_rests_is_known_for_as_long() {
    let block = "[body.p]\nbox = { width = \"40 cm\", height = \"2 cm\" }\nmass = \"1.3 kg\"\n\
                 [body.p.start]\nat = [\"-sin(0.1 rad)*1 cm\", \"cos(0.1 rad)*1 cm\"]\n\
                 velocity = [\"cos(0.1 rad)*1 m/s\", \"sin(0.1 rad)*1 m/s\"]\nangle = \"0.1 rad\"\n\
                 [surface.floor]\nthrough = [0, 0]\nslope = \"0.1 rad\"\nrigid = { restitution = 0, friction = 0.3 }\n";
    let (sine, cosine) = 0.1_f64.sin_cos();
    let truth = 0.5 * cosine / (9.81 * (sine + 0.3 * cosine)) - 0.01 * sine;
    for until in ["2 s", "3e7 s"] {
        scene(block).heavy().until(until).ask(["p.x"])[0].is(truth, 1e-14);
    }
}

/// Far from the origin a stiff floor presses with a force that is known to four digits, and friction is off as it is: once the ball rolls, what rounding has
/// made of its speed it has made of its spin, and none of it is left.
#[test]
fn friction_is_off_as_what_presses_is() {
    let ball = "[body.p]\nball = { radius = \"0.398 m\" }\nmass = \"300 kg\"\n\
                start = { at = [\"4.24e5 m\", \"-3.202e6 m + 0.398 m + 1.457 m\"], \
                velocity = [\"-0.2251 m/s\", \"-0.22774 m/s\"], omega = \"-1.1589 rad/s\" }\n\
                [surface.floor]\nthrough = [0, \"-3.202e6 m\"]\n\
                spring = { stiffness = \"5.593e11 N/m\", damping = \"0 N*s/m\", friction = 0.51 }\n";
    let slip = -0.2251 - 1.1589 * 0.398;
    let found = scene(ball).until("12.1 s").accuracy(7.3e-5).ask(["p.vx", "p.omega"]);
    let speed = -0.2251 - slip * 2.0 / 7.0;
    are(&found, [speed, -speed / 0.398], 1e-13);
}

/// No more digits are told of all of a motion than of its parts: rounding counts wherever what moves is more than that.
#[test]
fn all_of_a_motion_has_no_more_digits_than_its_parts() {
    let case = scene(BOUNCING).heavy().until("10 s").run(&["p.vy"]);
    let (error, fastest) = (case.finds[0].error.expect("an error"), (2.0 * 9.81_f64).sqrt());
    let reached = case.trust.expect("check runs").reached;
    assert!(reached >= 0.5 * error / fastest && error > 1e-14, "{reached:e} of all, {error:e} of the speed");
}
