//! A block at rest on a rough floor or slope that a growing force pushes until it breaks away.
//!
//! # Law
//!
//! Friction holds the block up to mu_s m g cos(slope); then it slides with mu_k.
//!
//! # Closed form
//!
//! A force k t along the ground is too much at k t = m g (mu_s cos(slope) + sin(slope)). From there on the acceleration is
//! k t/m - g (mu_k cos(slope) + sin(slope)), of which speed and place are integrals.
//!
//! # Source
//!
//! Coulomb, Théorie des machines simples, 1781.

use super::super::ground::{Along, Ground, block, friction};
use super::super::real::Real;
use super::super::setup::{At, Problem, Setup};
use super::super::units::{FORCE, Measure, TIME};

/// Coefficients of friction: no slope that is drawn is too steep for them.
const FRICTION: [f64; 2] = [1.3, 2.0];
const FLAT: [f64; 2] = [0.02, 2.0];
/// Ends of runs, in parts of the time to the break-away.
const ENDS: [f64; 2] = [1.6, 5.0];
/// N/s
const GROWTH: Measure = Measure([1, -3, 1]);

pub(super) fn make(mut setup: Setup) -> Problem {
    let ground = Ground::random(&mut setup, 0.5);
    let (shape, half) = block(&mut setup);
    let is_flat = ground.slope.value.is_zero();
    let ([kinetic, of_rest], rough) = friction(&mut setup, if is_flat { FLAT } else { FRICTION });
    let start = format!("angle = \"{}\"", ground.slope);
    ground.write(&mut setup, [&shape, &start], [&half.word, "0"], &rough);
    let size = setup.draw.log_between(0.01, 10.0);
    let growth = setup.given("growth", size, GROWTH);
    let slope = &ground.slope;
    setup.write(&format!(
        "[force.push]
        on = \"p\"
        at = \"p.cm\"
        force = [\"{growth}*t*cos({slope})\", \"{growth}*t*sin({slope})\"]"
    ));
    let mass = &ground.mass.value;
    let [pull, push] = ground.weight();
    assert!(pull.abs() < &of_rest * &push, "it stands");
    let breaks = mass * (&of_rest * &push - &pull) / &growth.value;
    let size = Real::of(setup.draw.between(ENDS[0], ENDS[1]));
    let until = setup.near("until", &(&breaks * size), TIME);
    setup.ask_time("floor.p.slides", &breaks);
    let half_way = setup.near("half_way", &(&breaks / 2), TIME);
    let held = -(&growth.value * &half_way.value + mass * &pull);
    setup.ask("floor.friction", At::After(half_way.word.clone()), &held, FORCE);
    let late = &until.value - &breaks;
    let first = &growth.value * &breaks / mass + &pull - &kinetic * &push;
    let rate = &growth.value / mass;
    let speed = (&first + &rate * &late / 2) * &late;
    let place = (&first / 2 + &rate * &late / 6) * late.squared();
    ground.ask(&mut setup, &At::End, &half.value, Along { place: &place, speed: &speed }, &speed);
    setup.problem(&ground.gravity.word, &until)
}
