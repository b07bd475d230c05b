//! A ball on a Hertzian floor.
//!
//! # Law
//!
//! m d'' = m g - k d^(3/2) (1 + c d') while the depth d is positive; without weight, or without damping.
//!
//! # Closed form
//!
//! The first integral of [`Hertz`], by which depth and speed are roots and the duration is one integral. Without weight and damping it
//! is (4/5) B(2/5, 1/2) d/v.
//!
//! # Source
//!
//! Landau and Lifshitz, Theory of Elasticity, § 9; Hunt and Crossley, Coefficient of restitution interpreted as damping in vibroimpact, 1975.

use super::super::ball::Ball;
use super::super::pad::hertz;
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::touch::{Fall, Hertz, Law};
use super::super::units::{ACCELERATION, ENERGY, LENGTH, SPEED, TIME};

/// Share of those without weight.
const WEIGHTLESS: f64 = 0.7;

pub(super) fn make(mut setup: Setup) -> Problem {
    let ball = Ball::random(&mut setup);
    let has_weight = !setup.draw.chance(WEIGHTLESS);
    let gravity = setup.given("g", if has_weight { 1.0 } else { 0.0 }, ACCELERATION);
    let fall = Fall::new(&gravity.value, &ball.height.value, &ball.vy.value);
    let is_damped = !has_weight && setup.draw.chance(0.7);
    let (coefficients, law): (String, Hertz) = hertz(&mut setup, &ball.mass.value, &fall.speed, is_damped);
    ball.write(&mut setup, &format!("hertz = {{ {coefficients} }}"));
    let touch = match has_weight {
        true => law.heavy(&fall.speed, &gravity.value),
        false => Law::Hertz(law).touch(&fall.speed),
    };
    let end = &fall.time + &touch.duration;
    // Under its weight it comes down again 2 v/g later.
    let late = match has_weight {
        true => &touch.after * 2 / &gravity.value * Real::of(setup.draw.between(0.1, 0.9)),
        false => &fall.time * Real::of(setup.draw.between(0.1, 2.0)),
    };
    let until = setup.near("until", &(&end + late), TIME);
    let flight = &until.value - &end;
    assert!(flight.sign() > 0 && &flight * &gravity.value < &touch.after * 2, "one contact");
    ball.ask_first(&mut setup, &fall, &touch);
    let fallen = &gravity.value * &flight;
    setup.ask("p.vy", At::End, &(&touch.after - &fallen), SPEED);
    setup.ask("floor.p.rim.gap", At::End, &((&touch.after - &fallen / 2) * &flight), LENGTH);
    if is_damped {
        let work = &ball.mass.value * (touch.after.squared() - fall.speed.squared()) / 2;
        setup.ask("floor.work", At::End, &work, ENERGY);
    }
    setup.problem(&gravity.word, &until)
}
