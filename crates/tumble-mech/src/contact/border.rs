//! What bodies and fixed polygons touch by: circles about ends, corners and centres, and straight edges.

use tumble_expr::{Expr, Vector};

use crate::anchor::Anchor;
use crate::body::Body;
use crate::contact::feature::{Feature, PolygonSide, corner_features, round_trip};
use crate::kinematics::{Kinematics, PointRef, rotated};

/// A circle by which something touches; a corner or an end is one of no radius, or of the rod's.
#[derive(Clone, Debug)]
pub(crate) struct Rim {
    pub(crate) name: String,
    pub(crate) centre: Anchor,
    /// m
    pub(crate) radius: Expr,
    /// Other ends of the edges that begin there: none of a disk.
    pub(crate) neighbours: Vec<Anchor>,
}

/// A straight edge; what is solid, or the rod, is on the left on the way from its first end to the other.
#[derive(Clone, Debug)]
pub(crate) struct Edge {
    pub(crate) name: String,
    pub(crate) ends: [Anchor; 2],
    /// Half the thickness of a rod, m.
    pub(crate) radius: Expr,
    /// Whether it goes on beyond each of its ends, into what else is solid.
    pub(crate) goes_on: [bool; 2],
}

/// All that something may touch by.
#[derive(Clone, Debug, Default)]
pub(crate) struct Border {
    pub(crate) rims: Vec<Rim>,
    pub(crate) edges: Vec<Edge>,
}

impl Border {
    /// Whether it touches by one circle alone.
    pub(crate) fn is_round(&self) -> bool {
        self.rims.len() == 1 && self.edges.is_empty()
    }

    /// That of a body.
    pub(crate) fn of_body(body: &Body) -> Self {
        let (features, sides) = (body.features(), body.sides());
        let of_feature = |feature: &Feature| 1 + feature.neighbours.len();
        let locals =
            features.iter().flat_map(|feature| std::iter::once(&feature.centre).chain(&feature.neighbours));
        let mut places = body.points_at(locals.chain(sides.iter().flat_map(|side| &side.ends))).into_iter();
        let mut next = || Anchor::Material(places.next().expect("a place of each"));
        let rim = |feature: Feature| {
            let count = of_feature(&feature);
            let mut all: Vec<Anchor> = (0..count).map(|_| next()).collect();
            let centre = all.remove(0);
            Rim { name: feature.name, centre, radius: feature.radius, neighbours: all }
        };
        let rims = features.into_iter().map(rim).collect();
        let edge = |side: PolygonSide| Edge {
            name: side.name,
            ends: [next(), next()],
            radius: side.radius,
            goes_on: [false; 2],
        };
        let edges = sides.into_iter().map(edge).collect();
        Self { rims, edges }
    }

    /// That of a polygon of the world, its corners counter-clockwise. Corners that are `hidden` on or in what else is solid touch nothing, and
    /// edges go on there: what slides into the inner corner between a step and its floor is on one contact with each, and not on the
    /// step's corner besides.
    pub(crate) fn of_polygon(corners: &[Vector], hidden: impl Fn(&Vector) -> bool) -> Self {
        let world = |place: Vector| Anchor::World(place);
        let in_view = corner_features(corners).into_iter().filter(|feature| !hidden(&feature.centre));
        let rims = in_view.map(|feature| Rim {
            name: feature.name,
            centre: world(feature.centre),
            radius: feature.radius,
            neighbours: feature.neighbours.into_iter().map(world).collect(),
        });
        let edges = round_trip(corners).zip(1..).map(|(ends, number)| Edge {
            name: format!("side{number}"),
            goes_on: ends.each_ref().map(&hidden),
            ends: ends.map(world),
            radius: Expr::zero(),
        });
        Self { rims: rims.collect(), edges: edges.filter(|edge| edge.goes_on != [true; 2]).collect() }
    }
}

impl Edge {
    /// The unit vector from its first end to the other, world axes, and its length, m.
    pub(crate) fn along(&self) -> (Vector, Expr) {
        let way = match &self.ends {
            [Anchor::Material(from), Anchor::Material(to)] => &to.arm - &from.arm,
            [from, to] => to.position() - from.position(),
        };
        let length = way.norm();
        let unit = way.map(|part| part / &length);
        (self.owner().map_or_else(|| unit.clone(), |owner| rotated(&unit, &owner.angle())), length)
    }

    /// Motion of the body that it is of.
    pub(crate) fn owner(&self) -> Option<Kinematics> {
        self.ends[0].material().map(|point| point.body.clone())
    }

    /// Largest distance of its points from the centre of its body, or a little more, m.
    pub(crate) fn reach(&self) -> Expr {
        let arms = self.ends.iter().filter_map(Anchor::material).map(|point| point.arm.norm());
        arms.fold(self.radius.clone(), |sum, arm| sum + arm)
    }
}

impl Rim {
    /// Of its neighbours those whose edge faces an edge that it is on, at the second end of that, or at the first.
    pub(crate) fn facing(&self, is_second: bool) -> impl Iterator<Item = &Anchor> {
        // They stand in pairs, the next on the way round and the one before; a rod has its other end alone.
        let first = if is_second || self.neighbours.len() == 1 { 0 } else { 1 };
        self.neighbours.iter().skip(first).step_by(2)
    }

    /// The body's point in its centre.
    pub(crate) fn point(&self) -> Option<&PointRef> {
        self.centre.material()
    }
}
