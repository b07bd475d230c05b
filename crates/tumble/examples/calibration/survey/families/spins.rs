//! Something round that is thrown along a rough floor with spin: it slips, rolls, and may come back.
//!
//! # Law
//!
//! Friction mu m g against the slip s = v + omega R; it changes v by F/m and omega by F/(k m R), with k m R^2 the moment of inertia.
//!
//! # Closed form
//!
//! The slip falls by mu g (1 + 1/k) each second, to zero at t = |s|/(mu g (1 + 1/k)). Then the body rolls with v - s k/(k + 1), and
//! passes its first place again if that goes back.
//!
//! # Source
//!
//! Coriolis, Théorie mathématique des effets du jeu de billard, 1835.

use super::super::ground::{Along, Ground, Round};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{NUMBER, RATE, SPEED, TIME};

/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.02, 1.5];
/// Speeds of the rim about the centre, in the problem's own size.
const SPINS: [f64; 2] = [0.1, 10.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let ground = Ground::random(&mut setup, 0.0);
    let round = Round::random(&mut setup);
    let (radius, k) = (&round.radius.value, &round.inertia);
    let speed = setup.given("speed", 1.0, SPEED);
    let size = setup.draw.sign() * setup.draw.log_between(SPINS[0], SPINS[1]);
    let rim = setup.units.size(SPEED) * size / round.radius.near() / setup.units.size(RATE);
    let omega = setup.omega("omega", rim);
    let size = setup.draw.log_between(FRICTION[0], FRICTION[1]);
    let mu = setup.given("mu", size, NUMBER);
    let (shape, start) = (round.shape(), format!("omega = \"{omega}\""));
    ground.write(
        &mut setup,
        [&shape, &start],
        [&round.radius.word, &speed.word],
        &format!("friction = \"{mu}\""),
    );
    let slip = &speed.value + &omega.value * radius;
    assert!(!slip.is_zero(), "it rolls from the beginning");
    let push = -(&mu.value * &ground.gravity.value * slip.sign());
    let rolls = -(&slip / (&push * (1 + 1 / k)));
    let rolling = &speed.value - &slip * k / (k + 1);
    let place = (&speed.value + &push * &rolls / 2) * &rolls;
    let home = &rolls - &place / &rolling;
    let comes = rolling.sign() * speed.value.sign() < 0 && home > rolls;
    let size = Real::of(setup.draw.between(1.6, 4.0));
    let until = setup.near("until", &(if comes { &home * &size } else { &rolls * &size }), TIME);
    let along = |time: &Real| &place + &rolling * (time - &rolls);
    setup.ask_time("floor.p.rolls", &rolls);
    let turned = -(&rolling / radius);
    let rolled = At::After("floor.p.rolls".into());
    let there = Along { place: &place, speed: &rolling };
    ground.ask(&mut setup, &rolled, radius, there, &speed.value);
    let end = along(&until.value);
    ground.ask(&mut setup, &At::End, radius, Along { place: &end, speed: &rolling }, &speed.value);
    setup.ask("p.omega", At::End, &turned, RATE);
    if comes && home < until.value {
        setup.write(&format!("[event.home]\nwhen = \"p.x - {} passes through 0 m\"", ground.x()));
        setup.ask_time("home", &home);
        ground.ask(
            &mut setup,
            &At::After("home".into()),
            radius,
            Along { place: &Real::zero(), speed: &rolling },
            &rolling,
        );
    }
    setup.problem(&ground.gravity.word, &until)
}
