//! The signs in formulas: what they are of, and formulas in which they have another value.

use std::sync::Arc;

use crate::expr::{Expr, Inner, Node, Unary};
use crate::hashing::FastMap;
use crate::same::is_renamed;
use crate::substitute::rebuilt;

impl Expr {
    /// What the signs in it are of, each once.
    pub fn signs(&self) -> Vec<Self> {
        let (mut seen, mut found): (FastMap<*const Inner, ()>, Vec<Self>) = (FastMap::default(), vec![]);
        let mut pending = vec![self];
        while let Some(next) = pending.pop() {
            if seen.insert(Arc::as_ptr(&next.0), ()).is_some() {
                continue;
            }
            if let Node::Unary(Unary::Sign, of) = next.node()
                && !found.iter().any(|known| is_alike(known, of))
            {
                found.push(of.clone());
            }
            pending.extend(next.children());
        }
        found
    }

    /// Whether it may jump where what it depends on does not: signs, steps, choices and piecewise constant tables.
    pub fn may_jump(&self) -> bool {
        self.folded(|formula, part| {
            let own = match formula.node() {
                Node::Unary(Unary::Sign | Unary::Step, _) | Node::Select(..) => true,
                Node::Table(table, _) => table.0.is_stepped(),
                _ => false,
            };
            own || formula.children().into_iter().any(part)
        })
    }

    /// The formula with a value in the place of each sign of something.
    pub fn with_sign(&self, of: &Self, value: &Self) -> Self {
        self.folded(|formula, part| match formula.node() {
            Node::Unary(Unary::Sign, own) if is_alike(own, of) => value.clone(),
            _ => rebuilt(formula, part),
        })
    }
}

fn is_alike(a: &Expr, b: &Expr) -> bool {
    a.0.hash == b.0.hash && is_renamed(std::slice::from_ref(a), std::slice::from_ref(b), |a, b| a == b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dimension;

    #[test]
    fn signs_are_found_and_replaced() {
        let [x, y, s] = ["x", "y", "s"].map(|name| Expr::symbol(name, Dimension::NONE));
        let formula = (&x + &y).sign() * &y - (&x + &y).sign() * x.sign();
        let found = formula.signs();
        assert!(found.len() == 2 && found.iter().any(|of| is_alike(of, &(&x + &y))));
        let replaced = formula.with_sign(&(&x + &y), &s);
        assert!(is_alike(&replaced, &(&s * &y - &s * x.sign())));
        assert!(is_alike(&formula.with_sign(&y, &s), &formula));
    }
}
