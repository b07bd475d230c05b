//! Places where a label may stand, with what they cost before anything else is known.

use super::occupancy::{CLEARANCE, beside};
use crate::rect::Rect;

use crate::geometry::{Point, along, dot, minus, plus, times, turned, unit};

/// Distance of labels from what they belong to, in pixels.
const DISTANCE: f64 = 5.0;
/// Parts of a shaft beside which labels may stand, best first.
const SHAFT_PARTS: [f64; 5] = [0.6, 0.8, 0.4, 0.2, 0.95];
/// Directions about an arrowhead, in turns from its own direction.
const HEAD_TURNS: u32 = 16;
/// Distances tried, in steps of this many pixels, and their number.
const RING_STEP: f64 = 7.0;
const RINGS: u32 = 4;
/// Distance between places far away that are beside each other, in pixels.
const GRID: f64 = 11.0;
/// What keeps rows from overlapping by rounding, in pixels.
const ROUNDING: f64 = 1e-3;
/// Cost of a step away.
const STEP_COST: f64 = 4.0;
/// Costs of places at the side of a shaft, and of a head, instead of the best one.
const SIDE_COST: f64 = 1.5;
const TURN_COST: f64 = 6.0;

/// A place and its cost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) place: Rect,
    pub(crate) cost: f64,
}

/// Places about the head and beside the shaft of an arrow, for a label of `size`.
pub(crate) fn about_arrow([tail, head]: [Point; 2], size: [f64; 2]) -> Vec<Candidate> {
    let Some(forward) = unit(minus(head, tail)) else { return about_point(head, DISTANCE, size) };
    let mut candidates = about_head(head, forward, size);
    candidates.extend(beside_shaft([tail, head], size));
    candidates
}

/// Places about both ends and on both sides of a line.
pub(crate) fn about_line([from, to]: [Point; 2], size: [f64; 2]) -> Vec<Candidate> {
    [[from, to], [to, from]].into_iter().flat_map(|arrow| about_arrow(arrow, size)).collect()
}

/// Places on both sides of a line.
pub(crate) fn beside_shaft([tail, head]: [Point; 2], size: [f64; 2]) -> Vec<Candidate> {
    let Some(forward) = unit(minus(head, tail)) else { return vec![] };
    let side = turned(forward);
    let place = |(i, part): (usize, f64)| {
        let at = plus(tail, times(minus(head, tail), part));
        let cost = SIDE_COST * (i as f64 + 0.5);
        [side, times(side, -1.0)]
            .into_iter()
            .flat_map(move |normal| steps(at, normal, DISTANCE + 2.0, size, cost))
    };
    SHAFT_PARTS.into_iter().enumerate().flat_map(place).collect()
}

fn about_head(head: Point, forward: Point, size: [f64; 2]) -> Vec<Candidate> {
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(HEAD_TURNS);
    let directions = (0..HEAD_TURNS).map(|i| {
        let (sin, cos) = turn(i).sin_cos();
        plus(times(forward, cos), times(turned(forward), sin))
    });
    let turned_away = |direction: Point| TURN_COST * (1.0 - dot(direction, forward));
    directions.flat_map(|d| steps(head, d, DISTANCE, size, turned_away(d))).collect()
}

/// Places on one side of a point, one behind the other.
fn steps(at: Point, direction: Point, distance: f64, size: [f64; 2], cost: f64) -> Vec<Candidate> {
    let step = |i: u32| {
        let distance = distance + RING_STEP * f64::from(i);
        Candidate { place: supported(at, direction, distance, size), cost: cost + STEP_COST * f64::from(i) }
    };
    (0..RINGS).map(step).collect()
}

/// The rectangle whose side nearest to `at`, seen along `direction` (a unit vector), is `distance` away.
fn supported(at: Point, direction: Point, distance: f64, [width, height]: [f64; 2]) -> Rect {
    let support = direction[0].abs() * width / 2.0 + direction[1].abs() * height / 2.0;
    Rect::centred(along(at, direction, distance + support), width, height)
}

/// Places around a point.
pub(crate) fn about_point(at: Point, distance: f64, [width, height]: [f64; 2]) -> Vec<Candidate> {
    const DIRECTIONS: [Point; 8] = [
        [1.0, -1.0],
        [-1.0, -1.0],
        [1.0, 1.0],
        [-1.0, 1.0],
        [1.0, 0.0],
        [-1.0, 0.0],
        [0.0, -1.0],
        [0.0, 1.0],
    ];
    let place = |i: u32, direction: Point| Candidate {
        place: beside(at, direction, distance + RING_STEP * f64::from(i), width, height),
        cost: STEP_COST * f64::from(i),
    };
    (0..RINGS).flat_map(|i| DIRECTIONS.map(|direction| place(i, direction))).collect()
}

/// Places outside an arc, best at its middle.
pub(crate) fn about_arc(centre: Point, points: &[Point], size: [f64; 2]) -> Vec<Candidate> {
    let middle = (points.len() as f64 - 1.0) / 2.0;
    let place = |(i, p): (usize, &Point)| {
        let away = unit(minus(*p, centre)).unwrap_or([1.0, 0.0]);
        let cost = 3.0 * ((i as f64 - middle) / middle.max(1.0)).abs();
        steps(*p, away, DISTANCE, size, cost)
    };
    points.iter().enumerate().step_by(2).flat_map(place).collect()
}

/// Places all over `area`, at one cost.
pub(crate) fn anywhere(area: &Rect, [width, height]: [f64; 2], cost: f64) -> Vec<Candidate> {
    // Every other row is as close as labels may stand above each other.
    let row = (height + CLEARANCE) / 2.0 + ROUNDING;
    let count = |room: f64, step: f64| (room / step).floor().clamp(0.0, 200.0) as u32;
    let (columns, rows) = (count(area.width - width, GRID), count(area.height - height, row));
    let place = |i: u32, j: u32| {
        let (x, y) = (area.x + GRID * f64::from(i), area.y + row * f64::from(j));
        Candidate { place: Rect::new(x, y, width, height), cost }
    };
    (0..=columns).flat_map(|i| (0..=rows).map(move |j| place(i, j))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_other_row_is_as_close_as_labels_may_stand() {
        let size = [40.0, 17.0];
        let mut rows: Vec<f64> =
            anywhere(&Rect::new(0.0, 0.0, 200.0, 200.0), size, 0.0).iter().map(|one| one.place.y).collect();
        rows.dedup();
        let first = Rect::new(0.0, rows[0], size[0], size[1]).grown(CLEARANCE);
        let shared = |row: usize| first.overlap(&Rect::new(0.0, rows[row], size[0], size[1]));
        assert!(shared(1) > 0.0 && shared(2) == 0.0 && rows[2] - rows[0] < 17.0 + CLEARANCE + 0.01);
    }
}
