//! Multiplying out.

use num_traits::One;
use tumble_expr::Exponent;

use super::sum::Terms;
use super::{Algebra, Factor, Form, Id};
use crate::rational::{self, Rational};

/// Terms beyond which nothing is multiplied out.
pub(crate) const MOST_TERMS: usize = 40;
/// The highest power of a sum that is multiplied out.
const HIGHEST_POWER: i32 = 8;

impl Algebra {
    /// Whether a factor is a sum that can be multiplied out.
    fn opens(&self, (id, exponent): &Factor) -> bool {
        let whole = exponent.is_integer() && (1..=HIGHEST_POWER).contains(exponent.numer());
        whole && matches!(self.form(*id), Form::Sum(_))
    }

    /// Whether there is anything to multiply out in these terms.
    pub(crate) fn has_products_of_sums(&self, terms: &Terms) -> bool {
        terms.keys().any(|id| self.factors(*id).iter().any(|factor| self.opens(factor)))
    }

    /// The terms with every product of sums multiplied out, unless they are too many.
    pub(crate) fn expanded(&mut self, terms: &Terms) -> Option<Terms> {
        let mut all = Terms::new();
        let mut pending: Vec<(Id, Rational)> = terms.iter().map(|(id, by)| (*id, by.clone())).collect();
        let mut steps = 0;
        while let Some((id, by)) = pending.pop() {
            steps += 1;
            if steps > 4 * MOST_TERMS || all.len() > MOST_TERMS {
                return None;
            }
            let factors = self.factors(id);
            match factors.iter().position(|factor| self.opens(factor)) {
                None => self.add_term(&mut all, &by, id),
                Some(place) => pending.extend(self.opened(&factors, place, &by)),
            }
        }
        Some(all)
    }

    /// One sum among the factors multiplied out, once.
    fn opened(&mut self, factors: &[Factor], place: usize, by: &Rational) -> Vec<(Id, Rational)> {
        let (sum, exponent) = factors[place];
        let mut rest = factors.to_vec();
        rest[place].1 = exponent - Exponent::one();
        let terms = self.terms(sum);
        let mut opened = vec![];
        for (part, own) in terms {
            rest.push((part, Exponent::one()));
            let term = self.raw_product(rational::times(&own, by), &rest);
            rest.pop();
            let (number, part) = self.split(term);
            opened.push((part, number));
        }
        opened
    }
}
