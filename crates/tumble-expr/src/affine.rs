//! Whether formulas are sums of some symbols, each times what has none of them.

use std::collections::HashSet;

use crate::expr::{Binary, Expr, Node, Symbol, Unary};

impl Expr {
    /// The first part of the formula in which these symbols are not just added up, each times what has none of them; `None` where
    /// the whole is such a sum.
    pub fn nonlinear_part(&self, symbols: &HashSet<Symbol>) -> Option<Self> {
        let mut first = None;
        // Whether a part has any of the symbols.
        self.folded(|formula, has| {
            let own = matches!(formula.node(), Node::Symbol(symbol) if symbols.contains(symbol));
            let any = own || formula.children().into_iter().any(has);
            if any && first.is_none() && !is_linear(formula, has) {
                first = Some(formula.clone());
            }
            any
        });
        first
    }
}

/// Whether an operation adds up what some of its parts have; `of` says which have any.
fn is_linear(formula: &Expr, of: impl Fn(&Expr) -> bool) -> bool {
    match formula.node() {
        Node::Symbol(_) | Node::Unary(Unary::Neg, _) => true,
        Node::Binary(Binary::Add | Binary::Sub, ..) => true,
        Node::Binary(Binary::Mul, a, b) => !(of(a) && of(b)),
        Node::Binary(Binary::Div, _, b) => !of(b),
        Node::Select(condition, ..) => !of(condition),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dimension;

    #[test]
    fn sums_with_any_factors_are_linear() {
        let [a, b, x] = ["a", "b", "x"].map(|name| Expr::symbol(name, Dimension::NONE));
        let symbols: HashSet<Symbol> = [&a, &b].into_iter().flat_map(Expr::symbols).collect();
        let linear = [
            -(&a * x.sign() + &b / (x.sin() + 2)) * x.abs() + x.powi(3),
            Expr::select(Expr::compare(crate::Relation::Less, x.clone(), Expr::one()), a.clone(), b.clone()),
            x.sqrt(),
        ];
        for formula in linear {
            assert!(formula.nonlinear_part(&symbols).is_none());
        }
        let part = Expr::norm(vec![a.clone(), x.clone()]);
        let nonlinear = [
            (&x + &part * 2, part),
            (&a * &b, &a * &b),
            (&x / &a, &x / &a),
            (a.abs() * &x, a.abs()),
            (
                Expr::select(Expr::compare(crate::Relation::Less, a.clone(), b.clone()), x.clone(), b),
                Expr::compare(crate::Relation::Less, a.clone(), Expr::symbol("b", Dimension::NONE)),
            ),
            (a.sign(), a.sign()),
        ];
        for (formula, part) in nonlinear {
            let found = formula.nonlinear_part(&symbols).expect("not linear");
            assert!(crate::is_renamed(&[found], &[part], |a, b| a == b));
        }
    }
}
