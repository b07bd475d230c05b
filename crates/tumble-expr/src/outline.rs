//! Formulas but for the names of their symbols: a hash to look them up by, and the symbols in an order that no name has a part in.

use std::collections::HashMap;
use std::hash::Hasher;
use std::sync::Arc;

use crate::expr::{Expr, Inner, Node, Symbol};
use crate::hashing::{FastMap, Mixer};
use crate::same::{hash_node, is_renamed};

/// What formulas have in common with those that differ from them by names alone.
#[derive(Clone, Debug)]
pub struct Skeleton {
    hash: u64,
    symbols: Vec<Symbol>,
}

impl Skeleton {
    /// That of these formulas.
    pub fn of(formulas: &[Expr]) -> Self {
        let mut walk = Walk::default();
        let mut mixer = Mixer::default();
        for formula in formulas {
            mixer.write_u64(walk.through(formula));
        }
        Self { hash: mixer.finish(), symbols: walk.symbols }
    }

    /// Equal where formulas differ by names alone.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    /// The symbols, each once: in formulas that differ by names alone, those at one place stand for each other.
    pub fn symbols(&self) -> &[Symbol] {
        &self.symbols
    }

    /// Whether the formulas that this is of are others, with an outline of their own, but for the names.
    pub fn is_renamed(&self, own: &[Expr], other: &Self, others: &[Expr]) -> bool {
        let pairs = || self.symbols.iter().zip(&other.symbols);
        let is_alike = self.hash == other.hash
            && self.symbols.len() == other.symbols.len()
            && pairs().all(|(a, b)| a.dimension == b.dimension);
        let names: HashMap<&Symbol, &Symbol> = pairs().collect();
        is_alike && is_renamed(own, others, |a, b| names.get(a) == Some(&b))
    }
}

/// Formulas that are looked through, what they share once.
#[derive(Default)]
struct Walk {
    symbols: Vec<Symbol>,
    places: HashMap<Symbol, usize>,
    hashes: FastMap<*const Inner, u64>,
}

impl Walk {
    fn through(&mut self, formula: &Expr) -> u64 {
        let mut pending = vec![(formula, false)];
        while let Some((next, are_parts_done)) = pending.pop() {
            let key = Arc::as_ptr(&next.0);
            if self.hashes.contains_key(&key) {
                continue;
            }
            if are_parts_done || !next.0.traces.any() {
                let hash = self.hash(next);
                self.hashes.insert(key, hash);
            } else {
                pending.push((next, true));
                next.node().each_part(|part| pending.push((part, false)));
            }
        }
        self.hashes[&Arc::as_ptr(&formula.0)]
    }

    /// That of a node whose parts are done.
    fn hash(&mut self, formula: &Expr) -> u64 {
        // What holds no symbol is its own outline.
        if !formula.0.traces.any() {
            return formula.0.hash;
        }
        let mut mixer = Mixer::default();
        match formula.node() {
            Node::Symbol(symbol) => mixer.write_usize(self.place(symbol)),
            node => hash_node(node, &mut mixer, |part, mixer| {
                mixer.write_u64(self.hashes[&Arc::as_ptr(&part.0)]);
            }),
        }
        mixer.finish()
    }

    fn place(&mut self, symbol: &Symbol) -> usize {
        if let Some(place) = self.places.get(symbol) {
            return *place;
        }
        self.symbols.push(symbol.clone());
        self.places.insert(symbol.clone(), self.symbols.len() - 1);
        self.symbols.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dimension;

    fn written(names: [&str; 2]) -> Vec<Expr> {
        let [x, y] = names.map(|name| Expr::symbol(name, Dimension::LENGTH));
        vec![(&x * &y).sqrt() * 3 + &x, x - y]
    }

    fn is_renamed(own: &[Expr], others: &[Expr]) -> bool {
        Skeleton::of(own).is_renamed(own, &Skeleton::of(others), others)
    }

    #[test]
    fn names_have_no_part_in_it() {
        assert!(is_renamed(&written(["a", "b"]), &written(["c", "d"])));
        assert!(is_renamed(&written(["a", "b"]), &written(["b", "a"])));
        let [own, other] =
            [["a", "b"], ["d", "c"]].map(|names| Skeleton::of(&written(names)).symbols().to_vec());
        let places = |names: [&str; 2], symbols: &[Symbol]| {
            names.map(|name| symbols.iter().position(|symbol| &*symbol.name == name))
        };
        assert_eq!(places(["a", "b"], &own), places(["d", "c"], &other));
    }

    #[test]
    fn what_differs_by_more_is_told_apart() {
        assert!(!is_renamed(&written(["a", "b"]), &written(["c", "c"])));
        assert!(!is_renamed(&written(["a", "b"]), &written(["c", "d"])[..1]));
        let other = written(["c", "d"]).into_iter().map(|formula| formula * 2).collect::<Vec<_>>();
        assert!(!is_renamed(&written(["a", "b"]), &other));
        let time = Expr::symbol("t", Dimension::TIME).sin();
        assert!(!is_renamed(&[Expr::symbol("x", Dimension::LENGTH).sin()], &[time]));
    }
}
