//! Plane geometry on the page (pixels, y down).

use crate::rect::Rect;

/// A point or a vector.
pub(crate) type Point = [f64; 2];

pub(crate) fn plus(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn times(a: Point, factor: f64) -> Point {
    [factor * a[0], factor * a[1]]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn length(a: Point) -> f64 {
    a[0].hypot(a[1])
}

/// The unit vector along `a`; `None` if it has no direction.
pub(crate) fn unit(a: Point) -> Option<Point> {
    // Two steps keep the tiniest vectors.
    let largest = a[0].abs().max(a[1].abs());
    let scaled = [a[0] / largest, a[1] / largest];
    let length = length(scaled);
    (largest > 0.0 && length.is_finite()).then(|| [scaled[0] / length, scaled[1] / length])
}

/// The point `distance` from `start` along a direction.
pub(crate) fn along(start: Point, direction: Point, distance: f64) -> Point {
    plus(start, times(direction, distance))
}

/// The vector turned by a quarter.
pub(crate) fn turned([x, y]: Point) -> Point {
    [-y, x]
}

/// The page direction of an angle counted counter-clockwise from the x axis.
pub(crate) fn direction(angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    [cos, -sin]
}

/// Angle between points of an arc, in radians.
const ARC_STEP: f64 = 0.1;

/// Points of an arc of an angle `sweep` from `start` (radians, counter-clockwise as seen).
pub(crate) fn arc(centre: Point, radius: f64, start: f64, sweep: f64) -> Vec<Point> {
    let steps = (sweep.abs() / ARC_STEP).ceil().clamp(1.0, 100.0);
    let at = |i: i32| along(centre, direction(start + sweep * f64::from(i) / steps), radius);
    (0..=steps as i32).map(at).collect()
}

/// The point of the straight line from `a` to `b` nearest to `p`.
pub(crate) fn nearest(p: Point, [a, b]: [Point; 2]) -> Point {
    let d = minus(b, a);
    let square = dot(d, d);
    let t = if square > 0.0 { (dot(minus(p, a), d) / square).clamp(0.0, 1.0) } else { 0.0 };
    along(a, d, t)
}

/// How much nearer an end of a rectangle must be than its middle to be taken, per pixel.
const CENTRAL: f64 = 1e-3;

/// Ratio of squares beyond which one length is larger than another whatever rounding does.
const FARTHER: f64 = 1.0 + 1e-9;

/// The nearest points of a rectangle and a polyline, in this order, and their
/// distance; 0 where they meet.
pub(crate) fn gap(place: &Rect, line: &[Point]) -> ([Point; 2], f64) {
    let onto = |p: Point| [p[0].clamp(place.x, place.right()), p[1].clamp(place.y, place.bottom())];
    let mut best = ([place.centre(), place.centre()], f64::INFINITY);
    let mut least = f64::INFINITY;
    let mut consider = |pair: [Point; 2]| {
        let between = minus(pair[0], pair[1]);
        // The rank is at least the distance: most pairs are out of it before a root is taken.
        if dot(between, between) > FARTHER * least * least {
            return;
        }
        let distance = length(between);
        let rank = distance + CENTRAL * length(minus(pair[1], place.centre()));
        if rank < least {
            (best, least) = ((pair, distance), rank);
        }
    };
    for p in line {
        consider([onto(*p), *p]);
    }
    for w in line.windows(2) {
        if let Some([p, _]) = place.clipped_line(w[0], w[1]) {
            consider([p, p]);
        }
        let opposite = nearest(place.centre(), [w[0], w[1]]);
        consider([onto(opposite), opposite]);
        for corner in corners(place) {
            consider([corner, nearest(corner, [w[0], w[1]])]);
        }
    }
    best
}

/// The corners of a rectangle, going round.
pub(crate) fn corners(r: &Rect) -> [Point; 4] {
    [[r.x, r.y], [r.right(), r.y], [r.right(), r.bottom()], [r.x, r.bottom()]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_exist_for_the_tiniest_and_largest_vectors() {
        assert_eq!(unit([0.0, 0.0]), None);
        assert_eq!(unit([f64::NAN, 1.0]), None);
        for size in [1e-300, 1.0, 1e299] {
            let [x, y] = unit([3.0 * size, -4.0 * size]).expect("a direction");
            assert!((x - 0.6).abs() < 1e-15 && (y + 0.8).abs() < 1e-15);
        }
    }

    #[test]
    fn gaps_are_measured_between_nearest_points() {
        let place = Rect::new(0.0, 0.0, 10.0, 10.0);
        assert_eq!(gap(&place, &[[13.0, 14.0]]).1, 5.0);
        assert_eq!(gap(&place, &[[-5.0, 5.0], [15.0, 5.0]]).1, 0.0);
        assert_eq!(gap(&place, &[[-5.0, 12.0], [15.0, 12.0]]).1, 2.0);
    }

    #[test]
    fn arcs_run_counter_clockwise_as_seen() {
        let arc = arc([0.0, 0.0], 2.0, 0.0, std::f64::consts::FRAC_PI_2);
        let end = arc[arc.len() - 1];
        assert!(arc[0] == [2.0, 0.0] && (end[1] + 2.0).abs() < 1e-12, "y points down");
    }
}
