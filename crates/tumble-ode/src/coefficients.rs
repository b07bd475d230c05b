//! Coefficients of several polynomials of one order, one row after the other.

use std::ops::{Index, IndexMut};

/// Terms that are this part of others are left out: all of them together are far below the rounding of the sum.
const NEGLIGIBLE: f64 = 1e-24;

/// How many coefficients of a row count within a length; at least those of a value and its rate.
fn order_within(row: &[f64], length: f64) -> usize {
    let terms = || {
        row.iter().scan(1.0, |power, c| {
            let term = c.abs() * *power;
            *power *= length;
            Some(term)
        })
    };
    let largest = terms().fold(0.0, f64::max);
    let last = terms().enumerate().filter(|(_, term)| *term > NEGLIGIBLE * largest).map(|(k, _)| k).last();
    last.map_or(0, |k| k + 1).max(2).min(row.len())
}

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

    /// The same up to the order from which on no term within a length is more than [`NEGLIGIBLE`] of the largest of its row: steps that are cut
    /// short at one event after the other need few.
    pub(crate) fn within(&self, length: f64) -> Self {
        let order = self.iter().map(|row| order_within(row, length)).max().unwrap_or_default();
        if order == self.stride {
            return self.clone();
        }
        Self::of(self.iter().map(|row| &row[..order]))
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

    #[test]
    fn terms_that_do_not_count_are_left_out() {
        let exponential: Vec<f64> = (0..20)
            .scan(1.0, |c, k| {
                *c /= f64::from(k).max(1.0);
                Some(*c)
            })
            .collect();
        let still = [0.0; 20];
        let rows = Coefficients::of([&exponential[..], &still].into_iter());
        assert_eq!(rows.within(1.0), rows);
        let short = rows.within(1e-6);
        // 1e-6^4/24 is 4e-26.
        assert_eq!(short[0], exponential[..4]);
        assert_eq!(short[1], [0.0; 4]);
        // What falls from rest at a large height keeps its fall.
        let falls = Coefficients::of([&[1.0, 0.0, -4.9, 0.0][..]].into_iter());
        assert_eq!(&falls.within(1e-11)[0], [1.0, 0.0, -4.9]);
        assert_eq!(&falls.within(1e-13)[0], [1.0, 0.0]);
    }
}
