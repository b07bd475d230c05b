//! Parts with names of their own, explained below an equation.

use std::collections::HashMap;

use num_traits::{One, Signed};
use tumble_expr::{Dimension, Exponent};

use super::{Algebra, Factor, Form, Id, Leaf};
use crate::rational::{self, Rational};

/// Signs beyond which a part becomes a definition at once, about eight lines: so every part stays of a size that can be
/// worked with.
const CUT_COST: u32 = 160;
/// Levels beyond which a part becomes a definition at once: so walks through parts do not exhaust the stack.
const CUT_DEPTH: u32 = 16;
/// Signs that equations may have together without definitions: about two lines.
const LONG: u32 = 40;
/// Signs that a part must have to be worth a name.
const WORTH_A_NAME: u32 = 7;
/// Signs that a definition must save, itself counted.
const MUST_SAVE: u32 = 8;
/// Most definitions made to shorten equations.
const MOST_DEFINITIONS: usize = 16;

/// A part with a name.
#[derive(Clone, Debug)]
pub(crate) struct Definition {
    /// As handed in; `None` is named when it is shown.
    pub(crate) name: Option<String>,
    /// What stands for it.
    pub(crate) symbol: Id,
    pub(crate) body: Id,
}

impl Algebra {
    /// Gives a part a name; from now on it is known wherever it stands.
    pub(crate) fn define(&mut self, name: Option<String>, body: Id, dimension: Dimension) -> Id {
        if matches!(self.form(body), Form::Symbol(_) | Form::Number(_)) {
            return body;
        }
        let index = self.definitions.len();
        let positive = self.facts(body).never_negative;
        // No scene can spell such a name.
        let leaf = Leaf { name: format!("definition {index}"), dimension, positive, definition: Some(index) };
        let symbol = self.leaf(leaf);
        self.definitions.push(Definition { name, symbol, body });
        let bare = match self.form(body) {
            Form::Sum(_) => self.primitive(body),
            _ => (Rational::one(), vec![], body),
        };
        self.named.insert(body, (symbol, Rational::one()));
        if bare.1.is_empty() {
            self.named.insert(bare.2, (symbol, bare.0.recip()));
        }
        symbol
    }

    /// A part with its name in its place, if it or a factor of it has one.
    pub(super) fn named(&mut self, id: Id) -> Id {
        if self.named.is_empty() {
            return id;
        }
        if let Some((symbol, by)) = self.named.get(&id).cloned() {
            return self.scaled(by, symbol);
        }
        let negative = self.negated(id);
        if let Some((symbol, by)) = self.named.get(&negative).cloned() {
            return self.scaled(-by, symbol);
        }
        match self.form(id).clone() {
            Form::Sum(_) => {
                let (by, mut factors, primitive) = self.primitive(id);
                let Some((symbol, own)) = self.named.get(&primitive).cloned() else { return id };
                factors.push((symbol, Exponent::one()));
                self.raw_product(rational::times(&by, &own), &factors)
            }
            Form::Product(by, factors) if factors.iter().any(|factor| self.is_named(factor)) => {
                self.with_named_factors(by, factors)
            }
            Form::Product(by, _) if !by.is_one() => self.over_named_product(id, &by),
            _ => id,
        }
    }

    /// A quotient by a product that has a name, such as 2/3 M R^2, where the number in front becomes simpler by it.
    fn over_named_product(&mut self, id: Id, by: &Rational) -> Id {
        for index in 0..self.definitions.len() {
            let (symbol, body) = (self.definitions[index].symbol, self.definitions[index].body);
            if !self.divides(body, id) {
                continue;
            }
            let one = Exponent::one();
            let new = self.raw_product(Rational::one(), &[(id, one), (body, one), (symbol, -one)]);
            let (number, _) = self.split(new);
            if total_bits(&number) < total_bits(by) {
                return new;
            }
        }
        id
    }

    /// Whether a product stands, in all its factors, in the denominator of another.
    fn divides(&self, body: Id, id: Id) -> bool {
        let own = self.factors(id);
        let in_denominator = |(part, exponent): Factor| {
            own.iter().any(|(other, power)| *other == part && *power <= -exponent && exponent.is_positive())
        };
        matches!(self.form(body), Form::Product(..)) && self.factors(body).into_iter().all(in_denominator)
    }

    fn is_named(&self, (id, exponent): &Factor) -> bool {
        exponent.is_integer() && self.named.contains_key(id)
    }

    fn with_named_factors(&mut self, by: Rational, mut factors: Vec<Factor>) -> Id {
        for factor in &mut factors {
            if self.is_named(factor) {
                let (symbol, own) = self.named[&factor.0].clone();
                factor.0 = self.scaled(own, symbol);
            }
        }
        self.raw_product(by, &factors)
    }

    /// A part that is too large to work with becomes a definition.
    pub(super) fn cut(&mut self, id: Id) -> Id {
        let facts = self.facts(id);
        let valueless = matches!(self.form(id), Form::Call(function, _) if !function.is_number());
        if valueless || (facts.cost <= CUT_COST && facts.depth <= CUT_DEPTH) {
            return id;
        }
        self.define(None, id, Dimension::NONE)
    }

    /// Gives names to long parts that stand in several places, while that shortens the whole.
    pub(crate) fn pull_out(&mut self, roots: &mut [Id]) {
        for _ in 0..MOST_DEFINITIONS {
            let total = roots.iter().map(|id| self.cost(*id)).fold(0, u32::saturating_add);
            if total <= LONG {
                return;
            }
            let Some(best) = self.best_part(roots) else { return };
            let symbol = self.define(None, best, Dimension::NONE);
            let mut done = HashMap::new();
            for root in roots.iter_mut() {
                *root = self.replaced(*root, best, symbol, &mut done);
            }
        }
    }

    /// The part whose name would save most.
    fn best_part(&self, roots: &[Id]) -> Option<Id> {
        let counts = self.counts(roots);
        let saved = |id: Id, count: u32| {
            let cost = self.cost(id);
            // Each place keeps one sign; the definition has its own cost and two signs more.
            count.saturating_mul(cost - 1).saturating_sub(cost + 2)
        };
        let worthy = |id: &Id| {
            let kind = match self.form(*id) {
                Form::Sum(_) => true,
                Form::Call(function, _) => function.is_number(),
                _ => false,
            };
            kind && self.cost(*id) >= WORTH_A_NAME
        };
        let all = counts.into_iter().filter(|(id, _)| worthy(id));
        let all = all.map(|(id, count)| (saved(id, count), std::cmp::Reverse(id)));
        let best = all.filter(|(saved, _)| *saved >= MUST_SAVE).max()?;
        Some(best.1.0)
    }

    /// How often each part is printed.
    fn counts(&self, roots: &[Id]) -> HashMap<Id, u32> {
        let mut counts: HashMap<Id, u32> = HashMap::new();
        let order = self.parts_first(roots);
        for root in roots {
            // A whole side of an equation gains nothing from a name.
            for part in self.parts(*root) {
                *counts.entry(part).or_default() += 1;
            }
        }
        for id in order.into_iter().rev().filter(|id| !roots.contains(id)) {
            let count = counts.get(&id).copied().unwrap_or(0);
            for part in self.parts(id) {
                let entry = counts.entry(part).or_default();
                *entry = entry.saturating_add(count);
            }
        }
        counts
    }

    /// All parts below these, parts before what is made of them.
    pub(crate) fn parts_first(&self, roots: &[Id]) -> Vec<Id> {
        let mut seen = std::collections::HashSet::new();
        let mut pending: Vec<Id> = roots.to_vec();
        while let Some(id) = pending.pop() {
            if seen.insert(id) {
                pending.extend(self.parts(id));
            }
        }
        let mut order: Vec<Id> = seen.into_iter().collect();
        // A part is interned before what is made of it.
        order.sort();
        order
    }

    /// `id` with `symbol` wherever `part` stands.
    fn replaced(&mut self, id: Id, part: Id, symbol: Id, done: &mut HashMap<Id, Id>) -> Id {
        if id == part {
            return symbol;
        }
        if let Some(known) = done.get(&id) {
            return *known;
        }
        for inner in self.parts(id) {
            self.replaced(inner, part, symbol, done);
        }
        let of = |inner: Id| if inner == part { symbol } else { done[&inner] };
        let new = match self.form(id).clone() {
            Form::Sum(terms) => {
                let mut all = super::sum::Terms::new();
                for (inner, by) in &terms {
                    let inner = of(*inner);
                    self.add_term(&mut all, by, inner);
                }
                self.raw_sum(all)
            }
            Form::Product(by, factors) => {
                let factors: Vec<Factor> =
                    factors.into_iter().map(|(inner, exponent)| (of(inner), exponent)).collect();
                self.raw_product(by, &factors)
            }
            Form::Call(function, parts) => {
                let parts = parts.into_iter().map(of).collect();
                self.intern(Form::Call(function, parts))
            }
            _ => id,
        };
        done.insert(id, new);
        new
    }

    /// The definitions that these parts use, and those that these use, in the order in which a reader meets them.
    pub(crate) fn used(&self, roots: &[Id]) -> Vec<usize> {
        let mut found: Vec<usize> = vec![];
        let mut next = self.definitions_in(roots);
        while let Some(index) = next.iter().copied().find(|index| !found.contains(index)) {
            found.push(index);
            next.retain(|other| *other != index);
            next.extend(self.definitions_in(&[self.definitions[index].body]));
        }
        found
    }

    fn definitions_in(&self, roots: &[Id]) -> Vec<usize> {
        let definition = |id: Id| match self.form(id) {
            Form::Symbol(index) => self.symbols[*index].definition,
            _ => None,
        };
        self.parts_first(roots).into_iter().filter_map(definition).collect()
    }
}

fn total_bits(value: &Rational) -> u64 {
    value.numer().bits() + value.denom().bits()
}
