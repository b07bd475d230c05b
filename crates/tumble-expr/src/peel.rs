//! Exact reductions of linear systems: what one equation alone decides is not left to the elimination.
//!
//! An unknown needs only the equations it is connected to. Among these, an equation with one entry gives its unknown as
//! a quotient, and an unknown in one equation alone follows from it when all others are known. So diagonal and
//! triangular systems, in any order of rows, become quotients and sums, and systems of separate bodies fall apart.

use num_traits::Zero;

use crate::expr::{Binary, Node};
use crate::graph::{Graph, NodeId};
use crate::linear;

/// A simpler node for an unknown of a system, if there is one.
pub(crate) fn unknown(graph: &mut Graph, system: NodeId, column: u32) -> Option<NodeId> {
    let Node::System(parts) = graph.node(system) else { return None };
    let whole = System::new(graph, parts);
    let mut part = whole.connected(column as usize);
    // As many equations as unknowns, or the matrix is singular and left for the evaluator to refuse.
    if part.rows.len() != part.columns.len() {
        return None;
    }
    if part.rows.iter().all(|row| is_zero(graph, part.right[*row])) {
        return Some(part.right[*part.rows.first()?]);
    }
    let later = part.peel(graph);
    if part.rows.len() == whole.rows.len() {
        return None;
    }
    part.solve_core(graph);
    part.solve_later(graph, &later);
    part.found[column as usize]
}

fn is_zero(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Number(value) if value.is_zero())
}

/// A system of which some rows and columns are still there.
#[derive(Clone)]
struct System {
    n: usize,
    /// Row by row; `None` for a bare zero.
    matrix: Vec<Option<NodeId>>,
    entries: Vec<NodeId>,
    right: Vec<NodeId>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// Unknowns that have a formula.
    found: Vec<Option<NodeId>>,
}

impl System {
    fn new(graph: &Graph, parts: &[NodeId]) -> Self {
        let n = linear::size(parts.len());
        let (entries, right) = parts.split_at(n * n);
        Self {
            n,
            matrix: entries.iter().map(|entry| (!is_zero(graph, *entry)).then_some(*entry)).collect(),
            entries: entries.to_vec(),
            right: right.to_vec(),
            rows: (0..n).collect(),
            columns: (0..n).collect(),
            found: vec![None; n],
        }
    }

    fn entry(&self, row: usize, column: usize) -> Option<NodeId> {
        self.matrix[row * self.n + column]
    }

    /// The equations and unknowns that an unknown is connected to.
    fn connected(&self, column: usize) -> Self {
        let (mut rows, mut columns) = (vec![false; self.n], vec![false; self.n]);
        let mut pending = vec![column];
        columns[column] = true;
        while let Some(column) = pending.pop() {
            for row in (0..self.n).filter(|row| self.entry(*row, column).is_some()) {
                rows[row] = true;
                for other in (0..self.n).filter(|other| self.entry(row, *other).is_some()) {
                    if !std::mem::replace(&mut columns[other], true) {
                        pending.push(other);
                    }
                }
            }
        }
        let chosen = |chosen: Vec<bool>| (0..self.n).filter(|index| chosen[*index]).collect();
        Self { rows: chosen(rows), columns: chosen(columns), ..self.clone() }
    }

    /// Solves equations with one entry, and sets unknowns aside that one equation has alone; returns the latter.
    fn peel(&mut self, graph: &mut Graph) -> Vec<(usize, usize)> {
        let mut later = vec![];
        loop {
            if let Some((row, column)) = self.lone_in_row() {
                self.remove(row, column);
                self.solve_row(graph, row, column);
            } else if let Some((row, column)) = self.lone_in_column() {
                self.remove(row, column);
                later.push((row, column));
            } else {
                return later;
            }
        }
    }

    fn lone_in_row(&self) -> Option<(usize, usize)> {
        let has = |row: usize, column: &&usize| self.entry(row, **column).is_some();
        let lone = |row: usize| only(self.columns.iter().filter(|column| has(row, column)));
        self.rows.iter().find_map(|row| Some((*row, *lone(*row)?)))
    }

    fn lone_in_column(&self) -> Option<(usize, usize)> {
        let has = |row: &&usize, column: usize| self.entry(**row, column).is_some();
        let lone = |column: usize| only(self.rows.iter().filter(|row| has(row, column)));
        self.columns.iter().find_map(|column| Some((*lone(*column)?, *column)))
    }

    fn remove(&mut self, row: usize, column: usize) {
        self.rows.retain(|other| *other != row);
        self.columns.retain(|other| *other != column);
    }

    /// The unknown of an equation in which nothing else is unknown.
    fn solve_row(&mut self, graph: &mut Graph, row: usize, column: usize) {
        let right = self.less_known(graph, row);
        let entry = self.entries[row * self.n + column];
        self.found[column] = Some(graph.add(Node::Binary(Binary::Div, right, entry)));
    }

    /// The right side of an equation less all unknowns in it that have a formula.
    fn less_known(&self, graph: &mut Graph, row: usize) -> NodeId {
        let known = (0..self.n).filter_map(|column| Some((self.entry(row, column)?, self.found[column]?)));
        known.fold(self.right[row], |rest, (entry, x)| {
            let product = graph.add(Node::Binary(Binary::Mul, entry, x));
            graph.add(Node::Binary(Binary::Sub, rest, product))
        })
    }

    /// What is left is a smaller system.
    fn solve_core(&mut self, graph: &mut Graph) {
        match (self.rows.as_slice(), self.columns.as_slice()) {
            (&[], _) => {}
            (&[row], &[column]) => self.solve_row(graph, row, column),
            (_, columns) => {
                let parts = self.core(graph);
                let core = graph.add(Node::System(parts));
                for (index, column) in columns.iter().enumerate() {
                    self.found[*column] = Some(graph.add(Node::Unknown(core, index as u32)));
                }
            }
        }
    }

    /// Entries and right sides of what is left.
    fn core(&self, graph: &mut Graph) -> Vec<NodeId> {
        let left = |row: usize, column: usize| self.rows.contains(&row) && self.columns.contains(&column);
        let places = (0..self.entries.len()).filter(|place| left(place / self.n, place % self.n));
        let mut parts: Vec<NodeId> = places.map(|place| self.entries[place]).collect();
        parts.extend(self.rows.iter().map(|row| self.less_known(graph, *row)));
        parts
    }

    /// The unknowns set aside, last first: each equation has then no other.
    fn solve_later(&mut self, graph: &mut Graph, later: &[(usize, usize)]) {
        for (row, column) in later.iter().rev() {
            self.solve_row(graph, *row, *column);
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
        assert_eq!(systems(&solved), [12, 12, 12]);
    }
}
