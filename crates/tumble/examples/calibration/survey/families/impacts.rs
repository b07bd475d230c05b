//! Balls and flat rods that bounce on rigid floors and slopes, elastically or until they rest.
//!
//! # Law
//!
//! Between impacts the gap has the acceleration -g cos(slope), along the slope there is -g sin(slope). An impact turns
//! the rate of the gap round, to e of what it was.
//!
//! # Closed form
//!
//! The first impact is at (r + u)/g with u = sqrt(r^2 + 2 g gap), the flights after it last 2 u e^n/g each, and all of
//! them together 2 u e/(g (1 - e)).
//!
//! # Source
//!
//! Newton's law of restitution; the sum of a geometric series.

use super::super::bounces::{Bounces, Hit};
use super::super::draw::Draw;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, ENERGY, LENGTH, MASS, NUMBER, RATE, SPEED, TIME};

/// Bounces of a run.
const MOST_COUNT: f64 = 1000.0;
/// Runs do not end in flights shorter than this part of them.
const SHORTEST: f64 = 3e-4;
/// Up to this restitution motions are followed beyond their last impact.
const MOST_TO_REST: f64 = 0.9;
/// Impacts that are asked for are no slower than this part of the first: the program sums up the very small ones.
const SLOWEST: f64 = 1e-4;
/// Angles of slopes, rad.
const SLOPES: [f64; 2] = [0.02, 1.1];

/// A ball on a floor or a slope.
pub(super) fn ball(mut setup: Setup) -> Problem {
    let tilt = if setup.draw.chance(0.5) { setup.draw.between(SLOPES[0], SLOPES[1]) } else { 0.0 };
    let tilt = setup.draw.sign() * tilt;
    let slope = setup.angle("slope", tilt);
    let radius = if setup.draw.chance(0.5) { setup.draw.log_between(1e-3, 1.0) } else { 0.0 };
    let radius = setup.given("radius", radius, LENGTH);
    let shape = if radius.value.is_zero() {
        "point = {}".to_owned()
    } else {
        format!("ball = {{ radius = \"{radius}\" }}")
    };
    let scene = Scene::random(&mut setup, slope, radius.value);
    scene.write(&mut setup, &shape, "");
    finish(setup, &scene, &[])
}

/// A rod or a box that falls flat, and has to stay level.
pub(super) fn level(mut setup: Setup) -> Problem {
    let half = setup.draw.log_between(0.05, 3.0);
    let length = setup.given("length", 2.0 * half, LENGTH);
    let slope = Given { word: "0 deg".into(), value: Real::zero() };
    let (shape, radius) = if setup.draw.chance(0.5) {
        (format!("rod = {{ from = [0, 0], to = [\"{length}\", 0] }}"), Real::zero())
    } else {
        let height = setup.given("height", 0.5, LENGTH);
        (format!("box = {{ width = \"{length}\", height = \"{height}\" }}"), height.value / 2)
    };
    let scene = Scene::random(&mut setup, slope, radius);
    scene.write(&mut setup, &shape, "angle = 0, omega = 0, ");
    let none = Real::zero();
    finish(setup, &scene, &[("p.angle", none.clone(), NUMBER), ("p.omega", none, RATE)])
}

/// A body above a surface.
struct Scene {
    mass: Given,
    gravity: Given,
    slope: Given,
    foot: [Given; 2],
    offset: [Given; 2],
    velocity: [Given; 2],
    restitution: Given,
    bounces: Bounces,
    /// From the surface to the centre in touch.
    radius: Real,
    until: Given,
}

/// Components across a slope and along it.
fn turned([x, y]: [&Real; 2], slope: &Real) -> [Real; 2] {
    let [sine, cosine] = [slope.sin(), slope.cos()];
    [y * &cosine - x * &sine, x * cosine + y * sine]
}

impl Scene {
    fn random(setup: &mut Setup, slope: Given, radius: Real) -> Self {
        let (mass, gravity) = (setup.given("mass", 1.0, MASS), setup.given("g", 1.0, ACCELERATION));
        let foot = ["foot_x", "foot_y"].map(|name| setup.shift(name));
        let least = radius.to_f64() / setup.units.size(LENGTH);
        let (sine, cosine) = slope.near().sin_cos();
        let drawn = |draw: &mut Draw| {
            let (above, along) = (least + draw.log_between(0.05, 3.0), draw.between(-1.0, 1.0));
            [along * cosine - above * sine, along * sine + above * cosine]
        };
        let is_above = |place: [&Real; 2]| (&turned(place, &slope.value)[0] - &radius).sign() > 0;
        let offset = setup.fit_all(["offset_x", "offset_y"], LENGTH, drawn, is_above);
        let speeds = [0; 2].map(|_| setup.draw.between(-1.0, 1.0));
        let velocity =
            [("vx", speeds[0]), ("vy", speeds[1])].map(|(name, size)| setup.given(name, size, SPEED));
        let restitution = restitution(setup);
        let [height, _] = turned(offset.each_ref().map(|part| &part.value), &slope.value);
        let [rate, _] = turned(velocity.each_ref().map(|part| &part.value), &slope.value);
        let normal = &gravity.value * slope.value.cos();
        let bounces = Bounces::new(normal, height - &radius, rate, restitution.value.clone());
        let until = until(setup, &bounces, restitution.near());
        Self { mass, gravity, slope, foot, offset, velocity, restitution, bounces, radius, until }
    }

    fn write(&self, setup: &mut Setup, shape: &str, start: &str) {
        let Self { mass, foot: [px, py], offset: [dx, dy], velocity: [vx, vy], restitution, slope, .. } =
            self;
        setup.write(&format!(
            "[body.p]
            {shape}
            mass = \"{mass}\"
            start = {{ {start}at = [\"{px} + {dx}\", \"{py} + {dy}\"], velocity = [\"{vx}\", \"{vy}\"] }}
            [surface.floor]
            through = [\"{px}\", \"{py}\"]
            slope = \"{slope}\"
            rigid = {{ restitution = \"{restitution}\" }}"
        ));
    }

    /// Place and velocity, from what they are across the slope.
    fn state(&self, time: &Real, [gap, rate]: [Real; 2]) -> [[Real; 2]; 2] {
        let slope = &self.slope.value;
        let [_, place] = turned(self.offset.each_ref().map(|part| &part.value), slope);
        let [_, speed] = turned(self.velocity.each_ref().map(|part| &part.value), slope);
        let change = -(&self.gravity.value * slope.sin());
        let along = place + &speed * time + &change * time.squared() / 2;
        let [dx, dy] = back([&(gap + &self.radius), &along], slope);
        let place = [&self.foot[0].value + dx, &self.foot[1].value + dy];
        [place, back([&rate, &(speed + change * time)], slope)]
    }
}

/// The opposite of [`turned`].
fn back([across, along]: [&Real; 2], slope: &Real) -> [Real; 2] {
    let [sine, cosine] = [slope.sin(), slope.cos()];
    [along * &cosine - across * &sine, along * sine + across * cosine]
}

fn restitution(setup: &mut Setup) -> Given {
    let size = match setup.draw.whole(0, 5) {
        0 | 1 => 1.0,
        2 => setup.draw.between(0.9, 0.999),
        3 => 0.5,
        _ => setup.draw.between(0.05, 0.9),
    };
    setup.given("e", size, NUMBER)
}

/// The end of the run: after some bounces, or when all are over.
fn until(setup: &mut Setup, bounces: &Bounces, restitution: f64) -> Given {
    let hits = bounces.hits();
    let first = hits[0].time.to_f64();
    let limit = bounces.limit().filter(|_| restitution <= MOST_TO_REST && setup.draw.chance(0.5));
    let size = limit.map_or_else(|| many(setup, bounces), |limit| limit.to_f64() * 1.05);
    let is_fit = |time: &Real| bounces.is_clear(time) && hits[0].time < *time;
    let found = setup.time("until", |draw| size + first * draw.between(0.0, 1.0), is_fit);
    found.unwrap_or_else(|| setup.near("until", &(&hits[0].time / 2), TIME))
}

/// The time of an impact that is followed by a flight of some length.
fn many(setup: &mut Setup, bounces: &Bounces) -> f64 {
    let is_long = |pair: &&[Hit]| pair[1].time.to_f64() / pair[0].time.to_f64() - 1.0 > SHORTEST;
    let most = bounces.hits().windows(2).take_while(is_long).count().max(1) as f64;
    let count = setup.draw.log_between(1.0, most.min(MOST_COUNT)) as usize;
    bounces.hits()[count - 1].time.to_f64()
}

/// Other values with their truths, at the end and at an impact.
type Others<'a> = &'a [(&'a str, Real, super::super::units::Measure)];

fn finish(mut setup: Setup, scene: &Scene, others: Others<'_>) -> Problem {
    ask_end(&mut setup, scene, others);
    let hits = scene.bounces.before(&scene.until.value);
    let hits = hits.iter().take_while(|hit| hit.before > &hits[0].before * Real::of(SLOWEST)).count();
    if hits > 0 {
        let count = setup.draw.log_between(1.0, hits as f64).round() as usize;
        ask_hit(&mut setup, scene, count, others);
    }
    if let Some(limit) = scene.bounces.limit().filter(|limit| *limit < scene.until.value) {
        setup.ask_rest(&limit);
    }
    setup.problem(&scene.gravity.word, &scene.until)
}

fn ask_end(setup: &mut Setup, scene: &Scene, others: Others<'_>) {
    let time = &scene.until.value;
    let [gap, rate] = scene.bounces.at(time);
    let [[x, y], [vx, vy]] = scene.state(time, [gap, rate]);
    for (that, truth, measure) in
        [("p.x", &x, LENGTH), ("p.y", &y, LENGTH), ("p.vx", &vx, SPEED), ("p.vy", &vy, SPEED)]
    {
        setup.ask(that, At::End, truth, measure);
    }
    for (that, truth, measure) in others {
        setup.ask(that, At::End, truth, *measure);
    }
    let mass = &scene.mass.value;
    // Elastic impacts give back what they take.
    let taken = (mass * scene.bounces.hits()[0].before.squared() / 2).to_f64();
    let work = -(mass * scene.bounces.lost(time));
    setup.ask_beside("floor.work", At::End, (&work, taken), ENERGY);
    let fallen = y - &scene.foot[1].value - &scene.offset[1].value;
    setup.ask("gravity.work", At::End, &-(mass * &scene.gravity.value * fallen), ENERGY);
}

/// Values at an impact, by its number.
fn ask_hit(setup: &mut Setup, scene: &Scene, count: usize, others: Others<'_>) {
    let hit = &scene.bounces.hits()[count - 1];
    let per_hit = if others.is_empty() { 1 } else { 2 };
    let contact = |count: usize| format!("floor.contact[{}].start", per_hit * (count - 1) + 1);
    let instant = contact(count);
    setup.ask(&instant, At::End, &hit.time, TIME);
    setup.ask_time(&instant, &hit.time);
    let [[x, _], [vx, vy]] = scene.state(&hit.time, [Real::zero(), hit.after.clone()]);
    setup.ask("p.x", At::After(instant.clone()), &x, LENGTH);
    setup.ask("p.vy", At::After(instant.clone()), &vy, SPEED);
    setup.ask("p.vx", At::After(instant.clone()), &vx, SPEED);
    let [_, [_, vy]] = scene.state(&hit.time, [Real::zero(), -&hit.before]);
    setup.ask("p.vy", At::Before(instant.clone()), &vy, SPEED);
    for (that, truth, measure) in others {
        setup.ask(that, At::After(instant.clone()), truth, *measure);
    }
    if count > 1 {
        let first = &scene.bounces.hits()[0].time;
        setup.ask(&format!("{instant} - {}", contact(1)), At::End, &(&hit.time - first), TIME);
    }
}
