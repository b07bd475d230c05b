//! A ball that falls on a floor which gives way.

use super::setup::{At, Given, Setup};
use super::touch::{Fall, Touch};
use super::units::{LENGTH, MASS, SPEED, TIME};

/// Its first contact.
const FIRST: &str = "floor.contact[1]";

/// What is given of it.
pub(crate) struct Ball {
    pub(crate) mass: Given,
    pub(crate) height: Given,
    pub(crate) vy: Given,
    radius: Given,
    foot: Given,
    x: Given,
    vx: Given,
}

impl Ball {
    pub(crate) fn random(setup: &mut Setup) -> Self {
        let mass = setup.given("mass", 1.0, MASS);
        let radius = setup.given("radius", 0.1, LENGTH);
        let [foot, x] = ["foot", "x"].map(|name| setup.shift(name));
        let height = setup.draw.log_between(0.05, 3.0);
        let height = setup.given("height", height, LENGTH);
        let [vx, vy] = [("vx", 1.0), ("vy", -1.0)].map(|(name, size)| setup.given(name, size, SPEED));
        Self { mass, height, vy, radius, foot, x, vx }
    }

    /// Writes the ball and the floor, with what its law is.
    pub(crate) fn write(&self, setup: &mut Setup, law: &str) {
        let Self { mass, height, vy, radius, foot, x, vx } = self;
        setup.write(&format!(
            "[body.p]
        ball = {{ radius = \"{radius}\" }}
        mass = \"{mass}\"
        start = {{ at = [\"{x}\", \"{foot} + {radius} + {height}\"], velocity = [\"{vx}\", \"{vy}\"] }}
        [surface.floor]
        through = [0, \"{foot}\"]
        {law}"
        ));
    }

    pub(crate) fn ask_first(&self, setup: &mut Setup, fall: &Fall, touch: &Touch) {
        setup.ask(&format!("{FIRST}.start"), At::End, &fall.time, TIME);
        setup.ask(&format!("{FIRST}.duration"), At::End, &touch.duration, TIME);
        let end = &fall.time + &touch.duration;
        let instant = format!("{FIRST}.end");
        setup.ask_time(&instant, &end);
        setup.ask("p.vy", At::Before(format!("{FIRST}.start")), &-&fall.speed, SPEED);
        setup.ask("p.vy", At::After(instant.clone()), &touch.after, SPEED);
        setup.ask("p.x", At::After(instant), &(&self.x.value + &self.vx.value * end), LENGTH);
        setup.ask("floor.p.rim.gap", At::Least(None), &-&touch.depth, LENGTH);
    }
}
