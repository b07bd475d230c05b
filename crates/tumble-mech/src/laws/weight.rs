//! # Law
//! Weight: `F = m g` at the centre of mass, of the energy `V = m g y`.
//! # Symbols and units
//! m mass (kg), g acceleration of gravity (m/s^2), F force (N), y height of the centre of mass (m), V (J).
//! # Sign and frame
//! g is a vector in world axes; in a vertical plane (0, -g), and nothing within a horizontal plane. V is zero at y = 0, and
//! everywhere in a horizontal plane.
//! # Validity
//! A uniform field: bodies small against the distance over which g varies.
//! # Source
//! Newton's law of gravitation near the Earth's surface.
//! # Checked by
//! `tests/free_flight.rs` (parabola), `tests/pendulum.rs` (elliptic functions); energy in
//! `tests/balance.rs`.

use tumble_expr::{Expr, Vector, Written};

use crate::body::Body;
use crate::mass::MassProperties;
use crate::model::Gravity;
use crate::potential::Potential;
use crate::statement::Statement;
use crate::term::{Law, Term};

/// Name of the load in every equation and output.
pub(crate) const NAME: &str = "gravity";

pub(crate) fn term(body: usize, mass: &MassProperties, gravity: &Vector) -> Term {
    Term {
        load: NAME.to_owned(),
        law: Law::Weight,
        body,
        arm: Vector::planar(Expr::zero(), Expr::zero()),
        force: &mass.mass * gravity,
        couple: Expr::zero(),
        window: None,
    }
}

/// `m g`
pub(crate) fn statement(body: usize, mass: &MassProperties, gravity: &Vector) -> Statement {
    let force = Written::Vector(gravity.map(|g| &mass.mass * g));
    Statement::of(&term(body, mass, gravity), force)
}

/// The energy of a body, by its index, where there is gravity in the plane.
pub(crate) fn potential((index, body): (usize, &Body), gravity: &Gravity) -> Option<Potential> {
    let Gravity::Vertical(g) = gravity else { return None };
    let weight = term(index, &body.mass_properties(), &gravity.in_plane()?);
    Some(Potential::of(body.potential_energy(gravity), weight, vec![g.clone()]))
}

impl Body {
    /// Energy of the weight, J.
    pub fn potential_energy(&self, gravity: &Gravity) -> Expr {
        match gravity {
            Gravity::Vertical(g) => self.mass_properties().mass * g * self.kinematics().position().y(),
            Gravity::None | Gravity::Horizontal(_) => Expr::zero(),
        }
    }
}
