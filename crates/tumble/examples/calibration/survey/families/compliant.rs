//! A ball on a floor that gives way.
//!
//! # Law
//!
//! m d'' = m g - k d - c d' while the depth d is positive; let go where the force vanishes, or at the surface.
//!
//! # Closed form
//!
//! Without damping, with w^2 = k/m and the speed v at first touch: it lasts (2/w)(pi - atan(v w/g)), half a period
//! without weight, and ends with the speed v. The depth is at most g/w^2 + sqrt(g^2/w^4 + v^2/w^2). Without weight and
//! with damping, b = c/(2m) and s^2 = w^2 - b^2: d = (v/s) exp(-b t) sin(s t), which ends at t = pi/s at the surface, and
//! at zero force where tan(s t) = -2 b s/(w^2 - 2 b^2).
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, §§ 21 and 25.

use super::super::ball::Ball;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::touch::{Fall, Touch};
use super::super::units::{ACCELERATION, DAMPING, ENERGY, FORCE, LENGTH, SPEED, STIFFNESS, TIME};

/// How long a contact is, in parts of the time before it.
const BRIEF: [f64; 2] = [1e-5, 0.3];
/// Damping in parts of the critical.
const DAMPINGS: [f64; 2] = [0.01, 0.7];
/// Contacts of a run with weight.
const MOST: f64 = 200.0;

pub(super) fn make(mut setup: Setup) -> Problem {
    let ball = Ball::random(&mut setup);
    let with_weight = setup.draw.chance(0.5);
    let gravity = setup.given("g", if with_weight { 1.0 } else { 0.0 }, ACCELERATION);
    let brief = setup.draw.log_between(BRIEF[0], BRIEF[1]);
    let stiffness = setup.given("stiffness", (std::f64::consts::PI / brief).powi(2), STIFFNESS);
    let release = setup.draw.pick(&["at zero force", "at the surface"]);
    let fall = Fall::new(&gravity.value, &ball.height.value, &ball.vy.value);
    let frequency = (&stiffness.value / &ball.mass.value).sqrt();
    let size = setup.draw.log_between(DAMPINGS[0], DAMPINGS[1]) * std::f64::consts::PI / brief * 2.0;
    let damping = setup.given("damping", if with_weight { 0.0 } else { size }, DAMPING);
    ball.write(
        &mut setup,
        &format!(
            "spring = {{ stiffness = \"{stiffness}\", damping = \"{damping}\", release = \"{release}\" }}"
        ),
    );
    let touch = if with_weight {
        Touch::heavy(&fall, &gravity.value, &frequency)
    } else {
        let half = &damping.value / &ball.mass.value / 2;
        Touch::damped(&fall.speed, [&frequency, &half], release == "at zero force")
    };
    let until = if with_weight {
        ask_many(&mut setup, (&ball, &stiffness), &fall, &touch, &gravity)
    } else {
        ask_one(&mut setup, &ball, &fall, &touch)
    };
    setup.problem(&gravity.word, &until)
}

/// A contact without weight, and the motion after it.
fn ask_one(setup: &mut Setup, ball: &Ball, fall: &Fall, touch: &Touch) -> Given {
    let size = (&fall.time * 2 + &touch.duration).to_f64();
    let end = &fall.time + &touch.duration * 2;
    let found = setup.time("until", |draw| size * draw.between(0.9, 2.0), |time| *time > end);
    let until = found.unwrap_or_else(|| setup.near("until", &(end * 3), TIME));
    ball.ask_first(setup, fall, touch);
    setup.ask("p.vy", At::End, &touch.after, SPEED);
    let energy = |speed: &Real| &ball.mass.value * speed.squared() / 2;
    setup.ask("floor.work", At::End, &(energy(&touch.after) - energy(&fall.speed)), ENERGY);
    until
}

/// Contact after contact under its weight.
fn ask_many(
    setup: &mut Setup,
    (ball, stiffness): (&Ball, &Given),
    fall: &Fall,
    touch: &Touch,
    gravity: &Given,
) -> Given {
    let flight = &fall.speed * 2 / &gravity.value;
    let period = &touch.duration + &flight;
    let count = setup.draw.log_between(1.0, MOST) as i64;
    let begin = |count: i64| &fall.time + &period * (count - 1);
    let end = begin(count) + &touch.duration;
    let [low, high] = [10, 90].map(|part| &end + &flight * part / 100);
    let found = setup.time(
        "until",
        |draw| draw.between(low.to_f64(), high.to_f64()),
        |time| low < *time && *time < high,
    );
    let until = found.unwrap_or_else(|| setup.near("until", &(begin(1) / 2), TIME));
    if until.value < end {
        return until;
    }
    ball.ask_first(setup, fall, touch);
    let since = &until.value - end;
    setup.ask("p.vy", At::End, &(&fall.speed - &gravity.value * &since), SPEED);
    setup.ask("floor.p.rim.gap", At::End, &((&fall.speed - &gravity.value * &since / 2) * since), LENGTH);
    setup.ask("floor.normal", At::Greatest(None), &(&stiffness.value * &touch.depth), FORCE);
    setup.ask_time(&format!("floor.contact[{count}].start"), &begin(count));
    setup.ask(&format!("floor.contact[{count}].duration"), At::End, &touch.duration, TIME);
    until
}
