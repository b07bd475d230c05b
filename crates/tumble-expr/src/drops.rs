//! Dropping a formula without recursion: a chain of a million sums must not overflow the stack.

use std::sync::Arc;

use crate::expr::{Expr, Inner, Node};

impl Drop for Inner {
    fn drop(&mut self) {
        let mut pending = Vec::new();
        take_children(self, &mut pending);
        while let Some(Expr(shared)) = pending.pop() {
            if let Some(mut inner) = Arc::into_inner(shared) {
                take_children(&mut inner, &mut pending);
            }
        }
    }
}

fn take_children(inner: &mut Inner, pending: &mut Vec<Expr>) {
    match std::mem::replace(&mut inner.node, Node::Pi) {
        Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
        Node::Unary(_, a) | Node::Table(_, a) | Node::Unknown(a, _) => pending.push(a),
        Node::Binary(_, a, b) | Node::Compare(_, a, b) => pending.extend([a, b]),
        Node::Select(a, b, c) => pending.extend([a, b, c]),
        Node::Norm(parts) | Node::System(_, parts) => pending.extend(parts),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deep_chain_drops() {
        let mut sum = Expr::one();
        for _ in 0..1_000_000 {
            sum = sum + 1;
        }
        drop(sum);
    }
}
