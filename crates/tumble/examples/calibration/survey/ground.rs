//! A body that lies on a rough floor or slope.

use super::real::Real;
use super::setup::{At, Given, Setup};
use super::units::{ACCELERATION, LENGTH, MASS, SPEED};

/// Angles of slopes, rad.
const SLOPES: [f64; 2] = [0.02, 0.9];
/// Round shapes, and their moments of inertia in parts of m R^2 as fractions.
const ROUND: [(&str, [i64; 2]); 4] =
    [("ball", [2, 5]), ("shell", [2, 3]), ("disk", [1, 2]), ("ring", [1, 1])];

/// What all of them have.
#[derive(Clone, Debug)]
pub(crate) struct Ground {
    pub(crate) mass: Given,
    pub(crate) gravity: Given,
    /// Upwards to the right.
    pub(crate) slope: Given,
    foot: [Given; 2],
}

/// A body along the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Along<'a> {
    pub(crate) place: &'a Real,
    pub(crate) speed: &'a Real,
}

/// A round shape.
#[derive(Clone, Debug)]
pub(crate) struct Round {
    pub(crate) radius: Given,
    /// Its moment of inertia in parts of m R^2.
    pub(crate) inertia: Real,
    name: &'static str,
    share: [i64; 2],
}

impl Ground {
    /// With this share of slopes.
    pub(crate) fn random(setup: &mut Setup, sloped: f64) -> Self {
        let (mass, gravity) = (setup.given("mass", 1.0, MASS), setup.given("g", 1.0, ACCELERATION));
        let is_sloped = setup.draw.chance(sloped);
        let size = if is_sloped { setup.draw.sign() * setup.draw.between(SLOPES[0], SLOPES[1]) } else { 0.0 };
        let slope = setup.angle("slope", size);
        let foot = [setup.shift("foot_x"), setup.shift("foot_y")];
        Self { mass, gravity, slope, foot }
    }

    /// Where the ground is given.
    pub(crate) fn x(&self) -> &Given {
        &self.foot[0]
    }

    /// The place so high over it, as formulas.
    pub(crate) fn above(&self, height: &str) -> [String; 2] {
        let Self { slope, foot: [x, y], .. } = self;
        [format!("{x} - {height}*sin({slope})"), format!("{y} + {height}*cos({slope})")]
    }

    /// How far from the origin it is, m.
    pub(crate) fn far(&self) -> f64 {
        self.foot[0].near().hypot(self.foot[1].near())
    }

    /// Weight along the ground and across it, for a mass of one.
    pub(crate) fn weight(&self) -> [Real; 2] {
        [-(&self.gravity.value * self.slope.value.sin()), &self.gravity.value * self.slope.value.cos()]
    }

    /// Writes the body `p`, whose middle is so high over the ground, and the floor with its contact law.
    pub(crate) fn write(
        &self,
        setup: &mut Setup,
        [shape, start]: [&str; 2],
        [height, speed]: [&str; 2],
        rigid: &str,
    ) {
        let Self { mass, slope, foot: [x, y], .. } = self;
        let [middle_x, middle_y] = self.above(height);
        setup.write(&format!(
            "[body.p]
            {shape}
            mass = \"{mass}\"
            [body.p.start]
            at = [\"{middle_x}\", \"{middle_y}\"]
            velocity = [\"{speed}*cos({slope})\", \"{speed}*sin({slope})\"]
            {start}
            [surface.floor]
            through = [\"{x}\", \"{y}\"]
            slope = \"{slope}\"
            rigid = {{ restitution = 0, {rigid} }}"
        ));
    }

    /// Asks where the body is and how fast; what rests has no speed, of that size before.
    pub(crate) fn ask(
        &self,
        setup: &mut Setup,
        at: &At,
        height: &Real,
        Along { place, speed }: Along<'_>,
        size: &Real,
    ) {
        let [sine, cosine] = [self.slope.value.sin(), self.slope.value.cos()];
        let x = &self.foot[0].value - height * &sine + place * &cosine;
        setup.ask("p.x", at.clone(), &x, LENGTH);
        let (vx, size) = (speed * cosine, size.abs().to_f64());
        setup.ask_beside("p.vx", at.clone(), (&vx, size), SPEED);
        if !sine.is_zero() {
            setup.ask_beside("p.vy", at.clone(), (&(speed * sine), size), SPEED);
        }
    }
}

impl Round {
    pub(crate) fn random(setup: &mut Setup) -> Self {
        Self::named(setup, "radius")
    }

    /// With that name for the radius.
    pub(crate) fn named(setup: &mut Setup, radius: &str) -> Self {
        let (name, share) = setup.draw.pick(&ROUND);
        let size = setup.draw.log_between(0.01, 1.0);
        let radius = setup.given(radius, size, LENGTH);
        Self { radius, inertia: Real::from(share[0]) / share[1], name, share }
    }

    /// k/(k + 1) as a formula.
    pub(crate) fn share(&self) -> String {
        let [above, below] = self.share;
        format!("{above}/{}", above + below)
    }

    /// As a scene has it.
    pub(crate) fn shape(&self) -> String {
        format!("{} = {{ radius = \"{}\" }}", self.name, self.radius)
    }
}

/// A block that does not tip over, with half its height.
pub(crate) fn block(setup: &mut Setup) -> (String, Given) {
    let half = setup.given("half", 0.05, LENGTH);
    (format!("box = {{ width = \"40*{half}\", height = \"2*{half}\" }}"), half)
}

/// A kinetic and a static coefficient, the same or a greater one, with what a scene says of them.
pub(crate) fn friction(setup: &mut Setup, [low, high]: [f64; 2]) -> ([Real; 2], String) {
    let size = setup.draw.log_between(low, high);
    let kinetic = setup.given("mu", size, super::units::NUMBER);
    if setup.draw.chance(0.5) {
        return ([kinetic.value.clone(), kinetic.value.clone()], format!("friction = \"{kinetic}\""));
    }
    let more = setup.draw.between(1.01, 1.5);
    let of_rest = Real::read(&format!("{more:.2}"));
    let text = format!("friction = {{ static = \"{more:.2}*{kinetic}\", kinetic = \"{kinetic}\" }}");
    ([kinetic.value.clone(), of_rest * &kinetic.value], text)
}
