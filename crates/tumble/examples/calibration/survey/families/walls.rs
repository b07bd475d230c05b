//! A ball that is thrown to and fro between two walls.
//!
//! # Law
//!
//! Between impacts the velocity across the walls stays; an impact turns it round, to e of what it was.
//!
//! # Closed form
//!
//! Each way takes the width over the speed, which is e1 e2 e1 .. of the first.
//!
//! # Source
//!
//! Newton's law of restitution.

use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, ENERGY, LENGTH, MASS, NUMBER, SPEED, TIME};

/// Impacts of a run.
const MOST: f64 = 1000.0;
/// The speed becomes no smaller than this part of the first.
const SLOWEST: f64 = 1e-6;
/// The run ends in this part of its last way.
const LAST: [f64; 2] = [0.1, 0.9];

pub(super) fn make(mut setup: Setup) -> Problem {
    let (mass, gravity) = (setup.given("mass", 1.0, MASS), setup.given("g", 1.0, ACCELERATION));
    let size = if setup.draw.chance(0.5) { setup.draw.log_between(1e-3, 0.2) } else { 0.0 };
    let radius = setup.given("radius", size, LENGTH);
    let left = setup.shift("left");
    let width = setup.given("width", 1.0, LENGTH);
    let part = Real::of(setup.draw.between(0.35, 0.6));
    let offset = setup.near("offset", &(&width.value * part), LENGTH);
    let speed = setup.draw.sign();
    let speed = setup.given("speed", speed, SPEED);
    let restitutions = ["e_left", "e_right"].map(|name| restitution(&mut setup, name));
    let ways = Ways::new(&mut setup, [&width, &offset, &radius], &speed, &restitutions);
    let shape =
        if size == 0.0 { "point = {}".to_owned() } else { format!("ball = {{ radius = \"{radius}\" }}") };
    let [e_left, e_right] = &restitutions;
    setup.write(&format!(
        "[body.p]
        {shape}
        mass = \"{mass}\"
        start = {{ at = [\"{left} + {offset}\", 0], velocity = [\"{speed}\", 0] }}
        [surface.wall_l]
        through = [\"{left}\", 0]
        normal = [1, 0]
        rigid = {{ restitution = \"{e_left}\" }}
        [surface.wall_r]
        through = [\"{left} + {width}\", 0]
        normal = [-1, 0]
        rigid = {{ restitution = \"{e_right}\" }}"
    ));
    let until = ways.until(&mut setup);
    ask(&mut setup, &ways, (&mass, &left, &speed), &until);
    setup.problem(&gravity.word, &until)
}

fn restitution(setup: &mut Setup, name: &str) -> Given {
    let size = if setup.draw.chance(0.5) { 1.0 } else { setup.draw.between(0.3, 0.999) };
    setup.given(name, size, NUMBER)
}

fn ask(setup: &mut Setup, ways: &Ways, (mass, left, speed): (&Given, &Given, &Given), until: &Given) {
    let last = ways.hits.iter().rev().find(|hit| hit.time < until.value).expect("the run is longer");
    setup.ask("p.vx", At::End, &last.speed, SPEED);
    let x = &last.place + &last.speed * (&until.value - &last.time);
    setup.ask(&format!("p.x - {left}"), At::End, &x, LENGTH);
    setup.ask("p.x", At::End, &(x + &left.value), LENGTH);
    let change = last.speed.squared() - speed.value.squared();
    setup.ask("wall_l.work + wall_r.work", At::End, &(&mass.value * change / 2), ENERGY);
    for (count, hit) in one_each(setup, ways, &until.value) {
        let wall = if hit.place.to_f64() < ways.middle { "wall_l" } else { "wall_r" };
        let instant = format!("{wall}.contact[{count}].start");
        setup.ask(&instant, At::End, &hit.time, TIME);
        setup.ask("p.vx", At::After(instant.clone()), &hit.speed, SPEED);
        setup.ask("p.x", At::After(instant), &(&hit.place + &left.value), LENGTH);
    }
}

/// An early impact and any one, each with its number at its wall.
fn one_each<'w>(setup: &mut Setup, ways: &'w Ways, until: &Real) -> Vec<(usize, &'w Hit)> {
    let count = ways.hits.iter().take_while(|hit| hit.time < *until).count() - 1;
    let chosen: Vec<usize> =
        (0..count.min(2)).map(|_| setup.draw.log_between(1.0, count as f64) as usize).collect();
    chosen.into_iter().map(|number| (number.div_ceil(2), &ways.hits[number])).collect()
}

/// An impact, or the start: when, where from the left wall, and the velocity after it.
struct Hit {
    time: Real,
    place: Real,
    speed: Real,
}

struct Ways {
    hits: Vec<Hit>,
    middle: f64,
}

impl Ways {
    fn new(
        setup: &mut Setup,
        [width, offset, radius]: [&Given; 3],
        speed: &Given,
        restitutions: &[Given; 2],
    ) -> Self {
        let ends = [radius.value.clone(), &width.value - &radius.value];
        let start = Hit { time: Real::zero(), place: offset.value.clone(), speed: speed.value.clone() };
        let mut ways = Self { hits: vec![start], middle: width.near() / 2.0 };
        let count = setup.draw.log_between(1.0, MOST) as usize;
        let slowest = speed.near().abs() * SLOWEST;
        // One more than there are, to know when the last way ends.
        while ways.hits.len() <= count + 1 && ways.hits[ways.hits.len() - 1].speed.to_f64().abs() > slowest {
            let last = &ways.hits[ways.hits.len() - 1];
            let right = usize::from(last.speed.sign() > 0);
            let place = ends[right].clone();
            let time = &last.time + (&place - &last.place) / &last.speed;
            let speed = -(&last.speed * &restitutions[right].value);
            ways.hits.push(Hit { time, place, speed });
        }
        ways
    }

    fn until(&self, setup: &mut Setup) -> Given {
        let [from, to] = [2, 1].map(|back| self.hits[self.hits.len() - back].time.to_f64());
        let inside = LAST.map(|part| from + part * (to - from));
        let is_fit = |time: &Real| (inside[0]..inside[1]).contains(&time.to_f64());
        let found = setup.time("until", |draw| draw.between(inside[0], inside[1]), is_fit);
        found.unwrap_or_else(|| setup.near("until", &(&self.hits[1].time / 2), TIME))
    }
}
