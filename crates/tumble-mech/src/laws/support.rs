//! # Law
//! A body that stays on rigid surfaces: with a_i the acceleration that gap i would have without these contacts and A_ij
//! the acceleration of gap i by a unit force at contact j, the normal forces solve `A N = -a`, so that no gap changes.
//! For a free body `A_ij = n_i . n_j / M + (r_i x n_i)(r_j x n_j) / I`; for one on a pivot
//! `A_ij = (R_i x n_i)(R_j x n_j) / I_P` with R from the pivot.
//! # Symbols and units
//! N (N), a (m/s^2), A (1/kg), n (1), r and R (m), M (kg), I and I_P (kg m^2).
//! # Sign and frame
//! World axes, n out of the solid. N is never negative: where it would become so, the contact ends.
//! # Validity
//! No friction. Forces of more contacts than the body has freedoms are undetermined; of all choices that give the same
//! motion one is taken, and contacts without a part in it are idle.
//! # Source
//! Lagrange's multipliers of the constraints g_i = 0; Signorini's conditions.
//! # Checked by
//! `tests/resting.rs`: a rod that slides down a wall, a box on a slope, lift-off.

use tumble_expr::{Expr, Substitution};

use crate::contact::Pair;
use crate::coordinates::Coordinates;
use crate::kinematics::Kinematics;
use crate::mass::MassProperties;

/// Normal forces of one body's lasting contacts, N. `free` are the accelerations without them, by their symbols.
pub(crate) fn normal_forces(
    held: &[&Pair],
    (body, mass, coordinates): (&Kinematics, &MassProperties, &Coordinates),
    free: &Substitution,
) -> Vec<Expr> {
    let response = |i: &Pair, j: &Pair| coordinates.response(body, mass, i, j);
    let matrix = held.iter().map(|i| held.iter().map(|j| response(i, j)).collect()).collect();
    let needed = held.iter().map(|pair| -free.apply(&pair.gap_acceleration())).collect();
    Expr::solve(matrix, needed)
}
