//! Unknowns of a linear system `A x = b`, of which A and b are series.
//!
//! Comparing orders, `A_0 x_k = b_k - sum over j from 1 to k of A_j x_(k-j)`: one matrix for all orders. It is factored
//! when the evaluator starts ([`elimination`](super::elimination)), lane by lane, so that a pivot chosen in one lane is no
//! other's. Then each order is a right side, of which the sum runs over the entries that change with time, and a substitution.

use std::sync::Arc;

use super::amplified::is_small;
use super::arithmetic::convolution;
use super::elimination::{Plan, Symmetric, Workspace};
use super::kernels::Kernels;
use super::{Parts, Series, Slot};
use crate::Lanewise;
use crate::shape::SparsityPattern;

/// A matrix of a linear system.
#[derive(Clone, Debug)]
pub struct Matrix {
    pub(crate) shape: SparsityPattern,
    /// Row by row.
    pub(crate) entries: Vec<Slot>,
    pub(crate) plan: Arc<Plan>,
    /// Of a large one in which entries across the diagonal are the same slots.
    pub(crate) symmetric: Option<Symmetric>,
    /// Where its factors begin in the evaluator's list.
    pub(crate) offset: usize,
}

impl Matrix {
    pub(crate) fn new(shape: SparsityPattern, entries: Vec<Slot>, offset: usize) -> Self {
        let rows = (0..shape.size()).map(|row| shape.columns()[shape.row(row)].to_vec());
        let plan = Plan::of(rows.collect());
        let is_wanted = !is_small(shape.size()) && !plan.is_singular && is_symmetric(&shape, &entries);
        let order = plan.steps.iter().map(|step| step.column);
        let symmetric = is_wanted.then(|| Symmetric::new(&shape, order));
        Self { shape, entries, plan, symmetric, offset }
    }
}

/// Whether entries across the diagonal are the same, and none on it is missing.
fn is_symmetric(shape: &SparsityPattern, entries: &[Slot]) -> bool {
    let at = |row: usize, column: usize| {
        let columns = &shape.columns()[shape.row(row)];
        columns.binary_search(&(column as u32)).ok().map(|index| entries[shape.row(row).start + index])
    };
    let is_mirrored = |row: usize| {
        let mut own = shape.entries_of(row);
        at(row, row).is_some() && own.all(|(entry, column)| at(column, row) == Some(entries[entry]))
    };
    (0..shape.size()).all(is_mirrored)
}

/// A linear system on the tape.
#[derive(Clone, Debug)]
pub struct System {
    pub(crate) matrix: u32,
    /// Slot of the matrix's factors.
    pub(crate) factor: Slot,
    /// By row: what changes with time.
    pub(crate) terms: Vec<Vec<Term>>,
    pub(crate) right: Vec<Slot>,
    /// Slot of the first unknown; the others follow.
    pub(crate) unknowns: Slot,
}

/// An entry that changes with time and the unknown it multiplies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Term {
    pub(crate) entry: Slot,
    pub(crate) unknown: Slot,
}

/// What systems are solved in, kept to be used again.
#[derive(Clone, Debug)]
pub struct Bench<S> {
    pub(crate) numbers: Workspace,
    pub(crate) lanes: Vec<f64>,
    /// By row.
    pub(crate) right: Vec<S>,
    /// By column.
    pub(crate) x: Vec<S>,
}

impl<S> Default for Bench<S> {
    fn default() -> Self {
        Self { numbers: Workspace::default(), lanes: vec![], right: vec![], x: vec![] }
    }
}

impl System {
    pub(crate) fn parts(&self) -> Parts {
        let entries = self.terms.iter().flatten().map(|term| term.entry);
        entries.chain(self.right.iter().copied()).chain([self.factor]).collect()
    }
}

impl<S: Kernels> Series<'_, S> {
    /// Finds the unknowns of a system at an order.
    pub(crate) fn solve(&self, system: u32, k: usize, bench: &mut Bench<S>) {
        let system = &self.tape.systems[system as usize];
        bench.right.clear();
        bench.right.extend((0..system.right.len()).map(|row| right_side(self, system, row, k)));
        bench.x.resize(system.right.len(), S::zero());
        S::solve(self, system, bench);
    }
}

/// `b_k - sum over j from 1 to k of A_j x_(k-j)`, for one row.
fn right_side<S: Kernels>(series: &Series<'_, S>, system: &System, row: usize, k: usize) -> S {
    let right = series.of(system.right[row])[k];
    let terms = &system.terms[row];
    if k == 0 || terms.is_empty() {
        return right;
    }
    let taken = terms.iter().fold(S::zero(), |sum, term| {
        let (a, x) = (series.of(term.entry), series.of(term.unknown));
        sum + (convolution(&x[1..k], &a[1..k]) + x[0] * a[k])
    });
    right - taken
}

/// Factors of a matrix at order 0.
pub(crate) fn factor<S: Lanewise>(
    series: &Series<'_, S>,
    matrix: &Matrix,
    bench: &mut Bench<S>,
    factors: &mut [S],
) {
    let Bench { numbers, lanes, .. } = bench;
    let room = matrix.plan.room;
    lanes.resize(S::LANES * room, 0.0);
    for (lane, factors) in lanes.chunks_exact_mut(room.max(1)).enumerate() {
        let entry = |entry: usize| series.first(matrix.entries[entry]).lane(lane);
        matrix.plan.factor(entry, numbers, factors);
    }
    for (index, factor) in factors.iter_mut().enumerate() {
        *factor = S::from_lanes(|lane| lanes[lane * room + index]);
    }
}
