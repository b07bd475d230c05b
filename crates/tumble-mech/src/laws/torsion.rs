//! # Law
//! A torsion spring and damper between a body and the world: `tau = -kappa (theta - theta_0) - c omega`.
//! # Symbols and units
//! kappa stiffness (N m/rad), theta_0 rest angle (rad), c damping (N m s/rad).
//! # Sign and frame
//! Counter-clockwise positive; the torque is a couple.
//! # Validity
//! Any angle, not wrapped: three turns wind it up by three turns.
//! # Source
//! Hooke's law for torsion.
//! # Checked by
//! `tests/springs.rs` (a torsion pendulum, damped).

use tumble_expr::{Dimension, Expr, Vector};

use crate::interaction::{Bodies, Interaction};
use crate::kinematics::Kinematics;
use crate::term::{Law, Term};

/// A torsion spring, a torsion damper, or both.
#[derive(Clone, Debug)]
pub struct Torsion {
    /// Its name.
    pub name: String,
    /// The body it turns.
    pub body: Kinematics,
    /// N m/rad
    pub stiffness: Expr,
    /// rad
    pub rest_angle: Expr,
    /// N m s/rad
    pub damping: Expr,
}

impl Interaction for Torsion {
    fn name(&self) -> &str {
        &self.name
    }

    fn terms(&self, bodies: &Bodies<'_>) -> Vec<Term> {
        let twist = self.body.angle() - &self.rest_angle;
        let torque = -(&self.stiffness * twist) - &self.damping * self.body.omega();
        let nothing = || Vector::planar(Expr::zero(), Expr::zero());
        vec![bodies.term(&self.name, Law::Torsion, &self.body.body, nothing(), nothing(), torque)]
    }

    fn bodies(&self) -> Vec<&str> {
        vec![&self.body.body]
    }

    fn dimensions(&self) -> Vec<(&'static str, Expr, Dimension)> {
        vec![
            ("stiffness", self.stiffness.clone(), Dimension::TORQUE),
            ("rest angle", self.rest_angle.clone(), Dimension::NONE),
            ("damping", self.damping.clone(), Dimension::new(2, 1, -1)),
        ]
    }

    fn angles(&self) -> Vec<(&'static str, Expr)> {
        vec![("rest angle", self.rest_angle.clone())]
    }

    fn nonnegative(&self) -> Vec<(&'static str, Expr, &'static str)> {
        vec![("stiffness", self.stiffness.clone(), "N m/rad"), ("damping", self.damping.clone(), "N m s/rad")]
    }
}
