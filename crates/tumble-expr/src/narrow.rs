//! Whether a formula may be narrow: change within a stretch that its coefficients beside it do not show.
//!
//! Exponentials and their like may, and quotients, and high powers: all coefficients of `cos(x)^60` up to the sixtieth are zero where
//! the cosine is. Products of a few factors, sines and cosines are as steep everywhere as they are somewhere.

use crate::ops::{Op, Slot};
use crate::tape::{Stage, Tape};

/// A product of at most so many factors is shown whole by its coefficients, which are never fewer.
const MOST_FACTORS: u32 = 4;

impl Tape {
    /// Whether something on the tape may be narrow.
    pub fn may_be_narrow(&self) -> bool {
        let mut factors: Vec<Option<u32>> = Vec::with_capacity(self.len());
        for (slot, op) in self.ops.iter().enumerate() {
            let count = match self.stage(slot as Slot) {
                Stage::Varying => self.factors(*op, &factors).filter(|count| *count <= MOST_FACTORS),
                _ => Some(0),
            };
            factors.push(count);
        }
        factors.contains(&None)
    }

    /// How many factors that change a result has at most; `None` of what may be narrow.
    fn factors(&self, op: Op, known: &[Option<u32>]) -> Option<u32> {
        let of = |slot: Slot| known[slot as usize];
        match op {
            Op::State(_) | Op::Time => Some(1),
            Op::Exp(_) | Op::Log(_) | Op::Div(..) | Op::Pow { .. } => None,
            Op::Sinh { .. } | Op::Cosh { .. } | Op::Tan { .. } | Op::Tanh { .. } => None,
            Op::Atan { .. } | Op::Atan2 { .. } => None,
            Op::Sin { of: a, .. } | Op::Cos { of: a, .. } => of(a).map(|_| 1),
            Op::Mul(a, b) => Some(of(a)?.saturating_add(of(b)?)),
            Op::Square(a) => Some(of(a)?.saturating_mul(2)),
            _ => op.parts(self).into_iter().try_fold(0, |most, part| Some(of(part)?.max(most))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dimension, Expr, Layout, Symbol};

    #[test]
    fn high_powers_and_exponentials_may_be_narrow() {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        let layout = Layout::new(vec![symbol("x")], symbol("t"), vec![symbol("p")]);
        let may = |formula: fn(Expr, Expr) -> Expr| {
            let formula = formula(Expr::from(symbol("x")), Expr::from(symbol("p")));
            Tape::compile(&layout, &[formula]).expect("pure numbers").may_be_narrow()
        };
        assert!(may(|x, _| (-(&x * &x)).exp()));
        assert!(may(|x, _| 1 / (1 + &x * &x)));
        assert!(may(|x, _| x.cos().powi(60)));
        assert!(may(|x, p| (x * p).log()));
        assert!(!may(|x, p| x * p.exp() / (1 + &p * &p)));
        assert!(!may(|x, p| (3 * &x).sin() * x.powi(2) + p.powi(60)));
    }
}
