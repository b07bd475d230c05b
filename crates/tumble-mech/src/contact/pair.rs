//! # Law
//! A circle of radius r about the body's point p and a surface through P with the unit normal n: the gap is
//! `g = n . (p - P) - r`, its rates follow by differentiating; the force N >= 0 acts along n at the contact point
//! `p - r n`, and its power is `N g'` less what the moving surface adds. Friction acts there along t, n turned clockwise by a right
//! angle (`slipping`).
//!
//! Against a circle of radius R about Q, with `d = p - Q`: from outside `g = |d| - L`, `L = R + r`, `n = d/L`; from inside
//! `g = L - |d|`, `L = R - r`, `n = -d/L`. Rows keep `h = +-(d . d - L^2)/(2 L)` in the place of g, which is zero where g is, with
//! `h' = n . d'` and `h'' = n . d'' +- d' . d'/L`: polynomials, exact where they touch. If Q is a point of another body, that has the
//! opposite forces at `Q +- R n`. What is compliant is pressed into each other, so there `n = +-d/|d|`, `g' = n . d'` and
//! `g'' = n . d'' +- (d' . d' - g'^2)/|d|`.
//! # Symbols and units
//! g, h (m), n, t (1), p, P, Q, d, r, R, L (m), N (N).
//! # Sign and frame
//! World axes; n points out of the solid towards the first body, g is positive apart and negative inside.
//! # Validity
//! Ends, corners and rims of rigid bodies against planes and circles, which may move, and planes tilt, on given paths; rims and points
//! against those of other bodies. Where nothing is compliant n has the length one where they touch.
//! # Source
//! Geometry of a circle and a line, or two circles: what a tilting surface moves by along itself is zero where they touch. The laws of
//! the forces are the surface's.
//! # Checked by
//! `tests/bouncing_rod.rs`, `tests/bouncing_ball.rs`, `tests/moving_floor.rs`, `tests/meeting.rs`, `tests/bowl.rs`,
//! `tests/compliant_bodies.rs`.

mod forces;

use tumble_expr::{Expr, Vector, is_identically_zero};

use crate::anchor::rate;
use crate::body::Body;
use crate::contact::border::Rim;
use crate::contact::opposite::Opposite;
use crate::contact::outlines::Couple;
use crate::contact::said::Said;
use crate::contact::slipping::Level;
use crate::contact::straight::Limit;
use crate::friction::Friction;
use crate::kinematics::PointRef;
use crate::parameters::time_symbol;
use crate::surface::{ContactLaw, Surface};

/// How the unit vectors of a contact are written: along the normal, and along the surface, where t would be read as the time.
pub const NORMAL: &str = "n";
/// See [`NORMAL`].
pub const TANGENT: &str = "e_t";

/// Where in a model it is said that the two of a pair meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rule {
    /// A surface, by its index.
    Surface(usize),
    /// A contact of bodies, by its index.
    Bodies(usize),
}

/// A body, what it meets, and along what: pairs with one of these slip alike.
pub(crate) type Alike = (usize, Rule, Line);

/// What pairs slip along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Line {
    Plane,
    /// An edge, with the other body of the pair.
    Edge(Option<usize>, usize),
    /// None: each of these pairs slips on its own.
    None(usize),
}

/// A point of a body and what it may touch: a surface, or a point of another body.
#[derive(Clone, Debug)]
pub struct Pair {
    /// `floor.rod.tip`, `balls.red.white`
    pub name: String,
    /// What says that they meet.
    pub rule: Rule,
    /// Index of the body.
    pub body: usize,
    /// Index of the other body, if it is none of the world.
    pub other: Option<usize>,
    /// Centre of the circle that touches.
    pub centre: PointRef,
    /// Its radius, m.
    pub radius: Expr,
    /// A point of the surface, or the centre of the other circle, m.
    pub through: Vector,
    /// Unit vector out of the solid, towards the body; of a circle it has that length where they touch.
    pub normal: Vector,
    /// What happens where they touch, by whoever says it.
    pub law: ContactLaw,
    /// Friction along the surface, if it has any.
    pub friction: Option<Friction>,
    /// What of the surface is not said by a point and the normal.
    pub(crate) opposite: Opposite,
    /// Where they may touch, if not everywhere.
    pub(crate) limits: Vec<Limit>,
    /// Where friction acts between the rim of the circle and what it meets, while they are pressed into each other.
    pub(crate) level: Level,
    /// Set of what stands for the rolling resistance of a pair beside it: the radius, m, by which its couple is a force and its rate a
    /// speed. It has the force of the pair, and no gap of its own.
    pub(crate) lever: Option<Expr>,
}

impl Pair {
    pub(crate) fn new(
        (surface_index, surface): (usize, &Surface),
        (body_index, body): (usize, &Body),
        (rim, centre): (&Rim, &PointRef),
        (law, friction): Said,
    ) -> Self {
        let opposite = surface.circle.as_ref().map_or(Opposite::Plane, |circle| {
            Opposite::circle(None, (circle.radius.clone(), circle.inside), &rim.radius, &law)
        });
        Self {
            name: format!("{}.{}.{}", surface.name, body.name, rim.name),
            rule: Rule::Surface(surface_index),
            body: body_index,
            other: None,
            centre: centre.clone(),
            radius: rim.radius.clone(),
            through: surface.through.clone(),
            normal: opposite.normal(centre, &surface.through).unwrap_or_else(|| surface.normal.clone()),
            law,
            friction,
            opposite,
            limits: vec![],
            level: Level::Rim,
            lever: None,
        }
    }

    /// Distance from the surface, m.
    pub fn gap(&self) -> Expr {
        match &self.opposite {
            Opposite::Plane => dot(&self.normal, &self.apart()) - &self.radius,
            Opposite::Edge(edge) => dot(&self.normal, &self.apart()) - &edge.reach,
            Opposite::Circle(circle) => circle.sign() * (self.apart().norm() - &circle.reach),
        }
    }

    /// What is zero with the gap and has as simple a formula as there is: it is the gap itself of a plane or an edge.
    pub(crate) fn closing(&self) -> Expr {
        match &self.opposite {
            Opposite::Plane | Opposite::Edge(_) => self.gap(),
            Opposite::Circle(circle) => {
                let apart = self.apart();
                let beyond = dot(&apart, &apart) - &circle.reach * &circle.reach;
                circle.sign() * beyond / (2 * &circle.reach)
            }
        }
    }

    /// From the point of the surface, or the other centre, to the centre, m.
    fn apart(&self) -> Vector {
        self.opposite.apart(&self.centre, &self.through)
    }

    /// Rate of the gap, m/s.
    pub fn gap_rate(&self) -> Expr {
        let relative = self.centre.velocity() - self.opposite.velocity(&self.through);
        match self.opposite {
            Opposite::Circle(_) => dot(&self.normal, &relative),
            Opposite::Edge(_) => dot(&self.normal, &relative) + dot(&self.turning(), &self.apart()),
            Opposite::Plane => {
                let tilting = dot(&rate(&self.normal), &(self.centre.position() - &self.through));
                dot(&self.normal, &relative) + tilting
            }
        }
    }

    /// Second derivative of the gap, m/s^2, in the bodies' accelerations.
    pub fn gap_acceleration(&self) -> Expr {
        let relative = self.centre.acceleration() - self.opposite.acceleration(&self.through);
        if let Opposite::Circle(circle) = &self.opposite {
            let velocity = self.centre.velocity() - self.opposite.velocity(&self.through);
            let across = circle.across(&velocity, &self.normal);
            return dot(&self.normal, &relative)
                + circle.sign() * dot(&velocity, &across) / circle.distance(&self.apart());
        }
        if let Opposite::Edge(edge) = &self.opposite {
            let velocity = self.centre.velocity() - self.opposite.velocity(&self.through);
            let coriolis = 2 * dot(&self.turning(), &velocity);
            return dot(&self.normal, &relative)
                + coriolis
                + dot(&edge.turning_rate(&self.normal), &self.apart());
        }
        let turning = rate(&self.normal);
        let coriolis = 2 * dot(&turning, &(self.centre.velocity() - rate(&self.through)));
        let tilting = dot(&rate(&turning), &(self.centre.position() - &self.through));
        dot(&self.normal, &relative) + coriolis + tilting
    }

    /// How the normal turns, 1/s.
    pub(super) fn turning(&self) -> Vector {
        match &self.opposite {
            Opposite::Plane => rate(&self.normal),
            Opposite::Edge(edge) => edge.turning(&self.normal),
            Opposite::Circle(circle) => {
                let velocity = self.centre.velocity() - self.opposite.velocity(&self.through);
                let distance = circle.distance(&self.apart());
                circle.across(&velocity, &self.normal).map(|part| circle.sign() * part / &distance)
            }
        }
    }

    /// From the body's centre of mass to the point that touches, m, world axes.
    pub fn arm(&self) -> Vector {
        self.arm_to(|radius| radius.clone())
    }

    /// The same to the point of the line of the normal force that is a lever away from the centre of the circle that touches, m; the lever
    /// is a formula of its radius.
    pub(super) fn arm_to(&self, lever: impl Fn(&Expr) -> Expr) -> Vector {
        match &self.opposite {
            Opposite::Edge(edge) if edge.is_first => {
                let own = self.centre.body.position();
                let centre = match &edge.other {
                    Some(other) => other.body.position() - own + other.world_arm(),
                    None => &self.through - own,
                };
                centre + &lever(&edge.radius) * &self.normal
            }
            _ => self.centre.world_arm() - &lever(&self.radius) * &self.normal,
        }
    }

    /// The same of the other body.
    pub fn other_arm(&self) -> Option<Vector> {
        let other = self.opposite.point()?;
        match &self.opposite {
            Opposite::Plane => None,
            Opposite::Circle(circle) => {
                Some(other.world_arm() + &(circle.sign() * &circle.radius) * &self.normal)
            }
            Opposite::Edge(edge) if edge.is_first => Some(other.world_arm() + &edge.radius * &self.normal),
            Opposite::Edge(_) => Some(self.centre.body.position() - other.body.position() + self.arm()),
        }
    }

    /// The arm of one of its bodies.
    pub(crate) fn arm_of(&self, body: usize) -> Vector {
        self.other_arm().filter(|_| self.other == Some(body)).unwrap_or_else(|| self.arm())
    }

    /// The bodies, the one that the normal points to first.
    pub fn bodies(&self) -> impl Iterator<Item = usize> + use<> {
        std::iter::once(self.body).chain(self.other)
    }

    /// The two that meet by it.
    pub(crate) fn couple(&self) -> Couple {
        (self.rule, self.body, self.other)
    }

    /// Makes its bodies neighbours of each other.
    pub(crate) fn join(&self, neighbours: &mut [Vec<usize>]) {
        if let Some(other) = self.other {
            neighbours[self.body].push(other);
            neighbours[other].push(self.body);
        }
    }

    /// Whether it is of a body.
    pub fn has(&self, body: usize) -> bool {
        self.body == body || self.other == Some(body)
    }

    /// What it has in common with those that slip alike: all points of a body on one plane do; `own` is its index.
    pub(crate) fn slips_with(&self, own: usize) -> Alike {
        let line = match &self.opposite {
            _ if self.is_rolling() => Line::None(own),
            Opposite::Plane => Line::Plane,
            Opposite::Edge(edge) => Line::Edge(self.other, edge.line),
            Opposite::Circle(_) => Line::None(own),
        };
        (self.body, self.rule, line)
    }

    /// Each body with the sign of the forces on it.
    pub(crate) fn sides(&self) -> impl Iterator<Item = (usize, i32)> + use<> {
        self.bodies().zip([1, -1])
    }

    /// The point that touches, m.
    pub fn point(&self) -> Vector {
        self.centre.body.position() + self.arm()
    }

    /// A length that its gap is measured from besides its places, m.
    pub(crate) fn extent(&self) -> Expr {
        match &self.opposite {
            Opposite::Plane => Expr::zero(),
            Opposite::Circle(circle) => circle.radius.clone(),
            Opposite::Edge(edge) => edge.reach.clone(),
        }
    }

    /// Lengths that its gap is a difference of, added up, m.
    pub(crate) fn extents(&self) -> Expr {
        let other = self.opposite.position(&self.through).norm();
        self.centre.position().norm() + other + &self.radius + self.extent()
    }

    /// Unit vector along the surface, its normal turned clockwise by a right angle.
    pub fn tangent(&self) -> Vector {
        turned(&self.normal)
    }

    /// What stands for its rolling resistance, if it has any.
    pub(crate) fn rolling(&self) -> Option<Self> {
        let lever = match &self.opposite {
            _ if !is_identically_zero(&self.radius) => self.radius.clone(),
            Opposite::Circle(circle) => circle.radius.clone(),
            Opposite::Edge(edge) => edge.radius.clone(),
            Opposite::Plane => Expr::zero(),
        };
        let length = self.friction.as_ref()?.rolling.as_ref()?;
        let friction = Friction::new(length / &lever);
        let is_round = self.is_round() && self.is_rigid() && !is_identically_zero(&lever);
        is_round.then(|| Self { friction: Some(friction), lever: Some(lever), ..self.clone() })
    }

    /// The couple against rolling, N m, of what stands for that.
    pub fn rolling_couple(&self) -> Option<Expr> {
        self.lever.as_ref().map(|lever| lever * Expr::from(self.friction_symbol()))
    }

    /// Whether it stands for a rolling resistance.
    pub fn is_rolling(&self) -> bool {
        self.lever.is_some()
    }

    /// Whether its forces along the normal go through the centres of mass of its bodies, so that they turn nothing.
    pub(crate) fn is_central(&self) -> bool {
        let is_centre = |point: &PointRef| point.arm.components().iter().all(is_identically_zero);
        let other = match &self.opposite {
            Opposite::Edge(edge) => !edge.is_first && self.other.is_none(),
            _ => self.opposite.point().is_none_or(is_centre),
        };
        is_centre(&self.centre) && other
    }

    /// Whether the surface is at rest for good.
    pub(crate) fn is_fixed(&self) -> bool {
        !(moves(&self.through) || moves(&self.normal))
    }

    /// Whether one of the two is an edge.
    pub(crate) fn has_edge(&self) -> bool {
        matches!(self.opposite, Opposite::Edge(_))
    }

    /// Whether it touches by a round rim, which rolls where it does not slip.
    pub fn is_round(&self) -> bool {
        match &self.opposite {
            Opposite::Edge(edge) if edge.is_first => !is_identically_zero(&edge.radius),
            Opposite::Edge(_) => !is_identically_zero(&self.radius),
            _ => !is_identically_zero(&self.radius) || self.other.is_some(),
        }
    }

    /// Whether the surface is rigid.
    pub fn is_rigid(&self) -> bool {
        self.law.is_rigid()
    }

    pub(crate) fn is_hertzian(&self) -> bool {
        self.law.is_hertzian()
    }

    /// Whether it may end while it is pressed in, so that what is stored there stays there.
    pub(crate) fn may_keep_energy(&self) -> bool {
        self.releases_early() || !self.limits.is_empty()
    }

    /// Whether a body that is let go may still be inside the surface.
    pub(crate) fn releases_early(&self) -> bool {
        self.law.releases_early()
    }
}

/// Whether a place or a direction is a formula of the time.
pub(crate) fn moves(v: &Vector) -> bool {
    let t = time_symbol();
    v.components().iter().any(|part| part.symbols().contains(&t))
}

/// A vector turned clockwise by a right angle.
pub(super) fn turned(v: &Vector) -> Vector {
    Vector::planar(v.y().clone(), -v.x())
}

pub(super) fn dot(a: &Vector, b: &Vector) -> Expr {
    a.x() * b.x() + a.y() * b.y()
}
