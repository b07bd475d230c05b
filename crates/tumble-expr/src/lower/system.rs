//! Linear systems on the tape: the factors of the matrix, then residuals, eliminations and unknowns.

use super::Lowering;
use crate::Stage;
use crate::linear;
use crate::ops::solve::{Matrix, System, Term};
use crate::ops::{Op, Slot};

impl Lowering {
    /// Places a system; the slot is that of its first unknown, and the others stand before it, the last one first.
    pub(super) fn system(&mut self, parts: &[Slot]) -> Slot {
        let n = linear::size(parts.len());
        let (entries, right) = parts.split_at(n * n);
        let (matrix, factor) = self.factor(n, entries);
        let changing: Vec<Vec<usize>> = entries.chunks(n).map(|row| self.changing(row)).collect();
        let residuals = self.residuals(&changing, right);
        let forward = self.next() + changing.iter().filter(|columns| !columns.is_empty()).count() as Slot;
        let solution = forward + 2 * n as Slot - 1;
        let term = |row: usize, column: usize| Term {
            entry: entries[row * n + column],
            unknown: solution - column as Slot,
        };
        let terms =
            changing.iter().enumerate().map(|(row, columns)| columns.iter().map(|c| term(row, *c)).collect());
        let terms: Vec<Vec<Term>> = terms.collect();
        let right = right.to_vec();
        self.tape.systems.push(System { n, matrix, factor, terms, right, residuals, forward, solution });
        self.place(n, &changing);
        solution
    }

    pub(super) fn unknown(&self, system: Slot, row: u32) -> Slot {
        system - row
    }

    /// A matrix and the slot of its factors, which all systems with that matrix share.
    fn factor(&mut self, n: usize, entries: &[Slot]) -> (u32, Slot) {
        let matrices = &mut self.tape.matrices;
        let index = matrices.iter().position(|known| known.entries == entries).unwrap_or_else(|| {
            let offset = matrices.last().map_or(0, |last| last.offset + last.room());
            matrices.push(Matrix { n, entries: entries.to_vec(), offset });
            matrices.len() - 1
        }) as u32;
        (index, self.emit(Op::Factor(index)))
    }

    /// Columns whose entries in a row change with time.
    fn changing(&self, row: &[Slot]) -> Vec<usize> {
        let varies = |column: &usize| self.tape.stage(row[*column]) == Stage::Varying;
        (0..row.len()).filter(varies).collect()
    }

    /// Where the residuals will stand: that of a row which does not change is its right side.
    fn residuals(&self, changing: &[Vec<usize>], right: &[Slot]) -> Vec<Slot> {
        let mut next = self.next();
        let mut place = |columns: &Vec<usize>, right: Slot| {
            if columns.is_empty() {
                return right;
            }
            next += 1;
            next - 1
        };
        changing.iter().zip(right).map(|(columns, right)| place(columns, *right)).collect()
    }

    fn place(&mut self, n: usize, changing: &[Vec<usize>]) {
        let system = self.tape.systems.len() as u32 - 1;
        for (row, columns) in changing.iter().enumerate() {
            if !columns.is_empty() {
                self.push(Op::Residual { system, row: row as u32 });
            }
        }
        for row in 0..n as u32 {
            self.push(Op::Forward { system, row });
        }
        for row in (0..n as u32).rev() {
            self.push(Op::Solution { system, row });
        }
    }
}
