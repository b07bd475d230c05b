//! What a program that writes forces needs: `use tumble::prelude::*`.

pub use tumble_expr::units::{J, KG, M, N, RAD, S};
pub use tumble_expr::{Expr, Relation, Vector};
pub use tumble_mech::{
    Action, Anchor, Application, AppliedImpulse, Body, Component, ContactLaw, Drag, DragPlace, Equations,
    Event, Frame, Gravity, Joint, JointKind, Kinematics, Load, Magnus, MassProperties, Model, Moment,
    MultipleImpacts, Parameters, Part, Pivot, Place, PointRef, Release, Run, RunError, Shape, Spring, Start,
    Surface, Torsion, Wind,
};
pub use tumble_ode::{Accuracy, Direction};
pub use tumble_scene::{Instant, Plan, Sheet, Study, When};

pub use crate::pipeline::{Options, run_study};

/// The time, s.
pub fn t() -> Expr {
    tumble_mech::time()
}

/// pi
pub fn pi() -> Expr {
    Expr::pi()
}

/// A zero of any dimension.
pub fn zero() -> Expr {
    Expr::zero()
}

/// A vector in the plane.
pub fn vector([x, y]: [Expr; 2]) -> Vector {
    Vector::planar(x, y)
}

/// Euclidean length of a vector.
pub fn norm(v: &Vector) -> Expr {
    v.norm()
}

/// Sine of an angle in radians.
pub fn sin(x: Expr) -> Expr {
    x.sin()
}

/// Cosine of an angle in radians.
pub fn cos(x: Expr) -> Expr {
    x.cos()
}

/// Exponential.
pub fn exp(x: Expr) -> Expr {
    x.exp()
}

/// Square root, of any dimension.
pub fn sqrt(x: Expr) -> Expr {
    x.sqrt()
}

/// Absolute value.
pub fn abs(x: Expr) -> Expr {
    x.abs()
}

/// `a < b`, for [`select`].
pub fn less(a: Expr, b: Expr) -> Expr {
    Expr::compare(Relation::Less, a, b)
}

/// `then` where `condition` holds, else `otherwise`.
pub fn select(condition: Expr, then: Expr, otherwise: Expr) -> Expr {
    Expr::select(condition, then, otherwise)
}
