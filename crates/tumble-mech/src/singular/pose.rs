//! The ways that lead on from a singular configuration, or from next to it.
//!
//! # Law
//! With n of `n^T J = 0` and the columns of D all d of `J d = 0`, a motion `q* + h D x + ...` keeps the joints to second order if each n has
//!
//! ```text
//! x^T F x = 0    with  F_ij = n^T J'(D_i) D_j
//! ```
//!
//! (second derivative of `g = 0`, of which `n^T` takes out the accelerations; F is symmetric, because J is the gradient of g). With two
//! columns and one n, as of a loop of bars in one line, that is a quadratic in `x_1/x_2`: two roots are two branches that cross; one is
//! branches that touch, or an end; none is a pose that nothing leads away from, as of a triangle without height. What does not turn
//! by it, and how the others turn, are the angular velocities in D x.
//!
//! Where rows follow from others everywhere their n have `F = 0`. The singular pose is about `s / max|F|` away, with s the least
//! singular value, for a motion in which what moves most moves by a unit.
//!
//! # Symbols and units
//! As in [`super`]; F by a unit of motion (rad or m).
//!
//! # Sign and frame
//! Angular velocities are counterclockwise; a branch may be gone along in both directions, so the first that turns is told as positive.
//!
//! # Validity
//! Branches of more than one coordinate, and conditions of third order, are counted and not told apart.
//!
//! # Source
//! As in [`super`].
//!
//! # Checked by
//! `tests/branches.rs`: parallelograms, a kite that is driven through a dead point, a triangle without height.

use nalgebra::{DMatrix, DVector};

use super::rank::{scaled, values};
use crate::assembly::Rows;
use crate::equations::Equations;
use crate::gauge::Gauge;
use crate::mode::Mode;
use crate::product::product;

/// How far poses are moved to see how J changes, in units of the coordinates: slopes are then known to some eight digits.
const MOVED: f64 = 1e-4;
/// Changes of J by a unit of motion that are less than this part of J are none.
const UNCHANGED: f64 = 1e-5;
/// Next to a singular pose, singular values up to so many times the least of the rows that are kept are zero there.
const ALIKE: f64 = 10.0;
/// Parts of the largest entry of a vector that others must have to be told.
const TOLD: f64 = 0.1;
/// Parts of the largest angular velocity that are none: those of two branches that touch are known to half of the digits of the pose.
const TURNS: f64 = 1e-2;
/// Two roots of a quadratic whose discriminant is less than this part of its coefficients are one: what these are known to.
const ONE_ROOT: f64 = 1e-6;

/// Rows where some of them follow, or almost follow, from others.
pub(super) struct Pose {
    rows: Rows,
    /// Largest entry of J.
    largest: f64,
    /// Least singular value of the rows that are kept.
    least: f64,
    /// By column n and d; the latter as velocities.
    left: DMatrix<f64>,
    free: DMatrix<f64>,
    /// F of each n.
    forms: Vec<DMatrix<f64>>,
    /// The greatest of its entries for a unit of motion.
    changes: Vec<f64>,
}

impl Pose {
    /// That at these states; singular values below `zero` are none, or those that are as small as the least that is kept.
    pub(super) fn at(
        gauge: &mut Gauge,
        left_out: &[usize],
        (time, states): (f64, &[f64]),
        zero: Option<f64>,
    ) -> Self {
        let rows = gauge.at(time, states);
        let matrix = scaled(&rows);
        let least = values(&gauge.at(time, states).without(left_out)).last().copied().unwrap_or(f64::NAN);
        let largest = matrix.amax();
        let zero = zero.map_or(ALIKE * least, |part| part * largest);
        let (left, free) = (nulls(&matrix.transpose(), zero), nulls(&matrix, zero));
        let unit = rows.mass.map(|mass| if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 1.0 });
        let mut forms = vec![DMatrix::zeros(free.ncols(), free.ncols()); left.ncols()];
        let mut changes = vec![0.0_f64; left.ncols()];
        for (index, motion) in free.column_iter().enumerate() {
            let motion = motion.component_mul(&unit);
            let most = motion.amax().max(f64::MIN_POSITIVE);
            let moved = |by: f64| {
                let mut states = states.to_vec();
                let places = rows.coordinates.iter().zip(&motion);
                places.for_each(|(state, part)| states[*state] += by / most * part);
                states
            };
            let [after, before] = [MOVED, -MOVED].map(|by| scaled(&gauge.at(time, &moved(by))));
            let change = (after - before) / (2.0 * MOVED);
            let change = product(&product(&left.transpose(), &change), &free);
            for (own, changed) in change.row_iter().enumerate() {
                changes[own] = changes[own].max(changed.amax());
                forms[own].row_mut(index).copy_from(&(most * changed));
            }
        }
        let free = DMatrix::from_diagonal(&unit) * free;
        Self { rows, largest, least, left, free, forms, changes }
    }

    /// Rows, by index, that follow from others at this pose and at none nearby.
    pub(super) fn only_here(&self) -> Vec<usize> {
        let mut worst = vec![0.0_f64; self.rows.indices.len()];
        for (own, _) in
            self.left.column_iter().zip(&self.changes).filter(|(_, change)| self.is_change(**change))
        {
            worst.iter_mut().zip(own.iter()).for_each(|(worst, part)| *worst = part.abs().max(*worst));
        }
        let most = worst.iter().fold(0.0, |most: f64, part| most.max(*part));
        let told =
            self.rows.indices.iter().zip(&worst).filter(|(_, part)| most > 0.0 && **part > TOLD * most);
        told.map(|(index, _)| *index).collect()
    }

    /// How far the singular pose is, rad or m; none where there is no such pose about.
    pub(super) fn distance(&self) -> Option<f64> {
        let most = self.changes.iter().fold(0.0, |most: f64, change| most.max(*change));
        self.is_change(most).then(|| self.least / most)
    }

    /// Twice the kinetic energy of the bodies at some states, J.
    pub(super) fn energy(&self, states: &[f64]) -> f64 {
        let velocities = self.rows.velocities.iter().map(|state| states[*state]);
        velocities.zip(&self.rows.mass).map(|(velocity, mass)| mass * velocity * velocity).sum()
    }

    fn is_change(&self, change: f64) -> bool {
        change > UNCHANGED * self.largest
    }

    /// The velocities with which the bodies may go on, and whether it is one because two fall together; none where they are too many to
    /// be told apart.
    fn branches(&self) -> Option<(Vec<DVector<f64>>, bool)> {
        let forms = self.forms.iter().zip(&self.changes).filter(|(_, change)| self.is_change(**change));
        let forms: Vec<&DMatrix<f64>> = forms.map(|(form, _)| form).collect();
        let ([first, others @ ..], 2) = (&forms[..], self.free.ncols()) else { return None };
        let is_kept = |x: &DVector<f64>| {
            others.iter().all(|form| (x.transpose() * *form * x)[0].abs() <= TOLD * form.amax())
        };
        let roots = roots(first);
        let is_double = roots.len() == 1;
        Some((roots.into_iter().filter(is_kept).map(|x| &self.free * x).collect(), is_double))
    }
}

/// Directions of length one in which a quadratic of two unknowns is zero.
fn roots(form: &DMatrix<f64>) -> Vec<DVector<f64>> {
    let symmetric = 0.5 * (form + form.transpose());
    let parts = symmetric.symmetric_eigen();
    let (mut low, mut high) = (0, 1);
    if parts.eigenvalues[low] > parts.eigenvalues[high] {
        (low, high) = (high, low);
    }
    // Along the axes it is `low x^2 + high y^2`.
    let [a, b] = [low, high].map(|axis| parts.eigenvalues[axis]);
    let size = a.abs().max(b.abs());
    let [u, v] = [low, high].map(|axis| parts.eigenvectors.column(axis).into_owned());
    if a.abs() <= ONE_ROOT.sqrt() * size {
        return vec![u];
    }
    if b.abs() <= ONE_ROOT.sqrt() * size {
        return vec![v];
    }
    if a > 0.0 || b < 0.0 {
        return vec![];
    }
    let (x, y) = (b.sqrt(), (-a).sqrt());
    [1.0, -1.0].map(|sign| (&u * x + &v * (sign * y)).normalize()).into()
}

/// By column, what a matrix makes nothing of but for `zero`.
fn nulls(matrix: &DMatrix<f64>, zero: f64) -> DMatrix<f64> {
    let (n, m) = (matrix.ncols(), matrix.nrows());
    let square = DMatrix::from_fn(n.max(m), n, |i, j| if i < m { matrix[(i, j)] } else { 0.0 });
    let parts = square.svd(false, true);
    let Some(right) = parts.v_t else { return DMatrix::zeros(n, 0) };
    let none: Vec<usize> = (0..n).filter(|place| parts.singular_values[*place] <= zero).collect();
    right.select_rows(&none).transpose()
}

impl Equations {
    /// In a sentence, which joints hold less than elsewhere and how the bodies may go on.
    pub(super) fn ways_on(&self, mode: &Mode, pose: &Pose) -> String {
        let joints = self.named_joints(&pose.only_here());
        let branches = pose.branches().map(|(found, is_double)| {
            let mut told: Vec<String> = found.iter().map(|branch| self.turning(mode, pose, branch)).collect();
            told.sort();
            (told, is_double)
        });
        let is_own = |change: &&f64| pose.is_change(**change);
        match branches.as_ref().map(|(told, is_double)| (&told[..], is_double)) {
            Some(([one, other], _)) => {
                format!("{joints} can be kept in more than one way there: either {one}, or {other}")
            }
            Some(([one], true)) => {
                format!(
                    "{joints} hold less there than elsewhere, and if more than one way leads on, they begin alike: {one}"
                )
            }
            Some(([one], false)) => {
                format!("{joints} hold less there than elsewhere, though only one way leads on: {one}")
            }
            Some(_) => format!(
                "{joints} hold less there than elsewhere, though no way leads on: the bodies can only begin to move"
            ),
            None => {
                let ways = pose.free.ncols();
                let elsewhere = ways.saturating_sub(pose.changes.iter().filter(is_own).count());
                format!(
                    "{joints} hold less there than elsewhere: the bodies can begin to move in {ways} independent ways, not {elsewhere}"
                )
            }
        }
    }

    /// How bodies turn with some velocities.
    fn turning(&self, mode: &Mode, pose: &Pose, velocities: &DVector<f64>) -> String {
        let turns = mode.bodies.iter().filter_map(|&body| {
            let state = *self.velocity_states(mode, body).last()?;
            let place = pose.rows.velocities.iter().position(|velocity| *velocity == state)?;
            let is_joined = pose.rows.gradient.rows.iter().flatten().any(|(column, _)| *column == place);
            is_joined.then(|| (format!("`{}`", self.model().bodies[body].name), velocities[place]))
        });
        let mut turns: Vec<(String, f64)> = turns.collect();
        let most = turns.iter().fold(0.0, |most: f64, (_, omega)| most.max(omega.abs()));
        if most <= TURNS * velocities.amax() {
            return "they move without turning".into();
        }
        let is_none = |omega: f64| omega.abs() <= TURNS * most;
        let first = turns.iter().find(|(_, omega)| !is_none(*omega)).map_or(1.0, |(_, omega)| *omega);
        let unit = most.copysign(first);
        turns.iter_mut().for_each(|(_, omega)| *omega = if is_none(*omega) { 0.0 } else { *omega / unit });
        let named = |is: fn(f64) -> bool| {
            let names: Vec<&str> =
                turns.iter().filter(|(_, omega)| is(*omega)).map(|(name, _)| name.as_str()).collect();
            listed(&names)
        };
        let [forth, back, not] = [|omega| omega > 0.0, |omega| omega < 0.0, |omega| omega == 0.0].map(named);
        let count = turns.iter().filter(|(_, omega)| *omega > 0.0).count();
        let verb = if count > 1 { "turn" } else { "turns" };
        let way = if back.is_some() || count > 1 { " one way" } else { "" };
        let mut told = format!("{} {verb}{way}", forth.unwrap_or_default());
        back.iter().for_each(|back| told += &format!(" and {back} the other"));
        not.iter().for_each(|not| told += &format!(", without a turn of {not}"));
        let names: Vec<&str> = turns.iter().map(|(name, _)| name.as_str()).collect();
        let rates: Vec<String> =
            turns.iter().map(|(_, omega)| format!("{}", (omega * 1e2).round() / 1e2 + 0.0)).collect();
        told + &format!(" ({} as {})", names.join(" : "), rates.join(" : "))
    }
}

fn listed(names: &[&str]) -> Option<String> {
    let (last, others) = names.split_last()?;
    Some(if others.is_empty() { (*last).to_owned() } else { format!("{} and {last}", others.join(", ")) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `x y`, `x^2`, `x^2 + y^2`.
    #[test]
    fn quadratics_have_two_roots_or_one_or_none() {
        let both = roots(&DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 1.0, 0.0]));
        assert_eq!(both.len(), 2);
        assert!(both.iter().all(|x| (x[0] * x[1]).abs() < 1e-15), "{both:?}");
        let [one] = &roots(&DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 0.0, 0.0]))[..] else {
            panic!("one root")
        };
        assert!(one[0].abs() < 1e-15, "{one}");
        assert!(roots(&DMatrix::identity(2, 2)).is_empty());
    }
}
