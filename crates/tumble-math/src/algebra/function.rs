//! Functions of parts.

use num_traits::{One, Signed, Zero};
use tumble_expr::{Binary, Exponent, Relation, TableRef, Unary};

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
            Unary::Tan | Unary::Asin | Unary::Atan | Unary::Sinh | Unary::Tanh | Unary::Sign => {
                let (minus, a) = self.positive(a);
                let value = self.plain(op, a);
                if minus { self.negated(value) } else { value }
            }
            Unary::Acos | Unary::Exp | Unary::Log | Unary::Step => self.plain(op, a),
        }
    }

    pub(crate) fn negated(&mut self, a: Id) -> Id {
        self.scaled(-Rational::one(), a)
    }

    /// A function without a rule for signs.
    fn plain(&mut self, op: Unary, a: Id) -> Id {
        match self.as_number(a).and_then(|value| at_number(op, value)) {
            Some(value) => self.number(value),
            None => self.intern(Form::Call(Function::Unary(op), vec![a])),
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

    pub(crate) fn compare(&mut self, relation: Relation, a: Id, b: Id) -> Id {
        self.intern(Form::Call(Function::Compare(relation), vec![a, b]))
    }

    pub(crate) fn select(&mut self, condition: Id, a: Id, b: Id) -> Id {
        if a == b {
            return a;
        }
        self.intern(Form::Call(Function::Select, vec![condition, a, b]))
    }

    pub(crate) fn table(&mut self, table: &TableRef, a: Id) -> Id {
        self.intern(Form::Call(Function::Table(table.clone()), vec![a]))
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
