//! What a formula stands for, and arithmetic between such values.

use thiserror::Error;

use super::error::Code;
use super::syntax::BinaryOperator;
use crate::expr::{Binary, Relation};
use crate::{Dimension, Expr, Kind, TypeError, Vector};

/// A number or a vector.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number with its dimension, or the outcome of a comparison.
    Scalar(Expr),
    /// Two or three components of one dimension.
    Vector(Vector),
}

/// Two values that do not go together.
#[derive(Clone, Debug, PartialEq, Error)]
pub(super) enum ValueError {
    #[error(transparent)]
    Type(#[from] TypeError),
    #[error("this {0} a vector and a number")]
    Mixed(&'static str),
    #[error("the product of two vectors is ambiguous")]
    Product,
    #[error("nothing can be divided by a vector")]
    DivideByVector,
    #[error("vectors have no power")]
    Power,
    #[error("vectors cannot be compared")]
    Compare,
    #[error("this divides by zero")]
    DivisionByZero,
    #[error("{0} takes a number, not a vector")]
    NumberWanted(&'static str),
    #[error("{0} takes a vector, not a number")]
    VectorWanted(&'static str),
    #[error("the components of this vector are {} and {}", .0.describe(), .1.describe())]
    Components(Kind, Kind),
}

impl ValueError {
    pub(super) fn code(&self) -> Code {
        match self {
            Self::Type(error) => Code::from(error),
            Self::DivisionByZero => Code::DivisionByZero,
            Self::Components(..) => Code::Unlike,
            _ => Code::Shape,
        }
    }

    pub(super) fn help(&self) -> Option<&'static str> {
        match self {
            Self::Product => Some("write `dot(a, b)` or `cross(a, b)`"),
            Self::Power => Some("write `dot(a, a)` for the square, `norm(a)^n` for a power of the length"),
            Self::DivideByVector => Some("divide by `norm(a)`"),
            Self::Compare => Some("compare `norm(a)` or components"),
            Self::NumberWanted("abs") => Some("the length of a vector is `norm(a)`"),
            Self::VectorWanted("norm") => Some("the absolute value of a number is `abs(a)`"),
            Self::Type(TypeError::NotPure { function, .. }) if *function != "an exponent" => {
                Some("divide by a quantity of the same dimension, to leave a pure number")
            }
            _ => None,
        }
    }
}

impl From<Expr> for Value {
    fn from(expr: Expr) -> Self {
        Self::Scalar(expr)
    }
}

impl From<Vector> for Value {
    fn from(vector: Vector) -> Self {
        Self::Vector(vector)
    }
}

impl Value {
    /// In words, with an article: "a length (m)".
    pub fn describe(&self) -> String {
        match self {
            Self::Scalar(expr) => kind_of(expr),
            Self::Vector(vector) => {
                let measured = vector.components().iter().find(|part| !part.is_zero());
                let of = measured.map_or_else(|| "zeros".to_owned(), kind_of);
                format!("a vector of {} components, each {of}", vector.components().len())
            }
        }
    }

    /// The vector of these components, which must be numbers of one dimension.
    pub(super) fn of_components(parts: &[Self]) -> Result<Self, ValueError> {
        let numbers = parts.iter().map(|part| part.number("a component").cloned());
        let vector = Vector::new(numbers.collect::<Result<_, _>>()?);
        match vector.norm().kind() {
            Ok(_) => Ok(vector.into()),
            Err(TypeError::Unlike { left, right, .. }) => Err(ValueError::Components(left, right)),
            Err(error) => Err(error.into()),
        }
    }

    /// The value with its sign changed.
    pub(super) fn negated(&self) -> Result<Self, ValueError> {
        self.each(|a| -a).checked()
    }

    pub(super) fn infix(operator: BinaryOperator, a: &Self, b: &Self) -> Result<Self, ValueError> {
        let value = match operator {
            BinaryOperator::Plus => a.together(b, Binary::Add, "adds")?,
            BinaryOperator::Minus => a.together(b, Binary::Sub, "subtracts")?,
            BinaryOperator::Times => a.product(b)?,
            BinaryOperator::Divide => a.quotient(b)?,
            BinaryOperator::Power => Self::numbers(Binary::Pow, a, b)?,
            _ => a.comparison(operator, b)?,
        };
        value.checked()
    }

    /// The number, where it is one.
    pub(super) fn number(&self, function: &'static str) -> Result<&Expr, ValueError> {
        match self {
            Self::Scalar(expr) => Ok(expr),
            Self::Vector(_) => Err(ValueError::NumberWanted(function)),
        }
    }

    /// The vector, where it is one.
    pub(super) fn vector(&self, function: &'static str) -> Result<&Vector, ValueError> {
        match self {
            Self::Vector(vector) => Ok(vector),
            Self::Scalar(_) => Err(ValueError::VectorWanted(function)),
        }
    }

    /// The value itself, unless a formula in it carries a mistake.
    pub(super) fn checked(self) -> Result<Self, ValueError> {
        self.parts().iter().try_for_each(|part| part.kind().map(|_| ()))?;
        Ok(self)
    }

    /// Whether every part may stand where `expected` is asked for.
    pub(super) fn expect(&self, expected: Dimension) -> Result<(), TypeError> {
        self.parts().iter().try_for_each(|part| part.expect(expected).map(|_| ()))
    }

    /// The number alone, or the components.
    pub(super) fn parts(&self) -> &[Expr] {
        match self {
            Self::Scalar(expr) => std::slice::from_ref(expr),
            Self::Vector(vector) => vector.components(),
        }
    }

    /// `f` of both, or of both in every component.
    pub(super) fn zip(
        &self,
        other: &Self,
        verb: &'static str,
        f: impl Fn(&Expr, &Expr) -> Expr,
    ) -> Result<Self, ValueError> {
        match (self, other) {
            (Self::Scalar(a), Self::Scalar(b)) => Ok(f(a, b).into()),
            (Self::Vector(a), Self::Vector(b)) => {
                let (a, b) = (a.components(), b.components());
                alike(verb, a.len(), b.len())?;
                Ok(Vector::new(a.iter().zip(b).map(|(a, b)| f(a, b)).collect()).into())
            }
            _ => Err(ValueError::Mixed(verb)),
        }
    }

    fn together(&self, other: &Self, op: Binary, verb: &'static str) -> Result<Self, ValueError> {
        self.zip(other, verb, |a, b| Expr::binary(op, a.clone(), b.clone()))
    }

    fn each(&self, f: impl Fn(&Expr) -> Expr) -> Self {
        match self {
            Self::Scalar(expr) => f(expr).into(),
            Self::Vector(vector) => vector.map(f).into(),
        }
    }

    fn product(&self, other: &Self) -> Result<Self, ValueError> {
        match (self, other) {
            (Self::Scalar(a), b) => Ok(b.each(|b| a * b)),
            (a, Self::Scalar(b)) => Ok(a.each(|a| a * b)),
            _ => Err(ValueError::Product),
        }
    }

    fn quotient(&self, other: &Self) -> Result<Self, ValueError> {
        match other {
            Self::Scalar(b) if b.is_zero() => Err(ValueError::DivisionByZero),
            Self::Scalar(b) => Ok(self.each(|a| a / b)),
            Self::Vector(_) => Err(ValueError::DivideByVector),
        }
    }

    fn numbers(op: Binary, a: &Self, b: &Self) -> Result<Self, ValueError> {
        match (a, b) {
            (Self::Scalar(a), Self::Scalar(b)) => Ok(Expr::binary(op, a.clone(), b.clone()).into()),
            _ => Err(ValueError::Power),
        }
    }

    fn comparison(&self, operator: BinaryOperator, other: &Self) -> Result<Self, ValueError> {
        let (Self::Scalar(a), Self::Scalar(b)) = (self, other) else { return Err(ValueError::Compare) };
        let (a, b) = (a.clone(), b.clone());
        Ok(match operator {
            BinaryOperator::Less => Expr::compare(Relation::Less, a, b),
            BinaryOperator::LessEqual => Expr::compare(Relation::LessEqual, a, b),
            BinaryOperator::Greater => Expr::compare(Relation::Less, b, a),
            _ => Expr::compare(Relation::LessEqual, b, a),
        }
        .into())
    }
}

/// A mistake unless two vectors have one length.
pub(super) fn alike(verb: &'static str, left: usize, right: usize) -> Result<(), TypeError> {
    if left == right { Ok(()) } else { Err(TypeError::Lengths { verb, left, right }) }
}

fn kind_of(expr: &Expr) -> String {
    expr.kind().map_or_else(|_| "a formula with a mistake".to_owned(), |kind| kind.describe())
}
