//! Coefficients of several polynomials of one order, one row after the other.

use std::ops::{Index, IndexMut};

/// Rows of coefficients, lowest order first: of the states of a piece, or of what is watched along a step.
///
/// One piece of memory whatever the number of rows: a motion has thousands of pieces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coefficients {
    data: Vec<f64>,
    /// Length of a row.
    stride: usize,
}

impl Coefficients {
    /// Copies of some rows of one length.
    ///
    /// # Panics
    /// If their lengths differ.
    pub fn of<'a>(rows: impl Iterator<Item = &'a [f64]>) -> Self {
        let mut all = Self::default();
        all.refill(rows);
        all
    }

    /// Takes copies of other rows instead of those that it has.
    ///
    /// # Panics
    /// If their lengths differ.
    pub(crate) fn refill<'a>(&mut self, rows: impl Iterator<Item = &'a [f64]>) {
        self.data.clear();
        let (least, _) = rows.size_hint();
        for row in rows {
            if self.data.is_empty() {
                self.stride = row.len();
                self.data.reserve_exact(row.len() * least.max(1));
            }
            assert_eq!(row.len(), self.stride, "rows of one length");
            self.data.extend_from_slice(row);
        }
    }

    /// How many polynomials there are.
    pub fn len(&self) -> usize {
        self.data.len() / self.stride.max(1)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// The rows in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[f64]> + DoubleEndedIterator + Clone {
        self.data.chunks_exact(self.stride.max(1))
    }

    /// The rows in order, to be changed.
    pub fn iter_mut(&mut self) -> impl ExactSizeIterator<Item = &mut [f64]> {
        self.data.chunks_exact_mut(self.stride.max(1))
    }

    /// A row, if there are so many.
    pub fn get(&self, row: usize) -> Option<&[f64]> {
        (row < self.len()).then(|| &self[row])
    }

    /// All coefficients, row after row.
    pub fn all(&self) -> &[f64] {
        &self.data
    }
}

impl Index<usize> for Coefficients {
    type Output = [f64];
    fn index(&self, row: usize) -> &[f64] {
        &self.data[row * self.stride..][..self.stride]
    }
}

impl IndexMut<usize> for Coefficients {
    fn index_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.data[row * self.stride..][..self.stride]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_where_they_were_put() {
        let rows = Coefficients::of([&[1.0, 2.0][..], &[3.0, 4.0]].into_iter());
        assert_eq!((rows.len(), &rows[1], rows.get(2)), (2, &[3.0, 4.0][..], None));
        assert_eq!(rows.iter().map(|row| row[0]).sum::<f64>(), 4.0);
        assert_eq!((Coefficients::default().len(), Coefficients::default().iter().len()), (0, 0));
    }
}
