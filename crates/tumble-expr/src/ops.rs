//! The operations of a tape, and what each does to values and to Taylor coefficients.
//!
//! Coefficients are normalised: the series of `a` is `a_0 + a_1 s + a_2 s^2 + ...`. Each family of operations has a
//! file with its recurrences: the coefficient of order `k >= 1` from all lower ones of the result and those up to `k` of
//! its parts. In every sum the terms of lowest order of the result come first and order 0 is split off.

pub(crate) mod amplified;
pub(crate) mod arithmetic;
pub(crate) mod branch;
pub(crate) mod elimination;
pub(crate) mod enclosed;
pub(crate) mod integral;
pub(crate) mod kernels;
pub(crate) mod norm;
pub(crate) mod power;
mod recurrences;
pub(crate) mod running;
pub(crate) mod solve;
pub(crate) mod square_over;

use smallvec::{SmallVec, smallvec};

use crate::Tape;
use crate::arena::Arena;
use crate::ops::kernels::Kernels;
use crate::ops::solve::{Matrix, System};
use crate::table::Table;

/// Where an operation's result stands: its index on the tape.
pub type Slot = u32;

/// What an operation is made of.
pub(crate) type Parts = SmallVec<[Slot; 4]>;

/// One operation of a tape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Op {
    /// A state, by its index.
    State(u32),
    Time,
    /// A parameter, by its index.
    Input(u32),
    /// An exact number, by its index in the tape's list.
    Number(u32),
    Pi,
    Neg(Slot),
    Add(Slot, Slot),
    Sub(Slot, Slot),
    Mul(Slot, Slot),
    /// `of` times something that does not change with time.
    Scale {
        of: Slot,
        by: Slot,
    },
    Div(Slot, Slot),
    /// `of` divided by something that does not change with time.
    Shrink {
        of: Slot,
        by: Slot,
    },
    Square(Slot),
    Sqrt(Slot),
    Pow {
        of: Slot,
        exponent: Slot,
    },
    Exp(Slot),
    Log(Slot),
    Sin {
        of: Slot,
        cos: Slot,
    },
    Cos {
        of: Slot,
        sin: Slot,
    },
    Sinh {
        of: Slot,
        cosh: Slot,
    },
    Cosh {
        of: Slot,
        sinh: Slot,
    },
    /// With the slot of 1 + tan^2.
    Tan {
        of: Slot,
        slope: Slot,
    },
    /// With the slot of 1 - tanh^2.
    Tanh {
        of: Slot,
        slope: Slot,
    },
    /// With the slot of sqrt(1 - of^2).
    Asin {
        of: Slot,
        root: Slot,
    },
    /// With the slot of sqrt(1 - of^2).
    Acos {
        of: Slot,
        root: Slot,
    },
    /// With the slot of 1 + of^2.
    Atan {
        of: Slot,
        square: Slot,
    },
    /// With the slot of x^2 + y^2.
    Atan2 {
        y: Slot,
        x: Slot,
        square: Slot,
    },
    /// Sign of the branch times `of`.
    Abs {
        of: Slot,
        branch: u32,
    },
    Sign {
        of: Slot,
        branch: u32,
    },
    Step {
        branch: u32,
    },
    Choose {
        branch: u32,
        positive: Slot,
        negative: Slot,
    },
    /// Where the segment of a measured function of `of` counts from.
    Knot {
        lookup: u32,
        of: Slot,
    },
    /// A coefficient of the segment's polynomial.
    Coefficient {
        lookup: u32,
        of: Slot,
        power: u32,
    },
    /// Length of the vector whose components are in the tape's list.
    Norm(u32),
    /// `of^2 / by`; the last is its index in the tape's list of functions that vanish.
    SquareOver {
        of: Slot,
        by: Slot,
        vanishing: u32,
    },
    /// The triangular factors of a matrix, by its index on the tape. They stand in a list of the evaluator's.
    Factor(u32),
    /// A linear system, by its index on the tape. Its unknowns, which follow it, are found together.
    System(u32),
    /// An unknown of a linear system.
    Unknown {
        system: Slot,
        row: u32,
    },
}

/// Series of every slot, as far as they are known.
pub struct Series<'a, S> {
    pub(crate) arena: &'a Arena<S>,
    /// +1 or -1 a branch, then the segment of each measured function.
    pub(crate) signs: &'a [S],
    pub(crate) tape: &'a Tape,
    /// The factors of every matrix, from its offset on.
    pub(crate) factors: &'a [S],
    /// Which lengths and quotients have an argument that is zero at the point of expansion, whatever rounding has left.
    pub(crate) vanishing: &'a [bool],
    /// Of an interval of places, how far they are from where those arguments are zero.
    pub(crate) elapsed: S,
}

impl<'a, S: Kernels> Series<'a, S> {
    pub(crate) fn of(&self, slot: Slot) -> &'a [S] {
        self.arena.row(slot)
    }

    pub(crate) fn first(&self, slot: Slot) -> S {
        self.arena.at(slot, 0)
    }

    /// Value of an operation whose parts are evaluated. Leaves and numbers are set by the evaluator.
    pub(crate) fn value(&self, op: Op) -> S {
        let at = |slot| self.first(slot);
        match op {
            Op::State(_) | Op::Time | Op::Input(_) | Op::Number(_) | Op::Pi => {
                unreachable!("the evaluator sets leaves and numbers itself")
            }
            Op::Neg(a) => -at(a),
            Op::Add(a, b) => at(a) + at(b),
            Op::Sub(a, b) => at(a) - at(b),
            Op::Mul(a, b) | Op::Scale { of: a, by: b } => at(a) * at(b),
            Op::Div(a, b) | Op::Shrink { of: a, by: b } => at(a) / at(b),
            Op::Square(a) => at(a).square(),
            Op::Sqrt(a) => at(a).sqrt(),
            Op::Pow { of, exponent } => at(of).pow(at(exponent)),
            Op::Exp(a) => at(a).exp(),
            Op::Log(a) => at(a).log(),
            Op::Sin { of, .. } => at(of).sin(),
            Op::Cos { of, .. } => at(of).cos(),
            Op::Sinh { of, .. } => at(of).sinh(),
            Op::Cosh { of, .. } => at(of).cosh(),
            Op::Tan { of, .. } => at(of).tan(),
            Op::Tanh { of, .. } => at(of).tanh(),
            Op::Asin { of, .. } => at(of).asin(),
            Op::Acos { of, .. } => at(of).acos(),
            Op::Atan { of, .. } => at(of).atan(),
            Op::Atan2 { y, x, .. } => at(y).atan2(at(x)),
            Op::Abs { of, branch } => self.sign(branch) * at(of),
            Op::Sign { branch, .. } => self.sign(branch),
            Op::Step { branch } => branch::step(self.sign(branch)),
            Op::Choose { branch, positive, negative } => self.sign(branch).choose(at(positive), at(negative)),
            Op::Knot { lookup, .. } => self.segment(lookup, Table::origin),
            Op::Coefficient { lookup, power, .. } => {
                self.segment(lookup, |table, segment| table.coefficient(segment, power as usize))
            }
            Op::Norm(parts) => S::norm(self, parts),
            Op::SquareOver { of, by, vanishing } => S::square_over(self, (of, by, vanishing)),
            Op::Factor(_) | Op::System(_) => S::zero(),
            // It was put there with the others of its system.
            Op::Unknown { system, row } => at(system + 1 + row),
        }
    }

    /// Coefficient of order `k >= 1` of an operation that has no kernel of its own, whose result stands in `slot`.
    pub(crate) fn coefficient(&self, op: Op, slot: Slot, k: usize) -> S {
        let a = |slot| self.of(slot);
        let c = self.of(slot);
        match op {
            Op::Pow { of, exponent } => power::power(a(of), self.first(exponent), c, k),
            Op::Log(x) => integral::against(a(x)[k], a(x), c, k),
            Op::Asin { of, root } => integral::against(a(of)[k], a(root), c, k),
            Op::Acos { of, root } => integral::against(-a(of)[k], a(root), c, k),
            Op::Atan { of, square } => integral::against(a(of)[k], a(square), c, k),
            Op::Atan2 { y, x, square } => {
                c[0].smooth(integral::against(integral::sweep(a(x), a(y), k), a(square), c, k))
            }
            Op::Abs { of, branch } => self.sign(branch) * a(of)[k],
            Op::Choose { branch, positive, negative } => {
                self.sign(branch).choose(a(positive)[k], a(negative)[k])
            }
            Op::SquareOver { of, by, vanishing } => {
                S::square_over_coefficient(self, (of, by, vanishing), c, k)
            }
            // Constant along a step, or found by a kernel.
            _ => S::zero(),
        }
    }

    pub(crate) fn matrix(&self, system: &System) -> &'a Matrix {
        &self.tape.matrices[system.matrix as usize]
    }

    pub(crate) fn factors_of(&self, system: &System) -> &'a [S] {
        let matrix = self.matrix(system);
        &self.factors[matrix.offset..][..matrix.plan.room]
    }

    fn sign(&self, branch: u32) -> S {
        self.signs[branch as usize]
    }

    /// Something of the segment that holds, lane by lane.
    fn segment(&self, lookup: u32, of: impl Fn(&Table, usize) -> f64) -> S {
        let table = &self.tape.tables[lookup as usize].table.0;
        self.signs[self.tape.guards.len() + lookup as usize].of_segment(|segment| of(table, segment))
    }
}

impl Op {
    /// The branch this operation takes its side from.
    pub(crate) fn branch(self) -> Option<u32> {
        match self {
            Self::Abs { branch, .. } | Self::Sign { branch, .. } => Some(branch),
            Self::Step { branch } | Self::Choose { branch, .. } => Some(branch),
            _ => None,
        }
    }

    /// Whether this is one of [`crate::Tape::turnings`], where it changes with time.
    pub(crate) fn turns(self) -> bool {
        matches!(self, Self::Norm(_) | Self::SquareOver { .. } | Self::Sqrt(_) | Self::Pow { .. })
    }

    /// The measured function this operation belongs to.
    pub(crate) fn lookup(self) -> Option<u32> {
        match self {
            Self::Knot { lookup, .. } | Self::Coefficient { lookup, .. } => Some(lookup),
            _ => None,
        }
    }

    /// The slots this operation must come after.
    pub(crate) fn parts(self, tape: &Tape) -> Parts {
        match self {
            Self::State(_) | Self::Time | Self::Input(_) | Self::Number(_) | Self::Pi => smallvec![],
            Self::Neg(a) | Self::Square(a) | Self::Sqrt(a) | Self::Exp(a) | Self::Log(a) => smallvec![a],
            Self::Sin { of, .. } | Self::Cos { of, .. } | Self::Sinh { of, .. } | Self::Cosh { of, .. } => {
                smallvec![of]
            }
            Self::Tan { of, .. } | Self::Tanh { of, .. } => smallvec![of],
            Self::Asin { of: a, root: b } | Self::Acos { of: a, root: b } => smallvec![a, b],
            Self::Atan { of: a, square: b } | Self::Pow { of: a, exponent: b } => smallvec![a, b],
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) => smallvec![a, b],
            Self::Scale { of: a, by: b } | Self::Shrink { of: a, by: b } => smallvec![a, b],
            Self::SquareOver { of, by, .. } => smallvec![of, by],
            Self::Atan2 { y, x, square } => smallvec![y, x, square],
            Self::Abs { of, .. } | Self::Sign { of, .. } => smallvec![of],
            Self::Knot { of, .. } | Self::Coefficient { of, .. } => smallvec![of],
            Self::Step { branch } => smallvec![tape.guards[branch as usize]],
            Self::Choose { branch, positive, negative } => {
                smallvec![tape.guards[branch as usize], positive, negative]
            }
            Self::Norm(parts) => Parts::from_slice(&tape.norms[parts as usize]),
            Self::Factor(matrix) => Parts::from_slice(&tape.matrices[matrix as usize].entries),
            Self::System(system) => tape.systems[system as usize].parts(),
            Self::Unknown { system, .. } => smallvec![system],
        }
    }
}
