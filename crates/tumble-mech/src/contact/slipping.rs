//! # Law
//! Friction F acts along t, a pair's normal n turned clockwise by a right angle. The rate of slip is `t . (v - w)`, with v and w the
//! velocities of the material points of both where it acts. It acts at x = `p - r n`, where the circle of radius r about p touches.
//!
//! What is compliant is pressed in where the gap g is negative. Friction acts on both at one point `x = p - (r + s g) n` of the line of the
//! normal force. On a body that touches by one round rim alone, such as a ball, it is on that rim, `s = 0`, which rolls with
//! `v = -omega r`; between two such bodies, and two ends of rods, it is half way, `s = 1/2`. A body that has several contact points has them
//! at different depths, and if each stuck by itself it could not turn. There friction acts where the plane or edge is when nothing presses
//! it, `s = 1`: all points on it have one lever there and slip alike, as they do where it is rigid.
//!
//! The slip's derivative is `t . (v' - w') + t' . (v - w)`, with `v' = a + alpha x (x - c) + omega x (x' - c')` of the body with the centre of
//! mass c.
//! # Symbols and units
//! g, r, p, x, c (m), n, t, s (1), v, w (m/s), F (N), alpha (1/s^2), omega (1/s), a (m/s^2).
//! # Sign and frame
//! World axes; F acts along t on the first body and against it on the other.
//! # Validity
//! As the pair's. Surfaces of the world move as a whole, and do not turn what they rub.
//! # Source
//! Kinematics of rigid bodies; where a compliant contact acts within its depth is a convention, and the half way of two bodies is that of
//! the discrete element method: Cundall and Strack 1979.
//! # Checked by
//! `tests/compliant_friction.rs`, `tests/compliant_bodies.rs`, `tests/friction.rs`, `tests/rolling.rs`.

use tumble_expr::{Expr, Vector};

use crate::anchor::rate;
use crate::contact::opposite::Opposite;
use crate::contact::pair::{Pair, dot, turned};
use crate::kinematics::Kinematics;

/// Where friction acts along the depth of a compliant contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// On the rim of the circle that touches.
    Rim,
    /// Half way between both rims.
    Middle,
    /// Where what it meets would be if nothing pressed it.
    Surface,
}

impl Pair {
    /// From the first body's centre of mass to where friction acts on it, m, world axes.
    pub(crate) fn slip_arm(&self) -> Vector {
        self.arm_to(|radius| self.lever_of(radius))
    }

    /// Distance of where friction acts from the centre of a circle of that radius which touches, m.
    fn lever_of(&self, radius: &Expr) -> Expr {
        match self.level {
            Level::Rim => radius.clone(),
            Level::Middle => radius + self.gap() / 2,
            Level::Surface => radius + self.gap(),
        }
    }

    /// The same of one of its bodies.
    pub(crate) fn slip_arm_of(&self, body: usize) -> Vector {
        match self.opposite.point().filter(|_| self.other == Some(body)) {
            // Both are rubbed at one point, however deep they are in each other.
            Some(other) if !self.is_rigid() => {
                self.centre.body.position() - other.body.position() + self.slip_arm()
            }
            Some(_) => self.arm_of(body),
            None => self.slip_arm(),
        }
    }

    /// Of the first body less what it turns against, 1/s; `body` is what is known of bodies, `turning` the same of a plane that tilts.
    fn relative(&self, body: fn(&Kinematics) -> Expr, turning: Expr) -> Expr {
        let other = match (self.other, self.opposite.point(), &self.opposite) {
            (Some(_), Some(point), _) => body(&point.body),
            (_, _, Opposite::Plane) => turning,
            _ => Expr::zero(),
        };
        body(&self.centre.body) - other
    }

    /// Rate at which the body's point slips along the surface, m/s.
    pub fn slip_rate(&self) -> Expr {
        if let Some(lever) = &self.lever {
            return lever * self.relative(Kinematics::omega, self.normal.cross_planar(&rate(&self.normal)));
        }
        dot(&self.tangent(), &self.slipping())
    }

    /// Its derivative, m/s^2, in the bodies' accelerations.
    pub fn slip_acceleration(&self) -> Expr {
        if let Some(lever) = &self.lever {
            let turning = self.normal.cross_planar(&rate(&rate(&self.normal)));
            return lever * self.relative(Kinematics::alpha, turning);
        }
        let motion = &self.centre.body;
        let (omega, arm) = (motion.omega(), self.slip_arm());
        let normal_turns = self.turning();
        let own = motion.acceleration()
            + motion.alpha() * arm.perpendicular()
            + &omega * self.moving(&normal_turns).perpendicular();
        let tilting = dot(&turned(&normal_turns), &self.slipping());
        dot(&self.tangent(), &(own - self.opposite.material_acceleration(self, &normal_turns))) + tilting
    }

    /// Velocity of the point where friction acts less that of the body's centre of mass, m/s, while the normal turns so, 1/s.
    pub(crate) fn moving(&self, turning: &Vector) -> Vector {
        let motion = &self.centre.body;
        let lever = |radius: &Expr| {
            let lever = self.lever_of(radius) * turning;
            match self.level {
                Level::Rim => lever,
                Level::Middle => lever + &(self.gap_rate() / 2) * &self.normal,
                Level::Surface => lever + &self.gap_rate() * &self.normal,
            }
        };
        match &self.opposite {
            Opposite::Edge(edge) if edge.is_first => {
                self.opposite.velocity(&self.through) - motion.velocity() + lever(&edge.radius)
            }
            _ => motion.omega() * self.centre.world_arm().perpendicular() - lever(&self.radius),
        }
    }

    /// Velocity of the body's material point less that of the surface, m/s.
    fn slipping(&self) -> Vector {
        self.material_velocity() - self.opposite.material_velocity(self)
    }

    /// Velocity of the body's material point that friction acts at, m/s.
    pub(crate) fn material_velocity(&self) -> Vector {
        let motion = &self.centre.body;
        motion.velocity() + motion.omega() * self.slip_arm().perpendicular()
    }
}
