//! A straight line of operations: what evaluators run.

use thiserror::Error;

use crate::expr::Symbol;
use crate::lower::Lowering;
use crate::ops::solve::{Matrix, System};
use crate::ops::{Op, Slot};
use crate::resolved::Resolved;
use crate::rounding::{Constant, Rounding};
use crate::table::TableRef;
use crate::{Expr, Graph, Kind, TypeError};

/// Which symbols are leaves, and in which order their values are given.
#[derive(Clone, Debug)]
pub struct Layout {
    /// What changes with time and has a derivative.
    pub states: Vec<Symbol>,
    /// The independent variable.
    pub time: Symbol,
    /// Parameters: fixed during a run, never folded into the tape.
    pub inputs: Vec<Symbol>,
    /// How numbers that no `f64` is are rounded.
    pub rounding: Rounding,
}

impl Layout {
    /// Leaves in that order, and numbers rounded to the nearest.
    pub fn new(states: Vec<Symbol>, time: Symbol, inputs: Vec<Symbol>) -> Self {
        Self { states, time, inputs, rounding: Rounding::NEAREST }
    }
}

/// Why formulas cannot become a tape.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CompileError {
    /// A formula's parts do not fit together.
    #[error(transparent)]
    Type(#[from] TypeError),
    /// A symbol is neither a state, nor the time, nor an input.
    #[error("`{0}` has no value here")]
    UnknownSymbol(String),
    /// A comparison where a number is asked for.
    #[error("a comparison cannot be an output: use if(condition, 1, 0)")]
    TruthAsOutput,
}

/// When the result of an operation changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Never.
    Constant,
    /// From run to run, with the inputs.
    Uniform,
    /// With time.
    Varying,
}

/// Formulas as a straight line of operations, each using results that come before it.
///
/// The first slots are the leaves: all states in the layout's order, then the time, then all inputs.
#[derive(Clone, Debug)]
pub struct Tape {
    pub(crate) ops: Vec<Op>,
    pub(crate) stages: Vec<Stage>,
    pub(crate) numbers: Vec<Constant>,
    /// pi, rounded.
    pub(crate) pi: f64,
    /// Vectors whose lengths are taken, and denominators that may vanish with their numerators.
    pub(crate) norms: Vec<Vec<Slot>>,
    /// Guard slot of each branch.
    pub(crate) guards: Vec<Slot>,
    /// Measured functions, each with its argument.
    pub(crate) tables: Vec<Lookup>,
    /// Matrices of linear systems.
    pub(crate) matrices: Vec<Matrix>,
    pub(crate) systems: Vec<System>,
    pub(crate) outputs: Vec<Slot>,
    /// Names of the leaves.
    pub(crate) names: Vec<String>,
    pub(crate) states: usize,
    pub(crate) inputs: usize,
    /// How it is run.
    pub(crate) resolved: Resolved,
}

/// A measured function with the slot of its argument.
#[derive(Clone, Debug)]
pub struct Lookup {
    /// The function.
    pub table: TableRef,
    /// Slot of its argument.
    pub of: Slot,
}

/// A function that is not smooth where its argument is zero but may pass close by: its series does not show how close.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Turning {
    /// Length of a vector whose components are in these slots: near zero its square turns.
    Norm {
        /// Slots of the components.
        parts: Vec<Slot>,
        /// Index for [`crate::Jets::set_vanishing`].
        index: usize,
    },
    /// A root or power of a slot.
    Power {
        /// Its slot.
        of: Slot,
    },
}

impl Tape {
    /// Compiles formulas that share a layout; the order of `outputs` is kept.
    pub fn compile(layout: &Layout, outputs: &[Expr]) -> Result<Self, CompileError> {
        check(outputs)?;
        let mut graph = Graph::default();
        let outputs = graph.import(outputs);
        Lowering::new(layout).lower(&graph, &outputs)
    }

    /// The same with numbers rounded in another way.
    #[must_use]
    pub fn rounded(&self, rounding: Rounding) -> Self {
        let mut tape = self.clone();
        tape.numbers.iter_mut().for_each(|number| *number = number.rounded(rounding));
        tape.pi = rounding.pi();
        tape
    }

    /// How many operations there are, leaves included.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Whether nothing is computed.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// The operations in order.
    pub fn ops(&self) -> &[Op] {
        &self.ops
    }

    /// How many states the layout has.
    pub fn states(&self) -> usize {
        self.states
    }

    /// How many inputs the layout has.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Where the outputs stand.
    pub fn outputs(&self) -> &[Slot] {
        &self.outputs
    }

    /// Slot of the time.
    pub fn time_slot(&self) -> Slot {
        self.states as Slot
    }

    /// Slots whose signs choose branches (abs, sign, step, min, max, if).
    pub fn guards(&self) -> &[Slot] {
        &self.guards
    }

    /// Whether a slot holds the literal zero.
    pub fn is_zero(&self, slot: Slot) -> bool {
        match self.ops[slot as usize] {
            Op::Number(index) => self.numbers[index as usize].value == 0.0,
            _ => false,
        }
    }

    /// Lengths, roots and powers of what changes with time.
    pub fn turnings(&self) -> Vec<Turning> {
        let turning = |op: Op| match op {
            Op::Norm(index) => {
                Some(Turning::Norm { parts: self.norms[index as usize].clone(), index: index as usize })
            }
            Op::SquareOver { vanishing, .. } => Some(Turning::Norm {
                parts: self.norms[vanishing as usize].clone(),
                index: vanishing as usize,
            }),
            Op::Sqrt(of) | Op::Pow { of, .. } => Some(Turning::Power { of }),
            _ => None,
        };
        self.varying().filter_map(|(_, op)| turning(op)).collect()
    }

    pub(crate) fn resolved(&self) -> &Resolved {
        &self.resolved
    }

    /// How many norms there are, those of inputs included.
    pub fn norms(&self) -> usize {
        self.norms.len()
    }

    /// Measured functions, each with the slot of its argument. Their segments follow the branches' sides.
    pub fn tables(&self) -> &[Lookup] {
        &self.tables
    }

    /// How many sides there are: one a branch, then one a measured function.
    pub fn sides(&self) -> usize {
        self.guards.len() + self.tables.len()
    }

    /// When the result in a slot changes.
    pub fn stage(&self, slot: Slot) -> Stage {
        self.stages[slot as usize]
    }

    /// Operations that change with time, in order, leaves excluded.
    pub(crate) fn varying(&self) -> impl Iterator<Item = (Slot, Op)> {
        self.at_stage(|stage| stage == Stage::Varying)
    }

    /// Operations that do not change with time, in order, leaves excluded.
    pub(crate) fn prologue(&self) -> impl Iterator<Item = (Slot, Op)> {
        self.at_stage(|stage| stage < Stage::Varying)
    }

    fn at_stage(&self, keep: impl Fn(Stage) -> bool) -> impl Iterator<Item = (Slot, Op)> {
        let leaves = self.states + 1 + self.inputs;
        let inner = self.ops.iter().zip(&self.stages).enumerate().skip(leaves);
        inner.filter(move |(_, (_, stage))| keep(**stage)).map(|(slot, (op, _))| (slot as Slot, *op))
    }
}

/// Whether formulas can be computed: their parts fit together, and none is a comparison.
pub(crate) fn check(formulas: &[Expr]) -> Result<(), CompileError> {
    for formula in formulas {
        match formula.kind()? {
            Kind::Truth => return Err(CompileError::TruthAsOutput),
            kind => _ = kind.dimension()?,
        }
    }
    Ok(())
}
