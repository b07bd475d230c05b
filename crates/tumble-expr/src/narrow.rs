//! Whether a formula may be narrow: change within a stretch that its coefficients beside it do not show.
//!
//! Exponentials and their like may, and quotients, and high powers: all coefficients of `cos(x)^60` up to the sixtieth are zero where
//! the cosine is. Low powers, products of what is zero in different places, sines and cosines are as steep everywhere as they are
//! somewhere.

use crate::ops::{Op, Slot};
use crate::tape::{Stage, Tape};

/// A power up to this is shown by its coefficients, which are always more.
const HIGHEST_POWER: u32 = 4;

/// A power of what is in a slot.
#[derive(Clone, Copy)]
struct Power {
    base: Slot,
    exponent: u32,
}

impl Tape {
    /// Whether something on the tape may be narrow.
    pub fn may_be_narrow(&self) -> bool {
        let mut powers: Vec<Power> = Vec::with_capacity(self.len());
        for (slot, op) in self.ops.iter().enumerate() {
            let own = Power { base: slot as Slot, exponent: 1 };
            let varies = self.stage(slot as Slot) == Stage::Varying;
            let power = if varies { power(*op, own, &powers) } else { Some(own) };
            match power.filter(|power| power.exponent <= HIGHEST_POWER) {
                Some(power) => powers.push(power),
                None => return true,
            }
        }
        false
    }
}

/// What power a result is; `None` of what may be narrow.
fn power(op: Op, own: Power, known: &[Power]) -> Option<Power> {
    let of = |slot: Slot| known[slot as usize];
    match op {
        Op::Exp(_) | Op::Log(_) | Op::Div(..) | Op::Pow { .. } => None,
        Op::Sinh { .. } | Op::Cosh { .. } | Op::Tan { .. } | Op::Tanh { .. } => None,
        Op::Atan { .. } | Op::Atan2 { .. } => None,
        Op::Neg(a) | Op::Scale { of: a, .. } | Op::Shrink { of: a, .. } => Some(of(a)),
        Op::Square(a) => Some(Power { exponent: 2 * of(a).exponent, ..of(a) }),
        Op::Mul(a, b) => {
            let (a, b) = (of(a), of(b));
            let higher = if a.exponent < b.exponent { b } else { a };
            let same = Power { exponent: a.exponent + b.exponent, ..a };
            Some(if a.base == b.base { same } else { higher })
        }
        _ => Some(own),
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
        assert!(may(|x, _| x.sin().powi(3) * x.sin().powi(3)));
        assert!(!may(|x, p| x.abs() * &x * x.sin() * x.cos() * (p * &x).cos()));
        assert!(!may(|x, p| (3 * &x).sin() * x.powi(2) + p.powi(60)));
    }
}
