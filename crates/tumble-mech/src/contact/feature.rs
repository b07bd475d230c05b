//! What a body may touch by: points, which are ends, corners and round rims, and the straight sides between them.

use std::collections::HashMap;

use tumble_expr::{Expr, Graph, NodeId, Vector};

use crate::body::Body;
use crate::shape::Shape;

/// A circle fixed in a body; a corner or an end is one of no radius.
#[derive(Clone, Debug)]
pub struct Feature {
    /// Name of the body's point that is there, or `from`, `to`, `corner1`, `rim`, ...
    pub name: String,
    /// Its centre, m, body coordinates.
    pub centre: Vector,
    /// m
    pub radius: Expr,
    /// Where the straight sides that begin there end, m, body coordinates.
    pub neighbours: Vec<Vector>,
}

/// A straight side of a body.
#[derive(Clone, Debug)]
pub struct PolygonSide {
    /// `side1`, ...
    pub name: String,
    /// Its ends, m, body coordinates: on the way from the first to the other the body is on the left.
    pub ends: [Vector; 2],
    /// Half the thickness of a rod, m.
    pub radius: Expr,
}

impl Body {
    /// All points by which the body may touch. Two parts may share one: it is listed once.
    pub fn features(&self) -> Vec<Feature> {
        // Equal formulas are one node of a graph: so no point is compared with all others.
        let mut graph = Graph::default();
        let mut names = HashMap::new();
        for (name, place) in &self.points {
            names.entry(graph.import(place.components())).or_insert(name);
        }
        let mut features: Vec<Feature> = vec![];
        let mut taken: HashMap<(Vec<NodeId>, Vec<NodeId>), usize> = HashMap::new();
        for (index, part) in self.parts.iter().enumerate() {
            for feature in of_shape(&part.shape) {
                let place = graph.import(feature.centre.components());
                let key = (place.clone(), graph.import(std::slice::from_ref(&feature.radius)));
                if let Some(known) = taken.get(&key) {
                    features[*known].neighbours.extend(feature.neighbours);
                    continue;
                }
                taken.insert(key, features.len());
                let own = self.name_in(index, feature.name);
                let name = names.get(&place).map_or(own, |name| (*name).clone());
                features.push(Feature { name, ..feature });
            }
        }
        features
    }

    /// All straight sides of the body; a rod has two.
    pub fn sides(&self) -> Vec<PolygonSide> {
        let parts = self.parts.iter().enumerate();
        let sides = parts.flat_map(|(index, part)| {
            let (sides, radius) = sides_of(&part.shape);
            sides.into_iter().zip(1..).map(move |(ends, number)| PolygonSide {
                name: self.name_in(index, format!("side{number}")),
                ends,
                radius: radius.clone(),
            })
        });
        sides.collect()
    }

    /// What something of a part is called.
    fn name_in(&self, part: usize, name: String) -> String {
        if self.parts.len() == 1 { name } else { format!("part{}.{name}", part + 1) }
    }
}

fn of_shape(shape: &Shape) -> Vec<Feature> {
    let round = |centre: &Vector, name: &str, radius: Expr| Feature {
        name: name.to_owned(),
        centre: centre.clone(),
        radius,
        neighbours: vec![],
    };
    match shape {
        Shape::Point { at } => vec![round(at, "point", Expr::zero())],
        Shape::Rod { from, to, end_radius } => [("from", from, to), ("to", to, from)]
            .map(|(name, own, other)| Feature {
                neighbours: vec![other.clone()],
                ..round(own, name, end_radius.clone())
            })
            .into(),
        Shape::Disk { centre, radius }
        | Shape::Ring { centre, radius }
        | Shape::Ball { centre, radius }
        | Shape::Shell { centre, radius } => vec![round(centre, "rim", radius.clone())],
        Shape::Box { .. } | Shape::Polygon { .. } => corner_features(&shape.hull().0),
    }
}

/// The corners of a polygon, each with those beside it.
pub(crate) fn corner_features(corners: &[Vector]) -> Vec<Feature> {
    let beside = |index: usize, by: usize| corners[(index + by) % corners.len()].clone();
    let feature = |index: usize| Feature {
        name: format!("corner{}", index + 1),
        centre: corners[index].clone(),
        radius: Expr::zero(),
        neighbours: vec![beside(index, 1), beside(index, corners.len() - 1)],
    };
    (0..corners.len()).map(feature).collect()
}

/// The sides of a polygon in order.
pub(crate) fn round_trip(corners: &[Vector]) -> impl Iterator<Item = [Vector; 2]> + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(from, to)| [from.clone(), to.clone()])
}

fn sides_of(shape: &Shape) -> (Vec<[Vector; 2]>, Expr) {
    match shape {
        Shape::Rod { from, to, end_radius } => {
            (vec![[from.clone(), to.clone()], [to.clone(), from.clone()]], end_radius.clone())
        }
        shape => (shape.edges(), Expr::zero()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Part;
    use tumble_expr::units::{KG, M};

    fn names(body: &Body) -> Vec<String> {
        body.features().into_iter().map(|feature| feature.name).collect()
    }

    #[test]
    fn ends_have_the_names_of_the_points_there() {
        let rod = Body::rod("rod", [0 * M, 0 * M], [0 * M, -1 * M]).with_point("tip", [0 * M, -1 * M]);
        assert_eq!(names(&rod), ["from", "tip"]);
    }

    #[test]
    fn corners_are_counted_and_shared_ones_listed_once() {
        let plate = |x: f64| Shape::Box { centre: Vector::planar(x * M, 0 * M), width: 1 * M, height: 1 * M };
        let one = Body::of_shape("box", plate(0.0));
        assert_eq!(names(&one), ["corner1", "corner2", "corner3", "corner4"]);
        let part = |x| Part { shape: plate(x), mass: 1 * KG };
        // Side by side: two corners of the second are corners of the first.
        let boxes = Body::from_parts("boxes", vec![part(0.0), part(1.0)]);
        assert_eq!(names(&boxes).len(), 6);
        assert_eq!(boxes.features()[1].neighbours.len(), 4);
        assert_eq!(boxes.sides().len(), 8);
    }
}
