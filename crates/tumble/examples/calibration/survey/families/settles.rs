//! A block that a spring swings to and fro on a rough floor or slope, until it stays.
//!
//! # Law
//!
//! About where the spring balances the weight along the ground there is the acceleration -k u/m - mu_k g cos(slope) sign(u').
//!
//! # Closed form
//!
//! Each half swing takes pi sqrt(m/k), and ends nearer by 2 mu_k m g cos(slope)/k. The first end with k |u| <= mu_s m g cos(slope) is the last.
//!
//! # Source
//!
//! Coulomb, Théorie des machines simples, 1781.

use super::super::ground::{Along, Ground, block, friction};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{ENERGY, LENGTH, STIFFNESS, TIME};

/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.02, 1.0];
/// How far the spring is stretched at first, in parts of how far kinetic friction would hold it.
const STRETCHES: [f64; 2] = [1.6, 40.0];
/// Ends of runs, in parts of the time until it stays.
const ENDS: [f64; 2] = [1.05, 2.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let ground = Ground::random(&mut setup, 0.5);
    let (shape, half) = block(&mut setup);
    let ([kinetic, of_rest], rough) = friction(&mut setup, FRICTION);
    let start = format!("angle = \"{}\"", ground.slope);
    ground.write(&mut setup, [&shape, &start], [&half.word, "0"], &rough);
    let size = setup.draw.log_between(0.1, 100.0);
    let stiffness = setup.given("stiffness", size, STIFFNESS);
    let [pull, push] = ground.weight();
    let mass = &ground.mass.value;
    let held = |coefficient: &Real| coefficient * &push * mass / &stiffness.value;
    let balanced = mass * &pull / &stiffness.value;
    let stretch = Real::of(setup.draw.sign() * setup.draw.log_between(STRETCHES[0], STRETCHES[1]));
    let anchor = setup.near("anchor", &(held(&kinetic) * stretch - &balanced), LENGTH);
    let [x, y] = ground.above(&half.word);
    let slope = &ground.slope;
    setup.write(&format!(
        "[spring.cord]
        between = [\"p.cm\", {{ world = [\"{x} + {anchor}*cos({slope})\", \"{y} + {anchor}*sin({slope})\"] }}]
        stiffness = \"{stiffness}\"
        rest_length = 0"
    ));
    let middle = &anchor.value + balanced;
    let mut off = -middle.clone();
    let (mut path, mut swings) = (Real::zero(), 0);
    while off.abs() > held(&of_rest) {
        let swing = (off.abs() - held(&kinetic)) * 2;
        off = &off - &swing * off.sign();
        (path, swings) = (path + swing, swings + 1);
    }
    assert!(swings > 0, "it slides");
    let stop = Real::pi() * (mass / &stiffness.value).sqrt() * swings;
    let size = Real::of(setup.draw.between(ENDS[0], ENDS[1]));
    let until = setup.near("until", &(&stop * size), TIME);
    assert!(until.value > stop, "it stays at the end");
    setup.ask_time("floor.p.sticks", &stop);
    let there = Along { place: &(middle + off), speed: &Real::zero() };
    ground.ask(&mut setup, &At::End, &half.value, there, &(&path / &stop));
    setup.ask("floor.work", At::End, &-(kinetic * push * mass * path), ENERGY);
    setup.problem(&ground.gravity.word, &until)
}
