//! Scalars that are `f64` lane by lane: one, or several side by side.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use crate::table::Table;

/// Scalars whose lanes are independent numbers.
pub trait Lanewise: Scalar {
    /// How many numbers this is.
    const LANES: usize;
    /// The number in one lane.
    fn lane(self, lane: usize) -> f64;
    /// A number for each lane.
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self;
}

/// Numbers side by side: one operation on all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const N: usize>(pub [f64; N]);

/// Of what is larger than this, coefficients of high order overflow before the value does.
const HUGE: f64 = 1e150;

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

/// Functions of one number, lane by lane.
macro_rules! functions {
    ($($method:ident $function:expr;)*) => {$(
        fn $method(self) -> Self {
            self.lanes($function)
        }
    )*};
}

macro_rules! scalar {
    () => {
        fn constant(value: f64, _: bool) -> Self {
            Self::splat(value)
        }
        fn segment(self, table: &Table) -> Self {
            self.lanes(|x| table.segment(x) as f64)
        }
        fn of_segment(self, of: impl Fn(usize) -> f64) -> Self {
            self.lanes(|segment| of(segment as usize))
        }
        functions! {
            sign |x| if x == 0.0 { 0.0 } else { x.signum() };
            sqrt f64::sqrt;
            sin libm::sin;
            cos libm::cos;
            tan libm::tan;
            asin libm::asin;
            acos libm::acos;
            atan libm::atan;
            sinh libm::sinh;
            cosh libm::cosh;
            tanh libm::tanh;
            exp libm::exp;
            log libm::log;
        }
        fn atan2(self, x: Self) -> Self {
            self.pairs(x, libm::atan2)
        }
        fn pow(self, exponent: Self) -> Self {
            self.pairs(exponent, libm::pow)
        }
        fn over(self, by: Self) -> Self {
            self.pairs(by, |of, by| match by.abs() > HUGE && (by.is_infinite() || !of.is_finite()) {
                true => 0.0,
                false => of / by,
            })
        }
    };
}

/// Applies functions of numbers in every lane.
trait Apply: Sized {
    fn lanes(self, f: impl Fn(f64) -> f64) -> Self;
    fn pairs(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;
}

impl Apply for f64 {
    fn lanes(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    fn pairs(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }
}

impl<const N: usize> Apply for Lanes<N> {
    fn lanes(self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }
    fn pairs(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|lane| f(self.0[lane], other.0[lane])))
    }
}

impl Scalar for f64 {
    scalar!();
    fn splat(value: f64) -> Self {
        value
    }
    fn choose(self, positive: Self, negative: Self) -> Self {
        if self >= 0.0 { positive } else { negative }
    }
    fn sine_and_cosine(self) -> (Self, Self) {
        libm::sincos(self)
    }
}

impl<const N: usize> Scalar for Lanes<N> {
    scalar!();
    fn splat(value: f64) -> Self {
        Self([value; N])
    }
    fn choose(self, positive: Self, negative: Self) -> Self {
        Self(std::array::from_fn(|lane| self.0[lane].choose(positive.0[lane], negative.0[lane])))
    }
}

impl Lanewise for f64 {
    const LANES: usize = 1;
    fn lane(self, _: usize) -> f64 {
        self
    }
    fn from_lanes(mut f: impl FnMut(usize) -> f64) -> Self {
        f(0)
    }
}

impl<const N: usize> Lanewise for Lanes<N> {
    const LANES: usize = N;
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    fn from_lanes(f: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(f))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Around zero, where series are left out, at turns of the quadrant, and far away.
    #[test]
    fn sine_and_cosine_have_the_same_bits_together_and_alone() {
        let near = (0..1100).map(|k| libm::ldexp(1.1, -k));
        let far = (0..20_000).map(|k| 0.017 * f64::from(k)).chain((0..1000).map(|k| libm::ldexp(1.3, k)));
        for x in near.chain(far).chain([0.0, f64::INFINITY, f64::NAN]).flat_map(|x| [x, -x]) {
            let bits = |(sin, cos): (f64, f64)| [sin, cos].map(f64::to_bits);
            assert!(
                bits(x.sine_and_cosine()) == bits((libm::sin(x), libm::cos(x))) || !x.is_finite(),
                "{x:e}"
            );
        }
    }
}
