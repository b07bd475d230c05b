//! Instants of simple motions: the top of a throw, places passed up and down, angles, and turns of a spring.
//!
//! # Law
//!
//! Free fall with a spin; or a point on an undamped spring.
//!
//! # Closed form
//!
//! Roots of y = y0 + v t - g t^2/2, (v -+ sqrt(v^2 - 2 g (y - y0)))/g; an angle is passed after (angle - angle0)/omega; a
//! swing A cos(w t - p) passes a place at w t = p -+ arccos(place/A), and again after each period.
//!
//! # Source
//!
//! Galilei, Discorsi, fourth day; Landau and Lifshitz, Mechanics, § 21.

use std::f64::consts::TAU;

use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, LENGTH, MASS, NUMBER, SPEED, STIFFNESS, TIME};

/// Periods of a swing.
const PERIODS: [f64; 2] = [0.7, 100.0];

/// A rod that is thrown.
pub(super) fn flight(mut setup: Setup) -> Problem {
    let gravity = setup.given("g", 1.0, ACCELERATION);
    let place = ["x", "y"].map(|name| setup.shift(name));
    let rise = setup.draw.log_between(0.1, 3.0);
    let velocity = [("vx", 1.0), ("vy", rise)].map(|(name, size)| setup.given(name, size, SPEED));
    let turn = setup.draw.sign() * setup.draw.log_between(0.3, 30.0);
    let (angle, omega) = (setup.angle("angle0", 0.3 * turn), setup.omega("omega", turn));
    let throw = Throw { gravity, place, velocity, angle, omega };
    throw.write(&mut setup);
    let top = throw.top();
    let length = Real::of(setup.draw.between(2.1, 5.0));
    let until = setup.near("until", &(&top * length), TIME);
    ask_top(&mut setup, &throw);
    ask_height(&mut setup, &throw, &until);
    ask_angle(&mut setup, &throw, &until);
    let [x, y] = throw.at(&until.value);
    setup.ask("rod.x", At::End, &x, LENGTH);
    setup.ask("rod.y", At::End, &y, LENGTH);
    setup.ask("rod.y", At::Greatest(None), &throw.at(&top)[1], LENGTH);
    setup.problem(&throw.gravity.word, &until)
}

struct Throw {
    gravity: Given,
    place: [Given; 2],
    velocity: [Given; 2],
    angle: Given,
    omega: Given,
}

impl Throw {
    fn write(&self, setup: &mut Setup) {
        let Self { place: [x, y], velocity: [vx, vy], angle, omega, .. } = self;
        setup.write(&format!(
            "[body.rod]
            rod = {{ from = [0, 0], to = [\"1 m\", 0] }}
            mass = \"2 kg\"
            start = {{ at = [\"{x}\", \"{y}\"], velocity = [\"{vx}\", \"{vy}\"], angle = \"{angle}\", omega = \"{omega}\" }}
            [event.top]
            when = \"rod.vy falls through 0 m/s\""
        ));
    }

    fn top(&self) -> Real {
        &self.velocity[1].value / &self.gravity.value
    }

    fn at(&self, time: &Real) -> [Real; 2] {
        let [x, y] = [0, 1].map(|axis| &self.place[axis].value + &self.velocity[axis].value * time);
        [x, y - &self.gravity.value * time.squared() / 2]
    }
}

fn ask_top(setup: &mut Setup, throw: &Throw) {
    let top = throw.top();
    let [x, y] = throw.at(&top);
    setup.ask_time("top", &top);
    setup.ask("rod.x", At::After("top".into()), &x, LENGTH);
    setup.ask("rod.y", At::After("top".into()), &y, LENGTH);
    let angle = &throw.angle.value + &throw.omega.value * top;
    setup.ask("rod.angle", At::After("top".into()), &angle, NUMBER);
}

/// A height that is this part of the greatest below it is touched and not passed, within rounding.
const GRAZES: f64 = 1e-12;

/// A height that is passed up and down.
fn ask_height(setup: &mut Setup, throw: &Throw, until: &Given) {
    let speed = &throw.velocity[1].value;
    let most = speed.squared() / &throw.gravity.value / 2;
    let part = setup.draw.between(0.01, 0.99);
    let height = setup.near("height", &(&most * Real::of(part)), LENGTH);
    if (&most - &height.value).to_f64() <= GRAZES * most.to_f64() || height.value.sign() <= 0 {
        return;
    }
    setup.write(&format!(
        "[event.pass]
        when = \"rod.y - {} passes through {height}\"",
        throw.place[1]
    ));
    let root = (speed.squared() - &throw.gravity.value * &height.value * 2).sqrt();
    let times = [speed - &root, speed + &root].map(|way| way / &throw.gravity.value);
    let rates = [root.clone(), -&root];
    for (count, (time, rate)) in
        times.iter().zip(&rates).enumerate().filter(|(_, (time, _))| **time < until.value)
    {
        let instant = format!("pass[{}]", count + 1);
        setup.ask_time(&instant, time);
        setup.ask("rod.vy", At::After(instant.clone()), rate, SPEED);
        setup.ask("rod.x", At::After(instant), &throw.at(time)[0], LENGTH);
    }
    if times[1] < until.value {
        setup.ask("pass[2] - pass[1]", At::End, &(&times[1] - &times[0]), TIME);
    }
}

fn ask_angle(setup: &mut Setup, throw: &Throw, until: &Given) {
    let time = Real::of(setup.draw.between(0.1, 0.9)) * &until.value;
    let size = (&throw.angle.value + &throw.omega.value * time).to_f64();
    let angle = setup.angle("angle1", size);
    let time = (&angle.value - &throw.angle.value) / &throw.omega.value;
    if time.sign() <= 0 || time >= until.value {
        return;
    }
    setup.write(&format!(
        "[event.turned]
        when = \"rod.angle passes through {angle}\""
    ));
    setup.ask_time("turned", &time);
    setup.ask("rod.y", At::After("turned".into()), &throw.at(&time)[1], LENGTH);
}

/// A point on a spring.
pub(super) fn swing(mut setup: Setup) -> Problem {
    let (mass, stiffness) = (setup.given("mass", 1.0, MASS), setup.given("stiffness", 1.0, STIFFNESS));
    let anchor = setup.shift("anchor");
    let [offset, speed] = [0; 2].map(|_| setup.draw.between(-1.0, 1.0));
    let offset = setup.given("offset", offset, LENGTH);
    let speed = setup.given("speed", speed, SPEED);
    let frequency = (&stiffness.value / &mass.value).sqrt();
    let size = setup.draw.log_between(PERIODS[0], PERIODS[1]);
    let until = setup.near("until", &(Real::pi() * 2 * Real::of(size) / &frequency), TIME);
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{mass}\"
        start = {{ at = [\"{anchor} + {offset}\", 0], velocity = [\"{speed}\", 0] }}
        [spring.own]
        between = [\"p.cm\", {{ world = [\"{anchor}\", 0] }}]
        stiffness = \"{stiffness}\"
        rest_length = 0"
    ));
    let wave = Wave::new(&offset.value, &speed.value, frequency);
    ask_passing(&mut setup, &wave, &anchor, &until);
    let [x, v] = wave.at(&until.value);
    setup.ask("p.vx", At::End, &v, SPEED);
    setup.ask(&format!("p.x - {anchor}"), At::End, &x, LENGTH);
    // As it is written, with few digits.
    if (&until.value * &wave.frequency).to_f64() > 1.1 * TAU {
        setup.ask("p.x", At::Greatest(None), &(&anchor.value + &wave.amplitude), LENGTH);
        setup.ask("p.vx", At::Least(None), &-(&wave.amplitude * &wave.frequency), SPEED);
    }
    setup.problem("0 m/s^2", &until)
}

/// A cos(w t - p)
struct Wave {
    amplitude: Real,
    frequency: Real,
    phase: Real,
}

impl Wave {
    fn new(offset: &Real, speed: &Real, frequency: Real) -> Self {
        let sine = speed / &frequency;
        let amplitude = (offset.squared() + sine.squared()).sqrt();
        Self { amplitude, phase: sine.atan2(offset), frequency }
    }

    fn at(&self, time: &Real) -> [Real; 2] {
        let angle = &self.frequency * time - &self.phase;
        [&self.amplitude * angle.cos(), -(&self.amplitude * &self.frequency * angle.sin())]
    }

    /// When it passes a place, given as a part of the amplitude, upwards.
    fn rises(&self, part: &Real, until: &Real) -> Vec<Real> {
        let first = &self.phase - (Real::pi() / 2 - part.asin());
        let turn = Real::pi() * 2;
        let all = (-1..).map(|count| (&first + &turn * count) / &self.frequency);
        all.skip_while(|time| time.sign() <= 0).take_while(|time| time < until).collect()
    }
}

fn ask_passing(setup: &mut Setup, wave: &Wave, anchor: &Given, until: &Given) {
    let size = Real::of(setup.draw.between(-0.98, 0.98));
    let place = setup.near("place", &(&wave.amplitude * size), LENGTH);
    let part = &place.value / &wave.amplitude;
    let from = (&wave.at(&Real::from(0))[0] / &wave.amplitude - &part).abs();
    // Where it begins at the place, rounding decides whether it comes there.
    if part.abs() >= Real::from(1) || from.to_f64() <= GRAZES {
        return;
    }
    setup.write(&format!(
        "[event.pass]
        when = \"p.x - {anchor} rises through {place}\""
    ));
    let times = wave.rises(&part, &until.value);
    if times.is_empty() {
        return;
    }
    let count = setup.draw.whole(1, times.len());
    let instant = format!("pass[{count}]");
    let time = &times[count - 1];
    setup.ask_time(&instant, time);
    setup.ask("p.vx", At::After(instant.clone()), &wave.at(time)[1], SPEED);
    setup.ask("p.x", At::After(instant.clone()), &(&anchor.value + &place.value), LENGTH);
    if count > 1 {
        setup.ask(&format!("{instant} - pass[1]"), At::End, &(time - &times[0]), TIME);
    }
}
