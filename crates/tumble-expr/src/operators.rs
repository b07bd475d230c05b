//! Arithmetic between formulas and plain numbers, by value and by reference.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::expr::{Binary, Expr, Unary};

macro_rules! between_formulas {
    ($($trait:ident $method:ident)*) => {$(
        impl $trait<Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr { Expr::binary(Binary::$trait, self, other) }
        }
        impl $trait<&Expr> for Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr { Expr::binary(Binary::$trait, self, other.clone()) }
        }
        impl $trait<Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr { Expr::binary(Binary::$trait, self.clone(), other) }
        }
        impl $trait<&Expr> for &Expr {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr { Expr::binary(Binary::$trait, self.clone(), other.clone()) }
        }
        with_numbers!($trait $method i32);
        with_numbers!($trait $method f64);
    )*};
}

macro_rules! with_numbers {
    ($trait:ident $method:ident $number:ty) => {
        impl $trait<$number> for Expr {
            type Output = Expr;
            fn $method(self, other: $number) -> Expr {
                Expr::binary(Binary::$trait, self, other.into())
            }
        }
        impl $trait<$number> for &Expr {
            type Output = Expr;
            fn $method(self, other: $number) -> Expr {
                Expr::binary(Binary::$trait, self.clone(), other.into())
            }
        }
        impl $trait<Expr> for $number {
            type Output = Expr;
            fn $method(self, other: Expr) -> Expr {
                Expr::binary(Binary::$trait, self.into(), other)
            }
        }
        impl $trait<&Expr> for $number {
            type Output = Expr;
            fn $method(self, other: &Expr) -> Expr {
                Expr::binary(Binary::$trait, self.into(), other.clone())
            }
        }
    };
}

between_formulas! { Add add Sub sub Mul mul Div div }

impl Neg for Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        Expr::unary(Unary::Neg, self)
    }
}

impl Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        Expr::unary(Unary::Neg, self.clone())
    }
}
