//! # Law
//! A circle of radius r about p and a straight edge of another body or of the world, thick by R to each side, from P along the unit
//! vector u over the length L, with the outward normal m: the gap is `m . (p - P) - (r + R)`. The edge turns with its body,
//! `m' = omega x m` and `m'' = alpha x m - omega^2 m`, so `g' = m . (p' - P') + m' . (p - P)` and
//! `g'' = m . (p'' - P'') + 2 m' . (p' - P') + m'' . (p - P)`. Both bodies are pushed at one point, `p - r m`, along m.
//!
//! They meet there only where `0 <= u . (p - P) <= L`; beyond its ends the edge's corners do, but for an end on or behind a plane that the
//! body meets: nothing is beyond that. A corner of a polygon in the place of the
//! circle meets the edge only if its own edges do not lead through it: `m . (q - p) >= 0` for the corners q beside it; where the contact
//! is compliant, a corner beside it may be pressed in deeper, so there the edge may lead through at a small angle. A circle meets a
//! corner C where it is beyond the ends of both edges, `(p - C) . (q - C) <= 0`.
//!
//! What is compliant hands over where depths are equal. A corner p on an edge with the end C, towards which it goes along w, and the edge
//! from p to q with `s = (q - p)/|q - p|` on which C would be, are pressed in by the same depth where `(w - s) . (C - p) = 0`, the bisector
//! of the two edges; of q the one that faces the edge is meant, next to p on the way round at the edge's second end. For two corners of no
//! radius that is the limit instead of the ends; for ends of rods it is one besides.
//! # Symbols and units
//! p, P, C, q, r, R, L (m), g (m), m, u (1), omega (1/s), alpha (1/s^2).
//! # Sign and frame
//! World axes. m points from the edge to the circle; the pair's normal points to its first body, so it is -m where the edge is that one's.
//! # Validity
//! Convex polygons, boxes and rods; a rod has an edge on each side.
//! # Source
//! Feature pairs of convex bodies by their Voronoi regions; differentiation in a turning frame.
//! # Checked by
//! `tests/edges.rs`.

use tumble_expr::{Binary, Expr, Vector, is_identically_zero};

use crate::anchor::{Anchor, rate};
use crate::contact::border::{Edge, Rim};
use crate::contact::pair::{dot, turned};
use crate::kinematics::{Kinematics, PointRef};
use crate::surface::ContactLaw;

/// Where a contact with an edge ends or begins may be off by this part of the edge's length: what stands flush with an end stays there,
/// and where one contact gives way to the next neither is missed.
const FITS: f64 = 1e-11;

/// Sine of the angle by which an edge beside a corner may lead through the edge that it is pressed into: more than any depth makes of it that
/// is small against the body, and less than that of what comes from the side.
const LEANS: f64 = 0.25;

/// An edge and a circle: one of them is the first body's.
#[derive(Clone, Debug)]
pub(crate) struct Straight {
    /// Motion of the body whose edge it is; `None` of the world.
    pub(crate) owner: Option<Kinematics>,
    /// Whether the edge is the first body's.
    pub(crate) is_first: bool,
    /// The second body's point: the centre of its circle, or the first end of its edge.
    pub(crate) other: Option<PointRef>,
    /// Radius of the second, m.
    pub(crate) radius: Expr,
    /// Distance of the centre from the edge while they touch, m.
    pub(crate) reach: Expr,
    /// Radius of a circle about the centre of the edge's body that holds all places of contact, m; `None` of the world.
    pub(crate) around: Option<Expr>,
    /// What is the same for all circles that meet this edge.
    pub(crate) line: usize,
}

/// What must not be negative while two touch.
#[derive(Clone, Debug)]
pub(crate) struct Limit {
    value: Expr,
    /// A length that it is small against, m.
    size: Expr,
    /// Whether contact ends where it becomes negative, and does not only begin where it is not.
    ends: bool,
    /// Whether another contact counts where it is zero.
    yields: bool,
}

impl Limit {
    /// Not negative where contact may begin, but for rounding. An edge that comes flush with another is in line with it at the very instant at which
    /// its corner arrives.
    pub(crate) fn entered(&self) -> Expr {
        match (self.yields, self.ends) {
            (true, _) => &self.value - FITS * &self.size,
            (false, true) => self.value.clone(),
            (false, false) => self.taken(),
        }
    }

    /// Not negative where there may be contact, rounding included.
    pub(crate) fn holding(&self) -> Expr {
        if self.yields { self.entered() } else { self.taken() }
    }

    /// Not negative where contact may be taken over from another, rounding included.
    pub(crate) fn taken(&self) -> Expr {
        &self.value + FITS * &self.size
    }

    /// By how much it changes with an angle, m, where it turns with bodies and moves with none.
    pub(crate) fn turns(&self) -> Option<&Expr> {
        (!self.ends).then_some(&self.size)
    }

    /// Negative from where on there is none, if contact ends here at all: the next begins at the very place.
    pub(crate) fn left(&self) -> Option<Expr> {
        self.ends.then(|| self.value.clone())
    }
}

impl Straight {
    /// How the edge's normal turns, 1/s.
    pub(crate) fn turning(&self, normal: &Vector) -> Vector {
        match &self.owner {
            Some(motion) => motion.omega() * normal.perpendicular(),
            None => rate(normal),
        }
    }

    /// The derivative of that, 1/s^2.
    pub(crate) fn turning_rate(&self, normal: &Vector) -> Vector {
        match &self.owner {
            Some(motion) => {
                let omega = motion.omega();
                motion.alpha() * normal.perpendicular() - (&omega * &omega) * normal
            }
            None => rate(&rate(normal)),
        }
    }
}

/// The normal of an edge, out of what it bounds.
pub(crate) fn outward(edge: &Edge) -> Vector {
    turned(&edge.along().0)
}

/// Where a circle may touch an edge; `apart` is from the first end to its centre, and the edge is the first body's or not.
pub(crate) fn along_edge(
    edge: &Edge,
    rim: &Rim,
    apart: &Vector,
    (law, is_first): (&ContactLaw, bool),
) -> Vec<Limit> {
    let (along, length) = edge.along();
    let place = dot(&along, apart);
    let ends = [place.clone(), &length - place];
    let normal = turned(&along);
    let cone = |next: &Anchor| {
        let (above, size) = (dot(&normal, &between(&rim.centre, next)), distance(&rim.centre, next));
        let value = if law.is_rigid() { above } else { above + LEANS * &size };
        Limit { value, size, ends: false, yields: false }
    };
    let within = |value: Expr| Limit { value, size: length.clone(), ends: true, yields: false };
    let has_end = |(end, _): &(usize, Expr)| !edge.goes_on[*end];
    let is_sharp = is_identically_zero(&(&rim.radius + &edge.radius));
    let is_corner = rim.neighbours.len() > 1;
    let mut limits = vec![];
    if law.is_rigid() || !(is_sharp && is_corner) {
        limits.extend(ends.into_iter().enumerate().filter(has_end).map(|(_, value)| within(value)));
    }
    if !law.is_rigid() {
        let ways = [(-&along, -apart), (along.clone(), &(&length * &along) - apart)];
        let with_ends = ways.iter().enumerate().filter(|(end, _)| !edge.goes_on[*end]);
        let facing = with_ends.filter_map(|(end, (way, to_end))| {
            let equal = rim.facing(end == 1).map(|next| {
                let own = between(&rim.centre, next);
                let size = own.norm();
                let own = own.map(|part| part / &size);
                let equal = dot(&(way - &own), to_end) / 2;
                // A rod that goes on beyond the end touches there too, and both push.
                if is_corner { equal } else { greater(equal, dot(way, &own) * &size) }
            });
            equal.reduce(greater)
        });
        // Where both corners are at one place only one of the two counts.
        limits.extend(facing.map(|value| Limit { yields: is_sharp && is_first, ..within(value) }));
    }
    limits.into_iter().chain(rim.neighbours.iter().map(cone)).collect()
}

/// Where a circle may touch one about a corner or an end; `apart` is from there to its centre.
pub(crate) fn beyond_ends(corner: &Rim, apart: &Vector, reach: &Expr) -> Vec<Limit> {
    let of = |next| {
        let way = between(&corner.centre, next);
        let length = way.norm();
        Limit { value: -dot(&way, apart) / length, size: reach.clone(), ends: true, yields: false }
    };
    corner.neighbours.iter().map(of).collect()
}

pub(crate) fn greater(a: Expr, b: Expr) -> Expr {
    Expr::binary(Binary::Max, a, b)
}

/// The distance of two places of a body, or of the world, m: the same however the body turns.
fn distance(from: &Anchor, to: &Anchor) -> Expr {
    match (from.material(), to.material()) {
        (Some(from), Some(to)) => (&to.arm - &from.arm).norm(),
        _ => (to.position() - from.position()).norm(),
    }
}

/// From one place of a body, or of the world, to another.
fn between(from: &Anchor, to: &Anchor) -> Vector {
    match (from.material(), to.material()) {
        (Some(from), Some(to)) => crate::kinematics::rotated(&(&to.arm - &from.arm), &from.body.angle()),
        _ => to.position() - from.position(),
    }
}
