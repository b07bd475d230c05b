//! Replacing symbols by formulas.

use std::collections::HashMap;
use std::sync::Arc;

use crate::expr::{Expr, Inner, Node, Symbol};
use crate::hashing::FastMap;
use crate::traces::Traces;

/// Formulas to put in the place of symbols.
#[derive(Clone, Debug, Default)]
pub struct Substitution {
    formulas: HashMap<Symbol, Expr>,
    /// Those of all symbols.
    traces: Traces,
}

impl Substitution {
    /// Puts `formula` wherever `symbol` stands; a later formula for the same symbol replaces an earlier one.
    pub fn insert(&mut self, symbol: Symbol, formula: Expr) {
        self.traces = self.traces | Traces::of_symbol(&symbol);
        self.formulas.insert(symbol, formula);
    }

    /// Puts in all that another does.
    pub fn extend(&mut self, other: Self) {
        self.traces = self.traces | other.traces;
        self.formulas.extend(other.formulas);
    }

    /// The same with other formulas put into those that it has.
    #[must_use]
    pub fn then(&self, other: &Self) -> Self {
        let (symbols, formulas): (Vec<_>, Vec<_>) =
            self.formulas.iter().map(|(symbol, formula)| (symbol.clone(), formula.clone())).unzip();
        let formulas = symbols.into_iter().zip(other.apply_all(&formulas)).collect();
        Self { formulas, traces: self.traces }
    }

    /// The formula for a symbol, if there is one.
    pub fn get(&self, symbol: &Symbol) -> Option<&Expr> {
        self.formulas.get(symbol)
    }

    /// `formula` with its symbols replaced, once: what is put in is not looked through again.
    ///
    /// Shared parts stay shared, parts that hold none of the symbols are not looked at, and the depth of a formula is not
    /// bounded by the stack.
    pub fn apply(&self, formula: &Expr) -> Expr {
        self.replaced(formula, &mut FastMap::default())
    }

    /// The same of many formulas: what they share is looked through once, and stays shared.
    pub fn apply_all(&self, formulas: &[Expr]) -> Vec<Expr> {
        let mut done = FastMap::default();
        formulas.iter().map(|formula| self.replaced(formula, &mut done)).collect()
    }

    /// `done` are parts that have been replaced before, of formulas that are still there.
    fn replaced(&self, formula: &Expr, done: &mut FastMap<*const Inner, Expr>) -> Expr {
        if !formula.0.traces.meet(self.traces) {
            return formula.clone();
        }
        let mut pending = vec![formula.clone()];
        while let Some(next) = pending.last().cloned() {
            let missing =
                |part: &&Expr| part.0.traces.meet(self.traces) && !done.contains_key(&Arc::as_ptr(&part.0));
            let parts: Vec<Expr> = next.children().into_iter().filter(missing).cloned().collect();
            if parts.is_empty() {
                let replaced = self.rebuilt(&next, |part| match part.0.traces.meet(self.traces) {
                    true => done[&Arc::as_ptr(&part.0)].clone(),
                    false => part.clone(),
                });
                done.insert(Arc::as_ptr(&next.0), replaced);
                pending.pop();
            } else {
                pending.extend(parts);
            }
        }
        done[&Arc::as_ptr(&formula.0)].clone()
    }

    fn rebuilt(&self, formula: &Expr, part: impl Fn(&Expr) -> Expr) -> Expr {
        if let Node::Symbol(symbol) = formula.node() {
            return self.get(symbol).unwrap_or(formula).clone();
        }
        rebuilt(formula, part)
    }
}

/// A formula of other parts; itself where they are the same.
pub(crate) fn rebuilt(formula: &Expr, part: impl Fn(&Expr) -> Expr) -> Expr {
    let same = |old: &&Expr| Arc::ptr_eq(&old.0, &part(old).0);
    if formula.children().iter().all(same) {
        return formula.clone();
    }
    match formula.node().map(&part) {
        Node::Unary(op, a) => Expr::unary(op, a),
        Node::Binary(op, a, b) => Expr::binary(op, a, b),
        Node::Compare(relation, a, b) => Expr::compare(relation, a, b),
        Node::Select(a, b, c) => Expr::select(a, b, c),
        Node::Norm(parts) => Expr::norm(parts),
        Node::Table(table, a) => Expr::table(&table.0, a),
        Node::System(shape, parts) => Expr::system(&shape, parts),
        Node::Unknown(system, row) => Expr::unknown(system, row),
        Node::Number(_) | Node::Pi | Node::Symbol(_) => formula.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dimension, Graph};

    #[test]
    fn symbols_are_replaced_once() {
        let x = Symbol::new("x", Dimension::LENGTH);
        let mut substitution = Substitution::default();
        substitution.insert(x.clone(), Expr::from(x.clone()) * 2);
        let replaced = substitution.apply(&(Expr::from(x.clone()) + Expr::from(x.clone())));
        let mut graph = Graph::default();
        let expected = Expr::from(x.clone()) * 2 + Expr::from(x) * 2;
        let ids = graph.import(&[replaced, expected]);
        assert_eq!(ids[0], ids[1]);
    }

    #[test]
    fn what_holds_no_symbol_is_shared() {
        let y = Expr::symbol("y", Dimension::LENGTH).sqrt();
        assert!(Arc::ptr_eq(&Substitution::default().apply(&y).0, &y.0));
    }
}
