//! Motions that obey linear equations, each direction for itself.
//!
//! # Law
//!
//! m x'' = -k (x - a) - c x' + F cos(w t), with k and c of any sign.
//!
//! # Closed form
//!
//! The sum of the lasting answer to the drive and of exp(-c t/(2m)) times circular or hyperbolic functions.
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, §§ 21, 25 and 26; [`Oscillator`] has the formulas.

use super::super::oscillator::{Oscillator, State};
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{DAMPING, ENERGY, FORCE, LENGTH, MASS, RATE, SPEED, STIFFNESS, TIME};

/// Largest growth of a small difference.
const GROWTH: f64 = 1e8;
/// Lengths of the runs in radians of the stiffest direction.
const PHASES: [f64; 2] = [0.5, 100.0];

/// A point with forces of its own in either direction.
pub(super) fn make(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let length = setup.draw.log_between(PHASES[0], PHASES[1]);
    let until = setup.given("until", length, TIME);
    let axes = ["x", "y"].map(|axis| Axis::random(&mut setup, axis, length));
    let [x, y] = &axes;
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{mass}\"
        start = {{ at = [\"{}\", \"{}\"], velocity = [\"{}\", \"{}\"] }}
        [force.own]
        on = \"p\"
        at = \"p.cm\"
        force = [\"{}\", \"{}\"]",
        x.start(),
        y.start(),
        x.speed,
        y.speed,
        x.force(),
        y.force()
    ));
    ask(&mut setup, &axes, &mass.value, &until);
    setup.problem("0 m/s^2", &until)
}

fn ask(setup: &mut Setup, axes: &[Axis; 2], mass: &Real, until: &Given) {
    let time = setup.moment("then", until);
    for axis in axes {
        let name = axis.name;
        for (at, time) in [(At::End, until), (At::After(time.word.clone()), &time)] {
            let State { x, v } = axis.at(mass, &time.value);
            setup.ask(&format!("p.v{name}"), at.clone(), &v, SPEED);
            setup.ask(&format!("p.{name}"), at.clone(), &(&x + &axis.anchor.value), LENGTH);
            setup.ask(&format!("p.{name} - {}", axis.anchor), at, &x, LENGTH);
        }
    }
    let speeds = axes.each_ref().map(|axis| axis.at(mass, &until.value).v.squared());
    let energy = mass * (&speeds[0] + &speeds[1]) / 2;
    setup.ask("p.kinetic", At::End, &energy, ENERGY);
    let first = axes.each_ref().map(|axis| axis.speed.value.squared());
    let work = energy - mass * (&first[0] + &first[1]) / 2;
    setup.ask("own.work", At::End, &work, ENERGY);
}

/// One direction.
struct Axis {
    name: &'static str,
    anchor: Given,
    offset: Given,
    speed: Given,
    stiffness: Given,
    damping: Given,
    drive: Given,
    frequency: Given,
}

impl Axis {
    fn random(setup: &mut Setup, name: &'static str, length: f64) -> Self {
        let [stiffness, damping] = kind(setup, length);
        let frequency = setup.draw.log_between(0.1, 3.0);
        let drive = if setup.draw.chance(0.5) { setup.draw.between(-1.0, 1.0) } else { 0.0 };
        let [offset, speed] = [0; 2].map(|_| setup.draw.between(-1.0, 1.0));
        Self {
            name,
            stiffness: setup.given(&format!("stiffness_{name}"), stiffness, STIFFNESS),
            damping: setup.given(&format!("damping_{name}"), damping, DAMPING),
            anchor: setup.shift(&format!("anchor_{name}")),
            offset: setup.given(&format!("offset_{name}"), offset, LENGTH),
            speed: setup.given(&format!("speed_{name}"), speed, SPEED),
            drive: setup.given(&format!("drive_{name}"), drive, FORCE),
            frequency: setup.given(&format!("frequency_{name}"), frequency, RATE),
        }
    }

    fn start(&self) -> String {
        format!("{} + {}", self.anchor, self.offset)
    }

    fn force(&self) -> String {
        let Self { name, anchor, stiffness, damping, drive, frequency, .. } = self;
        format!("-{stiffness}*(p.{name} - {anchor}) - {damping}*p.v{name} + {drive}*cos({frequency}*t)")
    }

    /// The place, from the anchor, and the velocity.
    fn at(&self, mass: &Real, time: &Real) -> State {
        let system =
            Oscillator { stiffness: &self.stiffness.value / mass, damping: &self.damping.value / mass };
        let start = State { x: self.offset.value.clone(), v: self.speed.value.clone() };
        let drive = &self.drive.value / mass;
        if drive.is_zero() {
            return system.free(&start, time);
        }
        system.driven(&start, [&drive, &self.frequency.value], time)
    }
}

/// Stiffness and damping of a direction: free, damped, a spring of some kind, or one that runs away.
fn kind(setup: &mut Setup, length: f64) -> [f64; 2] {
    let draw = &mut setup.draw;
    let fading = draw.log_between(0.01, 3.0);
    match draw.whole(0, 5) {
        0 => [0.0, 0.0],
        1 => [0.0, fading],
        2 => [draw.log_between(0.1, 1.0), 0.0],
        3 => [draw.log_between(0.1, 1.0), fading],
        4 => [-(draw.log_between(2.0, GROWTH).ln() / length).powi(2), 0.0],
        _ => [draw.log_between(0.1, 1.0), -(draw.log_between(2.0, GROWTH).ln() / length).min(1.5)],
    }
}
