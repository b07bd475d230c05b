//! # Law
//! A row is a scalar condition `g = 0` on the motion of one or two bodies, kept by a multiplier: a unit of it is a wrench on
//! each body, the same by which g changes (virtual work). With a_i what `g_i''` would be without multipliers and A_ij what a unit of
//! multiplier j does to it, all rows that hold solve `A lambda = -a` together; `A_ij` is the sum over the bodies of both of
//! `f_i . f_j / M + (r_i x f_i + c_i)(r_j x f_j + c_j) / I`, for a body on a pivot `T_i T_j / I_P` with torques about the pivot.
//! # Symbols and units
//! g (m or rad), lambda (N or N m), f force (1) at the arm r (m) and c couple (m or 1) of a unit multiplier, M (kg), I (kg m^2).
//! # Sign and frame
//! World axes; a gap's normal force is never negative, where it would become so the contact ends; a joint's may have any sign.
//! # Validity
//! No friction. Rows that depend on each other have no one solution: those that add nothing are left out, with multiplier zero.
//! # Source
//! Lagrange's equations of the first kind; Signorini's conditions for gaps.
//! # Checked by
//! `tests/resting.rs`: a rod that slides down a wall, a box on a slope, lift-off; `tests/joints.rs`.

use std::collections::{BTreeMap, BTreeSet};

use tumble_expr::{Expr, Substitution, Symbol, Vector};

use crate::coordinates::Measure;

/// A condition, with what it does to bodies.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Stands for what keeps it.
    pub(crate) multiplier: Symbol,
    /// By body, what a unit of the multiplier is.
    pub(crate) wrenches: Vec<Wrench>,
    /// What is zero, and its derivatives by the time.
    pub(crate) position: Expr,
    pub(crate) rate: Expr,
    pub(crate) acceleration: Expr,
    /// Kind of what is zero.
    pub(crate) measure: Measure,
}

/// A force at its point and a couple, for a unit of a multiplier.
#[derive(Clone, Debug)]
pub(crate) struct Wrench {
    pub(crate) body: usize,
    /// From the centre of mass, m, world axes.
    pub(crate) arm: Vector,
    pub(crate) force: Vector,
    pub(crate) couple: Expr,
}

impl Wrench {
    /// Its torque about the point from which the centre of mass is at `from`.
    pub(crate) fn torque_about(&self, from: &Vector) -> Expr {
        (from + &self.arm).cross_planar(&self.force) + &self.couple
    }
}

/// A body without moment of inertia that rows turn: its torques add up to nothing, which says how it turns.
pub(crate) struct Light {
    pub(crate) body: usize,
    /// Symbol of its angular acceleration.
    pub(crate) alpha: Symbol,
    /// Of all forces but those of the rows, about its centre of mass, N m.
    pub(crate) torque: Expr,
}

/// Multipliers by which all rows hold, then the angular accelerations of bodies without moment of inertia. `free` are the
/// accelerations without them, by their symbols; `response` is what a unit of one wrench does along another of the same body.
pub(crate) fn solved(
    rows: &[Row],
    light: &[Light],
    response: impl Fn(&Wrench, &Wrench) -> Expr,
    free: &Substitution,
) -> Vec<Expr> {
    let entry = |i: &Row, j: &Row| {
        let both = i.wrenches.iter().flat_map(|own| j.wrenches.iter().map(move |other| (own, other)));
        let shared = both.filter(|(own, other)| own.body == other.body);
        shared.fold(Expr::zero(), |sum, (own, other)| sum + response(own, other))
    };
    let centre = Vector::planar(Expr::zero(), Expr::zero());
    let torque = |row: &Row, light: &Light| {
        let own = row.wrenches.iter().filter(|wrench| wrench.body == light.body);
        own.fold(Expr::zero(), |sum, wrench| sum + wrench.torque_about(&centre))
    };
    // Bodies have few neighbours: all other entries are zero.
    let mut on_body: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for (index, row) in rows.iter().enumerate() {
        row.wrenches.iter().for_each(|wrench| _ = on_body.entry(wrench.body).or_default().insert(index));
    }
    let mut lights: BTreeMap<usize, usize> = BTreeMap::new();
    light.iter().enumerate().for_each(|(index, light)| _ = lights.insert(light.body, index));
    let of_row = |i: &Row| -> Vec<(usize, Expr)> {
        let others: BTreeSet<usize> =
            i.wrenches.iter().flat_map(|wrench| &on_body[&wrench.body]).copied().collect();
        let turned: BTreeSet<usize> =
            i.wrenches.iter().filter_map(|wrench| lights.get(&wrench.body)).copied().collect();
        let turned = turned.into_iter().map(|index| (rows.len() + index, torque(i, &light[index])));
        others.into_iter().map(|j| (j, entry(i, &rows[j]))).chain(turned).collect()
    };
    let of_light = |light: &Light| -> Vec<(usize, Expr)> {
        let own = on_body.get(&light.body).into_iter().flatten();
        own.map(|index| (*index, torque(&rows[*index], light))).collect()
    };
    let matrix = rows.iter().map(of_row).chain(light.iter().map(of_light)).collect();
    let needed = rows.iter().map(|row| -free.apply(&row.acceleration));
    Expr::solve_rows(matrix, needed.chain(light.iter().map(|light| -&light.torque)).collect())
}
