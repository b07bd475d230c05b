//! A normal form for display: sums and products over exact numbers, each part once.
//!
//! Everything here is an identity that holds wherever the formula has a value. Nothing of it is integrated.

mod abs;
mod cancel;
mod definitions;
mod expand;
mod export;
mod function;
mod import;
mod polynomial;
mod product;
mod shorten;
mod sum;
mod trigonometry;

use std::collections::HashMap;
use std::hash::{Hash, Hasher};
use std::mem;

use num_traits::{One, Signed, Zero};
use tumble_expr::{Binary, Dimension, Exponent, Expr, Relation, TableRef, Unary};

use crate::MathError;
use crate::rational::{self, Rational};

pub(crate) use definitions::Definition;
pub(crate) use import::Imported;

/// A part of a formula in an [`Algebra`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Id(u32);

/// A base unit: what a written quantity such as `9.81 m/s^2` holds beside its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Base {
    Metre,
    Kilogram,
    Second,
}

/// What is neither a sum nor a product nor a power by a number.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Function {
    Unary(Unary),
    Binary(Binary),
    Compare(Relation),
    Select,
    Norm,
    Table(TableRef),
    /// Entries of a matrix, row by row, and right sides; stands only within an import.
    System,
    /// One unknown of the system whose entries are the arguments.
    Unknown(u32),
}

/// A factor of a product: a part and its exponent.
pub(crate) type Factor = (Id, Exponent);

/// One kind of part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Number(Rational),
    Pi,
    Unit(Base),
    /// Index into [`Algebra::symbols`].
    Symbol(usize),
    /// Parts without a number in front, each times a number; at least two, in the order of their ids.
    Sum(Vec<(Id, Rational)>),
    /// A number, and parts raised to powers, in the order of their ids.
    Product(Rational, Vec<Factor>),
    Call(Function, Vec<Id>),
}

/// A leaf.
#[derive(Clone, Debug)]
pub(crate) struct Leaf {
    pub(crate) name: String,
    pub(crate) dimension: Dimension,
    pub(crate) positive: bool,
    /// Index of the definition it stands for.
    pub(crate) definition: Option<usize>,
}

/// By numerators and denominators, which have no common divisor here: the hash of a ratio itself divides them out once more,
/// which takes longer than all else that is done with a form.
impl Form {
    fn parts(&self) -> Vec<Id> {
        match self {
            Self::Sum(terms) => terms.iter().map(|(part, _)| *part).collect(),
            Self::Product(_, factors) => factors.iter().map(|(part, _)| *part).collect(),
            Self::Call(_, parts) => parts.clone(),
            Self::Number(_) | Self::Pi | Self::Unit(_) | Self::Symbol(_) => vec![],
        }
    }
}

impl Hash for Form {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let number = |by: &Rational, state: &mut H| (by.numer(), by.denom()).hash(state);
        mem::discriminant(self).hash(state);
        match self {
            Self::Number(by) => number(by, state),
            Self::Pi => {}
            Self::Unit(base) => base.hash(state),
            Self::Symbol(index) => index.hash(state),
            Self::Sum(terms) => terms.iter().for_each(|(id, by)| {
                id.hash(state);
                number(by, state);
            }),
            Self::Product(by, factors) => {
                number(by, state);
                factors.hash(state);
            }
            Self::Call(function, parts) => (function, parts).hash(state),
        }
    }
}

/// What is known of a part without looking into it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts {
    /// About how many signs it takes to print.
    pub(crate) cost: u32,
    /// Levels of functions and brackets.
    pub(crate) depth: u32,
    /// Its value is never negative.
    pub(crate) never_negative: bool,
}

/// Formulas in normal form, equal parts once.
#[derive(Debug, Default)]
pub(crate) struct Algebra {
    forms: Vec<Form>,
    facts: Vec<Facts>,
    known: HashMap<Form, Id>,
    pub(crate) symbols: Vec<Leaf>,
    pub(crate) definitions: Vec<Definition>,
    /// Which definition a part is, up to a number: for a sum without common factor, any number; else a sign.
    named: HashMap<Id, (Id, Rational)>,
    /// The first reason why the result is of no use.
    refused: Option<MathError>,
    exported: HashMap<Id, Expr>,
}

impl Algebra {
    pub(crate) fn form(&self, id: Id) -> &Form {
        &self.forms[id.0 as usize]
    }

    pub(crate) fn facts(&self, id: Id) -> Facts {
        self.facts[id.0 as usize]
    }

    pub(crate) fn cost(&self, id: Id) -> u32 {
        self.facts(id).cost
    }

    /// The first reason why nothing made so far is of use.
    pub(crate) fn check(&self) -> Result<(), MathError> {
        self.refused.clone().map_or(Ok(()), Err)
    }

    /// Notes that a number outgrew its bounds; what is returned only keeps the work going.
    fn refuse_long(&mut self) -> Id {
        self.refused.get_or_insert(MathError::TooLong { bits: rational::LARGEST_BITS });
        self.one()
    }

    pub(crate) fn number(&mut self, value: Rational) -> Id {
        if rational::bits(&value) > rational::LARGEST_BITS {
            return self.refuse_long();
        }
        self.intern(Form::Number(value))
    }

    pub(crate) fn one(&mut self) -> Id {
        self.intern(Form::Number(Rational::one()))
    }

    pub(crate) fn zero(&mut self) -> Id {
        self.intern(Form::Number(Rational::zero()))
    }

    pub(crate) fn as_number(&self, id: Id) -> Option<&Rational> {
        match self.form(id) {
            Form::Number(value) => Some(value),
            _ => None,
        }
    }

    pub(crate) fn is_zero(&self, id: Id) -> bool {
        self.as_number(id).is_some_and(Zero::is_zero)
    }

    /// A product of two parts.
    pub(crate) fn multiplied(&mut self, a: Id, b: Id) -> Id {
        self.product(Rational::one(), &[(a, Exponent::one()), (b, Exponent::one())])
    }

    /// The leaf of that name.
    pub(crate) fn leaf(&mut self, leaf: Leaf) -> Id {
        let index = self.symbols.iter().position(|known| known.name == leaf.name);
        let index = index.unwrap_or_else(|| {
            self.symbols.push(leaf);
            self.symbols.len() - 1
        });
        self.intern(Form::Symbol(index))
    }

    fn intern(&mut self, form: Form) -> Id {
        if let Some(id) = self.known.get(&form) {
            return *id;
        }
        let id = Id(u32::try_from(self.forms.len()).expect("the budget of parts is far below 2^32"));
        self.facts.push(self.facts_of(&form));
        self.forms.push(form.clone());
        self.known.insert(form, id);
        id
    }

    /// The parts that a form is made of.
    pub(crate) fn parts(&self, id: Id) -> Vec<Id> {
        self.form(id).parts()
    }

    fn facts_of(&self, form: &Form) -> Facts {
        Facts {
            cost: self.cost_of(form),
            depth: self.depth_of(form),
            never_negative: self.never_negative_of(form),
        }
    }

    fn depth_of(&self, form: &Form) -> u32 {
        form.parts().into_iter().map(|id| self.facts(id).depth + 1).max().unwrap_or(0)
    }

    fn never_negative_of(&self, form: &Form) -> bool {
        match form {
            Form::Number(value) => !value.is_negative(),
            Form::Pi | Form::Unit(_) => true,
            Form::Symbol(index) => self.symbols[*index].positive,
            Form::Sum(terms) => {
                terms.iter().all(|(id, by)| by.is_positive() && self.facts(*id).never_negative)
            }
            Form::Product(by, factors) => {
                by.is_positive() && factors.iter().all(|factor| self.power_never_negative(factor))
            }
            Form::Call(function, _) => matches!(
                function,
                Function::Norm | Function::Unary(Unary::Abs | Unary::Exp | Unary::Cosh | Unary::Step)
            ),
        }
    }

    fn power_never_negative(&self, (id, exponent): &Factor) -> bool {
        rational::is_even(exponent) || !exponent.is_integer() || self.facts(*id).never_negative
    }
}
