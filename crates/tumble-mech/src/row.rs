//! # Law
//! A row is a scalar condition `g = 0` on the motion of one or two bodies, kept by a multiplier: a unit of it is a wrench on
//! each body, the same by which g changes (virtual work). With a_i what `g_i''` would be without multipliers and A_ij what a unit of
//! multiplier j does to it, all rows that hold solve `A lambda = -a` together; `A_ij` is the sum over the bodies of both of
//! `f_i . f_j / M + (r_i x f_i + c_i)(r_j x f_j + c_j) / I`, for a body on a pivot `T_i T_j / I_P` with torques about the pivot.
//! # Symbols and units
//! g (m or rad), lambda (N or N m), f force (1) at the arm r (m) and c couple (m or 1) of a unit multiplier, M (kg), I (kg m^2).
//! # Sign and frame
//! World axes; a gap's normal force is never negative, where it would become so the contact ends; a joint's may have any sign.
//! # Validity
//! No friction. Rows that depend on each other have no one solution: those that add nothing are left out, with multiplier zero.
//! # Source
//! Lagrange's equations of the first kind; Signorini's conditions for gaps.
//! # Checked by
//! `tests/resting.rs`: a rod that slides down a wall, a box on a slope, lift-off; `tests/joints.rs`.

use tumble_expr::{Expr, Symbol, Vector};

use crate::coordinates::Measure;

/// A condition, with what it does to bodies.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Stands for what keeps it.
    pub(crate) multiplier: Symbol,
    /// By body, what a unit of the multiplier is.
    pub(crate) wrenches: Vec<Wrench>,
    /// What is zero, and its derivatives by the time.
    pub(crate) position: Expr,
    pub(crate) rate: Expr,
    pub(crate) acceleration: Expr,
    /// Kind of what is zero.
    pub(crate) measure: Measure,
}

/// A force at its point and a couple, for a unit of a multiplier.
#[derive(Clone, Debug)]
pub(crate) struct Wrench {
    pub(crate) body: usize,
    /// From the centre of mass, m, world axes.
    pub(crate) arm: Vector,
    pub(crate) force: Vector,
    pub(crate) couple: Expr,
}

impl Wrench {
    /// Its torque about the point from which the centre of mass is at `from`.
    pub(crate) fn torque_about(&self, from: &Vector) -> Expr {
        (from + &self.arm).cross_planar(&self.force) + &self.couple
    }
}

/// Torque of some wrenches on a body about its centre of mass.
pub(crate) fn torque_on(wrenches: &[Wrench], body: usize) -> Expr {
    let centre = Vector::planar(Expr::zero(), Expr::zero());
    let own = wrenches.iter().filter(|wrench| wrench.body == body);
    own.fold(Expr::zero(), |sum, wrench| sum + wrench.torque_about(&centre))
}
