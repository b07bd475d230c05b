//! What a point of a body may touch: a plane, a circle of the world or of another body, from outside or inside, or an edge.

use tumble_expr::{Expr, Vector};

use crate::anchor::rate;
use crate::contact::pair::{Pair, dot};
use crate::contact::straight::Straight;
use crate::kinematics::PointRef;
use crate::surface::ContactLaw;

/// The other one of a pair.
#[derive(Clone, Debug)]
pub(crate) enum Opposite {
    Plane,
    Circle(Circle),
    Edge(Straight),
}

/// A circle that a circle of a body may touch.
#[derive(Clone, Debug)]
pub(crate) struct Circle {
    /// Its centre, where it is a point of a body.
    pub(crate) centre: Option<PointRef>,
    /// m
    pub(crate) radius: Expr,
    /// Whether it is touched from inside, as a bowl is.
    pub(crate) inside: bool,
    /// Distance of the centres while they touch, m.
    pub(crate) reach: Expr,
    /// Whether they may be pressed into each other.
    yields: bool,
}

impl Circle {
    /// 1 where the gap grows with the distance of the centres.
    pub(crate) fn sign(&self) -> i32 {
        if self.inside { -1 } else { 1 }
    }

    /// Distance of the centres in a contact, m; `apart` is from one to the other.
    pub(crate) fn distance(&self, apart: &Vector) -> Expr {
        if self.yields { apart.norm() } else { self.reach.clone() }
    }

    /// What turns the normal of a velocity: where nothing is pressed in, all of it does.
    pub(crate) fn across(&self, velocity: &Vector, normal: &Vector) -> Vector {
        if self.yields { velocity - &dot(normal, velocity) * normal } else { velocity.clone() }
    }
}

impl Opposite {
    /// A circle that one of radius `own`, m, touches.
    pub(crate) fn circle(
        centre: Option<PointRef>,
        (radius, inside): (Expr, bool),
        own: &Expr,
        law: &ContactLaw,
    ) -> Self {
        let reach = if inside { &radius - own } else { &radius + own };
        Self::Circle(Circle { centre, radius, inside, reach, yields: !law.is_rigid() })
    }

    /// Towards a body whose circle has this centre; `None` of what is no circle.
    pub(crate) fn normal(&self, centre: &PointRef, through: &Vector) -> Option<Vector> {
        let Self::Circle(circle) = self else { return None };
        let apart = self.apart(centre, through);
        let distance = circle.distance(&apart);
        Some(apart.map(|part| circle.sign() * part / &distance))
    }

    /// From its point, or from `through` where that is none of a body's, to a body's, m.
    pub(crate) fn apart(&self, centre: &PointRef, through: &Vector) -> Vector {
        // Far from the origin the difference of the places is exact; what the arm is added to before would be rounded.
        let place = centre.body.position();
        match self.point() {
            None => place - through + centre.world_arm(),
            Some(other) => place - other.body.position() + (centre.world_arm() - other.world_arm()),
        }
    }

    /// Its centre or the point that it is given by, where that is a point of a body.
    pub(crate) fn point(&self) -> Option<&PointRef> {
        match self {
            Self::Plane => None,
            Self::Circle(circle) => circle.centre.as_ref(),
            Self::Edge(edge) => edge.other.as_ref(),
        }
    }

    /// Its point or centre, which is at `through` where it is none of a body's, m.
    pub(crate) fn position(&self, through: &Vector) -> Vector {
        self.point().map_or_else(|| through.clone(), PointRef::position)
    }

    /// Velocity of its point or centre, which is at `through` where it is none of a body's, m/s.
    pub(crate) fn velocity(&self, through: &Vector) -> Vector {
        self.point().map_or_else(|| rate(through), PointRef::velocity)
    }

    /// The same for the acceleration, m/s^2.
    pub(crate) fn acceleration(&self, through: &Vector) -> Vector {
        self.point().map_or_else(|| rate(&rate(through)), PointRef::acceleration)
    }

    /// Velocity of its material point where a pair rubs, m/s.
    pub(crate) fn material_velocity(&self, pair: &Pair) -> Vector {
        match (self.point(), self.slip_arm(pair)) {
            (Some(point), Some(arm)) => point.body.velocity() + point.body.omega() * arm.perpendicular(),
            _ => rate(&pair.through),
        }
    }

    /// From the centre of mass of the other body to where friction acts on it, m, world axes.
    fn slip_arm(&self, pair: &Pair) -> Option<Vector> {
        pair.other.map(|other| pair.slip_arm_of(other))
    }

    /// Derivative of that velocity, m/s^2, while the normal turns so, 1/s.
    pub(crate) fn material_acceleration(&self, pair: &Pair, turning: &Vector) -> Vector {
        let (Some(point), Some(arm)) = (self.point(), self.slip_arm(pair)) else {
            return rate(&rate(&pair.through));
        };
        let omega = point.body.omega();
        let own = || &omega * point.world_arm().perpendicular();
        let moving = match self {
            _ if !pair.is_rigid() => {
                pair.centre.body.velocity() - point.body.velocity() + pair.moving(turning)
            }
            Self::Circle(circle) => own() + &(circle.sign() * &circle.radius) * turning,
            Self::Edge(edge) if edge.is_first => own() + &edge.radius * turning,
            _ => pair.centre.velocity() - point.body.velocity() - &pair.radius * turning,
        };
        point.body.acceleration() + point.body.alpha() * arm.perpendicular() + omega * moving.perpendicular()
    }
}
