//! Linear systems of numbers with few entries, all of one pattern.

use std::sync::Arc;

use crate::ops::elimination::{Plan, Workspace};

/// A matrix of numbers that is factored and solved with, again and again.
///
/// Work and memory grow with the entries, and what eliminating them fills in, not with the square of their number.
#[derive(Clone, Debug)]
pub struct SparseSystem {
    plan: Arc<Plan>,
    factors: Vec<f64>,
    space: Workspace,
    right: Vec<f64>,
}

impl SparseSystem {
    /// Of rows with entries in these columns, each by increasing columns.
    pub fn new(rows: Vec<Vec<u32>>) -> Self {
        let plan = Plan::of(rows);
        Self { factors: vec![0.0; plan.room], plan, space: Workspace::default(), right: vec![] }
    }

    /// Factors the matrix of these entries, row by row. How large the smallest pivot is beside what it was computed from: 0 where there
    /// is none but for rounding.
    pub fn factor(&mut self, entries: &[f64]) -> f64 {
        self.plan.factor(|entry| entries[entry], &mut self.space, &mut self.factors)
    }

    /// The solution for some right sides; no numbers where the matrix is singular.
    pub fn solve(&mut self, right: &[f64], x: &mut [f64]) {
        self.right.clear();
        self.right.extend_from_slice(right);
        self.plan.substitute(&self.factors, &mut self.right, x);
    }
}
