//! Short forms: what is found, and that it is always the same formula.

mod common;

use std::time::{Duration, Instant};

use common::{assert_same, g, length, mass, pure, speed, t};
use proptest::prelude::*;
use tumble_expr::{Binary, Dimension, Expr, Relation, Unary};
use tumble_notation::{Left, Math, MathError, Notation, polynomial_in};

/// No formula may take longer than this, however large: fifty times what it takes, for machines that are busy.
const PATIENCE: Duration = Duration::from_secs(120);

fn text(formula: &Expr) -> String {
    text_with(&Notation::new().positive(["m", "L", "k"]), formula)
}

fn text_with(notation: &Notation, formula: &Expr) -> String {
    let shown = notation.formula(formula).expect("short");
    assert_same(formula, &shown.lines[0].formula, &["m", "L", "k"]);
    let plain = |name: &str| tumble_notation::text(&Math::symbol(name));
    common::reader::assert_reads_as(&shown, &["m", "L", "k"], &plain);
    shown.text()
}

fn pi_over(n: i32) -> Expr {
    Expr::pi() / n
}

#[test]
fn exact_angles() {
    let half_turn = pi_over(2);
    for (formula, expected) in [
        (half_turn.cos(), "0"),
        (half_turn.sin(), "1"),
        (Expr::pi().cos(), "−1"),
        (Expr::pi().sin(), "0"),
        ((3 * pi_over(2)).sin(), "−1"),
        ((7 * pi_over(6)).sin(), "−1/2"),
        (pi_over(4).cos(), "√2/2"),
        (pi_over(3).sin(), "√3/2"),
        ((-pi_over(3)).cos(), "1/2"),
        ((2 * Expr::pi() / 7).cos(), "sin((3/14) π)"),
        (Expr::zero().sin(), "0"),
        (Expr::zero().cos(), "1"),
    ] {
        assert_eq!(text(&formula), expected);
    }
}

#[test]
fn signs_and_cases_that_are_known() {
    let [a, b] = ["a", "b"].map(pure);
    let l = || Expr::symbol("L", Dimension::NONE);
    let less = |x: Expr, y: Expr| Expr::compare(Relation::Less, x, y);
    for (formula, expected) in [
        ((3 * l() * &a).sign(), "sgn(a)"),
        ((-2 * l() * &a).sign(), "−sgn(a)"),
        ((&a * &a * &b).sign(), "sgn(a² b)"),
        (Expr::select(less(0.into(), 0.into()), a.clone(), b.clone()), "b"),
        (Expr::select(less(1.into(), 2.into()), a.clone(), b.clone()), "a"),
        (Expr::select(less(a.clone(), a.clone()), a.clone(), b.clone()), "b"),
    ] {
        assert_eq!(text(&formula), expected);
    }
}

#[test]
fn sums_that_divide_sums_are_taken_out() {
    let [a, b, c] = ["a", "b", "c"].map(pure);
    let sum = || &a + &b;
    let below = 3 * &a * &a * sum() + &b * sum() * sum() + 3 * &a * &a * &b + 3 * &a * &b * &b;
    for (formula, expected) in [
        ((&a * &a - &b * &b) / sum(), "a − b"),
        (sum() / (&a * &a - &b * &b), "1/(a − b)"),
        (6 * &c * sum() * sum() / below, "6 c/(3 a + b)"),
        ((&a.powi(3) - &b.powi(3)) / (&a - &b), "a² + a b + b²"),
        ((&a * &a + &b * &b) / sum(), "(a² + b²)/(a + b)"),
        (sum().sqrt() * sum() / (&a * &a - &b * &b), "√(a + b)/(a − b)"),
    ] {
        assert_eq!(text(&formula), expected);
    }
}

#[test]
fn signs_and_turns_of_angles() {
    let a = pure("a");
    for (formula, expected) in [
        ((-&a).sin(), "−sin a"),
        ((-&a).cos(), "cos a"),
        ((&a + Expr::pi()).cos(), "−cos a"),
        ((&a + Expr::pi()).sin(), "−sin a"),
        ((&a + pi_over(2)).sin(), "cos a"),
        ((&a - pi_over(2)).sin(), "−cos a"),
        ((&a + pi_over(2)).cos(), "−sin a"),
        ((pi_over(2) - &a).cos(), "sin a"),
        ((Expr::pi() - &a).sin(), "sin a"),
        ((-&a).tan(), "−tan a"),
        ((3 * &a).cos(), "cos(3 a)"),
    ] {
        assert_eq!(text(&formula), expected);
    }
}

#[test]
fn sums_of_angles_and_of_squares() {
    let (a, b) = (pure("a"), pure("b"));
    let (l, w) = (length("L"), Expr::symbol("w", Dimension::ANGULAR_RATE));
    for (formula, expected) in [
        (a.cos() * b.cos() + a.sin() * b.sin(), "cos(a − b)"),
        (a.cos() * b.cos() - a.sin() * b.sin(), "cos(a + b)"),
        (a.sin() * b.sin() - a.cos() * b.cos(), "−cos(a + b)"),
        (a.sin() * b.cos() + a.cos() * b.sin(), "sin(a + b)"),
        (a.sin() * b.cos() - a.cos() * b.sin(), "sin(a − b)"),
        (a.cos() * b.sin() - a.sin() * b.cos(), "−sin(a − b)"),
        (a.sin().powi(2) + a.cos().powi(2), "1"),
        (3 * &b * a.sin().powi(2) + 3 * &b * a.cos().powi(2), "3 b"),
        (&b - a.sin().powi(2) - a.cos().powi(2), "b − 1"),
    ] {
        assert_eq!(text(&formula), expected);
    }
    let speed = [&l * &w * a.cos(), &l * &w * a.sin()];
    assert_eq!(text(&Expr::norm(speed.to_vec())), "L |w|");
}

/// The place of one part less that of the centre of two.
#[test]
fn what_is_left_of_a_sum_over_its_denominator_cancels() {
    let (m, k, x) = (mass("m"), mass("k"), length("x"));
    let centre = &x * (2 * &m + 3 * &k) / (2 * (&m + 3 * &k));
    assert_eq!(text(&(&x - centre).powi(2)), "9 k² x²/(4 (3 k + m)²)");
}

#[test]
fn roots_and_lengths() {
    let (m, x, y) = (mass("m"), length("x"), length("y"));
    for (formula, expected) in [
        (m.powi(2).sqrt(), "m"),
        (x.powi(2).sqrt(), "|x|"),
        ((&x * &x).sqrt(), "|x|"),
        ((&m * &m * &x).sqrt(), "m √x"),
        (x.powi(3).sqrt() / x.sqrt(), "x"),
        (x.sqrt() * x.sqrt(), "x"),
        (Expr::norm(vec![x.clone()]), "|x|"),
        (Expr::norm(vec![0 * &x, -&x]), "|x|"),
        (Expr::norm(vec![-(&m * &x), &m * &y]), "m √(x² + y²)"),
        ((-(&m * &x)).abs(), "m |x|"),
        (m.abs(), "m"),
        ((&x - &y).abs() * (&y - &x).abs(), "(x − y)²"),
        ((4 * &x * &x).sqrt(), "2 |x|"),
        (Expr::from(8).sqrt() / Expr::from(2).sqrt(), "2"),
        ((10 * &m * (&x * (1 - pure("a").cos()))).sqrt(), "√(10 m x (1 − cos a))"),
        ((3 * &m * &x / 2).sqrt(), "√((3/2) m x)"),
        ((10 * &m * (&x * (1 - pure("a").cos())) / 7).sqrt(), "√((10/7) m x (1 − cos a))"),
        (x.sqrt() * (&x * &y).sqrt(), "√(x² y)"),
        (x.sqrt() * (-(&x * &y)).sqrt(), "√(x (−x y))"),
    ] {
        assert_eq!(text(&formula), expected);
    }
}

#[test]
fn products_and_quotients() {
    let (m, l, x, y) = (mass("m"), length("L"), length("x"), length("y"));
    let stiffness = Expr::symbol("k", Dimension::new(0, 1, -2));
    for (formula, expected) in [
        (&l * g() * &m, "m g L"),
        (g() * &m * 2, "2 m g"),
        (-(&stiffness * (&x - &l)) / &m, "(k/m) (L − x)"),
        ((&x + &y) * 2 / ((&x + &y) * 3 * &m), "2/(3 m)"),
        ((&x + &y) / (2 * &x + 2 * &y), "1/2"),
        (&m * g() * &x / (&m * (&x + &y)), "g x/(x + y)"),
        ((&x + &y) / &m, "(x + y)/m"),
        (&m * (&x + &y) - &m * &x - &m * &y, "0"),
        (speed("v").powi(2) / (2 * g()), "v²/(2 g)"),
        (&m * speed("v").powi(2) / 2, "m v²/2"),
        (1 / (2 * Expr::pi()) * (&stiffness / &m).sqrt(), "√(k/m)/(2 π)"),
        (x.powi(-2), "1/x²"),
        ((&x / &y).powi(2), "x²/y²"),
        (&x * (&x - &y) * (&x + &y), "x³ − x y²"),
    ] {
        assert_eq!(text(&formula), expected);
    }
}

#[test]
fn branches_are_cases() {
    let (x, y) = (length("x"), length("y"));
    let select = Expr::select(Expr::compare(Relation::Less, x.clone(), y.clone()), x.clone(), 2 * &y);
    let shown = Notation::new().formula(&select).expect("short");
    assert_eq!(shown.text(), "{x if x < y; 2 y otherwise}");
    assert_same(&select, &shown.lines[0].formula, &[]);
    let twice = Notation::new().formula(&(2 * &select * &y)).expect("short");
    assert_eq!(twice.text(), "2 y ({x if x < y; 2 y otherwise})");
}

#[test]
fn names_are_found_with_other_signs_and_numbers() {
    let (v, w) = (speed("rod.v"), speed("w"));
    let u = &w - &v;
    let notation = Notation::new().define("u", &u).define("|u|", &u.abs());
    assert_eq!(text_with(&notation, &((2 * &v - 2 * &w).abs() * &u)), "2 |u| u\nwhere u = w − v_rod");
    let notation = Notation::new().define("u", &u);
    assert_eq!(text_with(&notation, &((&v - &w).abs() * (&v - &w) / 2)), "−|u| u/2\nwhere u = w − v_rod");
    // A name that is not used is not explained.
    assert_eq!(text_with(&notation, &v), "v_rod");
}

#[test]
fn long_parts_that_repeat_get_names() {
    let (v, w, a) = (speed("v"), speed("w"), pure("a"));
    let long = (&w * a.cos() - &v * a.sin() + speed("c")) * 2;
    let formula = (&long / speed("d")).sin() + (&long / speed("j")).cos() + long.abs() / speed("f")
        - (&long / speed("h")).exp() * &a
        + (&long / speed("i")).tan();
    let shown = text(&formula);
    assert!(shown.contains("where u₁ = "), "{shown}");
    assert_eq!(shown.matches("cos a").count(), 1, "{shown}");
}

#[test]
fn units_of_a_name_and_of_a_symbol_do_not_mix() {
    // A symbol that is called like a definition is another thing.
    let u = speed("u");
    let named = Notation::new().define("u_1", &(speed("w") * 2 - &u));
    assert_eq!(text_with(&named, &((speed("w") * 2 - &u) * &u)), "u u₁\nwhere u₁ = 2 w − u");
}

#[test]
fn mistakes_are_refused() {
    let wrong = length("x") + mass("m");
    assert!(matches!(Notation::new().formula(&wrong), Err(MathError::Type(_))));
    assert!(matches!(Notation::new().formula(&Expr::from(f64::NAN)), Err(MathError::Type(_))));
    let named = Notation::new().define("u", &wrong);
    assert!(matches!(named.formula(&length("x")), Err(MathError::Type(_))));
    let factor = Left::times(&wrong, Math::symbol("a"));
    assert!(matches!(Notation::new().equation(factor, &length("x")), Err(MathError::Type(_))));
}

#[test]
fn quotients_by_zero_are_shown_as_written() {
    let x = length("x");
    for formula in [&x / 0, Expr::from(0) / 0, Expr::zero().powi(-1), &x / (&x - &x)] {
        let shown = Notation::new().formula(&formula).expect("shown");
        assert!(!shown.text().is_empty());
    }
}

#[test]
fn huge_numbers_are_cut_or_refused() {
    let huge = Expr::from(1e300) * Expr::from(1e300) * pure("a");
    assert_eq!(Notation::new().formula(&huge).expect("shown").text(), "1·10⁶⁰⁰ a");
    let mut tower = Expr::from(3);
    for _ in 0..40 {
        tower = &tower * &tower;
    }
    let refused = Notation::new().formula(&tower);
    assert!(matches!(refused, Err(MathError::TooLong { .. })), "{refused:?}");
    let exponent = pure("a").powi(i32::MAX).powi(i32::MAX);
    assert!(Notation::new().formula(&exponent).is_err());
    let minus = Notation::new().formula(&Expr::from(-2).powi(i32::MIN + 1));
    assert!(minus.is_err());
}

#[test]
fn roots_of_negative_numbers_end() {
    let i = Expr::from(-1).sqrt();
    for formula in [1 / &i, &i * &i * &i, (-pure("a").powi(2)).sqrt().powi(-3)] {
        assert!(Notation::new().formula(&formula).is_ok());
    }
}

fn timed(name: &str, work: impl FnOnce() -> Result<usize, MathError>) {
    let start = Instant::now();
    let result = work();
    let took = start.elapsed();
    println!("{name}: {result:?} in {took:?}");
    assert!(took < PATIENCE, "{name} took {took:?}");
}

fn characters(formula: &Expr) -> Result<usize, MathError> {
    let shown = Notation::new().formula(formula)?;
    let lines = shown.lines.iter().chain(&shown.definitions);
    let written =
        |math: &Math| tumble_notation::text(math).len() + tumble_notation::mathml_in_pieces(math).len();
    Ok(lines.map(|line| written(&line.math())).sum())
}

#[test]
fn deep_formulas_take_a_bounded_time() {
    for depth in [5_000, 100_000] {
        let mut chain = pure("x");
        for _ in 0..depth {
            chain = (chain + pure("y")).sin();
        }
        timed("sines", || characters(&chain));
        let mut fractions = pure("x");
        for _ in 0..depth {
            fractions = 1 / (fractions + pure("y"));
        }
        timed("fractions", || characters(&fractions));
        timed("polynomial", || {
            Ok(polynomial_in(&chain, &tumble_expr::Symbol::new("x", Dimension::NONE))
                .map_or(0, |all| all.len()))
        });
    }
}

#[test]
fn shared_formulas_take_a_bounded_time() {
    let mut doubled = pure("x");
    for level in 0..200 {
        doubled = (&doubled * pure("a") + level).sin() + &doubled * doubled.cos();
    }
    timed("doubled", || characters(&doubled));
    let mut squared = pure("x") + pure("y");
    for _ in 0..60 {
        squared = &squared * &squared + pure("z");
    }
    timed("squared", || characters(&squared));
    let mut sum = pure("x0");
    for index in 1..3_000 {
        sum = sum + pure(&format!("x{index}")) * pure(&format!("y{index}"));
    }
    timed("wide", || characters(&(&sum * &sum)));
    timed("wide norm", || characters(&Expr::norm((0..300).map(|i| pure(&format!("z{i}")) - &sum).collect())));
    let mut product = pure("x0") + 1;
    for index in 1..200 {
        product = product * (pure(&format!("x{index}")) + index);
    }
    timed("product of sums", || characters(&product));
}

fn leaf() -> impl Strategy<Value = Expr> {
    prop_oneof![
        (-6i32..7).prop_map(Expr::from),
        prop_oneof![Just(0.5), Just(9.81), Just(-0.02)].prop_map(Expr::from),
        Just(Expr::pi()),
        prop_oneof![Just("x"), Just("y"), Just("m"), Just("theta"), Just("rod.omega")].prop_map(pure),
    ]
}

fn formulas() -> impl Strategy<Value = Expr> {
    leaf().prop_recursive(5, 40, 3, |inner| {
        let unary = prop_oneof![
            Just(Unary::Neg),
            Just(Unary::Sin),
            Just(Unary::Cos),
            Just(Unary::Tan),
            Just(Unary::Atan),
            Just(Unary::Tanh),
            Just(Unary::Exp),
            Just(Unary::Sqrt),
            Just(Unary::Abs),
            Just(Unary::Log),
            Just(Unary::Cosh),
        ];
        let binary = prop_oneof![
            Just(Binary::Add),
            Just(Binary::Sub),
            Just(Binary::Mul),
            Just(Binary::Div),
            Just(Binary::SquareOver)
        ];
        prop_oneof![
            1 => (unary, inner.clone()).prop_map(|(op, a)| Expr::unary(op, a)),
            3 => (binary, inner.clone(), inner.clone()).prop_map(|(op, a, b)| Expr::binary(op, a, b)),
            1 => (inner.clone(), -3i32..4).prop_map(|(a, n)| a.powi(n)),
            1 => prop::collection::vec(inner, 1..4).prop_map(Expr::norm),
        ]
    })
}

/// Rounding may make nonsense of a formula that subtracts nearly equal numbers; a small change of the symbols shows it.
fn is_steady(values: &[f64], evaluate: &mut dyn FnMut(&[f64]) -> Vec<f64>) -> bool {
    let here = evaluate(values);
    let moved: Vec<f64> = values.iter().map(|value| value * (1.0 + 1e-13)).collect();
    let there = evaluate(&moved);
    let fine = |a: &f64, b: &f64| a.is_finite() && a.abs() < 1e6 && (a - b).abs() < 1e-10 * a.abs().max(1e-4);
    here.iter().zip(&there).all(|(a, b)| fine(a, b))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn what_is_shown_is_what_was_given(formula in formulas(), named in formulas()) {
        let notation = Notation::new().positive(["m"]).define("q", &named);
        let whole = &formula * &named + &formula;
        if let Ok(shown) = notation.formula(&whole) {
            let shown_formula = shown.lines[0].formula.clone();
            let mut evaluator = common::Evaluator::new(&[whole, shown_formula]);
            let mut points = common::Points::new();
            for _ in 0..4 {
                let values: Vec<f64> = evaluator.names.clone().iter().map(|_| points.next()).collect();
                // A root of what is zero but for rounding is steady, and rounding all the same.
                let noise = evaluator.noise(&values).into_iter().fold(0.0, f64::max);
                if !is_steady(&values, &mut |values| evaluator.at(values)) || noise.is_nan() || noise > 1e-10 {
                    continue;
                }
                let found = evaluator.at(&values);
                let scale = found[0].abs().max(1e-2);
                // What is zero but for rounding in one form may be a zero in the other.
                prop_assert!((found[0] - found[1]).abs() < 1e-9 * scale + noise, "{} {found:?}", shown.text());
                let text = tumble_notation::text(&shown.lines[0].right);
                if text.contains('…') {
                    continue;
                }
                let mut known: std::collections::HashMap<String, f64> = evaluator.names.iter().zip(&values)
                    .map(|(name, value)| (tumble_notation::text(&Math::symbol(name)), *value)).collect();
                known.insert("π".to_owned(), std::f64::consts::PI);
                known.insert("e".to_owned(), std::f64::consts::E);
                let mut exact = true;
                for line in shown.definitions.iter().rev() {
                    let mut own = common::Evaluator::new(std::slice::from_ref(&line.formula));
                    let place = |name: &String| evaluator.names.iter().position(|other| other == name);
                    let all: Option<Vec<f64>> = own.names.clone().iter().map(|name| Some(values[place(name)?])).collect();
                    let Some(all) = all else { exact = false; break };
                    known.insert(tumble_notation::text(line.left.as_ref().expect("named")), own.at(&all)[0]);
                }
                if exact && known.values().all(|value| value.is_finite()) {
                    let read = common::reader::value(&text, &known);
                    prop_assert!((found[1] - read).abs() < 1e-8 * scale, "{text} reads as {read}, not {}", found[1]);
                }
            }
        }
        let _ = t();
    }
}
