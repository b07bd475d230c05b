//! A tape resolved for running: kernels that work on whole series, in the order in which they are run.
//!
//! Sums of multiples, and multiples of sums, are one kernel, in the order in which the tape has them, so that every scalar finds the
//! same bits as operation by operation; `a |a|` is a square with the sign of its branch; sine and cosine are found in one pass; `k a_k`,
//! which the functions known by their derivative need, is kept in a row of its own, and so is the square of a length. All else is a kernel
//! of one operation. What a step takes is the instructions of its kernels, so few of them are fast.

use std::ops::Range;

use crate::ops::solve::System;
use crate::ops::{Op, Slot};
use crate::{Stage, Tape};

/// What is run at once. Rows are slots of the tape, or come after them.
#[derive(Clone, Debug)]
pub(crate) enum Kernel {
    /// A sum of multiples.
    Sum(Sum),
    Product(Slot, Slot),
    Square(Slot),
    /// `a |a|`.
    Directed {
        of: Slot,
        branch: u32,
    },
    /// `k a_k`.
    Slope(Slot),
    /// Sine, and cosine in the other row, of what has that slope.
    Wave {
        of: Slot,
        slope: Slot,
        cos: Slot,
        /// Whether its argument is a multiple of the time.
        is_linear: bool,
    },
    /// `c' = a' g`, with the slope of a.
    Along {
        op: Op,
        of: Slot,
        slope: Slot,
        factor: Slot,
    },
    Quotient(Slot, Slot),
    Root(Slot),
    /// A length, by its index on the tape; its square is kept in the other row.
    Norm {
        parts: u32,
        square: Slot,
    },
    /// What has the sign of a branch.
    Abs {
        of: Slot,
        branch: u32,
    },
    /// A linear system, by its index on the tape: all its unknowns.
    System(u32),
    /// Any other operation.
    Other(Op),
}

/// A sum of multiples, by ranges of the terms.
#[derive(Clone, Debug)]
pub(crate) struct Sum {
    /// Its value.
    pub(crate) value: Range<u32>,
    /// Its coefficients of other orders, to which constants add nothing.
    pub(crate) change: Range<u32>,
    /// What all of it is multiplied with or divided by.
    pub(crate) then: By,
}

/// One term of a sum.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    pub(crate) of: Slot,
    /// What it is multiplied with or divided by, which does not change with time.
    pub(crate) by: By,
    pub(crate) is_taken: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum By {
    One,
    Times(Slot),
    Over(Slot),
}

/// The kernels of what changes with time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Resolved {
    pub(crate) kernels: Vec<(Slot, Kernel)>,
    /// How many of them, the first ones, are linear in the time.
    pub(crate) linear: usize,
    pub(crate) terms: Vec<Term>,
    /// How many rows there are: slots, and what is kept besides.
    pub(crate) rows: usize,
    /// Row of the square of each length of the tape.
    pub(crate) squares: Vec<Slot>,
}

impl Resolved {
    pub(crate) fn of(tape: &Tape) -> Self {
        Resolving::new(tape).run()
    }
}

struct Resolving<'a> {
    tape: &'a Tape,
    resolved: Resolved,
    /// Slots that are part of one other kernel and nothing else.
    is_merged: Vec<bool>,
    /// Slots that are linear in the time.
    is_linear: Vec<bool>,
    /// Slots that are found together with another.
    is_done: Vec<bool>,
    /// Rows of slopes by slot.
    slopes: Vec<Option<Slot>>,
}

impl<'a> Resolving<'a> {
    fn new(tape: &'a Tape) -> Self {
        let slots = tape.len();
        let squares = vec![Slot::MAX; tape.norms()];
        let resolved = Resolved { rows: slots, squares, ..Resolved::default() };
        Self {
            tape,
            resolved,
            is_merged: merged(tape),
            is_linear: linear_in_time(tape),
            is_done: vec![false; slots],
            slopes: vec![None; slots],
        }
    }

    fn run(mut self) -> Resolved {
        for (slot, op) in self.tape.varying() {
            if !self.is_merged[slot as usize] && !self.is_done[slot as usize] {
                let kernel = self.kernel(slot, op);
                self.resolved.kernels.push((slot, kernel));
            }
        }
        self.linear_first();
        self.resolved
    }

    /// They depend on nothing but each other.
    fn linear_first(&mut self) {
        let is_linear = |(slot, kernel): &(Slot, Kernel)| match kernel {
            Kernel::Slope(of) => self.is_linear[*of as usize],
            _ => self.is_linear.get(*slot as usize).is_some_and(|is_linear| *is_linear),
        };
        let kernels = std::mem::take(&mut self.resolved.kernels);
        let (mut linear, others): (Vec<_>, Vec<_>) = kernels.into_iter().partition(is_linear);
        self.resolved.linear = linear.len();
        linear.extend(others);
        self.resolved.kernels = linear;
    }

    fn kernel(&mut self, slot: Slot, op: Op) -> Kernel {
        match op {
            op if is_linear(op) => self.sum(slot),
            Op::Mul(a, b) => self.directed(a, b).unwrap_or(Kernel::Product(a, b)),
            Op::Square(a) => Kernel::Square(a),
            Op::Sin { of, cos } => {
                self.is_done[cos as usize] = true;
                Kernel::Wave { of, slope: self.slope(of), cos, is_linear: self.is_linear[of as usize] }
            }
            Op::Exp(of) => Kernel::Along { op, of, slope: self.slope(of), factor: slot },
            Op::Sinh { of, cosh } => Kernel::Along { op, of, slope: self.slope(of), factor: cosh },
            Op::Cosh { of, sinh } => Kernel::Along { op, of, slope: self.slope(of), factor: sinh },
            Op::Tan { of, slope } | Op::Tanh { of, slope } => {
                Kernel::Along { op, of, slope: self.slope(of), factor: slope }
            }
            Op::Div(a, b) => Kernel::Quotient(a, b),
            Op::Sqrt(a) => Kernel::Root(a),
            Op::Norm(parts) => {
                let square = self.row();
                self.resolved.squares[parts as usize] = square;
                Kernel::Norm { parts, square }
            }
            Op::SquareOver { by, vanishing, .. } => {
                let square = self.row();
                self.resolved.squares[vanishing as usize] = square;
                self.resolved.kernels.push((square, Kernel::Square(by)));
                Kernel::Other(op)
            }
            Op::Abs { of, branch } => Kernel::Abs { of, branch },
            Op::System(system) => {
                let System { unknowns, right, .. } = &self.tape.systems[system as usize];
                self.is_done[*unknowns as usize..][..right.len()].fill(true);
                Kernel::System(system)
            }
            op => Kernel::Other(op),
        }
    }

    fn row(&mut self) -> Slot {
        self.resolved.rows += 1;
        self.resolved.rows as Slot - 1
    }

    /// The row of `k a_k`, made where it is first needed.
    fn slope(&mut self, of: Slot) -> Slot {
        if let Some(row) = self.slopes[of as usize] {
            return row;
        }
        let row = self.row();
        self.slopes[of as usize] = Some(row);
        self.resolved.kernels.push((row, Kernel::Slope(of)));
        row
    }

    fn directed(&self, a: Slot, b: Slot) -> Option<Kernel> {
        let abs = [a, b].into_iter().find(|part| self.is_merged[*part as usize])?;
        match self.tape.ops()[abs as usize] {
            Op::Abs { of, branch } => Some(Kernel::Directed { of, branch }),
            _ => None,
        }
    }

    fn sum(&mut self, slot: Slot) -> Kernel {
        let (of, then) = match self.tape.ops()[slot as usize] {
            Op::Scale { of, by } if self.is_merged[of as usize] => (of, By::Times(by)),
            Op::Shrink { of, by } if self.is_merged[of as usize] => (of, By::Over(by)),
            _ => (slot, By::One),
        };
        let all = self.terms(of);
        let changing: Vec<Term> =
            all.iter().filter(|term| self.tape.stage(term.of) == Stage::Varying).copied().collect();
        let is_same = changing.len() == all.len();
        let value = self.keep(all);
        let change = if is_same { value.clone() } else { self.keep(changing) };
        Kernel::Sum(Sum { value, change, then })
    }

    fn keep(&mut self, terms: Vec<Term>) -> Range<u32> {
        let first = self.resolved.terms.len() as u32;
        self.resolved.terms.extend(terms);
        first..self.resolved.terms.len() as u32
    }

    /// The terms of a slot in the order in which the tape adds them: what is merged on the left comes first.
    fn terms(&self, slot: Slot) -> Vec<Term> {
        let mut next = slot;
        let mut last_first = vec![];
        loop {
            let (left, right, is_taken) = match self.tape.ops()[next as usize] {
                Op::Add(a, b) => (a, b, false),
                Op::Sub(a, b) => (a, b, true),
                _ => break last_first.push(self.multiple(next, false)),
            };
            last_first.push(match self.is_merged[right as usize] {
                true => self.multiple(right, is_taken),
                false => Term { of: right, by: By::One, is_taken },
            });
            if !self.is_merged[left as usize] {
                break last_first.push(Term { of: left, by: By::One, is_taken: false });
            }
            next = left;
        }
        last_first.reverse();
        last_first
    }

    /// A slot that is a multiple of another, as a term.
    fn multiple(&self, slot: Slot, is_taken: bool) -> Term {
        match self.tape.ops()[slot as usize] {
            Op::Neg(of) if self.is_merged[of as usize] => self.multiple(of, !is_taken),
            Op::Neg(of) => Term { of, by: By::One, is_taken: !is_taken },
            Op::Scale { of, by } => Term { of, by: By::Times(by), is_taken },
            Op::Shrink { of, by } => Term { of, by: By::Over(by), is_taken },
            _ => Term { of: slot, by: By::One, is_taken },
        }
    }
}

fn is_multiple(op: Op) -> bool {
    matches!(op, Op::Neg(_) | Op::Scale { .. } | Op::Shrink { .. })
}

fn is_addition(op: Op) -> bool {
    matches!(op, Op::Add(..) | Op::Sub(..))
}

fn is_linear(op: Op) -> bool {
    is_multiple(op) || is_addition(op)
}

/// Which operations become part of what reads them.
type Merges = fn(Op) -> bool;

/// Which slots are nothing but part of one other: multiples, and sums on its left, of a sum; the absolute value of the other factor; and
/// sums of a multiple that is not itself part of a sum.
fn merged(tape: &Tape) -> Vec<bool> {
    let uses = uses(tape);
    let is_single = |slot: Slot| tape.stage(slot) == Stage::Varying && uses[slot as usize] == 1;
    let mut merged = vec![false; tape.len()];
    for (_, op) in tape.varying() {
        let parts: &[(Slot, Merges)] = match op {
            Op::Add(left, right) | Op::Sub(left, right) => &[(left, is_linear), (right, is_multiple)],
            Op::Neg(of) => &[(of, is_multiple)],
            Op::Mul(a, b) => {
                let is_size = |part: Slot, other: Slot| matches!(tape.ops()[part as usize], Op::Abs { of, .. } if of == other);
                for part in [(a, b), (b, a)].into_iter().filter(|(part, other)| is_size(*part, *other)) {
                    merged[part.0 as usize] = is_single(part.0);
                }
                continue;
            }
            _ => continue,
        };
        for &(part, merges) in parts {
            merged[part as usize] = is_single(part) && merges(tape.ops()[part as usize]);
        }
    }
    for (slot, op) in tape.varying() {
        if let (Op::Scale { of, .. } | Op::Shrink { of, .. }, false) = (op, merged[slot as usize]) {
            merged[of as usize] = is_single(of) && is_addition(tape.ops()[of as usize]);
        }
    }
    merged
}

/// How often each slot is used, by a function that is known by it and by what reads the tape from outside included.
fn uses(tape: &Tape) -> Vec<u32> {
    let mut uses = vec![0; tape.len()];
    let parts = tape.varying().flat_map(|(_, op)| op.parts(tape));
    let slopes = tape.varying().filter_map(|(_, op)| match op {
        Op::Tan { slope, .. } | Op::Tanh { slope, .. } => Some(slope),
        _ => None,
    });
    let read = tape.outputs().iter().chain(tape.guards()).copied();
    for slot in parts.chain(slopes).chain(read).chain(tape.tables().iter().map(|lookup| lookup.of)) {
        uses[slot as usize] += 1;
    }
    uses
}

/// Which slots are a multiple of the time and what does not change with it.
fn linear_in_time(tape: &Tape) -> Vec<bool> {
    let mut linear = vec![false; tape.len()];
    for slot in 0..tape.len() {
        linear[slot] = tape.stage(slot as Slot) != Stage::Varying
            || match tape.ops()[slot] {
                Op::Time => true,
                Op::Neg(a) | Op::Scale { of: a, .. } | Op::Shrink { of: a, .. } => linear[a as usize],
                Op::Add(a, b) | Op::Sub(a, b) => linear[a as usize] && linear[b as usize],
                _ => false,
            };
    }
    linear
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crate::{Branches, Dimension, Expr, Jets, Layout, Symbol, Tape, Unary};

    /// Coefficients of order 0 to 2 of formulas of the time about 0.4, of which only the first is read.
    fn series(formulas: &[Expr], t: Symbol) -> Vec<f64> {
        let tape = Tape::compile(&Layout::new(vec![], t, vec![]), formulas).expect("typed");
        let mut jets = Jets::new(Arc::new(tape), 2, &[]);
        jets.set_time_is_parameter(true);
        jets.start(0.4, &[], Branches::Free);
        jets.set(0, 1, 1.0);
        jets.extend(1);
        jets.set(0, 2, 0.0);
        jets.extend(2);
        jets.output(0).to_vec()
    }

    #[test]
    fn what_a_function_is_known_by_stays_beside_a_sum_that_reads_it() {
        let time = Symbol::new("t", Dimension::NONE);
        let t = Expr::from(time.clone());
        let tanh = Expr::unary(Unary::Tanh, &t * 3);
        let slope = 1 - &tanh * &tanh;
        let alone = series(std::slice::from_ref(&tanh), time.clone());
        for other in [&slope * 2, &slope + &t, &slope - 5] {
            assert_eq!(series(&[tanh.clone(), other], time.clone()), alone);
        }
    }

    #[test]
    fn a_square_with_a_sign_is_a_product() {
        let time = Symbol::new("t", Dimension::NONE);
        let t = Expr::from(time.clone());
        for side in [-1, 1] {
            let u = (side * &t).sin();
            let own = series(&[u.abs() * &u], time.clone());
            let product = series(&[&u * &u], time.clone());
            let signed: Vec<f64> = product.iter().map(|c| f64::from(side) * c).collect();
            assert_eq!(own, signed);
        }
    }
}
