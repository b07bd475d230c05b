//! Points of a body by which it may touch a plane surface: ends, corners, round rims.

use std::collections::{HashMap, HashSet};

use tumble_expr::{Expr, Graph, Vector};

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
}

impl Body {
    /// All points by which the body may touch a plane. Two parts may share one: it is listed once.
    pub fn features(&self) -> Vec<Feature> {
        // Equal formulas are one node of a graph: so no point is compared with all others.
        let mut graph = Graph::default();
        let mut names = HashMap::new();
        for (name, place) in &self.points {
            names.entry(graph.import(place.components())).or_insert(name);
        }
        let (mut features, mut taken) = (vec![], HashSet::new());
        for (index, part) in self.parts.iter().enumerate() {
            for (name, centre, radius) in of_shape(&part.shape) {
                let place = graph.import(centre.components());
                if taken.insert((place.clone(), graph.import(std::slice::from_ref(&radius)))) {
                    let own = if self.parts.len() == 1 { name } else { format!("part{}.{name}", index + 1) };
                    let name = names.get(&place).map_or(own, |name| (*name).clone());
                    features.push(Feature { name, centre, radius });
                }
            }
        }
        features
    }
}

fn of_shape(shape: &Shape) -> Vec<(String, Vector, Expr)> {
    let sharp = |name: String, at: Vector| (name, at, Expr::zero());
    match shape {
        Shape::Point { at } => vec![sharp("point".into(), at.clone())],
        Shape::Rod { from, to, end_radius } => vec![
            ("from".into(), from.clone(), end_radius.clone()),
            ("to".into(), to.clone(), end_radius.clone()),
        ],
        Shape::Disk { centre, radius }
        | Shape::Ring { centre, radius }
        | Shape::Ball { centre, radius }
        | Shape::Shell { centre, radius } => vec![("rim".into(), centre.clone(), radius.clone())],
        Shape::Box { .. } | Shape::Polygon { .. } => {
            let corners = shape.edges().into_iter().map(|[corner, _]| corner);
            corners.zip(1..).map(|(corner, number)| sharp(format!("corner{number}"), corner)).collect()
        }
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
        assert_eq!(names(&Body::from_parts("boxes", vec![part(0.0), part(1.0)])).len(), 6);
    }
}
