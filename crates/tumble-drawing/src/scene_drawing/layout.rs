//! Where the parts of a scene lie on the page.

use super::tags::tags;
use super::{SceneBody, SceneDrawing, marks};
use crate::axes::{Axes, clipped};
use crate::curves::no_data;
use crate::free_body::Arrow;
use crate::free_body::circular_arrow::CircularArrow;
use crate::free_body::draw;
use crate::free_body::layout::View;
use crate::free_body::strokes::{Form, Stroke};
use crate::geometry::{Point, along, length, minus, unit};
use crate::heading::Heading;
use crate::outline::{Pen, Plane};
use crate::placing::{Occupancy, draw_placed, placed};
use crate::rect::Rect;
use crate::scale::Range;
use crate::stroboscope::{ALONE, equal_axes, picture_width};
use crate::svg::{Element, Svg, circle};
use crate::text::Label;
use crate::theme::{BODY, INK, MOTION, PAPER};

/// Room around everything, as a part of the larger side.
const PADDING: f64 = 0.15;
/// A circle of a radius larger than so many times the size of all bodies is not shown as a whole.
const LARGEST_ROUND: f64 = 12.0;
/// Greatest width of the picture in pixels: it stands beside what is given, and fits a narrow page.
const WIDEST: f64 = 440.0;
/// Length of the fastest velocity and of the largest force, and of the shortest, in pixels.
const LONGEST: f64 = 64.0;
const SHORTEST: f64 = 18.0;
/// Radius, start and sweep of the arrow of an angular velocity.
const RING: [f64; 3] = [24.0, 0.5, 3.6];
/// Radius of named points in pixels.
const POINT: f64 = 2.6;

/// A scene with its axes laid out.
pub(super) struct Layout {
    pub(super) scene: SceneDrawing,
    heading: Heading,
    pub(super) axes: Axes,
    pub(super) view: View,
    empty: bool,
}

impl Layout {
    pub(super) fn new(scene: SceneDrawing) -> Self {
        let ranges = ranges(&scene);
        let wanted = ranges.unwrap_or_default();
        let width = picture_width(wanted, ALONE).min(WIDEST);
        let heading = Heading::new(&scene.title, width);
        let axes = equal_axes(wanted, (width, ALONE.greatest_height), heading.bottom());
        let view = View::of(&axes);
        Self { scene, heading, axes, view, empty: ranges.is_none() }
    }

    pub(super) fn svg(&self, description: String) -> Svg {
        let [width, height] = self.axes.end();
        let title = self.scene.title.to_plain_or("The scene");
        let mut svg = Svg::on_paper(width, height, title).described(description);
        svg.push(self.heading.draw());
        svg.push(clipped(self.axes.area, self.contents()));
        svg.push(self.axes.draw());
        svg.children.extend(self.empty.then(|| no_data(&self.axes.area)));
        svg
    }

    fn contents(&self) -> Vec<Element> {
        let (scene, view, area) = (&self.scene, &self.view, &self.axes.area);
        let mut drawn = self.occupancy();
        let fields = marks::fields(scene, area, &mut drawn);
        let labels = placed(&tags(self), &drawn, area);
        let mut parts: Vec<Element> = scene.surfaces.iter().filter_map(|s| s.draw(view, area)).collect();
        parts.extend(scene.links.iter().map(|link| marks::link(link.kind, link.ends.map(|p| view.pixel(p)))));
        parts.extend(scene.bodies.iter().flat_map(|body| self.draw_body(body)));
        parts.extend(scene.pivots.iter().map(|pivot| marks::pivot(view.pixel(pivot.at))));
        let dot = |at: Point| circle(view.pixel(at), POINT).attr("fill", PAPER).stroked(INK, 1.1);
        parts.extend(scene.points.iter().map(|point| dot(point.at)));
        parts.extend(self.rings().iter().map(|(ring, _)| draw::ring(ring)));
        parts.extend(self.strokes().iter().map(|(stroke, _)| draw::arrow(stroke)));
        parts.extend(fields);
        parts.extend(draw_placed(&labels));
        parts
    }

    /// The labels at their places.
    #[cfg(test)]
    pub(super) fn labels(&self) -> Vec<crate::placing::Placed> {
        let mut drawn = self.occupancy();
        marks::fields(&self.scene, &self.axes.area, &mut drawn);
        placed(&tags(self), &drawn, &self.axes.area)
    }

    fn draw_body(&self, body: &SceneBody) -> Vec<Element> {
        let pen = Pen { colour: BODY, hollow: false };
        let outlines = body.outlines.iter().flat_map(|shape| shape.draw(&body.pose, &self.axes, pen));
        outlines.chain([draw::centre_mark(self.view.pixel(body.pose.centre()))]).collect()
    }

    /// Velocities and forces with what stands beside them.
    pub(super) fn strokes(&self) -> Vec<(Stroke, &Label)> {
        let Self { scene, view, .. } = self;
        let velocities = scene.bodies.iter().filter_map(|body| Some((body, body.velocity.as_ref()?)));
        let fastest = velocities.clone().map(|(_, (v, _))| length(*v)).fold(0.0, f64::max);
        let motions = velocities.filter_map(|(body, (v, label))| {
            let tail = view.pixel(body.pose.centre());
            let ends = [tail, head(tail, *v, length(*v) / fastest)?];
            let start = along(tail, unit(minus(ends[1], tail))?, draw::CENTRE_RADIUS);
            Some((Stroke { start, ..Stroke::new(ends, MOTION, Form::Thin) }, label))
        });
        let largest = scene.forces.iter().map(Arrow::magnitude).fold(0.0, f64::max);
        let forces = scene.forces.iter().filter_map(|force| {
            let tail = view.pixel(force.point);
            let ends = [tail, head(tail, force.vector, force.magnitude() / largest)?];
            Some((Stroke::new(ends, force.kind.style(), Form::Full), &force.symbol))
        });
        motions.chain(forces).collect()
    }

    /// Angular velocities with the bodies they belong to.
    pub(super) fn rings(&self) -> Vec<(CircularArrow, usize)> {
        let ring = |(i, body): (usize, &SceneBody)| {
            let (rate, _) = body.rate.as_ref()?;
            let (centre, [radius, start, sweep]) = (self.view.pixel(body.pose.centre()), RING);
            let (start, sweep) = (start * rate.signum(), sweep * rate.signum());
            Some((CircularArrow { centre, radius, start, sweep, style: MOTION, form: Form::Thin }, i))
        };
        self.scene.bodies.iter().enumerate().filter_map(ring).collect()
    }

    /// What labels must keep clear of.
    fn occupancy(&self) -> Occupancy {
        let mut drawn = Occupancy::new(self.axes.area);
        let strips = self.scene.surfaces.iter().flat_map(|s| s.strip(&self.view, &self.axes.area));
        strips.for_each(|line| drawn.add_line(line.to_vec()));
        for body in &self.scene.bodies {
            for outline in &body.outlines {
                outline.lines(&body.pose, &self.axes).into_iter().for_each(|line| drawn.add_line(line));
            }
            drawn.add_box(Rect::centred(self.view.pixel(body.pose.centre()), 11.0, 11.0));
        }
        for link in &self.scene.links {
            let [a, b] = link.ends.map(|p| self.view.pixel(p));
            marks::sides(a, b).into_iter().for_each(|line| drawn.add_line(line.to_vec()));
        }
        let pivots = self.scene.pivots.iter().map(|pivot| marks::pivot_box(self.view.pixel(pivot.at)));
        pivots.for_each(|place| drawn.add_box(place));
        self.strokes().iter().for_each(|(stroke, _)| drawn.add_arrow([stroke.tail, stroke.head]));
        self.rings().iter().for_each(|(ring, _)| drawn.add_bent_arrow(ring.points()));
        drawn
    }
}

/// The head of an arrow along a vector of the world, as long as its part of the largest is.
fn head(tail: Point, vector: Point, part: f64) -> Option<Point> {
    let [x, y] = unit(vector)?;
    Some(along(tail, [x, -y], (part * LONGEST).max(SHORTEST)))
}

/// Circles of material, as a whole where they are not much larger than everything else.
fn rounds(scene: &SceneDrawing, points: &[Point]) -> Vec<Point> {
    let size = Rect::around(points.iter().copied()).map_or(0.0, |all| all.width.max(all.height));
    let near = scene.surfaces.iter().filter_map(|surface| Some((surface.point, surface.round?.radius)));
    let near = near.filter(|(_, radius)| *radius <= LARGEST_ROUND * size);
    near.flat_map(|([x, y], radius)| [[x - radius, y - radius], [x + radius, y + radius]]).collect()
}

/// Ranges of x and y that hold everything with a place.
fn ranges(scene: &SceneDrawing) -> Option<[Range; 2]> {
    let bodies = scene.bodies.iter().flat_map(|body| {
        body.outlines.iter().flat_map(|outline| outline.extent(&body.pose)).chain([body.pose.centre()])
    });
    let named = scene.pivots.iter().chain(&scene.points).map(|point| point.at);
    let links = scene.links.iter().flat_map(|link| link.ends);
    let mut points: Vec<Point> = bodies.chain(named).chain(links).collect();
    if points.is_empty() {
        points.extend(scene.surfaces.iter().map(|surface| surface.point));
    }
    let feet: Vec<Point> = scene.surfaces.iter().filter_map(|s| s.foot_of_lowest(&points)).collect();
    points.extend(feet);
    points.extend(rounds(scene, &points));
    let [x, y] = Range::of_points(&points)?;
    // A lone point is shown with a metre around it.
    let size = x.span().max(y.span());
    let room = if size > 0.0 { 2.0 * PADDING * size } else { 1.0 };
    Some([x, y].map(|range| range.widened(range.span() + room).opened()))
}
