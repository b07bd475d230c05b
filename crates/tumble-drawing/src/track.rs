//! One body in one run of a stroboscopic picture, and what its instants are called.

use crate::outline::{Outline, Pose};
use crate::scale::drawable;
use crate::text::Label;

/// Digits of the times written beside bodies.
const TIME_DIGITS: usize = 3;

/// One body in one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyPath {
    /// What the legend says; may be empty.
    pub label: Label,
    /// The body, in metres about its centre of mass at angle zero.
    pub shapes: Vec<Outline>,
    /// The body at equal time steps, in order of time.
    pub poses: Vec<Pose>,
    /// Path of the centre of mass, points `[x, y]` in metres.
    pub trace: Vec<[f64; 2]>,
}

impl BodyPath {
    /// The poses that can be drawn.
    pub(crate) fn poses(&self) -> impl Iterator<Item = &Pose> {
        self.numbered().map(|(_, pose)| pose)
    }

    /// The same with their numbers, counted from 0 over all poses.
    pub(crate) fn numbered(&self) -> impl Iterator<Item = (usize, &Pose)> {
        self.poses.iter().enumerate().filter(|(_, pose)| pose.is_drawable())
    }

    /// World points that bound bodies and path.
    pub(crate) fn extent(&self) -> Vec<[f64; 2]> {
        let bodies = self.poses().flat_map(|pose| self.shapes.iter().flat_map(|s| s.extent(pose)));
        let centres = self.poses().map(Pose::centre);
        let trace = self.trace.iter().copied();
        bodies.chain(centres).chain(trace).filter(|p| drawable(p[0]) && drawable(p[1])).collect()
    }

    /// Greatest distance of the body's outline from its centre of mass, in metres.
    pub(crate) fn reach(&self) -> f64 {
        self.shapes.iter().map(Outline::reach).fold(0.0, f64::max)
    }

    /// The first and the last pose with their times.
    pub(crate) fn labels(&self) -> Vec<(&Pose, Label)> {
        let first = self.poses().next();
        let last = self.poses().skip(1).last();
        first.into_iter().chain(last).map(|pose| (pose, time_label(pose.t))).collect()
    }
}

fn time_label(t: f64) -> Label {
    let equals = Label::symbol("t").then(Label::plain(" = ")).then(Label::number(t, TIME_DIGITS));
    if t == 0.0 { equals } else { equals.then(Label::plain("\u{a0}s")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(times: &[f64]) -> BodyPath {
        let pose = |t: &f64| Pose { t: *t, ..Pose::default() };
        BodyPath { poses: times.iter().map(pose).collect(), ..BodyPath::default() }
    }

    fn labels(times: &[f64]) -> Vec<String> {
        track(times).labels().iter().map(|(_, label)| label.to_plain()).collect()
    }

    #[test]
    fn first_and_last_instants_have_times() {
        assert_eq!(labels(&[0.0, 0.1, 0.3]), ["t = 0", "t = 0.3\u{a0}s"]);
        assert_eq!(labels(&[0.5]), ["t = 0.5\u{a0}s"]);
        assert!(labels(&[]).is_empty());
    }

    #[test]
    fn extents_hold_bodies_and_path() {
        let mut track = track(&[0.0]);
        track.shapes = vec![Outline::Circle { centre: [0.0, 0.0], radius: 2.0, is_hollow: false }];
        track.trace = vec![[5.0, f64::NAN], [7.0, 1.0]];
        assert_eq!(track.extent(), [[-2.0, -2.0], [2.0, 2.0], [0.0, 0.0], [7.0, 1.0]]);
        assert_eq!(track.reach(), 2.0);
    }
}
