//! Numbers a tape can run on: one `f64`, several side by side, intervals, and numbers with their rounding errors.
//!
//! Elementary functions come from one pinned pure-Rust kernel, lane by lane, so a result has the same bits on every
//! width, thread count and processor. Nothing here may call the standard library's transcendental functions: they
//! are the platform's. (Square roots are exact by IEEE 754 and may.)

mod interval;
mod lanes;
mod rounded;

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::table::Table;

pub use interval::Interval;
pub use lanes::{Lanes, Lanewise};
pub use rounded::{Drawn, Inexact, OneError, Rounded, RoundingError, is_short};

/// What evaluators compute with.
pub trait Scalar:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// That number.
    fn splat(value: f64) -> Self;
    /// A number that stands for an exact one: the nearest to it, or that number itself.
    fn constant(value: f64, is_exact: bool) -> Self;
    /// `positive` where `self >= 0`, else `negative`: the rule of every branch.
    fn choose(self, positive: Self, negative: Self) -> Self;
    /// -1, 0 or 1.
    fn sign(self) -> Self;
    /// The segment of a measured function that holds at this argument.
    fn segment(self, table: &Table) -> Self;
    /// Something of the segment that this is the index of.
    fn of_segment(self, of: impl Fn(usize) -> f64) -> Self;
    /// 0
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// 1
    fn one() -> Self {
        Self::splat(1.0)
    }
    /// The product with itself.
    fn square(self) -> Self {
        self * self
    }
    /// A coefficient of a quotient: nothing is left over what is beyond the range of numbers, or so near to it that its own coefficients
    /// are.
    fn over(self, by: Self) -> Self {
        self / by
    }
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Sine.
    fn sin(self) -> Self;
    /// Cosine.
    fn cos(self) -> Self;
    /// Both, with the same bits.
    fn sine_and_cosine(self) -> (Self, Self) {
        (Self::sin(self), Self::cos(self))
    }
    /// Tangent.
    fn tan(self) -> Self;
    /// Inverse sine.
    fn asin(self) -> Self;
    /// Inverse cosine.
    fn acos(self) -> Self;
    /// Inverse tangent.
    fn atan(self) -> Self;
    /// Angle of the point (x, `self`).
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn log(self) -> Self;
    /// Power with a real exponent.
    fn pow(self, exponent: Self) -> Self;
    /// A coefficient of an order above 0 of a function with this value: nothing is known of it where the function jumps.
    fn smooth(self, coefficient: Self) -> Self {
        coefficient
    }
}

/// The nearest `f64`; beyond its range, infinite.
pub fn nearest(value: &BigRational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn exact_numbers_round_to_the_nearest(value in proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL) {
            let shortest = crate::unit::decimal(value).expect("finite");
            prop_assert_eq!(nearest(&shortest).to_bits(), value.to_bits());
        }
    }
}
