//! Which results are polynomials in time, known from the tape alone.

use crate::ops::{Op, Slot};
use crate::{Stage, Tape};

/// Degree of a polynomial in time; `None` where the result is not known to be one.
pub type Degree = Option<u32>;

impl Tape {
    /// Degree of every output within one step, given each state's. (The time has degree 1 and branches are frozen.)
    ///
    /// # Panics
    /// If there are not as many degrees as states.
    pub fn degrees(&self, states: &[Degree]) -> Vec<Degree> {
        let slots = self.slot_degrees(states);
        self.outputs().iter().map(|slot| slots[*slot as usize]).collect()
    }

    /// Degrees of the outputs beyond the states' rates, of the guards of branches and of the arguments of tables.
    ///
    /// # Panics
    /// If there are not as many degrees as states.
    pub fn watched_degrees(&self, states: &[Degree]) -> Vec<Degree> {
        let slots = self.slot_degrees(states);
        let further = self.outputs().iter().skip(self.states());
        let arguments = self.tables().iter().map(|lookup| &lookup.of);
        further.chain(self.guards()).chain(arguments).map(|slot| slots[*slot as usize]).collect()
    }

    fn slot_degrees(&self, states: &[Degree]) -> Vec<Degree> {
        assert_eq!(states.len(), self.states(), "one degree a state");
        let mut degrees: Vec<Degree> = Vec::with_capacity(self.len());
        for (slot, op) in self.ops.iter().enumerate() {
            let degree = match op {
                Op::State(index) => states[*index as usize],
                _ if self.stage(slot as Slot) < Stage::Varying => Some(0),
                _ => self.degree(*op, &degrees),
            };
            degrees.push(degree);
        }
        degrees
    }

    fn degree(&self, op: Op, known: &[Degree]) -> Degree {
        let of = |slot: Slot| known[slot as usize];
        match op {
            Op::Time => Some(1),
            Op::Neg(a) | Op::Scale { of: a, .. } | Op::Shrink { of: a, .. } | Op::Abs { of: a, .. } => of(a),
            Op::Add(a, b) | Op::Sub(a, b) => Some(of(a)?.max(of(b)?)),
            Op::Choose { positive, negative, .. } => Some(of(positive)?.max(of(negative)?)),
            Op::Mul(a, b) => of(a)?.checked_add(of(b)?),
            Op::Square(a) => of(a)?.checked_mul(2),
            // Sums with factors that keep their value, if the matrix does: else its factors have no degree.
            Op::System(_) | Op::Unknown { .. } => {
                op.parts(self).into_iter().try_fold(0, |highest, part| Some(of(part)?.max(highest)))
            }
            Op::Sign { .. } | Op::Step { .. } | Op::Knot { .. } | Op::Coefficient { .. } => Some(0),
            _ => {
                let parts = op.parts(self);
                parts.into_iter().all(|part| of(part) == Some(0)).then_some(0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Dimension, Expr, Layout, Symbol};

    fn degree_of(formula: impl Fn(Expr, Expr, Expr) -> Expr) -> Degree {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        let layout = Layout::new(vec![symbol("x")], symbol("t"), vec![symbol("p")]);
        let leaf = |name: &str| Expr::from(symbol(name));
        let tape = Tape::compile(&layout, &[formula(leaf("x"), leaf("t"), leaf("p"))]).expect("pure numbers");
        tape.degrees(&[Some(2)])[0]
    }

    #[test]
    fn degrees_follow_the_operations() {
        assert_eq!(degree_of(|x, t, p| &x * &t * &p + x.powi(3) / p), Some(6));
        assert_eq!(degree_of(|_, _, p| p.sin()), Some(0));
        assert_eq!(degree_of(|x, _, _| x.abs() + (&x - 1).step()), Some(2));
        assert_eq!(degree_of(|x, _, _| x.sin()), None);
        assert_eq!(degree_of(|x, t, _| x / t), None);
        assert_eq!(degree_of(|x, t, _| Expr::norm(vec![x, t])), None);
    }

    #[test]
    fn a_system_is_a_polynomial_if_its_matrix_is_constant() {
        let solved = |a: Expr, b: Expr| {
            let matrix = vec![vec![a.clone(), Expr::from(1)], vec![Expr::from(1), a]];
            Expr::solve(matrix, vec![b, Expr::from(1)]).remove(1)
        };
        assert_eq!(degree_of(|x, t, p| solved(p, x * t)), Some(3));
        assert_eq!(degree_of(|x, t, p| solved(x.sign() * p, t)), Some(1));
        assert_eq!(degree_of(|x, t, _| solved(t, x)), None);
    }
}
