//! Derivatives of formulas with respect to a symbol, as formulas.

use std::sync::Arc;

use num_rational::BigRational;
use num_traits::One;

use crate::expr::{Binary, Expr, Node, Symbol, Unary};

impl Expr {
    /// The derivative with respect to `symbol`, all other symbols held fixed; on branches, that of the side that holds.
    ///
    /// Shared parts are differentiated once, and the depth of the formula is not bounded by the stack.
    pub fn derivative(&self, symbol: &Symbol) -> Self {
        self.folded(|formula, of| slope(formula, symbol, of))
    }
}

/// Derivative of a formula from those of its parts. What does not change gives the bare zero.
fn slope(formula: &Expr, symbol: &Symbol, of: impl Fn(&Expr) -> Expr) -> Expr {
    if let Node::Symbol(own) = formula.node() {
        return if own == symbol { Expr::one() } else { Expr::zero() };
    }
    if formula.children().iter().all(|part| of(part).is_zero()) {
        return Expr::zero();
    }
    match formula.node() {
        Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Compare(..) => Expr::zero(),
        Node::Unary(op, a) => unary(*op, a, formula, of(a)),
        Node::Binary(op, a, b) => binary(*op, (a, b), formula, (of(a), of(b))),
        Node::Select(condition, a, b) => Expr::select(condition.clone(), of(a), of(b)),
        Node::Norm(parts) => {
            let products = parts.iter().map(|part| part * of(part));
            products.fold(Expr::zero(), |sum, product| sum + product) / formula
        }
        Node::Table(table, a) => match table.0.derivative() {
            Ok(slope) => Expr::table(&Arc::new(slope), a.clone()) * of(a),
            Err(error) => Expr::mistaken(error),
        },
        Node::System(shape, parts) => formula.system_slope(shape, parts, of),
        Node::Unknown(system, row) => Expr::unknown(of(system), *row),
    }
}

fn unary(op: Unary, a: &Expr, value: &Expr, da: Expr) -> Expr {
    let one = Expr::one;
    match op {
        Unary::Neg => -da,
        Unary::Sin => a.cos() * da,
        Unary::Cos => -(a.sin() * da),
        Unary::Tan => (one() + value * value) * da,
        Unary::Asin => da / (one() - a * a).sqrt(),
        Unary::Acos => -(da / (one() - a * a).sqrt()),
        Unary::Atan => da / (one() + a * a),
        Unary::Sinh => Expr::unary(Unary::Cosh, a.clone()) * da,
        Unary::Cosh => Expr::unary(Unary::Sinh, a.clone()) * da,
        Unary::Tanh => (one() - value * value) * da,
        Unary::Exp => value * da,
        Unary::Log => da / a,
        Unary::Sqrt => da / (2 * value),
        Unary::Abs => a.sign() * da,
        Unary::Sign | Unary::Step => Expr::zero(),
    }
}

fn binary(op: Binary, (a, b): (&Expr, &Expr), value: &Expr, (da, db): (Expr, Expr)) -> Expr {
    match op {
        Binary::Add => da + db,
        Binary::Sub => da - db,
        Binary::Mul => da * b + a * db,
        Binary::Div => (da - value * db) / b,
        Binary::Pow if db.is_zero() => b * Expr::binary(Binary::Pow, a.clone(), less_one(b)) * da,
        Binary::Pow => value * (db * a.log() + b * da / a),
        Binary::Atan2 => (b * da - a * db) / (a * a + b * b),
        Binary::Min => Expr::select(Expr::compare(crate::Relation::Less, a.clone(), b.clone()), da, db),
        Binary::Max => Expr::select(Expr::compare(crate::Relation::Less, a.clone(), b.clone()), db, da),
        Binary::SquareOver => (2 * a * da - value * db) / b,
    }
}

/// A number stays a number, so that the power of a quantity keeps a known dimension.
fn less_one(exponent: &Expr) -> Expr {
    match exponent.as_number() {
        Some(value) => Expr::number(value - BigRational::one()),
        None => exponent - 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Branches, Dimension, Jets, Layout, Tape};

    /// The formula's derivative, against the first coefficient of its series.
    fn agrees(formula: impl Fn(&Expr) -> Expr) {
        let t = Symbol::new("t", Dimension::NONE);
        let written = formula(&Expr::from(t.clone()));
        let slope = written.derivative(&t);
        let layout = Layout::new(vec![], t, vec![]);
        let tape = Tape::compile(&layout, &[written, slope]).expect("typed");
        let mut jets = Jets::new(Arc::new(tape), 1, &[]);
        jets.start(0.7, &[], Branches::Free);
        jets.set(0, 1, 1.0);
        jets.extend(1);
        let (series, slope) = (jets.output(0)[1], jets.output(1)[0]);
        assert!((series - slope).abs() < 1e-13 * slope.abs().max(1.0), "{series} is not {slope}");
    }

    #[test]
    fn every_operation_agrees_with_its_series() {
        for op in [Unary::Neg, Unary::Sin, Unary::Cos, Unary::Tan, Unary::Asin, Unary::Acos, Unary::Atan] {
            agrees(|t| Expr::unary(op, t * 0.9 - 0.1));
        }
        for op in [Unary::Sinh, Unary::Cosh, Unary::Tanh, Unary::Exp, Unary::Log, Unary::Sqrt, Unary::Abs] {
            agrees(|t| Expr::unary(op, t * 0.9 - 0.1));
        }
        agrees(|t| Expr::unary(Unary::Abs, t - 2));
        agrees(|t| (t - 0.2).sign() * t + (t - 0.2).step());
        for op in [Binary::Add, Binary::Sub, Binary::Mul, Binary::Div, Binary::Pow, Binary::Atan2] {
            agrees(|t| Expr::binary(op, t.sin(), t.exp()));
        }
        for op in [Binary::Min, Binary::Max, Binary::SquareOver] {
            agrees(|t| Expr::binary(op, t.sin(), t.exp()));
            agrees(|t| Expr::binary(op, t.exp(), t.sin()));
        }
        agrees(|t| t.powi(3) + 2 / t + t.powr(crate::Exponent::new(1, 3)));
        agrees(|t| Expr::norm(vec![t.sin(), t.exp(), Expr::from(2)]));
        let matrix = |t: &Expr| vec![vec![t.exp(), t.sin()], vec![t.sin(), t.cos() + 2]];
        agrees(|t| Expr::solve(matrix(t), vec![t.clone(), t * t]).remove(1));
        let twice = |t: &Expr| Expr::solve(matrix(t), Expr::solve(matrix(t), vec![t.clone(), t.exp()]));
        agrees(|t| twice(t).remove(0));
    }

    #[test]
    fn what_does_not_change_has_derivative_zero() {
        let (t, m) = (Symbol::new("t", Dimension::TIME), Expr::symbol("m", Dimension::MASS));
        assert!((m.sqrt() * 3).derivative(&t).is_zero());
        let slope = (Expr::from(t.clone()) * m).derivative(&t);
        assert_eq!(slope.dimension(), Ok(Dimension::MASS));
    }
}
