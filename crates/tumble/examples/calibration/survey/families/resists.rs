//! Something round that rolls on a floor or slope against rolling resistance, until it stops or rolls back.
//!
//! # Law
//!
//! A couple of at most d N against the turning. With k m R^2 the moment of inertia, the acceleration is
//! -g (sin(slope) + sign(v) (d/R) cos(slope))/(k + 1).
//!
//! # Closed form
//!
//! It stops at v/a after v^2/(2 a). There it stays if |tan(slope)| <= d/R, or else rolls back evenly accelerated.
//!
//! # Source
//!
//! Coulomb, Théorie des machines simples, 1781.

use super::super::ground::{Along, Ground, Round};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{LENGTH, RATE, SPEED, TIME};

/// Lengths of the resistance in parts of the radius.
const LENGTHS: [f64; 2] = [1e-3, 0.5];
/// Ends of runs, in parts of the time to the stop.
const ENDS: [f64; 2] = [0.3, 5.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let ground = Ground::random(&mut setup, 0.5);
    let round = Round::random(&mut setup);
    let (radius, k) = (&round.radius.value, &round.inertia);
    let part = Real::of(setup.draw.log_between(LENGTHS[0], LENGTHS[1]));
    let length = setup.near("length", &(radius * &part), LENGTH);
    let size = setup.draw.sign() * setup.draw.log_between(0.1, 10.0);
    let speed = setup.given("speed", size, SPEED);
    let start = format!("omega = \"-({speed})/({})\"", round.radius);
    // Rough enough that it never slips.
    let rigid = format!("friction = 5, rolling = \"{length}\"");
    ground.write(&mut setup, [&round.shape(), &start], [&round.radius.word, &speed.word], &rigid);
    let [pull, push] = ground.weight();
    let resisted = &length.value / radius * &push;
    let rolled = |way: i64| (&pull - &resisted * way) / (k + 1);
    let way = speed.value.sign();
    let first = rolled(way);
    let stops = first.sign() * way < 0;
    let stop = if stops { -(&speed.value / &first) } else { speed.value.abs() / &push };
    let size = Real::of(setup.draw.log_between(ENDS[0], ENDS[1]));
    let until = setup.near("until", &(&stop * size), TIME);
    let along = |v: &Real, a: &Real, t: &Real| [(v + a * t / 2) * t, v + a * t];
    let ask = |setup: &mut Setup, at: At, [place, then]: [Real; 2]| {
        ground.ask(setup, &at, radius, Along { place: &place, speed: &then }, &speed.value);
        let size = (&speed.value / radius).abs().to_f64();
        setup.ask_beside("p.omega", at, (&-(then / radius), size), RATE);
    };
    if !stops || stop >= until.value {
        ask(&mut setup, At::End, along(&speed.value, &first, &until.value));
        return setup.problem(&ground.gravity.word, &until);
    }
    let [place, _] = along(&speed.value, &first, &stop);
    let stays = pull.abs() <= resisted;
    let instant = if stays { "floor.p.stops" } else { "floor.p.turns[2]" };
    setup.ask_time(instant, &stop);
    ask(&mut setup, At::After(instant.into()), [place.clone(), Real::zero()]);
    let back = if stays { Real::zero() } else { rolled(pull.sign()) };
    let [more, then] = along(&Real::zero(), &back, &(&until.value - &stop));
    ask(&mut setup, At::End, [place + more, then]);
    setup.problem(&ground.gravity.word, &until)
}
