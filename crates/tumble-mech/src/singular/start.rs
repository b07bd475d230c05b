//! Starts, and instants at which joints change, in a singular configuration.
//!
//! Rows that follow from others go on to do so. With n of `n^T J = 0` and all d, v of `J d = J v = 0` that is
//! `n^T J'(v) d = 0`: the rank of J does not change along what J leaves free. Where that is not zero, a row follows from the others at this pose
//! alone, and leaving it out would let the bodies go where it does not allow.

use nalgebra::DMatrix;

use super::rank::scaled;
use crate::equations::Equations;
use crate::gauge::Gauge;
use crate::mode::Mode;

/// Singular values below this part of the largest are zero: as starts are given.
const NONE: f64 = 1e-9;
/// How far poses are moved to see how J changes, in units of the coordinates: slopes are then known to some eight digits.
const MOVED: f64 = 1e-4;
/// Changes of J by a unit of motion that are less than this part of J are none.
const UNCHANGED: f64 = 1e-5;

impl Equations {
    /// Names of the joints of which a row follows from others at these states and at no states nearby; none where there are none.
    pub(crate) fn only_here(&self, mode: &Mode, time: f64, states: &[f64], inputs: &[f64]) -> Option<String> {
        let listed: Vec<_> = self.joint_rows(mode).collect();
        let mut gauge = Gauge::of(self, mode, &listed, inputs).ok()?;
        let rows = gauge.at(time, states);
        if rows.redundant().is_empty() {
            return None;
        }
        let matrix = scaled(&rows);
        let (left, free) = (nulls(&matrix.transpose()), nulls(&matrix));
        let unit = rows.mass.map(|mass| if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 1.0 });
        let mut worst = vec![0.0; listed.len()];
        for motion in free.column_iter() {
            let most = motion.component_mul(&unit).amax().max(f64::MIN_POSITIVE);
            let moved = |by: f64| {
                let mut states = states.to_vec();
                let places = rows.coordinates.iter().zip(motion.iter().zip(&unit));
                places.for_each(|(state, (part, unit))| states[*state] += by / most * part * unit);
                states
            };
            let [after, before] = [MOVED, -MOVED].map(|by| scaled(&gauge.at(time, &moved(by))));
            let change = left.transpose() * ((after - before) / (2.0 * MOVED)) * &free;
            for (own, changes) in left.column_iter().zip(change.row_iter()) {
                if changes.amax() > UNCHANGED * matrix.amax() {
                    worst
                        .iter_mut()
                        .zip(own.iter())
                        .for_each(|(worst, part)| *worst = part.abs().max(*worst));
                }
            }
        }
        let most = worst.iter().fold(0.0, |most: f64, part| most.max(*part));
        let told = rows.indices.iter().zip(&worst).filter(|(_, part)| **part > 0.1 * most);
        let told: Vec<usize> = told.map(|(index, _)| *index).collect();
        (most > 0.0).then(|| self.named_joints(&told))
    }
}

/// By column, what a matrix makes nothing of.
fn nulls(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, m) = (matrix.ncols(), matrix.nrows());
    let square = DMatrix::from_fn(n.max(m), n, |i, j| if i < m { matrix[(i, j)] } else { 0.0 });
    let parts = square.svd(false, true);
    let Some(right) = parts.v_t else { return DMatrix::zeros(n, 0) };
    let least = NONE * parts.singular_values.max();
    let none: Vec<usize> = (0..n).filter(|place| parts.singular_values[*place] <= least).collect();
    right.select_rows(&none).transpose()
}
