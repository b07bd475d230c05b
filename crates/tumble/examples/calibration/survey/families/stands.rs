//! A point that falls onto a rough damped floor or slope, slips, and comes to stand there.
//!
//! # Law
//!
//! Across the ground m d'' = m g cos(slope) - N with N = k d + c d'; along it friction mu N against the motion, until that stops.
//!
//! # Closed form
//!
//! The depth is that of a driven oscillator ([`Oscillator`]). Along the ground v = v_0 - g sin(slope) t - sign(v_0) mu J with the impulse
//! J = g cos(slope) t + v_n - d' of a mass of one, which is zero at a root; from there on friction holds g sin(slope).
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, § 26, with Coulomb's law.

use super::super::ground::friction;
use super::super::oscillator::{Oscillator, State};
use super::super::quadrature::root;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, DAMPING, FORCE, LENGTH, MASS, SPEED, STIFFNESS, TIME};

/// Angles of slopes, rad, and the share of them.
const SLOPES: [f64; 2] = [0.02, 0.5];
const SLOPED: f64 = 0.5;
/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.1, 1.5];
/// Damping in parts of the critical: so much that it does not leave the ground.
const DAMPINGS: [f64; 2] = [0.4, 1.6];
/// Speeds of landing, in parts of g times the time of the floor.
const LANDINGS: [f64; 2] = [0.03, 0.3];
/// Frequencies of the floor in radians for each unit of time.
const FREQUENCIES: [f64; 2] = [3.0, 1e4];
/// Radians in which the floor settles, and places that are looked at in them and until it stops.
const SETTLES: i64 = 30;
const PLACES: i64 = 150;

pub(super) fn make(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let gravity = setup.given("g", 1.0, ACCELERATION);
    let size = setup.draw.sign() * setup.draw.between(SLOPES[0], SLOPES[1]);
    let is_sloped = setup.draw.chance(SLOPED);
    let slope = setup.angle("slope", if is_sloped { size } else { 0.0 });
    let foot = ["foot_x", "foot_y"].map(|name| setup.given(name, 0.0, LENGTH));
    let [pull, push] = [-(&gravity.value * slope.value.sin()), &gravity.value * slope.value.cos()];
    let floor = Floor::random(&mut setup, &mass.value);
    let landing = Real::of(setup.draw.log_between(LANDINGS[0], LANDINGS[1]));
    let frequency = floor.system.stiffness.sqrt();
    let height = setup.near("height", &((&landing * &push / &frequency).squared() / (&push * 2)), LENGTH);
    let size = setup.draw.sign() * setup.draw.log_between(0.03, 3.0);
    let speed = setup.given("speed", size, SPEED);
    let (friction, rough) = friction(&mut setup, FRICTION);
    let [x, y] = &foot;
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{mass}\"
        [body.p.start]
        at = [\"{x} - {height}*sin({slope})\", \"{y} + {height}*cos({slope})\"]
        velocity = [\"{speed}*cos({slope})\", \"{speed}*sin({slope})\"]
        [surface.floor]
        through = [\"{x}\", \"{y}\"]
        slope = \"{slope}\"
        spring = {{ stiffness = \"{}\", damping = \"{}\", {rough} }}",
        floor.stiffness, floor.damping
    ));
    let fall = (&height.value * 2 / &push).sqrt();
    let there = Landed {
        across: &push * &fall,
        along: &speed.value + &pull * &fall,
        system: floor.system,
        push,
        pull,
        friction,
    };
    let since = there.stops();
    let stop = &fall + &since;
    let size = Real::of(setup.draw.between(1.05, 1.5));
    let until = setup.near("until", &(&stop * size), TIME);
    let late = &until.value - &fall;
    assert!(late > since, "it stands at the end");
    let place = &speed.value * &fall + &there.pull * fall.squared() / 2 + there.place(&since);
    setup.ask_time("floor.p.sticks", &stop);
    let [sine, cosine] = [slope.value.sin(), slope.value.cos()];
    let State { x: depth, .. } = there.depth(&late);
    setup.ask("p.x", At::End, &(&foot[0].value + &place * &cosine + &depth * &sine), LENGTH);
    let mass = &mass.value;
    let held = -(&there.pull * mass);
    setup.ask_beside("floor.friction", At::End, (&held, (&there.push * mass).to_f64()), FORCE);
    setup.ask("floor.normal", At::End, &(there.normal(&late) * mass), FORCE);
    setup.problem(&gravity.word, &until)
}

struct Floor {
    stiffness: Given,
    damping: Given,
    system: Oscillator,
}

impl Floor {
    fn random(setup: &mut Setup, mass: &Real) -> Self {
        let frequency = setup.draw.log_between(FREQUENCIES[0], FREQUENCIES[1]);
        let stiffness = setup.given("stiffness", frequency * frequency, STIFFNESS);
        let part = setup.draw.between(DAMPINGS[0], DAMPINGS[1]);
        let critical = (&stiffness.value * mass).sqrt() * 2;
        let damping = setup.near("damping", &(critical * Real::of(part)), DAMPING);
        let system = Oscillator { stiffness: &stiffness.value / mass, damping: &damping.value / mass };
        Self { stiffness, damping, system }
    }
}

/// What has come to the ground, as a mass of one.
struct Landed {
    system: Oscillator,
    /// Weight across the ground and along it.
    push: Real,
    pull: Real,
    /// Velocities at the landing.
    across: Real,
    along: Real,
    /// Kinetic and static coefficient.
    friction: [Real; 2],
}

impl Landed {
    fn depth(&self, time: &Real) -> State {
        self.system.pushed(&State { x: Real::zero(), v: self.across.clone() }, &self.push, time)
    }

    fn normal(&self, time: &Real) -> Real {
        let State { x, v } = self.depth(time);
        &self.system.stiffness * x + &self.system.damping * v
    }

    /// For the friction against the first motion.
    fn against(&self) -> Real {
        &self.friction[0] * self.along.sign()
    }

    fn speed(&self, time: &Real) -> Real {
        let impulse = &self.push * time + &self.across - self.depth(time).v;
        &self.along + &self.pull * time - self.against() * impulse
    }

    fn place(&self, time: &Real) -> Real {
        let (fallen, sunk) = (time.squared() / 2, self.depth(time).x);
        let pushed = &self.push * &fallen + &self.across * time - sunk;
        &self.along * time + &self.pull * fallen - self.against() * pushed
    }

    /// When it stops for good, without ever leaving the ground.
    fn stops(&self) -> Real {
        let slowed = self.against() * &self.push - &self.pull;
        assert!((&slowed * self.along.sign()).sign() > 0, "it stops");
        let settled = SETTLES / self.system.stiffness.sqrt();
        let places = |most: &Real| (1..=PLACES).map(|place| most * place / PLACES).collect::<Vec<_>>();
        assert!(places(&settled).iter().all(|time| self.normal(time).sign() > 0), "it stays on the ground");
        let most = (&self.along / slowed).abs() * 2 + &settled;
        let has_stopped = |time: &Real| self.speed(time).sign() != self.along.sign();
        let mut times = [places(&settled), places(&most)].concat();
        times.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        let late = times.iter().position(has_stopped).expect("it has stopped by then");
        let early = if late == 0 { Real::zero() } else { times[late - 1].clone() };
        let stop = root(|time| -(self.speed(time) * self.along.sign()), [&early, &times[late]]);
        let holds = |time: &Real| self.pull.abs() < &self.friction[1] * self.normal(&(&stop + time));
        assert!(holds(&Real::zero()) && places(&settled).iter().all(holds), "it is held");
        stop
    }
}
