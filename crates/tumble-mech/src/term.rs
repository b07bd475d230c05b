//! One contribution to a body's equations of motion, with where it comes from.

use tumble_expr::{Expr, Vector};

/// Which law a term follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Law {
    /// Gravity on the body's mass.
    Weight,
    /// A force that the user wrote.
    Force,
    /// A torque that the user wrote.
    Torque,
    /// Air resistance.
    Drag,
    /// Lift on a spinning body.
    Lift,
    /// A spring or damper.
    Spring,
    /// A torsion spring or damper.
    Torsion,
    /// What holds a pivot in its place.
    Reaction,
    /// What a surface does to a body that touches it, along its normal.
    Contact,
    /// Dry friction: what it does along itself.
    Friction,
    /// Rolling resistance: the couple that it turns against.
    Rolling,
}

impl Law {
    /// Whether it is a couple, without a force.
    pub fn is_couple(self) -> bool {
        matches!(self, Self::Torque | Self::Torsion | Self::Rolling)
    }

    /// Whether it is what keeps bodies where a pivot or a joint holds them: it follows from the other loads.
    pub fn is_reaction(self) -> bool {
        matches!(self, Self::Reaction)
    }
}

/// A force at its point and a couple, as they enter the equations.
#[derive(Clone, Debug)]
pub struct Term {
    /// Name of the load or joint.
    pub load: String,
    /// The law it follows.
    pub law: Law,
    /// Index of the body it acts on.
    pub body: usize,
    /// From the body's centre of mass to the point of action, m, world axes.
    pub arm: Vector,
    /// N, world axes.
    pub force: Vector,
    /// Couple beyond the moment of the force, N m.
    pub couple: Expr,
    /// Index of the window it acts in; `None` is always.
    pub window: Option<usize>,
}

impl Term {
    /// Torque about the body's centre of mass, N m: `r x F` and the couple.
    pub fn torque(&self) -> Expr {
        self.torque_about(&self.arm)
    }

    /// Torque about the point from which the arm to the point of action is `arm`.
    pub fn torque_about(&self, arm: &Vector) -> Expr {
        arm.cross_planar(&self.force) + &self.couple
    }
}
