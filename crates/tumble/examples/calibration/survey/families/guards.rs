//! Steep guards: functions that rise or fall within a small part of the run, and pass a value there.
//!
//! # Law
//!
//! f((s - c)/w) = l, with s the time or a place that moves evenly or falls, and w from a tenth to a five thousandth of
//! its way.
//!
//! # Closed form
//!
//! s = c + w f^-1(l), once for a step and twice for a bump; the time of a place on the way down is
//! (v + sqrt(v^2 + 2 g d))/g.
//!
//! # Source
//!
//! Inverses of elementary functions.

use super::super::bump::Bump;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, LENGTH, Measure, NUMBER, SPEED, TIME};

/// Widths in parts of the way.
const WIDTHS: [f64; 2] = [1.0 / 5000.0, 0.1];

/// What is steep, of z = (s - c)/w.
#[derive(Clone, Copy, Debug)]
enum Steep {
    Tanh,
    Logistic,
    Atan,
    Bump(Bump),
}

const ALL: [Steep; 6] = [
    Steep::Tanh,
    Steep::Logistic,
    Steep::Atan,
    Steep::Bump(Bump::Gaussian),
    Steep::Bump(Bump::Lorentzian),
    Steep::Bump(Bump::Sech),
];

impl Steep {
    /// The formula of z.
    fn formula(self, z: &str) -> String {
        match self {
            Self::Tanh => format!("tanh({z})"),
            Self::Logistic => format!("1/(1 + exp(-({z})))"),
            Self::Atan => format!("atan({z})"),
            Self::Bump(bump) => bump.formula(z),
        }
    }

    fn levels(self) -> [f64; 2] {
        match self {
            Self::Tanh | Self::Atan => [-0.9, 0.9],
            Self::Logistic | Self::Bump(_) => [0.05, 0.95],
        }
    }

    /// Where the level is passed: z, in order.
    fn passings(self, level: &Real) -> Vec<Real> {
        match self {
            Self::Tanh => vec![level.atanh()],
            Self::Logistic => vec![(level / (1 - level)).ln()],
            Self::Atan => vec![level.tan()],
            Self::Bump(bump) => bump.passings(level).to_vec(),
        }
    }
}

/// What the argument is, with its time at each of its values.
struct Way {
    formula: &'static str,
    measure: Measure,
    /// Where it begins, and where it ends.
    ends: [Real; 2],
    motion: Motion,
}

/// s = start + speed t + change t^2/2, which grows or falls all along.
struct Motion {
    start: Real,
    speed: Real,
    change: Real,
}

impl Motion {
    fn at(&self, time: &Real) -> Real {
        &self.start + &self.speed * time + &self.change * time.squared() / 2
    }

    /// `None` of a place that it never comes to: one above a fall.
    fn time(&self, place: &Real) -> Option<Real> {
        let way = place - &self.start;
        let square = self.speed.squared() + &self.change * &way * 2;
        if square.sign() < 0 {
            return None;
        }
        let falls = self.speed.sign() < 0 || self.change.sign() < 0;
        Some(way * 2 / (&self.speed + square.sqrt() * if falls { -1 } else { 1 }))
    }
}

pub(super) fn make(mut setup: Setup) -> Problem {
    let gravity = setup.given("g", 1.0, ACCELERATION);
    let length = setup.draw.log_between(0.3, 30.0);
    let until = setup.given("until", length, TIME);
    let [x, y] = ["at_x", "at_y"].map(|name| setup.shift(name));
    let (vx, vy) = (setup.draw.log_between(0.1, 3.0), -setup.draw.log_between(0.1, 3.0));
    let [vx, vy] = [("vx", vx), ("vy", vy)].map(|(name, size)| setup.given(name, size, SPEED));
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"1 kg\"
        start = {{ at = [\"{x}\", \"{y}\"], velocity = [\"{vx}\", \"{vy}\"] }}"
    ));
    let motion = |start: &Real, speed: &Real, change: &Real| Motion {
        start: start.clone(),
        speed: speed.clone(),
        change: change.clone(),
    };
    let none = Real::zero();
    let (formula, measure, motion) = match setup.draw.whole(0, 2) {
        0 => ("t", TIME, motion(&none, &Real::from(1), &none)),
        1 => ("p.x", LENGTH, motion(&x.value, &vx.value, &none)),
        _ => ("p.y", LENGTH, motion(&y.value, &vy.value, &-&gravity.value)),
    };
    let ends = [motion.at(&none), motion.at(&until.value)];
    let way = Way { formula, measure, ends, motion };
    let speed = |time: &Real| -(&gravity.value * time) + &vy.value;
    guard(&mut setup, &way, &until, &speed);
    setup.problem(&gravity.word, &until)
}

fn guard(setup: &mut Setup, way: &Way, until: &Given, speed: &dyn Fn(&Real) -> Real) {
    let steep = setup.draw.pick(&ALL);
    let [from, to] = &way.ends;
    let width = (to - from).abs() * Real::of(setup.draw.log_between(WIDTHS[0], WIDTHS[1]));
    let width = setup.near("width", &width, way.measure);
    let centre = from + (to - from) * Real::of(setup.draw.between(0.2, 0.8));
    let centre = setup.near("centre", &centre, way.measure);
    let [low, high] = steep.levels();
    let level = setup.draw.between(low, high);
    let level = match steep {
        Steep::Atan => setup.angle("level", level),
        _ => setup.given("level", level, NUMBER),
    };
    let z = format!("({} - {centre})/{width}", way.formula);
    setup.write(&format!(
        "[event.pass]
        when = \"{} passes through {level}\"",
        steep.formula(&z)
    ));
    let places = steep.passings(&level.value).into_iter().map(|z| &centre.value + z * &width.value);
    let mut times: Vec<Real> = places.filter_map(|place| way.motion.time(&place)).collect();
    times.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    times.retain(|time| time.sign() > 0 && *time < until.value);
    ask(setup, &times, speed);
}

fn ask(setup: &mut Setup, times: &[Real], speed: &dyn Fn(&Real) -> Real) {
    for (count, time) in times.iter().enumerate() {
        let instant = format!("pass[{}]", count + 1);
        setup.ask_time(&instant, time);
        setup.ask("p.vy", At::After(instant), &speed(time), SPEED);
    }
    if let [first, second] = times {
        setup.ask("pass[2] - pass[1]", At::End, &(second - first), TIME);
    }
}
