//! Surfaces near a body: a line, or a circle, with hatching on the side of the material.

use crate::outline::Plane;
use crate::rect::Rect;
use crate::scale::drawable;
use crate::svg::{Element, PathData};
use crate::text::Label;
use crate::theme::{GREY, HAIRLINE, INK};

use super::layout::View;
use crate::geometry::{Point, along, direction, dot, length, minus, plus, times, unit};

/// Distance of hatching strokes along the surface, in pixels.
const HATCH_STEP: f64 = 8.0;
/// Depth of the hatching, in pixels.
pub(crate) const HATCH_DEPTH: f64 = 8.0;
/// Thickness of the surface, in pixels.
const THICKNESS: f64 = 1.4;

/// Points of a circle that is drawn.
const CIRCLE_POINTS: usize = 180;
/// Half the length of the part of a circle that its name stands by, in pixels.
const NAMED: f64 = 20.0;

/// The edge of a half-plane of material, or of a round piece or hollow of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// A point on it, or the centre of a circle, in world coordinates, metres.
    pub point: [f64; 2],
    /// Its normal, out of the material; of any length but zero. Of a circle, where its name stands: opposite to the normal there.
    pub normal: [f64; 2],
    /// How far it goes from the point to the left and to the right, seen along the normal, metres; without end where nothing is said.
    pub reach: Option<f64>,
    /// Set where it is a circle.
    pub round: Option<GroundCircle>,
    /// Its name; may be empty.
    pub name: Label,
}

/// A circle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GroundCircle {
    /// Its radius, m.
    pub radius: f64,
    /// Whether the material is outside it, as of a bowl.
    pub hollow: bool,
}

impl Ground {
    /// A surface through a point (world, metres) with its outward normal.
    pub fn new(point: [f64; 2], normal: [f64; 2], name: Label) -> Self {
        Self { point, normal, reach: None, round: None, name }
    }

    /// The edge of a piece of material, which is on the left on the way from one end to the other (world, metres).
    pub fn between(from: [f64; 2], to: [f64; 2], name: Label) -> Self {
        let [dx, dy] = minus(to, from);
        let middle = times(plus(from, to), 0.5);
        Self { reach: Some(0.5 * dx.hypot(dy)), ..Self::new(middle, [dy, -dx], name) }
    }

    /// The edges of a polygon of material with these corners (world, metres), counter-clockwise. The first has its name.
    pub fn around(corners: &[[f64; 2]], name: Label) -> Vec<Self> {
        let next = corners.iter().cycle().skip(1);
        let names = std::iter::once(name).chain(std::iter::repeat(Label::default()));
        corners
            .iter()
            .zip(next)
            .zip(names)
            .map(|((from, to), name)| Self::between(*from, *to, name))
            .collect()
    }

    /// A circle about a point (world, metres).
    pub fn round(centre: [f64; 2], round: GroundCircle, name: Label) -> Self {
        Self { round: Some(round), ..Self::new(centre, [0.0, 1.0], name) }
    }

    /// Whether it has a place and a direction.
    pub fn is_drawable(&self) -> bool {
        let is_round = |round: GroundCircle| drawable(round.radius) && round.radius > 0.0;
        self.point.into_iter().chain(self.normal).all(drawable)
            && unit(self.normal).is_some()
            && self.round.is_none_or(is_round)
    }

    /// How far a world point lies above the surface, in metres.
    pub(crate) fn height(&self, point: Point) -> f64 {
        let away = minus(point, self.point);
        match self.round {
            Some(round) => (length(away) - round.radius) * if round.hollow { -1.0 } else { 1.0 },
            None => dot(away, unit(self.normal).unwrap_or_default()),
        }
    }

    /// The point of the surface nearest to a world point.
    pub(crate) fn foot(&self, point: Point) -> Point {
        if let Some(round) = self.round {
            return along(self.point, self.outward(point), round.radius);
        }
        let foot = along(point, unit(self.normal).unwrap_or_default(), -self.height(point));
        let Some(reach) = self.reach else { return foot };
        let [x, y] = minus(foot, self.point);
        let away = x.hypot(y);
        if away > reach { along(self.point, [x / away, y / away], reach) } else { foot }
    }

    /// From the centre of the circle to a point; down, or up, where that is the centre.
    fn outward(&self, point: Point) -> Point {
        unit(minus(point, self.point)).unwrap_or([0.0, if self.is_hollow() { -1.0 } else { 1.0 }])
    }

    fn is_hollow(&self) -> bool {
        self.round.is_some_and(|round| round.hollow)
    }

    /// Where the surface is nearest to the lowest of some points, if anything there can be drawn.
    pub(crate) fn foot_of_lowest(&self, points: &[Point]) -> Option<Point> {
        let lowest = points.iter().min_by(|a, b| self.height(**a).total_cmp(&self.height(**b)))?;
        self.is_drawable().then(|| self.foot(*lowest))
    }

    /// Lines that cover the surface and its hatching.
    pub(crate) fn strip(&self, view: &View, area: &Rect) -> Vec<[Point; 2]> {
        if let Some(round) = self.round {
            let steps = self.circle(view, round);
            return steps.windows(2).filter_map(|step| area.clipped_line(step[0].0, step[1].0)).collect();
        }
        let Some(line) = self.visible(view, area) else { return Vec::new() };
        let depths = [0.0, -HATCH_DEPTH / 2.0, -HATCH_DEPTH];
        depths.map(|depth| line.map(|p| along(p, self.page_normal(), depth))).to_vec()
    }

    /// Points of the circle on the page, each with the way into the material.
    fn circle(&self, view: &View, round: GroundCircle) -> Vec<(Point, Point)> {
        let one = |step: usize| {
            let away = direction(std::f64::consts::TAU * step as f64 / CIRCLE_POINTS as f64);
            let into = if round.hollow { away } else { times(away, -1.0) };
            (view.pixel(along(self.point, away, round.radius)), [into[0], -into[1]])
        };
        (0..=CIRCLE_POINTS).map(one).collect()
    }

    /// The outward unit normal on the page.
    pub(crate) fn page_normal(&self) -> Point {
        let [x, y] = unit(self.normal).unwrap_or_default();
        [x, -y]
    }

    /// Where points of the page at the surface come to at the depth of its hatching.
    pub(crate) fn below<const N: usize>(&self, points: [Point; N]) -> [Point; N] {
        points.map(|p| along(p, self.page_normal(), -HATCH_DEPTH))
    }

    /// The visible part of the surface in `area`, on the page; of a circle, where its name stands.
    pub(crate) fn visible(&self, view: &View, area: &Rect) -> Option<[Point; 2]> {
        if self.round.is_some() {
            let [x, y] = view.pixel(self.foot(self.point));
            let near = area.clipped_line([x - NAMED, y], [x + NAMED, y])?;
            return (length(minus(near[1], near[0])) > NAMED).then_some(near);
        }
        let [nx, ny] = self.page_normal();
        if let Some(reach) = self.reach {
            let reach = times(unit([-self.normal[1], self.normal[0]])?, reach);
            let ends = [minus(self.point, reach), plus(self.point, reach)].map(|end| view.pixel(end));
            return area.clipped_line(ends[0], ends[1]);
        }
        let foot = view.pixel(self.foot(view.world(area.centre())));
        let reach = times([-ny, nx], area.width.hypot(area.height));
        let line = area.clipped_line(minus(foot, reach), plus(foot, reach))?;
        let [dx, dy] = minus(line[1], line[0]);
        (dx.hypot(dy) > HATCH_STEP).then_some(line)
    }

    pub(crate) fn draw(&self, view: &View, area: &Rect) -> Option<Element> {
        if let Some(round) = self.round {
            return Some(self.draw_circle(view, area, round));
        }
        let line = self.visible(view, area)?;
        let mut hatching = PathData::default();
        self.hatching(line, area).iter().for_each(|stroke| hatching.add_polyline(stroke));
        Some(drawn(PathData::polyline(&line), hatching))
    }

    fn draw_circle(&self, view: &View, area: &Rect, round: GroundCircle) -> Element {
        let points = self.circle(view, round);
        let (mut edge, mut hatching) = (PathData::default(), PathData::default());
        for step in self.strip(view, area) {
            edge.add_polyline(&step);
        }
        // Strokes lean as those of a line do.
        let gap = points
            .windows(2)
            .map(|step| length(minus(step[1].0, step[0].0)))
            .fold(f64::MIN_POSITIVE, f64::max);
        for (at, into) in points.iter().step_by((HATCH_STEP / gap).ceil().max(1.0) as usize) {
            let side = [-into[1], into[0]];
            let end = along(along(*at, *into, HATCH_DEPTH), side, HATCH_DEPTH);
            area.clipped_line(*at, end).iter().for_each(|stroke| hatching.add_polyline(stroke));
        }
        drawn(edge, hatching)
    }

    fn hatching(&self, [from, to]: [Point; 2], area: &Rect) -> Vec<[Point; 2]> {
        let [dx, dy] = minus(to, from);
        let whole = dx.hypot(dy);
        let Some(forward) = unit([dx, dy]) else { return Vec::new() };
        let down = times(self.page_normal(), -HATCH_DEPTH);
        let stroke = |i: usize| {
            let top = along(from, forward, i as f64 * HATCH_STEP);
            area.clipped_line(top, plus(along(top, forward, -HATCH_DEPTH), down))
        };
        // Strokes cut short by the edge of the panel look like slips of the pen.
        let long = |[a, b]: &[Point; 2]| length(minus(*a, *b)) > HATCH_DEPTH / 2.0;
        (0..=(whole / HATCH_STEP) as usize + 1).filter_map(stroke).filter(long).collect()
    }
}

fn drawn(edge: PathData, hatching: PathData) -> Element {
    Element::new("g").child(hatching.stroke(GREY, HAIRLINE)).child(edge.stroke(INK, THICKNESS))
}
