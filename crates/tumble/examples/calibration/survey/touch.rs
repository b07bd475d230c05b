//! One contact with something compliant, along one line.

use super::oscillator::{Oscillator, State};
use super::quadrature::{integral, root};
use super::real::Real;

/// What falls from a height: when it touches, and how fast.
#[derive(Clone, Debug)]
pub(crate) struct Fall {
    pub(crate) time: Real,
    pub(crate) speed: Real,
}

impl Fall {
    /// With the rate of the height at first.
    pub(crate) fn new(gravity: &Real, height: &Real, rate: &Real) -> Self {
        let speed = (rate.squared() + gravity * height * 2).sqrt();
        Self { time: height * 2 / (&speed - rate), speed }
    }
}

/// How long it lasts, how deep it is, and the speed after it.
#[derive(Clone, Debug)]
pub(crate) struct Touch {
    pub(crate) duration: Real,
    pub(crate) depth: Real,
    pub(crate) after: Real,
}

impl Touch {
    /// Under its weight on a spring without damping.
    pub(crate) fn heavy(fall: &Fall, gravity: &Real, frequency: &Real) -> Self {
        let v = &fall.speed;
        let duration = (Real::pi() - (v * frequency / gravity).atan()) * 2 / frequency;
        let rest = gravity / frequency.squared();
        let depth = &rest + (rest.squared() + (v / frequency).squared()).sqrt();
        Self { duration, depth, after: v.clone() }
    }

    /// Without weight, by the frequency without damping and half the damping for each kilogram.
    pub(crate) fn damped(speed: &Real, [frequency, half]: [&Real; 2], at_zero_force: bool) -> Self {
        let swing = (frequency.squared() - half.squared()).sqrt();
        let system = Oscillator { stiffness: frequency.squared(), damping: half * 2 };
        let start = State { x: Real::zero(), v: speed.clone() };
        let turn = swing.atan2(half) / &swing;
        let duration = match at_zero_force {
            false => Real::pi() / &swing,
            // Of the angles with this tangent the one from 0 to pi.
            true => (half * &swing * 2).atan2(&(half.squared() * 2 - frequency.squared())) / &swing,
        };
        let after = -system.free(&start, &duration).v;
        Self { depth: system.free(&start, &turn).x, duration, after }
    }
}

/// What a compliant contact without weight does to a mass of one.
#[derive(Clone, Debug)]
pub(crate) enum Law {
    /// Frequency without damping and half the damping; it lets go at zero force.
    Spring([Real; 2]),
    /// After Hertz.
    Hertz(Hertz),
}

impl Law {
    /// The contact that begins with this speed.
    pub(crate) fn touch(&self, speed: &Real) -> Touch {
        match self {
            Self::Spring([frequency, half]) => Touch::damped(speed, [frequency, half], true),
            Self::Hertz(law) => law.touch(speed),
        }
    }

    /// When of this speed at first only `left` is, upwards if negative, and how deep it is then; it is before the end.
    pub(crate) fn reaches(&self, speed: &Real, left: &Real) -> (Real, Real) {
        match self {
            Self::Hertz(law) => (law.time(speed, [left, speed]), law.stretch(speed, left).power_of([2, 5])),
            Self::Spring([frequency, half]) => {
                let system = Oscillator { stiffness: frequency.squared(), damping: half * 2 };
                let start = State { x: Real::zero(), v: speed.clone() };
                let end = self.touch(speed).duration;
                let time = root(|time| left - system.free(&start, time).v, [&Real::zero(), &end]);
                let depth = system.free(&start, &time).x;
                (time, depth)
            }
        }
    }
}

/// d'' = -stiffness d^(3/2) (1 + damping d').
///
/// Without weight dv/dd = -k d^(3/2) (1 + c v)/v is integrated at once: with F(v) = v/c - ln(1 + c v)/c^2, without damping v^2/2, the depth is
/// ((5/(2 k)) (F(v_0) - F(v)))^(2/5), and it parts with the other speed of that F.
#[derive(Clone, Debug)]
pub(crate) struct Hertz {
    /// For each kilogram, m^(-1/2)/s^2.
    pub(crate) stiffness: Real,
    /// s/m
    pub(crate) damping: Real,
}

impl Hertz {
    /// Without weight.
    fn touch(&self, speed: &Real) -> Touch {
        let after = self.leaves(speed);
        let duration = self.time(speed, [&-&after, speed]);
        Touch { duration, depth: self.stretch(speed, &Real::zero()).power_of([2, 5]), after }
    }

    /// Without damping, under its weight: v^2 = v_0^2 + 2 g d - (4/5) k d^(5/2) up to the greatest depth and back.
    pub(crate) fn heavy(&self, speed: &Real, gravity: &Real) -> Touch {
        let square =
            |d: &Real| speed.squared() + gravity * d * 2 - &self.stiffness * d.squared() * d.sqrt() * 4 / 5;
        let mut most = self.stretch(speed, &Real::zero()).power_of([2, 5]);
        while square(&most).sign() >= 0 {
            most = most * 2;
        }
        // From where the weight is borne on the square falls.
        let rest = (gravity / &self.stiffness).power_of([2, 3]);
        let depth = root(|d| -square(d), [&rest, &most]);
        let down = integral(|[from, _]| 1 / square(&from).sqrt(), [&Real::zero(), &depth]);
        Touch { duration: down * 2, depth, after: speed.clone() }
    }

    /// The depth to the power of 5/2 at a velocity.
    fn stretch(&self, first: &Real, now: &Real) -> Real {
        (self.taken(first) - self.taken(now)) * 5 / 2 / &self.stiffness
    }

    /// F
    fn taken(&self, v: &Real) -> Real {
        let c = &self.damping;
        if c.is_zero() { v.squared() / 2 } else { (v - (1 + c * v).ln() / c) / c }
    }

    fn leaves(&self, speed: &Real) -> Real {
        if self.damping.is_zero() {
            return speed.clone();
        }
        // It is slower than before, and than 1/c.
        let limit = 1 / &self.damping;
        let most = if *speed < limit { speed } else { &limit };
        root(|left| -self.stretch(speed, &-left), [&Real::zero(), most])
    }

    /// The time between two velocities: dt = dv/(k d^(3/2) (1 + c v)).
    fn time(&self, first: &Real, [low, high]: [&Real; 2]) -> Real {
        let slowness = |[from, _]: [Real; 2]| {
            let v = low + from;
            let force = &self.stiffness * self.stretch(first, &v).power_of([3, 5]);
            1 / (force * (1 + &self.damping * &v))
        };
        integral(slowness, [low, high])
    }
}
