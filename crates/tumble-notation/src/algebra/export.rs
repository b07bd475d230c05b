//! From the normal form back to formulas.

use num_traits::{One, Signed};
use tumble_expr::{Exponent, Expr, Symbol};

use super::{Algebra, Factor, Form, Function, Id};
use crate::rational::Rational;

impl Algebra {
    /// The formula of a part, with every definition written out; shared parts stay shared.
    pub(crate) fn export(&mut self, id: Id) -> Expr {
        let mut pending = vec![id];
        while let Some(next) = pending.last().copied() {
            if self.exported.contains_key(&next) {
                pending.pop();
                continue;
            }
            let missing: Vec<Id> =
                self.needs(next).into_iter().filter(|part| !self.exported.contains_key(part)).collect();
            if missing.is_empty() {
                let formula = self.formula(next);
                self.exported.insert(next, formula);
                pending.pop();
            } else {
                pending.extend(missing);
            }
        }
        self.exported[&id].clone()
    }

    fn needs(&self, id: Id) -> Vec<Id> {
        match self.form(id) {
            Form::Symbol(index) => {
                let definition = self.symbols[*index].definition;
                definition.map(|index| self.definitions[index].body).into_iter().collect()
            }
            _ => self.parts(id),
        }
    }

    fn formula(&self, id: Id) -> Expr {
        let of = |id: &Id| self.exported[id].clone();
        match self.form(id) {
            Form::Number(value) => Expr::number(value.clone()),
            Form::Pi => Expr::pi(),
            Form::Unit(base) => Expr::quantity(Rational::one(), base.dimension()),
            Form::Symbol(index) => match self.symbols[*index].definition {
                Some(definition) => of(&self.definitions[definition].body),
                None => self.symbol_formula(*index),
            },
            Form::Sum(terms) => self.sum_formula(terms),
            Form::Product(by, factors) => self.product_formula(by, factors),
            Form::Call(function, parts) => call(function, parts.iter().map(of).collect()),
        }
    }

    fn symbol_formula(&self, index: usize) -> Expr {
        let leaf = &self.symbols[index];
        Symbol::new(leaf.name.as_str(), leaf.dimension).into()
    }

    fn sum_formula(&self, terms: &[(Id, Rational)]) -> Expr {
        let mut sum: Option<Expr> = None;
        for (part, by) in terms {
            let term = times(&by.abs(), self.exported[part].clone());
            sum = Some(match sum {
                None if by.is_negative() => -term,
                None => term,
                Some(before) if by.is_negative() => before - term,
                Some(before) => before + term,
            });
        }
        sum.unwrap_or_else(Expr::zero)
    }

    fn product_formula(&self, by: &Rational, factors: &[Factor]) -> Expr {
        let side = |wanted: bool| {
            let powers = factors.iter().filter(|(_, exponent)| exponent.is_positive() == wanted);
            powers.map(|(id, exponent)| raised(&self.exported[id], exponent.abs())).reduce(|a, b| a * b)
        };
        let above = times(by, side(true).unwrap_or_else(Expr::one));
        side(false).map_or_else(|| above.clone(), |below| above.clone() / below)
    }
}

fn times(by: &Rational, formula: Expr) -> Expr {
    if by.is_one() { formula } else { Expr::number(by.clone()) * formula }
}

fn raised(base: &Expr, exponent: Exponent) -> Expr {
    if exponent.is_one() {
        base.clone()
    } else if exponent == Exponent::new(1, 2) {
        base.sqrt()
    } else {
        base.powr(exponent)
    }
}

fn call(function: &Function, parts: Vec<Expr>) -> Expr {
    let mut parts = parts.into_iter();
    let mut next = || parts.next().expect("functions are made with all their arguments");
    match function {
        Function::Unary(op) => Expr::unary(*op, next()),
        Function::Binary(op) => Expr::binary(*op, next(), next()),
        Function::Compare(relation) => Expr::compare(*relation, next(), next()),
        Function::Select => Expr::select(next(), next(), next()),
        Function::Table(table) => Expr::table(&table.0, next()),
        Function::Norm => Expr::norm(parts.collect()),
        Function::Unknown(row) => unknown(*row, parts.collect()),
        // Never part of a number: unknowns hold the entries themselves.
        Function::System => Expr::zero(),
    }
}

/// One unknown of a system from its n x n entries and its n right sides.
fn unknown(row: u32, mut entries: Vec<Expr>) -> Expr {
    let n = entries.len().isqrt();
    let right = entries.split_off(n * n);
    let matrix = entries.chunks(n.max(1)).map(<[Expr]>::to_vec).collect();
    Expr::solve(matrix, right).swap_remove(row as usize)
}
