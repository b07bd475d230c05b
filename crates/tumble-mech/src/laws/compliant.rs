//! # Law
//! A compliant surface or body pushes with `N = k d + c d'` (spring and damper side by side) or, after Hertz with the
//! damping of Hunt and Crossley, `N = k d^(3/2) (1 + c d')`, where d is the depth, the gap taken negative.
//! A damped spring lets go when the force comes down to zero (the surface recovers on its own, slower than the body
//! leaves) or when the body is back at the undeformed surface; by then the damper has pulled for a moment. After Hertz the force is zero at
//! the surface, whatever the damping, and also where others pull the two apart faster than 1/c: there too it lets go, and pushes again if they
//! part slower while still in. So it is `N = k d^(3/2) max(0, 1 + c d')`: never more than `k d^(3/2)` on the way out, and no
//! energy is gained. The energy is
//! `V = k d^2 / 2` or, after Hertz, `V = (2/5) k d^(5/2)`. Both of two bodies have the force, on one line: that of the centres of two
//! circles, and the normal of an edge.
//! # Symbols and units
//! N (N), d (m), k (N/m, N/m^(3/2)), c (kg/s, s/m), V (J).
//! # Sign and frame
//! N is along the pair's normal, out of the solid, on the first body, and against it on another.
//! # Validity
//! Depths small against the body. Friction is a law of its own. No rebound is faster than 1/c by itself. The power d^(3/2) has no Taylor series at first touch, so a Hertzian
//! contact runs in a transformed time: with the root w of the depth and `dt = w ds` all rates are polynomials; with several, see
//! [`time_transformation`].
//! # Source
//! Hooke; Hertz 1882; Hunt and Crossley 1975, "Coefficient of restitution interpreted as damping in vibroimpact", of approach and rebound,
//! where 1 + c d' stays positive. That contacts do not pull is added where bodies are driven: Marhefka and Orin 1999, "A compliant contact model
//! with nonlinear damping for simulation of robotic systems"; Azad and Featherstone 2010, "Modeling the contact between a rolling sphere and a
//! compliant ground plane".
//! # Checked by
//! `tests/compliant.rs`: contact times on a spring with gravity, damped and Hertzian, in closed form; energy;
//! `tests/compliant_bodies.rs`: the same between bodies, in bowls and at corners.

use tumble_expr::{Expr, Written, is_identically_zero};

use crate::contact::Pair;
use crate::parameters::time_symbol;
use crate::potential::Potential;
use crate::statement::{Statement, sum, times};

/// Force of a pressed pair along the normal, N, in the body's position and velocity and, for Hertz, the root of the
/// depth.
pub(crate) fn normal_force(pair: &Pair) -> Option<Expr> {
    let (stiffness, damping) = pair.law.coefficients()?;
    Some(damped_force(pair, stiffness, damping))
}

/// `(k d + c d') n`, with d the depth; nothing of a Hertzian contact, whose depth is a state of its own.
pub(crate) fn statement(pair: &Pair) -> Option<Statement> {
    let (stiffness, damping) = pair.law.coefficients()?;
    if pair.is_hertzian() {
        return None;
    }
    let depth = Written::named("d", Written::Scalar(-pair.gap()));
    let mut terms = vec![times(stiffness, vec![depth])];
    if !is_identically_zero(damping) {
        terms.push(times(damping, vec![Written::named("d'", Written::Scalar(-pair.gap_rate()))]));
    }
    let normal = Written::named("n", Written::Vector(pair.normal.clone()));
    Some(Statement::of(&pair.term(), Written::Product(vec![sum(terms), normal])))
}

/// The energy of a pressed pair, by its index.
pub(crate) fn potential((index, pair): (usize, &Pair)) -> Option<Potential> {
    let (stiffness, damping) = pair.law.coefficients()?;
    let force = damped_force(pair, stiffness, &Expr::zero());
    let (energy, by_path) = match pair.is_hertzian() {
        true => {
            let moved = pair.gap().derivative(&time_symbol());
            let by_path = if is_identically_zero(&moved) { Expr::zero() } else { -(&force * moved) };
            (stiffness * Expr::from(pair.root_symbol()).powi(5) * 2 / 5, by_path)
        }
        // The gap is in the formula itself.
        false => (stiffness * (pair.gap() * pair.gap()) / 2, Expr::zero()),
    };
    let elastic = pair.pushed_by(&force);
    let whole = Potential::of(energy, elastic.first()?.clone(), vec![stiffness.clone()]);
    Some(Potential {
        pair: Some(index),
        body: Some(pair.body).filter(|_| pair.other.is_none()),
        elastic,
        driven: &whole.driven + by_path,
        is_whole: is_identically_zero(damping),
        ..whole
    })
}

/// What has the sign of the force where a pair is in, in two parts, the second by its damping: the force, or of a Hertzian one what its
/// elastic force is multiplied by.
pub(crate) fn resistance(pair: &Pair) -> [Expr; 2] {
    let Some((stiffness, damping)) = pair.law.coefficients() else { return [Expr::zero(), Expr::zero()] };
    let damped = damping * -pair.gap_rate();
    match pair.is_hertzian() {
        true => [Expr::one(), damped],
        false => [-(stiffness * pair.gap()), damped],
    }
}

fn damped_force(pair: &Pair, stiffness: &Expr, damping: &Expr) -> Expr {
    let closing = -pair.gap_rate();
    match pair.is_hertzian() {
        true => stiffness * Expr::from(pair.root_symbol()).powi(3) * (1 + damping * closing),
        false => -(stiffness * pair.gap()) + damping * closing,
    }
}

/// dt/ds of Hertzian contacts that are pressed at the same time, by the roots of their depths: `1/(1/w_1 + 1/w_2 + ...)`, written so that one of
/// them may be zero. It is of the size of the least, however many there are.
pub(crate) fn time_transformation(roots: impl Iterator<Item = Expr>) -> Option<Expr> {
    roots.reduce(|rate, root| &rate * &root / (&rate + &root))
}

/// Rate of the root w of the depth with respect to the parameter s: `d' / 2` of one alone, since `d = w^2` and `dt = w ds`.
pub(crate) fn root_rate(pair: &Pair, others: impl Iterator<Item = Expr>) -> Expr {
    let alone = -pair.gap_rate() / 2;
    match time_transformation(others) {
        Some(others) => alone * &others / (&others + Expr::from(pair.root_symbol())),
        None => alone,
    }
}

/// What is zero while a Hertzian pair is pressed: the gap and the square of the root, m.
pub(crate) fn root_invariant(pair: &Pair) -> Expr {
    let root: Expr = pair.root_symbol().into();
    &root * &root + pair.gap()
}
