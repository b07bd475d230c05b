//! A tilted rod, or something round with spin, that falls onto a rough floor: one impact.
//!
//! # Law
//!
//! Friction follows the slip in the course of the impact (Routh), by Poisson's or Stronge's restitution.
//!
//! # Closed form
//!
//! It strikes at (r + u)/g with u = sqrt(r^2 + 2 g gap), where the impulse is that of `impact`. Then it flies freely.
//!
//! # Source
//!
//! Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV; Stronge, Impact Mechanics, 2000.

use super::super::draw::Draw;
use super::super::ground::{Round, friction};
use super::super::impact::Impact;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, LENGTH, MASS, MOMENTUM, NUMBER, RATE, SPEED};

/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.02, 1.2];
/// Restitution.
const RESTITUTION: [f64; 2] = [0.1, 1.0];
/// Tilts of rods, rad.
const TILTS: [f64; 2] = [0.1, 1.45];
/// The least flight after it that is looked at, in parts of that before, and in how many places.
const SHORTEST: f64 = 1e-3;
const PLACES: i64 = 50;

pub(super) fn rod(mut setup: Setup) -> Problem {
    let length = setup.given("length", 1.0, LENGTH);
    let (side, tilt) = (setup.draw.sign(), setup.draw.between(TILTS[0], TILTS[1]));
    let angle = setup.angle("angle", side * tilt);
    let half = &length.value / 2;
    // The lower end from the centre.
    let low = -angle.value.sign();
    let arm = [angle.value.cos(), angle.value.sin()].map(|part| part * &half * low);
    let body =
        Body { arm, spin: Real::zero(), gyration: half.squared() / 3, ends: vec![half.clone(), -&half] };
    let shape = format!("rod = {{ from = [\"-({length})/2\", 0], to = [\"({length})/2\", 0] }}");
    strike(setup, [&shape, &format!("angle = \"{angle}\"")], &body, &angle.value)
}

pub(super) fn round(mut setup: Setup) -> Problem {
    let round = Round::random(&mut setup);
    let radius = &round.radius.value;
    let rim = setup.draw.between(-3.0, 3.0) * setup.units.size(LENGTH) / round.radius.near();
    let omega = setup.omega("omega", rim);
    let gyration = radius.squared() * &round.inertia;
    let arm = [Real::zero(), -radius];
    let body = Body { arm, spin: omega.value.clone(), gyration, ends: vec![] };
    strike(setup, [&round.shape(), &format!("omega = \"{omega}\"")], &body, &Real::zero())
}

struct Body {
    /// From the centre to where it strikes.
    arm: [Real; 2],
    spin: Real,
    /// Moment of inertia over the mass.
    gyration: Real,
    /// Ends of a rod along its own axis.
    ends: Vec<Real>,
}

fn strike(mut setup: Setup, [shape, start]: [&str; 2], body: &Body, angle: &Real) -> Problem {
    let fall = Fall::random(&mut setup, body);
    let size = if setup.draw.chance(0.2) { 1.0 } else { setup.draw.between(RESTITUTION[0], RESTITUTION[1]) };
    let restitution = setup.given("e", size, NUMBER);
    let (friction, rough) = friction(&mut setup, FRICTION);
    let law = setup.draw.pick(&["poisson", "stronge"]);
    fall.write(
        &mut setup,
        [shape, start],
        &format!("restitution = \"{restitution}\", {rough}, law = \"{law}\""),
    );
    let [rx, ry] = &body.arm;
    let reach = |a: &Real, b: &Real| a * b / &body.gyration;
    let impact = Impact {
        response: [1 + reach(ry, ry), -reach(rx, ry), 1 + reach(rx, rx)],
        velocity: [&fall.velocity[0].value - &body.spin * ry, &body.spin * rx - &fall.down],
        friction,
        restitution: restitution.value.clone(),
        is_of_work: law == "stronge",
    };
    // Of a unit of mass.
    let [along, out] = impact.impulse();
    let turning = &body.spin + (rx * &out - ry * &along) / &body.gyration;
    let after = Flight {
        rates: [&fall.velocity[0].value + &along, &out - &fall.down, turning],
        place: [&fall.velocity[0].value * &fall.hit, -ry],
        angle: angle + &body.spin * &fall.hit,
        gravity: fall.gravity.value.clone(),
    };
    let until = after.until(&mut setup, &fall.hit, body);
    ask_impact(&mut setup, &fall, [&along, &out], &after, body);
    ask_end(&mut setup, &fall, &after, &(&until.value - &fall.hit));
    setup.problem(&fall.gravity.word, &until)
}

/// Before the impact.
struct Fall {
    mass: Given,
    gravity: Given,
    foot: [Given; 2],
    height: Given,
    velocity: [Given; 2],
    /// When it strikes, and the speed of its centre downwards then.
    hit: Real,
    down: Real,
}

impl Fall {
    fn random(setup: &mut Setup, body: &Body) -> Self {
        let (mass, gravity) = (setup.given("mass", 1.0, MASS), setup.given("g", 1.0, ACCELERATION));
        let foot = ["foot_x", "foot_y"].map(|name| setup.shift(name));
        let least = -body.arm[1].to_f64() / setup.units.size(LENGTH);
        let above = |draw: &mut Draw| [least + draw.log_between(0.02, 3.0)];
        let is_above = |[height]: [&Real; 1]| (height + &body.arm[1]).sign() > 0;
        let [height] = setup.fit_all(["height"], LENGTH, above, is_above);
        let speeds = [0; 2].map(|_| setup.draw.between(-2.0, 2.0));
        let velocity =
            [("vx", speeds[0]), ("vy", speeds[1])].map(|(name, size)| setup.given(name, size, SPEED));
        let (gap, rate, pull) = (&height.value + &body.arm[1], &velocity[1].value, &gravity.value);
        let down = (rate.squared() + pull * &gap * 2).sqrt();
        // Both are the same: each is used where it is no difference of what may be nearly equal.
        let hit = if rate.sign() > 0 { (rate + &down) / pull } else { &gap * 2 / (&down - rate) };
        Self { mass, gravity, foot, height, velocity, hit, down }
    }

    fn write(&self, setup: &mut Setup, [shape, start]: [&str; 2], rigid: &str) {
        let Self { mass, foot: [x, y], height, velocity: [vx, vy], .. } = self;
        setup.write(&format!(
            "[body.p]
            {shape}
            mass = \"{mass}\"
            [body.p.start]
            at = [\"{x}\", \"{y} + {height}\"]
            velocity = [\"{vx}\", \"{vy}\"]
            {start}
            [surface.floor]
            through = [\"{x}\", \"{y}\"]
            rigid = {{ {rigid} }}"
        ));
    }
}

/// After the impact, from where the body was at first along the floor and from the floor upwards.
struct Flight {
    /// vx, vy, omega
    rates: [Real; 3],
    place: [Real; 2],
    angle: Real,
    gravity: Real,
}

impl Flight {
    fn at(&self, time: &Real) -> [Real; 3] {
        let [vx, vy, omega] = &self.rates;
        let [x, y] = &self.place;
        [x + vx * time, y + vy * time - &self.gravity * time.squared() / 2, &self.angle + omega * time]
    }

    /// The lowest gap of the body.
    fn gap(&self, body: &Body, time: &Real) -> f64 {
        let [_, y, angle] = self.at(time);
        let (y, sine) = (y.to_f64(), angle.sin().to_f64());
        let ends = body.ends.iter().map(|end| y + end.to_f64() * sine);
        ends.reduce(f64::min).unwrap_or(y + body.arm[1].to_f64())
    }

    /// An end before which nothing strikes again.
    fn until(&self, setup: &mut Setup, hit: &Real, body: &Body) -> Given {
        let is_clear = |until: &Real| {
            let late = until - hit;
            let mut places = (1..=PLACES).map(|place| &late * place / PLACES);
            late.sign() > 0 && places.all(|time| self.gap(body, &time) > 0.0)
        };
        let first = hit.to_f64();
        let found = setup.time("until", |draw| first * (1.0 + draw.log_between(SHORTEST, 1.0)), is_clear);
        found.expect("a flight after the impact")
    }
}

fn ask_impact(setup: &mut Setup, fall: &Fall, [along, out]: [&Real; 2], after: &Flight, body: &Body) {
    const INSTANT: &str = "floor.contact[1].start";
    setup.ask_time(INSTANT, &fall.hit);
    let (speed, reach) = (fall.down.to_f64(), body.gyration.sqrt().to_f64());
    for (that, rate, (size, measure)) in
        [("p.vx", 0, (speed, SPEED)), ("p.vy", 1, (speed, SPEED)), ("p.omega", 2, (speed / reach, RATE))]
    {
        setup.ask_beside(that, At::After(INSTANT.into()), (&after.rates[rate], size), measure);
    }
    for (that, part) in [("floor.contact[1].impulse.x", along), ("floor.contact[1].impulse.y", out)] {
        let impulse = part * &fall.mass.value;
        setup.ask_beside(that, At::End, (&impulse, (out * &fall.mass.value).to_f64()), MOMENTUM);
    }
}

fn ask_end(setup: &mut Setup, fall: &Fall, after: &Flight, time: &Real) {
    let [x, y, angle] = after.at(time);
    let [foot_x, foot_y] = fall.foot.each_ref().map(|part| &part.value);
    setup.ask("p.x", At::End, &(x + foot_x), LENGTH);
    setup.ask("p.y", At::End, &(y + foot_y), LENGTH);
    setup.ask_beside("p.angle", At::End, (&angle, 1.0), NUMBER);
    let vy = &after.rates[1] - &after.gravity * time;
    setup.ask("p.vy", At::End, &vy, SPEED);
}
