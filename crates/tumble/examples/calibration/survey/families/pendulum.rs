//! Pendulums, from small swings to turns over the top.
//!
//! # Law
//!
//! theta'' = -w^2 sin theta, with w^2 = M g d/I, d the distance of the centre of mass from the pivot and I the moment of
//! inertia about it.
//!
//! # Closed form
//!
//! With k^2 = sin^2(theta0/2) + (omega0/(2 w))^2 below one it swings: sin(theta/2) = k sn(w t + u0, k) and
//! omega = 2 w k cn. Above one it turns: theta = 2 am(k w t + u0, 1/k) and omega = 2 w k dn, in the direction of omega0.
//!
//! # Source
//!
//! Whittaker, A Treatise on the Analytical Dynamics of Particles and Rigid Bodies, § 44.

use super::super::elliptic::Elliptic;
use super::super::real::Real;
use super::super::setup::{At, Given, Problem, Setup};
use super::super::units::{ACCELERATION, LENGTH, MASS, NUMBER, RATE, SPEED, TIME};

/// Radians of small swings in a run.
const PHASES: [f64; 2] = [1.0, 60.0];
/// How far from the top a swing begins, rad.
const NEAR_TOP: [f64; 2] = [1e-4, 0.5];

/// Shapes that swing.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Rod,
    Disk,
    Point,
}

pub(super) fn make(mut setup: Setup) -> Problem {
    let shape = setup.draw.pick(&[Shape::Rod, Shape::Disk, Shape::Point]);
    let [mass, length, gravity] = [("mass", MASS), ("arm", LENGTH), ("g", ACCELERATION)]
        .map(|(name, measure)| setup.given(name, 1.0, measure));
    let (body, square) = shape.body(&mut setup, &length, &gravity);
    let frequency = square.sqrt();
    let phases = setup.draw.log_between(PHASES[0], PHASES[1]);
    let size = 1.0 / frequency.to_f64() / setup.units.size(TIME);
    let until = setup.given("until", phases * size, TIME);
    let (angle, omega) = start(&mut setup, 1.0 / size);
    let place = ["pivot_x", "pivot_y"].map(|name| setup.shift(name));
    setup.write(&format!(
        "[body.p]
        {body}
        mass = \"{mass}\"
        start = {{ angle = \"{angle}\", omega = \"{omega}\" }}
        [pivot.hinge]
        body = \"p\"
        point = [0, 0]
        world = [\"{}\", \"{}\"]
        [event.vertical]
        when = \"sin(p.angle) passes through 0\"
        [event.back]
        when = \"p.omega falls through 0 rad/s\"",
        place[0], place[1]
    ));
    let swing = Swing::new(&frequency, &angle.value, &omega.value);
    ask(&mut setup, &swing, &until);
    ask_tip(&mut setup, &swing, (&length, &place), &until);
    ask_turns(&mut setup, &swing, &until);
    setup.problem(&gravity.word.clone(), &until)
}

impl Shape {
    /// Lines of the body, which hangs down at angle zero, and the square of its frequency.
    fn body(self, setup: &mut Setup, length: &Given, gravity: &Given) -> (String, Real) {
        let (g, l) = (&gravity.value, &length.value);
        let tip = format!("points.tip = [0, \"-{length}\"]");
        match self {
            Self::Rod => {
                (format!("rod = {{ from = [0, 0], to = [0, \"-{length}\"] }}\n{tip}"), g / l * 3 / 2)
            }
            Self::Disk => {
                let size = setup.draw.log_between(0.1, 0.9);
                let radius = setup.given("radius", size, LENGTH);
                let lines = format!("disk = {{ centre = [0, \"-{length}\"], radius = \"{radius}\" }}\n{tip}");
                (lines, g * l / (l.squared() + radius.value.squared() / 2))
            }
            Self::Point => (format!("point = {{ at = [0, \"-{length}\"] }}\n{tip}"), g / l),
        }
    }
}

/// Small swings, wide ones, nearly to the top, and turns.
fn start(setup: &mut Setup, frequency: f64) -> (Given, Given) {
    let side = setup.draw.sign();
    let (angle, omega) = match setup.draw.whole(0, 4) {
        0 => (setup.draw.log_between(1e-3, 0.3), 0.0),
        1 => (setup.draw.between(0.3, 3.0), 0.0),
        2 => (std::f64::consts::PI - setup.draw.log_between(NEAR_TOP[0], NEAR_TOP[1]), 0.0),
        3 => (setup.draw.between(0.1, 1.5), setup.draw.between(-1.0, 1.0)),
        _ => (setup.draw.between(0.1, 1.5), setup.draw.sign() * setup.draw.between(1.8, 4.0)),
    };
    let top = Real::pi() - Real::of(NEAR_TOP[0]) / 2;
    let found = setup.fit_angle("start_angle", |_| side * angle, |angle| angle.abs() < top);
    let angle = found.unwrap_or_else(|| setup.angle("start_angle", side));
    (angle, setup.omega("start_omega", omega * frequency))
}

fn ask(setup: &mut Setup, swing: &Swing, until: &Given) {
    let then = setup.moment("then", until);
    for (at, time) in [(At::End, until), (At::After(then.word.clone()), &then)] {
        let [angle, omega] = swing.at(&time.value);
        setup.ask("p.angle", at.clone(), &angle, NUMBER);
        setup.ask("p.omega", at, &omega, RATE);
    }
}

fn ask_tip(setup: &mut Setup, swing: &Swing, (length, place): (&Given, &[Given; 2]), until: &Given) {
    let [angle, omega] = swing.at(&until.value);
    let arm = [angle.sin(), -angle.cos()].map(|part| part * &length.value);
    setup.ask("p.tip.x", At::End, &(&place[0].value + &arm[0]), LENGTH);
    setup.ask("p.tip.y", At::End, &(&place[1].value + &arm[1]), LENGTH);
    setup.ask("p.tip.vx", At::End, &-(omega * &arm[1]), SPEED);
}

/// Passings of the vertical, and where it turns back.
fn ask_turns(setup: &mut Setup, swing: &Swing, until: &Given) {
    let passings = swing.times([0, if swing.swings() { 2 } else { 1 }], &until.value);
    if let Some((instant, time)) = one(setup, "vertical", &passings) {
        setup.ask_time(&instant, time);
        setup.ask("p.omega", At::After(instant), &swing.at(time)[1], RATE);
    }
    if !swing.swings() {
        return;
    }
    let turns = swing.times([1, 4], &until.value);
    if let Some((instant, time)) = one(setup, "back", &turns) {
        setup.ask_time(&instant, time);
        setup.ask("p.angle", At::After(instant), &swing.widest(), NUMBER);
        setup.ask("p.angle", At::Greatest(None), &swing.widest(), NUMBER);
    }
    if !swing.times([0, 4], &until.value).is_empty() {
        setup.ask("p.omega", At::Greatest(None), &swing.fastest(), RATE);
    }
}

/// One of the instants of an event, with its name.
fn one<'t>(setup: &mut Setup, event: &str, times: &'t [Real]) -> Option<(String, &'t Real)> {
    let count = setup.draw.whole(1, times.len().max(1));
    Some((format!("{event}[{count}]"), times.get(count - 1)?))
}

/// A pendulum in motion.
struct Swing {
    frequency: Real,
    /// k, which is above one where it turns over.
    modulus: Real,
    functions: Elliptic,
    /// u0
    start: Real,
    direction: i64,
}

impl Swing {
    fn new(frequency: &Real, angle: &Real, omega: &Real) -> Self {
        let half = angle / 2;
        let rate = omega / frequency / 2;
        let modulus = (half.sin().squared() + rate.squared()).sqrt();
        let complement = half.cos().squared() - rate.squared();
        let swings = complement.sign() > 0;
        let (functions, direction) = if swings {
            (Elliptic::new(modulus.clone(), complement.sqrt()), 1)
        } else {
            (Elliptic::new(1 / &modulus, complement.abs().sqrt() / &modulus), rate.sign())
        };
        let amplitude = if swings { half.sin().atan2(&rate) } else { half * direction };
        let start = functions.argument(&amplitude);
        Self { frequency: frequency.clone(), modulus, functions, start, direction }
    }

    fn swings(&self) -> bool {
        self.modulus < Real::from(1)
    }

    /// Angle and rate.
    fn at(&self, time: &Real) -> [Real; 2] {
        let rate = &self.frequency * &self.modulus * 2;
        if self.swings() {
            let values = self.functions.at(&(&self.start + self.pace() * time));
            let angle = (&self.modulus * &values.sn).atan2(&values.dn) * 2;
            return [angle, rate * values.cn];
        }
        let values = self.functions.at(&(&self.start + self.pace() * time));
        [values.amplitude * 2 * self.direction, rate * values.dn * self.direction]
    }

    /// The argument of the functions grows by this in each second.
    fn pace(&self) -> Real {
        if self.swings() { self.frequency.clone() } else { &self.frequency * &self.modulus }
    }

    /// When the argument comes to so many quarters and all further ones by a step, after the start and up to a time.
    fn times(&self, [first, step]: [i64; 2], until: &Real) -> Vec<Real> {
        let (quarter, pace) = (self.functions.quarter(), self.pace());
        let soon = until * Real::read("1e-30");
        let begun = (&self.start / &quarter).round().to_f64() as i64;
        let from = begun - (begun - first).rem_euclid(step) - step;
        let all = (0..).map(|count| (&quarter * (from + step * count) - &self.start) / &pace);
        all.skip_while(|time| *time <= soon).take_while(|time| time < until).collect()
    }

    /// The angle at which it turns back.
    fn widest(&self) -> Real {
        self.modulus.asin() * 2
    }

    fn fastest(&self) -> Real {
        &self.frequency * &self.modulus * 2
    }
}
