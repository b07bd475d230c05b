//! Which symbols may be in a formula: enough to pass by the parts that hold none of those looked for.

use std::ops::BitOr;

use crate::Expr;
use crate::expr::{Node, Symbol};

/// A set of symbols, by a bit each: two symbols may share one, so that a symbol may seem to be there and is not, and never
/// the other way round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Traces(u128);

impl Traces {
    /// Those of a node, from those of its parts.
    pub(crate) fn of(node: &Node) -> Self {
        let of = |part: &Expr| part.0.traces;
        let all = |parts: &[Expr]| parts.iter().fold(Self::default(), |all, part| all | of(part));
        match node {
            Node::Number(_) | Node::Pi => Self::default(),
            Node::Symbol(symbol) => Self::of_symbol(symbol),
            Node::Unary(_, a) | Node::Table(_, a) | Node::Unknown(a, _) => of(a),
            Node::Binary(_, a, b) | Node::Compare(_, a, b) => of(a) | of(b),
            Node::Select(a, b, c) => of(a) | of(b) | of(c),
            Node::Norm(parts) | Node::System(_, parts) => all(parts),
        }
    }

    /// The bit of a symbol, by its name.
    pub(crate) fn of_symbol(symbol: &Symbol) -> Self {
        // Fowler, Noll and Vo's hash; its high bits are mixed best.
        let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        let hash = symbol.name.bytes().fold(0xcbf2_9ce4_8422_2325, mix);
        Self(1 << (hash >> 57))
    }

    /// Whether there is any symbol.
    pub(crate) fn any(self) -> bool {
        self.0 != 0
    }

    /// Whether a symbol may be in both.
    pub(crate) fn meet(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

impl BitOr for Traces {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dimension;

    #[test]
    fn every_symbol_leaves_its_trace() {
        for n in 0..300 {
            let symbol = Symbol::new(format!("x{n}"), Dimension::NONE);
            let formula = Expr::norm(vec![1 + Expr::from(symbol.clone()).sin(), Expr::pi()]);
            assert!(formula.0.traces.meet(Traces::of_symbol(&symbol)));
        }
        assert!(!(Expr::pi() + 1).0.traces.any());
    }
}
