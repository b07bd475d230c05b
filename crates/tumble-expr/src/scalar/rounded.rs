//! Numbers with the rounding error that their computation may have made.
//!
//! First order, as a running error analysis: the error of a sum is that of its parts and one rounding of its own, that of
//! `f(x)` is `|f'(x)|` times that of x and one rounding of its own. A rounding is counted where there is one: sums and
//! products of numbers with few digits are exact. Source: Higham, Accuracy and Stability of Numerical Algorithms, 3.3.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use crate::table::Table;

/// Digits of a significand.
const BITS: u32 = 53;
/// A number with so many zeros at the end of its significand was not made by rounding, but once in 16 million times.
const SHORT_BY: u32 = 24;

/// A value and its rounding error in units of `f64::EPSILON`, absolute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounded {
    /// The value.
    pub value: f64,
    /// Times `f64::EPSILON`, the error that it may have.
    pub error: f64,
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
    /// A number that was rounded when it was found, unless it has few digits.
    pub fn leaf(value: f64) -> Self {
        Self::constant(value, is_short(value))
    }

    /// A number that came out of a computation: that it has few digits is where it was stopped, not how it is known.
    pub fn computed(value: f64) -> Self {
        Self::constant(value, false)
    }

    /// The error, absolute.
    pub fn noise(self) -> f64 {
        self.error * f64::EPSILON
    }

    /// A function's value, its slope there, and what its argument brings.
    fn of(self, value: f64, slope: f64) -> Self {
        // Where nothing is uncertain, an infinite slope does not matter.
        let brought = if self.error == 0.0 { 0.0 } else { slope.abs() * self.error };
        let is_exact = value == 0.0 && self.error == 0.0;
        Self { value, error: brought + if is_exact { 0.0 } else { value.abs() } }
    }
}

impl Add for Rounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let sum = a + b;
        // Knuth's error of a sum.
        let part = sum - a;
        let is_exact = (a - (sum - part)) + (b - part) == 0.0;
        Self { value: sum, error: self.error + other.error + if is_exact { 0.0 } else { sum.abs() } }
    }
}

impl Sub for Rounded {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Rounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Mul for Rounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        // A power of two shifts all digits and adds none.
        let is_exact = digits(a).min(digits(b)) <= 1 || digits(a) + digits(b) <= BITS;
        let own = if is_exact { 0.0 } else { (a * b).abs() };
        Self { value: a * b, error: a.abs() * other.error + b.abs() * self.error + own }
    }
}

impl Div for Rounded {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let value = a / b;
        if b.is_infinite() && a.is_finite() {
            return Self::splat(value);
        }
        // A quotient of few digits that gives the numerator back was exact.
        let is_exact = is_short(value) && is_short(b) && value * b == a;
        let own = if is_exact { 0.0 } else { value.abs() };
        Self { value, error: (self.error + value.abs() * other.error) / b.abs() + own }
    }
}

impl Scalar for Rounded {
    fn splat(value: f64) -> Self {
        Self { value, error: 0.0 }
    }
    fn constant(value: f64, is_exact: bool) -> Self {
        Self { value, error: if is_exact { 0.0 } else { value.abs() } }
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
        let root = self.value.sqrt();
        // Near zero the root of the error is less than what the slope says.
        let brought = (0.5 * self.error / root).min((self.error / f64::EPSILON).sqrt());
        let brought = if self.error == 0.0 { 0.0 } else { brought };
        let is_exact = self.error == 0.0 && root * root == self.value && is_short(root);
        Self { value: root, error: brought + if is_exact { 0.0 } else { root } }
    }
    fn sin(self) -> Self {
        self.sine_and_cosine().0
    }
    fn cos(self) -> Self {
        self.sine_and_cosine().1
    }
    fn sine_and_cosine(self) -> (Self, Self) {
        let (sin, cos) = libm::sincos(self.value);
        let is_zero = self.value == 0.0 && self.error == 0.0;
        (self.of(sin, cos), if is_zero { Self::one() } else { self.of(cos, sin) })
    }
    fn tan(self) -> Self {
        let value = libm::tan(self.value);
        self.of(value, 1.0 + value * value)
    }
    fn asin(self) -> Self {
        self.of(libm::asin(self.value), 1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        self.of(libm::acos(self.value), 1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn atan(self) -> Self {
        self.of(libm::atan(self.value), 1.0 / (1.0 + self.value * self.value))
    }
    fn atan2(self, x: Self) -> Self {
        let (y, x, value) = (self, x, libm::atan2(self.value, x.value));
        let square = x.value * x.value + y.value * y.value;
        let brought = x.value.abs() * y.error + y.value.abs() * x.error;
        let brought = if brought == 0.0 { 0.0 } else { brought / square };
        Self { value, error: brought + value.abs() }
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
        if self.value == 0.0 && self.error == 0.0 { Self::one() } else { self.of(value, value) }
    }
    fn log(self) -> Self {
        self.of(libm::log(self.value), 1.0 / self.value)
    }
    fn pow(self, exponent: Self) -> Self {
        let value = libm::pow(self.value, exponent.value);
        let by_exponent =
            exponent.error * if exponent.error == 0.0 { 0.0 } else { libm::log(self.value).abs() };
        let own = self.of(value, exponent.value * value / self.value);
        Self { value, error: own.error + value.abs() * by_exponent }
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
}
