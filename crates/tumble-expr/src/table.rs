//! Measured functions of one variable: values at knots, and a rule between and outside them.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use thiserror::Error;

use crate::{Dimension, TypeError};

/// How values follow between knots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// Each value holds from its knot up to the next.
    Constant,
    /// Straight lines.
    Linear,
    /// The natural cubic spline: smooth to the second derivative, which vanishes at both ends.
    Cubic,
}

/// What holds outside the first and the last knot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// The nearest value.
    Hold,
    /// Zero.
    Zero,
    /// Nothing: a motion that gets there is refused.
    Refuse,
}

/// A piecewise polynomial through measured values, SI units.
#[derive(Clone, Debug)]
pub struct Table {
    /// Its name.
    pub name: String,
    /// What the variable measures.
    pub x: Dimension,
    /// What the values measure.
    pub y: Dimension,
    knots: Vec<f64>,
    /// Coefficients of powers of the distance from the knot at the left, one a segment; the first and the last segment
    /// are outside and count from the first and the last knot.
    segments: Vec<[f64; 4]>,
    refuses: bool,
    degree: usize,
}

/// Values that are no table.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TableError {
    /// Fewer rows than the interpolation needs.
    #[error("a table needs at least two rows, and this has {0}")]
    TooShort(usize),
    /// Knots out of order.
    #[error("row {row}: {x} does not come after {before}; the first column must increase")]
    Order {
        /// Row, from 1.
        row: usize,
        /// Its knot.
        x: f64,
        /// The knot before.
        before: f64,
    },
    /// A number that is not finite.
    #[error("row {row} holds a number that is not finite")]
    NotFinite {
        /// Row, from 1.
        row: usize,
    },
}

impl Table {
    /// A table of rows (x, y), SI units.
    pub fn new(
        name: impl Into<String>,
        [x, y]: [Dimension; 2],
        rows: &[[f64; 2]],
        interpolation: Interpolation,
        outside: Outside,
    ) -> Result<Self, TableError> {
        check(rows)?;
        let inside = match interpolation {
            Interpolation::Constant => {
                rows[..rows.len() - 1].iter().map(|row| [row[1], 0.0, 0.0, 0.0]).collect()
            }
            Interpolation::Linear => linear(rows),
            Interpolation::Cubic => natural_spline(rows),
        };
        let (first, last) = (rows[0][1], rows[rows.len() - 1][1]);
        let edge = |value: f64| match outside {
            Outside::Hold => [value, 0.0, 0.0, 0.0],
            Outside::Zero => [0.0; 4],
            Outside::Refuse => [f64::NAN, 0.0, 0.0, 0.0],
        };
        let segments = [edge(first)].into_iter().chain(inside).chain([edge(last)]).collect();
        let degree = match interpolation {
            Interpolation::Constant => 0,
            Interpolation::Linear => 1,
            Interpolation::Cubic => 3,
        };
        let knots = rows.iter().map(|row| row[0]).collect();
        Ok(Self { name: name.into(), x, y, knots, segments, refuses: outside == Outside::Refuse, degree })
    }

    /// Where the polynomial changes, increasing.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Highest power used.
    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    /// Whether its values jump: those that hold up to the next knot, and those that are zero outside and not at the ends.
    pub(crate) fn is_stepped(&self) -> bool {
        let ends = [(0, 1, 0.0), (self.knots.len(), self.knots.len() - 1, self.last_width())];
        let falls = |(edge, inner, at): (usize, usize, f64)| {
            let value =
                self.segments[inner].iter().rev().fold(0.0, |sum, coefficient| sum * at + coefficient);
            self.segments[edge] == [0.0; 4] && value != 0.0
        };
        self.degree == 0 || ends.into_iter().any(falls)
    }

    fn last_width(&self) -> f64 {
        let last = self.knots.len() - 1;
        self.knots[last] - self.knots[last - 1]
    }

    /// Index of the segment that holds at x: 0 before the first knot, each holding from its knot on.
    ///
    /// The last knot is still measured: it belongs to the segment before it, but for values that hold up to the next knot.
    pub fn segment(&self, x: f64) -> usize {
        let segment = self.knots.partition_point(|knot| *knot <= x);
        let on_last = self.knots.last() == Some(&x) && self.degree > 0;
        if on_last { segment - 1 } else { segment }
    }

    /// First and last x of a segment.
    pub fn ends(&self, segment: usize) -> [f64; 2] {
        let low = segment.checked_sub(1).map_or(f64::NEG_INFINITY, |knot| self.knots[knot]);
        [low, self.knots.get(segment).copied().unwrap_or(f64::INFINITY)]
    }

    /// Whether a segment lies outside a table that says nothing there.
    pub fn refuses(&self, segment: usize) -> bool {
        self.refuses && (segment == 0 || segment == self.knots.len())
    }

    /// The knot from which a segment's polynomial counts.
    pub(crate) fn origin(&self, segment: usize) -> f64 {
        self.knots[segment.saturating_sub(1)]
    }

    /// A coefficient of a segment's polynomial.
    pub(crate) fn coefficient(&self, segment: usize, power: usize) -> f64 {
        self.segments[segment][power]
    }

    /// The derivative, as a table of the same knots.
    pub(crate) fn derivative(&self) -> Result<Self, TypeError> {
        let y = self.y.over(self.x).ok_or(TypeError::ExponentRange)?;
        let slope = |[_, b, c, d]: &[f64; 4]| [*b, 2.0 * c, 3.0 * d, 0.0];
        let segments = self.segments.iter().map(slope).collect();
        let degree = self.degree.saturating_sub(1);
        Ok(Self { name: format!("{}'", self.name), y, segments, degree, ..self.clone() })
    }
}

fn check(rows: &[[f64; 2]]) -> Result<(), TableError> {
    if rows.len() < 2 {
        return Err(TableError::TooShort(rows.len()));
    }
    if let Some(row) = rows.iter().position(|row| !row.iter().all(|value| value.is_finite())) {
        return Err(TableError::NotFinite { row: row + 1 });
    }
    match rows.windows(2).position(|pair| pair[1][0] <= pair[0][0]) {
        Some(at) => Err(TableError::Order { row: at + 2, x: rows[at + 1][0], before: rows[at][0] }),
        None => Ok(()),
    }
}

fn linear(rows: &[[f64; 2]]) -> Vec<[f64; 4]> {
    let slope = |pair: &[[f64; 2]]| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
    rows.windows(2).map(|pair| [pair[0][1], slope(pair), 0.0, 0.0]).collect()
}

/// The tridiagonal system for the second derivatives at the inner knots, by elimination; it is diagonally dominant.
fn natural_spline(rows: &[[f64; 2]]) -> Vec<[f64; 4]> {
    let n = rows.len();
    let h = |i: usize| rows[i + 1][0] - rows[i][0];
    let slope = |i: usize| (rows[i + 1][1] - rows[i][1]) / h(i);
    let (mut factor, mut right) = (vec![0.0; n], vec![0.0; n]);
    for i in 1..n - 1 {
        let diagonal = 2.0 * (h(i - 1) + h(i)) - h(i - 1) * factor[i - 1];
        factor[i] = h(i) / diagonal;
        right[i] = (6.0 * (slope(i) - slope(i - 1)) - h(i - 1) * right[i - 1]) / diagonal;
    }
    let mut second = vec![0.0; n];
    for i in (1..n - 1).rev() {
        second[i] = right[i] - factor[i] * second[i + 1];
    }
    let piece = |i: usize| {
        let b = slope(i) - h(i) * (2.0 * second[i] + second[i + 1]) / 6.0;
        [rows[i][1], b, second[i] / 2.0, (second[i + 1] - second[i]) / (6.0 * h(i))]
    };
    (0..n - 1).map(piece).collect()
}

/// A shared table; two are one if they are the same object.
#[derive(Clone, Debug)]
pub struct TableRef(pub Arc<Table>);

impl PartialEq for TableRef {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for TableRef {}

impl Hash for TableRef {
    fn hash<H: Hasher>(&self, state: &mut H) {
        Arc::as_ptr(&self.0).hash(state);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(table: &Table, x: f64) -> f64 {
        let segment = table.segment(x);
        let u = x - table.origin(segment);
        (0..4).rev().fold(0.0, |sum, power| sum * u + table.coefficient(segment, power))
    }

    fn table(rows: &[[f64; 2]], interpolation: Interpolation, outside: Outside) -> Table {
        Table::new("w", [Dimension::TIME, Dimension::SPEED], rows, interpolation, outside).expect("a table")
    }

    const ROWS: [[f64; 2]; 4] = [[0.0, 1.0], [1.0, 3.0], [3.0, -1.0], [4.0, 0.0]];

    #[test]
    fn values_stand_at_their_knots() {
        for interpolation in [Interpolation::Constant, Interpolation::Linear, Interpolation::Cubic] {
            let table = table(&ROWS, interpolation, Outside::Hold);
            for [x, y] in ROWS {
                assert_eq!(value(&table, x), y, "{interpolation:?} at {x}");
            }
            assert_eq!((value(&table, -5.0), value(&table, 9.0)), (1.0, 0.0));
        }
    }

    #[test]
    fn between_knots() {
        assert_eq!(value(&table(&ROWS, Interpolation::Constant, Outside::Hold), 2.9), 3.0);
        assert_eq!(value(&table(&ROWS, Interpolation::Linear, Outside::Hold), 2.0), 1.0);
        assert_eq!(value(&table(&ROWS, Interpolation::Linear, Outside::Zero), 4.5), 0.0);
        // A straight line is its own spline.
        let line = [[0.0, 0.0], [1.0, 2.0], [2.5, 5.0], [3.0, 6.0]];
        assert!((value(&table(&line, Interpolation::Cubic, Outside::Hold), 1.7) - 3.4).abs() < 1e-15);
    }

    #[test]
    fn a_spline_is_smooth_at_its_knots() {
        let spline = table(&ROWS, Interpolation::Cubic, Outside::Hold);
        let slope = spline.derivative().expect("dimensions fit");
        let curvature = slope.derivative().expect("dimensions fit");
        for knot in [1.0, 3.0] {
            for of in [&slope, &curvature] {
                assert!((value(of, knot - 1e-12) - value(of, knot)).abs() < 1e-10);
            }
        }
        assert!(value(&curvature, 0.0).abs() < 1e-14);
    }

    #[test]
    fn bad_rows_are_refused() {
        let fails = |rows: &[[f64; 2]]| {
            Table::new("w", [Dimension::TIME; 2], rows, Interpolation::Linear, Outside::Hold)
                .expect_err("bad")
        };
        assert_eq!(fails(&[[0.0, 1.0]]), TableError::TooShort(1));
        assert_eq!(fails(&[[0.0, 1.0], [0.0, 2.0]]), TableError::Order { row: 2, x: 0.0, before: 0.0 });
        assert_eq!(fails(&[[0.0, 1.0], [1.0, f64::NAN]]), TableError::NotFinite { row: 2 });
    }
}
