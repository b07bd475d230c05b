//! # Law
//! An impact changes velocities and not places. With v_i the rate of gap i just before and A_ij the change of it by a
//! unit impulse at contact j, the impulses P come in two phases (Poisson): compression ends where no gap closes,
//! `v + A P_c >= 0`, `P_c >= 0`, one of the two zero at each contact; restitution gives back at least the part e of
//! each compression, `P_e >= e P_c`, as much more as keeps the gaps from closing. One contact: `v_after = -e v_before`.
//! Taken sequentially instead, the contact that closes fastest impacts alone, until none closes: Newton's cradle. Those that close
//! equally fast impact together. Where it takes infinitely many, as with e below 1 between three balls, they come to a limit, which
//! is taken where what still closes is rounding.
//! # Symbols and units
//! v (m/s), A (1/kg), P (N s), e (1), 0 to 1.
//! # Sign and frame
//! Along the surfaces' normals, out of the solid.
//! # Validity
//! Rigid bodies, an instant; without friction, or with what friction adds in the responses. Energy never grows: with one e at all contacts it shrinks unless e is 1.
//! # Source
//! Poisson's hypothesis as a complementarity problem: Glocker and Pfeiffer 1995, Anitescu and Potra 1997.
//! # Checked by
//! Tests below; `tests/bouncing_rod.rs`, `tests/bouncing_ball.rs`.

use nalgebra::{DMatrix, DVector};

use crate::contact::complementarity::solve;

/// Impacts one after the other at one instant that have not come to an end by then are refused.
const MOST_SEQUENTIAL: usize = 100_000;
/// An approach slower than this part of the fastest at the beginning is over: rounding of what all impulses do.
const STANDS: f64 = 1e-12;
/// The same of impacts one after the other, each of which is known to a few ulps of what it changes: what is left of infinitely many is less than an ulp.
pub(crate) const FOLLOWED: f64 = f64::EPSILON / 16.0;

/// Approaches that differ by less than this part are equally fast: rounding does not say which of them is first.
const AS_FAST: f64 = 1e-9;

/// How impacts at several contacts of one instant are taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MultipleImpacts {
    /// All at once.
    #[default]
    Simultaneous,
    /// The fastest approach first, then the next; those that are equally fast together.
    Sequential,
}

/// What becomes of contacts that slip so that no forces hold what presses on them (Painleve's paradox).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Painleve {
    /// The motion is refused.
    #[default]
    Refused,
    /// An impulse stops the slip: an impact without collision.
    Impact,
}

/// Impulses along the normals, N s; `None` if none are found.
pub(crate) fn impulses(
    rule: MultipleImpacts,
    response: &DMatrix<f64>,
    before: &DVector<f64>,
    restitution: &DVector<f64>,
) -> Option<DVector<f64>> {
    match rule {
        MultipleImpacts::Simultaneous => simultaneous(response, before, restitution),
        MultipleImpacts::Sequential => sequential(response, before, restitution),
    }
}

fn simultaneous(
    response: &DMatrix<f64>,
    before: &DVector<f64>,
    restitution: &DVector<f64>,
) -> Option<DVector<f64>> {
    let compression = solve(response, before)?;
    let returned = restitution.component_mul(&compression);
    let impulses = compression + returned;
    let then = before + response * &impulses;
    // Rounding would be pushed away by contacts that had no part in the impact.
    if then.iter().all(|then| *then >= -STANDS * before.amax()) {
        return Some(impulses);
    }
    Some(impulses + solve(response, &then)?)
}

fn sequential(
    response: &DMatrix<f64>,
    before: &DVector<f64>,
    restitution: &DVector<f64>,
) -> Option<DVector<f64>> {
    let mut now = before.clone();
    let mut impulses = DVector::zeros(before.len());
    let slow = -FOLLOWED * before.amax();
    for _ in 0..MOST_SEQUENTIAL {
        if now.min() >= slow {
            return Some(impulses);
        }
        let first = fastest(now.iter().copied());
        let part = DMatrix::from_fn(first.len(), first.len(), |i, j| response[(first[i], first[j])]);
        let [rates, ratios] =
            [&now, restitution].map(|all| DVector::from_fn(first.len(), |i, _| all[first[i]]));
        let own = simultaneous(&part, &rates, &ratios)?;
        for (index, impulse) in first.into_iter().zip(&own) {
            impulses[index] += impulse;
            now += response.column(index) * *impulse;
        }
    }
    None
}

/// Of the rates of gaps, those that close fastest, by their order.
pub(crate) fn fastest(rates: impl Iterator<Item = f64> + Clone) -> Vec<usize> {
    let least = rates.clone().fold(f64::INFINITY, f64::min);
    rates.enumerate().filter(|(_, rate)| *rate <= (1.0 - AS_FAST) * least).map(|(index, _)| index).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both ends of a uniform rod of unit mass: a push at one moves the other the opposite way, half as much.
    fn rod() -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &[4.0, -2.0, -2.0, 4.0])
    }

    fn after(rule: MultipleImpacts, before: [f64; 2], e: f64) -> Vec<f64> {
        let before = DVector::from_row_slice(&before);
        let e = DVector::from_element(2, e);
        let impulses = impulses(rule, &rod(), &before, &e).expect("an impact");
        (before + rod() * impulses).iter().copied().collect()
    }

    #[test]
    fn one_contact_is_newton_s() {
        let found = after(MultipleImpacts::Simultaneous, [-3.0, 5.0], 0.7);
        assert!((found[0] - 2.1).abs() < 1e-14, "{found:?}");
    }

    #[test]
    fn a_flat_fall_comes_back_flat_when_taken_simultaneously() {
        let found = after(MultipleImpacts::Simultaneous, [-3.0, -3.0], 0.5);
        assert!(found.iter().all(|v| (v - 1.5).abs() < 1e-14), "{found:?}");
    }

    /// Elastic impacts one after the other exchange the approaches of the ends, and keep the energy.
    #[test]
    fn sequential_keeps_the_energy() {
        let before = DVector::from_row_slice(&[-3.0, -1.0]);
        let found = DVector::from_vec(after(MultipleImpacts::Sequential, [-3.0, -1.0], 1.0));
        let inverse = rod().try_inverse().expect("regular");
        let energy = |v: &DVector<f64>| (v.transpose() * &inverse * v)[0];
        assert!((energy(&before) - energy(&found)).abs() < 1e-12, "{found}");
        assert!(found.iter().all(|v| *v >= -1e-12));
    }

    /// Three balls in a row, the first strikes two that touch.
    fn row() -> (DMatrix<f64>, DVector<f64>) {
        (DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]), DVector::from_row_slice(&[-1.0, 0.0]))
    }

    /// With e = 0 the first two go on together at 1/2, then the last two at 1/4, and so on: all at 1/3 in the end.
    #[test]
    fn infinitely_many_impacts_come_to_their_limit() {
        let (response, before) = row();
        let none = DVector::zeros(2);
        let push = impulses(MultipleImpacts::Sequential, &response, &before, &none).expect("a limit");
        assert!((push[0] - 2.0 / 3.0).abs() < 1e-11 && (push[1] - 1.0 / 3.0).abs() < 1e-11, "{push}");
    }

    /// A ball strikes two that touch at once: which of the two is first is not left to rounding.
    #[test]
    fn what_closes_equally_fast_strikes_together() {
        // Normals at 30 degrees to both sides of the way.
        let response = DMatrix::from_row_slice(2, 2, &[2.0, 0.5, 0.5, 2.0]);
        let before = DVector::from_row_slice(&[-1.0, -1.0 + 1e-14]);
        let push = impulses(MultipleImpacts::Sequential, &response, &before, &DVector::from_element(2, 1.0))
            .expect("one");
        assert!((push[0] - push[1]).abs() < 1e-13, "{push}");
        assert!((push[0] - 0.8).abs() < 1e-13, "{push}");
    }

    #[test]
    fn nothing_closes_after_a_plastic_impact() {
        let found = after(MultipleImpacts::Simultaneous, [-3.0, -1.0], 0.0);
        assert!(found.iter().all(|v| v.abs() < 1e-14), "{found:?}");
        let found = after(MultipleImpacts::Simultaneous, [-3.0, 4.0], 0.0);
        // The impulse 3/4 that stops one end takes 3/2 from the other's speed.
        assert!(found[0].abs() < 1e-14 && (found[1] - 2.5).abs() < 1e-14, "{found:?}");
    }
}
