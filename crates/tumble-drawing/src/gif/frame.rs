//! One frame of a motion as a drawing.

use crate::animation::{MovingBody, MovingCase, MovingLink};
use crate::free_body::layout::View;
use crate::geometry::{Point, along, minus, times, unit};
use crate::outline::{Pen, Plane, Pose};
use crate::rect::Rect;
use crate::scale::drawable;
use crate::scale_bar;
use crate::scene_drawing::marks;
use crate::svg::{Element, PathData, Svg, circle};
use crate::text::{Label, PlacedText, TextAnchor};
use crate::theme::{INK, LineStyle, SMALL};
use crate::thin::{pieces, simplified};

/// Room around the motion as a part of its larger side, and below it for the scale bar, in pixels.
const PADDING: f64 = 0.08;
const BELOW: f64 = 44.0;
/// Bounds of the height as parts of the width.
const HEIGHTS: [f64; 2] = [0.25, 1.2];
/// Radius of the dot at the centre of mass, and thickness and dashes of its path.
const CENTRE: f64 = 2.4;
const TRAIL: f64 = 1.1;
const TRAIL_DASHES: &str = "2 2.5";
/// How far a simplified path may lie beside the true one, in pixels.
const TOLERANCE: f64 = 0.1;

/// A motion with the space it takes.
pub(super) struct Scene<'a> {
    motion: &'a MovingCase,
    /// In metres, y upwards.
    bounds: Rect,
}

impl<'a> Scene<'a> {
    /// `None` if nothing in the motion can be drawn.
    pub(super) fn new(motion: &'a MovingCase) -> Option<Self> {
        let [left, bottom, right, top] = motion.extent()?;
        let room = (PADDING * (right - left).max(top - bottom)).max(f64::MIN_POSITIVE);
        let bounds = Rect::new(left, bottom, right - left, top - bottom).grown(room);
        let finite = motion.times.iter().copied().all(drawable);
        (finite && !motion.times.is_empty()).then_some(Self { motion, bounds })
    }

    /// The scene at time `t`, `width` pixels wide.
    pub(super) fn svg(&self, t: f64, width: f64) -> Svg {
        let [low, high] = HEIGHTS.map(|part| (part * width).round());
        let tall = (self.bounds.height / self.bounds.width * width).clamp(low, high).round();
        let density = (width / self.bounds.width).min(tall / self.bounds.height);
        let view = View { centre: self.bounds.centre(), at: [width / 2.0, tall / 2.0], density };
        let area = Rect::new(0.0, 0.0, width, tall);
        let mut svg = Svg::on_paper(width, tall + BELOW, "");
        svg.push(crate::axes::clipped(area, self.contents(t, &view, &area)));
        svg.push(scale_bar::draw([width - 12.0, tall + 6.0], density, "m"));
        let time = Label::symbol("t").then(Label::plain(&format!(" = {:.*} s", self.decimals(), t)));
        svg.push(PlacedText::new(&time, [12.0, tall + 26.0], SMALL, TextAnchor::Start).element());
        svg
    }

    fn decimals(&self) -> usize {
        let [from, to] = self.motion.span();
        let duration = to - from;
        if duration > 0.0 { (2.0 - duration.log10().floor()).clamp(0.0, 9.0) as usize } else { 2 }
    }

    fn contents(&self, t: f64, view: &View, area: &Rect) -> Vec<Element> {
        let motion = self.motion;
        let surfaces = motion.surfaces.iter().filter(|surface| surface.is_drawable());
        let mut parts: Vec<Element> = surfaces.filter_map(|surface| surface.draw(view, area)).collect();
        let (low, part) = self.place(t);
        let bodies = || motion.bodies.iter().enumerate();
        parts.extend(bodies().filter_map(|(i, body)| trail(body, low, i, view)));
        parts.extend(bodies().flat_map(|(i, body)| draw_body(body, &pose(body, low, part), i, view)));
        parts.extend(motion.links.iter().filter_map(|link| draw_link(link, low, part, view)));
        parts
            .extend(motion.points.iter().map(|point| circle(view.pixel(point.at), CENTRE).attr("fill", INK)));
        parts
    }

    /// The frame before time `t`, and how far `t` is on the way to the next.
    fn place(&self, t: f64) -> (usize, f64) {
        let times = &self.motion.times;
        let high = times.partition_point(|other| *other <= t).min(times.len() - 1);
        let low = high.saturating_sub(1);
        let span = times[high] - times[low];
        (low, if span > 0.0 { ((t - times[low]) / span).clamp(0.0, 1.0) } else { 0.0 })
    }
}

/// A value between those of two frames; the last one stays where there are too few.
fn pose(body: &MovingBody, low: usize, part: f64) -> Pose {
    let at = |i: usize| body.poses.get(i).or(body.poses.last()).copied().unwrap_or_default();
    let (a, b) = (at(low), at(low + 1));
    let between = |a: f64, b: f64| a + part * (b - a);
    Pose { t: 0.0, x: between(a.x, b.x), y: between(a.y, b.y), angle: between(a.angle, b.angle) }
}

fn draw_body(body: &MovingBody, pose: &Pose, index: usize, view: &View) -> Vec<Element> {
    if body.poses.is_empty() || !pose.is_drawable() {
        return Vec::new();
    }
    let pen = Pen { colour: LineStyle::of(index).colour, hollow: false };
    let centre = circle(view.pixel(pose.centre()), CENTRE).attr("fill", INK);
    body.outlines.iter().flat_map(|shape| shape.draw(pose, view, pen)).chain([centre]).collect()
}

fn trail(body: &MovingBody, low: usize, index: usize, view: &View) -> Option<Element> {
    let centres = body.poses.iter().take(low + 1).map(|pose| view.pixel(pose.centre()));
    let mut path = PathData::default();
    pieces(centres).iter().for_each(|piece| path.add_polyline(&simplified(piece, TOLERANCE)));
    body.trail.then(|| path.stroke(LineStyle::of(index).colour, TRAIL).dashed(TRAIL_DASHES))
}

fn draw_link(link: &MovingLink, low: usize, part: f64, view: &View) -> Option<Element> {
    let at = |i: usize| link.ends.get(i).or(link.ends.last());
    let (a, b) = (at(low)?, at(low + 1)?);
    let between = |k: usize| -> Point { along(a[k], minus(b[k], a[k]), part) };
    let ends = [between(0), between(1)];
    unit(times(minus(ends[1], ends[0]), view.density()))?;
    ends.iter().flatten().all(|v| drawable(*v)).then(|| marks::link(link.kind, ends.map(|p| view.pixel(p))))
}
