//! Starts, and instants at which joints or velocities change, in a singular configuration.
//!
//! Rows that follow from others go on to do so. With n of `n^T J = 0` and all d, v of `J d = J v = 0` that is
//! `n^T J'(v) d = 0`: the rank of J does not change along what J leaves free. Where that is not zero, a row follows from the others at this pose
//! alone, and leaving it out would let the bodies go where it does not allow.

use super::LOST;
use super::pose::Pose;
use super::rank::NEAR;
use crate::equations::Equations;
use crate::gauge::Gauge;
use crate::mode::Mode;

/// Singular values below this part of the largest entry are zero: as starts are given.
const NONE: f64 = 1e-9;

impl Equations {
    /// In a sentence, of which joints a row follows from others at these states, or within [`LOST`] of them, and at no states nearby;
    /// none where there are none.
    pub(crate) fn only_here(&self, mode: &Mode, time: f64, states: &[f64], inputs: &[f64]) -> Option<String> {
        let listed = self.rows_by_joint(mode);
        if listed.is_empty() {
            return None;
        }
        let mut gauge = Gauge::of(self, mode, &listed, inputs).ok()?;
        let rows = gauge.at(time, states);
        let redundant = rows.redundant();
        if !redundant.is_empty() {
            let pose = Pose::at(&mut gauge, &[], (time, states), Some(NONE));
            if !pose.only_here().is_empty() {
                return Some(self.ways_on(mode, &pose));
            }
        }
        if rows.without(&redundant).gradient.independence() > NEAR {
            return None;
        }
        let pose = Pose::at(&mut gauge, &redundant, (time, states), None);
        pose.distance().is_some_and(|distance| distance < LOST).then(|| self.ways_on(mode, &pose))
    }
}
