//! Linear systems: cases for the suite, and what only they must do.

use num_complex::Complex64;
use tumble_expr::{Branches, Dimension, Expr, Jets, Layout, Op, SparsityPattern, Symbol, Tape};

use super::{Case, ORDER, P, cauchy, p, series, t};

pub(crate) fn cases() -> Vec<Case> {
    let case = |name, formula, radius| Case { name, formula, at: 0.7, radius };
    let right = || vec![t().cos(), p() * t(), t().exp(), Expr::from(2), t().powi(2), t().sin()];
    let solve = |matrix: Vec<Vec<Expr>>| {
        let n = matrix.len();
        Expr::solve(matrix, right()[..n].to_vec())
    };
    let kkt = vec![
        vec![t() + 2, Expr::from(0.1), t().sin()],
        vec![Expr::from(0.1), Expr::from(3), t().cos()],
        vec![t().sin(), t().cos(), Expr::zero()],
    ];
    let fixed = vec![vec![p(), Expr::one()], vec![Expr::one(), -p()]];
    vec![
        case("one equation", solve(vec![vec![t() + 2]]).remove(0), 1.0),
        case("two equations", sum(solve(vec![vec![t().sin() + 2, t()], vec![t(), t().exp() + 3]])), 0.5),
        case("three equations", sum(solve(dense(3))), 0.5),
        case("six equations", sum(solve(dense(6))), 0.5),
        case("one of six unknowns", solve(dense(6)).remove(4), 0.5),
        case("zeros on the diagonal", sum(solve(exchanged())), 0.2),
        case("exchange in some lanes", sum(solve(balanced())), 0.5),
        case("chain", sum(Expr::solve(chain(9), vec![t().sin(); 9])), 0.3),
        case("indefinite", sum(solve(kkt)), 0.3),
        case("matrix of parameters", sum(solve(fixed)), 1.0),
        case("triangular", sum(solve(vec![vec![Expr::zero(), t() + 2], vec![t().exp(), p()]])), 0.5),
    ]
}

/// With weights, so that no two unknowns can be mistaken for each other.
fn sum(unknowns: Vec<Expr>) -> Expr {
    unknowns.into_iter().enumerate().fold(Expr::zero(), |sum, (row, x)| sum + x * (row as i32 + 1))
}

/// Entries that all change, the diagonal largest.
pub(crate) fn dense(n: i32) -> Vec<Vec<Expr>> {
    let entry = |i: i32, j: i32| (t() * (0.2 + 0.1 * f64::from(i)) + 2 * i - 3 * j).sin();
    let diagonal = |i: i32, j: i32| if i == j { entry(i, j) + 6 + t() } else { entry(i, j) };
    (0..n).map(|i| (0..n).map(|j| diagonal(i, j)).collect()).collect()
}

/// Entries beside the diagonal only, of which each couples two neighbours; the diagonal of every third is zero.
fn chain(n: i32) -> Vec<Vec<Expr>> {
    let entry = |i: i32, j: i32| match (i - j).abs() {
        0 if i % 3 == 1 => Expr::zero(),
        0 => t() + i + 2,
        1 => (t() + i.min(j)).cos() + 2,
        _ => Expr::zero(),
    };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// A zero, and what is zero at the point of expansion, where pivots are looked for.
fn exchanged() -> Vec<Vec<Expr>> {
    vec![
        vec![t() - 0.7, t() + 1, p()],
        vec![t().exp(), Expr::zero(), Expr::one()],
        vec![Expr::from(2), t().sin(), t() - 0.7],
    ]
}

/// Which of the first two rows has the larger pivot changes at t = 0.725.
fn balanced() -> Vec<Vec<Expr>> {
    vec![
        vec![1.45 - t(), Expr::from(5), t().sin()],
        vec![t(), t().cos(), Expr::from(5)],
        vec![Expr::from(0.5), Expr::from(-8), t() + 0.3],
    ]
}

/// Cramer's rule.
pub(crate) fn cramer(shape: &SparsityPattern, parts: &[Complex64], column: usize) -> Complex64 {
    let n = shape.size();
    let (known, right) = parts.split_at(shape.entries());
    let mut entries = vec![Complex64::from(0.0); n * n];
    for row in 0..n {
        shape.entries_of(row).for_each(|(entry, column)| entries[row * n + column] = known[entry]);
    }
    let rows = |swap: Option<usize>| {
        let entry = |i: usize, j: usize| if Some(j) == swap { right[i] } else { entries[i * n + j] };
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect::<Vec<Vec<_>>>()
    };
    determinant(&rows(Some(column))) / determinant(&rows(None))
}

/// By minors of the first row.
fn determinant(rows: &[Vec<Complex64>]) -> Complex64 {
    let Some((first, rest)) = rows.split_first() else { return 1.0.into() };
    let without = |column: usize| -> Vec<Vec<Complex64>> {
        let keep = |row: &Vec<Complex64>| [&row[..column], &row[column + 1..]].concat();
        rest.iter().map(keep).collect()
    };
    let sign = |column: usize| if column.is_multiple_of(2) { 1.0 } else { -1.0 };
    let entries = first.iter().enumerate().filter(|(_, entry)| entry.norm_sqr() > 0.0);
    entries.map(|(column, entry)| sign(column) * entry * determinant(&without(column))).sum()
}

/// Rows that differ by a millionth cost six digits and no more.
#[test]
fn nearly_singular_systems_lose_what_their_condition_takes() {
    const NEAR: f64 = 1e-6;
    let matrix = vec![vec![t().cos(), Expr::one()], vec![t().cos(), 1 + t().exp() * NEAR]];
    let formula = Expr::solve(matrix, vec![t().sin(), p()]).remove(1);
    let reference = cauchy(&Case {
        name: "by hand",
        formula: (p() - t().sin()) / (t().exp() * NEAR),
        at: 0.7,
        radius: 1.0,
    });
    let ours = series(&formula, 0.7);
    for k in 0..=ORDER {
        let error = (ours[k] - reference[k]).abs() / reference[0].abs();
        assert!(error < 8.0 * f64::EPSILON / NEAR, "order {k}: {} not {}", ours[k], reference[k]);
    }
}

#[test]
fn derivatives_agree_with_difference_quotients() {
    /// Balances the quotient's own error, `h^2`, against its rounding, `1e-16 / h`.
    const STEP: f64 = 1e-5;
    let symbol = Symbol::new("t", Dimension::NONE);
    for case in cases() {
        let at = |t: f64| series(&case.formula, t)[0];
        let quotient = (at(case.at + STEP) - at(case.at - STEP)) / (2.0 * STEP);
        let slope = series(&case.formula.derivative(&symbol), case.at)[0];
        assert!(
            (slope - quotient).abs() < 1e-8 * slope.abs().max(1.0),
            "{}: {slope} not {quotient}",
            case.name
        );
    }
}

#[test]
fn a_system_stands_on_the_tape_once() {
    let layout =
        Layout::new(vec![], Symbol::new("t", Dimension::NONE), vec![Symbol::new("p", Dimension::NONE)]);
    // Twice the same system, written twice.
    let unknowns: Vec<Expr> =
        (0..2).flat_map(|_| Expr::solve(dense(3), vec![t(), p(), Expr::one()])).collect();
    let tape = Tape::compile(&layout, &unknowns).expect("pure numbers");
    let count = |is: fn(&Op) -> bool| tape.ops().iter().filter(|op| is(op)).count();
    assert_eq!(count(|op| matches!(op, Op::Factor(_))), 1);
    assert_eq!(count(|op| matches!(op, Op::System(_))), 1);
    assert_eq!(count(|op| matches!(op, Op::Unknown { .. })), 3);
}

/// The equations themselves, put into the series of their unknowns.
#[test]
fn unknowns_satisfy_their_equations() {
    let (matrix, right) = (dense(4), [t().cos(), p() * t(), t().exp(), Expr::from(2)]);
    let x = Expr::solve(matrix.clone(), right.to_vec());
    for (row, right) in matrix.iter().zip(right) {
        let left = row.iter().zip(&x).fold(Expr::zero(), |sum, (a, x)| sum + a * x);
        let defect = series(&(left - right), 0.7);
        assert!(defect.iter().all(|c: &f64| c.abs() < 1e-14), "{defect:?}");
    }
}

#[test]
fn a_new_parameter_gives_new_factors() {
    let layout =
        Layout::new(vec![], Symbol::new("t", Dimension::NONE), vec![Symbol::new("p", Dimension::NONE)]);
    let matrix = vec![vec![p(), Expr::one()], vec![Expr::one(), p() * 2]];
    let tape = Tape::compile(&layout, &Expr::solve(matrix, vec![t(), Expr::one()])).expect("pure numbers");
    let mut jets = Jets::new(tape.into(), 1, &[P]);
    jets.bind(&[3.0]);
    jets.start(2.0, &[], Branches::Free);
    // By hand: [[3, 1], [1, 6]] x = [2, 1].
    assert!(
        (jets.value_of(0) - 11.0_f64 / 17.0).abs() < 1e-15 && (jets.value_of(1) - 1.0 / 17.0).abs() < 1e-15
    );
}
