//! Something round with spin on a rough compliant floor, without weight: one bounce.
//!
//! # Law
//!
//! Friction is mu times the normal force against the slip s = v + omega R, as long as there is any; then it rolls, held by none.
//!
//! # Closed form
//!
//! Of the normal impulse J of a mass of one, v changes by -mu J and omega by -mu J/(k R), with k m R^2 the moment of inertia; the place by -mu (v_n t - d). It rolls from
//! J = |s|/(mu (1 + 1/k)) on if the whole bounce has as much, when the speed across the floor is v_n - J (`touch::Law`).
//!
//! # Source
//!
//! Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV.

use super::super::ground::{Round, friction};
use super::super::pad::Pad;
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{LENGTH, MASS, RATE, SPEED, TIME};

/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.02, 1.5];
/// Nearer to the threshold of rolling, in parts of it, rounding may decide.
const APART: f64 = 1e-6;

pub(super) fn make(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let round = Round::random(&mut setup);
    let [foot, x] = ["foot", "x"].map(|name| setup.shift(name));
    let height = setup.draw.log_between(0.05, 3.0);
    let height = setup.given("height", height, LENGTH);
    let down = setup.given("down", 1.0, SPEED);
    let size = setup.draw.between(-2.0, 2.0);
    let along = setup.given("along", size, SPEED);
    let rim = setup.draw.between(-3.0, 3.0) * setup.units.size(LENGTH) / round.radius.near();
    let omega = setup.omega("omega", rim);
    let ([mu, _], rough) = friction(&mut setup, FRICTION);
    let pad = Pad::random(&mut setup, &mass.value, &down.value);
    let radius = &round.radius;
    setup.write(&format!(
        "[body.p]
        {}
        mass = \"{mass}\"
        start = {{ at = [\"{x}\", \"{foot} + {radius} + {height}\"], velocity = [\"{along}\", \"-{down}\"], omega = \"{omega}\" }}
        [surface.floor]
        through = [0, \"{foot}\"]
        {}",
        round.shape(),
        pad.line(&format!(", {rough}"))
    ));
    let touch = pad.law.touch(&down.value);
    let begin = &height.value / &down.value;
    let end = &begin + &touch.duration;
    let late = &begin * Real::of(setup.draw.between(0.1, 2.0));
    let until = setup.near("until", &(&end + late), TIME);
    assert!(until.value > end, "the whole bounce");
    let slip = &along.value + &omega.value * &radius.value;
    let k = &round.inertia;
    let (whole, needed) = (&down.value + &touch.after, slip.abs() / (&mu * (1 + 1 / k)));
    assert!((&needed / &whole - 1).abs().to_f64() > APART, "it is clear whether it rolls");
    let rubbed = |push: &Real| {
        let change = -(&mu * push * slip.sign());
        [&along.value + &change, &omega.value + change / k / &radius.value]
    };
    let size = along.value.abs().to_f64().max((&omega.value * &radius.value).abs().to_f64());
    let rolls = needed < whole;
    let [vx, turning] = rubbed(if rolls { &needed } else { &whole });
    if rolls {
        let (since, depth) = pad.law.reaches(&down.value, &(&down.value - &needed));
        let (time, pushed) = (&begin + &since, &down.value * &since - depth);
        let place = &x.value + &along.value * &time - &mu * slip.sign() * pushed;
        setup.ask_time("floor.p.rolls", &time);
        setup.ask("p.x", At::After("floor.p.rolls".into()), &place, LENGTH);
        setup.ask("p.x", At::End, &(place + &vx * (&until.value - time)), LENGTH);
    }
    setup.ask("floor.contact[1].duration", At::End, &touch.duration, TIME);
    setup.ask_beside("p.vx", At::End, (&vx, size), SPEED);
    setup.ask_beside("p.omega", At::End, (&turning, size / radius.near()), RATE);
    setup.ask("p.vy", At::End, &touch.after, SPEED);
    setup.problem("0 m/s^2", &until)
}
