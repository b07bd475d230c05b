//! Which labels a scene has, and where they may stand.

use super::layout::Layout;
use crate::geometry::{Point, times};
use crate::outline::Plane;
use crate::placing::{Candidate, Tag, about_arc, about_arrow, about_line, about_point, beside, beside_shaft};
use crate::rect::Rect;
use crate::text::Label;
use crate::theme::{INK, MOTION, Rgb, SMALL};

/// Distance of names from points, and from pivots, in pixels.
const POINT_DISTANCE: f64 = 7.0;
const PIVOT_DISTANCE: f64 = 12.0;
/// Distance of names from the links they belong to.
const LINK_DISTANCE: f64 = 11.0;
/// More bodies than these have no names.
const MOST_NAMED: usize = 10;
/// Directions tried around a body, in order of preference.
const AROUND: [Point; 8] =
    [[0.6, -1.0], [-0.6, -1.0], [0.6, 1.0], [-0.6, 1.0], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0], [0.0, 1.0]];
/// Least distance of labels from the frame.
const EDGE: f64 = 5.0;
/// Longest label as a part of the picture's width; longer ones are cut.
const LONGEST: f64 = 0.6;

/// All labels of the scene.
pub(super) fn tags(layout: &Layout) -> Vec<Tag> {
    let mut tags = points(layout);
    tags.extend(bodies(layout));
    tags.extend(surfaces(layout));
    tags.extend(links(layout));
    tags.extend(motions(layout));
    tags.retain(|tag| !tag.label.is_empty());
    tags
}

fn tag(
    layout: &Layout,
    label: &Label,
    colour: Rgb,
    owner: Vec<Point>,
    near: impl Fn([f64; 2]) -> Vec<Candidate>,
) -> Tag {
    let label = label.fitted(SMALL, LONGEST * layout.axes.area.width);
    let mut near = near(Tag::extent(&label, SMALL));
    // What leaves the picture is cut off; if everything does, the placing weighs it.
    let inside = |candidate: &Candidate| layout.axes.area.encloses(&candidate.place.grown(EDGE));
    if near.iter().any(inside) {
        near.retain(inside);
    }
    Tag::new(label, colour, owner, near)
}

fn points(layout: &Layout) -> Vec<Tag> {
    let pivots = layout.scene.pivots.iter().map(|point| (point, PIVOT_DISTANCE));
    let points = layout.scene.points.iter().map(|point| (point, POINT_DISTANCE));
    let named = pivots.chain(points).map(|(point, distance)| {
        let at = layout.view.pixel(point.at);
        let near = |size| about_point(at, distance, size);
        // Among others it would be read as the name of one of them.
        Tag { far: Some(0.0), ..tag(layout, &point.name, INK, vec![at], near) }
    });
    named.collect()
}

fn bodies(layout: &Layout) -> Vec<Tag> {
    let body = |body: &super::SceneBody| {
        let at = layout.view.pixel(body.pose.centre());
        let rim: Vec<Point> =
            body.outlines.iter().flat_map(|o| o.spokes(&body.pose)).map(|p| layout.view.pixel(p)).collect();
        let owner = if rim.is_empty() { vec![at] } else { rim.clone() };
        let frame = Rect::around(owner.iter().copied()).unwrap_or(Rect::centred(at, 0.0, 0.0));
        let rods: Vec<Vec<Point>> = body.outlines.iter().map(|o| o.ends(&body.pose)).collect();
        let rods = rods.iter().filter_map(|ends| <[Point; 2]>::try_from(&ends[..]).ok());
        let rods: Vec<[Point; 2]> = rods.map(|ends| ends.map(|end| layout.view.pixel(end))).collect();
        let near = |size| {
            let beside_rods = rods.iter().flat_map(|ends| beside_shaft(*ends, size));
            about_body(at, &frame, size).into_iter().chain(beside_rods).collect()
        };
        tag(layout, &body.name, INK, owner, near)
    };
    let bodies = &layout.scene.bodies;
    // Of many, those that move have names: others' could not stand by them.
    bodies.iter().filter(|one| bodies.len() <= MOST_NAMED || one.velocity.is_some()).map(body).collect()
}

/// Places around the centre, then around the frame of a body.
fn about_body(at: Point, frame: &Rect, [width, height]: [f64; 2]) -> Vec<Candidate> {
    let reach = 0.5 * frame.width.min(frame.height);
    let rings = [14.0, 22.0, 32.0, reach + 8.0, reach + 18.0, reach + 30.0];
    let place = |(i, distance): (usize, f64)| {
        AROUND.map(|direction| Candidate {
            place: beside(at, direction, distance, width, height),
            cost: 3.0 * i as f64,
        })
    };
    rings.into_iter().enumerate().flat_map(place).collect()
}

fn surfaces(layout: &Layout) -> Vec<Tag> {
    let faces = |body: &super::SceneBody| {
        let faces = body.outlines.iter().filter_map(|outline| outline.face(&body.pose, &layout.view));
        faces.collect::<Vec<_>>()
    };
    let off: Vec<_> = layout.scene.bodies.iter().flat_map(faces).collect();
    let surface = |surface: &crate::free_body::Ground| {
        let line = surface.visible(&layout.view, &layout.axes.area)?;
        let near = |size| about_line(surface.below(line), size);
        Some(Tag { off: off.clone(), ..tag(layout, &surface.name, INK, line.to_vec(), near) })
    };
    layout.scene.surfaces.iter().filter_map(surface).collect()
}

fn links(layout: &Layout) -> Vec<Tag> {
    let link = |link: &super::SceneLink| {
        let [a, b] = link.ends.map(|p| layout.view.pixel(p));
        let middle = times([a[0] + b[0], a[1] + b[1]], 0.5);
        tag(layout, &link.name, INK, vec![a, b], |size| about_point(middle, LINK_DISTANCE, size))
    };
    layout.scene.links.iter().map(link).collect()
}

fn motions(layout: &Layout) -> Vec<Tag> {
    let bodies = &layout.scene.bodies;
    let straight = |(stroke, label): (crate::free_body::strokes::Stroke, &Label)| {
        let ends = [stroke.tail, stroke.head];
        tag(layout, label, stroke.style.colour, ends.to_vec(), |size| about_arrow(ends, size))
    };
    let rate = |(ring, i): (crate::free_body::circular_arrow::CircularArrow, usize)| {
        let (_, label) = bodies[i].rate.as_ref()?;
        let points = ring.points();
        Some(tag(layout, label, MOTION.colour, points.clone(), |size| about_arc(ring.centre, &points, size)))
    };
    let straight = layout.strokes().into_iter().map(straight);
    straight.chain(layout.rings().into_iter().filter_map(rate)).collect()
}
