//! Circular arrows about the centre of mass.

use std::f64::consts::TAU;

use crate::outline::{Outline, Plane};
use crate::text::Label;
use crate::theme::{LineStyle, MOTION};

use super::body::FreeBodyDiagram;
use super::layout::{View, angle_arms};
use super::strokes::{Form, Stroke, equation};
use crate::geometry::{Point, arc, direction, dot, minus, plus, times};

/// Radius of the innermost circular arrow, and distance to the next, in pixels.
const RADIUS: f64 = 21.0;
const STEP: f64 = 9.0;
/// Angle that circular arrows span, in radians.
const SWEEP: f64 = 4.4;
/// Starts tried, in turns of a circle, and the one taken if nothing is in the way.
const STARTS: u32 = 24;
const FIRST_START: f64 = 0.6;
/// Heads cover this angle and some room, in radians.
const HEAD_ANGLE: f64 = 0.75;
/// What a line through the head costs, compared with one through the rest.
const HEAD_COST: f64 = 8.0;

/// A circular arrow on the page.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CircularArrow {
    pub(crate) centre: Point,
    pub(crate) radius: f64,
    /// Where it starts, in radians from the x axis.
    pub(crate) start: f64,
    /// Angle swept, counter-clockwise as seen, in radians.
    pub(crate) sweep: f64,
    pub(crate) style: LineStyle,
    pub(crate) form: Form,
}

impl CircularArrow {
    /// Points along the arrow from tail to head.
    pub(crate) fn points(&self) -> Vec<Point> {
        arc(self.centre, self.radius, self.start, self.sweep)
    }

    /// The direction in which its head points.
    pub(crate) fn head_direction(&self) -> Point {
        let radial = direction(self.start + self.sweep);
        times([radial[1], -radial[0]], self.sweep.signum())
    }
}

/// The circular arrows of a panel, couples and the angular velocity, turned
/// so that their heads are clear of other lines.
pub(crate) fn rings(body: &FreeBodyDiagram, view: &View, strokes: &[Stroke]) -> Vec<CircularArrow> {
    let couples = body.couples.iter().map(|couple| (couple.value, couple.kind.style(), Form::Full));
    let rate = body.rate.map(|rate| (rate, MOTION, Form::Thin));
    let centre = view.pixel(body.pose.centre());
    let lines = lines(body, view, strokes);
    let ring = |(i, (value, style, form)): (usize, (f64, LineStyle, Form))| {
        let (radius, sweep) = (RADIUS + STEP * i as f64, SWEEP * value.signum());
        let hits: Vec<f64> = lines.iter().flat_map(|line| crossings(*line, centre, radius)).collect();
        CircularArrow { centre, radius, start: clear_start(sweep, &hits), sweep, style, form }
    };
    couples.chain(rate).enumerate().map(ring).collect()
}

/// What should not run through a head.
fn lines(body: &FreeBodyDiagram, view: &View, strokes: &[Stroke]) -> Vec<[Point; 2]> {
    let rods = body.outlines.iter().filter_map(|outline| match outline {
        Outline::Segment { from, to } => Some([*from, *to].map(|p| view.pixel(body.pose.world(p)))),
        _ => None,
    });
    let arms = angle_arms(body, view);
    strokes.iter().map(|stroke| [stroke.tail, stroke.head]).chain(rods).chain(arms).collect()
}

/// Angles at which a straight line crosses a circle.
fn crossings([a, b]: [Point; 2], centre: Point, radius: f64) -> Vec<f64> {
    let (d, from) = (minus(b, a), minus(a, centre));
    let (square, half) = (dot(d, d), dot(d, from));
    let root = (half * half - square * (dot(from, from) - radius * radius)).sqrt();
    let hit = |t: f64| plus(from, times(d, t));
    let hits = [(-half - root) / square, (root - half) / square];
    hits.into_iter().filter(|t| (0.0..=1.0).contains(t)).map(hit).map(|[x, y]| (-y).atan2(x)).collect()
}

/// The start that keeps lines at the angles `hits` off the head first, then off the rest.
fn clear_start(sweep: f64, hits: &[f64]) -> f64 {
    let first = if sweep > 0.0 { FIRST_START } else { TAU / 2.0 - FIRST_START };
    let cost = |start: f64| {
        let one = |hit: &f64| {
            // How far the arrow has run when it meets the line.
            let run = ((hit - start) * sweep.signum()).rem_euclid(TAU);
            let (to_end, end) = ((run - sweep.abs()).abs(), sweep.abs());
            if to_end < HEAD_ANGLE { HEAD_COST * (1.5 - to_end / HEAD_ANGLE) } else { f64::from(run < end) }
        };
        hits.iter().map(one).sum::<f64>()
    };
    let starts = (0..STARTS).map(|i| first + TAU * f64::from(i) / f64::from(STARTS));
    let better = |a: (f64, f64), b: (f64, f64)| if b.0 < a.0 - 1e-9 { b } else { a };
    starts.map(|start| (cost(start), start)).reduce(better).map_or(first, |(_, start)| start)
}

/// Labels of the circular arrows, in their order.
pub(crate) fn ring_labels(body: &FreeBodyDiagram) -> Vec<Label> {
    let couples = body.couples.iter();
    let couples = couples.map(|c| equation(&c.symbol, c.value, &body.unit.couple));
    let rate = body.rate.map(|rate| equation(&Label::symbol("omega"), rate, "rad/s"));
    couples.chain(rate).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_keep_clear_of_lines() {
        for sweep in [SWEEP, -SWEEP] {
            for hit in 0..12 {
                let hit = TAU * f64::from(hit) / 12.0;
                let head = clear_start(sweep, &[hit]) + sweep;
                let apart = (head - hit).rem_euclid(TAU);
                assert!(apart.min(TAU - apart) >= HEAD_ANGLE, "{hit}: {apart}");
            }
        }
    }

    #[test]
    fn lines_cross_circles_where_they_do() {
        let hits = crossings([[0.0, 0.0], [0.0, 50.0]], [0.0, 0.0], 20.0);
        assert!(hits.len() == 1 && (hits[0] + TAU / 4.0).abs() < 1e-12, "downwards on the page");
        assert!(crossings([[30.0, 0.0], [30.0, 50.0]], [0.0, 0.0], 20.0).is_empty());
        assert!(crossings([[1.0, 1.0]; 2], [0.0, 0.0], 20.0).is_empty());
    }
}
