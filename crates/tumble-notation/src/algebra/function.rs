//! Functions of parts.

use std::cmp::Ordering;

use num_traits::{One, Signed, Zero};
use tumble_expr::{Binary, Exponent, Relation, Unary};

use super::{Algebra, Form, Function, Id};
use crate::rational::{self, Rational};

impl Algebra {
    pub(crate) fn unary(&mut self, op: Unary, a: Id) -> Id {
        match op {
            Unary::Neg => self.negated(a),
            Unary::Sqrt => self.power(a, Exponent::new(1, 2)),
            Unary::Sin => self.sine(a),
            Unary::Cos => self.cosine(a),
            Unary::Abs => self.abs(a),
            Unary::Cosh => {
                let (_, a) = self.positive(a);
                self.plain(op, a)
            }
            Unary::Sign => self.sign(a),
            Unary::Tan | Unary::Asin | Unary::Atan | Unary::Sinh | Unary::Tanh => {
                let (minus, a) = self.positive(a);
                let value = self.plain(op, a);
                if minus { self.negated(value) } else { value }
            }
            Unary::Acos | Unary::Exp | Unary::Log | Unary::Step => self.plain(op, a),
        }
    }

    /// The sign of a product is that of its factors that are not positive anyway.
    fn sign(&mut self, a: Id) -> Id {
        let (minus, a) = self.positive(a);
        let bare = match self.form(a).clone() {
            Form::Product(by, factors) => {
                let factors: Vec<_> = factors.into_iter().filter(|(id, _)| !self.is_positive(*id)).collect();
                self.raw_product(by.signum(), &factors)
            }
            _ => a,
        };
        let value = self.plain(Unary::Sign, bare);
        if minus { self.negated(value) } else { value }
    }

    /// Whether a part is known to be more than zero.
    fn is_positive(&self, id: Id) -> bool {
        match self.form(id) {
            Form::Number(value) => value.is_positive(),
            Form::Pi | Form::Unit(_) => true,
            Form::Symbol(index) => self.symbols[*index].positive && self.symbols[*index].definition.is_none(),
            Form::Call(function, _) => matches!(function, Function::Unary(Unary::Exp | Unary::Cosh)),
            Form::Sum(_) | Form::Product(..) => false,
        }
    }

    pub(crate) fn negated(&mut self, a: Id) -> Id {
        self.scaled(-Rational::one(), a)
    }

    /// A function without a rule for signs.
    fn plain(&mut self, op: Unary, a: Id) -> Id {
        match self.as_number(a).and_then(|value| at_number(op, value)) {
            Some(value) => self.number(value),
            None => self.call(op, a),
        }
    }

    pub(crate) fn binary(&mut self, op: Binary, a: Id, b: Id) -> Id {
        let one = Exponent::one();
        match op {
            Binary::Add => self.sum_of(a, Rational::one(), b),
            Binary::Sub => self.sum_of(a, -Rational::one(), b),
            Binary::Mul => self.product(Rational::one(), &[(a, one), (b, one)]),
            Binary::Div => self.quotient(op, a, one, b),
            Binary::SquareOver => self.quotient(op, a, one + one, b),
            Binary::Pow => self.general_power(a, b),
            Binary::Min | Binary::Max if a == b => a,
            _ => self.intern(Form::Call(Function::Binary(op), vec![a, b])),
        }
    }

    fn sum_of(&mut self, a: Id, by: Rational, b: Id) -> Id {
        let mut terms = self.terms(a);
        self.add_term(&mut terms, &by, b);
        self.sum(terms)
    }

    /// A quotient; one by zero is left as it was written, but the square of zero over anything is zero.
    fn quotient(&mut self, op: Binary, a: Id, exponent: Exponent, b: Id) -> Id {
        if op == Binary::SquareOver && self.is_zero(a) {
            return a;
        }
        if self.is_zero(b) {
            return self.intern(Form::Call(Function::Binary(op), vec![a, b]));
        }
        self.product(Rational::one(), &[(a, exponent), (b, -Exponent::one())])
    }

    fn general_power(&mut self, a: Id, b: Id) -> Id {
        let exponent = self.as_number(b).and_then(rational::exponent);
        match exponent {
            // Zero to a negative power stays as it was written.
            Some(exponent) if !(self.is_zero(a) && exponent.is_negative()) => self.power(a, exponent),
            _ => self.intern(Form::Call(Function::Binary(Binary::Pow), vec![a, b])),
        }
    }

    pub(crate) fn select(&mut self, condition: Id, a: Id, b: Id) -> Id {
        if a == b {
            return a;
        }
        if let Some(holds) = self.truth(condition) {
            return if holds { a } else { b };
        }
        self.intern(Form::Call(Function::Select, vec![condition, a, b]))
    }

    /// Whether a comparison holds, where that is known: between numbers, and of a part with itself.
    fn truth(&self, condition: Id) -> Option<bool> {
        let Form::Call(Function::Compare(relation), parts) = self.form(condition) else { return None };
        let [a, b] = parts[..] else { return None };
        let order = if a == b { Ordering::Equal } else { self.as_number(a)?.cmp(self.as_number(b)?) };
        Some(match relation {
            Relation::Less => order.is_lt(),
            Relation::LessEqual => order.is_le(),
        })
    }
}

/// Values that are exact.
fn at_number(op: Unary, value: &Rational) -> Option<Rational> {
    let (zero, one) = (Rational::zero(), Rational::one());
    match op {
        Unary::Sign => Some(value.signum()),
        Unary::Step => Some(if value.is_negative() { zero } else { one }),
        Unary::Exp | Unary::Cosh if value.is_zero() => Some(one),
        Unary::Log if value.is_one() => Some(zero),
        Unary::Tan | Unary::Asin | Unary::Atan | Unary::Sinh | Unary::Tanh if value.is_zero() => Some(zero),
        _ => None,
    }
}
