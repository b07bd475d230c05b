//! # Law
//! Coulomb's dry friction. While the point that touches slips with the rate s along the surface, `F = -mu_k sign(s) N`. While it does
//! not, F is what keeps it so, as long as `|F| <= mu_s N`. An impact obeys the same with impulses in the place of forces.
//! Rolling resistance is a couple of the same kind: `C = -d sign(w) N` while the two turn against each other with the rate w, and what keeps
//! them from it, as long as `|C| <= d N`, while they do not. It acts while a contact lasts; impacts know nothing of it.
//! # Symbols and units
//! N normal force (N), F force along the surface (N), mu_s and mu_k static and kinetic coefficient (1), `mu_k <= mu_s`, s (m/s), C (N m), d
//! (m), w (rad/s).
//! # Sign and frame
//! Along t, the surface's normal turned clockwise by a right angle: to the right on a floor. s is the velocity of the body's material
//! point less that of the surface's. C and w are counter-clockwise, those of the body less those of the surface.
//! # Validity
//! Rigid bodies. Coefficients do not depend on the speed, the pressure or the time at rest.
//! # Source
//! Amontons and Coulomb; for impacts Routh 1905.
//! # Checked by
//! `tests/friction.rs`: stops, break-away, backspin, thresholds of rolling; tests of `contact/routh.rs`.

use tumble_expr::{Binary, Expr, is_identically_zero};

/// Dry friction of a rigid surface.
#[derive(Clone, Debug)]
pub struct Friction {
    /// Greatest force along the surface over the normal force while nothing slips.
    pub of_rest: Expr,
    /// The same while it slips; not greater.
    pub kinetic: Expr,
    /// What the restitution is the ratio of; where it is not said here, what others that touch say, and else of impulses.
    pub restitution: Option<Restitution>,
    /// Rolling resistance: greatest couple against rolling over the normal force, m; none where nothing is said.
    pub rolling: Option<Expr>,
}

/// What the restitution e of an impact is the ratio of; without friction at one contact all three are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Restitution {
    /// Of impulses: of restitution and of compression.
    #[default]
    Poisson,
    /// Its square is that of works: done in restitution and taken in compression.
    Stronge,
    /// Of speeds: after and before. May gain energy, and is refused where it does.
    Newton,
}

impl Friction {
    /// With one coefficient at rest and while it slips.
    pub fn new(coefficient: impl Into<Expr>) -> Self {
        let coefficient = coefficient.into();
        Self { of_rest: coefficient.clone(), kinetic: coefficient, restitution: None, rolling: None }
    }

    /// The coefficients, with what messages call them.
    pub(crate) fn coefficients(&self) -> Vec<(&'static str, &Expr)> {
        match is_identically_zero(&(&self.of_rest - &self.kinetic)) {
            true => vec![("friction", &self.kinetic)],
            false => vec![("static friction", &self.of_rest), ("kinetic friction", &self.kinetic)],
        }
    }

    /// With another coefficient while it slips.
    pub fn kinetic(self, kinetic: impl Into<Expr>) -> Self {
        Self { kinetic: kinetic.into(), ..self }
    }

    /// With another meaning of the restitution.
    pub fn restitution(self, restitution: Restitution) -> Self {
        Self { restitution: Some(restitution), ..self }
    }

    /// With a rolling resistance, m.
    pub fn rolling(self, length: impl Into<Expr>) -> Self {
        Self { rolling: Some(length.into()), ..self }
    }

    /// The lesser of two: each coefficient on its own.
    pub(crate) fn lesser(&self, other: &Self) -> Self {
        let lesser = |a: &Expr, b: &Expr| Expr::binary(Binary::Min, a.clone(), b.clone());
        Self {
            of_rest: lesser(&self.of_rest, &other.of_rest),
            kinetic: lesser(&self.kinetic, &other.kinetic),
            restitution: self.restitution.or(other.restitution),
            rolling: match (&self.rolling, &other.rolling) {
                (Some(a), Some(b)) => Some(lesser(a, b)),
                (a, b) => a.clone().or(b.clone()),
            },
        }
    }
}
