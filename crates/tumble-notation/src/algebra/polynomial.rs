//! Parts as polynomials in a leaf.

use std::collections::HashSet;

use num_traits::{One, Signed, Zero};
use tumble_expr::Exponent;

use super::sum::Terms;
use super::{Algebra, Form, Id};
use crate::rational::Rational;

/// The highest degree of polynomials that are looked for: longer ones are not read as formulas.
const HIGHEST_DEGREE: usize = 16;

impl Algebra {
    /// Coefficients of a part as a polynomial in a leaf, from the constant one on; `None` if it is not seen to be one.
    pub(crate) fn coefficients(&mut self, id: Id, leaf: Id) -> Option<Vec<Id>> {
        if id == leaf {
            return Some(vec![self.zero(), self.one()]);
        }
        if !self.depends(id, leaf) {
            return Some(vec![id]);
        }
        let mut all = match self.form(id).clone() {
            Form::Sum(terms) => self.coefficients_of_sum(&terms, leaf)?,
            Form::Product(by, factors) => {
                let number = self.number(by);
                let mut product = vec![number];
                for (part, exponent) in factors {
                    product = self.times_power(&product, (part, exponent), leaf)?;
                }
                product
            }
            _ => return None,
        };
        while all.len() > 1 && all.last().is_some_and(|last| self.is_zero(*last)) {
            all.pop();
        }
        Some(all)
    }

    fn coefficients_of_sum(&mut self, terms: &[(Id, Rational)], leaf: Id) -> Option<Vec<Id>> {
        let mut sums: Vec<Terms> = vec![];
        for (part, by) in terms {
            for (degree, coefficient) in self.coefficients(*part, leaf)?.into_iter().enumerate() {
                sums.resize(sums.len().max(degree + 1), Terms::new());
                self.add_term(&mut sums[degree], by, coefficient);
            }
        }
        Some(sums.into_iter().map(|terms| self.sum(terms)).collect())
    }

    fn times_power(&mut self, product: &[Id], (part, exponent): (Id, Exponent), leaf: Id) -> Option<Vec<Id>> {
        if !self.depends(part, leaf) {
            let power = self.power(part, exponent);
            return Some(product.iter().map(|own| self.multiplied(*own, power)).collect());
        }
        let usable = exponent.is_integer() && exponent.is_positive();
        let degree = usize::try_from(*exponent.numer()).ok().filter(|_| usable)?;
        if degree > HIGHEST_DEGREE {
            return None;
        }
        let base = self.coefficients(part, leaf)?;
        let mut result = product.to_vec();
        for _ in 0..degree {
            result = self.convolved(&result, &base)?;
        }
        Some(result)
    }

    fn convolved(&mut self, a: &[Id], b: &[Id]) -> Option<Vec<Id>> {
        let length = a.len() + b.len() - 1;
        if length > HIGHEST_DEGREE + 1 {
            return None;
        }
        let mut sums = vec![Terms::new(); length];
        for (i, left) in a.iter().enumerate() {
            for (j, right) in b.iter().enumerate() {
                let product = self.multiplied(*left, *right);
                self.add_term(&mut sums[i + j], &Rational::one(), product);
            }
        }
        Some(sums.into_iter().map(|terms| self.sum(terms)).collect())
    }

    /// Whether a leaf is in a part or in a definition that the part uses.
    pub(crate) fn depends(&self, id: Id, leaf: Id) -> bool {
        let (mut seen, mut pending) = (HashSet::new(), vec![id]);
        while let Some(next) = pending.pop() {
            if next == leaf {
                return true;
            }
            if seen.insert(next) {
                pending.extend(self.parts(next));
                if let Form::Symbol(index) = self.form(next)
                    && let Some(definition) = self.symbols[*index].definition
                {
                    pending.push(self.definitions[definition].body);
                }
            }
        }
        false
    }

    /// The exponent with which a leaf stands in a part: how a reader orders terms by their power of the time.
    pub(crate) fn power_of(&self, id: Id, leaf: Id) -> Exponent {
        let own = self.factors(id).into_iter().find(|(part, _)| *part == leaf);
        own.map_or_else(Exponent::zero, |(_, exponent)| exponent)
    }
}
