//! Events that do something: they begin a force, change a parameter, or stop the run.
//!
//! # Law
//!
//! A point moves evenly to a place. There a constant force begins, or a spring gets its stiffness, or the run ends.
//!
//! # Closed form
//!
//! The place is reached after way/speed; what follows is a throw, or a swing about the place.
//!
//! # Source
//!
//! Landau and Lifshitz, Mechanics, § 21.

use super::super::oscillator::{Oscillator, State};
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{FORCE, LENGTH, MASS, SPEED, STIFFNESS, TIME};

/// The place in parts of the way.
const PLACES: [f64; 2] = [0.1, 0.7];
/// Changes of momentum by the force, in units of the first.
const IMPULSES: [f64; 2] = [0.1, 3.0];
/// Radians of the swing.
const PHASES: [f64; 2] = [0.3, 60.0];

pub(super) fn make(mut setup: Setup) -> Problem {
    let (mass, speed) = (setup.given("mass", 1.0, MASS), setup.given("speed", 1.0, SPEED));
    let length = setup.draw.log_between(0.3, 30.0);
    let (at, until) = (setup.shift("at"), setup.given("until", length, TIME));
    let part = Real::of(setup.draw.between(PLACES[0], PLACES[1]));
    let place = setup.near("place", &(&speed.value * &until.value * part), LENGTH);
    let there = &place.value / &speed.value;
    let run = Run { mass, speed, at, until, place, there };
    setup.write(&format!(
        "[body.p]
        point = {{}}
        mass = \"{}\"
        start = {{ at = [\"{}\", 0], velocity = [\"{}\", 0] }}",
        run.mass, run.at, run.speed
    ));
    match setup.draw.whole(0, 2) {
        0 => window(&mut setup, &run),
        1 => change(&mut setup, &run),
        _ => stop(&mut setup, &run),
    }
    setup.problem("0 m/s^2", &run.until)
}

struct Run {
    mass: Given,
    speed: Given,
    at: Given,
    until: Given,
    place: Given,
    /// When the place is reached.
    there: Real,
}

impl Run {
    fn event(&self, setup: &mut Setup, action: &str) {
        setup.write(&format!(
            "[event.there]
            when = \"p.x - {} rises through {}\"
            {action}",
            self.at, self.place
        ));
        setup.ask_time("there", &self.there);
    }

    /// Asks for the end, which is so far from the place.
    fn ask_end(&self, setup: &mut Setup, State { x, v }: State) {
        setup.ask("p.vx", At::End, &v, SPEED);
        let x = x + &self.place.value;
        setup.ask(&format!("p.x - {}", self.at), At::End, &x, LENGTH);
        setup.ask("p.x", At::End, &(x + &self.at.value), LENGTH);
    }

    fn state_there(&self) -> State {
        State { x: Real::zero(), v: self.speed.value.clone() }
    }
}

/// A force acts for at least this part of what is left of the run: none would last long enough that begins when it ends.
const SHORTEST: f64 = 1e-6;

/// A force from the place on, to a time.
fn window(setup: &mut Setup, run: &Run) {
    let there = run.there.to_f64();
    let rest = run.until.near() - there;
    let end = setup.time(
        "end",
        |draw| there + rest * draw.log_between(1e-3, 1.0),
        |time| (time - &run.there).to_f64() > SHORTEST * rest && *time < run.until.value,
    );
    let end = end.unwrap_or_else(|| run.until.clone());
    let impulse = Real::of(setup.draw.sign() * setup.draw.log_between(IMPULSES[0], IMPULSES[1]));
    let force = &run.mass.value * &run.speed.value * impulse / (&end.value - &run.there);
    let force = setup.near("force", &force, FORCE);
    run.event(setup, "");
    setup.write(&format!(
        "[force.push]
        on = \"p\"
        at = \"p.cm\"
        force = [\"{force}\", 0]
        during = [\"there\", \"{end}\"]"
    ));
    let free = Oscillator::undamped(Real::zero());
    let pushed =
        free.pushed(&run.state_there(), &(&force.value / &run.mass.value), &(&end.value - &run.there));
    let last = free.free(&pushed, &(&run.until.value - &end.value));
    run.ask_end(setup, last);
}

/// A spring about the place, from there on.
fn change(setup: &mut Setup, run: &Run) {
    let phases = Real::of(setup.draw.log_between(PHASES[0], PHASES[1]));
    let rest = &run.until.value - &run.there;
    let stiffness = (phases / &rest).squared() * &run.mass.value;
    let stiffness = setup.near("later", &stiffness, STIFFNESS);
    setup.parameter("stiffness", "0 N/m");
    run.event(setup, &format!("action = {{ set = {{ stiffness = \"{stiffness}\" }} }}"));
    setup.write(&format!(
        "[force.spring]
        on = \"p\"
        at = \"p.cm\"
        force = [\"-stiffness*(p.x - {} - {})\", 0]",
        run.at, run.place
    ));
    let system = Oscillator::undamped(&stiffness.value / &run.mass.value);
    run.ask_end(setup, system.free(&run.state_there(), &rest));
}

fn stop(setup: &mut Setup, run: &Run) {
    run.event(setup, "action = \"stop\"");
    run.ask_end(setup, run.state_there());
    setup.ask("t", At::End, &run.there, TIME);
}
