//! Cones of friction: the sum of normal force and friction lies within, on the edge where the contact slides.

use crate::geometry::{Point, along, dot, length, plus, times, turned, unit};
use crate::outline::Plane;
use crate::scale::drawable;
use crate::svg::{Element, PathData};
use crate::theme::{CONTACT, HAIRLINE};

use super::layout::{Scales, View};
use super::strokes::LEAST_LENGTH;

/// How much of a cone's colour covers what is below it.
const COVERS: &str = "0.13";
/// The widest cones are as many times as wide as the normal force is long, and lower than that.
const WIDEST: f64 = 2.4;
/// Friction below this part of the normal force leaves the sum of both on the arrow of the normal force.
const ALONG_NORMAL: f64 = 0.02;

/// The cone of friction at a contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrictionCone {
    /// Point of contact in world coordinates, metres.
    pub point: [f64; 2],
    /// The normal force: components in world axes, in the arrow unit of the diagram.
    pub normal: [f64; 2],
    /// Friction, likewise.
    pub friction: [f64; 2],
    /// The coefficient of friction, which is the tangent of half the cone's angle.
    pub coefficient: f64,
}

impl FrictionCone {
    /// Whether there is a cone to draw.
    pub(super) fn is_drawable(&self) -> bool {
        let numbers = self.point.into_iter().chain(self.normal).chain(self.friction);
        unit(self.normal).is_some()
            && self.coefficient > 0.0
            && numbers.chain([self.coefficient]).all(drawable)
    }

    /// The cone on the page, as high as the arrow of its normal force is long.
    pub(super) fn place(&self, view: &View, scales: &Scales) -> Option<Cone> {
        let [x, y] = unit(self.normal)?;
        let normal = length(self.normal);
        let long = scales.length(normal).max(LEAST_LENGTH);
        let height = long.min(0.5 * WIDEST * long / self.coefficient);
        let (apex, up) = (view.pixel(self.point), [x, -y]);
        let side = turned(up);
        let at = |part: f64| plus(along(apex, up, height), times(side, part * height));
        // Friction along that side, whose way on the page is the other one in the world.
        let part = dot(self.friction, [side[0], -side[1]]) / normal;
        let sum = (part.abs() > ALONG_NORMAL && part.is_finite()).then(|| at(part));
        Some(Cone { apex, edges: [at(-self.coefficient), at(self.coefficient)], sum })
    }
}

/// A cone on the page, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cone {
    apex: Point,
    /// Where its edges end.
    edges: [Point; 2],
    /// Where the line of the sum of normal force and friction ends, if it is not that of the normal force.
    sum: Option<Point>,
}

impl Cone {
    /// A cone that stands upright on a point, with its sum on one edge.
    pub(super) fn sample([x, y]: Point, width: f64, height: f64) -> Self {
        let edges = [[x - 0.5 * width, y - height], [x + 0.5 * width, y - height]];
        Self { apex: [x, y], edges, sum: Some(edges[1]) }
    }

    /// The lines that are drawn.
    pub(super) fn lines(&self) -> Vec<[Point; 2]> {
        self.edges.into_iter().chain(self.sum).map(|end| [self.apex, end]).collect()
    }

    pub(super) fn draw(&self) -> Element {
        let [left, right] = self.edges;
        let face =
            PathData::polygon(&[self.apex, left, right]).fill(CONTACT.colour).attr("fill-opacity", COVERS);
        let edge = |end: Point| PathData::polyline(&[self.apex, end]).stroke(CONTACT.colour, HAIRLINE);
        let sum = self
            .sum
            .map(|end| PathData::polyline(&[self.apex, end]).stroke(CONTACT.colour, 2.0).dashed("4 3"));
        Element::new("g").attr("class", "cone").child(face).children(self.edges.map(edge)).children(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(friction: [f64; 2], coefficient: f64) -> Cone {
        let view = View { centre: [0.0; 2], at: [0.0; 2], density: 1.0 };
        let scales = Scales { density: 1.0, arrow: 100.0, largest: 10.0, fastest: 1.0 };
        let cone = FrictionCone { point: [0.0; 2], normal: [0.0, 10.0], friction, coefficient };
        cone.place(&view, &scales).expect("a normal force")
    }

    #[test]
    fn the_sum_of_what_slides_is_on_an_edge_of_its_cone() {
        let cone = placed([-4.0, 0.0], 0.4);
        assert_eq!(cone.sum, Some([-40.0, -100.0]));
        assert!(cone.edges.contains(&[-40.0, -100.0]) && cone.edges.contains(&[40.0, -100.0]));
        assert_eq!(placed([0.1, 0.0], 0.4).sum, None);
        assert_eq!(placed([2.0, 0.0], 0.4).sum, Some([20.0, -100.0]));
    }

    #[test]
    fn wide_cones_are_lower() {
        let cone = placed([0.0; 2], 4.0);
        assert!(cone.edges.iter().all(|[x, y]| (x.abs() - 120.0).abs() < 1e-12 && (y + 30.0).abs() < 1e-12));
    }
}
