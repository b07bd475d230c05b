//! # Law
//! A circle of radius r about the body's point p and a surface through P with the unit normal n: the gap is
//! `g = n . (p - P) - r`, its rates follow by differentiating; the force N >= 0 acts along n at the contact point
//! `p - r n`, and its power is `N g'` less what the moving surface adds. Friction F acts there along t, n turned clockwise by a right
//! angle. The rate of slip is `s = t . (v - P')`, with v the velocity of the body's material point there.
//! # Symbols and units
//! g (m), n, t (1), p, P, r (m), N, F (N), s (m/s).
//! # Sign and frame
//! World axes; n points out of the solid, g is positive apart and negative inside.
//! # Validity
//! Ends, corners and rims of rigid bodies against planes, which may move and tilt on given paths.
//! # Source
//! Geometry of a circle and a line: what a tilting surface moves by along itself is zero where they touch. The laws of the forces are
//! the surface's.
//! # Checked by
//! `tests/bouncing_rod.rs`, `tests/bouncing_ball.rs`, `tests/moving_floor.rs`.

use tumble_expr::{Dimension, Expr, Symbol, Vector, Written, is_identically_zero};

use crate::anchor::rate;
use crate::body::Body;
use crate::contact::feature::Feature;
use crate::contact::grip::Way;
use crate::coordinates::{Measure, Pivot};
use crate::friction::Friction;
use crate::kinematics::PointRef;
use crate::parameters::time_symbol;
use crate::row::{Row, Wrench};
use crate::statement::Statement;
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
    /// Friction along the surface, if it has any.
    pub friction: Option<Friction>,
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
            friction: surface.friction.clone(),
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

    /// Unit vector along the surface, its normal turned clockwise by a right angle.
    pub fn tangent(&self) -> Vector {
        turned(&self.normal)
    }

    /// Rate at which the body's point slips along the surface, m/s.
    pub fn slip_rate(&self) -> Expr {
        dot(&self.tangent(), &self.slipping())
    }

    /// Its derivative, m/s^2, in the body's accelerations.
    pub fn slip_acceleration(&self) -> Expr {
        let motion = &self.centre.body;
        let (omega, arm) = (motion.omega(), self.arm());
        let turning = &omega * self.centre.world_arm().perpendicular() - &self.radius * rate(&self.normal);
        let own =
            motion.acceleration() + motion.alpha() * arm.perpendicular() + &omega * turning.perpendicular();
        let tilting = dot(&turned(&rate(&self.normal)), &self.slipping());
        dot(&self.tangent(), &(own - rate(&rate(&self.through)))) + tilting
    }

    /// Velocity of the body's material point less that of the surface, m/s.
    fn slipping(&self) -> Vector {
        let motion = &self.centre.body;
        motion.velocity() + motion.omega() * self.arm().perpendicular() - rate(&self.through)
    }

    /// Stands for the force along the surface, N.
    pub fn friction_symbol(&self) -> Symbol {
        Symbol::new(format!("{}.friction", self.name), Dimension::FORCE)
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

    /// The friction on the body.
    pub(crate) fn friction_term(&self) -> Term {
        let force: Expr = self.friction_symbol().into();
        Term {
            load: format!("{}.friction", self.name),
            law: Law::Friction,
            force: &force * &self.tangent(),
            ..self.term()
        }
    }

    /// `N n`; what N is follows from other loads where the surface is rigid.
    pub(crate) fn statement(&self) -> Statement {
        along(&self.term(), self.force_symbol(), "n", &self.normal)
    }

    /// `f t`, where there is friction.
    pub(crate) fn friction_statement(&self) -> Option<Statement> {
        let rubs = || along(&self.friction_term(), self.friction_symbol(), "t", &self.tangent());
        self.friction.is_some().then(rubs)
    }

    /// The condition that it does not slip. How far it has slipped before is nothing to it: it has a rate only.
    pub(crate) fn slip_row(&self) -> Row {
        let (body, arm, force) = (self.body, self.arm(), self.tangent());
        Row {
            multiplier: self.friction_symbol(),
            wrenches: vec![Wrench { body, arm, force, couple: Expr::zero() }],
            position: Expr::zero(),
            rate: self.slip_rate(),
            acceleration: self.slip_acceleration(),
            measure: Measure::Length,
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
        match pivot {
            _ if !self.is_fixed() => None,
            None => Some(vec![self.normal.x().clone(), self.normal.y().clone(), self.centre.arm.norm()]),
            Some(pivot) if moves(&pivot.world) => None,
            Some(pivot) => Some(vec![(&self.centre.arm - &body.at(&pivot.point).arm).norm()]),
        }
    }

    /// Whether the surface is at rest for good.
    pub(crate) fn is_fixed(&self) -> bool {
        !(moves(&self.through) || moves(&self.normal))
    }

    /// Whether it touches by a round rim, which rolls where it does not slip.
    pub fn is_round(&self) -> bool {
        !is_identically_zero(&self.radius)
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
            Watched::Slip => "slip",
            Watched::Cone(Way::Forward) => "cone forward",
            Watched::Cone(Way::Backward) => "cone backward",
            Watched::Wedge => "wedge",
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
    /// The rate at which it slips.
    Slip,
    /// What friction could still have more before it slips that way.
    Cone(Way),
    /// How a push moves the contact while it slips.
    Wedge,
}

/// Whether a place or a direction is a formula of the time.
pub(crate) fn moves(v: &Vector) -> bool {
    let t = time_symbol();
    v.components().iter().any(|part| part.symbols().contains(&t))
}

/// A vector turned clockwise by a right angle.
fn turned(v: &Vector) -> Vector {
    Vector::planar(v.y().clone(), -v.x())
}

fn dot(a: &Vector, b: &Vector) -> Expr {
    a.x() * b.x() + a.y() * b.y()
}

/// A force along a unit vector.
fn along(term: &Term, force: Symbol, name: &str, unit: &Vector) -> Statement {
    let unit = Written::named(name, Written::Vector(unit.clone()));
    Statement::of(term, Written::Product(vec![Written::Scalar(force.into()), unit]))
}
