//! What is watched of pairs: their gaps while they are apart, and what ends a contact.

use tumble_expr::{Expr, Vector};

use crate::body::Body;
use crate::contact::grip::Way;
use crate::contact::opposite::Opposite;
use crate::contact::pair::{Pair, dot, moves};
use crate::contact::straight::{Limit, greater};
use crate::coordinates::Pivot;
use crate::kinematics::Kinematics;

/// What of a pair is watched for crossing zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Watched {
    /// Its gap.
    Gap,
    /// How far a Hertzian contact is from the depth up to which it may have no force.
    Depth,
    /// How far one of several is from the depth up to which it may have none again.
    Shallow,
    /// How far one without force yet is from being as far out.
    Out,
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
    /// How far it is from leaving where there may be a contact, by one of its limits.
    Limit(usize),
}

impl Pair {
    /// What is watched for zero while they are apart: it changes with no coordinate faster than [`Self::slopes`]. From inside a
    /// circle that is as true of the polynomial, which is smooth where the centres meet.
    pub(crate) fn watched(&self) -> Expr {
        match &self.opposite {
            Opposite::Circle(circle) if circle.inside => self.closing(),
            _ => self.gap(),
        }
    }

    /// What must not be negative for what is watched to be a contact.
    pub(crate) fn conditions(&self) -> Vec<Expr> {
        let is_near = match &self.opposite {
            Opposite::Edge(edge) => edge.around.as_ref().map(|around| {
                let rim = if edge.is_first {
                    self.opposite.position(&self.through)
                } else {
                    self.centre.position()
                };
                let away =
                    rim - edge.owner.as_ref().map_or_else(|| self.through.clone(), Kinematics::position);
                (around * around - dot(&away, &away)) / (2 * around)
            }),
            _ => None,
        };
        self.limits.iter().map(Limit::entered).chain(is_near).collect()
    }

    /// What is not negative where they may touch, m; nothing where they may everywhere.
    pub fn within(&self) -> Vec<Expr> {
        self.limits.iter().map(Limit::holding).collect()
    }

    /// What is not negative where they may take over from another contact of the same two, m.
    pub(crate) fn taken_within(&self) -> Vec<Expr> {
        self.limits.iter().map(Limit::taken).collect()
    }

    /// What becomes negative where a contact that lasts ends by leaving where there may be one.
    pub(crate) fn leaving(&self) -> Vec<Expr> {
        self.limits.iter().filter_map(Limit::left).collect()
    }

    /// How fast what is watched, and its conditions, can change with each coordinate of one of its bodies: of x, of y and of the angle for a free body,
    /// of the angle for a pivoted one. `None` where the surface or the pivot moves.
    pub(crate) fn slopes(&self, index: usize, pivot: Option<&Pivot>, body: &Body) -> Option<Vec<Expr>> {
        if let Opposite::Edge(edge) = &self.opposite
            && let Some(around) = &edge.around
        {
            return self.slopes_near(index, pivot, body, edge.is_first == (index == self.body), around);
        }
        let point = self.opposite.point().filter(|_| self.other == Some(index)).unwrap_or(&self.centre);
        let along = match &self.opposite {
            Opposite::Plane => [self.normal.x().clone(), self.normal.y().clone()],
            Opposite::Circle(_) | Opposite::Edge(_) => [Expr::one(), Expr::one()],
        };
        match pivot {
            _ if !self.is_fixed() => None,
            None => Some(along.into_iter().chain([point.arm.norm() + self.swept()]).collect()),
            Some(pivot) if moves(&pivot.world) => None,
            Some(pivot) => Some(vec![(&point.arm - &body.at(&pivot.point).arm).norm() + self.swept()]),
        }
    }

    /// By how much conditions that only turn change with an angle, m: the longest edge beside a corner that meets an edge.
    fn swept(&self) -> Expr {
        self.limits.iter().filter_map(Limit::turns).cloned().reduce(greater).unwrap_or_else(Expr::zero)
    }

    /// The same of a pair with an edge that turns, as long as the circle is within the edge's reach of its body: what is watched is then at
    /// most twice as fast as it.
    fn slopes_near(
        &self,
        index: usize,
        pivot: Option<&Pivot>,
        body: &Body,
        is_edge: bool,
        around: &Expr,
    ) -> Option<Vec<Expr>> {
        let point = self.opposite.point().filter(|_| self.other == Some(index)).unwrap_or(&self.centre);
        let lever = |from: Option<&Vector>| match (is_edge, from) {
            (true, None) => 2 * around,
            (true, Some(from)) => 2 * around + 2 * from.norm(),
            (false, None) => 2 * point.arm.norm(),
            (false, Some(from)) => 2 * (&point.arm - from).norm(),
        };
        match pivot {
            _ if !self.is_fixed() => None,
            None => Some(vec![Expr::from(2), Expr::from(2), lever(None) + self.swept()]),
            Some(pivot) if moves(&pivot.world) => None,
            Some(pivot) => Some(vec![lever(Some(&body.at(&pivot.point).arm)) + self.swept()]),
        }
    }

    /// Up to which size what is watched changes no faster than [`Self::slopes`], where there is a bound to that.
    pub(crate) fn slopes_reach(&self) -> Option<&Expr> {
        match &self.opposite {
            Opposite::Edge(edge) => edge.around.as_ref(),
            _ => None,
        }
    }

    /// Kept apart, gaps and forces have names by which the integrator knows them in every mode.
    pub(crate) fn guard_name(&self, of: Watched) -> String {
        let what = match of {
            Watched::Slip if self.is_rolling() => "rolling",
            Watched::Cone(Way::Forward) if self.is_rolling() => "rolling forward",
            Watched::Cone(Way::Backward) if self.is_rolling() => "rolling backward",
            Watched::Gap => "gap",
            Watched::Depth => "depth",
            Watched::Shallow => "shallow",
            Watched::Out => "out",
            Watched::Force => "force",
            Watched::Normal => "normal",
            Watched::Slip => "slip",
            Watched::Cone(Way::Forward) => "cone forward",
            Watched::Cone(Way::Backward) => "cone backward",
            Watched::Wedge => "wedge",
            Watched::Limit(limit) => return format!("{}.limit{limit}", self.name),
        };
        format!("{}.{what}", self.name)
    }
}
