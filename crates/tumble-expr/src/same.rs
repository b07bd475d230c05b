//! Formulas as keys: equal where they are written alike, part by part, wherever they were built.

use std::collections::HashSet;
use std::hash::{BuildHasherDefault, Hash, Hasher};
use std::sync::Arc;

use num_rational::BigRational;

use crate::expr::{Expr, Inner, Node, Symbol};
use crate::hashing::Mixer;

/// Some formulas in order, to look up what was built of them.
#[derive(Clone, Debug)]
pub struct Formulas(Box<[Expr]>);

impl Formulas {
    /// These formulas.
    pub fn new(formulas: &[Expr]) -> Self {
        Self(formulas.into())
    }

    /// In order.
    pub fn list(&self) -> &[Expr] {
        &self.0
    }
}

impl Hash for Formulas {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.iter().for_each(|formula| state.write_u64(formula.0.hash));
    }
}

impl PartialEq for Formulas {
    /// Shared parts are compared once, and the depth of a formula is not bounded by the stack.
    fn eq(&self, other: &Self) -> bool {
        if self.0.len() != other.0.len() {
            return false;
        }
        let mut seen: HashSet<[*const Inner; 2], BuildHasherDefault<Mixer>> = HashSet::default();
        let mut pending: Vec<(&Expr, &Expr)> = self.0.iter().zip(&other.0).collect();
        while let Some((a, b)) = pending.pop() {
            let pair = [a, b].map(|formula| Arc::as_ptr(&formula.0));
            if pair[0] == pair[1] {
                continue;
            }
            if a.0.hash != b.0.hash || !is_alike(a, b) {
                return false;
            }
            let (of_a, of_b) = (a.children(), b.children());
            if !of_a.is_empty() && seen.insert(pair) {
                pending.extend(of_a.into_iter().zip(of_b));
            }
        }
        true
    }
}

impl Eq for Formulas {}

/// Whether formulas are written alike where one symbol stands for another, by `stands_for`: shared parts are compared once.
pub fn is_renamed(these: &[Expr], those: &[Expr], stands_for: impl Fn(&Symbol, &Symbol) -> bool) -> bool {
    let mut seen: HashSet<[*const Inner; 2], BuildHasherDefault<Mixer>> = HashSet::default();
    let mut pending: Vec<(&Expr, &Expr)> = these.iter().zip(those).collect();
    while let Some((a, b)) = pending.pop() {
        let is_same = match (a.node(), b.node()) {
            (Node::Symbol(a), Node::Symbol(b)) => stands_for(a, b),
            _ => is_alike(a, b),
        };
        let (of_a, of_b) = (a.children(), b.children());
        if !is_same || of_a.len() != of_b.len() {
            return false;
        }
        if !of_a.is_empty() && seen.insert([a, b].map(|formula| Arc::as_ptr(&formula.0))) {
            pending.extend(of_a.into_iter().zip(of_b));
        }
    }
    these.len() == those.len()
}

/// Whether two nodes are the same but for their parts, of which they have as many.
fn is_alike(a: &Expr, b: &Expr) -> bool {
    let has_one_kind = matches!((&a.0.kind, &b.0.kind), (Ok(a), Ok(b)) if a == b);
    has_one_kind
        && match (a.node(), b.node()) {
            (Node::Number(a), Node::Number(b)) => a == b,
            (Node::Symbol(a), Node::Symbol(b)) => a == b,
            (a, b) => a.map(|_| ()) == b.map(|_| ()),
        }
}

/// A hash of a node from those of its parts: equal for nodes that are written alike.
pub(crate) fn hash_of(node: &Node) -> u64 {
    let mut mixer = Mixer::default();
    hash_node(node, &mut mixer, |part, mixer| mixer.write_u64(part.0.hash));
    mixer.finish()
}

impl<Part: Hash> Hash for Node<Part> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        hash_node(self, state, |part, state| part.hash(state));
    }
}

/// Hashes a node, its parts as they say.
pub(crate) fn hash_node<Part, H: Hasher>(
    node: &Node<Part>,
    state: &mut H,
    hash_part: impl Fn(&Part, &mut H),
) {
    std::mem::discriminant(node).hash(state);
    match node {
        Node::Number(value) => hash_number(value, state),
        Node::Symbol(symbol) => symbol.hash(state),
        Node::Unary(op, _) => op.hash(state),
        Node::Binary(op, ..) => op.hash(state),
        Node::Compare(relation, ..) => relation.hash(state),
        Node::Table(table, _) => table.hash(state),
        Node::Unknown(_, row) => row.hash(state),
        Node::Pi | Node::Select(..) | Node::Norm(_) | Node::System(..) => {}
    }
    node.each_part(|part| hash_part(part, state));
}

/// By the words of a number, without a division; all numbers are in lowest terms.
fn hash_number<H: Hasher>(value: &BigRational, state: &mut H) {
    for part in [value.numer(), value.denom()] {
        state.write_u8(part.sign() as u8);
        part.iter_u64_digits().for_each(|word| state.write_u64(word));
    }
}

/// An exact number as a key.
#[derive(PartialEq, Eq)]
pub(crate) struct Exact(pub(crate) BigRational);

impl Hash for Exact {
    fn hash<H: Hasher>(&self, state: &mut H) {
        hash_number(&self.0, state);
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::Dimension;

    fn written(scale: i32) -> Expr {
        let (x, y) = (Expr::symbol("x", Dimension::NONE), Expr::symbol("y", Dimension::NONE));
        Expr::norm(vec![&x + &y, scale * (&x * &y).sin()]) / 3
    }

    #[test]
    fn what_is_written_alike_is_found() {
        let mut known = HashMap::new();
        known.insert(Formulas::new(&[written(2)]), 1);
        assert_eq!(known.get(&Formulas::new(&[written(2)])), Some(&1));
        assert_eq!(known.get(&Formulas::new(&[written(3)])), None);
        assert_eq!(known.get(&Formulas::new(&[written(2), written(2)])), None);
    }

    #[test]
    fn numbers_are_told_apart_by_their_dimension() {
        let [pure, length] =
            [Dimension::NONE, Dimension::LENGTH].map(|of| Expr::quantity(num_traits::One::one(), of));
        assert!(Formulas::new(&[pure]) != Formulas::new(&[length]));
    }

    #[test]
    fn shared_and_deep_formulas_are_compared() {
        let deep = || (0..200_000).fold(Expr::symbol("x", Dimension::NONE), |sum, _| (&sum + &sum).sin());
        assert!(Formulas::new(&[deep()]) == Formulas::new(&[deep()]));
    }
}
