//! # Law
//! Lift on a spinning body in a stream of air: `F = S omega x (-u)`, with u the velocity of the air relative to the
//! centre. A ball of radius R has `S = rho C_L pi R^3 / 2`, so that its lift coefficient is `C_L R omega / |u|`.
//! # Symbols and units
//! S lift factor (kg), omega angular rate (rad/s), u (m/s), rho (kg/m^3), C_L slope of the lift coefficient, R (m).
//! # Sign and frame
//! World axes; a body that flies to the right with back spin (counter-clockwise) is lifted up.
//! # Validity
//! Spin slow against the stream: the lift is proportional to omega.
//! # Source
//! Magnus effect in its linear form.
//! # Checked by
//! `tests/air.rs` (the lift turns the velocity at a constant rate: a circle).

use tumble_expr::{Dimension, Expr, Vector, Written};

use crate::air::Wind;
use crate::interaction::{Bodies, Interaction};
use crate::kinematics::PointRef;
use crate::laws::drag::{relative, written_wind};
use crate::statement::{Statement, times};
use crate::term::{Law, Term};

/// Lift on a spinning body.
#[derive(Clone, Debug)]
pub struct Magnus {
    /// Its name.
    pub name: String,
    /// Where it acts: the centre of the ball.
    pub at: PointRef,
    /// Lift factor S, kg.
    pub factor: Expr,
}

impl Magnus {
    /// On a ball of that radius, m, in air of that density, kg/m^3, with the slope of its lift coefficient.
    pub fn ball(name: impl Into<String>, at: PointRef, radius: &Expr, density: Expr, slope: Expr) -> Self {
        let volume = Expr::pi() * (radius * radius * radius);
        Self { name: name.into(), at, factor: density * slope * volume / 2 }
    }
}

/// Velocity through the air, as it is written.
fn through_air(point: &PointRef, wind: &Wind) -> Written {
    let velocity = Written::named("v", Written::Vector(point.velocity()));
    match written_wind(wind, &point.position()) {
        Some(wind) => Written::named("v_r", velocity.less(wind)),
        None => velocity,
    }
}

impl Interaction for Magnus {
    fn name(&self) -> &str {
        &self.name
    }

    fn terms(&self, bodies: &Bodies<'_>) -> Vec<Term> {
        let through_air = -&relative(&self.at, bodies.wind);
        let force: Vector = (&self.factor * self.at.body.omega()) * through_air.perpendicular();
        let (body, arm) = (&self.at.body.body, self.at.world_arm());
        vec![bodies.term(&self.name, Law::Lift, body, arm, force, Expr::zero())]
    }

    fn statements(&self, bodies: &Bodies<'_>) -> Vec<Statement> {
        let spin = Written::Scalar(self.at.body.omega());
        let lift = spin.cross(through_air(&self.at, bodies.wind));
        let force = times(&self.factor, vec![lift]);
        self.terms(bodies).iter().map(|term| Statement::of(term, force.clone())).collect()
    }

    fn bodies(&self) -> Vec<&str> {
        vec![&self.at.body.body]
    }

    fn dimensions(&self) -> Vec<(&'static str, Expr, Dimension)> {
        vec![("factor", self.factor.clone(), Dimension::MASS)]
    }
}
