//! Where a linear system has entries, and what its unknowns measure: what of it is no formula.

use std::ops::Range;

use crate::Kind;

/// Entries of the matrix of a linear system, row by row and each row by columns, and kinds of its unknowns.
///
/// The parts of a system are its entries in that order, then its right sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SparsityPattern {
    /// Where each row begins among the entries, and where the last one ends.
    starts: Vec<u32>,
    columns: Vec<u32>,
    kinds: Vec<Kind>,
}

impl SparsityPattern {
    /// Of rows with entries in these columns, in order; what the unknowns are is yet to be found.
    pub(crate) fn new(rows: impl IntoIterator<Item = Vec<u32>>) -> Self {
        let (mut starts, mut columns) = (vec![0], vec![]);
        for row in rows {
            columns.extend(row);
            starts.push(columns.len() as u32);
        }
        let kinds = vec![Kind::Zero; starts.len() - 1];
        Self { starts, columns, kinds }
    }

    /// The same with unknowns of these kinds.
    pub(crate) fn with(&self, kinds: Vec<Kind>) -> Self {
        Self { kinds, ..self.clone() }
    }

    /// What each unknown is.
    pub(crate) fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    /// How many equations and unknowns there are.
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// How many entries there are.
    pub fn entries(&self) -> usize {
        self.columns.len()
    }

    /// The entries of a row, among all.
    pub fn row(&self, row: usize) -> Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    /// Column of each entry.
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// The entries of a row, each with its column.
    pub fn entries_of(&self, row: usize) -> impl Iterator<Item = (usize, usize)> {
        self.row(row).map(|entry| (entry, self.columns[entry] as usize))
    }
}
