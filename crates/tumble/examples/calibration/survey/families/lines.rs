//! Resistance of the air along rods and edges, and on what falls in it.
//!
//! # Law
//!
//! The force on each metre is b u + c |u| u, with u = -velocity of the material in still air. A body that turns about its
//! centre, or about the end that it is held at, has I omega' = -B omega - C omega |omega|, with B and C the sums of
//! b s^2 and c s^3, s the distance from the axis; where only the component across an edge counts, s is the one along it.
//!
//! # Closed form
//!
//! omega = B omega0 e/(B + C omega0 (1 - e)) with e = exp(-B t/I), and an angle I/C ln(1 + C omega0 (1 - e)/B). An edge from
//! -a to a in the distance h has the sum 2 (a (2 a^2 + 5 h^2) sqrt(h^2 + a^2)/8 + 3 h^4/8 asinh(a/h)) of s^3. What falls
//! with m v' = m g - k v^2 has v = w tanh(g t/w + artanh(v0/w)), and the tangent on its way up, with w^2 = m g/k.
//!
//! # Source
//!
//! Integrals of rational and hyperbolic functions, done by hand.

use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, ENERGY, LENGTH, MASS, Measure, NUMBER, RATE, SPEED, TIME};

/// What a rod of this length and mass has of either resistance, in its own size.
const STRENGTHS: [f64; 2] = [0.03, 3.0];
/// Angles turned without resistance, rad.
const ANGLES: [f64; 2] = [0.3, 60.0];
/// kg/(m s) and kg/m^2, for each metre.
const LINEAR: Measure = Measure([-1, -1, 1]);
const QUADRATIC: Measure = Measure([-2, 0, 1]);
/// kg/m, at a point.
const AT_POINT: Measure = Measure([-1, 0, 1]);

/// A rod or a box that turns in its place.
pub(super) fn spin(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let component = setup.draw.pick(&["full", "normal"]);
    let shape = Shape::random(&mut setup, component == "normal");
    let turn = setup.draw.sign() * setup.draw.log_between(0.3, 3.0);
    let omega = setup.omega("omega", turn);
    let strengths = strengths(&mut setup);
    let linear = setup.given("linear", strengths[0], LINEAR);
    let quadratic = setup.given("quadratic", strengths[1], QUADRATIC);
    let length = setup.draw.log_between(ANGLES[0], ANGLES[1]) / turn.abs();
    let until = setup.given("until", length, TIME);
    let place = ["x", "y"].map(|name| setup.shift(name));
    shape.write(&mut setup, &mass, &omega, &place);
    setup.write(&format!(
        "[drag.air]
        along = \"p\"
        component = \"{component}\"
        linear = \"{linear}\"
        quadratic = \"{quadratic}\""
    ));
    let inertia = &mass.value * &shape.inertia;
    let spin = Spin {
        linear: &linear.value * &shape.sums[0] / &inertia,
        quadratic: &quadratic.value * &shape.sums[1] / &inertia,
        omega: omega.value,
    };
    ask_spin(&mut setup, &spin, &inertia, &until);
    setup.problem("0 m/s^2", &until)
}

/// Of linear and quadratic resistance one or both.
fn strengths(setup: &mut Setup) -> [f64; 2] {
    let mut size = || setup.draw.log_between(STRENGTHS[0], STRENGTHS[1]);
    let [linear, quadratic] = [size(), size()];
    match setup.draw.whole(0, 3) {
        0 => [linear, 0.0],
        1 => [linear, quadratic],
        _ => [0.0, quadratic],
    }
}

fn ask_spin(setup: &mut Setup, spin: &Spin, inertia: &Real, until: &Given) {
    let then = setup.moment("then", until);
    for (at, time) in [(At::End, until), (At::After(then.word.clone()), &then)] {
        let [angle, omega] = spin.at(&time.value);
        setup.ask("p.angle", at.clone(), &angle, NUMBER);
        setup.ask("p.omega", at, &omega, RATE);
    }
    let energy = |omega: &Real| inertia * omega.squared() / 2;
    let [_, omega] = spin.at(&until.value);
    setup.ask("air.work", At::End, &(energy(&omega) - energy(&spin.omega)), ENERGY);
}

/// omega' = -linear omega - quadratic omega |omega|
struct Spin {
    linear: Real,
    quadratic: Real,
    omega: Real,
}

impl Spin {
    /// Angle and rate.
    fn at(&self, time: &Real) -> [Real; 2] {
        let Self { linear, quadratic, omega } = self;
        let fading = (-(linear * time)).exp();
        // (1 - exp(-B t))/B
        let lasting = if linear.is_zero() { time.clone() } else { (1 - &fading) / linear };
        let loss = quadratic * omega.abs() * &lasting + 1;
        let angle = if quadratic.is_zero() { omega * lasting } else { loss.ln() / quadratic * omega.sign() };
        [angle, omega * fading / loss]
    }
}

/// What turns: its lines in the scene and sums over its edges.
struct Shape {
    lines: String,
    is_held: bool,
    /// About the axis, for a mass of one.
    inertia: Real,
    /// Of s^2 and of s^3.
    sums: [Real; 2],
}

impl Shape {
    fn random(setup: &mut Setup, across: bool) -> Self {
        let length = setup.given("length", 1.0, LENGTH);
        match setup.draw.whole(0, 2) {
            0 => Self::rod(&length),
            1 => Self::held(&length),
            _ => {
                let height = setup.draw.log_between(0.1, 1.5);
                let height = setup.given("height", height, LENGTH);
                Self::boxed(&length, &height, across)
            }
        }
    }

    fn rod(length: &Given) -> Self {
        let half = &length.value / 2;
        Self {
            lines: format!("rod = {{ from = [0, 0], to = [\"{length}\", 0] }}"),
            is_held: false,
            inertia: length.value.squared() / 12,
            sums: [half.power(3) * 2 / 3, half.power(4) / 2],
        }
    }

    fn held(length: &Given) -> Self {
        let whole = &length.value;
        Self {
            is_held: true,
            inertia: whole.squared() / 3,
            sums: [whole.power(3) / 3, whole.power(4) / 4],
            ..Self::rod(length)
        }
    }

    fn boxed(width: &Given, height: &Given, across: bool) -> Self {
        let halves = [width, height].map(|side| &side.value / 2);
        let edges = [[&halves[0], &halves[1]], [&halves[1], &halves[0]]];
        let none = Real::zero();
        let edges = edges.map(|[half, distance]| edge(half, if across { &none } else { distance }));
        Self {
            lines: format!("box = {{ width = \"{width}\", height = \"{height}\" }}"),
            is_held: false,
            inertia: (width.value.squared() + height.value.squared()) / 12,
            sums: [0, 1].map(|power| (&edges[0][power] + &edges[1][power]) * 2),
        }
    }

    fn write(&self, setup: &mut Setup, mass: &Given, omega: &Given, [x, y]: &[Given; 2]) {
        let at = if self.is_held { String::new() } else { format!("at = [\"{x}\", \"{y}\"], ") };
        setup.write(&format!(
            "[body.p]
            {}
            mass = \"{mass}\"
            start = {{ {at}omega = \"{omega}\" }}",
            self.lines
        ));
        if self.is_held {
            setup.write(&format!(
                "[pivot.hinge]
                body = \"p\"
                point = [0, 0]
                world = [\"{x}\", \"{y}\"]"
            ));
        }
    }
}

/// Sums of s^2 and s^3 over an edge from -half to half in a distance from the axis.
fn edge(half: &Real, distance: &Real) -> [Real; 2] {
    let (a, h) = (half.squared(), distance.squared());
    let square = (&a / 3 + &h) * half * 2;
    if distance.is_zero() {
        return [square, a.squared() / 2];
    }
    let root = (&a + &h).sqrt();
    let cube = half * (&a * 2 + &h * 5) * root / 8 + h.squared() * 3 / 8 * (half / distance).asinh();
    [square, cube * 2]
}

/// A body that falls, or is thrown up, in the air: a ball, a point, or a rod that stays level.
pub(super) fn fall(mut setup: Setup) -> Problem {
    let mass = setup.given("mass", 1.0, MASS);
    let gravity = setup.given("g", 1.0, ACCELERATION);
    let (lines, drag, coefficient) = falling(&mut setup);
    let [x, y] = ["x", "y"].map(|name| setup.shift(name));
    let fast = (&mass.value * &gravity.value / &coefficient).sqrt();
    // Written with one digit, a speed grows by a third at most: none falls faster than it can end.
    let part = setup.draw.pick(&[0.0, 1.0, 1.0]) * setup.draw.between(-0.7, 2.0);
    let speed = setup.near("speed", &(&fast * Real::of(part)), SPEED);
    let length = Real::of(setup.draw.log_between(0.3, 10.0)) * &fast / &gravity.value;
    let until = setup.near("until", &length, TIME);
    setup.write(&format!(
        "[body.p]
        {lines}
        mass = \"{mass}\"
        start = {{ at = [\"{x}\", \"{y}\"], velocity = [0, \"{speed}\"] }}
        [drag.air]
        {drag}"
    ));
    let fall = Fall { gravity: gravity.value.clone(), fast, speed: speed.value };
    ask_fall(&mut setup, &fall, (&mass, &y), &until);
    setup.problem(&gravity.word, &until)
}

/// Lines of the shape and of its resistance, and k.
fn falling(setup: &mut Setup) -> (String, String, Real) {
    let strength = setup.draw.log_between(STRENGTHS[0], STRENGTHS[1]);
    let size = setup.given("size", 1.0, LENGTH);
    match setup.draw.whole(0, 2) {
        0 => {
            let c = setup.given("quadratic", strength, AT_POINT);
            ("point = {}".into(), format!("at = \"p.cm\"\nquadratic = \"{c}\""), c.value)
        }
        1 => {
            let c = setup.given("quadratic", strength, QUADRATIC);
            let lines = format!("rod = {{ from = [0, 0], to = [\"{size}\", 0] }}");
            (lines, format!("along = \"p\"\nquadratic = \"{c}\""), c.value * size.value)
        }
        _ => {
            let density = setup.given("density", strength, Measure([-3, 0, 1]));
            let factor = setup.given("coefficient", 0.47, NUMBER);
            let drag = format!("on = \"p\"\ndensity = \"{density}\"\ncoefficient = \"{factor}\"");
            let area = Real::pi() * size.value.squared();
            (format!("ball = {{ radius = \"{size}\" }}"), drag, density.value * factor.value * area / 2)
        }
    }
}

fn ask_fall(setup: &mut Setup, fall: &Fall, (mass, y): (&Given, &Given), until: &Given) {
    let then = setup.moment("then", until);
    for (at, time) in [(At::End, until), (At::After(then.word.clone()), &then)] {
        let [way, speed] = fall.at(&time.value);
        setup.ask("p.y", at.clone(), &(way + &y.value), LENGTH);
        setup.ask("p.vy", at, &speed, SPEED);
    }
    let [way, speed] = fall.at(&until.value);
    let energy = |speed: &Real| &mass.value * speed.squared() / 2;
    let lost = energy(&speed) - energy(&fall.speed) + &mass.value * &fall.gravity * way;
    setup.ask("air.work", At::End, &lost, ENERGY);
    setup.ask("p.angle", At::End, &Real::zero(), NUMBER);
    let top = fall.top();
    if fall.speed.sign() > 0 && top < until.value {
        setup.ask("p.y", At::Greatest(None), &(fall.at(&top)[0].clone() + &y.value), LENGTH);
    }
}

struct Fall {
    gravity: Real,
    /// The speed at which resistance carries the weight.
    fast: Real,
    /// Upwards, at the start.
    speed: Real,
}

impl Fall {
    fn top(&self) -> Real {
        (&self.speed / &self.fast).atan() * &self.fast / &self.gravity
    }

    /// Way and velocity, upwards.
    fn at(&self, time: &Real) -> [Real; 2] {
        let [scale, unit] = [self.fast.squared() / &self.gravity, &self.fast / &self.gravity];
        if self.speed.sign() <= 0 {
            let before = (-&self.speed / &self.fast).atanh();
            let now = &before + time / &unit;
            return [(before.cosh() / now.cosh()).ln() * scale, -(now.tanh() * &self.fast)];
        }
        let before = (&self.speed / &self.fast).atan();
        let now = &before - time / &unit;
        if now.sign() >= 0 {
            return [(now.cos() / before.cos()).ln() * scale, now.tan() * &self.fast];
        }
        [-(before.cos().ln() + now.cosh().ln()) * scale, now.tanh() * &self.fast]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Way and rate differ by as much as the rate and the law say, to the square of a step.
    fn obeys(at: impl Fn(&Real) -> [Real; 2], law: impl Fn(&Real) -> Real) {
        let (time, step) = (Real::read("0.7"), Real::read("1e-20"));
        let [[x0, v0], [x1, v1]] = [&time - &step, &time + &step].map(|time| at(&time));
        let [_, v] = at(&time);
        let small = Real::read("1e-35");
        assert!(((x1 - x0) / (&step * 2) - &v).abs() < small);
        assert!(((v1 - v0) / (step * 2) - law(&v)).abs() < small);
        assert!(at(&Real::zero())[0].abs() < small);
    }

    #[test]
    fn spins_obey_their_law() {
        for [linear, quadratic, omega] in [["0.3", "0", "2"], ["0", "0.4", "-3"], ["0.3", "0.4", "-3"]] {
            let [linear, quadratic, omega] = [linear, quadratic, omega].map(Real::read);
            let law = |w: &Real| -(&linear * w) - &quadratic * w * w.abs();
            let spin = Spin { linear: linear.clone(), quadratic: quadratic.clone(), omega };
            obeys(|time| spin.at(time), law);
        }
    }

    #[test]
    fn falls_obey_their_law() {
        // Up, up and down again, down, and from rest.
        for speed in ["9", "3", "-2", "0"] {
            let [gravity, fast, speed] = ["10", "4", speed].map(Real::read);
            let law = |v: &Real| -(v * v.abs() / fast.squared() + 1) * &gravity;
            let fall = Fall { gravity: gravity.clone(), fast: fast.clone(), speed };
            obeys(|time| fall.at(time), law);
        }
    }

    #[test]
    fn edges_are_sums() {
        let (half, distance) = (Real::read("0.6"), Real::read("0.25"));
        let [square, cube] = edge(&half, &distance);
        // Simpson's rule on a thousand parts.
        let count = 1000;
        let sum = |power: i64| {
            let value = |part: i64| {
                let place = &half * (2 * part - count) / count;
                let weight = if part == 0 || part == count { 1 } else { 2 + 2 * (part % 2) };
                (place.squared() + distance.squared()).sqrt().power(power) * weight
            };
            (0..=count).map(value).fold(Real::zero(), |sum, part| sum + part) * &half * 2 / (3 * count)
        };
        assert!((square - sum(2)).abs() < Real::read("1e-12"));
        assert!((cube - sum(3)).abs() < Real::read("1e-12"));
    }
}
