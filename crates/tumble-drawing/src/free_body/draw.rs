//! How arrows, marks and leaders look.

use crate::svg::{Element, PathData, circle, line};
use crate::theme::{GREY, HAIRLINE, INK, LineStyle, PAPER};

use super::circular_arrow::CircularArrow;
use super::strokes::{Form, Stroke};
use crate::geometry::{Point, along, arc, length, minus, plus, times, turned, unit};

/// Length and half the width of arrowheads in pixels.
pub(crate) const HEAD_LENGTH: f64 = 11.0;
pub(crate) const HEAD_WIDTH: f64 = 4.6;
/// The same for velocities, and for forces along a line.
const THIN_HEAD: [f64; 2] = [7.0, 3.0];
const SMALL_HEAD: [f64; 2] = [5.0, 2.2];
/// Half the width of the shaft of a hollow arrow, and of its head.
const HOLLOW_SHAFT: f64 = 2.2;
const HOLLOW_HEAD: f64 = 5.6;
/// How far the shaft reaches into the head, so that no gap shows.
const INTO_HEAD: f64 = 2.0;
/// Half the height of break strokes, half their distance, and their lean.
const BREAK_HEIGHT: f64 = 5.5;
const BREAK_DISTANCE: f64 = 2.2;
const BREAK_LEAN: f64 = 2.2;
/// Radius of the mark of the centre of mass.
pub(crate) const CENTRE_RADIUS: f64 = 5.5;
/// Radius of dots at points of action.
const DOT_RADIUS: f64 = 2.3;

/// A straight arrow with its break, if it has one.
pub(crate) fn arrow(stroke: &Stroke) -> Element {
    match stroke.form {
        Form::Full => full(stroke),
        Form::Hollow => hollow(stroke),
        Form::Thin => thin(stroke),
    }
}

fn full(stroke: &Stroke) -> Element {
    let forward = stroke.direction();
    let neck = along(stroke.head, forward, INTO_HEAD - HEAD_LENGTH);
    let style = stroke.style;
    let head = head(stroke.head, forward, style);
    let shaft = shaft(&[stroke.start, neck], style);
    Element::new("g").child(head).child(shaft).children(stroke.broken.then(|| break_mark(stroke)))
}

fn shaft(points: &[Point], style: LineStyle) -> Element {
    PathData::polyline(points).stroke(style.colour, style.thickness).dashed(style.dashes)
}

fn head(tip: Point, forward: Point, style: LineStyle) -> Element {
    let back = along(tip, forward, -HEAD_LENGTH);
    let side = times(turned(forward), HEAD_WIDTH);
    let notch = along(tip, forward, 1.2 - HEAD_LENGTH);
    let outline = PathData::polygon(&[tip, plus(back, side), notch, minus(back, side)]);
    outline.fill(style.colour)
}

/// Two strokes across the shaft with paper between them: longer than to scale.
fn break_mark(stroke: &Stroke) -> Element {
    let forward = stroke.direction();
    let middle = times(plus(stroke.start, along(stroke.head, forward, -HEAD_LENGTH)), 0.5);
    bar_pair(middle, forward, stroke.style)
}

/// The two strokes of a break about `middle`.
pub(crate) fn bar_pair(middle: Point, forward: Point, style: LineStyle) -> Element {
    let lean = plus(times(turned(forward), BREAK_HEIGHT), times(forward, -BREAK_LEAN));
    let at = [-BREAK_DISTANCE, BREAK_DISTANCE].map(|d| along(middle, forward, d));
    let ends = at.map(|p| [plus(p, lean), minus(p, lean)]);
    let gap = PathData::polygon(&[ends[0][0], ends[1][0], ends[1][1], ends[0][1]]).fill(PAPER);
    let bar = |[a, b]: [Point; 2]| line(a, b).stroked(style.colour, 1.4);
    Element::new("g").attr("class", "break").child(gap).children(ends.map(bar))
}

fn hollow(stroke: &Stroke) -> Element {
    let (forward, style) = (stroke.direction(), stroke.style);
    let side = turned(forward);
    let neck = along(stroke.head, forward, -1.2 * HEAD_LENGTH);
    let half = [(stroke.start, HOLLOW_SHAFT), (neck, HOLLOW_SHAFT), (neck, HOLLOW_HEAD)];
    let mut outline: Vec<_> = half.iter().map(|(p, d)| along(*p, side, *d)).collect();
    outline.push(stroke.head);
    outline.extend(half.iter().rev().map(|(p, d)| along(*p, side, -d)));
    let outline = PathData::polygon(&outline).fill(PAPER).attr("stroke", style.colour);
    let outline = outline.attr("stroke-width", style.thickness).attr("stroke-linejoin", "round");
    Element::new("g").child(outline).children(stroke.broken.then(|| break_mark(stroke)))
}

fn thin(stroke: &Stroke) -> Element {
    let shaft = PathData::polyline(&[stroke.start, stroke.head]);
    thin_path(shaft, stroke.head, stroke.direction(), stroke.style)
}

fn thin_path(path: PathData, tip: Point, forward: Point, style: LineStyle) -> Element {
    open_head(path, tip, forward, THIN_HEAD, style)
}

fn open_head(mut path: PathData, tip: Point, forward: Point, size: [f64; 2], style: LineStyle) -> Element {
    let back = along(tip, forward, -size[0]);
    let side = times(turned(forward), size[1]);
    path.add_polyline(&[plus(back, side), tip, minus(back, side)]);
    path.stroke(style.colour, style.thickness)
}

/// Small arrows along a line, with a line along their heads.
pub(crate) fn spread(style: LineStyle, arrows: &[[Point; 2]]) -> Element {
    let heads: Vec<Point> = arrows.iter().map(|[_, head]| *head).collect();
    let rim = PathData::polyline(&heads).stroke(style.colour, HAIRLINE);
    let arrow = |[tail, head]: &[Point; 2]| {
        let forward = unit(minus(*head, *tail)).filter(|_| length(minus(*head, *tail)) > SMALL_HEAD[0])?;
        let shaft = PathData::polyline(&[*tail, *head]);
        Some(open_head(shaft, *head, forward, SMALL_HEAD, LineStyle { thickness: 1.0, ..style }))
    };
    Element::new("g").attr("class", "spread").child(rim).children(arrows.iter().filter_map(arrow))
}

/// A circular arrow.
pub(crate) fn ring(ring: &CircularArrow) -> Element {
    let (points, forward) = (ring.points(), ring.head_direction());
    let Some(tip) = points.last().copied() else { return Element::new("g") };
    if ring.form == Form::Thin {
        return thin_path(PathData::polyline(&points), tip, forward, ring.style);
    }
    // The head is straight: it is turned inwards by half the angle it spans.
    let lean = HEAD_LENGTH / ring.radius / 2.0 * ring.sweep.signum();
    let (sin, cos) = lean.sin_cos();
    let forward = [cos * forward[0] - sin * forward[1], sin * forward[0] + cos * forward[1]];
    let covered = (HEAD_LENGTH - INTO_HEAD) / ring.radius / ring.sweep.abs() * points.len() as f64;
    let short = points.len().saturating_sub(covered.ceil() as usize);
    let shaft_points = &points[..short.clamp(2, points.len())];
    Element::new("g").child(shaft(shaft_points, ring.style)).child(head(tip, forward, ring.style))
}

/// The quartered circle at the centre of mass.
pub(crate) fn centre_mark(at: Point) -> Element {
    let quarter = |start: f64| {
        let mut sector = arc(at, CENTRE_RADIUS, start, std::f64::consts::FRAC_PI_2);
        sector.push(at);
        PathData::polygon(&sector).fill(INK)
    };
    let rim = circle(at, CENTRE_RADIUS).attr("fill", PAPER).stroked(INK, 1.1);
    let quarters = [quarter(0.0), quarter(std::f64::consts::PI)];
    Element::new("g").attr("class", "centre-of-mass").child(rim).children(quarters)
}

/// The dot at a point of action.
pub(crate) fn dot(at: Point, style: LineStyle) -> Element {
    circle(at, DOT_RADIUS).attr("fill", style.colour).stroked(PAPER, HAIRLINE)
}

/// A dashed auxiliary line.
pub(crate) fn dashed(points: &[Point]) -> Element {
    PathData::polyline(points).stroke(GREY, 1.0).dashed("5 3")
}
