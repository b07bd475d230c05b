//! Where the parts of a panel lie on the page.

use crate::axes::Axes;
use crate::outline::Plane;
use crate::rect::Rect;

use super::body::FreeBodyDiagram;
use super::circular_arrow::rings;
use super::cone::Cone;
use super::strokes::{spreads, strokes};
use crate::geometry::{Point, along, direction};

/// A map from world coordinates to the page that keeps its digits far from the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    /// The world point that is drawn at `at`, metres.
    pub(crate) centre: Point,
    /// Its place on the page, pixels.
    pub(crate) at: Point,
    /// Pixels per metre.
    pub(crate) density: f64,
}

impl View {
    /// The map of axes with the same scale in both directions.
    pub(crate) fn of(axes: &Axes) -> Self {
        let centre = [axes.x.range.middle(), axes.y.range.middle()];
        Self { centre, at: axes.pixel(centre), density: axes.x.density() }
    }

    pub(crate) fn world(&self, [x, y]: Point) -> Point {
        let [x, y] = [x - self.at[0], self.at[1] - y];
        [self.centre[0] + x / self.density, self.centre[1] + y / self.density]
    }
}

impl Plane for View {
    fn pixel(&self, [x, y]: Point) -> Point {
        let [x, y] = [x - self.centre[0], y - self.centre[1]];
        [self.at[0] + x * self.density, self.at[1] - y * self.density]
    }

    fn density(&self) -> f64 {
        self.density
    }
}

/// The scales of a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scales {
    /// Pixels per metre.
    pub(crate) density: f64,
    /// Length of the longest arrow in pixels, and what it stands for.
    pub(crate) arrow: f64,
    pub(crate) largest: f64,
    /// The speed whose arrow is longest, in m/s.
    pub(crate) fastest: f64,
}

impl Scales {
    /// Length in pixels of an arrow that stands for so much. In this order the largest and smallest numbers neither overflow nor vanish.
    pub(super) fn length(&self, magnitude: f64) -> f64 {
        magnitude / self.largest * self.arrow
    }
}

/// Length of the arms of a marked angle, and radius of its arc, in pixels.
pub(crate) const ARM: f64 = 46.0;
pub(crate) const ARC_RADIUS: f64 = 35.0;
/// A surface nearer than this, in sizes of the body, belongs into the picture.
const NEAR: f64 = 0.6;

/// World points that bound the body itself, with its points of action.
pub(crate) fn body_points(body: &FreeBodyDiagram) -> Vec<Point> {
    let outlines = body.outlines.iter().flat_map(|outline| outline.extent(&body.pose));
    let forces = body.forces.iter().chain(&body.resultant).map(|force| force.point);
    let arms = body.arms.iter().map(|arm| arm.at);
    outlines.chain(forces).chain(arms).chain([body.pose.centre()]).collect()
}

/// Width and height of the body with its points of action, in metres.
pub(crate) fn body_size(body: &FreeBodyDiagram) -> [f64; 2] {
    Rect::around(body_points(body)).map_or([0.0; 2], |r| [r.width, r.height])
}

/// What a body and its arrows take, in pixels about its centre of mass.
pub(super) fn about_centre(body: &FreeBodyDiagram, scales: &Scales) -> Rect {
    let view = View { centre: body.pose.centre(), at: [0.0; 2], density: scales.density };
    bounds(body, &view, scales)
}

/// The space on the page that everything drawn in a panel needs.
pub(crate) fn bounds(body: &FreeBodyDiagram, view: &View, scales: &Scales) -> Rect {
    let mut points: Vec<_> = body_points(body).into_iter().map(|p| view.pixel(p)).collect();
    let strokes = strokes(body, view, scales);
    points.extend(strokes.iter().flat_map(|stroke| [stroke.tail, stroke.head]));
    points.extend(cones(body, view, scales).iter().flat_map(Cone::lines).flatten());
    points.extend(spreads(body, view).into_iter().flat_map(|(_, arrows)| arrows).flatten());
    points.extend(rings(body, view, &strokes).iter().flat_map(|ring| ring.points()));
    points.extend(angle_arms(body, view).into_iter().flatten());
    points.extend(near_surfaces(body, view));
    Rect::around(points).unwrap_or(Rect::centred(view.at, 0.0, 0.0))
}

/// The cones of friction of a panel.
pub(super) fn cones(body: &FreeBodyDiagram, view: &View, scales: &Scales) -> Vec<Cone> {
    body.cones.iter().filter_map(|cone| cone.place(view, scales)).collect()
}

/// Pixels below the body where near surfaces end.
fn near_surfaces(body: &FreeBodyDiagram, view: &View) -> Vec<Point> {
    let size = body_size(body);
    let near = NEAR * size[0].hypot(size[1]);
    let points = body_points(body);
    let foot = |surface: &super::surface::Ground| {
        let lowest = points.iter().min_by(|a, b| surface.height(**a).total_cmp(&surface.height(**b)))?;
        let foot = view.pixel(surface.foot(*lowest));
        let [below] = surface.below([foot]);
        (surface.height(*lowest) <= near).then_some([foot, below])
    };
    body.surfaces.iter().filter_map(foot).flatten().collect()
}

/// Vertex of the marked angle on the page.
pub(crate) fn angle_vertex(body: &FreeBodyDiagram, view: &View) -> Option<Point> {
    body.angle.is_some().then(|| view.pixel(body.pose.centre()))
}

/// The arms of the marked angle: the reference and the turned one.
pub(crate) fn angle_arms(body: &FreeBodyDiagram, view: &View) -> Vec<[Point; 2]> {
    let (Some(angle), Some(vertex)) = (&body.angle, angle_vertex(body, view)) else { return Vec::new() };
    let arm = |turn: f64| [vertex, along(vertex, direction(turn), ARM)];
    vec![arm(angle.reference), arm(angle.reference + angle.value)]
}

/// Outlines of the body on the page, closed; rods with their thickness.
pub(crate) fn faces(body: &FreeBodyDiagram, view: &View) -> Vec<Vec<Point>> {
    body.outlines.iter().filter_map(|outline| outline.face(&body.pose, view)).collect()
}
