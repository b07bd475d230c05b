//! Greatest and least values, works and energies of swings.
//!
//! # Law
//!
//! m x'' = -k x - c x' about an anchor, in two directions that do not know of each other where there is no damping.
//!
//! # Closed form
//!
//! A damped swing turns first where v0 cos(s t) = (b v0 + w^2 x0)/s sin(s t). On an undamped spring in the plane
//! r^2 = S/2 + R/2 cos(2 w t - p), with S and R from the axes' cosines and sines. A spring takes k (r^2 - r0^2)/2.
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, §§ 21, 23 and 25.

use super::super::oscillator::{Oscillator, State};
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{DAMPING, ENERGY, LENGTH, MASS, SPEED, STIFFNESS, TIME};

/// Damping in parts of the critical.
const DAMPINGS: [f64; 2] = [0.001, 0.8];
/// Radians of a run.
const PHASES: [f64; 2] = [7.0, 200.0];

/// A damped swing along a line.
pub(super) fn damped(mut setup: Setup) -> Problem {
    let parts = Parts::random(&mut setup);
    let size = 2.0 * setup.draw.log_between(DAMPINGS[0], DAMPINGS[1]);
    let damping = setup.given("damping", size, DAMPING);
    let [anchor, _] = &parts.anchor;
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{}\"
        start = {{ at = [\"{anchor} + {}\", 0], velocity = [\"{}\", 0] }}
        [force.spring]
        on = \"p\"
        at = \"p.cm\"
        force = [\"-{}*(p.x - {anchor})\", 0]
        [force.brake]
        on = \"p\"
        at = \"p.cm\"
        force = [\"-{damping}*p.vx\", 0]",
        parts.mass, parts.offset[0], parts.speed[0], parts.stiffness
    ));
    let mass = &parts.mass.value;
    let system = Oscillator { stiffness: &parts.stiffness.value / mass, damping: &damping.value / mass };
    let start = State { x: parts.offset[0].value.clone(), v: parts.speed[0].value.clone() };
    let until = parts.until.clone();
    ask_damped(&mut setup, &parts, (&system, &start), &until);
    setup.problem("0 m/s^2", &until)
}

fn ask_damped(setup: &mut Setup, parts: &Parts, (system, start): (&Oscillator, &State), until: &Given) {
    let [anchor, _] = &parts.anchor;
    let turn = first_turn(system, start);
    let there = system.free(start, &turn).x;
    let outwards = At::Greatest(None);
    let at = if start.v.sign() > 0 { outwards } else { At::Least(None) };
    setup.ask("p.x", at.clone(), &(&anchor.value + &there), LENGTH);
    setup.ask(&format!("p.x - {anchor}"), at, &there, LENGTH);
    let end = system.free(start, &until.value);
    let energy = |state: &State| &parts.mass.value * state.v.squared() / 2;
    let stored = |state: &State| &parts.stiffness.value * state.x.squared() / 2;
    setup.ask("spring.work", At::End, &(stored(start) - stored(&end)), ENERGY);
    let lost = energy(&end) + stored(&end) - energy(start) - stored(start);
    setup.ask("brake.work", At::End, &lost, ENERGY);
    let then = setup.moment("then", until);
    let state = system.free(start, &then.value);
    setup.ask("p.kinetic", At::After(then.word), &energy(&state), ENERGY);
}

/// When it turns back for the first time.
fn first_turn(system: &Oscillator, start: &State) -> Real {
    let half = &system.damping / 2;
    let swing = (&system.stiffness - half.squared()).sqrt();
    let against = (&half * &start.v + &system.stiffness * &start.x) / &swing;
    let angle = start.v.atan2(&against);
    (if angle.sign() > 0 { angle } else { angle + Real::pi() }) / swing
}

/// A spring in the plane.
pub(super) fn plane(mut setup: Setup) -> Problem {
    let parts = Parts::random(&mut setup);
    let Parts { mass, stiffness, anchor: [ax, ay], offset: [dx, dy], speed: [vx, vy], until } = &parts;
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{mass}\"
        start = {{ at = [\"{ax} + {dx}\", \"{ay} + {dy}\"], velocity = [\"{vx}\", \"{vy}\"] }}
        [spring.cord]
        between = [\"p.cm\", {{ world = [\"{ax}\", \"{ay}\"] }}]
        stiffness = \"{stiffness}\"
        rest_length = 0"
    ));
    let square = &stiffness.value / &mass.value;
    let system = Oscillator::undamped(square.clone());
    let starts =
        [0, 1].map(|axis| State { x: parts.offset[axis].value.clone(), v: parts.speed[axis].value.clone() });
    let distance = format!("norm([p.x - {ax}, p.y - {ay}])");
    let [far, near] = ellipse(&starts, &square.sqrt());
    setup.ask(&distance, At::Greatest(None), &far, LENGTH);
    setup.ask(&distance, At::Least(None), &near, LENGTH);
    setup.ask("p.kinetic", At::Greatest(None), &(&stiffness.value * far.squared() / 2), ENERGY);
    let ends = starts.each_ref().map(|start| system.free(start, &until.value));
    let squares = |states: &[State; 2]| states[0].x.squared() + states[1].x.squared();
    let work = &stiffness.value * (squares(&starts) - squares(&ends)) / 2;
    setup.ask("cord.work", At::End, &work, ENERGY);
    setup.ask(&distance, At::End, &squares(&ends).sqrt(), LENGTH);
    let first = &mass.value * (starts[0].v.squared() + starts[1].v.squared()) / 2;
    setup.ask("p.kinetic", At::End, &(first + work), ENERGY);
    let until = until.clone();
    setup.problem("0 m/s^2", &until)
}

/// The greatest and the least distance from the anchor.
fn ellipse(starts: &[State; 2], frequency: &Real) -> [Real; 2] {
    let [p, q] = starts.each_ref().map(|start| [start.x.clone(), &start.v / frequency]);
    let sum = p[0].squared() + p[1].squared() + q[0].squared() + q[1].squared();
    let cosine = p[0].squared() + q[0].squared() - p[1].squared() - q[1].squared();
    let sine = (&p[0] * &p[1] + &q[0] * &q[1]) * 2;
    let swing = (cosine.squared() + sine.squared()).sqrt();
    // The product of the half axes is known without a difference.
    let area = (&p[0] * &q[1] - &p[1] * &q[0]).abs();
    let far = ((sum + swing) / 2).sqrt();
    let near = area / &far;
    [far, near]
}

/// What both have.
struct Parts {
    mass: Given,
    stiffness: Given,
    anchor: [Given; 2],
    offset: [Given; 2],
    speed: [Given; 2],
    until: Given,
}

impl Parts {
    fn random(setup: &mut Setup) -> Self {
        let phases = setup.draw.log_between(PHASES[0], PHASES[1]);
        let sizes = [0; 4].map(|_| setup.draw.sign() * setup.draw.log_between(0.1, 1.0));
        let stiffness = setup.given("stiffness", 1.0, STIFFNESS);
        let mass = setup.given("mass", 1.0, MASS);
        let frequency = (&stiffness.value / &mass.value).sqrt();
        Self {
            mass,
            stiffness,
            anchor: ["anchor_x", "anchor_y"].map(|name| setup.shift(name)),
            offset: [("dx", sizes[0]), ("dy", sizes[1])].map(|(name, size)| setup.given(name, size, LENGTH)),
            speed: [("vx", sizes[2]), ("vy", sizes[3])].map(|(name, size)| setup.given(name, size, SPEED)),
            until: setup.near("until", &(Real::of(phases) / frequency), TIME),
        }
    }
}
