//! # Law
//! A rigid body in the plane: its centre of mass is at (x, y), it is turned by an angle, and a point with the arm r from
//! the centre has the position `c + r` and the velocity `v + omega x r`, with `r = R(angle) r_body`.
//! # Symbols and units
//! x, y position of the centre of mass (m), angle (rad), vx, vy velocity of the centre of mass (m/s), omega (rad/s),
//! ax, ay, alpha accelerations (m/s^2, rad/s^2).
//! # Sign and frame
//! World axes: x to the right, y up; angles counter-clockwise from the body's drawing at angle zero.
//! # Validity
//! Plane motion of a rigid body, any speed and angle; angles are not wrapped.
//! # Source
//! Chasles' theorem in the plane.
//! # Checked by
//! Tests below: derivatives of a point's position along a motion; pivoted bodies in `tests/pendulum.rs`.

use tumble_expr::{Dimension, Expr, Symbol, Vector};

/// The time, s, as a formula.
pub fn time() -> Expr {
    Expr::symbol("t", Dimension::TIME)
}

/// `v` turned counter-clockwise by `angle`.
pub fn rotated(v: &Vector, angle: &Expr) -> Vector {
    let (cos, sin) = (angle.cos(), angle.sin());
    Vector::planar(&cos * v.x() - &sin * v.y(), &sin * v.x() + &cos * v.y())
}

/// Names and formulas of a body's motion. Whether each is a state or follows from others is the joints' business.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Kinematics {
    /// Name of the body.
    pub body: String,
}

impl Kinematics {
    /// Motion of the body of that name.
    pub fn new(body: &str) -> Self {
        Self { body: body.to_owned() }
    }

    /// The symbol `body.name`.
    pub fn symbol(&self, name: &str, dimension: Dimension) -> Symbol {
        Symbol::new(format!("{}.{name}", self.body), dimension)
    }

    /// Symbols of the centre's position.
    pub fn position_symbols(&self) -> [Symbol; 2] {
        ["x", "y"].map(|name| self.symbol(name, Dimension::LENGTH))
    }

    /// Symbol of the angle.
    pub fn angle_symbol(&self) -> Symbol {
        self.symbol("angle", Dimension::NONE)
    }

    /// Symbols of the centre's velocity.
    pub fn velocity_symbols(&self) -> [Symbol; 2] {
        ["vx", "vy"].map(|name| self.symbol(name, Dimension::SPEED))
    }

    /// Symbol of the angular rate.
    pub fn omega_symbol(&self) -> Symbol {
        self.symbol("omega", Dimension::ANGULAR_RATE)
    }

    /// Symbols of the centre's acceleration.
    pub fn acceleration_symbols(&self) -> [Symbol; 2] {
        ["ax", "ay"].map(|name| self.symbol(name, Dimension::ACCELERATION))
    }

    /// Symbol of the angular acceleration.
    pub fn alpha_symbol(&self) -> Symbol {
        self.symbol("alpha", Dimension::ANGULAR_ACCELERATION)
    }

    /// All of them: of places, the angle, and their rates.
    pub(crate) fn symbols(&self) -> Vec<Symbol> {
        let places = [self.position_symbols(), self.velocity_symbols(), self.acceleration_symbols()];
        places
            .concat()
            .into_iter()
            .chain([self.angle_symbol(), self.omega_symbol(), self.alpha_symbol()])
            .collect()
    }

    /// Position of the centre of mass, m.
    pub fn position(&self) -> Vector {
        vector(self.position_symbols())
    }

    /// Angle, rad.
    pub fn angle(&self) -> Expr {
        self.angle_symbol().into()
    }

    /// Velocity of the centre of mass, m/s.
    pub fn velocity(&self) -> Vector {
        vector(self.velocity_symbols())
    }

    /// Angular rate, rad/s.
    pub fn omega(&self) -> Expr {
        self.omega_symbol().into()
    }

    /// Acceleration of the centre of mass, m/s^2. Forces cannot depend on it.
    pub fn acceleration(&self) -> Vector {
        vector(self.acceleration_symbols())
    }

    /// Angular acceleration, rad/s^2. Forces cannot depend on it.
    pub fn alpha(&self) -> Expr {
        self.alpha_symbol().into()
    }
}

fn vector([x, y]: [Symbol; 2]) -> Vector {
    Vector::planar(x.into(), y.into())
}

/// A material point of a body.
#[derive(Clone, Debug)]
pub struct PointRef {
    /// The body's motion.
    pub body: Kinematics,
    /// From the centre of mass to the point, m, body axes.
    pub arm: Vector,
}

impl PointRef {
    /// From the centre of mass to the point, m, world axes.
    pub fn world_arm(&self) -> Vector {
        rotated(&self.arm, &self.body.angle())
    }

    /// Position, m.
    pub fn position(&self) -> Vector {
        self.body.position() + self.world_arm()
    }

    /// Velocity, m/s.
    pub fn velocity(&self) -> Vector {
        self.body.velocity() + self.body.omega() * self.world_arm().perpendicular()
    }

    /// Acceleration, m/s^2: `a + alpha x r - omega^2 r`.
    pub fn acceleration(&self) -> Vector {
        let (arm, omega) = (self.world_arm(), self.body.omega());
        let tangential = self.body.alpha() * arm.perpendicular();
        self.body.acceleration() + tangential - (&omega * &omega) * arm
    }

    /// Formulas of the point's motion by name: x, y, vx, vy, ax, ay.
    pub fn quantities(&self) -> Vec<(&'static str, Expr)> {
        let (p, v, a) = (self.position(), self.velocity(), self.acceleration());
        let pairs = [("x", &p[0]), ("y", &p[1]), ("vx", &v[0]), ("vy", &v[1]), ("ax", &a[0]), ("ay", &a[1])];
        pairs.into_iter().map(|(name, formula)| (name, formula.clone())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use tumble_expr::units::M;
    use tumble_expr::{Branches, Jets, Layout, Substitution, Tape};

    /// Along x = t^2, y = t^3, angle = sin t, the series of a point's position gives its velocity and acceleration.
    #[test]
    fn velocity_and_acceleration_are_derivatives() {
        let body = Kinematics::new("b");
        let t = Expr::symbol("t", Dimension::NONE);
        let arm = Vector::planar(0.3 * M, -0.7 * M);
        let point = PointRef { body: body.clone(), arm };
        let mut motion = Substitution::default();
        let [x, y] = body.position_symbols();
        let [vx, vy] = body.velocity_symbols();
        let [ax, ay] = body.acceleration_symbols();
        let along = [
            (x, t.powi(2)),
            (y, t.powi(3)),
            (body.angle_symbol(), t.sin()),
            (vx, 2 * &t),
            (vy, 3 * t.powi(2)),
            (body.omega_symbol(), t.cos()),
            (ax, Expr::from(2)),
            (ay, 6 * &t),
            (body.alpha_symbol(), -t.sin()),
        ];
        for (symbol, formula) in along {
            let unit = tumble_expr::Unit(symbol.dimension);
            motion.insert(symbol, formula * unit);
        }
        let formulas: Vec<Expr> =
            point.quantities().iter().map(|(_, formula)| motion.apply(formula)).collect();
        let layout = Layout::new(vec![], Symbol::new("t", Dimension::NONE), vec![]);
        let mut jets = Jets::new(Arc::new(Tape::compile(&layout, &formulas).expect("typed")), 2, &[]);
        jets.start(0.8, &[], Branches::Free);
        jets.set(0, 1, 1.0);
        jets.extend(1);
        jets.extend(2);
        for axis in 0..2 {
            let position = jets.output(axis);
            assert!((jets.output(2 + axis)[0] - position[1]).abs() < 1e-14);
            assert!((jets.output(4 + axis)[0] - 2.0 * position[2]).abs() < 1e-14);
        }
    }
}
