//! Surfaces that bodies meet: floors, walls, slopes, bowls and poles, at rest or moved on a given path.

use tumble_expr::{Dimension, Expr, Vector, is_identically_zero};

use crate::body::Body;
use crate::contact::{Border, Feature, Rim};
use crate::friction::Friction;

/// A half-plane that is solid behind its surface, or a circle that is solid inside or outside.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Its name.
    pub name: String,
    /// A point on it, or the centre of a circle, m, world axes; a formula of the time where it moves.
    pub through: Vector,
    /// Unit vector out of the solid, world axes; a formula of the time where it tilts. Nothing of a circle.
    pub normal: Vector,
    /// Set where it is a circle.
    pub circle: Option<Round>,
    /// Corners of a convex polygon that is solid inside, counter-clockwise, m, where it is one: a step, a rail.
    pub polygon: Option<Vec<Vector>>,
    /// What happens where a body touches it.
    pub law: ContactLaw,
    /// Dry friction along it; none where nothing is said.
    pub friction: Option<Friction>,
    /// What meets it: names of bodies, `rod`, and of single points by which a body touches, `rod.tip`; `None` is all.
    pub on: Option<Vec<String>>,
}

/// A circle that bodies meet.
#[derive(Clone, Debug)]
pub struct Round {
    /// m
    pub radius: Expr,
    /// Whether it is hollow, and met from inside, as a bowl is.
    pub inside: bool,
}

/// What a surface does across itself to what touches it.
#[derive(Clone, Debug)]
pub enum ContactLaw {
    /// Compliant, like a spring with a damper that never pulls.
    Spring {
        /// N/m
        stiffness: Expr,
        /// kg/s
        damping: Expr,
        /// When the contact ends.
        release: Release,
    },
    /// Compliant, like two bodies with round surfaces.
    Hertz {
        /// N/m^(3/2)
        stiffness: Expr,
        /// Hunt and Crossley's damping: the force is multiplied by `1 + damping * speed`. s/m
        damping: Expr,
    },
    /// Not compliant.
    Rigid {
        /// Impulse while separating over impulse while approaching, 0 to 1.
        restitution: Expr,
    },
}

/// When a contact with a damped spring ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Release {
    /// When the force has come down to zero; the surface recovers on its own.
    AtZeroForce,
    /// When the body has come back to the undeformed surface; damping may pull just before.
    AtSurface,
}

impl Surface {
    /// A surface through a point, m, that looks along `normal`, a vector of any length.
    pub fn new(name: impl Into<String>, through: [Expr; 2], [x, y]: [Expr; 2], law: ContactLaw) -> Self {
        let [px, py] = through;
        let normal = Vector::planar(x, y);
        let length = normal.norm();
        Self {
            name: name.into(),
            through: Vector::planar(px, py),
            normal: normal.map(|component| component / &length),
            circle: None,
            polygon: None,
            law,
            friction: None,
            on: None,
        }
    }

    /// A circle about a point, m, that is solid inside: a wheel, a pole.
    pub fn circle(name: impl Into<String>, centre: [Expr; 2], radius: Expr, law: ContactLaw) -> Self {
        let circle = Some(Round { radius, inside: false });
        Self { circle, ..Self::new(name, centre, [Expr::zero(), Expr::one()], law) }
    }

    /// The same, solid outside and met from inside: a bowl.
    pub fn bowl(name: impl Into<String>, centre: [Expr; 2], radius: Expr, law: ContactLaw) -> Self {
        let circle = Some(Round { radius: radius.clone(), inside: true });
        Self { circle, ..Self::circle(name, centre, radius, law) }
    }

    /// A convex polygon at rest with these corners, m, counter-clockwise: a step, a rail.
    pub fn polygon(name: impl Into<String>, corners: Vec<Vector>, law: ContactLaw) -> Self {
        let nowhere = || Vector::planar(Expr::zero(), Expr::zero());
        let [x, y] = [0, 1]
            .map(|axis| corners.first().map_or_else(|| nowhere()[axis].clone(), |first| first[axis].clone()));
        Self { polygon: Some(corners), ..Self::new(name, [x, y], [Expr::zero(), Expr::one()], law) }
    }

    /// A surface through a point, m, that rises to the right by `angle`; at zero it is a floor.
    pub fn sloping(name: impl Into<String>, through: [Expr; 2], angle: &Expr, law: ContactLaw) -> Self {
        let [px, py] = through;
        Self {
            name: name.into(),
            through: Vector::planar(px, py),
            normal: Vector::planar(-angle.sin(), angle.cos()),
            circle: None,
            polygon: None,
            law,
            friction: None,
            on: None,
        }
    }

    /// A level floor at the height y, m.
    pub fn floor(name: impl Into<String>, height: Expr, law: ContactLaw) -> Self {
        Self::new(name, [Expr::zero(), height], [Expr::zero(), Expr::one()], law)
    }

    /// The same with friction.
    pub fn with_friction(self, friction: Friction) -> Self {
        Self { friction: Some(friction), ..self }
    }

    /// What of a body meets it: all of it, or the points that are named.
    pub(crate) fn met_of(&self, body: &Body, border: &Border) -> Border {
        if self.meets_all_of(body) {
            return border.clone();
        }
        let is_met = |rim: &&Rim| self.meets_by(body, &rim.name);
        Border { rims: border.rims.iter().filter(is_met).cloned().collect(), edges: vec![] }
    }

    /// Whether all of a body meets it.
    pub(crate) fn meets_all_of(&self, body: &Body) -> bool {
        self.on.as_ref().is_none_or(|names| names.contains(&body.name))
    }

    /// Whether it is a plane behind which no part of a body comes.
    pub(crate) fn hides_from(&self, body: &Body) -> bool {
        self.circle.is_none() && self.polygon.is_none() && self.meets_all_of(body)
    }

    /// Whether a place is on a plane or behind it, whatever the parameters are.
    pub(crate) fn has_behind(&self, place: &Vector) -> bool {
        let from = place - &self.through;
        let height = from.x() * self.normal.x() + from.y() * self.normal.y();
        let zero = Expr::zero();
        is_identically_zero(&height)
            || (height.as_number().is_some() && height.as_number() <= zero.as_number())
    }

    fn meets_by(&self, body: &Body, point: &str) -> bool {
        let is_meant = |name: &String| *name == body.name || is_at(name, body, point);
        self.on.as_ref().is_none_or(|names| names.iter().any(is_meant))
    }

    /// Whether a body meets it, by any of its points.
    pub fn meets(&self, body: &Body) -> bool {
        body.features().iter().any(|feature| self.meets_at(body, feature))
    }

    /// Whether a body meets it by this point.
    pub fn meets_at(&self, body: &Body, feature: &Feature) -> bool {
        self.meets_by(body, &feature.name)
    }
}

/// Whether a name, such as `rod.tip`, is that of a point by which a body touches.
pub(crate) fn is_at(name: &str, body: &Body, point: &str) -> bool {
    let rest = name.strip_prefix(&body.name).and_then(|rest| rest.strip_prefix('.'));
    rest == Some(point)
}

impl ContactLaw {
    /// Whether it does not yield.
    pub fn is_rigid(&self) -> bool {
        matches!(self, Self::Rigid { .. })
    }

    /// Whether the root of the depth is a state under it.
    pub(crate) fn is_hertzian(&self) -> bool {
        matches!(self, Self::Hertz { .. })
    }

    /// Whether what is let go may still be inside the surface.
    pub(crate) fn releases_early(&self) -> bool {
        match self {
            Self::Spring { damping, release: Release::AtZeroForce, .. } | Self::Hertz { damping, .. } => {
                !is_identically_zero(damping)
            }
            Self::Spring { .. } | Self::Rigid { .. } => false,
        }
    }

    /// Whether it may pull before it lets go.
    pub(crate) fn may_pull(&self) -> bool {
        matches!(self, Self::Spring { damping, release: Release::AtSurface, .. } if !is_identically_zero(damping))
    }

    /// What is left of a velocity of approach by a rigid surface.
    pub(crate) fn restitution(&self) -> Option<&Expr> {
        match self {
            Self::Rigid { restitution } => Some(restitution),
            Self::Spring { .. } | Self::Hertz { .. } => None,
        }
    }

    /// The same with a restitution that others say, if it has one.
    pub(crate) fn with_restitution(&self, said: Option<&Expr>) -> Self {
        match (self, said) {
            (Self::Rigid { .. }, Some(own)) => Self::Rigid { restitution: own.clone() },
            (law, _) => law.clone(),
        }
    }

    /// Stiffness and damping of a compliant surface.
    pub(crate) fn coefficients(&self) -> Option<(&Expr, &Expr)> {
        match self {
            Self::Spring { stiffness, damping, .. } | Self::Hertz { stiffness, damping } => {
                Some((stiffness, damping))
            }
            Self::Rigid { .. } => None,
        }
    }

    /// Coefficients: key, formula, dimension it must have.
    pub(crate) fn dimensions(&self) -> Vec<(&'static str, &Expr, Dimension)> {
        match self {
            Self::Spring { stiffness, damping, .. } => vec![
                ("stiffness", stiffness, Dimension::new(0, 1, -2)),
                ("damping", damping, Dimension::new(0, 1, -1)),
            ],
            Self::Hertz { stiffness, damping } => vec![
                ("stiffness", stiffness, hertz_stiffness()),
                ("damping", damping, Dimension::new(-1, 0, 1)),
            ],
            Self::Rigid { restitution } => vec![("restitution", restitution, Dimension::NONE)],
        }
    }
}

/// N/m^(3/2)
fn hertz_stiffness() -> Dimension {
    let exponent = tumble_expr::Exponent::new(-1, 2);
    Dimension { length: exponent, ..Dimension::FORCE }
}
