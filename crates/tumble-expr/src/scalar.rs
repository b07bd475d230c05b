//! Numbers a tape can run on: one `f64`, or several side by side.
//!
//! Elementary functions come from one pinned pure-Rust kernel, lane by lane, so a result has the same bits on every
//! width, thread count and processor. Nothing here may call the standard library's transcendental functions: they
//! are the platform's. (Square roots are exact by IEEE 754 and may.)

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_rational::BigRational;
use num_traits::ToPrimitive;

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
    /// The same number in every lane.
    fn splat(value: f64) -> Self;
    /// Applies a function of one number.
    fn map(self, f: impl Fn(f64) -> f64) -> Self;
    /// Applies a function of two numbers.
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;
    /// `positive` where `self >= 0`, else `negative`: the rule of every branch.
    fn choose(self, positive: Self, negative: Self) -> Self;

    /// How many numbers this is.
    const LANES: usize;
    /// The number in one lane.
    fn lane(self, lane: usize) -> f64;
    /// A number for each lane.
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self;

    /// The nearest number to an exact one.
    fn exact(value: &BigRational) -> Self {
        Self::splat(nearest(value))
    }
    /// pi
    fn pi() -> Self {
        Self::splat(std::f64::consts::PI)
    }
    /// 0
    fn zero() -> Self {
        Self::splat(0.0)
    }
    /// 1
    fn one() -> Self {
        Self::splat(1.0)
    }
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }
    /// Sine.
    fn sin(self) -> Self {
        self.map(libm::sin)
    }
    /// Cosine.
    fn cos(self) -> Self {
        self.map(libm::cos)
    }
    /// Tangent.
    fn tan(self) -> Self {
        self.map(libm::tan)
    }
    /// Inverse sine.
    fn asin(self) -> Self {
        self.map(libm::asin)
    }
    /// Inverse cosine.
    fn acos(self) -> Self {
        self.map(libm::acos)
    }
    /// Inverse tangent.
    fn atan(self) -> Self {
        self.map(libm::atan)
    }
    /// Angle of the point (x, `self`).
    fn atan2(self, x: Self) -> Self {
        self.zip(x, libm::atan2)
    }
    /// Hyperbolic sine.
    fn sinh(self) -> Self {
        self.map(libm::sinh)
    }
    /// Hyperbolic cosine.
    fn cosh(self) -> Self {
        self.map(libm::cosh)
    }
    /// Hyperbolic tangent.
    fn tanh(self) -> Self {
        self.map(libm::tanh)
    }
    /// Exponential.
    fn exp(self) -> Self {
        self.map(libm::exp)
    }
    /// Natural logarithm.
    fn log(self) -> Self {
        self.map(libm::log)
    }
    /// Power with a real exponent.
    fn pow(self, exponent: Self) -> Self {
        self.zip(exponent, libm::pow)
    }
}

/// The nearest `f64`; beyond its range, infinite.
pub fn nearest(value: &BigRational) -> f64 {
    value.to_f64().unwrap_or(f64::NAN)
}

impl Scalar for f64 {
    const LANES: usize = 1;
    fn lane(self, _: usize) -> f64 {
        self
    }
    fn from_lanes(mut f: impl FnMut(usize) -> f64) -> Self {
        f(0)
    }
    fn splat(value: f64) -> Self {
        value
    }
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }
    fn choose(self, positive: Self, negative: Self) -> Self {
        if self >= 0.0 { positive } else { negative }
    }
}

/// Numbers side by side: one operation on all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const N: usize>(pub [f64; N]);

macro_rules! lanewise {
    ($($trait:ident $method:ident)*) => {$(
        impl<const N: usize> $trait for Lanes<N> {
            type Output = Self;
            #[inline]
            fn $method(self, other: Self) -> Self {
                Self(std::array::from_fn(|lane| self.0[lane].$method(other.0[lane])))
            }
        }
    )*};
}
lanewise! { Add add Sub sub Mul mul Div div }

impl<const N: usize> Neg for Lanes<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|value| -value))
    }
}

impl<const N: usize> Scalar for Lanes<N> {
    const LANES: usize = N;
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(f))
    }
    fn splat(value: f64) -> Self {
        Self([value; N])
    }
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }
    fn choose(self, positive: Self, negative: Self) -> Self {
        Self(std::array::from_fn(|lane| self.0[lane].choose(positive.0[lane], negative.0[lane])))
    }
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
