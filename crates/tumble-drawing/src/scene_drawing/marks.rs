//! Signs for pivots, springs, gravity and wind.

use super::SceneDrawing;
use crate::free_body::draw;
use crate::free_body::strokes::{Form, Stroke};
use crate::geometry::{Point, along, minus, plus, times, turned, unit};
use crate::placing::Occupancy;
use crate::rect::Rect;
use crate::scene_drawing::LinkKind;
use crate::svg::{Element, PathData, circle};
use crate::text::{Label, PlacedText};
use crate::theme::{AIR, GREY, HAIRLINE, INK, LineStyle, PAPER, SMALL, WEIGHT};

/// Half the width and the height of a pivot's triangle, in pixels.
const PIVOT: [f64; 2] = [9.0, 13.0];
/// Half the width of a spring, and its turns.
const WIDTH: f64 = 7.0;
const TURNS: usize = 7;
/// Length of the arrows of gravity and wind, and room around them.
const FIELD: f64 = 46.0;
const FIELD_ROOM: f64 = 10.0;
/// Number of arrows of the wind and their distance.
const WINDS: usize = 3;
const WIND_STEP: f64 = 11.0;
/// Places tried along each side of the picture for such arrows.
const TRIES: usize = 8;

/// A triangle below a ring, on hatched ground.
pub(super) fn pivot(at: Point) -> Element {
    let [half, height] = PIVOT;
    let base = [at[0], at[1] + height];
    let corners = [at, plus(base, [half, 0.0]), plus(base, [-half, 0.0])];
    let triangle = PathData::polygon(&corners).fill(PAPER).stroked(INK, 1.2);
    let mut hatching = PathData::polyline(&[plus(base, [-1.4 * half, 0.0]), plus(base, [1.4 * half, 0.0])]);
    for i in -2..=2 {
        let top = plus(base, [5.0 * f64::from(i) + 2.0, 0.0]);
        hatching.add_polyline(&[top, plus(top, [-5.0, 5.0])]);
    }
    let hatching = hatching.stroke(GREY, HAIRLINE);
    let ring = circle(at, 3.2).attr("fill", PAPER).stroked(INK, 1.2);
    Element::new("g").child(hatching).child(triangle).child(ring)
}

/// The place that the sign of a pivot takes.
pub(super) fn pivot_box(at: Point) -> Rect {
    let [half, height] = PIVOT;
    Rect::new(at[0] - 1.4 * half, at[1] - 4.0, 2.8 * half, height + 10.0)
}

/// A spring or damper between two points of the page.
pub(crate) fn link(kind: LinkKind, [a, b]: [Point; 2]) -> Element {
    let axis = minus(b, a);
    let side = turned(unit(axis).unwrap_or([1.0, 0.0]));
    let at = |part: f64, off: f64| along(plus(a, times(axis, part)), side, off);
    let path = match kind {
        LinkKind::Spring => PathData::polyline(&spring(&at)),
        LinkKind::Damper => {
            let mut path = PathData::polyline(&[a, at(0.35, 0.0)]);
            path.add_polyline(&[at(0.65, WIDTH), at(0.35, WIDTH), at(0.35, -WIDTH), at(0.65, -WIDTH)]);
            path.add_polyline(&[at(0.55, 0.7 * WIDTH), at(0.55, -0.7 * WIDTH)]);
            path.add_polyline(&[at(0.55, 0.0), b]);
            path
        }
    };
    path.stroke(INK, 1.3).attr("stroke-linejoin", "round")
}

fn spring(at: &impl Fn(f64, f64) -> Point) -> Vec<Point> {
    let count = 2 * TURNS;
    let peak = |i: usize| {
        at(0.12 + 0.76 * (i as f64 + 0.5) / count as f64, if i.is_multiple_of(2) { WIDTH } else { -WIDTH })
    };
    let ends = ([at(0.0, 0.0), at(0.12, 0.0)], [at(0.88, 0.0), at(1.0, 0.0)]);
    ends.0.into_iter().chain((0..count).map(peak)).chain(ends.1).collect()
}

/// Lines along both sides of a link, which labels must not cross.
pub(super) fn sides(a: Point, b: Point) -> [[Point; 2]; 2] {
    let side = turned(unit(minus(b, a)).unwrap_or([1.0, 0.0]));
    [WIDTH, -WIDTH].map(|off| [along(a, side, off), along(b, side, off)])
}

/// The arrows of gravity and wind where there is room for them; the room is then taken.
pub(super) fn fields(scene: &SceneDrawing, area: &Rect, drawn: &mut Occupancy) -> Vec<Element> {
    let gravity = scene.gravity.as_ref().and_then(|(g, label)| field(*g, label, WEIGHT, 1, area, drawn));
    let wind = scene.wind.as_ref().and_then(|(w, label)| field(*w, label, AIR, WINDS, area, drawn));
    gravity.into_iter().chain(wind).collect()
}

fn field(
    vector: Point,
    label: &Label,
    style: LineStyle,
    count: usize,
    area: &Rect,
    drawn: &mut Occupancy,
) -> Option<Element> {
    let [x, y] = unit(vector)?;
    let forward = [x, -y];
    let text = [label.width(SMALL), 1.2 * SMALL];
    let depth = WIND_STEP * (count as f64 - 1.0) + 10.0;
    let arrows = [FIELD * x.abs() + depth * y.abs(), FIELD * y.abs() + depth * x.abs()];
    // The label stands beside upright arrows and below level ones.
    let upright = y.abs() > x.abs();
    let size = if upright {
        [arrows[0] + 4.0 + text[0], arrows[1].max(text[1])]
    } else {
        [arrows[0].max(text[0]), arrows[1] + text[1]]
    };
    let place = free_place(size, area, drawn);
    drawn.add_box(place.grown(FIELD_ROOM / 2.0));
    let [x, y] = place.centre();
    let (centre, corner) = if upright {
        ([place.x + arrows[0] / 2.0, y], [place.right() - text[0], y - text[1] / 2.0])
    } else {
        ([x, place.y + arrows[1] / 2.0], [x - text[0] / 2.0, place.bottom() - text[1]])
    };
    let label_place = Rect::new(corner[0], corner[1], text[0], text[1]);
    let stroke = |i: usize| {
        let off = WIND_STEP * (i as f64 - (count as f64 - 1.0) / 2.0);
        let middle = along(centre, turned(forward), off);
        arrow(middle, forward, style)
    };
    let name = PlacedText::centred(label, &label_place, SMALL).colour(style.colour).element();
    Some(Element::new("g").children((0..count).map(stroke)).child(name))
}

fn arrow(middle: Point, forward: Point, style: LineStyle) -> Element {
    let ends = [-0.5, 0.5].map(|part| along(middle, forward, part * FIELD));
    draw::arrow(&Stroke::new(ends, style, Form::Full))
}

/// The place along the upper and right, then the other sides that covers least.
fn free_place([width, height]: [f64; 2], area: &Rect, drawn: &Occupancy) -> Rect {
    let room = [area.width - width - 2.0 * FIELD_ROOM, area.height - height - 2.0 * FIELD_ROOM];
    let at = |part: [f64; 2]| {
        let corner = [0, 1].map(|k| FIELD_ROOM + part[k] * room[k].max(0.0));
        Rect::new(area.x + corner[0], area.y + corner[1], width, height)
    };
    let part = |i: usize| i as f64 / TRIES as f64;
    let top = (0..=TRIES).map(|i| [1.0 - part(i), 0.0]);
    let right = (0..=TRIES).map(|i| [1.0, part(i)]);
    let left = (0..=TRIES).map(|i| [0.0, part(i)]);
    let bottom = (0..=TRIES).map(|i| [1.0 - part(i), 1.0]);
    let places = top.chain(right).chain(left).chain(bottom).map(at);
    let burden = |place: &Rect| drawn.burden(&place.grown(FIELD_ROOM / 2.0));
    let first = at([1.0, 0.0]);
    places
        .fold((burden(&first), first), |best, place| {
            let cost = burden(&place);
            if cost < best.0 { (cost, place) } else { best }
        })
        .1
}
