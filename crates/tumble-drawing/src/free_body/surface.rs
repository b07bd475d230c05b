//! Surfaces near a body: a line with hatching on the side of the material.

use crate::rect::Rect;
use crate::scale::drawable;
use crate::svg::{Element, PathData};
use crate::text::Label;
use crate::theme::{GREY, HAIRLINE, INK};

use super::layout::View;
use crate::geometry::{Point, along, minus, plus, times, unit};

/// Distance of hatching strokes along the surface, in pixels.
const HATCH_STEP: f64 = 8.0;
/// Depth of the hatching, in pixels.
pub(crate) const HATCH_DEPTH: f64 = 8.0;
/// Thickness of the surface, in pixels.
const THICKNESS: f64 = 1.4;

/// The edge of a half-plane of material.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// A point on it, in world coordinates, metres.
    pub point: [f64; 2],
    /// Its normal, out of the material; of any length but zero.
    pub normal: [f64; 2],
    /// Its name; may be empty.
    pub name: Label,
}

impl Surface {
    /// A surface through a point (world, metres) with its outward normal.
    pub fn new(point: [f64; 2], normal: [f64; 2], name: Label) -> Self {
        Self { point, normal, name }
    }

    /// Whether it has a place and a direction.
    pub fn is_drawable(&self) -> bool {
        self.point.into_iter().chain(self.normal).all(drawable) && unit(self.normal).is_some()
    }

    /// How far a world point lies above the surface, in metres.
    pub(crate) fn height(&self, point: Point) -> f64 {
        let normal = unit(self.normal).unwrap_or_default();
        let [x, y] = minus(point, self.point);
        x * normal[0] + y * normal[1]
    }

    /// The point of the surface nearest to a world point.
    pub(crate) fn foot(&self, point: Point) -> Point {
        along(point, unit(self.normal).unwrap_or_default(), -self.height(point))
    }

    /// Where the surface is nearest to the lowest of some points, if anything there can be drawn.
    pub(crate) fn foot_of_lowest(&self, points: &[Point]) -> Option<Point> {
        let lowest = points.iter().min_by(|a, b| self.height(**a).total_cmp(&self.height(**b)))?;
        self.is_drawable().then(|| self.foot(*lowest))
    }

    /// Lines that cover the surface and its hatching.
    pub(crate) fn strip(&self, view: &View, area: &Rect) -> Vec<[Point; 2]> {
        let Some(line) = self.visible(view, area) else { return Vec::new() };
        let depths = [0.0, -HATCH_DEPTH / 2.0, -HATCH_DEPTH];
        depths.map(|depth| line.map(|p| along(p, self.page_normal(), depth))).to_vec()
    }

    /// The outward unit normal on the page.
    pub(crate) fn page_normal(&self) -> Point {
        let [x, y] = unit(self.normal).unwrap_or_default();
        [x, -y]
    }

    /// The visible part of the surface in `area`, on the page.
    pub(crate) fn visible(&self, view: &View, area: &Rect) -> Option<[Point; 2]> {
        let [nx, ny] = self.page_normal();
        let foot = view.pixel(self.foot(view.world(area.centre())));
        let reach = times([-ny, nx], area.width.hypot(area.height));
        let line = area.clipped_line(minus(foot, reach), plus(foot, reach))?;
        let [dx, dy] = minus(line[1], line[0]);
        (dx.hypot(dy) > HATCH_STEP).then_some(line)
    }

    pub(crate) fn draw(&self, view: &View, area: &Rect) -> Option<Element> {
        let line = self.visible(view, area)?;
        let mut hatching = PathData::default();
        self.hatching(line, area).iter().for_each(|stroke| hatching.add_polyline(stroke));
        let hatching = hatching.stroke().attr("stroke", GREY).attr("stroke-width", HAIRLINE);
        let edge = PathData::polyline(&line).stroke().attr("stroke", INK).attr("stroke-width", THICKNESS);
        Some(Element::new("g").child(hatching).child(edge))
    }

    fn hatching(&self, [from, to]: [Point; 2], area: &Rect) -> Vec<[Point; 2]> {
        let [dx, dy] = minus(to, from);
        let length = dx.hypot(dy);
        let Some(forward) = unit([dx, dy]) else { return Vec::new() };
        let down = times(self.page_normal(), -HATCH_DEPTH);
        let stroke = |i: usize| {
            let top = along(from, forward, i as f64 * HATCH_STEP);
            area.clipped_line(top, plus(along(top, forward, -HATCH_DEPTH), down))
        };
        // Strokes cut short by the edge of the panel look like slips of the pen.
        let long = |[a, b]: &[Point; 2]| crate::geometry::length(minus(*a, *b)) > HATCH_DEPTH / 2.0;
        (0..=(length / HATCH_STEP) as usize + 1).filter_map(stroke).filter(long).collect()
    }
}
