//! # Law
//! A torsion spring and damper between a body and the world: `tau = -kappa (theta - theta_0) - c omega`.
//! The spring's part has the energy `V = kappa (theta - theta_0)^2 / 2`.
//! # Symbols and units
//! kappa stiffness (N m/rad), theta_0 rest angle (rad), c damping (N m s/rad), V (J).
//! # Sign and frame
//! Counter-clockwise positive; the torque is a couple.
//! # Validity
//! Any angle, not wrapped: three turns wind it up by three turns.
//! # Source
//! Hooke's law for torsion.
//! # Checked by
//! `tests/springs.rs` (a torsion pendulum, damped); energy in `tests/balance.rs`.

use tumble_expr::{Dimension, Expr, Vector, Written, is_identically_zero};

use crate::interaction::{Bodies, Interaction};
use crate::kinematics::Kinematics;
use crate::potential::Potential;
use crate::statement::{Statement, times};
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

impl Torsion {
    /// rad
    fn twist(&self) -> Expr {
        self.body.angle() - &self.rest_angle
    }
}

impl Interaction for Torsion {
    fn name(&self) -> &str {
        &self.name
    }

    fn terms(&self, bodies: &Bodies<'_>) -> Vec<Term> {
        let torque = -(&self.stiffness * self.twist()) - &self.damping * self.body.omega();
        let nothing = || Vector::planar(Expr::zero(), Expr::zero());
        vec![bodies.term(&self.name, Law::Torsion, &self.body.body, nothing(), nothing(), torque)]
    }

    fn statements(&self, bodies: &Bodies<'_>) -> Vec<Statement> {
        let turned = || match is_identically_zero(&self.rest_angle) {
            true => Written::Scalar(self.body.angle()),
            false => Written::Scalar(self.body.angle()).less(Written::Scalar(self.rest_angle.clone())),
        };
        let spring = (!is_identically_zero(&self.stiffness)).then(|| times(&self.stiffness, vec![turned()]));
        let rate = || Written::Scalar(self.body.omega());
        let damper = (!is_identically_zero(&self.damping)).then(|| times(&self.damping, vec![rate()]));
        let torque = Written::Sum(spring.into_iter().chain(damper).map(|part| (true, part)).collect());
        self.terms(bodies).iter().map(|term| Statement::couple(term, torque.clone())).collect()
    }

    fn potential(&self, bodies: &Bodies<'_>) -> Option<Potential> {
        let twist = self.twist();
        let energy = &self.stiffness * (&twist * &twist) / 2;
        let energy = Some(energy).filter(|energy| !is_identically_zero(energy))?;
        let elastic = Self { damping: Expr::zero(), ..self.clone() }.terms(bodies).pop()?;
        let given = vec![self.stiffness.clone(), self.rest_angle.clone()];
        let is_whole = is_identically_zero(&self.damping);
        Some(Potential { is_whole, ..Potential::of(energy, elastic, given) })
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
