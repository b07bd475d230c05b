//! Formulas as they are written on a board: vectors whole, names before what they stand for, integrals as integrals.
//!
//! A [`Written`] is what is printed and what is computed: [`Written::value`] writes every name out, so that anyone can hold what is
//! shown against what runs.

use std::sync::Arc;

use crate::language::Value;
use crate::{Expr, Substitution, Symbol, Vector};

/// A number or a vector in the plane, as it is written.
#[derive(Clone, Debug)]
pub enum Written {
    /// A number.
    Scalar(Expr),
    /// A vector by its components.
    Vector(Vector),
    /// What has a name.
    Name(Arc<Named>),
    /// A sum of numbers or of vectors; `true` is a minus before the term.
    Sum(Vec<(bool, Written)>),
    /// A product of numbers and at most one vector.
    Product(Vec<Written>),
    /// The length of a vector, or the size of a number.
    Norm(Box<Written>),
    /// The scalar product of two vectors.
    Dot(Box<[Written; 2]>),
    /// The vector product in the plane: of two vectors a number, of a number (which points out of the plane) and a vector a vector.
    Cross(Box<[Written; 2]>),
    /// An integral.
    Integral {
        /// Of what.
        of: Box<Written>,
        /// The variable.
        over: Symbol,
        /// Its limits.
        limits: [Expr; 2],
    },
}

/// A name and what it stands for.
#[derive(Clone, Debug)]
pub struct Named {
    /// The name.
    pub name: String,
    /// The variable that it depends on, to be told where it is explained.
    pub of: Option<Symbol>,
    /// What it stands for.
    pub is: Written,
}

impl Written {
    /// What is explained by its name.
    pub fn named(name: &str, is: Self) -> Self {
        Self::Name(Arc::new(Named { name: name.to_owned(), of: None, is }))
    }

    /// What depends on a variable, and is explained by its name.
    pub fn function(name: &str, of: &Symbol, is: Self) -> Self {
        Self::Name(Arc::new(Named { name: name.to_owned(), of: Some(of.clone()), is }))
    }

    /// `self - other`; the terms of a sum are taken one by one.
    #[must_use]
    pub fn less(self, other: Self) -> Self {
        Self::Sum(self.terms().into_iter().chain(other.terms().into_iter().map(turned)).collect())
    }

    /// `-self`
    #[must_use]
    pub fn negative(self) -> Self {
        Self::Sum(self.terms().into_iter().map(turned).collect())
    }

    fn terms(self) -> Vec<(bool, Self)> {
        match self {
            Self::Sum(terms) => terms,
            only => vec![(false, only)],
        }
    }

    /// `self x other`
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::Cross(Box::new([self, other]))
    }

    /// `self . other`
    #[must_use]
    pub fn dot(self, other: Self) -> Self {
        Self::Dot(Box::new([self, other]))
    }

    /// Its length or size.
    #[must_use]
    pub fn norm(self) -> Self {
        Self::Norm(Box::new(self))
    }

    /// The parts that it is made of, from left to right.
    fn parts(&self) -> Vec<&Self> {
        match self {
            Self::Scalar(_) | Self::Vector(_) | Self::Name(_) => vec![],
            Self::Sum(terms) => terms.iter().map(|(_, term)| term).collect(),
            Self::Product(factors) => factors.iter().collect(),
            Self::Norm(of) | Self::Integral { of, .. } => vec![&**of],
            Self::Dot(both) | Self::Cross(both) => both.iter().collect(),
        }
    }

    /// The names to be explained, in the order of reading, each once, and after what it explains.
    pub fn names(&self) -> Vec<Arc<Named>> {
        let mut found = vec![];
        self.add_names(&mut found);
        let mut explained = 0;
        while let Some(named) = found.get(explained).cloned() {
            named.is.add_names(&mut found);
            explained += 1;
        }
        found
    }

    fn add_names(&self, found: &mut Vec<Arc<Named>>) {
        if let Self::Name(named) = self
            && !found.iter().any(|known| known.name == named.name)
        {
            found.push(named.clone());
        }
        self.parts().into_iter().for_each(|part| part.add_names(found));
    }

    /// With every formula in it through `f`.
    #[must_use]
    pub fn map(&self, f: &dyn Fn(&Expr) -> Expr) -> Self {
        self.through(f, &str::to_owned)
    }

    /// With other names for what has them.
    #[must_use]
    pub fn renamed(&self, name: &dyn Fn(&str) -> String) -> Self {
        self.through(&Expr::clone, name)
    }

    fn through(&self, f: &dyn Fn(&Expr) -> Expr, name: &dyn Fn(&str) -> String) -> Self {
        let through = |part: &Self| part.through(f, name);
        let both = |pair: &[Self; 2]| Box::new(pair.each_ref().map(through));
        match self {
            Self::Scalar(formula) => Self::Scalar(f(formula)),
            Self::Vector(vector) => Self::Vector(vector.map(f)),
            Self::Name(named) => Self::Name(Arc::new(Named {
                name: name(&named.name),
                of: named.of.clone(),
                is: through(&named.is),
            })),
            Self::Sum(terms) => {
                Self::Sum(terms.iter().map(|(minus, term)| (*minus, through(term))).collect())
            }
            Self::Product(factors) => Self::Product(factors.iter().map(through).collect()),
            Self::Norm(of) => Self::Norm(Box::new(through(of))),
            Self::Dot(pair) => Self::Dot(both(pair)),
            Self::Cross(pair) => Self::Cross(both(pair)),
            Self::Integral { of, over, limits } => Self::Integral {
                of: Box::new(through(of)),
                over: over.clone(),
                limits: limits.each_ref().map(f),
            },
        }
    }

    /// What it comes to, every name written out, and integrals summed over that many pieces; `None` where numbers and vectors stand
    /// where they cannot.
    pub fn value(&self, pieces: u32) -> Option<Value> {
        let value = |part: &Self| part.value(pieces);
        match self {
            Self::Scalar(formula) => Some(formula.clone().into()),
            Self::Vector(vector) => Some(Value::Vector(vector.clone())),
            Self::Name(named) => value(&named.is),
            Self::Sum(terms) => {
                let terms = terms.iter().map(|(minus, term)| {
                    let value = value(term)?;
                    if *minus { scaled(&Expr::from(-1.0), value) } else { Some(value) }
                });
                total(terms)
            }
            Self::Product(factors) => {
                factors.iter().try_fold(Value::from(Expr::one()), |all, factor| product(all, value(factor)?))
            }
            Self::Norm(of) => Some(match value(of)? {
                Value::Scalar(number) => number.abs().into(),
                Value::Vector(vector) => vector.norm().into(),
            }),
            Self::Dot(pair) => match (value(&pair[0])?, value(&pair[1])?) {
                (Value::Vector(a), Value::Vector(b)) => a.dot(&b).ok().map(Value::from),
                _ => None,
            },
            Self::Cross(pair) => match (value(&pair[0])?, value(&pair[1])?) {
                (Value::Vector(a), Value::Vector(b)) => Some(a.cross_planar(&b).into()),
                (Value::Scalar(a), Value::Vector(b)) => Some(Value::Vector(a * b.perpendicular())),
                _ => None,
            },
            Self::Integral { of, over, limits } => integral(value(of)?, over, limits, pieces),
        }
    }
}

fn turned((minus, term): (bool, Written)) -> (bool, Written) {
    (!minus, term)
}

fn product(a: Value, b: Value) -> Option<Value> {
    match (a, b) {
        (Value::Scalar(a), b) => scaled(&a, b),
        (a, Value::Scalar(b)) => scaled(&b, a),
        _ => None,
    }
}

fn scaled(by: &Expr, value: Value) -> Option<Value> {
    Some(match value {
        Value::Scalar(number) => (by * number).into(),
        Value::Vector(vector) => Value::Vector(by * vector),
    })
}

fn total(mut terms: impl Iterator<Item = Option<Value>>) -> Option<Value> {
    let first = terms.next()??;
    terms.try_fold(first, |sum, term| match (sum, term?) {
        (Value::Scalar(a), Value::Scalar(b)) => Some((a + b).into()),
        (Value::Vector(a), Value::Vector(b)) => Some(Value::Vector(a + b)),
        _ => None,
    })
}

/// Simpson's rule on each of the pieces.
fn integral(of: Value, over: &Symbol, [from, to]: &[Expr; 2], pieces: u32) -> Option<Value> {
    let (ends, length) = (2 * pieces, to - from);
    let term = |index: u32| {
        let weight = match index {
            _ if index == 0 || index == ends => 1.0,
            _ if index % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let mut here = Substitution::default();
        here.insert(over.clone(), from + &length * (f64::from(index) / f64::from(ends)));
        let value = match &of {
            Value::Scalar(number) => here.apply(number).into(),
            Value::Vector(vector) => Value::Vector(vector.map(|component| here.apply(component))),
        };
        scaled(&(&length * (weight / (6.0 * f64::from(pieces)))), value)
    };
    total((0..=ends).map(term))
}
