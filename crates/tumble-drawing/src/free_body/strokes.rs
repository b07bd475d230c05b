//! Arrows on the page: where they start and end, straight and circular.

use crate::outline::Plane;
use crate::text::Label;
use crate::theme::{ARM, LineStyle, MOTION};

use super::arrow::{Arrow, ArrowKind, DistributedForce, Velocity};
use super::body::{FreeBodyDiagram, NamedPoint};
use super::draw::CENTRE_RADIUS;
use super::layout::{Scales, View};
use super::set_apart::set_apart;
use crate::geometry::{Point, along, length, minus, plus, times, unit};

/// Least length of an arrow in pixels: room for a head and a break in the shaft.
pub(crate) const LEAST_LENGTH: f64 = 34.0;
/// Least length of a velocity, whose shaft has no break.
const LEAST_MOTION: f64 = 18.0;
/// Length of the fastest velocity in pixels, and of the largest force per length.
const LONGEST_MOTION: f64 = 60.0;
const LONGEST_SPREAD: f64 = 30.0;

/// Significant digits of printed magnitudes.
pub(super) const DIGITS: usize = 3;

/// How an arrow is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// A full head: forces.
    Full,
    /// An outline: sums of forces.
    Hollow,
    /// An open head: velocities.
    Thin,
}

/// A straight arrow on the page.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stroke {
    pub(crate) tail: Point,
    pub(crate) head: Point,
    /// Where its shaft begins to be drawn: at the tail, or at the rim of the centre of mass.
    pub(crate) start: Point,
    /// The true point of action.
    pub(crate) point: Point,
    /// Whether it is longer than to scale.
    pub(crate) broken: bool,
    pub(crate) style: LineStyle,
    pub(crate) form: Form,
}

impl Stroke {
    /// From its point of action, to scale.
    pub(crate) fn new([tail, head]: [Point; 2], style: LineStyle, form: Form) -> Self {
        Self { tail, head, start: tail, point: tail, broken: false, style, form }
    }

    /// The point at some part of its length.
    pub(crate) fn at(&self, part: f64) -> Point {
        plus(self.tail, times(minus(self.head, self.tail), part))
    }

    pub(crate) fn direction(&self) -> Point {
        unit(minus(self.head, self.tail)).unwrap_or([1.0, 0.0])
    }

    pub(crate) fn length(&self) -> f64 {
        length(minus(self.head, self.tail))
    }

    /// Begins the shaft outside the mark of the centre of mass, if it starts in there.
    fn leave(&mut self, centre: Point) {
        let inside = CENTRE_RADIUS * CENTRE_RADIUS - length(minus(self.tail, centre)).powi(2);
        if length(minus(self.point, centre)) < 1.0 && inside > 0.0 {
            self.start = along(self.tail, self.direction(), inside.sqrt());
        }
    }

    /// Begins the shaft at the rim of the mark of the centre of mass, in which its tail is.
    fn leave_rim(&mut self) {
        self.start = along(self.tail, self.direction(), CENTRE_RADIUS);
    }

    pub(crate) fn moved(&mut self, by: Point) {
        self.tail = plus(self.tail, by);
        self.head = plus(self.head, by);
        self.start = plus(self.start, by);
    }
}

/// The straight arrows of a panel: forces, the resultant, velocities.
pub(crate) fn strokes(body: &FreeBodyDiagram, view: &View, scales: &Scales) -> Vec<Stroke> {
    let forces = body.forces.iter().chain(&body.resultant).filter_map(|force| stroke(force, view, scales));
    let velocities = body.velocities.iter().filter_map(|velocity| motion(velocity, view, scales));
    let mut strokes: Vec<_> = forces.chain(velocities).collect();
    set_apart(&mut strokes);
    let centre = view.pixel(body.pose.centre());
    strokes.iter_mut().for_each(|stroke| stroke.leave(centre));
    strokes
}

fn stroke(force: &Arrow, view: &View, scales: &Scales) -> Option<Stroke> {
    let [x, y] = unit(force.vector)?;
    let true_length = scales.length(force.magnitude());
    let tail = view.pixel(force.point);
    let head = along(tail, [x, -y], true_length.max(LEAST_LENGTH));
    let form = if force.kind == ArrowKind::Resultant { Form::Hollow } else { Form::Full };
    let broken = true_length < LEAST_LENGTH;
    Some(Stroke { broken, ..Stroke::new([tail, head], force.kind.style(), form) })
}

fn motion(velocity: &Velocity, view: &View, scales: &Scales) -> Option<Stroke> {
    let [x, y] = unit(velocity.vector)?;
    let tail = view.pixel(velocity.point);
    let head = along(tail, [x, -y], (velocity.speed() / scales.fastest * LONGEST_MOTION).max(LEAST_MOTION));
    Some(Stroke::new([tail, head], MOTION, Form::Thin))
}

/// The arms of a panel, with the labels of those that are long enough to be seen.
pub(crate) fn arms(body: &FreeBodyDiagram, view: &View) -> Vec<(Stroke, Label)> {
    let centre = view.pixel(body.pose.centre());
    let arm = |arm: &NamedPoint| {
        let head = view.pixel(arm.at);
        (Stroke { point: head, ..Stroke::new([centre, head], ARM, Form::Thin) }, arm.name.clone())
    };
    let mut arms: Vec<_> = body.arms.iter().map(arm).filter(|(arm, _)| arm.length() > LEAST_MOTION).collect();
    arms.iter_mut().for_each(|(arm, _)| arm.leave_rim());
    arms
}

/// Arrows of forces along a line, tail and head, with what comes from where.
pub(crate) fn spreads(body: &FreeBodyDiagram, view: &View) -> Vec<(LineStyle, Vec<[Point; 2]>)> {
    let spread = |spread: &DistributedForce| {
        let largest = spread.largest();
        let arrow = |[point, force]: &[Point; 2]| {
            let tail = view.pixel(*point);
            [tail, plus(tail, times([force[0], -force[1]], LONGEST_SPREAD / largest))]
        };
        (spread.kind.style(), spread.arrows.iter().map(arrow).collect())
    };
    body.spreads.iter().map(spread).collect()
}

/// Labels of the straight arrows, in their order.
pub(crate) fn stroke_labels(body: &FreeBodyDiagram) -> Vec<Label> {
    let forces = body.forces.iter().chain(&body.resultant);
    let forces = forces.map(|force| equation(&force.symbol, force.magnitude(), &body.unit.arrow));
    let velocities = body.velocities.iter().map(|v| equation(&v.symbol, v.speed(), "m/s"));
    forces.chain(velocities).collect()
}

/// `symbol = value unit`; without a symbol the value alone.
pub(crate) fn equation(symbol: &Label, value: f64, unit: &str) -> Label {
    // Rounded text passes through unchanged: powers of ten keep their raised exponent.
    let quantity = Label::number(value, DIGITS).in_unit(unit);
    if symbol.is_empty() { quantity } else { symbol.clone().then(Label::plain(" = ")).then(quantity) }
}
