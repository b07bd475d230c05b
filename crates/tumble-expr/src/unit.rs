//! Units for Rust users: `9.81 * M / (S * S)` is a formula with its dimension.

use std::ops::{Div, Mul};

use num_rational::BigRational;

use crate::{Dimension, Expr};

/// A coherent SI unit: one of its dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit(pub Dimension);

/// The units that formulas in Rust are written with.
pub mod units {
    use super::Unit;
    use crate::Dimension;

    /// metre
    pub const M: Unit = Unit(Dimension::LENGTH);
    /// kilogram
    pub const KG: Unit = Unit(Dimension::MASS);
    /// second
    pub const S: Unit = Unit(Dimension::TIME);
    /// newton
    pub const N: Unit = Unit(Dimension::FORCE);
    /// joule, and newton metre
    pub const J: Unit = Unit(Dimension::TORQUE);
    /// radian
    pub const RAD: Unit = Unit(Dimension::NONE);
}

impl Unit {
    fn expr(self) -> Expr {
        Expr::quantity(BigRational::from_integer(1.into()), self.0)
    }
}

/// The shortest decimal that reads back as `value`, exactly; `None` unless finite.
pub(crate) fn decimal(value: f64) -> Option<BigRational> {
    if !value.is_finite() {
        return None;
    }
    let text = format!("{value:e}");
    let (digits, exponent) = text.split_once('e')?;
    let exponent: i32 = exponent.parse().ok()?;
    let places = digits.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let mantissa: num_bigint::BigInt = digits.replace('.', "").parse().ok()?;
    let ten = BigRational::from_integer(10.into());
    let shift = exponent - i32::try_from(places).ok()?;
    Some(BigRational::from_integer(mantissa) * ten.pow(shift))
}

macro_rules! scale {
    ($($number:ty),*) => {$(
        impl Mul<Unit> for $number {
            type Output = Expr;
            fn mul(self, unit: Unit) -> Expr {
                match Expr::from(self).as_number() {
                    Some(value) => Expr::quantity(value.clone(), unit.0),
                    None => Expr::from(self) * unit.expr(),
                }
            }
        }
        impl Div<Unit> for $number {
            type Output = Expr;
            fn div(self, unit: Unit) -> Expr {
                Expr::from(self) / unit.expr()
            }
        }
    )*};
}
scale!(i32, f64);

impl Mul<Unit> for Expr {
    type Output = Expr;
    fn mul(self, unit: Unit) -> Expr {
        self * unit.expr()
    }
}

impl Div<Unit> for Expr {
    type Output = Expr;
    fn div(self, unit: Unit) -> Expr {
        self / unit.expr()
    }
}

/// Panics where an exponent overflows, which no chain of units written by hand reaches.
impl Mul for Unit {
    type Output = Unit;
    fn mul(self, other: Unit) -> Unit {
        Unit(self.0.times(other.0).expect("exponents of a written unit fit"))
    }
}

/// Panics where an exponent overflows, which no chain of units written by hand reaches.
impl Div for Unit {
    type Output = Unit;
    fn div(self, other: Unit) -> Unit {
        Unit(self.0.over(other.0).expect("exponents of a written unit fit"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_float_becomes_its_shortest_decimal() {
        let tenth = decimal(0.1).expect("finite");
        assert_eq!(tenth, BigRational::new(1.into(), 10.into()));
        assert_eq!(decimal(2.5e-3).expect("finite"), BigRational::new(1.into(), 400.into()));
        assert_eq!(decimal(f64::INFINITY), None);
    }
}
