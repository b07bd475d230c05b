//! Something compliant of random stiffness, and what it does without weight.

use super::real::Real;
use super::setup::Setup;
use super::touch::{Hertz, Law};
use super::units::{DAMPING, FORCE, LENGTH, SLOWNESS, STIFFNESS};

/// Depths of contacts, in the problem's own size.
const DEPTHS: [f64; 2] = [1e-6, 0.1];
/// Damping in parts of the critical, ...
const DAMPINGS: [f64; 2] = [0.01, 0.7];
/// ... and Hunt and Crossley's, by the part by which it raises the force at first.
const RAISES: [f64; 2] = [0.01, 3.0];
/// Share of those without damping.
const UNDAMPED: f64 = 0.4;

/// What it is, in words of a scene, and what it does to a mass of one.
#[derive(Clone, Debug)]
pub(crate) struct Pad {
    key: &'static str,
    coefficients: String,
    pub(crate) law: Law,
}

impl Pad {
    /// Of either kind, for a mass and the speed with which it is met.
    pub(crate) fn random(setup: &mut Setup, mass: &Real, speed: &Real) -> Self {
        let is_damped = !setup.draw.chance(UNDAMPED);
        if setup.draw.chance(0.5) {
            Self::spring(setup, mass, speed, is_damped)
        } else {
            let (coefficients, law) = hertz(setup, mass, speed, is_damped);
            Self { key: "hertz", coefficients, law: Law::Hertz(law) }
        }
    }

    /// The line of a surface or of a contact, with what else is said of it.
    pub(crate) fn line(&self, more: &str) -> String {
        format!("{} = {{ {}{more} }}", self.key, self.coefficients)
    }

    fn spring(setup: &mut Setup, mass: &Real, speed: &Real, is_damped: bool) -> Self {
        let frequency = speed / depth(setup);
        let stiffness = setup.near("stiffness", &(mass * frequency.squared()), STIFFNESS);
        let frequency = (&stiffness.value / mass).sqrt();
        let part = if is_damped { setup.draw.log_between(DAMPINGS[0], DAMPINGS[1]) } else { 0.0 };
        let damping = setup.near("damping", &(mass * &frequency * 2 * Real::of(part)), DAMPING);
        let half = &damping.value / mass / 2;
        let coefficients = format!("stiffness = \"{stiffness}\", damping = \"{damping}\"");
        Self { key: "spring", coefficients, law: Law::Spring([frequency, half]) }
    }
}

/// Of a Hertzian one its coefficients, and what it does to a mass of one. Its stiffness is a force at a depth.
pub(crate) fn hertz(setup: &mut Setup, mass: &Real, speed: &Real, is_damped: bool) -> (String, Hertz) {
    let depth = depth(setup);
    let depth = setup.near("depth", &depth, LENGTH);
    let load = setup.near("load", &(mass * speed.squared() / &depth.value * 5 / 4), FORCE);
    let raise = if is_damped { setup.draw.log_between(RAISES[0], RAISES[1]) } else { 0.0 };
    let damping = setup.near("damping", &(Real::of(raise) / speed), SLOWNESS);
    let stiffness = &load.value / mass / &depth.value / depth.value.sqrt();
    let text = format!("stiffness = \"{load}/{depth}^(3/2)\", damping = \"{damping}\"");
    (text, Hertz { stiffness, damping: damping.value })
}

fn depth(setup: &mut Setup) -> Real {
    Real::of(setup.draw.log_between(DEPTHS[0], DEPTHS[1]) * setup.units.size(LENGTH))
}
