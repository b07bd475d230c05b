//! Two round bodies with spin that meet off their centres, without weight.
//!
//! # Law
//!
//! Round bodies do not couple push and friction: e counts along the line of centres, and friction takes the slip, up to mu times the push.
//!
//! # Closed form
//!
//! They meet at the lesser root of |p + u t| = R1 + R2. With 1/m the sum of both 1/m_i, and 1/m + the sum of R_i^2/I_i along the rims, the
//! impulses are (1 + e) m u_n and the lesser of mu times that and what takes the slip.
//!
//! # Source
//!
//! Coriolis, Théorie mathématique des effets du jeu de billard, 1835.

use super::super::draw::Draw;
use super::super::ground::{Round, friction};
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{LENGTH, MASS, MOMENTUM, NUMBER, RATE, SPEED, TIME};

/// Coefficients of friction.
const FRICTION: [f64; 2] = [0.02, 1.2];
/// How far off its centre a body is met, in parts of both radii.
const ASIDE: f64 = 0.95;
/// Speeds of the rims, in the problem's own size.
const RIMS: f64 = 2.0;

/// A body with its scene's words and what it does.
struct One {
    round: Round,
    mass: Given,
    omega: Given,
    velocity: [Given; 2],
}

impl One {
    fn random(setup: &mut Setup, number: usize, speed: f64) -> Self {
        let round = Round::named(setup, &format!("radius{number}"));
        let size = setup.draw.log_between(0.1, 10.0);
        let mass = setup.given(&format!("mass{number}"), size, MASS);
        let rim = setup.draw.between(-RIMS, RIMS) * setup.units.size(LENGTH) / round.radius.near();
        let omega = setup.omega(&format!("omega{number}"), rim);
        let sizes = [speed + setup.draw.between(-0.3, 0.3), setup.draw.between(-0.3, 0.3)];
        let velocity = [("vx", sizes[0]), ("vy", sizes[1])]
            .map(|(name, size)| setup.given(&format!("{name}{number}"), size, SPEED));
        Self { round, mass, omega, velocity }
    }

    fn write(&self, setup: &mut Setup, name: &str, place: [String; 2]) {
        let Self { round, mass, omega, velocity: [vx, vy] } = self;
        let ([x, y], shape) = (place, round.shape());
        setup.write(&format!(
            "[body.{name}]
            {shape}
            mass = \"{mass}\"
            start = {{ at = [\"{x}\", \"{y}\"], velocity = [\"{vx}\", \"{vy}\"], omega = \"{omega}\" }}"
        ));
    }

    /// What a unit of impulse along the rim does to its slip beside the centre's part.
    fn about(&self) -> Real {
        1 / (&self.mass.value * &self.round.inertia)
    }
}

pub(super) fn make(mut setup: Setup) -> Problem {
    let [one, other] = [(1, 1.0), (2, 0.0)].map(|(number, speed)| One::random(&mut setup, number, speed));
    let at = ["at_x", "at_y"].map(|name| setup.shift(name));
    let reach = &one.round.radius.value + &other.round.radius.value;
    let rate = [0, 1].map(|axis| &one.velocity[axis].value - &other.velocity[axis].value);
    let place = before(&mut setup, &rate, &reach);
    one.write(&mut setup, "a", [0, 1].map(|axis| format!("{} + {}", at[axis], place[axis])));
    let place = place.map(|part| part.value);
    other.write(&mut setup, "b", [at[0].word.clone(), at[1].word.clone()]);
    let size = setup.draw.between(0.0, 1.0);
    let restitution = setup.given("e", size, NUMBER);
    let ([kinetic, _], rough) = friction(&mut setup, FRICTION);
    setup.write(&format!(
        "[contact.rims]
        between = [\"a\", \"b\"]
        rigid = {{ restitution = \"{restitution}\", {rough} }}"
    ));
    let hit = meets(&place, &rate, &reach);
    let normal = [0, 1].map(|axis| (&place[axis] + &rate[axis] * &hit) / &reach);
    let along = [normal[1].clone(), -&normal[0]];
    let closing = -dot(&rate, &normal);
    let rims = &one.omega.value * &one.round.radius.value + &other.omega.value * &other.round.radius.value;
    let slip = dot(&rate, &along) + rims;
    let out = 1 / &one.mass.value + 1 / &other.mass.value;
    let push = (1 + &restitution.value) * &closing / &out;
    let sticking = &slip / (&out + one.about() + other.about());
    let most = &kinetic * &push;
    let rub = -(if sticking.abs() < most { sticking } else { most * slip.sign() });
    let impulse = [0, 1].map(|axis| &normal[axis] * &push + &along[axis] * &rub);
    let size = setup.draw.between(1.6, 4.0);
    let until = setup.near("until", &(&hit * Real::of(size)), TIME);
    setup.ask_time("rims.contact[1].start", &hit);
    for (axis, part) in ["x", "y"].into_iter().zip(&impulse) {
        setup.ask(&format!("rims.contact[1].impulse.{axis}"), At::End, part, MOMENTUM);
    }
    let late = &until.value - &hit;
    let mut ask = |name: &str, body: &One, sign: i64, start: [Real; 2]| {
        let rates = [0, 1].map(|axis| &body.velocity[axis].value + &impulse[axis] * sign / &body.mass.value);
        let ends = [0, 1].map(|axis| &start[axis] + &body.velocity[axis].value * &hit + &rates[axis] * &late);
        for (axis, letter) in ["x", "y"].into_iter().enumerate() {
            setup.ask(&format!("{name}.v{letter}"), At::End, &rates[axis], SPEED);
            setup.ask(&format!("{name}.{letter}"), At::End, &(&at[axis].value + &ends[axis]), LENGTH);
        }
        let turned = &body.omega.value + &rub * body.about() / &body.round.radius.value;
        setup.ask(&format!("{name}.omega"), At::After("rims.contact[1].start".into()), &turned, RATE);
    };
    ask("a", &one, 1, place);
    ask("b", &other, -1, [Real::zero(), Real::zero()]);
    setup.problem("0 m/s^2", &until)
}

fn dot(a: &[Real; 2], b: &[Real; 2]) -> Real {
    &a[0] * &b[0] + &a[1] * &b[1]
}

/// A place from which one body comes to the other with that velocity, by the way and off its centre.
fn before(setup: &mut Setup, rate: &[Real; 2], reach: &Real) -> [Given; 2] {
    let (reach, size) = (reach.to_f64(), setup.units.size(LENGTH));
    let [vx, vy] = rate.each_ref().map(|part| part.to_f64());
    let speed = vx.hypot(vy);
    let drawn = |draw: &mut Draw| {
        let [way, aside] =
            [draw.log_between(1.5, 10.0), draw.between(-ASIDE, ASIDE)].map(|part| part * reach / speed);
        [(-way * vx - aside * vy) / size, (-way * vy + aside * vx) / size]
    };
    let clear = Real::of(reach).squared() * Real::read("1.1");
    setup.fit_all(["x", "y"], LENGTH, drawn, |[x, y]| {
        let place = [x.clone(), y.clone()];
        let off = (&place[0] * &rate[1] - &place[1] * &rate[0]).squared() / dot(rate, rate);
        // It begins apart, and does not graze.
        dot(&place, &place) > clear && off < Real::of(reach).squared() * Real::read("0.95")
    })
}

/// When the distance comes down to the reach.
fn meets(place: &[Real; 2], rate: &[Real; 2], reach: &Real) -> Real {
    let (square, half) = (dot(rate, rate), -dot(place, rate));
    let rest = dot(place, place) - reach.squared();
    let under = half.squared() - &square * &rest;
    rest / (half + under.sqrt())
}
