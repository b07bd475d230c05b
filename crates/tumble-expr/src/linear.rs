//! Linear systems in formulas: what they are made of, their dimensions, their derivatives.

use std::sync::Arc;

use crate::Dimension;
use crate::expr::{Expr, Node};
use crate::shape::SparsityPattern;
use crate::typing::{Kind, TypeError};

impl Expr {
    /// The unknowns x of the linear system `matrix x = rhs`, one for each right side.
    ///
    /// Rows may have different dimensions (a force and a torque), and so may the unknowns: each has one, the same from
    /// every row with an entry for it. Where all right sides that an unknown depends on are bare zeros, so is its
    /// kind. A matrix that is not square, or dimensions that do not fit, are mistakes that the unknowns carry. Where
    /// the matrix is singular, to rounding, the unknowns are not finite.
    pub fn solve(matrix: Vec<Vec<Self>>, rhs: Vec<Self>) -> Vec<Self> {
        let n = rhs.len();
        if matrix.len() != n || matrix.iter().any(|row| row.len() != n) {
            return vec![Self::mistaken(not_square(&matrix, n)); n.max(matrix.len())];
        }
        let entries = |row: Vec<Self>| row.into_iter().enumerate().collect();
        Self::solve_rows(matrix.into_iter().map(entries).collect(), rhs)
    }

    /// The same of a matrix with few entries: those of each row, by increasing columns. All others are zero.
    ///
    /// # Panics
    /// If there are not as many rows as right sides.
    pub fn solve_rows(rows: Vec<Vec<(usize, Self)>>, rhs: Vec<Self>) -> Vec<Self> {
        assert_eq!(rows.len(), rhs.len(), "one right side a row");
        let is_entry = |(_, entry): &(usize, Self)| !entry.is_zero();
        let rows: Vec<Vec<(usize, Self)>> =
            rows.into_iter().map(|row| row.into_iter().filter(is_entry).collect()).collect();
        if let ([row], [right]) = (&rows[..], &rhs[..]) {
            return vec![right / row.first().map_or_else(Self::zero, |(_, entry)| entry.clone())];
        }
        let columns = |row: &Vec<(usize, Self)>| row.iter().map(|(column, _)| *column as u32).collect();
        let shape = SparsityPattern::new(rows.iter().map(columns));
        let n = rhs.len() as u32;
        let entries = rows.into_iter().flatten().map(|(_, entry)| entry);
        let system = Self::system(&shape, entries.chain(rhs).collect());
        (0..n).map(|row| Self::unknown(system.clone(), row)).collect()
    }

    /// A linear system from its entries, row by row, and its right sides.
    pub(crate) fn system(shape: &SparsityPattern, parts: Vec<Self>) -> Self {
        let kinds = unknowns(shape, &parts);
        let kind = kinds.as_ref().map(|_| Kind::System).map_err(Clone::clone);
        let shape = shape.with(kinds.unwrap_or_else(|_| shape.kinds().to_vec()));
        Self::checked(Node::System(Arc::new(shape), parts), kind)
    }

    /// One unknown of a linear system.
    pub(crate) fn unknown(system: Self, row: u32) -> Self {
        let of = |system: &Self| match system.node() {
            Node::System(shape, _) => shape.kinds()[row as usize],
            _ => Kind::Zero,
        };
        let kind = system.kind().map(|_| of(&system));
        Self::checked(Node::Unknown(system, row), kind)
    }

    /// The system of the unknowns' derivatives: from `A x = b` follows `A x' = b' - A' x`.
    pub(crate) fn system_slope(
        &self,
        shape: &SparsityPattern,
        parts: &[Self],
        of: impl Fn(&Self) -> Self,
    ) -> Self {
        let (matrix, right) = parts.split_at(shape.entries());
        let slope = |row: usize| {
            let changes = shape.entries_of(row).map(|(entry, column)| (of(&matrix[entry]), column as u32));
            let taken = changes.filter(|(change, _)| !change.is_zero());
            let less = |rest, (change, column)| rest - change * Self::unknown(self.clone(), column);
            taken.fold(of(&right[row]), less)
        };
        let right = (0..shape.size()).map(slope);
        Self::system(shape, matrix.iter().cloned().chain(right).collect())
    }
}

fn not_square(matrix: &[Vec<Expr>], equations: usize) -> TypeError {
    let wrong = matrix.iter().find(|row| row.len() != equations).or(matrix.first());
    TypeError::NotSquare { equations, rows: matrix.len(), columns: wrong.map_or(0, Vec::len) }
}

/// Kinds of a system's unknowns.
fn unknowns(shape: &SparsityPattern, parts: &[Expr]) -> Result<Vec<Kind>, TypeError> {
    let dimensions = parts.iter().map(dimension).collect::<Result<Vec<_>, _>>()?;
    let (matrix, right) = dimensions.split_at(shape.entries());
    let mut found = Found { shape, matrix, rows: right.to_vec(), columns: vec![None; shape.size()] };
    found.spread()?;
    let columns = found.columns.clone();
    // What no right side reaches is zero, but its entries must fit each other all the same.
    let mut first = 0;
    while let Some(row) = found.rows[first..].iter().position(Option::is_none) {
        first += row;
        found.rows[first] = Some(Dimension::NONE);
        found.spread()?;
    }
    Ok(columns.into_iter().map(|column| column.map_or(Kind::Zero, Kind::Quantity)).collect())
}

/// `None` for a bare zero, which has every dimension.
fn dimension(part: &Expr) -> Result<Option<Dimension>, TypeError> {
    let kind = part.kind()?;
    let dimension = kind.dimension()?;
    Ok((kind != Kind::Zero).then_some(dimension))
}

/// Dimensions of right sides and unknowns, as far as they are known.
struct Found<'a> {
    shape: &'a SparsityPattern,
    matrix: &'a [Option<Dimension>],
    rows: Vec<Option<Dimension>>,
    columns: Vec<Option<Dimension>>,
}

impl Found<'_> {
    /// Follows the entries from what is known until nothing is added.
    fn spread(&mut self) -> Result<(), TypeError> {
        loop {
            let mut news = false;
            for row in 0..self.rows.len() {
                for (entry, column) in self.shape.entries_of(row) {
                    if let Some(entry) = self.matrix[entry] {
                        news |= self.entry(row, column, entry)?;
                    }
                }
            }
            if !news {
                return Ok(());
            }
        }
    }

    /// Whether the entry told something new.
    fn entry(&mut self, row: usize, column: usize, entry: Dimension) -> Result<bool, TypeError> {
        let range = TypeError::ExponentRange;
        let Some(right) = self.rows[row] else {
            let Some(unknown) = self.columns[column] else { return Ok(false) };
            self.rows[row] = Some(unknown.times(entry).ok_or(range)?);
            return Ok(true);
        };
        let here = right.over(entry).ok_or(range)?;
        match self.columns[column].replace(here) {
            None => Ok(true),
            Some(before) if before == here => Ok(false),
            Some(before) => Err(TypeError::Unlike {
                verb: "solves for an unknown that must be",
                left: Kind::Quantity(before),
                right: Kind::Quantity(here),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Branches, Graph, Jets, Layout, Stage, Substitution, Symbol, Tape};

    fn quantity(name: &str, dimension: Dimension) -> Expr {
        Expr::symbol(name, dimension)
    }

    fn kinds(unknowns: &[Expr]) -> Vec<Result<Kind, TypeError>> {
        unknowns.iter().map(Expr::kind).collect()
    }

    /// Force and torque rows on an acceleration and an angular acceleration.
    fn mixed(torque: Expr) -> Vec<Expr> {
        let (m, s) = (quantity("m", Dimension::MASS), quantity("s", Dimension::LENGTH));
        let (i, f) = (quantity("I", Dimension::INERTIA), quantity("F", Dimension::FORCE));
        Expr::solve(vec![vec![m.clone(), &m * &s], vec![&m * &s, i]], vec![f, torque])
    }

    #[test]
    fn rows_of_force_and_torque_fit_together() {
        let expected = [Dimension::ACCELERATION, Dimension::ANGULAR_ACCELERATION];
        for torque in [quantity("T", Dimension::TORQUE), Expr::zero()] {
            assert_eq!(kinds(&mixed(torque)), expected.map(|dimension| Ok(Kind::Quantity(dimension))));
        }
    }

    #[test]
    fn unknowns_of_two_dimensions_are_refused_with_both() {
        for unknown in kinds(&mixed(quantity("E", Dimension::FORCE))) {
            let text = unknown.expect_err("refused").to_string();
            assert!(text.contains("an acceleration (m/s^2)") && text.contains("1/s^2"), "{text}");
        }
    }

    #[test]
    fn entries_must_fit_each_other_where_all_right_sides_are_zero() {
        let (m, s) = (quantity("m", Dimension::MASS), quantity("s", Dimension::LENGTH));
        let zeros = vec![Expr::zero(), Expr::zero()];
        let fits = vec![vec![m.clone(), &m * &s], vec![&m * &s, &m * &s * &s]];
        assert_eq!(kinds(&Expr::solve(fits, zeros.clone())), vec![Ok(Kind::Zero); 2]);
        let wrong = vec![vec![m.clone(), &m * &s], vec![&m * &s, m]];
        let kinds = kinds(&Expr::solve(wrong, zeros));
        assert!(kinds.iter().all(|kind| matches!(kind, Err(TypeError::Unlike { .. }))), "{kinds:?}");
    }

    #[test]
    fn a_matrix_that_is_not_square_is_a_mistake() {
        let two = || vec![Expr::from(1), Expr::from(2)];
        let wide = Expr::solve(vec![two(), vec![Expr::from(1)]], two());
        assert_eq!(kinds(&wide), vec![Err(TypeError::NotSquare { equations: 2, rows: 2, columns: 1 }); 2]);
        let without = Expr::solve(vec![two(), two()], vec![]);
        assert_eq!(kinds(&without), vec![Err(TypeError::NotSquare { equations: 0, rows: 2, columns: 2 }); 2]);
        assert!(Expr::solve(vec![], vec![]).is_empty());
    }

    #[test]
    fn comparisons_and_systems_are_no_entries() {
        let truth = Expr::compare(crate::Relation::Less, Expr::zero(), Expr::one());
        let two = || vec![Expr::from(1), Expr::from(2)];
        let kinds_of = |entry| kinds(&Expr::solve(vec![two(), vec![entry, Expr::one()]], two()));
        assert_eq!(kinds_of(truth)[0], Err(TypeError::TruthAsNumber));
        let solved = Expr::solve(vec![two(), two()], two());
        assert_eq!(kinds_of(solved[0].children()[0].clone())[0], Err(TypeError::SystemAsNumber));
    }

    fn layout() -> Layout {
        let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
        Layout::new(vec![], symbol("t"), vec![symbol("p")])
    }

    fn pure(name: &str) -> Expr {
        quantity(name, Dimension::NONE)
    }

    #[test]
    fn what_depends_on_inputs_alone_is_solved_once_a_run() {
        let (t, p) = (pure("t"), pure("p"));
        let matrix = || vec![vec![p.clone(), Expr::one()], vec![Expr::one(), -&p]];
        let fixed = Expr::solve(matrix(), vec![p.sin(), Expr::one()]);
        let tape = Tape::compile(&layout(), &fixed).expect("typed");
        assert_eq!(tape.varying().count(), 0);
        // Of a right side that changes, the matrix stays factored: the system and its two unknowns remain.
        let moving = Expr::solve(matrix(), vec![t, Expr::one()]);
        let tape = Tape::compile(&layout(), &moving).expect("typed");
        assert_eq!(tape.varying().count(), 3);
        let factors = tape.prologue().filter(|(_, op)| matches!(op, crate::Op::Factor(_))).count();
        assert_eq!(factors, 1);
        assert_eq!(tape.stage(tape.outputs()[0]), Stage::Varying);
    }

    #[test]
    fn systems_with_one_matrix_share_its_factors() {
        let (t, p) = (pure("t"), pure("p"));
        let matrix = vec![vec![t.sin(), p.clone()], vec![p, t.cos()]];
        let mut outputs = Expr::solve(matrix, vec![t.clone(), t.exp()]);
        let symbol = Symbol::new("t", Dimension::NONE);
        outputs.extend(outputs.clone().iter().map(|x| x.derivative(&symbol)));
        let tape = Tape::compile(&layout(), &outputs).expect("typed");
        let count = |is: fn(&crate::Op) -> bool| tape.ops().iter().filter(|op| is(op)).count();
        assert_eq!(count(|op| matches!(op, crate::Op::Factor(_))), 1);
        assert_eq!(count(|op| matches!(op, crate::Op::Unknown { .. })), 4);
    }

    #[test]
    fn substitution_reaches_into_a_system() {
        let (t, p) = (pure("t"), pure("p"));
        let solved = |a: &Expr| {
            Expr::solve(
                vec![vec![a.clone(), Expr::one()], vec![Expr::one(), t.clone()]],
                vec![t.clone(), a.sin()],
            )
        };
        let mut substitution = Substitution::default();
        substitution.insert(Symbol::new("p", Dimension::NONE), t.exp());
        let (written, expected) = (solved(&p), solved(&t.exp()));
        let mut graph = Graph::default();
        for (written, expected) in written.iter().zip(&expected) {
            let ids = graph.import(&[substitution.apply(written), expected.clone()]);
            assert_eq!(ids[0], ids[1]);
        }
    }

    #[test]
    fn singular_matrices_have_no_finite_solution() {
        let (t, zero) = (pure("t"), pure("t") - 1);
        let singular = [
            // Of rank one, but not in rounded numbers.
            vec![vec![&t * 0.1, &t * 0.3], vec![&t * 0.3, &t * 0.9]],
            vec![vec![zero.clone(), zero.clone()], vec![t.clone(), &t * 2]],
            vec![vec![zero.clone(), t.clone()], vec![zero, &t * 2]],
            vec![vec![&t * 1e308 * 10, t.clone()], vec![t.clone(), &t * 2]],
        ];
        for matrix in singular {
            let solved = Expr::solve(matrix, vec![Expr::from(1), Expr::from(2)]);
            let tape = Arc::new(Tape::compile(&layout(), &solved).expect("typed"));
            let mut values = Jets::new(tape, 0, &[1.0]);
            values.start(1.0, &[], Branches::Free);
            let found = [values.value_of(0), values.value_of(1)];
            assert!(found.iter().all(|x: &f64| !x.is_finite()), "{found:?}");
        }
    }

    #[test]
    fn a_system_is_no_output() {
        let solved = Expr::solve(
            vec![vec![pure("p"), Expr::one()], vec![Expr::one(), pure("p")]],
            vec![pure("t"), pure("p")],
        );
        let system = solved[0].children()[0].clone();
        assert_eq!(Tape::compile(&layout(), &[system]).err(), Some(TypeError::SystemAsNumber.into()));
    }
}
