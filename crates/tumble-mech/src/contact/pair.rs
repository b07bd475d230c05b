//! # Law
//! A circle of radius r about the body's point p and a surface through P with the unit normal n: the gap is
//! `g = n . (p - P) - r`, its rates follow by differentiating; the force N >= 0 acts along n at the contact point
//! `p - r n`. It has no friction, so its power is `N g'` less what the moving surface adds.
//! # Symbols and units
//! g (m), n (1), p, P, r (m), N (N).
//! # Sign and frame
//! World axes; n points out of the solid, g is positive apart and negative inside.
//! # Validity
//! Ends, corners and rims of rigid bodies against planes, which may move and tilt on given paths.
//! # Source
//! Geometry of a circle and a line; the law of the force is the surface's.
//! # Checked by
//! `tests/bouncing_rod.rs`, `tests/bouncing_ball.rs`, `tests/moving_floor.rs`.

use tumble_expr::{Dimension, Expr, Symbol, Vector};

use crate::anchor::rate;
use crate::body::Body;
use crate::contact::feature::Feature;
use crate::coordinates::{Measure, Pivot};
use crate::kinematics::PointRef;
use crate::parameters::time_symbol;
use crate::row::{Row, Wrench};
use crate::surface::{ContactLaw, Surface};
use crate::term::{Law, Term};

/// A point of a body and a surface that it may touch.
#[derive(Clone, Debug)]
pub struct Pair {
    /// `floor.rod.tip`
    pub name: String,
    /// Index of the surface.
    pub surface: usize,
    /// Index of the body.
    pub body: usize,
    /// Centre of the circle that touches.
    pub centre: PointRef,
    /// Its radius, m.
    pub radius: Expr,
    /// A point of the surface, m.
    pub through: Vector,
    /// Unit vector out of the solid.
    pub normal: Vector,
    /// What happens where they touch, the body's own restitution included.
    pub law: ContactLaw,
}

impl Pair {
    pub(crate) fn new(
        (surface_index, surface): (usize, &Surface),
        (body_index, body): (usize, &Body),
        (feature, centre): (&Feature, &PointRef),
    ) -> Self {
        Self {
            name: format!("{}.{}.{}", surface.name, body.name, feature.name),
            surface: surface_index,
            body: body_index,
            centre: centre.clone(),
            radius: feature.radius.clone(),
            through: surface.through.clone(),
            normal: surface.normal.clone(),
            law: surface.law.of_body(body.restitution.as_ref()),
        }
    }

    /// Distance from the surface, m.
    pub fn gap(&self) -> Expr {
        // Far from the origin the difference of the places is exact; what the arm is added to before would be rounded.
        let from = self.centre.body.position() - &self.through;
        dot(&self.normal, &(from + self.centre.world_arm())) - &self.radius
    }

    /// Rate of the gap, m/s.
    pub fn gap_rate(&self) -> Expr {
        let relative = self.centre.velocity() - rate(&self.through);
        let tilting = dot(&rate(&self.normal), &(self.centre.position() - &self.through));
        dot(&self.normal, &relative) + tilting
    }

    /// Second derivative of the gap, m/s^2, in the body's accelerations.
    pub fn gap_acceleration(&self) -> Expr {
        let relative = self.centre.acceleration() - rate(&rate(&self.through));
        let turning = rate(&self.normal);
        let coriolis = 2 * dot(&turning, &(self.centre.velocity() - rate(&self.through)));
        let tilting = dot(&rate(&turning), &(self.centre.position() - &self.through));
        dot(&self.normal, &relative) + coriolis + tilting
    }

    /// From the body's centre of mass to the point that touches, m, world axes.
    pub fn arm(&self) -> Vector {
        self.centre.world_arm() - &self.radius * &self.normal
    }

    /// The point that touches, m.
    pub fn point(&self) -> Vector {
        self.centre.body.position() + self.arm()
    }

    /// Stands for the force along the normal, N.
    pub fn force_symbol(&self) -> Symbol {
        Symbol::new(format!("{}.normal", self.name), Dimension::FORCE)
    }

    /// Stands for the root of the depth, m^(1/2), a state while a Hertzian contact is pressed.
    pub(crate) fn root_symbol(&self) -> Symbol {
        let dimension = Dimension::LENGTH.power(tumble_expr::Exponent::new(1, 2));
        Symbol::new(format!("{}.root", self.name), dimension.unwrap_or(Dimension::NONE))
    }

    /// The force on the body.
    pub(crate) fn term(&self) -> Term {
        let force: Expr = self.force_symbol().into();
        Term {
            load: self.name.clone(),
            law: Law::Contact,
            body: self.body,
            arm: self.arm(),
            force: &force * &self.normal,
            couple: Expr::zero(),
            window: None,
        }
    }

    /// The condition that the gap stays closed.
    pub(crate) fn row(&self) -> Row {
        let (body, arm, force) = (self.body, self.arm(), self.normal.clone());
        Row {
            multiplier: self.force_symbol(),
            wrenches: vec![Wrench { body, arm, force, couple: Expr::zero() }],
            position: self.gap(),
            rate: self.gap_rate(),
            acceleration: self.gap_acceleration(),
            measure: Measure::Length,
        }
    }

    /// How fast the gap can change with each coordinate: of x, of y and of the angle for a free body, of the angle for a
    /// pivoted one. `None` where the surface or the pivot moves.
    pub(crate) fn slopes(&self, pivot: Option<&Pivot>, body: &Body) -> Option<Vec<Expr>> {
        let t = time_symbol();
        let moves = |v: &Vector| v.components().iter().any(|part| part.symbols().contains(&t));
        let is_moved = moves(&self.through) || moves(&self.normal);
        match pivot {
            _ if is_moved => None,
            None => Some(vec![self.normal.x().clone(), self.normal.y().clone(), self.centre.arm.norm()]),
            Some(pivot) if moves(&pivot.world) => None,
            Some(pivot) => Some(vec![(&self.centre.arm - &body.at(&pivot.point).arm).norm()]),
        }
    }

    /// Whether the surface is rigid.
    pub fn is_rigid(&self) -> bool {
        self.law.is_rigid()
    }

    pub(crate) fn is_hertzian(&self) -> bool {
        self.law.is_hertzian()
    }

    /// Whether a body that is let go may still be inside the surface.
    pub(crate) fn releases_early(&self) -> bool {
        self.law.releases_early()
    }

    /// Kept apart, gaps and forces have names by which the integrator knows them in every mode.
    pub(crate) fn guard_name(&self, of: Watched) -> String {
        let what = match of {
            Watched::Gap => "gap",
            Watched::Force => "force",
            Watched::Normal => "normal",
        };
        format!("{}.{what}", self.name)
    }
}

/// What of a pair is watched for crossing zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Watched {
    /// Its gap.
    Gap,
    /// The force of a spring with a damper.
    Force,
    /// The force that keeps it on a rigid surface.
    Normal,
}

fn dot(a: &Vector, b: &Vector) -> Expr {
    a.x() * b.x() + a.y() * b.y()
}
