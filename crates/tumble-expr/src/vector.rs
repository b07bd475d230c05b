//! Vectors of formulas: two components in the plane, three in space.

use std::ops::{Add, Index, Mul, Neg, Sub};

use crate::{Expr, TypeError};

/// A vector of formulas; its components are in the order x, y, z.
#[derive(Clone, Debug)]
pub struct Vector(Vec<Expr>);

impl Vector {
    /// A vector of these components.
    pub fn new(components: Vec<Expr>) -> Self {
        Self(components)
    }

    /// A vector in the plane.
    pub fn planar(x: Expr, y: Expr) -> Self {
        Self(vec![x, y])
    }

    /// Components in order.
    pub fn components(&self) -> &[Expr] {
        &self.0
    }

    /// First component.
    pub fn x(&self) -> &Expr {
        &self.0[0]
    }

    /// Second component.
    pub fn y(&self) -> &Expr {
        &self.0[1]
    }

    /// Scalar product.
    pub fn dot(&self, other: &Self) -> Result<Expr, TypeError> {
        self.alike("multiplies", other)?;
        let products = self.0.iter().zip(&other.0).map(|(a, b)| a * b);
        Ok(products.reduce(|sum, product| sum + product).unwrap_or_else(Expr::zero))
    }

    /// Vector product in the plane: the component out of it, counter-clockwise positive.
    pub fn cross_planar(&self, other: &Self) -> Expr {
        self.x() * other.y() - self.y() * other.x()
    }

    /// Vector product in space.
    pub fn cross(&self, other: &Self) -> Result<Self, TypeError> {
        self.alike("multiplies", other)?;
        let (a, b) = (&self.0, &other.0);
        let component = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
        Ok(Self(vec![component(1, 2), component(2, 0), component(0, 1)]))
    }

    /// Euclidean length.
    pub fn norm(&self) -> Expr {
        Expr::norm(self.0.clone())
    }

    /// Each component through `f`.
    pub fn map(&self, f: impl FnMut(&Expr) -> Expr) -> Self {
        Self(self.0.iter().map(f).collect())
    }

    /// Turned counter-clockwise by a right angle, in the plane.
    pub fn perpendicular(&self) -> Self {
        Self::planar(-self.y(), self.x().clone())
    }

    fn alike(&self, verb: &'static str, other: &Self) -> Result<(), TypeError> {
        let (left, right) = (self.0.len(), other.0.len());
        if left == right { Ok(()) } else { Err(TypeError::Lengths { verb, left, right }) }
    }

    fn zip(&self, other: &Self, f: impl Fn(&Expr, &Expr) -> Expr) -> Self {
        assert_eq!(self.0.len(), other.0.len(), "vectors of one length");
        Self(self.0.iter().zip(&other.0).map(|(a, b)| f(a, b)).collect())
    }
}

impl Index<usize> for Vector {
    type Output = Expr;
    fn index(&self, component: usize) -> &Expr {
        &self.0[component]
    }
}

/// Panics where the lengths differ.
impl Add for &Vector {
    type Output = Vector;
    fn add(self, other: &Vector) -> Vector {
        self.zip(other, |a, b| a + b)
    }
}

/// Panics where the lengths differ.
impl Sub for &Vector {
    type Output = Vector;
    fn sub(self, other: &Vector) -> Vector {
        self.zip(other, |a, b| a - b)
    }
}

impl Neg for &Vector {
    type Output = Vector;
    fn neg(self) -> Vector {
        self.map(|a| -a)
    }
}

impl Mul<&Vector> for &Expr {
    type Output = Vector;
    fn mul(self, vector: &Vector) -> Vector {
        vector.map(|a| self * a)
    }
}
macro_rules! by_value {
    ($($trait:ident $method:ident)*) => {$(
        impl $trait for Vector {
            type Output = Vector;
            fn $method(self, other: Vector) -> Vector { (&self).$method(&other) }
        }
        impl $trait<&Vector> for Vector {
            type Output = Vector;
            fn $method(self, other: &Vector) -> Vector { (&self).$method(other) }
        }
        impl $trait<Vector> for &Vector {
            type Output = Vector;
            fn $method(self, other: Vector) -> Vector { self.$method(&other) }
        }
    )*};
}
by_value! { Add add Sub sub }

impl Mul<Vector> for Expr {
    type Output = Vector;
    fn mul(self, vector: Vector) -> Vector {
        &self * &vector
    }
}

impl Mul<&Vector> for Expr {
    type Output = Vector;
    fn mul(self, vector: &Vector) -> Vector {
        &self * vector
    }
}

impl Mul<Vector> for &Expr {
    type Output = Vector;
    fn mul(self, vector: Vector) -> Vector {
        self * &vector
    }
}
