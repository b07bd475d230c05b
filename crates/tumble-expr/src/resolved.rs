//! A tape resolved for running: kernels that work on whole series, in the order in which they are run.
//!
//! Sums of multiples are one kernel, in the order in which the tape has them, so that every scalar finds the same bits as operation
//! by operation; sine and cosine are found in one pass; `k a_k`, which the functions known by their derivative need, is kept in a row
//! of its own, and so is the square of a length. All else is a kernel of one operation.

use std::ops::Range;

use crate::ops::solve::System;
use crate::ops::{Op, Slot};
use crate::{Stage, Tape};

/// What is run at once. Rows are slots of the tape, or come after them.
#[derive(Clone, Debug)]
pub(crate) enum Kernel {
    /// A sum of multiples, by a range of the terms.
    Sum(Range<u32>),
    Product(Slot, Slot),
    Square(Slot),
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
    /// `c' = a' g` with the slope of a.
    Along {
        op: Op,
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
    /// Slots that are terms of one sum and nothing else.
    is_merged: Vec<bool>,
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
        self.resolved
    }

    fn kernel(&mut self, slot: Slot, op: Op) -> Kernel {
        match op {
            op if is_linear(op) => self.sum(slot),
            Op::Mul(a, b) => Kernel::Product(a, b),
            Op::Square(a) => Kernel::Square(a),
            Op::Sin { of, cos } => {
                self.is_done[cos as usize] = true;
                Kernel::Wave { of, slope: self.slope(of), cos, is_linear: is_linear_in_time(self.tape, of) }
            }
            Op::Exp(of) => Kernel::Along { op, slope: self.slope(of), factor: slot },
            Op::Sinh { of, cosh } => Kernel::Along { op, slope: self.slope(of), factor: cosh },
            Op::Cosh { of, sinh } => Kernel::Along { op, slope: self.slope(of), factor: sinh },
            Op::Tan { of, slope } | Op::Tanh { of, slope } => {
                Kernel::Along { op, slope: self.slope(of), factor: slope }
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

    /// The terms of a slot in the order in which the tape adds them: what is merged on the left comes first.
    fn sum(&mut self, slot: Slot) -> Kernel {
        let first = self.resolved.terms.len();
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
        self.resolved.terms.extend(last_first.into_iter().rev());
        Kernel::Sum(first as u32..self.resolved.terms.len() as u32)
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

fn is_linear(op: Op) -> bool {
    is_multiple(op) || matches!(op, Op::Add(..) | Op::Sub(..))
}

/// Which operations become terms of what reads them.
type Merges = fn(Op) -> bool;

/// Which slots are nothing but terms of the sum after them: multiples, and sums on its left; or multiples that change their sign.
fn merged(tape: &Tape) -> Vec<bool> {
    let uses = uses(tape);
    let mut merged = vec![false; tape.len()];
    for (_, op) in tape.varying() {
        let parts: &[(Slot, Merges)] = match op {
            Op::Add(left, right) | Op::Sub(left, right) => &[(left, is_linear), (right, is_multiple)],
            Op::Neg(of) => &[(of, is_multiple)],
            _ => continue,
        };
        for &(part, merges) in parts {
            let op = tape.ops()[part as usize];
            let is_varying = tape.stage(part) == Stage::Varying;
            merged[part as usize] = is_varying && uses[part as usize] == 1 && merges(op);
        }
    }
    merged
}

/// How often each slot is used, what is read of the tape from outside included.
fn uses(tape: &Tape) -> Vec<u32> {
    let mut uses = vec![0; tape.len()];
    let parts = tape.varying().flat_map(|(_, op)| op.parts(tape));
    let read = tape.outputs().iter().chain(tape.guards()).copied();
    for slot in parts.chain(read).chain(tape.tables().iter().map(|lookup| lookup.of)) {
        uses[slot as usize] += 1;
    }
    uses
}

/// Whether a slot is a multiple of the time and what does not change with it.
fn is_linear_in_time(tape: &Tape, slot: Slot) -> bool {
    let (mut pending, mut seen) = (vec![slot], vec![false; tape.len()]);
    while let Some(slot) = pending.pop() {
        if std::mem::replace(&mut seen[slot as usize], true) || tape.stage(slot) != Stage::Varying {
            continue;
        }
        match tape.ops()[slot as usize] {
            Op::Time => {}
            Op::Neg(a) | Op::Scale { of: a, .. } | Op::Shrink { of: a, .. } => pending.push(a),
            Op::Add(a, b) | Op::Sub(a, b) => pending.extend([a, b]),
            _ => return false,
        }
    }
    true
}
