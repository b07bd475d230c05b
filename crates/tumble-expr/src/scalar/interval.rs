//! Intervals that enclose every value a computation may have.
//!
//! Results are rounded outwards: by one unit in the last place for sums, products, quotients and square roots, which
//! IEEE 754 rounds correctly, and by [`KERNEL_ULPS`] for functions of the pinned kernel. What has no value somewhere in
//! an argument, as `1/x` about zero, is [`Interval::ENTIRE`]: nothing is known of it.

use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use crate::table::Table;

/// The kernel's functions are accurate to one unit in the last place; a second one covers their own monotonicity.
const KERNEL_ULPS: usize = 2;
/// Peaks of a sine this close to an argument, in proportion to it, count as within it: the period is rounded.
const PEAK_MARGIN: f64 = 1e-9;

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The least of them.
    pub low: f64,
    /// The greatest of them.
    pub high: f64,
}

impl Interval {
    /// Every number: nothing is known.
    pub const ENTIRE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// From one number to another; what is not a number stands for anything.
    #[inline]
    pub fn new(low: f64, high: f64) -> Self {
        let low = if low.is_nan() { f64::NEG_INFINITY } else { low };
        let high = if high.is_nan() { f64::INFINITY } else { high };
        Self { low, high }
    }

    /// One number.
    #[inline]
    pub fn point(value: f64) -> Self {
        Self::new(value, value)
    }

    /// All numbers no farther from zero than that.
    pub fn around_zero(reach: f64) -> Self {
        Self::new(-reach, reach)
    }

    /// Largest absolute value.
    #[inline]
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// A number in it, about its middle.
    pub(crate) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// How far it reaches from there, at most.
    pub(crate) fn reach(self) -> f64 {
        let middle = self.middle();
        (self.high - middle).max(middle - self.low).next_up()
    }

    /// Whether all numbers in it have that sign, +1 or -1: the sign, or 0 where zero is among them.
    pub fn definite_sign(self) -> f64 {
        if self.low > 0.0 {
            1.0
        } else if self.high < 0.0 {
            -1.0
        } else {
            0.0
        }
    }

    /// Whether a number is in it.
    #[inline]
    pub fn contains(self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// The smallest interval that holds both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// What both hold, where two ways enclose one value.
    pub fn both(self, other: Self) -> Self {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        // Two enclosures of one value overlap, unless rounding in an argument speaks against it.
        if low <= high { Self { low, high } } else { self }
    }

    /// Greater at both ends by so many units in the last place.
    fn widened(self, ulps: usize) -> Self {
        let (mut low, mut high) = (self.low, self.high);
        for _ in 0..ulps {
            (low, high) = (down(low), up(high));
        }
        Self::new(low, high)
    }

    #[inline]
    fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    /// Of a function that increases, defined from `least` on.
    fn increasing(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.low), f(self.high)).widened(KERNEL_ULPS)
    }

    /// Of the least and the greatest of some values.
    fn of_corners(values: impl Iterator<Item = f64> + Clone) -> Self {
        if values.clone().any(f64::is_nan) {
            return Self::ENTIRE;
        }
        let low = values.clone().fold(f64::INFINITY, f64::min);
        Self::new(low, values.fold(f64::NEG_INFINITY, f64::max))
    }

    /// A sine or cosine, whose greatest values are at `peak` and every period from there.
    fn wave(self, f: fn(f64) -> f64, peak: f64) -> Self {
        let margin = PEAK_MARGIN * self.magnitude().max(1.0);
        if (self.high - self.low).is_nan() || self.high - self.low >= 2.0 * PI - 2.0 * margin {
            return Self::around_zero(1.0);
        }
        let holds = |at: f64| {
            let next = at + 2.0 * PI * ((self.low - margin - at) / (2.0 * PI)).ceil();
            next <= self.high + margin
        };
        let ends = Self::of_corners([f(self.low), f(self.high)].into_iter()).widened(KERNEL_ULPS);
        Self {
            low: if holds(peak + PI) { -1.0 } else { ends.low.max(-1.0) },
            high: if holds(peak) { 1.0 } else { ends.high.min(1.0) },
        }
    }
}

/// At most the next number below, without a branch: by Rump, Zimmermann, Boldo and Melquiond, Computing predecessor and successor
/// in rounding to nearest, BIT 49 (2009). What has overflown is at least the largest number.
#[inline]
fn down(value: f64) -> f64 {
    if value == f64::INFINITY { f64::MAX } else { value - (HALF_ULP * value.abs() + LEAST) }
}

/// At least the next number above.
#[inline]
fn up(value: f64) -> f64 {
    if value == f64::NEG_INFINITY { f64::MIN } else { value + (HALF_ULP * value.abs() + LEAST) }
}

/// `2^-53 (1 + 2^-52)`: this times a number is more than half the distance to its neighbours, ...
const HALF_ULP: f64 = 0.5 * f64::EPSILON * (1.0 + f64::EPSILON);
/// ... and where that is lost in underflow, the least number above zero is enough.
const LEAST: f64 = f64::from_bits(1);

/// A product of ends, where an end at infinity is no number that zero meets.
#[inline]
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { 0.0 } else { a * b }
}

impl Add for Interval {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        Self::new(down(self.low + other.low), up(self.high + other.high))
    }
}

impl Sub for Interval {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Interval {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Interval {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if self.low > 0.0 && other.low > 0.0 {
            return Self::new(down(self.low * other.low), up(self.high * other.high));
        }
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let [a, b] = [product(self.low, other.low), product(self.low, other.high)];
        let [c, d] = [product(self.high, other.low), product(self.high, other.high)];
        Self::new(down(a.min(b).min(c.min(d))), up(a.max(b).max(c.max(d))))
    }
}

impl Div for Interval {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        if other.contains(0.0) {
            return Self::ENTIRE;
        }
        if self.is_zero() {
            return self;
        }
        let [a, b] = [self.low / other.low, self.low / other.high];
        let [c, d] = [self.high / other.low, self.high / other.high];
        // Infinity over infinity is anything.
        if (a + b + c + d).is_nan() {
            return Self::ENTIRE;
        }
        Self::new(down(a.min(b).min(c.min(d))), up(a.max(b).max(c.max(d))))
    }
}

impl Scalar for Interval {
    #[inline]
    fn splat(value: f64) -> Self {
        Self::point(value)
    }

    fn constant(value: f64, is_exact: bool) -> Self {
        let value = Self::point(value);
        if is_exact { value } else { value.widened(1) }
    }

    /// The rule of frozen branches: their signs are single numbers.
    fn choose(self, positive: Self, negative: Self) -> Self {
        if self.low >= 0.0 {
            positive
        } else if self.high < 0.0 {
            negative
        } else {
            positive.hull(negative)
        }
    }

    fn sign(self) -> Self {
        Self { low: self.low.sign(), high: self.high.sign() }
    }

    fn segment(self, table: &Table) -> Self {
        Self { low: table.segment(self.low) as f64, high: table.segment(self.high) as f64 }
    }

    fn of_segment(self, of: impl Fn(usize) -> f64) -> Self {
        let values = self.low as usize..=self.high as usize;
        Self::of_corners(values.map(of).collect::<Vec<_>>().into_iter())
    }

    #[inline]
    fn square(self) -> Self {
        let (low, high) = (self.low.abs(), self.high.abs());
        let least = if self.contains(0.0) { 0.0 } else { low.min(high) };
        let most = low.max(high);
        Self::new(down(least * least).max(0.0), up(most * most))
    }

    fn sqrt(self) -> Self {
        if self.high < 0.0 {
            return Self::ENTIRE;
        }
        Self::new(down(self.low.max(0.0).sqrt()).max(0.0), up(self.high.sqrt()))
    }

    fn sin(self) -> Self {
        self.wave(libm::sin, PI / 2.0)
    }

    fn cos(self) -> Self {
        self.wave(libm::cos, 0.0)
    }

    fn tan(self) -> Self {
        let turns = |x: f64| ((x / PI) - 0.5).floor();
        let margin = PEAK_MARGIN * self.magnitude().max(1.0);
        let crosses = turns(self.low - margin) != turns(self.high + margin);
        if crosses || self.high - self.low >= PI { Self::ENTIRE } else { self.increasing(libm::tan) }
    }

    fn asin(self) -> Self {
        Self { low: self.low.max(-1.0), high: self.high.min(1.0) }.increasing(libm::asin)
    }

    fn acos(self) -> Self {
        -Self { low: self.low.max(-1.0), high: self.high.min(1.0) }.increasing(|x| -libm::acos(x))
    }

    fn atan(self) -> Self {
        self.increasing(libm::atan)
    }

    fn atan2(self, x: Self) -> Self {
        // On the negative axis and at the origin it jumps.
        if x.low <= 0.0 && self.contains(0.0) {
            return Self::ENTIRE;
        }
        let corners = [(self.low, x.low), (self.low, x.high), (self.high, x.low), (self.high, x.high)];
        Self::of_corners(corners.into_iter().map(|(y, x)| libm::atan2(y, x))).widened(KERNEL_ULPS)
    }

    fn sinh(self) -> Self {
        self.increasing(libm::sinh)
    }

    fn cosh(self) -> Self {
        let (low, high) = (self.low.abs(), self.high.abs());
        let least = if self.contains(0.0) { 0.0 } else { low.min(high) };
        Self::new(least, low.max(high)).increasing(libm::cosh)
    }

    fn tanh(self) -> Self {
        Self { low: -1.0, high: 1.0 }.both(self.increasing(libm::tanh))
    }

    fn exp(self) -> Self {
        let value = self.increasing(libm::exp);
        Self { low: value.low.max(0.0), ..value }
    }

    fn log(self) -> Self {
        if self.low < 0.0 { Self::ENTIRE } else { self.increasing(libm::log) }
    }

    fn pow(self, exponent: Self) -> Self {
        if self.high < 0.0 || (self.low <= 0.0 && exponent.low < 0.0) {
            return Self::ENTIRE;
        }
        let base = self.low.max(0.0);
        let corners = [base, self.high].into_iter();
        let corners = corners.flat_map(|a| [exponent.low, exponent.high].map(|p| libm::pow(a, p)));
        let value = Self::of_corners(corners).widened(KERNEL_ULPS);
        Self { low: value.low.max(0.0), ..value }
    }

    fn smooth(self, coefficient: Self) -> Self {
        if self == Self::ENTIRE { Self::ENTIRE } else { coefficient }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Function = (fn(Interval) -> Interval, fn(f64) -> f64);

    const FUNCTIONS: [Function; 13] = [
        (Interval::sqrt, f64::sqrt),
        (Interval::square, |x| x * x),
        (Interval::sin, libm::sin),
        (Interval::cos, libm::cos),
        (Interval::tan, libm::tan),
        (Interval::asin, libm::asin),
        (Interval::acos, libm::acos),
        (Interval::atan, libm::atan),
        (Interval::sinh, libm::sinh),
        (Interval::cosh, libm::cosh),
        (Interval::tanh, libm::tanh),
        (Interval::exp, libm::exp),
        (Interval::log, libm::log),
    ];

    proptest! {
        /// What a function has inside an interval is inside what it has of the interval.
        #[test]
        fn values_are_enclosed(
            middle in prop_oneof![-3.0f64..3.0, -1e3f64..1e3],
            reach in prop_oneof![1e-9f64..1e-3, 0.0f64..4.0],
            part in 0.0f64..=1.0,
            other in -3.0f64..3.0,
        ) {
            let x = Interval::new(middle - reach, middle + reach);
            let inside = (x.low + part * (x.high - x.low)).clamp(x.low, x.high);
            for (index, (of_interval, of_number)) in FUNCTIONS.iter().enumerate() {
                let value = of_number(inside);
                prop_assert!(value.is_nan() || of_interval(x).contains(value), "{} of {} in {:?}", index, inside, x);
            }
            let y = Interval::new(other, other + reach);
            let of_y = (y.low + part * (y.high - y.low)).clamp(y.low, y.high);
            prop_assert!((x + y).contains(inside + of_y) && (x - y).contains(inside - of_y));
            prop_assert!((x * y).contains(inside * of_y) && (x / y).contains(inside / of_y));
            prop_assert!(x.atan2(y).contains(libm::atan2(inside, of_y)));
            let power = libm::pow(inside, of_y);
            prop_assert!(power.is_nan() || x.pow(y).contains(power), "{:?} to {:?}", x, y);
        }
    }

    #[test]
    fn unknown_stays_unknown() {
        let about_zero = Interval::around_zero(1.0);
        assert_eq!(Interval::one() / about_zero, Interval::ENTIRE);
        assert_eq!(Interval::ENTIRE - Interval::ENTIRE, Interval::ENTIRE);
        assert_eq!(Interval::ENTIRE * Interval::zero(), Interval::zero());
        assert_eq!(about_zero.atan2(about_zero), Interval::ENTIRE);
        assert_eq!(Interval::point(2.0) + Interval::zero(), Interval::point(2.0));
        assert_eq!(about_zero.definite_sign(), 0.0);
    }

    /// Where ends overflow, what is between them is not lost: one over it is small.
    #[test]
    fn what_overflows_is_large() {
        let huge = Interval::new(1e200, 1e300).square();
        assert_eq!(huge, Interval::new(f64::MAX, f64::INFINITY));
        let small = Interval::point(1.0) / huge;
        assert!(small.low <= 0.0 && (0.0..1e-300).contains(&small.high), "{small:?}");
        assert_eq!((huge - huge).low, f64::NEG_INFINITY);
    }
}
