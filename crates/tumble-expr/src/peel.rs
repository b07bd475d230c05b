//! Exact reductions of linear systems: what one equation alone decides is not left to the elimination.
//!
//! An unknown needs only the equations it is connected to. Among these, an equation with one entry gives its unknown as
//! a quotient, and an unknown in one equation alone follows from it when all others are known. So diagonal and
//! triangular systems, in any order of rows, become quotients and sums, and systems of separate bodies fall apart.

use std::collections::BTreeSet;
use std::sync::Arc;

use num_traits::Zero;

use crate::expr::{Binary, Node};
use crate::graph::{Graph, NodeId};
use crate::shape::SparsityPattern;

/// Simpler nodes for the unknowns of a system, where there are any.
pub(crate) fn unknowns(graph: &mut Graph, shape: &SparsityPattern, parts: &[NodeId]) -> Vec<Option<NodeId>> {
    let mut system = System::new(graph, shape, parts);
    for (rows, columns) in system.components() {
        // As many equations as unknowns, or the matrix is singular and left for the evaluator to refuse.
        if rows.len() == columns.len() {
            system.reduce(graph, rows, columns);
        }
    }
    system.found
}

fn is_zero(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Number(value) if value.is_zero())
}

/// Places that are still there, in order.
type Places = BTreeSet<usize>;

/// A system whose unknowns are looked for.
struct System<'a> {
    shape: &'a SparsityPattern,
    /// By row, the entries that are no bare zeros, with their columns.
    rows: Vec<Vec<(usize, NodeId)>>,
    /// By column, the rows of these.
    columns: Vec<Vec<usize>>,
    right: Vec<NodeId>,
    /// Unknowns that have a formula.
    found: Vec<Option<NodeId>>,
}

impl<'a> System<'a> {
    fn new(graph: &Graph, shape: &'a SparsityPattern, parts: &[NodeId]) -> Self {
        let n = shape.size();
        let (entries, right) = parts.split_at(shape.entries());
        let mut columns = vec![vec![]; n];
        let row = |row: usize| {
            let own = shape.entries_of(row).map(|(entry, column)| (column, entries[entry]));
            own.filter(|(_, entry)| !is_zero(graph, *entry)).collect()
        };
        let rows: Vec<Vec<(usize, NodeId)>> = (0..n).map(row).collect();
        for (row, own) in rows.iter().enumerate() {
            own.iter().for_each(|(column, _)| columns[*column].push(row));
        }
        Self { shape, rows, columns, right: right.to_vec(), found: vec![None; n] }
    }

    /// Equations and unknowns that are connected with each other.
    fn components(&self) -> Vec<(Places, Places)> {
        let mut is_seen = vec![false; self.columns.len()];
        let mut found = vec![];
        for first in 0..self.columns.len() {
            let (mut rows, mut columns, mut pending) = (Places::new(), Places::new(), vec![first]);
            while let Some(column) = pending.pop() {
                if std::mem::replace(&mut is_seen[column], true) {
                    continue;
                }
                columns.insert(column);
                let new = self.columns[column].iter().filter(|row| rows.insert(**row));
                pending.extend(new.flat_map(|row| self.rows[*row].iter().map(|(column, _)| *column)));
            }
            if !columns.is_empty() {
                found.push((rows, columns));
            }
        }
        found
    }

    /// Finds the unknowns of a part of the system that is connected with nothing else.
    fn reduce(&mut self, graph: &mut Graph, mut rows: Places, mut columns: Places) {
        if rows.iter().all(|row| is_zero(graph, self.right[*row])) {
            let Some(zero) = rows.first().map(|row| self.right[*row]) else { return };
            columns.iter().for_each(|column| self.found[*column] = Some(zero));
            return;
        }
        let later = self.peel(graph, &mut rows, &mut columns);
        // The same system again is none simpler.
        if rows.len() < self.rows.len() {
            self.solve_core(graph, &rows, &columns);
            // Each of these equations has then no other unknown.
            for (row, column) in later.into_iter().rev() {
                self.solve_row(graph, row, column);
            }
        }
    }

    /// Solves equations with one entry, and sets unknowns aside that one equation has alone; returns the latter.
    fn peel(&mut self, graph: &mut Graph, rows: &mut Places, columns: &mut Places) -> Vec<(usize, usize)> {
        let mut later = vec![];
        let (mut lone_rows, mut lone_columns) = (rows.clone(), columns.clone());
        loop {
            let (row, column);
            if let Some(next) = lone_rows.pop_first() {
                let left = self.rows[next].iter().map(|(column, _)| *column);
                let Some(only) = only(left.filter(|column| columns.contains(column))) else { continue };
                (row, column) = (next, only);
                self.solve_row(graph, row, column);
            } else if let Some(next) = lone_columns.pop_first() {
                let left = self.columns[next].iter().copied();
                let Some(only) = only(left.filter(|row| rows.contains(row))) else { continue };
                (row, column) = (only, next);
                later.push((row, column));
            } else {
                return later;
            }
            rows.remove(&row);
            columns.remove(&column);
            lone_rows.remove(&row);
            lone_columns.remove(&column);
            lone_rows.extend(self.columns[column].iter().filter(|row| rows.contains(row)));
            let touched = self.rows[row].iter().map(|(column, _)| *column);
            lone_columns.extend(touched.filter(|column| columns.contains(column)));
        }
    }

    /// The unknown of an equation in which nothing else is unknown.
    fn solve_row(&mut self, graph: &mut Graph, row: usize, column: usize) {
        let right = self.less_known(graph, row);
        let own = self.rows[row].iter().find(|(other, _)| *other == column);
        let (_, entry) = *own.expect("the unknown is in its equation");
        self.found[column] = Some(graph.add(Node::Binary(Binary::Div, right, entry)));
    }

    /// The right side of an equation less all unknowns in it that have a formula.
    fn less_known(&self, graph: &mut Graph, row: usize) -> NodeId {
        let known = self.rows[row].iter().filter_map(|(column, entry)| Some((*entry, self.found[*column]?)));
        known.fold(self.right[row], |rest, (entry, x)| {
            let product = graph.add(Node::Binary(Binary::Mul, entry, x));
            graph.add(Node::Binary(Binary::Sub, rest, product))
        })
    }

    /// What is left is a smaller system.
    fn solve_core(&mut self, graph: &mut Graph, rows: &Places, columns: &Places) {
        match (rows.len(), rows.first(), columns.first()) {
            (0, ..) => return,
            (1, Some(row), Some(column)) => return self.solve_row(graph, *row, *column),
            _ => {}
        }
        let mut place = vec![None; self.columns.len()];
        columns.iter().enumerate().for_each(|(index, column)| place[*column] = Some(index as u32));
        let left = |row: &usize| self.rows[*row].iter().filter_map(|(column, _)| place[*column]).collect();
        let kinds = columns.iter().map(|column| self.shape.kinds()[*column]);
        let shape = SparsityPattern::new(rows.iter().map(left)).with(kinds.collect());
        let entries = rows.iter().flat_map(|row| &self.rows[*row]);
        let mut parts: Vec<NodeId> =
            entries.filter(|(column, _)| place[*column].is_some()).map(|(_, entry)| *entry).collect();
        parts.extend(rows.iter().map(|row| self.less_known(graph, *row)));
        let core = graph.add(Node::System(Arc::new(shape), parts));
        for (index, column) in columns.iter().enumerate() {
            self.found[*column] = Some(graph.add(Node::Unknown(core, index as u32)));
        }
    }
}

fn only<T>(mut items: impl Iterator<Item = T>) -> Option<T> {
    let first = items.next()?;
    items.next().is_none().then_some(first)
}

#[cfg(test)]
mod tests {
    use crate::{Dimension, Expr, Graph, Node};

    fn leaf(name: &str) -> Expr {
        Expr::symbol(name, Dimension::NONE)
    }

    /// Rows of names; `.` is a bare zero.
    fn matrix(rows: &[&str]) -> Vec<Vec<Expr>> {
        let entry = |name: &str| if name == "." { Expr::zero() } else { leaf(name) };
        rows.iter().map(|row| row.split(' ').map(entry).collect()).collect()
    }

    fn right(n: usize) -> Vec<Expr> {
        (0..n).map(|row| leaf(&format!("r{row}"))).collect()
    }

    fn same(written: &[Expr], expected: &[Expr]) {
        let mut graph = Graph::default();
        assert_eq!(graph.import(written), graph.import(expected));
    }

    fn systems(unknowns: &[Expr]) -> Vec<usize> {
        let mut graph = Graph::default();
        let roots = graph.import(unknowns);
        let of = |id: &crate::NodeId| match graph.node(*id) {
            Node::Unknown(system, _) => Some(graph.node(*system).parts().len()),
            _ => None,
        };
        roots.iter().filter_map(of).collect()
    }

    #[test]
    fn a_diagonal_system_is_quotients() {
        let solved = Expr::solve(matrix(&["a .", ". b"]), right(2));
        same(&solved, &[leaf("r0") / leaf("a"), leaf("r1") / leaf("b")]);
    }

    #[test]
    fn triangular_systems_are_quotients_in_any_order_of_rows() {
        let x = leaf("r1") / leaf("a");
        let y = (leaf("r0") - leaf("b") * &x) / leaf("c");
        same(&Expr::solve(matrix(&["b c", "a ."]), right(2)), &[x, y]);
        let solved = Expr::solve(matrix(&["d e f", "b c .", "a . ."]), right(3));
        assert_eq!(systems(&solved), []);
    }

    #[test]
    fn bodies_that_do_not_touch_are_systems_of_their_own() {
        let solved = Expr::solve(matrix(&["a . b .", ". e . f", "c . d .", ". g . h"]), right(4));
        assert_eq!(systems(&solved), [6, 6, 6, 6]);
        let alone = Expr::solve(matrix(&["e f", "g h"]), vec![leaf("r1"), leaf("r3")]);
        same(&[solved[1].clone(), solved[3].clone()], &alone);
    }

    #[test]
    fn an_unknown_of_one_equation_leaves_the_others_a_smaller_system() {
        // x2 stands in the first equation alone; x0 is known from the last one.
        let solved = Expr::solve(matrix(&["a b c d", ". e . f", ". g . h", "i . . ."]), right(4));
        let core = Expr::solve(matrix(&["e f", "g h"]), vec![leaf("r1"), leaf("r2")]);
        let first = leaf("r3") / leaf("i");
        let rest = leaf("r0") - leaf("a") * &first - leaf("b") * &core[0] - leaf("d") * &core[1];
        same(&solved, &[first, core[0].clone(), rest / leaf("c"), core[1].clone()]);
    }

    #[test]
    fn no_right_sides_no_unknowns() {
        let solved = Expr::solve(matrix(&["a b", "c d"]), vec![Expr::zero(), leaf("r") - leaf("r")]);
        same(&solved, &[Expr::zero(), Expr::zero()]);
    }

    #[test]
    fn what_is_singular_whatever_the_entries_is_left_to_the_evaluator() {
        let solved = Expr::solve(matrix(&["a b .", "c d .", "e f ."]), right(3));
        assert_eq!(systems(&solved), [9, 9, 9]);
    }
}
