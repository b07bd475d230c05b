//! Products: equal factors collected, quotients cancelled, powers of powers joined.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::{CheckedAdd, CheckedMul, One, Signed, Zero};
use tumble_expr::{Exponent, Unary};

use super::{Algebra, Factor, Form, Function, Id};
use crate::rational::{self, Rational};

/// A product while it is collected.
struct Collected {
    by: Rational,
    factors: BTreeMap<Id, Exponent>,
    /// An exponent or number went out of range.
    lost: bool,
}

impl Collected {
    fn multiply(&mut self, value: Option<Rational>) {
        match value {
            Some(value) => self.by = rational::times(&self.by, &value),
            None => self.lost = true,
        }
    }

    /// Joins a factor with the equal one that is there; says the exponent it has now.
    fn join(&mut self, id: Id, exponent: Exponent) {
        let before = self.factors.remove(&id).unwrap_or_else(Exponent::zero);
        match before.checked_add(&exponent) {
            Some(sum) if sum.is_zero() => {}
            Some(sum) => {
                self.factors.insert(id, sum);
            }
            None => self.lost = true,
        }
    }
}

impl Algebra {
    /// A number times powers, in normal form, whatever its length.
    pub(crate) fn raw_product(&mut self, by: Rational, factors: &[Factor]) -> Id {
        let mut collected = Collected { by, factors: BTreeMap::new(), lost: false };
        let mut pending: Vec<Factor> = factors.to_vec();
        while !pending.is_empty() {
            while let Some(factor) = pending.pop() {
                self.collect(&mut collected, factor, &mut pending);
            }
            self.reopen(&mut collected, &mut pending);
        }
        if collected.lost || rational::bits(&collected.by) > rational::LARGEST_BITS {
            return self.refuse_long();
        }
        self.made(collected.by, collected.factors.into_iter().collect())
    }

    fn made(&mut self, by: Rational, factors: Vec<Factor>) -> Id {
        if by.is_zero() || factors.is_empty() {
            return self.number(by);
        }
        match factors.as_slice() {
            [(only, exponent)] if by.is_one() && exponent.is_one() => *only,
            _ => self.intern(Form::Product(by, factors)),
        }
    }

    /// Factors whose exponents have become such that they can be taken apart go back to the pending ones.
    fn reopen(&self, collected: &mut Collected, pending: &mut Vec<Factor>) {
        let opens = |(id, exponent): &Factor| match self.form(*id) {
            Form::Number(value) if value.is_negative() => exponent.is_integer(),
            Form::Number(_) => *exponent >= Exponent::one() || exponent.is_negative(),
            Form::Product(..) => exponent.is_integer(),
            Form::Call(Function::Unary(Unary::Abs), _) => rational::is_even(exponent),
            _ => false,
        };
        let all: Vec<Factor> = collected.factors.iter().map(|(id, exponent)| (*id, *exponent)).collect();
        for factor in all.into_iter().filter(opens) {
            collected.factors.remove(&factor.0);
            pending.push(factor);
        }
    }

    fn collect(&mut self, collected: &mut Collected, (id, exponent): Factor, pending: &mut Vec<Factor>) {
        let whole = exponent.is_integer().then(|| *exponent.numer());
        match (self.form(id).clone(), whole) {
            (Form::Number(value), Some(whole)) => collected.multiply(rational::power(&value, whole)),
            (Form::Number(value), None) => self.root_of_number(collected, &value, exponent),
            (Form::Product(by, factors), Some(whole)) => {
                collected.multiply(rational::power(&by, whole));
                for (part, own) in factors {
                    match own.checked_mul(&exponent) {
                        Some(joined) => pending.push((part, joined)),
                        None => collected.lost = true,
                    }
                }
            }
            (Form::Product(by, factors), None) => {
                self.root_of_product(collected, id, &by, &factors, exponent)
            }
            (Form::Sum(_), _) => self.power_of_sum(collected, id, exponent, pending),
            (Form::Call(Function::Unary(Unary::Abs), parts), _) if rational::is_even(&exponent) => {
                pending.push((parts[0], exponent));
            }
            _ => collected.join(id, exponent),
        }
    }

    /// A sum as a factor gives away what its terms share, so that equal sums are known as such.
    fn power_of_sum(
        &mut self,
        collected: &mut Collected,
        sum: Id,
        exponent: Exponent,
        pending: &mut Vec<Factor>,
    ) {
        let (content, shared, primitive) = self.primitive(sum);
        if content.is_one() && shared.is_empty() {
            return collected.join(sum, exponent);
        }
        if exponent.is_integer() {
            collected.multiply(rational::power(&content, *exponent.numer()));
            let powers = shared.iter().map(|(id, own)| (*id, own.checked_mul(&exponent)));
            for (id, power) in powers {
                match power {
                    Some(power) => pending.push((id, power)),
                    None => collected.lost = true,
                }
            }
            pending.push((primitive, exponent));
        } else {
            let product = self.bare_product(content, shared, primitive);
            match self.form(product).clone() {
                Form::Product(by, factors) => {
                    self.root_of_product(collected, product, &by, &factors, exponent);
                }
                _ => collected.join(product, exponent),
            }
        }
    }

    fn bare_product(&mut self, by: Rational, mut factors: Vec<Factor>, last: Id) -> Id {
        factors.push((last, Exponent::one()));
        factors.sort();
        self.made(by, factors)
    }

    /// `value^exponent`: integer part of the exponent and exact roots leave, so that `8^(1/2)` of a square is a number.
    fn root_of_number(&mut self, collected: &mut Collected, value: &Rational, exponent: Exponent) {
        if value.is_zero() {
            return collected.multiply(exponent.is_positive().then(Rational::zero));
        }
        if value.is_negative() {
            let base = self.number(value.clone());
            return collected.join(base, exponent);
        }
        for (integer, exponent) in [(value.numer(), exponent), (value.denom(), -exponent)] {
            if integer.is_one() {
                continue;
            }
            let integer = BigRational::from_integer(integer.clone());
            let floor = exponent.floor();
            let rest = exponent - floor;
            collected.multiply(rational::power(&integer, *floor.numer()));
            let order = u32::try_from(*rest.denom()).expect("denominators are positive");
            let (outside, integer) = rational::powers_out(&integer, order);
            collected.multiply(rational::power(&outside, *rest.numer()));
            match rational::exact_root(integer.numer(), order) {
                Some(root) => {
                    collected.multiply(rational::power(&BigRational::from_integer(root), *rest.numer()));
                }
                None => {
                    let base = self.number(integer);
                    collected.join(base, rest);
                }
            }
        }
    }

    /// A root of a product: factors that cannot be negative leave it, an even power leaves as an absolute value.
    fn root_of_product(
        &mut self,
        collected: &mut Collected,
        whole: Id,
        by: &Rational,
        factors: &[Factor],
        exponent: Exponent,
    ) {
        let (mut kept, mut left) = (vec![], vec![]);
        for (id, own) in factors {
            let joined = own.checked_mul(&exponent);
            match joined {
                None => collected.lost = true,
                Some(power) if self.facts(*id).never_negative || !own.is_integer() => left.push((*id, power)),
                Some(power) if rational::is_even(own) => left.push((self.abs(*id), power)),
                Some(_) => kept.push((*id, *own)),
            }
        }
        if let ([only], true) = (kept.as_slice(), by.is_positive()) {
            // Where the root of an odd power has a value, its base is not negative.
            left.push((only.0, only.1 * exponent));
            kept.clear();
        }
        if left.is_empty() && by.abs().is_one() {
            return collected.join(whole, exponent);
        }
        self.root_of_number(collected, &by.abs(), exponent);
        for (id, power) in left {
            collected.join(id, power);
        }
        let sign = by.signum();
        if !kept.is_empty() || sign.is_negative() {
            let rest = self.made(sign, kept);
            collected.join(rest, exponent);
        }
    }

    /// `id^exponent`.
    pub(crate) fn power(&mut self, id: Id, exponent: Exponent) -> Id {
        self.product(Rational::one(), &[(id, exponent)])
    }

    /// `by * id`.
    pub(crate) fn scaled(&mut self, by: Rational, id: Id) -> Id {
        match self.form(id).clone() {
            Form::Sum(terms) => {
                let terms = terms.into_iter().map(|(part, own)| (part, rational::times(&own, &by)));
                self.raw_sum(terms.collect())
            }
            _ => self.raw_product(by, &[(id, Exponent::one())]),
        }
    }

    /// A part as a number times a part without one.
    pub(crate) fn split(&mut self, id: Id) -> (Rational, Id) {
        match self.form(id).clone() {
            Form::Number(value) => (value, self.one()),
            Form::Product(by, factors) if !by.is_one() => {
                let bare = self.made(Rational::one(), factors);
                (by, bare)
            }
            _ => (Rational::one(), id),
        }
    }

    /// The factors of a part, without the number in front.
    pub(crate) fn factors(&self, id: Id) -> Vec<Factor> {
        match self.form(id) {
            Form::Number(_) => vec![],
            Form::Product(_, factors) => factors.clone(),
            _ => vec![(id, Exponent::one())],
        }
    }
}
