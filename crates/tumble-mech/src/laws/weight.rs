//! # Law
//! Weight: `F = m g` at the centre of mass.
//! # Symbols and units
//! m mass (kg), g acceleration of gravity (m/s^2), F force (N).
//! # Sign and frame
//! g is a vector in world axes; in a vertical plane (0, -g), and nothing within a horizontal plane.
//! # Validity
//! A uniform field: bodies small against the distance over which g varies.
//! # Source
//! Newton's law of gravitation near the Earth's surface.
//! # Checked by
//! `tests/free_flight.rs` (parabola), `tests/pendulum.rs` (elliptic functions).

use tumble_expr::{Expr, Vector};

use crate::mass::MassProperties;
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
