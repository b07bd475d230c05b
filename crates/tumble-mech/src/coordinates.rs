//! # Law
//! A free body: `M a = sum F` for its centre of mass and `I alpha = sum tau` about it. A body on a fixed pivot P: about
//! the fixed axis `I_P alpha = sum tau_P` with `I_P = I + M |c - P|^2`, and the centre goes round P:
//! `v = v_P + omega x r`, `a = a_P + alpha x r - omega^2 r` with r from P to c. Where P moves on a given path,
//! `I_P alpha = sum tau_P - M (r x a_P)`. The pivot's reaction is `R = M a - sum F`.
//! # Symbols and units
//! M (kg), I (kg m^2), F and R (N), tau (N m), a (m/s^2), alpha (rad/s^2), r (m).
//! # Sign and frame
//! World axes, torques and angles counter-clockwise.
//! # Validity
//! Plane motion; the pivot is without friction, fixed in the world or moved on a given path.
//! # Source
//! Newton's and Euler's laws of motion; the theorem of the fixed axis.
//! # Checked by
//! `tests/free_flight.rs`, `tests/kicked_ball.rs`, `tests/pendulum.rs` (elliptic functions; the reaction closes
//! both laws), `tests/springs.rs` (a shaken pivot).

use tumble_expr::{Dimension, Expr, Substitution, Symbol, Vector};

use crate::anchor::rate;
use crate::kinematics::{Kinematics, PointRef};
use crate::mass::MassProperties;
use crate::row::Wrench;
use crate::term::{Law, Term};

/// A point of the world, fixed or moved on a given path, that a point of the body is held at.
#[derive(Clone, Debug)]
pub struct Pivot {
    /// Its name.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// The body's point, m, body coordinates.
    pub point: Vector,
    /// Where it is held, m, world axes; a formula of the time where it moves.
    pub world: Vector,
}

impl Pivot {
    /// Symbols of its force on the body, N.
    pub fn force_symbols(&self) -> [Symbol; 2] {
        force_symbols(&self.name)
    }
}

/// Symbols of the force of a joint of that name on the first body it holds, N.
pub(crate) fn force_symbols(joint: &str) -> [Symbol; 2] {
    ["fx", "fy"].map(|name| Symbol::new(format!("{joint}.{name}"), Dimension::FORCE))
}

/// The coordinates of one body: which of its kinematic symbols are states, and what the others are.
#[derive(Clone, Debug)]
pub(crate) enum Coordinates {
    Free {
        /// Whether the body has no moment of inertia, whatever the parameters are.
        is_point: bool,
    },
    Pivoted {
        joint: String,
        /// From the pivot to the centre of mass, m, body axes.
        arm: Vector,
        /// m, world axes
        world: Vector,
    },
}

/// What a state measures, and so which scale its error is relative to: its number is the scale group's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Measure {
    Length,
    Angle,
    Speed,
    AngularRate,
    /// Root of the depth of a Hertzian contact.
    Root,
    /// Force, or couple, that loads read otherwise than linearly.
    Force,
    Torque,
}

impl Measure {
    /// What the rate of something so measured is measured in.
    pub(crate) fn rate(self) -> Self {
        match self {
            Self::Angle => Self::AngularRate,
            _ => Self::Speed,
        }
    }
}

/// A state with its rate, in the body's kinematic symbols.
#[derive(Clone, Debug)]
pub(crate) struct StateRate {
    pub(crate) symbol: Symbol,
    pub(crate) rate: Expr,
    pub(crate) measure: Measure,
    /// Whether the rate is with respect to the parameter of the mode's time transformation.
    pub(crate) per_parameter: bool,
}

impl Coordinates {
    pub(crate) fn of(pivot: Option<&Pivot>, mass: &MassProperties) -> Self {
        match pivot {
            None => Self::Free { is_point: tumble_expr::is_identically_zero(&mass.inertia) },
            Some(pivot) => Self::Pivoted {
                joint: pivot.name.clone(),
                arm: &mass.centre - &pivot.point,
                world: pivot.world.clone(),
            },
        }
    }

    /// The states in order, each with its rate of change; accelerations are left as symbols.
    pub(crate) fn states(&self, body: &Kinematics) -> Vec<StateRate> {
        let state =
            |symbol: Symbol, rate: Expr, measure| StateRate { symbol, rate, measure, per_parameter: false };
        let [x, y] = body.position_symbols();
        let [vx, vy] = body.velocity_symbols();
        let [ax, ay] = body.acceleration_symbols();
        let turning = [
            state(body.angle_symbol(), body.omega(), Measure::Angle),
            state(body.omega_symbol(), body.alpha(), Measure::AngularRate),
        ];
        let moving = [
            state(x, vx.clone().into(), Measure::Length),
            state(y, vy.clone().into(), Measure::Length),
            state(vx, ax.into(), Measure::Speed),
            state(vy, ay.into(), Measure::Speed),
        ];
        match self {
            Self::Free { .. } => moving.into_iter().chain(turning).collect(),
            Self::Pivoted { .. } => turning.into(),
        }
    }

    /// How many states there are.
    pub(crate) fn count(&self) -> usize {
        match self {
            Self::Free { .. } => 6,
            Self::Pivoted { .. } => 2,
        }
    }

    /// What the kinematic symbols that are not states are, in those that are.
    pub(crate) fn define(&self, body: &Kinematics, definitions: &mut Substitution) {
        let Self::Pivoted { arm, world, .. } = self else { return };
        let arm = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
        let velocity = rate(world) + body.omega() * arm.perpendicular();
        for (symbol, formula) in body.position_symbols().into_iter().zip((world + &arm).components()) {
            definitions.insert(symbol, formula.clone());
        }
        for (symbol, formula) in body.velocity_symbols().into_iter().zip(velocity.components()) {
            definitions.insert(symbol, formula.clone());
        }
    }

    /// Acceleration of the centre and angular acceleration under forces and torques of this sum, the latter as [`Self::torque`].
    pub(crate) fn accelerations(
        &self,
        body: &Kinematics,
        mass: &MassProperties,
        (force, torque): (&Vector, &Expr),
    ) -> (Vector, Expr) {
        match self {
            Self::Free { is_point } => {
                let alpha = if *is_point { Expr::zero() } else { torque / &mass.inertia };
                (force.map(|component| component / &mass.mass), alpha)
            }
            Self::Pivoted { arm, world, .. } => {
                let from_pivot = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
                let anchor = rate(&rate(world));
                let carried = &mass.mass * from_pivot.cross_planar(&anchor);
                let alpha = (torque - carried) / inertia_about_pivot(arm, mass);
                let omega = body.omega();
                let centripetal = (&omega * &omega) * &from_pivot;
                (anchor + &alpha * from_pivot.perpendicular() - centripetal, alpha)
            }
        }
    }

    /// Torque of a term about what the body turns about: its centre, or its pivot.
    pub(crate) fn torque(&self, body: &Kinematics, term: &Term) -> Expr {
        match self {
            Self::Free { .. } => term.torque(),
            Self::Pivoted { arm, .. } => {
                let from_pivot = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
                term.torque_about(&(&from_pivot + &term.arm))
            }
        }
    }

    /// Forces of terms along each coordinate, N or N m.
    pub(crate) fn forces(&self, body: &Kinematics, terms: &[&Term]) -> Vec<Expr> {
        let torque = total(terms.iter().map(|term| self.torque(body, term)));
        match self {
            Self::Free { .. } => {
                let force = total_force(terms);
                vec![force.x().clone(), force.y().clone(), torque]
            }
            Self::Pivoted { .. } => vec![torque],
        }
    }

    /// What a term could do along each coordinate if it acted the other way round, N or N m: its size, whatever its direction.
    pub(crate) fn sizes(&self, body: &Kinematics, term: &Term) -> Vec<Expr> {
        let force = term.force.norm();
        let torque = |arm: &Vector| arm.norm() * &force + term.couple.abs();
        match self {
            Self::Free { .. } => vec![force.clone(), force.clone(), torque(&term.arm)],
            Self::Pivoted { arm, .. } => {
                let from_pivot = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
                vec![torque(&(from_pivot + &term.arm))]
            }
        }
    }

    /// Moment of inertia about the axis that the body turns about, kg m^2.
    pub(crate) fn inertia(&self, mass: &MassProperties) -> Expr {
        match self {
            Self::Free { .. } => mass.inertia.clone(),
            Self::Pivoted { arm, .. } => inertia_about_pivot(arm, mass),
        }
    }

    /// Indices of the velocities among [`Coordinates::states`].
    pub(crate) fn velocity_states(&self) -> &'static [usize] {
        match self {
            Self::Free { .. } => &[2, 3, 5],
            Self::Pivoted { .. } => &[1],
        }
    }

    /// Indices of what those are the rates of.
    pub(crate) fn coordinate_states(&self) -> &'static [usize] {
        match self {
            Self::Free { .. } => &[0, 1, 4],
            Self::Pivoted { .. } => &[0],
        }
    }

    /// What each velocity takes to be changed: kg, of a rotation kg m^2. What has no moment of inertia and does not turn either has
    /// one of 1 kg m^2, which nothing reaches.
    pub(crate) fn masses(&self, mass: &MassProperties, turns: bool) -> Vec<Expr> {
        match self {
            Self::Free { is_point } => {
                let inertia = if *is_point && !turns { Expr::one() } else { mass.inertia.clone() };
                vec![mass.mass.clone(), mass.mass.clone(), inertia]
            }
            Self::Pivoted { arm, .. } => vec![inertia_about_pivot(arm, mass)],
        }
    }

    /// Change of each velocity by a unit of its impulse: 1/kg, or 1/(kg m^2) of a rotation.
    pub(crate) fn inverse_masses(&self, mass: &MassProperties) -> Vec<Expr> {
        match self {
            Self::Free { is_point } => {
                let turning = match is_point {
                    true => &mass.inertia * 0,
                    false => 1 / &mass.inertia,
                };
                vec![1 / &mass.mass, 1 / &mass.mass, turning]
            }
            Self::Pivoted { arm, .. } => vec![1 / inertia_about_pivot(arm, mass)],
        }
    }

    /// What a unit of one wrench on the body does along another: 1/kg for two forces.
    pub(crate) fn response(&self, body: &Kinematics, mass: &MassProperties, i: &Wrench, j: &Wrench) -> Expr {
        match self {
            Self::Free { is_point } => {
                let along = i.force.x() * j.force.x() + i.force.y() * j.force.y();
                let centre = Vector::planar(Expr::zero(), Expr::zero());
                let pushed = along / &mass.mass;
                match is_point {
                    true => pushed,
                    false => pushed + i.torque_about(&centre) * j.torque_about(&centre) / &mass.inertia,
                }
            }
            Self::Pivoted { arm, .. } => {
                let from_pivot = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
                i.torque_about(&from_pivot) * j.torque_about(&from_pivot) / inertia_about_pivot(arm, mass)
            }
        }
    }

    /// What a unit of a wrench on the body does to the force of its pivot.
    pub(crate) fn recoil(&self, body: &Kinematics, mass: &MassProperties, by: &Wrench) -> Vector {
        let Self::Pivoted { arm, .. } = self else { return Vector::planar(Expr::zero(), Expr::zero()) };
        let from_pivot = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
        let alpha = by.torque_about(&from_pivot) / inertia_about_pivot(arm, mass);
        &mass.mass * alpha * from_pivot.perpendicular() - &by.force
    }

    /// The pivot's force on the body, given the force of all other terms and the acceleration.
    pub(crate) fn reaction(
        &self,
        index: usize,
        body: &Kinematics,
        mass: &MassProperties,
        force: &Vector,
    ) -> Option<Term> {
        let Self::Pivoted { joint, arm, .. } = self else { return None };
        let from_pivot = PointRef { body: body.clone(), arm: arm.clone() }.world_arm();
        Some(Term {
            load: joint.clone(),
            law: Law::Reaction,
            body: index,
            arm: -&from_pivot,
            force: &mass.mass * body.acceleration() - force,
            couple: Expr::zero(),
            window: None,
        })
    }
}

/// kg m^2; `arm` is from the pivot to the centre of mass.
fn inertia_about_pivot(arm: &Vector, mass: &MassProperties) -> Expr {
    let origin = Vector::planar(Expr::zero(), Expr::zero());
    MassProperties { centre: arm.clone(), ..mass.clone() }.inertia_about(&origin)
}

/// The sum of their forces.
pub(crate) fn total_force(terms: &[&Term]) -> Vector {
    let nothing = Vector::planar(Expr::zero(), Expr::zero());
    terms.iter().fold(nothing, |sum, term| sum + &term.force)
}

fn total(torques: impl Iterator<Item = Expr>) -> Expr {
    torques.fold(Expr::zero(), |sum, torque| sum + torque)
}
