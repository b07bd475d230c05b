//! A block that is pushed along a rough floor or slope, until it stops or turns round.
//!
//! # Law
//!
//! Along the ground there is the acceleration -g sin(slope) - mu_k g cos(slope) sign(v).
//!
//! # Closed form
//!
//! It stops at v/a after v^2/(2 a). There it stays if |tan(slope)| <= mu_s, or else slides back evenly accelerated.
//!
//! # Source
//!
//! Coulomb, Théorie des machines simples, 1781.

use super::super::ground::{Along, Ground, block, friction};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{SPEED, TIME};

/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.02, 1.5];
/// Ends of runs, in parts of the time to the stop.
const ENDS: [f64; 2] = [0.3, 5.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let ground = Ground::random(&mut setup, 0.5);
    let (shape, half) = block(&mut setup);
    let size = setup.draw.sign() * setup.draw.log_between(0.1, 10.0);
    let speed = setup.given("speed", size, SPEED);
    let ([kinetic, of_rest], rough) = friction(&mut setup, FRICTION);
    let start = format!("angle = \"{}\"", ground.slope);
    ground.write(&mut setup, [&shape, &start], [&half.word, &speed.word], &rough);
    let [pull, push] = ground.weight();
    let slide = |way: i64| &pull - &kinetic * &push * way;
    let way = speed.value.sign();
    let first = slide(way);
    let stops = first.sign() != way && !first.is_zero();
    let stop = if stops { -(&speed.value / &first) } else { speed.value.abs() / &push };
    let length = Real::of(setup.draw.log_between(ENDS[0], ENDS[1]));
    let until = setup.near("until", &(&stop * length), TIME);
    let along = |v: &Real, a: &Real, t: &Real| [(v + a * t / 2) * t, v + a * t];
    let ask = |setup: &mut Setup, at: At, [place, speed_then]: [Real; 2]| {
        let there = Along { place: &place, speed: &speed_then };
        ground.ask(setup, &at, &half.value, there, &speed.value);
    };
    if !stops || stop >= until.value {
        ask(&mut setup, At::End, along(&speed.value, &first, &until.value));
        return setup.problem(&ground.gravity.word, &until);
    }
    let [place, _] = along(&speed.value, &first, &stop);
    let stays = pull.abs() <= &of_rest * &push;
    let instant = if stays { "floor.p.sticks" } else { "floor.p.slides[2]" };
    setup.ask_time(instant, &stop);
    ask(&mut setup, At::After(instant.into()), [place.clone(), Real::zero()]);
    let back = if stays { Real::zero() } else { slide(pull.sign()) };
    let [more, then] = along(&Real::zero(), &back, &(&until.value - &stop));
    ask(&mut setup, At::End, [place + more, then]);
    setup.problem(&ground.gravity.word, &until)
}
