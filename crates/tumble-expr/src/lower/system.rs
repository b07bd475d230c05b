//! Linear systems on the tape: the factors of the matrix, then the system, then its unknowns.

use super::Lowering;
use crate::Stage;
use crate::ops::solve::{Matrix, System, Term};
use crate::ops::{Op, Slot};
use crate::shape::SparsityPattern;

impl Lowering {
    /// Places a system; its unknowns follow it.
    pub(super) fn system(&mut self, shape: &SparsityPattern, parts: &[Slot]) -> Slot {
        let (entries, right) = parts.split_at(shape.entries());
        let (matrix, factor) = self.factor(shape, entries);
        let unknowns = self.next() + 1;
        let Matrix { shape, entries, .. } = &self.tape.matrices[matrix as usize];
        let term = |(entry, column): (usize, usize)| Term {
            entry: entries[entry],
            unknown: unknowns + column as Slot,
        };
        let varies = |term: &Term| self.tape.stage(term.entry) == Stage::Varying;
        let terms = |row: usize| shape.entries_of(row).map(term).filter(varies).collect();
        let terms = (0..shape.size()).map(terms).collect();
        self.tape.systems.push(System { matrix, factor, terms, right: right.to_vec(), unknowns });
        let system = self.push(Op::System(self.tape.systems.len() as u32 - 1));
        for row in 0..right.len() as u32 {
            self.push(Op::Unknown { system, row });
        }
        system
    }

    pub(super) fn unknown(&self, system: Slot, row: u32) -> Slot {
        system + 1 + row
    }

    /// A matrix and the slot of its factors, which all systems with that matrix share.
    fn factor(&mut self, shape: &SparsityPattern, entries: &[Slot]) -> (u32, Slot) {
        let (shape, entries) = self.without_zeros(shape, entries);
        let is_this = |known: &Matrix| known.entries == entries && known.shape == shape;
        let index = self.tape.matrices.iter().position(is_this).unwrap_or_else(|| {
            let offset = self.tape.matrices.last().map_or(0, |last| last.offset + last.plan.room);
            self.tape.matrices.push(Matrix::new(shape, entries, offset));
            self.tape.matrices.len() - 1
        }) as u32;
        (index, self.emit(Op::Factor(index)))
    }

    /// The entries that are no zeros whatever the leaves are.
    fn without_zeros(&self, shape: &SparsityPattern, entries: &[Slot]) -> (SparsityPattern, Vec<Slot>) {
        let is_entry = |(entry, _): &(usize, usize)| !self.tape.is_zero(entries[*entry]);
        let row = |row: usize| shape.entries_of(row).filter(is_entry);
        let columns = |own: usize| row(own).map(|(_, column)| column as u32).collect();
        let kept = SparsityPattern::new((0..shape.size()).map(columns));
        (kept, (0..shape.size()).flat_map(row).map(|(entry, _)| entries[entry]).collect())
    }
}
