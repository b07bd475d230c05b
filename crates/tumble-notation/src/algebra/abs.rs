//! Absolute values and lengths.

use num_traits::{One, Signed};
use tumble_expr::{Exponent, Unary};

use super::sum::Terms;
use super::{Algebra, Factor, Form, Function, Id};
use crate::rational::{self, Rational};

impl Algebra {
    /// `|id|`: of a product, the product of the absolute values; what cannot be negative is its own.
    pub(crate) fn abs(&mut self, id: Id) -> Id {
        if self.facts(id).never_negative {
            return id;
        }
        match self.form(id).clone() {
            Form::Number(value) => self.number(value.abs()),
            Form::Product(by, factors) => self.abs_of_product(&by, &factors),
            Form::Sum(_) => self.abs_of_sum(id),
            _ => self.call(Unary::Abs, id),
        }
    }

    fn abs_of_product(&mut self, by: &Rational, factors: &[Factor]) -> Id {
        let absolute = self.abs_of_factors(factors);
        self.raw_product(by.abs(), &absolute)
    }

    fn abs_of_sum(&mut self, id: Id) -> Id {
        let (content, shared, primitive) = self.primitive(id);
        let bars = self.call(Unary::Abs, primitive);
        let mut factors = vec![(bars, Exponent::one())];
        factors.extend(self.abs_of_factors(&shared));
        self.product(content.abs(), &factors)
    }

    fn abs_of_factors(&mut self, factors: &[Factor]) -> Vec<Factor> {
        let absolute = |(id, exponent): &Factor| {
            let plain = rational::is_even(exponent) || !exponent.is_integer();
            (if plain { *id } else { self.abs(*id) }, *exponent)
        };
        factors.iter().map(absolute).collect()
    }

    /// Length of a vector: one component's absolute value; what all components share stands before it.
    pub(crate) fn norm(&mut self, components: &[Id]) -> Id {
        let mut components: Vec<Id> = components.iter().copied().filter(|id| !self.is_zero(*id)).collect();
        if let [only] = components[..] {
            return self.abs(only);
        }
        if components.is_empty() {
            return self.zero();
        }
        if let Some(root) = self.short_norm(&components) {
            return root;
        }
        let shared = self.shared_by_components(&mut components);
        let length = self.intern(Form::Call(Function::Norm, components));
        let shared = self.abs(shared);
        self.product(Rational::one(), &[(shared, Exponent::one()), (length, Exponent::one())])
    }

    /// The root of the sum of squares, where that is a single product.
    fn short_norm(&mut self, components: &[Id]) -> Option<Id> {
        let mut squares = Terms::new();
        for component in components {
            let square = self.power(*component, Exponent::from_integer(2));
            self.add_term(&mut squares, &Rational::one(), square);
        }
        let sum = self.sum(squares);
        let single = !matches!(self.form(sum), Form::Sum(_));
        single.then(|| self.power(sum, Exponent::new(1, 2)))
    }

    /// Takes the factors that all components have out of them.
    fn shared_by_components(&mut self, components: &mut [Id]) -> Id {
        let split: Vec<(Rational, Id)> = components.iter().map(|id| self.split_factors(*id)).collect();
        let terms: Vec<(Id, Rational)> = split.into_iter().map(|(by, part)| (part, by)).collect();
        let factors = self.factors_of_all(&terms);
        let divisor = super::sum::content(&terms).abs();
        let shared = self.raw_product(divisor, &factors);
        for component in components {
            *component =
                self.product(Rational::one(), &[(*component, Exponent::one()), (shared, -Exponent::one())]);
        }
        shared
    }

    /// A part as a number times factors, a sum with what its terms share outside.
    fn split_factors(&mut self, id: Id) -> (Rational, Id) {
        let taken = match self.form(id) {
            Form::Sum(_) => {
                let (content, mut factors, primitive) = self.primitive(id);
                factors.push((primitive, Exponent::one()));
                self.raw_product(content, &factors)
            }
            _ => id,
        };
        self.split(taken)
    }
}
