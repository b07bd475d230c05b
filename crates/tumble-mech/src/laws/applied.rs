//! # Law
//! A force or torque the user wrote: F at a point p adds F to the sum of forces and `(p - c) x F` to the sum of
//! torques about the centre c; a torque adds itself to the latter.
//! # Symbols and units
//! F force (N), p point of action (m), c centre of mass (m), tau torque (N m), window [a, b) (s).
//! # Sign and frame
//! World axes, or body axes turned with the body; torques counter-clockwise. The point is a material point, a place in
//! the world, or an offset from the centre that does not turn: the frame of the components changes nothing about it.
//! # Validity
//! Any formula of the time, the parameters and the states; it acts from a on and before b.
//! # Source
//! Newton's second law and the definition of a torque.
//! # Checked by
//! `tests/kicked_ball.rs` (a fixed offset and a material point), `tests/free_flight.rs` (gravity-free rotation).

use tumble_expr::{Expr, Vector, Written};

use crate::kinematics::{Kinematics, rotated};
use crate::load::{Application, Frame, Load};
use crate::statement::Statement;
use crate::term::{Law, Term};

pub(crate) fn term(load: &Load, body: usize, kinematics: &Kinematics, window: Option<usize>) -> Term {
    let nothing = || Vector::planar(Expr::zero(), Expr::zero());
    let (law, arm, force, couple) = match &load.application {
        Application::Force { at, force, frame } => {
            let force = match frame {
                Frame::World => force.clone(),
                Frame::Body => rotated(force, &kinematics.angle()),
            };
            (Law::Force, at.arm(kinematics), force, Expr::zero())
        }
        Application::Torque(torque) => (Law::Torque, nothing(), nothing(), torque.clone()),
    };
    Term { load: load.name.clone(), law, body, arm, force, couple, window }
}

/// Its components, or its torque.
pub(crate) fn statement(load: &Load, body: usize, kinematics: &Kinematics) -> Statement {
    let term = term(load, body, kinematics, None);
    match &load.application {
        Application::Force { .. } => Statement::of(&term, Written::Vector(term.force.clone())),
        Application::Torque(torque) => Statement::couple(&term, Written::Scalar(torque.clone())),
    }
}
