//! Forces that act between two times, long ones and strong short ones, in free motion and on springs.
//!
//! # Law
//!
//! m x'' = -k x - c x' + F while start <= t < end, for each of one to three forces.
//!
//! # Closed form
//!
//! Piece by piece that of a linear motion under a constant force. A force does the work F (x(end) - x(start)).
//!
//! # Source
//!
//! [`Oscillator`](super::super::oscillator::Oscillator).

use super::super::oscillator::{Oscillator, State};
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{DAMPING, ENERGY, FORCE, LENGTH, MASS, SPEED, STIFFNESS, TIME};

/// Lengths of windows in parts of the run.
const LENGTHS: [f64; 2] = [1e-8, 0.3];
/// Changes of momentum that a force makes, in units of the first momentum.
const IMPULSES: [f64; 2] = [0.1, 3.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let length = setup.draw.log_between(0.3, 30.0);
    let until = setup.given("until", length, TIME);
    let mass = setup.given("mass", 1.0, MASS);
    let speed = setup.given("speed", 1.0, SPEED);
    let at = setup.shift("at");
    let count = setup.draw.whole(1, 3);
    let windows: Vec<Window> = (0..count)
        .filter_map(|number| Window::random(&mut setup, number, count, (&mass, &speed, &until)))
        .collect();
    let system = springs(&mut setup, &mass, &at);
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{mass}\"
        start = {{ at = [\"{at}\", 0], velocity = [\"{speed}\", 0] }}"
    ));
    windows.iter().for_each(|window| window.write(&mut setup));
    let motion = Motion { system, mass, at, speed, windows };
    ask(&mut setup, &motion, &until);
    setup.problem("0 m/s^2", &until)
}

/// One force, by its index.
struct Window {
    name: String,
    force: Given,
    start: Given,
    end: Given,
}

impl Window {
    /// The windows of a run follow each other.
    fn random(setup: &mut Setup, number: usize, count: usize, of: (&Given, &Given, &Given)) -> Option<Self> {
        let (mass, speed, until) = of;
        let share = until.near() / count as f64;
        let ends = [number, number + 1].map(|edge| &until.value * edge as i64 / count as i64);
        let length = share * setup.draw.log_between(LENGTHS[0], LENGTHS[1]);
        let name = format!("kick{number}");
        let begin = |draw: &mut super::super::draw::Draw| share * (number as f64 + draw.between(0.1, 0.5));
        let start = setup.time(&format!("{name}_start"), begin, |time| ends[0] < *time && *time < ends[1])?;
        let lasting =
            setup.time(&format!("{name}_length"), |draw| length * draw.between(0.5, 1.0), |_| true)?;
        let end = Given { word: format!("{start} + {lasting}"), value: &start.value + &lasting.value };
        let impulse = setup.draw.sign() * setup.draw.log_between(IMPULSES[0], IMPULSES[1]);
        let force = &mass.value * &speed.value / &lasting.value * Real::of(impulse);
        let force = setup.near(&format!("{name}_force"), &force, FORCE);
        (end.value < ends[1]).then_some(Self { name, force, start, end })
    }

    fn write(&self, setup: &mut Setup) {
        let Self { name, force, start, end } = self;
        setup.write(&format!(
            "[force.{name}]
            on = \"p\"
            at = \"p.cm\"
            force = [\"{force}\", 0]
            during = [\"{start}\", \"{end}\"]"
        ));
    }
}

/// No spring, or one with or without damping.
fn springs(setup: &mut Setup, mass: &Given, at: &Given) -> Oscillator {
    let size = setup.draw.pick(&[0.0, 1.0]) * setup.draw.log_between(0.05, 3.0);
    let stiffness = setup.given("stiffness", size, STIFFNESS);
    let size = setup.draw.pick(&[0.0, 1.0]) * setup.draw.log_between(0.01, 1.0);
    let damping = setup.given("damping", size, DAMPING);
    setup.write(&format!(
        "[force.spring]
        on = \"p\"
        at = \"p.cm\"
        force = [\"-{stiffness}*(p.x - {at}) - {damping}*p.vx\", 0]"
    ));
    Oscillator { stiffness: stiffness.value / &mass.value, damping: damping.value / &mass.value }
}

struct Motion {
    system: Oscillator,
    mass: Given,
    at: Given,
    speed: Given,
    windows: Vec<Window>,
}

impl Motion {
    /// The place, from where it began, and the velocity.
    fn state(&self, time: &Real) -> State {
        let mut state = State { x: Real::zero(), v: self.speed.value.clone() };
        let mut now = Real::zero();
        let none = Real::zero();
        for window in self.windows.iter().take_while(|window| window.start.value < *time) {
            state = self.system.pushed(&state, &none, &(&window.start.value - &now));
            now = if window.end.value < *time { window.end.value.clone() } else { time.clone() };
            let drive = &window.force.value / &self.mass.value;
            state = self.system.pushed(&state, &drive, &(&now - &window.start.value));
        }
        self.system.pushed(&state, &none, &(time - now))
    }
}

fn ask(setup: &mut Setup, motion: &Motion, until: &Given) {
    let then = setup.moment("then", until);
    let mut instants = vec![(At::End, until.value.clone()), (At::After(then.word.clone()), then.value)];
    for Window { name, start, end, .. } in &motion.windows {
        instants.push((At::After(format!("{name}.start")), start.value.clone()));
        instants.push((At::After(format!("{name}.end")), end.value.clone()));
    }
    for (at, time) in instants {
        let State { x, v } = motion.state(&time);
        setup.ask("p.vx", at.clone(), &v, SPEED);
        setup.ask("p.x", at, &(x + &motion.at.value), LENGTH);
    }
    for Window { name, force, start, end } in &motion.windows {
        let way = motion.state(&end.value).x - motion.state(&start.value).x;
        setup.ask(&format!("{name}.work"), At::End, &(&force.value * way), ENERGY);
        setup.ask_time(&format!("{name}.end"), &end.value);
    }
}
