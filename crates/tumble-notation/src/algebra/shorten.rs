//! Of several equal forms, the one that takes the fewest signs.

use num_traits::{One, Signed};
use tumble_expr::Exponent;

use super::sum::{Terms, content};
use super::{Algebra, Factor, Form, Function, Id};
use crate::rational::{self, Rational, is_unit};

/// Brackets cost their two signs and the reader's going into them.
pub(crate) const BRACKETS: u32 = 3;
/// How much a common factor of some terms has to save before it is taken out: less would hide the terms.
const GROUPING_SAVES: u32 = 3;
/// How much multiplying out has to save: a product says more than as long a sum.
const EXPANDING_SAVES: u32 = 2;
/// Most terms among which common factors are looked for.
const MOST_GROUPED: usize = 24;

impl Algebra {
    /// A product in its shorter form: with its sums, or multiplied out.
    pub(crate) fn product(&mut self, by: Rational, factors: &[Factor]) -> Id {
        let product = self.raw_product(by, factors);
        let product = self.cancelled(product);
        if !matches!(self.form(product), Form::Product(..)) {
            return product;
        }
        let terms = self.terms(product);
        if !self.has_products_of_sums(&terms) {
            return product;
        }
        let mut best = product;
        if let Some(mut expanded) = self.expanded(&terms) {
            self.trigonometric_sums(&mut expanded);
            let sum = self.raw_sum(expanded);
            if self.cost(sum) + EXPANDING_SAVES <= self.cost(best) {
                best = sum;
            }
        }
        let distributed = self.distributed(product);
        self.shorter(best, distributed)
    }

    /// A sum in its shortest form: as it is, multiplied out, with common factors before brackets.
    pub(crate) fn sum(&mut self, terms: Terms) -> Id {
        let mut plain = terms;
        let expanded = if self.has_products_of_sums(&plain) { self.expanded(&plain) } else { None };
        self.trigonometric_sums(&mut plain);
        let mut best = self.with_factors_out(plain);
        if let Some(mut expanded) = expanded {
            self.trigonometric_sums(&mut expanded);
            let other = self.with_factors_out(expanded);
            best = self.shorter(best, other);
        }
        best
    }

    /// The one that takes fewer signs; the first if neither does.
    fn shorter(&self, first: Id, second: Id) -> Id {
        if self.cost(second) < self.cost(first) { second } else { first }
    }

    /// A product with one plain sum: each term times all other factors.
    fn distributed(&mut self, product: Id) -> Id {
        let Form::Product(by, factors) = self.form(product).clone() else { return product };
        let is_sum = |(id, exponent): &Factor| exponent.is_one() && matches!(self.form(*id), Form::Sum(_));
        let Some(place) = factors.iter().position(is_sum) else { return product };
        let mut rest = factors.clone();
        let (sum, _) = rest.remove(place);
        let mut all = Terms::new();
        for (part, own) in self.terms(sum) {
            let mut factors = rest.clone();
            factors.push((part, Exponent::one()));
            let term = self.raw_product(rational::times(&own, &by), &factors);
            self.add_term(&mut all, &Rational::one(), term);
        }
        self.raw_sum(all)
    }

    /// The sum of the terms, with what all or some of them share before brackets where that is shorter.
    fn with_factors_out(&mut self, terms: Terms) -> Id {
        let plain = self.raw_sum(terms);
        let mut best = self.shorter_factored(plain);
        for _ in 0..MOST_GROUPED {
            let Some(grouped) = self.grouped(best) else { break };
            best = grouped;
        }
        best
    }

    /// The sum or what its terms share before brackets, whichever is shorter.
    fn shorter_factored(&mut self, sum: Id) -> Id {
        let Form::Sum(terms) = self.form(sum).clone() else { return sum };
        let of_all = self.factors_of_all(&terms);
        let outside = self.taken_out(&terms, &of_all);
        let (number, shared, primitive) = self.primitive(sum);
        let mut factors = shared;
        factors.push((primitive, Exponent::one()));
        let quotient = self.raw_product(number, &factors);
        let best = self.shorter(sum, outside);
        self.shorter(best, quotient)
    }

    /// These factors and the common number, times what is left of the terms.
    fn taken_out(&mut self, terms: &[(Id, Rational)], shared: &[Factor]) -> Id {
        let number = content(terms);
        let inverse: Vec<Factor> = shared.iter().map(|(id, exponent)| (*id, -*exponent)).collect();
        let mut rest = Terms::new();
        for (part, by) in terms {
            let mut factors = inverse.clone();
            factors.push((*part, Exponent::one()));
            let term = self.raw_product(rational::over(by, &number), &factors);
            let (own, part) = self.split(term);
            // A multiple of a sum is its terms, which may cancel others.
            self.add_term(&mut rest, &own, part);
        }
        self.trigonometric_sums(&mut rest);
        let sum = self.raw_sum(rest);
        let mut factors = shared.to_vec();
        factors.push((sum, Exponent::one()));
        self.raw_product(number, &factors)
    }

    /// Some terms of a sum with the factor they share taken out, where that saves enough.
    fn grouped(&mut self, sum: Id) -> Option<Id> {
        let Form::Sum(terms) = self.form(sum).clone() else { return None };
        if terms.len() < 3 || terms.len() > MOST_GROUPED {
            return None;
        }
        let mut candidates: Vec<Id> =
            terms.iter().flat_map(|(id, _)| self.factors(*id)).map(|(id, _)| id).collect();
        candidates.sort();
        candidates.dedup();
        let all: Vec<Id> = candidates.into_iter().filter_map(|factor| self.group(&terms, factor)).collect();
        let best = all.into_iter().min_by_key(|id| self.cost(*id))?;
        (self.cost(best) + GROUPING_SAVES <= self.cost(sum)).then_some(best)
    }

    /// The sum with all terms that have this factor put together.
    fn group(&mut self, terms: &[(Id, Rational)], factor: Id) -> Option<Id> {
        let has = |(id, _): &&(Id, Rational)| self.factors(*id).iter().any(|(own, _)| *own == factor);
        let (inside, outside): (Vec<_>, Vec<_>) = terms.iter().partition(has);
        if inside.len() < 2 || outside.is_empty() {
            return None;
        }
        let inside: Vec<(Id, Rational)> = inside.into_iter().cloned().collect();
        let shared = self.factors_of_all(&inside);
        let group = self.taken_out(&inside, &shared);
        let mut all: Terms = outside.into_iter().cloned().collect();
        // Added as one term: its brackets are what was wanted.
        let (by, part) = self.split(group);
        self.add_term(&mut all, &by, part);
        Some(self.raw_sum(all))
    }

    pub(super) fn cost_of(&self, form: &Form) -> u32 {
        match form {
            Form::Number(value) => number_cost(value),
            Form::Unit(_) => 1,
            Form::Pi | Form::Symbol(_) => 1,
            Form::Sum(terms) => {
                let cost = |(id, by): &(Id, Rational)| 1 + self.term_cost(*id, by);
                let signs: u32 = terms.iter().map(cost).fold(0, u32::saturating_add);
                let all_negative = terms.iter().all(|(_, by)| by.is_negative());
                if all_negative { signs } else { signs - 1 }
            }
            Form::Product(by, factors) => {
                let product = self.product_cost(by, factors);
                if by.is_negative() { product.saturating_add(1) } else { product }
            }
            Form::Call(function, parts) => self.call_cost(function, parts),
        }
    }

    fn term_cost(&self, id: Id, by: &Rational) -> u32 {
        match self.form(id) {
            Form::Product(_, factors) => self.product_cost(by, factors),
            Form::Number(_) => number_cost(by),
            _ => self.product_cost(by, &[(id, Exponent::one())]),
        }
    }

    /// Without its sign.
    fn product_cost(&self, by: &Rational, factors: &[Factor]) -> u32 {
        let number = if is_unit(by) { 0 } else { number_cost(by) };
        let below = factors.iter().any(|(_, exponent)| exponent.is_negative()) && by.denom().is_one();
        let bare = self.sums_without_brackets(by, factors) * BRACKETS;
        let factors = factors.iter().map(|factor| self.factor_cost(factor));
        factors.fold(number + u32::from(below), u32::saturating_add).saturating_sub(bare)
    }

    /// How many sums fill a numerator or denominator, whose line does what brackets do.
    fn sums_without_brackets(&self, by: &Rational, factors: &[Factor]) -> u32 {
        let alone = |positive: bool, number: bool| {
            let mut side = factors.iter().filter(|(_, exponent)| exponent.is_positive() == positive);
            let (first, second) = (side.next(), side.next());
            let is_sum = first.is_some_and(|(id, exponent)| {
                exponent.abs().is_one() && matches!(self.form(*id), Form::Sum(_))
            });
            u32::from(is_sum && second.is_none() && number)
        };
        let is_quotient = !by.denom().is_one() || factors.iter().any(|(_, exponent)| exponent.is_negative());
        if !is_quotient {
            return 0;
        }
        alone(true, by.numer().abs().is_one()) + alone(false, by.denom().is_one())
    }

    fn factor_cost(&self, (id, exponent): &Factor) -> u32 {
        let base = self.cost(*id);
        let brackets = match self.form(*id) {
            Form::Sum(_) | Form::Product(..) if exponent.denom().is_one() => BRACKETS,
            _ => 0,
        };
        let power = match (exponent.numer().abs(), *exponent.denom()) {
            (1, 1) => 0,
            (1, 2) | (_, 1) => 1,
            _ => 3,
        };
        base.saturating_add(brackets + power)
    }

    fn call_cost(&self, function: &Function, parts: &[Id]) -> u32 {
        let name = match function {
            Function::Norm => 2 + 2 * u32::try_from(parts.len()).unwrap_or(u32::MAX / 2),
            Function::Select => 4,
            _ => 1,
        };
        let inside = parts.iter().map(|id| self.cost(*id)).fold(0, u32::saturating_add);
        let brackets = if inside > 1 { 1 } else { 0 };
        inside.saturating_add(name + brackets)
    }
}

/// Digits that are read as one sign.
const DIGITS_A_SIGN: u64 = 3;
/// Signs of a number that is cut off where it is printed.
const LONGEST_NUMBER: u64 = 4;

/// Without its sign.
fn number_cost(value: &Rational) -> u32 {
    // A decimal digit takes a little more than three bits.
    let part = |bits: u64| (1 + bits / (4 * DIGITS_A_SIGN)).min(LONGEST_NUMBER);
    let below = if value.denom().is_one() { 0 } else { 1 + part(value.denom().bits()) };
    u32::try_from(part(value.numer().bits()) + below).unwrap_or(u32::MAX / 4)
}
