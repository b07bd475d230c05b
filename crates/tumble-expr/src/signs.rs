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

    /// The formula with a value in the place of each sign of something.
    pub fn with_sign(&self, of: &Self, value: &Self) -> Self {
        let mut done: FastMap<*const Inner, Self> = FastMap::default();
        let mut pending = vec![self];
        while let Some(next) = pending.last().copied() {
            let missing = |part: &&Self| !done.contains_key(&Arc::as_ptr(&part.0));
            let parts: Vec<&Self> = next.children().into_iter().filter(missing).collect();
            if parts.is_empty() {
                let new = match next.node() {
                    Node::Unary(Unary::Sign, own) if is_alike(own, of) => value.clone(),
                    _ => rebuilt(next, |part| done[&Arc::as_ptr(&part.0)].clone()),
                };
                done.insert(Arc::as_ptr(&next.0), new);
                pending.pop();
            } else {
                pending.extend(parts);
            }
        }
        done[&Arc::as_ptr(&self.0)].clone()
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
