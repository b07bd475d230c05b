//! # Law
//! A compliant surface pushes with `N = k d + c d'` (spring and damper side by side) or, after Hertz with the
//! damping of Hunt and Crossley, `N = k d^(3/2) (1 + c d')`, where d is the depth, the gap taken negative.
//! A damped spring lets go when the force comes down to zero (the surface recovers on its own, slower than the body
//! leaves) or when the body is back at the undeformed surface; by then the damper has pulled for a moment.
//! # Symbols and units
//! N (N), d (m), k (N/m, N/m^(3/2)), c (kg/s, s/m).
//! # Sign and frame
//! N is along the surface's normal, out of the solid.
//! # Validity
//! Depths small against the body; no friction. The power d^(3/2) has no Taylor series at first touch, so a Hertzian
//! contact runs in a transformed time: with the root w of the depth and `dt = w ds` all rates are polynomials.
//! # Source
//! Hooke; Hertz 1882; Hunt and Crossley 1975, "Coefficient of restitution interpreted as damping in vibroimpact".
//! # Checked by
//! `tests/compliant.rs`: contact times on a spring with gravity, damped and Hertzian, in closed form; energy.

use tumble_expr::Expr;

use crate::contact::Pair;
use crate::surface::ContactLaw;

/// Force of a pressed pair along the normal, N, in the body's position and velocity and, for Hertz, the root of the
/// depth.
pub(crate) fn normal_force(pair: &Pair) -> Option<Expr> {
    let closing = -pair.gap_rate();
    match &pair.law {
        ContactLaw::Spring { stiffness, damping, .. } => Some(-(stiffness * pair.gap()) + damping * closing),
        ContactLaw::Hertz { stiffness, damping } => {
            let root: Expr = pair.root_symbol().into();
            Some(stiffness * root.powi(3) * (1 + damping * closing))
        }
        ContactLaw::Rigid { .. } => None,
    }
}

/// Rate of the root w of the depth with respect to the parameter s: `d' / 2`, since `d = w^2` and `dt = w ds`.
///
/// Other Hertzian contacts pressed at the same time multiply dt/ds by their roots.
pub(crate) fn root_rate(pair: &Pair, others: &Expr) -> Expr {
    -pair.gap_rate() * others / 2
}

/// What is zero while a Hertzian pair is pressed: the gap and the square of the root, m.
pub(crate) fn root_invariant(pair: &Pair) -> Expr {
    let root: Expr = pair.root_symbol().into();
    &root * &root + pair.gap()
}
