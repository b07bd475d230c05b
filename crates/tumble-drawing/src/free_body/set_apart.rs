//! Arrows that would lie on each other are moved sideways.

use super::strokes::Stroke;
use crate::geometry::{Point, dot, minus, times, turned};

/// Lines nearer than this to each other are read as one, in pixels.
const TOO_NEAR: f64 = 6.0;
/// Arrows that share less than this of their length only touch, in pixels.
const SHARED: f64 = 4.0;
/// Distance between arrows set apart, and how far a crowd may spread in all, in pixels.
const SPACING: f64 = 9.0;
const GREATEST_SPREAD: f64 = 54.0;

/// Moves arrows that lie on each other sideways, alternately to both sides.
pub(super) fn set_apart(strokes: &mut [Stroke]) {
    let groups = groups(strokes);
    for group in groups.iter().filter(|group| group.len() > 1) {
        let side = turned(strokes[group[0]].direction());
        let last = (group.len() - 1) as f64;
        let spacing = SPACING.min(GREATEST_SPREAD / last);
        for (i, member) in group.iter().enumerate() {
            strokes[*member].moved(times(side, spacing * (i as f64 - last / 2.0)));
        }
    }
}

/// Sets of arrows that lie on each other, directly or through others.
fn groups(strokes: &[Stroke]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for i in 0..strokes.len() {
        let touches = |group: &Vec<usize>| group.iter().any(|j| lie_together(&strokes[i], &strokes[*j]));
        let (touching, mut others): (Vec<_>, Vec<_>) = groups.into_iter().partition(touches);
        let mut joined: Vec<usize> = touching.into_iter().flatten().collect();
        joined.push(i);
        others.push(joined);
        groups = others;
    }
    groups
}

/// Whether two arrows run along each other for a visible length.
fn lie_together(a: &Stroke, b: &Stroke) -> bool {
    runs_along(a, b) || runs_along(b, a)
}

fn runs_along(a: &Stroke, b: &Stroke) -> bool {
    let u = a.direction();
    let local = |p: Point| [dot(minus(p, a.tail), u), dot(minus(p, a.tail), turned(u))];
    let (tail, head) = (local(b.tail), local(b.head));
    let (first, last) = if tail[0] <= head[0] { (tail, head) } else { (head, tail) };
    let (low, high) = (first[0].max(0.0), last[0].min(a.length()));
    if high - low < SHARED {
        return false;
    }
    let height = |x: f64| first[1] + (last[1] - first[1]) * (x - first[0]) / (last[0] - first[0]);
    height(low).abs().max(height(high).abs()) < TOO_NEAR
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::free_body::strokes::Form;

    fn stroke(tail: Point, head: Point) -> Stroke {
        Stroke::new([tail, head], crate::theme::WEIGHT, Form::Full)
    }

    #[test]
    fn opposite_arrows_on_one_line_are_parted() {
        let mut pair = [stroke([0.0, 0.0], [0.0, 100.0]), stroke([0.0, 90.0], [0.0, 10.0])];
        set_apart(&mut pair);
        assert_eq!((pair[0].tail[0] - pair[1].tail[0]).abs(), SPACING);
        assert!(!lie_together(&pair[0], &pair[1]));
    }

    #[test]
    fn arrows_from_one_point_in_opposite_directions_stay() {
        let mut pair = [stroke([0.0, 0.0], [50.0, 0.0]), stroke([0.0, 0.0], [-50.0, 0.0])];
        let before = pair.clone();
        set_apart(&mut pair);
        assert_eq!(pair, before);
    }

    #[test]
    fn crossing_arrows_stay_and_crowds_stay_together() {
        let mut cross = [stroke([0.0, 0.0], [50.0, 0.0]), stroke([25.0, -25.0], [25.0, 25.0])];
        let before = cross.clone();
        set_apart(&mut cross);
        assert_eq!(cross, before);
        let mut crowd = vec![stroke([0.0, 0.0], [50.0, 0.0]); 30];
        set_apart(&mut crowd);
        let offsets = crowd.iter().map(|s| s.tail[1].abs());
        assert!(offsets.fold(0.0, f64::max) <= GREATEST_SPREAD / 2.0 + 1e-9);
    }
}
