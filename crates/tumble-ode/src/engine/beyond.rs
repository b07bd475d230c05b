//! Guards that count where they go beyond zero by more than rounding, and where their conditions hold.

use tumble_expr::Row;

use super::ahead;
use crate::hybrid::Direction;
use crate::polynomial::{slope, value};
use crate::roots::roots;
use crate::signs::leading_sign;

/// What is beyond zero by less than this part of the scale may be so by rounding: what slides along what it touches has a distance that is
/// zero but for that.
const DEEP: f64 = 64.0 * f64::EPSILON;
/// A condition that is negative by less than this part of the scale holds if it is about to: where two guards meet, one of them is to
/// count. So much may be left of one that was beyond zero by rounding.
const NEARLY: f64 = 1e-11;

/// A guard along a step.
pub(super) struct Passing<'a> {
    pub(super) series: &'a [f64],
    /// Series of what must not be negative for a zero to count.
    pub(super) conditions: &'a [Row],
    pub(super) direction: Direction,
    /// How many of its derivatives, itself included, are zero now.
    pub(super) zeros: usize,
    pub(super) length: f64,
}

impl Passing<'_> {
    /// When it first goes beyond zero where its conditions hold. Where they do not, it may be beyond zero for long.
    pub(super) fn first(&self, scale: f64) -> Option<f64> {
        let Self { series, direction, zeros, length, .. } = *self;
        let is_beyond = zeros <= 1 && direction.allows(series[0]) && series[0].abs() <= NEARLY * scale;
        let mut found = roots(ahead(series, if zeros > 1 { zeros } else { 0 }), length);
        if is_beyond {
            // Rounding may have left it so far beyond zero that its arc does not come back from there: it is taken from zero, too.
            found.extend(roots(ahead(series, 1), length));
            found.sort_by(|a, b| a.at.total_cmp(&b.at));
        }
        let is_at_zero = zeros == 0 && (is_beyond || series[0] == 0.0);
        let now = (is_at_zero && direction.allows(leading_sign(&series[1..]))).then_some(0.0);
        let crossings = found.iter().filter(|root| root.crosses_to.is_some_and(|to| direction.allows(to)));
        let counts = |at: &f64| {
            let next = found.iter().map(|root| root.at).find(|next| next > at).unwrap_or(length);
            let goes_beyond = [0.5 * (at + next), next].into_iter().any(|s| {
                let value = value(series, s);
                direction.allows(value) && value.abs() > DEEP * scale
            });
            goes_beyond && self.conditions.iter().all(|condition| holds(condition, *at, scale))
        };
        now.into_iter().chain(crossings.map(|root| root.at)).find(counts)
    }
}

/// Whether a condition holds at s; what is about to break does not, within rounding.
fn holds(series: &[f64], s: f64, scale: f64) -> bool {
    let here = value(series, s);
    here > DEEP * scale || (here >= -NEARLY * scale && slope(series, s) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(series: &[f64], conditions: &[Row], zeros: usize) -> Option<f64> {
        let passing = Passing { series, conditions, direction: Direction::Falling, zeros, length: 2.0 };
        passing.first(1.0)
    }

    #[test]
    fn what_is_zero_but_for_rounding_does_not_pass() {
        assert_eq!(first(&[1e-16, -3e-17, 1e-18], &[], 0), None);
        assert_eq!(first(&[-1e-16, -3e-17], &[], 0), None);
        assert_eq!(first(&[-1e-16, -1.0], &[], 0), Some(0.0));
        assert_eq!(first(&[1.0, -1.0], &[], 0), Some(1.0));
        // Known to be zero and left upwards, it comes down again.
        assert_eq!(first(&[-1e-16, 1e-9, -1e-9], &[], 1), Some(1.0));
        // Up again before it was found to be back at zero.
        assert_eq!(first(&[0.0, 1.0, -1.0], &[], 0), Some(1.0));
    }

    #[test]
    fn where_a_condition_does_not_hold_it_may_be_beyond_zero() {
        let condition = |c: &[f64]| vec![Row::from_slice(c)];
        assert_eq!(first(&[1.0, -1.0], &condition(&[1.0]), 0), Some(1.0));
        assert_eq!(first(&[1.0, -1.0], &condition(&[-1.0]), 0), None);
        assert_eq!(first(&[-1.0, 0.0, -1.0], &condition(&[1.0]), 0), None);
        // It enters, or leaves, at the very zero.
        assert_eq!(first(&[1.0, -1.0], &condition(&[-1.0, 1.0]), 0), Some(1.0));
        assert_eq!(first(&[1.0, -1.0], &condition(&[1.0, -1.0]), 0), None);
        // From behind, out and in again.
        assert_eq!(first(&[-0.75, 2.0, -1.0], &condition(&[1.0]), 0), Some(1.5));
    }
}
