//! Forces that act for a small part of the run, or in a small part of the way.
//!
//! # Law
//!
//! m x'' = F b((s - c)/w), with b a bump, s the time or the place, and w from a tenth to a five thousandth of the run; or
//! the same on a spring.
//!
//! # Closed form
//!
//! In time, m dv = F w B and m dx = F w^2 (B's integral), with B the integral of b. In place, m v^2/2 grows by F w dB. On
//! a spring a Gaussian in time that is over leaves the swing of an impulse F w sqrt(pi) exp(-(W w)^2/4) at its centre.
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, §§ 6 and 22.

use super::super::bump::Bump;
use super::super::oscillator::{Oscillator, State};
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ENERGY, FORCE, LENGTH, MASS, SPEED, STIFFNESS, TIME};

/// Widths in parts of the run.
const WIDTHS: [f64; 2] = [1.0 / 5000.0, 0.1];
/// On a spring the Gaussian has to be over at the end, to all digits.
const WIDEST_ON_SPRING: f64 = 0.02;
/// The impulse in units of the momentum before, and the energy in units of that before.
const STRENGTHS: [f64; 2] = [0.05, 3.0];
/// A force in the way takes no more of the energy than this.
const MOST_BRAKING: f64 = 0.7;

/// The least gain of energy that is asked for, in parts of that before.
const LEAST_GAIN: f64 = 1e-30;

pub(super) fn make(mut setup: Setup) -> Problem {
    let point = Point::random(&mut setup);
    match setup.draw.whole(0, 2) {
        0 => in_time(&mut setup, &point),
        1 => in_place(&mut setup, &point),
        _ => on_spring(&mut setup, &point),
    }
    let Point { mass, at, speed, until } = &point;
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{mass}\"
        start = {{ at = [\"{at}\", 0], velocity = [\"{speed}\", 0] }}"
    ));
    setup.problem("0 m/s^2", until)
}

/// What moves.
struct Point {
    mass: Given,
    at: Given,
    speed: Given,
    until: Given,
}

impl Point {
    fn random(setup: &mut Setup) -> Self {
        let length = setup.draw.log_between(0.3, 30.0);
        Self {
            mass: setup.given("mass", 1.0, MASS),
            at: setup.shift("at"),
            speed: setup.given("speed", 1.0, SPEED),
            until: setup.given("until", length, TIME),
        }
    }
}

/// Where and how wide it is: in parts of what is given, which both numbers are given in.
fn place(setup: &mut Setup, whole: &Real, measure: super::super::units::Measure, widest: f64) -> [Given; 2] {
    let part = Real::of(setup.draw.between(0.35, 0.65));
    let width = Real::of(setup.draw.log_between(WIDTHS[0], widest));
    [setup.near("centre", &(whole * part), measure), setup.near("width", &(whole * width), measure)]
}

fn write_force(setup: &mut Setup, formula: &str) {
    setup.write(&format!(
        "[force.bump]
        on = \"p\"
        at = \"p.cm\"
        force = [\"{formula}\", 0]"
    ));
}

fn in_time(setup: &mut Setup, point: &Point) {
    let bump = setup.draw.pick(&Bump::ALL);
    let [centre, width] = place(setup, &point.until.value, TIME, WIDTHS[1]);
    let strength = setup.draw.sign() * setup.draw.log_between(STRENGTHS[0], STRENGTHS[1]);
    let force = &point.mass.value * &point.speed.value / &width.value * Real::of(strength);
    let force = setup.near("force", &force, FORCE);
    write_force(setup, &format!("{force}*{}", bump.formula(&format!("(t - {centre})/{width}"))));
    let kick = &force.value / &point.mass.value * &width.value;
    let state = |time: &Real| {
        let [z, begun] = [time, &Real::zero()].map(|time| (time - &centre.value) / &width.value);
        let slope = &point.speed.value - &kick * bump.area(&begun);
        let way = &kick * &width.value * (bump.second(&z) - bump.second(&begun));
        let x = slope.clone() * time + way;
        State { x: &point.at.value + x, v: slope + &kick * bump.area(&z) }
    };
    let then = setup.moment("then", &point.until);
    for (at, time) in [(At::End, &point.until), (At::After(then.word.clone()), &then)] {
        ask_state(setup, at, &state(&time.value));
    }
    ask_energy(setup, point, &state(&point.until.value).v);
}

fn ask_state(setup: &mut Setup, at: At, State { x, v }: &State) {
    setup.ask("p.vx", at.clone(), v, SPEED);
    setup.ask("p.x", at, x, LENGTH);
}

fn ask_energy(setup: &mut Setup, point: &Point, speed: &Real) {
    let energy = |speed: &Real| &point.mass.value * speed.squared() / 2;
    setup.ask("p.kinetic", At::End, &energy(speed), ENERGY);
    setup.ask("bump.work", At::End, &(energy(speed) - energy(&point.speed.value)), ENERGY);
}

fn in_place(setup: &mut Setup, point: &Point) {
    let bump = setup.draw.pick(&Bump::ALL);
    // A force that brakes takes up to twice the time.
    let way = &point.speed.value * &point.until.value / 2;
    let [centre, width] = place(setup, &way, LENGTH, WIDTHS[1]);
    let strength = setup.draw.sign() * setup.draw.log_between(STRENGTHS[0], STRENGTHS[1]);
    let strength = strength.max(-MOST_BRAKING) / std::f64::consts::PI;
    let force = &point.mass.value * point.speed.value.squared() / 2 / &width.value * Real::of(strength);
    let force = setup.near("force", &force, FORCE);
    let z = format!("(p.x - {} - {centre})/{width}", point.at);
    write_force(setup, &format!("{force}*{}", bump.formula(&z)));
    let part = Real::of(setup.draw.between(0.02, 0.3));
    let half = setup.draw.sign();
    let beyond = &centre.value + &width.value * Real::of(half) * part * 10;
    let there = setup.near("there", &beyond, LENGTH);
    setup.write(&format!(
        "[event.arrival]
        when = \"p.x - {} rises through {there}\"",
        point.at
    ));
    let area = |x: &Real| bump.area(&((x - &centre.value) / &width.value));
    let gain =
        &force.value * &width.value / &point.mass.value * 2 * (area(&there.value) - area(&Real::zero()));
    if there.value.sign() <= 0 {
        return;
    }
    let speed = (point.speed.value.squared() + &gain).sqrt();
    let at = At::After("arrival".into());
    setup.ask("p.vx", at.clone(), &speed, SPEED);
    setup.ask("p.x", at.clone(), &(&point.at.value + &there.value), LENGTH);
    // Far from the bump its integrals lose all digits of what is left of it.
    if (&gain / point.speed.value.squared()).abs() > Real::of(LEAST_GAIN) {
        setup.ask("bump.work", at, &(&point.mass.value * gain / 2), ENERGY);
    }
}

fn on_spring(setup: &mut Setup, point: &Point) {
    let [centre, width] = place(setup, &point.until.value, TIME, WIDEST_ON_SPRING);
    let phases = Real::of(setup.draw.log_between(0.5, 40.0));
    let stiffness = (phases / &point.until.value).squared() * &point.mass.value;
    let stiffness = setup.near("stiffness", &stiffness, STIFFNESS);
    let strength = setup.draw.sign() * setup.draw.log_between(STRENGTHS[0], STRENGTHS[1]);
    let force = &point.mass.value * &point.speed.value / &width.value * Real::of(strength);
    let force = setup.near("force", &force, FORCE);
    let bump = Bump::Gaussian.formula(&format!("(t - {centre})/{width}"));
    write_force(setup, &format!("{force}*{bump} - {stiffness}*(p.x - {})", point.at));
    let square = &stiffness.value / &point.mass.value;
    let fading = (-(&square * width.value.squared() / 4)).exp();
    let kick = &force.value / &point.mass.value * &width.value * Real::pi().sqrt() * fading;
    let system = Oscillator::undamped(square);
    let start = State { x: Real::zero(), v: point.speed.value.clone() };
    let blow = State { x: Real::zero(), v: kick };
    let state = |time: &Real| {
        let [free, kicked] = [system.free(&start, time), system.free(&blow, &(time - &centre.value))];
        State { x: &point.at.value + free.x + kicked.x, v: free.v + kicked.v }
    };
    let end = state(&point.until.value);
    ask_state(setup, At::End, &end);
    setup.ask(&format!("p.x - {}", point.at), At::End, &(&end.x - &point.at.value), LENGTH);
    ask_energy(setup, point, &end.v);
}
