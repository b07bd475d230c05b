//! Numbers with the rounding error that their computation may have made, or one that it might: [`Rounded`], [`Drawn`].
//!
//! First order, as a running error analysis: the error of a sum is that of its parts and one rounding of its own, that of
//! `f(x)` is `|f'(x)|` times that of x and one rounding of its own. A rounding is counted where there is one: sums and
//! products of numbers with few digits are exact. Source: Higham, Accuracy and Stability of Numerical Algorithms, 3.3.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use crate::rounding::{Rounding, drawn};
use crate::table::Table;

/// Digits of a significand.
const BITS: u32 = 53;
/// A number with so many zeros at the end of its significand was not made by rounding, but once in 16 million times.
const SHORT_BY: u32 = 24;

/// A value and what is known of its rounding error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inexact<E> {
    /// The value.
    pub value: f64,
    /// Times `f64::EPSILON`, the error.
    pub error: E,
}

/// A value and the rounding error that it may have in units of `f64::EPSILON`, absolute.
pub type Rounded = Inexact<f64>;

/// A value and one error of those that rounding may have made. What follows from two numbers that follow from one is off by both together.
pub type Drawn = Inexact<OneError>;

/// What is known of a rounding error, in units of `f64::EPSILON`: the most that it may be, as an `f64`, or one of many.
pub trait RoundingError: Copy + Debug + Send + Sync + PartialEq + 'static {
    /// Of what is exact.
    const NONE: Self;
    /// Of a sum.
    #[must_use]
    fn and(self, other: Self) -> Self;
    /// Of so many times the number.
    #[must_use]
    fn times(self, by: f64) -> Self;
    /// Of this part of it.
    #[must_use]
    fn over(self, by: f64) -> Self;
    /// And of one rounding to this value.
    #[must_use]
    fn rounded(self, value: f64) -> Self;
    /// Of the square root: near zero it is less than what the slope says.
    #[must_use]
    fn root(self, root: f64) -> Self;
    /// Of a length, by those of its parts.
    fn of_length(length: f64, parts: impl Iterator<Item = Inexact<Self>>) -> Self;
    /// Of the unknowns of a system, by those of its rows: what these make of them with their signs, or likely at most.
    fn of_unknowns(
        rows: Vec<Self>,
        signed: impl Fn(Vec<f64>) -> Vec<f64>,
        likely: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Vec<Self>;
    /// Whether there is none.
    fn is_none(self) -> bool {
        self == Self::NONE
    }
}

impl RoundingError for f64 {
    const NONE: Self = 0.0;
    fn and(self, other: Self) -> Self {
        self + other
    }
    fn times(self, by: f64) -> Self {
        by.abs() * self
    }
    fn over(self, by: f64) -> Self {
        self / by.abs()
    }
    fn rounded(self, value: f64) -> Self {
        self + value.abs()
    }
    fn root(self, root: f64) -> Self {
        (0.5 * self / root).min((self / f64::EPSILON).sqrt())
    }
    fn of_length(_: f64, parts: impl Iterator<Item = Rounded>) -> Self {
        parts.fold(0.0, |length, part| libm::hypot(length, part.error))
    }
    fn of_unknowns(
        rows: Vec<Self>,
        _: impl Fn(Vec<f64>) -> Vec<f64>,
        likely: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Vec<Self> {
        likely(&rows)
    }
}

/// A rounding error in units of `f64::EPSILON`, with its sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OneError(pub f64);

impl RoundingError for OneError {
    const NONE: Self = Self(0.0);
    fn and(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
    fn times(self, by: f64) -> Self {
        Self(by * self.0)
    }
    fn over(self, by: f64) -> Self {
        Self(self.0 / by)
    }
    /// Off by one way or the other, as its digits and what it comes from have it.
    fn rounded(self, value: f64) -> Self {
        Self(self.0 + drawn(value, self.0) * value)
    }
    fn root(self, root: f64) -> Self {
        Self((0.5 * self.0.abs() / root).min((self.0.abs() / f64::EPSILON).sqrt()).copysign(self.0))
    }
    fn of_length(length: f64, parts: impl Iterator<Item = Drawn>) -> Self {
        let sum: f64 = parts.map(|part| part.value * part.error.0).sum();
        Self(if sum == 0.0 { 0.0 } else { sum / length })
    }
    fn of_unknowns(
        rows: Vec<Self>,
        signed: impl Fn(Vec<f64>) -> Vec<f64>,
        _: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Vec<Self> {
        signed(rows.into_iter().map(|row| row.0).collect()).into_iter().map(Self).collect()
    }
}

/// Whether a number has so few digits that it is not the result of a rounding: 1, 0.5 or 1000, and not 0.1.
pub fn is_short(value: f64) -> bool {
    digits(value) <= BITS - SHORT_BY
}

/// Length of the significand, bits.
fn digits(value: f64) -> u32 {
    let fraction = value.to_bits() & ((1 << (BITS - 1)) - 1);
    if value == 0.0 { 0 } else { BITS - fraction.trailing_zeros().min(BITS - 1) }
}

impl Rounded {
    /// The error, absolute.
    pub fn noise(self) -> f64 {
        self.error * f64::EPSILON
    }
}

impl Drawn {
    /// A number that is off by so many times eps of it.
    pub fn off_by(value: f64, part: f64) -> Self {
        Self { value, error: OneError(part * value.abs()) }
    }

    /// A number that is rounded in this way, unless it is exact; `key` tells numbers of one value apart that are not the same.
    pub fn rounded(value: f64, is_exact: bool, rounding: Rounding, key: u64) -> Self {
        Self::off_by(value, if is_exact { 0.0 } else { rounding.draw(value, key) })
    }

    /// What it is off by.
    pub fn off(self) -> f64 {
        self.error.0 * f64::EPSILON
    }
}

impl<E: RoundingError> Inexact<E> {
    /// A number that was rounded when it was found, unless it has few digits.
    pub fn leaf(value: f64) -> Self {
        Self::constant(value, is_short(value))
    }

    /// A number that came out of a computation: that it has few digits is where it was stopped, not how it is known.
    pub fn computed(value: f64) -> Self {
        Self::constant(value, false)
    }

    /// A value with the error of what it is found from, and one rounding of its own if there is one.
    fn found(value: f64, brought: E, is_exact: bool) -> Self {
        Self { value, error: if is_exact { brought } else { brought.rounded(value) } }
    }

    /// A function's value, its slope there, and what its argument brings.
    fn of(self, value: f64, slope: f64) -> Self {
        // Where nothing is uncertain, an infinite slope does not matter.
        let is_certain = self.error.is_none();
        let brought = if is_certain { E::NONE } else { self.error.times(slope) };
        Self::found(value, brought, value == 0.0 && is_certain)
    }
}

impl<E: RoundingError> Add for Inexact<E> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let sum = a + b;
        // Knuth's error of a sum.
        let part = sum - a;
        let is_exact = (a - (sum - part)) + (b - part) == 0.0;
        Self::found(sum, self.error.and(other.error), is_exact)
    }
}

impl<E: RoundingError> Sub for Inexact<E> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<E: RoundingError> Neg for Inexact<E> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, error: self.error.times(-1.0) }
    }
}

impl<E: RoundingError> Mul for Inexact<E> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        // A power of two shifts all digits and adds none.
        let is_exact = digits(a).min(digits(b)) <= 1 || digits(a) + digits(b) <= BITS;
        Self::found(a * b, other.error.times(a).and(self.error.times(b)), is_exact)
    }
}

impl<E: RoundingError> Div for Inexact<E> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let value = a / b;
        if b.is_infinite() && a.is_finite() {
            return Self::splat(value);
        }
        // A quotient of few digits that gives the numerator back was exact.
        let is_exact = is_short(value) && is_short(b) && value * b == a;
        Self::found(value, self.error.and(other.error.times(-value)).over(b), is_exact)
    }
}

impl<E: RoundingError> Scalar for Inexact<E> {
    fn splat(value: f64) -> Self {
        Self { value, error: E::NONE }
    }
    fn constant(value: f64, is_exact: bool) -> Self {
        Self::found(value, E::NONE, is_exact)
    }
    fn choose(self, positive: Self, negative: Self) -> Self {
        if self.value >= 0.0 { positive } else { negative }
    }
    fn sign(self) -> Self {
        Self::splat(self.value.sign())
    }
    fn segment(self, table: &Table) -> Self {
        Self::splat(table.segment(self.value) as f64)
    }
    fn of_segment(self, of: impl Fn(usize) -> f64) -> Self {
        Self::leaf(of(self.value as usize))
    }
    fn sqrt(self) -> Self {
        let (root, is_certain) = (self.value.sqrt(), self.error.is_none());
        let brought = if is_certain { E::NONE } else { self.error.root(root) };
        Self::found(root, brought, is_certain && root * root == self.value && is_short(root))
    }
    fn sin(self) -> Self {
        self.sine_and_cosine().0
    }
    fn cos(self) -> Self {
        self.sine_and_cosine().1
    }
    fn sine_and_cosine(self) -> (Self, Self) {
        let (sin, cos) = libm::sincos(self.value);
        let is_zero = self.value == 0.0 && self.error.is_none();
        (self.of(sin, cos), if is_zero { Self::one() } else { self.of(cos, -sin) })
    }
    fn tan(self) -> Self {
        let value = libm::tan(self.value);
        self.of(value, 1.0 + value * value)
    }
    fn asin(self) -> Self {
        self.of(libm::asin(self.value), 1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        self.of(libm::acos(self.value), -1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn atan(self) -> Self {
        self.of(libm::atan(self.value), 1.0 / (1.0 + self.value * self.value))
    }
    fn atan2(self, x: Self) -> Self {
        let (y, x, value) = (self, x, libm::atan2(self.value, x.value));
        let square = x.value * x.value + y.value * y.value;
        let brought = y.error.times(x.value).and(x.error.times(-y.value));
        let brought = if brought.is_none() { E::NONE } else { brought.over(square) };
        Self::found(value, brought, false)
    }
    fn sinh(self) -> Self {
        self.of(libm::sinh(self.value), libm::cosh(self.value))
    }
    fn cosh(self) -> Self {
        self.of(libm::cosh(self.value), libm::sinh(self.value))
    }
    fn tanh(self) -> Self {
        let value = libm::tanh(self.value);
        self.of(value, 1.0 - value * value)
    }
    fn exp(self) -> Self {
        let value = libm::exp(self.value);
        if self.value == 0.0 && self.error.is_none() { Self::one() } else { self.of(value, value) }
    }
    fn log(self) -> Self {
        self.of(libm::log(self.value), 1.0 / self.value)
    }
    fn pow(self, exponent: Self) -> Self {
        let value = libm::pow(self.value, exponent.value);
        let own = self.of(value, exponent.value * value / self.value);
        if exponent.error.is_none() {
            return own;
        }
        let by_exponent = exponent.error.times(libm::log(self.value)).times(value);
        Self { value, error: own.error.and(by_exponent) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(x: Rounded) -> f64 {
        x.noise()
    }

    #[test]
    fn few_digits_are_exact() {
        let [one, half, three] = [1.0, 0.5, 3.0].map(Rounded::leaf);
        assert_eq!(error((one + half) * three / half - one), 0.0);
        assert_eq!(error(half * Rounded::splat(0.1)), 0.0);
        assert_eq!(error(Rounded::leaf(4.0).sqrt()), 0.0);
        assert!(error(one / three) > 0.0 && error(Rounded::leaf(2.0).sqrt()) > 0.0);
        assert!(is_short(1000.0) && is_short(0.0) && !is_short(0.1) && !is_short(1.0 / 3.0));
    }

    /// 0.1 + 0.2 - 0.3 is 5.6e-17, all of it rounding.
    #[test]
    fn the_error_is_that_of_the_parts() {
        let [a, b, c] = [0.1, 0.2, 0.3].map(Rounded::leaf);
        let sum = a + b - c;
        assert!(sum.value.abs() <= error(sum) && error(sum) < 1e-15, "{sum:?}");
        let far = Rounded::leaf(1e5 + 0.1) - Rounded::leaf(1e5);
        assert!((far.value - 0.1).abs() <= error(far) && error(far) < 1e-10);
    }

    #[test]
    fn near_zero_a_root_has_the_root_of_the_error() {
        let root = (Rounded::leaf(0.1) + Rounded::leaf(0.2) - Rounded::leaf(0.3)).sqrt();
        assert!(root.error.is_finite() && error(root) < 1e-7);
    }

    /// What two numbers have from one goes out of their difference, and what is left is no more than rounding may have made.
    #[test]
    fn one_error_passes_on_with_its_sign() {
        let [x, third] = [Drawn::off_by(0.1, 0.7), Drawn::splat(3.0).sqrt()];
        assert_ne!(x.off(), 0.0);
        assert_eq!((x + x - x - x).off(), 0.0);
        assert!((x * third - third * x).off() == 0.0 && (x / third * third).off() != x.off());
        for number in 1..200 {
            let value = 0.37 * f64::from(number);
            let bound = |x: Rounded| (x.sin() * x.exp() / (x.sqrt() + x) - x.tanh()).noise();
            let one = |x: Drawn| (x.sin() * x.exp() / (x.sqrt() + x) - x.tanh()).off();
            let (bound, off) = (bound(Rounded::computed(value)), one(Drawn::off_by(value, 1.0)));
            assert!(off != 0.0 && off.abs() <= 1.000_001 * bound, "{value}: {off:e} of {bound:e}");
        }
    }
}
