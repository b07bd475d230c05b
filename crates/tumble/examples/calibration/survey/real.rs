//! Real numbers to some seventy digits, for truths that are good far below the last bit of a double.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::str::FromStr;
use std::sync::OnceLock;

use dashu_float::round::mode::HalfEven;
use dashu_float::{DBig, FBig};

/// Bits of every number: a hundred and fifty digits, of which cancellation and growth may take a hundred and twenty: what decays
/// for long is a difference of what does not.
const PRECISION: usize = 512;
/// Digits to which a decimal number is read; those written in scenes have a dozen at most.
const DIGITS: usize = 80;

type Float = FBig<HalfEven, 2>;

/// A real number.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Real(Float);

impl Real {
    /// The number that a decimal text such as `-1.25e-3` means, to all digits.
    pub(crate) fn read(text: &str) -> Self {
        let decimal = DBig::from_str(text).unwrap_or_else(|error| panic!("`{text}`: {error}"));
        let decimal = decimal.with_precision(DIGITS).value();
        Self(decimal.with_base_and_precision::<2>(PRECISION).value().with_rounding())
    }

    /// The very number that a double is.
    pub(crate) fn of(value: f64) -> Self {
        let exact = Float::try_from(value).unwrap_or_else(|error| panic!("{value}: {error}"));
        Self(exact.with_precision(PRECISION).value())
    }

    /// The nearest double.
    pub(crate) fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub(crate) fn zero() -> Self {
        Self::from(0)
    }

    pub(crate) fn pi() -> Self {
        static PI: OnceLock<Real> = OnceLock::new();
        PI.get_or_init(|| Self(Float::pi(PRECISION))).clone()
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.sign() == 0
    }

    /// -1, 0 or 1.
    pub(crate) fn sign(&self) -> i64 {
        match self.partial_cmp(&Self::zero()) {
            Some(Ordering::Less) => -1,
            Some(Ordering::Greater) => 1,
            _ => 0,
        }
    }

    pub(crate) fn abs(&self) -> Self {
        if self.sign() < 0 { -self } else { self.clone() }
    }

    pub(crate) fn squared(&self) -> Self {
        self * self
    }

    /// A power with a whole exponent.
    pub(crate) fn power(&self, exponent: i64) -> Self {
        let whole = (0..exponent.abs()).fold(Self::from(1), |product, _| product * self);
        if exponent < 0 { 1 / whole } else { whole }
    }

    /// A power of a positive number, by the parts of its exponent.
    pub(crate) fn power_of(&self, [above, below]: [i64; 2]) -> Self {
        (self.ln() * above / below).exp()
    }

    pub(crate) fn sqrt(&self) -> Self {
        Self(self.0.sqrt())
    }

    /// Arc sine; what rounding has put beyond one is one.
    pub(crate) fn asin(&self) -> Self {
        let one = Self::from(1);
        if self.abs() >= one { Self::pi() * self.sign() / 2 } else { Self(self.0.asin()) }
    }

    /// The angle of the point (x, self), from -pi to pi.
    pub(crate) fn atan2(&self, x: &Self) -> Self {
        Self(self.0.atan2(&x.0))
    }

    /// The nearest whole number.
    pub(crate) fn round(&self) -> Self {
        Self(self.0.round().with_precision(PRECISION).value())
    }
}

/// Functions with the name that they have of the library's numbers.
macro_rules! functions {
    ($($name:ident)*) => {
        impl Real {
            $(pub(crate) fn $name(&self) -> Self {
                Self(self.0.$name())
            })*
        }
    };
}

functions! { exp ln sin cos tan atan sinh cosh tanh asinh atanh }

impl From<i64> for Real {
    fn from(value: i64) -> Self {
        Self(Float::from(value).with_precision(PRECISION).value())
    }
}

impl PartialOrd for Real {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

impl Neg for Real {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Neg for &Real {
    type Output = Real;

    fn neg(self) -> Real {
        -self.clone()
    }
}

/// An operator between numbers, references to them and small whole numbers.
macro_rules! operator {
    ($($trait:ident $method:ident;)*) => {
        $(
            impl $trait<&Real> for &Real {
                type Output = Real;
                fn $method(self, other: &Real) -> Real {
                    Real($trait::$method(&self.0, &other.0))
                }
            }
            forwarded! { $trait $method (Real, Real) (Real, &Real) (&Real, Real) }
            forwarded! { $trait $method (i64, Real) (i64, &Real) (Real, i64) (&Real, i64) }
        )*
    };
}

macro_rules! forwarded {
    ($trait:ident $method:ident $(($left:ty, $right:ty))*) => {
        $(impl $trait<$right> for $left {
            type Output = Real;
            fn $method(self, other: $right) -> Real {
                $trait::$method(&Real::from(self), &Real::from(other))
            }
        })*
    };
}

impl From<&Real> for Real {
    fn from(value: &Real) -> Self {
        value.clone()
    }
}

operator! {
    Add add;
    Sub sub;
    Mul mul;
    Div div;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_to_all_digits() {
        let tenth = Real::read("0.1");
        assert!((&tenth * 10 - 1).abs() < Real::read("1e-75"));
        assert_eq!(tenth.to_f64(), 0.1);
        // 0.1 as a double is a little more than a tenth.
        assert_eq!((Real::of(0.1) - tenth).to_f64(), 5.551115123125783e-18);
        assert_eq!(Real::read("-2.5e3").to_f64(), -2500.0);
    }

    #[test]
    fn functions_know_each_other() {
        let x = Real::read("0.7");
        let small = Real::read("1e-74");
        assert!((x.sin().squared() + x.cos().squared() - 1).abs() < small);
        assert!((x.exp().ln() - &x).abs() < small);
        assert!((x.sin().asin() - &x).abs() < small);
        assert!((x.tanh() - x.sinh() / x.cosh()).abs() < small);
        assert!((Real::from(-1).atan2(&Real::from(-1)) + Real::pi() * 3 / 4).abs() < small);
        assert_eq!(Real::read("-2.6").round().to_f64(), -3.0);
    }
}
