//! How numbers that no `f64` is are rounded: to the nearest, or, to see what rounding does to a result, a few ulps off.
//!
//! A rounding that is not the nearest moves each number by 0.51 to 1 eps of it, with a sign and a size of its own that follow from
//! the number and the seed alone: the same number is the same wherever it stands, and equal computations stay equal. Numbers
//! that are an `f64`, such as 0, 1 or 0.5, are never moved: they hold no rounding error, and structure hangs on them.

use num_rational::BigRational;

use crate::scalar::{is_short, nearest};

/// The least and the greatest move, in units of eps times the number: more than rounding to the nearest takes back, so that every
/// number moves, and no more than twice what that leaves out.
const MOVES: [f64; 2] = [0.51, 1.0];
/// What rounding to the nearest leaves out at most, in units of what a running error analysis counts, which is eps times the number.
pub const LEFT_OUT: f64 = 0.5;
/// A multiplier that mixes the bits of a key well: that of splitmix64 (Steele, Lea and Flood 2014), as are the shifts.
const MIX: [u64; 3] = [0x9e37_79b9_7f4a_7c15, 0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb];
/// Bits of a value that tell it from others: what agrees in them is equal but for rounding.
const TOLD_APART: u32 = 24;

/// How numbers are rounded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Rounding(Option<u64>);

/// A number on a tape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constant {
    pub(crate) value: f64,
    /// The number nearest to the exact one.
    nearest: f64,
    /// Whether it is the exact one.
    pub(crate) is_exact: bool,
}

impl Constant {
    pub(crate) fn of(exact: &BigRational, rounding: Rounding) -> Self {
        let value = nearest(exact);
        let is_exact = is_short(value) || BigRational::from_float(value).is_some_and(|back| back == *exact);
        Self { value, nearest: value, is_exact }.rounded(rounding)
    }

    /// The same number rounded in another way.
    pub(crate) fn rounded(self, rounding: Rounding) -> Self {
        let value = if self.is_exact { self.nearest } else { rounding.moved(self.nearest).0 };
        Self { value, ..self }
    }
}

impl Rounding {
    /// To the nearest number.
    pub const NEAREST: Self = Self(None);

    /// Every number a few ulps off; each seed in another way.
    pub fn perturbed(seed: u64) -> Self {
        Self(Some(seed))
    }

    /// Whether numbers are rounded to the nearest.
    pub fn is_nearest(self) -> bool {
        self.0.is_none()
    }

    /// How far a number is off that was computed with such a rounding error; `key` tells numbers of one value apart that are not
    /// the same.
    pub fn computed(self, value: f64, error: f64, key: u64) -> f64 {
        if is_short(value) { 0.0 } else { self.draw(value, key) * error }
    }

    /// A value off by 0.51 to 1 times an error that it may have. What nearly agrees in value and key is moved alike, as rounding
    /// would: errors of equal computations add up.
    pub fn off(self, value: f64, error: f64, key: u64) -> f64 {
        value + self.draw(value, key) * error
    }

    pub(crate) fn pi(self) -> f64 {
        self.moved(std::f64::consts::PI).0
    }

    /// A number moved as it is on every tape, and what rounding leaves out of the move.
    pub fn moved(self, value: f64) -> (f64, f64) {
        rounded_sum(value, self.draw(value, 0) * value.abs() * f64::EPSILON)
    }

    /// How many times an error that it may have a value is off: 0.51 to 1, up or down; 0 to the nearest.
    pub fn draw(self, value: f64, key: u64) -> f64 {
        let Some(seed) = self.0 else { return 0.0 };
        let (sign, part) = sign_and_part(mix(mix(mix(seed) ^ key) ^ told(value)));
        // Sizes are drawn evenly in their logarithm.
        sign * MOVES[0] * libm::pow(MOVES[1] / MOVES[0], part)
    }
}

/// By how many eps a number is off one of its roundings: a half to one, up or down, as its first digits and what its error was before have it.
pub(crate) fn drawn(value: f64, error: f64) -> f64 {
    let (sign, part) = sign_and_part(mix(mix(told(value)) ^ told(error)));
    sign * (0.5 + 0.5 * part)
}

/// The bits of a value by which draws tell it from others.
fn told(value: f64) -> u64 {
    value.to_bits() >> (u64::BITS - 12 - TOLD_APART)
}

/// Up or down, and a part of one: of mixed bits the last and the upper ones.
fn sign_and_part(bits: u64) -> (f64, f64) {
    let sign = if bits & 1 == 0 { 1.0 } else { -1.0 };
    (sign, (bits >> 11) as f64 / (1_u64 << 53) as f64)
}

/// A sum, rounded, and what rounding leaves out of it; exact where the change is the smaller one.
pub fn rounded_sum(value: f64, change: f64) -> (f64, f64) {
    let after = value + change;
    (after, change - (after - value))
}

fn mix(key: u64) -> u64 {
    let key = key.wrapping_add(MIX[0]);
    let key = (key ^ (key >> 30)).wrapping_mul(MIX[1]);
    let key = (key ^ (key >> 27)).wrapping_mul(MIX[2]);
    key ^ (key >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_numbers_stay_and_others_move_by_some_ulps() {
        for seed in 0..100 {
            let rounding = Rounding::perturbed(seed);
            assert_eq!(rounding.computed(0.5, 1.0, 3), 0.0);
            let ulps = rounding.computed(0.1, f64::EPSILON, 3) / f64::EPSILON;
            assert!((0.4..2.6).contains(&ulps.abs()), "{ulps}");
            let tenth = BigRational::new(1.into(), 10.into());
            assert_ne!(Constant::of(&tenth, rounding).value, 0.1);
            assert_eq!(Constant::of(&tenth, Rounding::NEAREST).value, 0.1);
        }
    }

    /// Half of all draws go up, and both halves of the sizes' range come.
    #[test]
    fn draws_differ() {
        let draws: Vec<f64> = (0..1000).map(|seed| Rounding::perturbed(seed).draw(0.1, 0)).collect();
        let count = |of: &dyn Fn(f64) -> bool| draws.iter().filter(|draw| of(**draw)).count();
        assert!((430..570).contains(&count(&|draw| draw > 0.0)));
        assert!((430..570).contains(&count(&|draw| draw.abs() < 0.714)));
    }

    #[test]
    fn what_nearly_agrees_is_moved_alike() {
        let rounding = Rounding::perturbed(7);
        let [a, b] = [0.1, 0.1 * (1.0 + 1e-12)].map(|value| rounding.off(value, 1.0, 5) - value);
        assert!((a - b).abs() < 1e-12);
    }
}
