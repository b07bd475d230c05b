//! Sums that divide sums: `(a + b)^2 / (a^2 + 4 a b + 3 b^2)` is `(a + b)/(a + 3 b)`.
//!
//! Sums are divided as polynomials in their factors, the leading term first (Cox, Little and O'Shea, Ideals, Varieties,
//! and Algorithms, 2.3, for one divisor). What is left over makes it no divisor.

use std::cmp::Ordering;

use num_traits::{One, Signed, Zero};
use tumble_expr::Exponent;

use super::sum::Terms;
use super::{Algebra, Factor, Form, Id};
use crate::rational::{self, LARGEST_BITS, Rational};

/// Steps beyond which a division is given up.
const MOST_QUOTIENTS: usize = 24;
/// Sums taken out of one product; each makes it shorter.
const MOST_CANCELLED: usize = 8;

impl Algebra {
    /// A quotient without the sums that divide one on the other side of it, where it is shorter so.
    pub(super) fn cancelled(&mut self, mut product: Id) -> Id {
        for _ in 0..MOST_CANCELLED {
            match self.cancelled_once(product) {
                Some(other) if self.cost(other) < self.cost(product) => product = other,
                _ => break,
            }
        }
        product
    }

    fn cancelled_once(&mut self, product: Id) -> Option<Id> {
        let Form::Product(by, factors) = self.form(product).clone() else { return None };
        let is_sum = |(id, _): &&Factor| matches!(self.form(*id), Form::Sum(_));
        let sums: Vec<Factor> = factors.iter().filter(is_sum).copied().collect();
        for whole in sums.iter().filter(|(_, exponent)| exponent.is_integer()) {
            for part in sums.iter().filter(|part| part.1.is_positive() != whole.1.is_positive()) {
                let Some(quotient) = self.divided(whole.0, part.0) else { continue };
                let mut rest: Vec<Factor> =
                    factors.iter().filter(|factor| *factor != whole).copied().collect();
                rest.extend([(part.0, whole.1), (quotient, whole.1)]);
                return Some(self.raw_product(by, &rest));
            }
        }
        None
    }

    /// The quotient of two sums, if it is a sum or product without denominators of its own.
    fn divided(&mut self, whole: Id, part: Id) -> Option<Id> {
        let [whole, part] = [whole, part].map(|id| {
            let terms = self.terms(id);
            self.expanded(&terms)
        });
        let (mut left, part) = (whole?, part?);
        if left.len() < part.len() {
            return None;
        }
        let (lead, by) = self.leading(&part)?;
        let mut quotient = Terms::new();
        // Steps are counted, not terms: where a product is not what its factors say, the same term comes again.
        for _ in 0..=MOST_QUOTIENTS {
            let Some((first, own)) = self.leading(&left) else { return Some(self.raw_sum(quotient)) };
            let one = Exponent::one();
            let term = self.raw_product(Rational::one(), &[(first, one), (lead, -one)]);
            if self.factors(term).iter().any(|(_, exponent)| exponent.is_negative()) {
                return None;
            }
            let ratio = rational::over(&own, &by);
            if rational::bits(&ratio) > LARGEST_BITS {
                return None;
            }
            for (id, number) in &part {
                let product = self.raw_product(-rational::times(number, &ratio), &[(*id, one), (term, one)]);
                self.add_term(&mut left, &Rational::one(), product);
            }
            self.add_term(&mut quotient, &ratio, term);
        }
        None
    }

    /// The term that comes first in an order that products keep: by the exponents of the factors, one after the other.
    fn leading(&self, terms: &Terms) -> Option<(Id, Rational)> {
        let first = terms.iter().max_by(|a, b| self.by_exponents(*a.0, *b.0))?;
        Some((*first.0, first.1.clone()))
    }

    fn by_exponents(&self, a: Id, b: Id) -> Ordering {
        let (a, b) = (self.factors(a), self.factors(b));
        let (mut left, mut right) = (a.iter().peekable(), b.iter().peekable());
        loop {
            let zero = Exponent::zero();
            let compared = match (left.peek(), right.peek()) {
                (None, None) => return Ordering::Equal,
                (Some((_, own)), None) => own.cmp(&zero),
                (None, Some((_, other))) => zero.cmp(other),
                (Some((id, own)), Some((other_id, _))) if id < other_id => own.cmp(&zero),
                (Some((id, _)), Some((other_id, other))) if id > other_id => zero.cmp(other),
                (Some((_, own)), Some((_, other))) => own.cmp(other),
            };
            if compared != Ordering::Equal {
                return compared;
            }
            // Equal exponents of one factor: no factor has the exponent zero.
            left.next();
            right.next();
        }
    }
}
