//! What truncated series leave out: the bound holds at every place of a step, and is no more than some digits too large.

use std::sync::Arc;

use tumble_expr::{Binary, Branches, Dimension, Expr, Jets, Layout, Remainders, Symbol, Tape, Unary};

/// Low, so that what is left out is far larger than rounding errors.
const ORDER: usize = 7;
/// Coefficients of the state x along the step.
const MOTION: [f64; ORDER + 1] = [0.7, 0.9, -0.4, 0.2, -0.15, 0.05, 0.02, -0.01];
/// Rounding errors of values that are about 1.
const ROUNDING: f64 = 1e-14;

fn x() -> Expr {
    Expr::symbol("x", Dimension::NONE)
}

fn t() -> Expr {
    Expr::symbol("t", Dimension::NONE)
}

fn cases() -> Vec<(&'static str, Expr)> {
    let unary = Expr::unary;
    vec![
        ("linear", x() * 3 - t() / 7 + 2),
        ("product", x() * t() * (x() - 2)),
        ("cube", x().powi(3) - x()),
        ("waves", x().sin() * x().cos() + (t() * 3).cos()),
        ("quotient", (x() + 1) / (t() + 2)),
        ("over a product", t() / (x() * x() + 1)),
        ("root", (x() + t().sin() + 3).sqrt()),
        ("length", Expr::norm(vec![x() + 1, t().cos() * 2])),
        ("drag", Expr::norm(vec![x() + 1, t() - 2]) * (x() + 1)),
        ("exp", unary(Unary::Exp, -x() * x())),
        ("tanh", unary(Unary::Tanh, x() * 2 - 1) * t()),
        ("abs", (x() - 3).abs() * t()),
        ("first unknown of a system", solved()[0].clone()),
        ("second unknown of a system", solved()[1].clone()),
        ("third unknown of a system", solved()[2].clone()),
        ("unknown of a large system", chain()[7].clone()),
        ("quotient of a square", Expr::binary(Binary::SquareOver, x().sin(), x() + 2)),
    ]
}

/// Of a matrix that turns along the motion.
fn solved() -> Vec<Expr> {
    let matrix = vec![
        vec![x().cos() + 3, x().sin(), Expr::zero()],
        vec![-x().sin(), x().cos() + 2, t()],
        vec![Expr::zero(), Expr::one(), Expr::from(4)],
    ];
    Expr::solve(matrix, vec![t() * t(), x() + 1, Expr::one()])
}

/// Of so many unknowns that no inverse is found.
fn chain() -> Vec<Expr> {
    let entry = |i: i32, j: i32| match (i - j).abs() {
        0 => x().cos() + 3 + t() * (f64::from(i) / 20.0),
        1 => (x() + i.min(j)).sin(),
        _ => Expr::zero(),
    };
    let matrix = (0..20).map(|i| (0..20).map(|j| entry(i, j)).collect()).collect();
    Expr::solve(matrix, (0..20).map(|i| t() * i + 1).collect())
}

fn tape(formula: &Expr) -> Arc<Tape> {
    let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
    let layout = Layout::new(vec![symbol("x")], symbol("t"), vec![]);
    Arc::new(Tape::compile(&layout, std::slice::from_ref(formula)).expect("typed"))
}

fn value(series: &[f64], s: f64) -> f64 {
    series.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// Its series along the motion from t = 0.3, and the bound for a step of that length.
fn bounded(formula: &Expr, length: f64) -> (Vec<f64>, f64) {
    let mut jets = Jets::<f64>::new(tape(formula), ORDER, &[]);
    jets.start(0.3, &MOTION[..1], Branches::Free);
    for (k, coefficient) in MOTION.iter().enumerate().skip(1) {
        jets.set(0, k, *coefficient);
        jets.set(1, k, f64::from(u8::from(k == 1)));
        jets.extend(k);
    }
    let mut rests = Remainders::default();
    jets.remainders(&mut rests, ORDER, length);
    (jets.output(0).to_vec(), rests.of(jets.tape().outputs()[0]))
}

#[test]
fn what_is_left_out_is_within_the_bound() {
    for (name, formula) in cases() {
        let mut values = Jets::<f64>::new(tape(&formula), 0, &[]);
        for length in [0.05, 0.1, 0.2] {
            let (series, bound) = bounded(&formula, length);
            let mut worst: f64 = 0.0;
            for part in 0..=20 {
                let s = length * f64::from(part) / 20.0;
                values.start(0.3 + s, &[value(&MOTION, s)], Branches::Free);
                worst = worst.max((values.value_of(0) - value(&series, s)).abs());
            }
            assert!(worst <= bound + ROUNDING, "{name}: {worst:e} over {length}, not {bound:e}");
            // Signs are not told apart, and roots and quotients are divided by their least.
            assert!(bound <= 1e3 * worst + ROUNDING, "{name}: {bound:e} over {length} for {worst:e}");
        }
    }
}

#[test]
fn what_may_be_zero_has_no_bound() {
    for (name, formula) in ["quotient", "length", "root"].into_iter().zip([
        t() / (x() - 0.71),
        Expr::norm(vec![x() - 0.71, x() * 2 - 1.42]),
        (x() - 0.71).sqrt(),
    ]) {
        let bound = bounded(&formula, 0.2).1;
        assert!(bound.is_nan() || bound == f64::INFINITY, "{name}: {bound:e}");
    }
    assert!(!bounded(&Expr::unary(Unary::Exp, (x() - 3) * (x() - 3) * -1e4), 0.2).1.is_finite());
}

/// A chain of so many unknowns that no inverse is found, of which one entry of the diagonal is given.
fn chain_with(weak: &Expr) -> Expr {
    let entry = |i: i32, j: i32| match (i - j).abs() {
        0 if i == 9 => weak.clone(),
        0 => x().cos() + 4,
        1 => (t() + i.min(j)).sin() / 8,
        _ => Expr::zero(),
    };
    let matrix = (0..20).map(|i| (0..20).map(|j| entry(i, j)).collect()).collect();
    Expr::solve(matrix, (0..20).map(|i| t() * i + 1).collect())[9].clone()
}

/// At its beginning, middle and end the matrix is as good as any.
#[test]
fn a_large_matrix_that_is_singular_between_has_no_bound() {
    // The steps go from t = 0.3 to 0.5.
    for at in [0.33, 0.37, 0.43, 0.46] {
        let bound = bounded(&chain_with(&(Expr::from(at) - t())), 0.2).1;
        assert!(bound.is_nan() || bound == f64::INFINITY, "{at}: {bound:e}");
    }
}

/// What is nearly singular somewhere makes much of what is left out there, and nowhere else.
#[test]
fn a_large_matrix_that_is_weak_between_has_a_bound_that_holds_there() {
    let mut finite = 0;
    for weak in [1e-2, 1e-3, 1e-4] {
        let formula = chain_with(&((t() - 0.44) * (t() - 0.44) + 0.01 + weak));
        let mut values = Jets::<f64>::new(tape(&formula), 0, &[]);
        for length in [0.02, 0.05, 0.2] {
            let (series, bound) = bounded(&formula, length);
            finite += u32::from(bound.is_finite());
            for part in 0..=200 {
                let s = length * f64::from(part) / 200.0;
                values.start(0.3 + s, &[value(&MOTION, s)], Branches::Free);
                let off = (values.value_of(0) - value(&series, s)).abs();
                assert!(
                    bound.is_nan() || off <= bound + ROUNDING,
                    "{weak}: {off:e} at {s} of {length}, not {bound:e}"
                );
            }
        }
    }
    assert!(finite > 0, "no bound at all holds for nothing");
}

/// A step ahead is beyond what the series know, and the bound says so.
#[test]
fn a_step_ahead_has_no_small_bound() {
    for steep in [100, 1000, 10_000, 1_000_000] {
        let ahead = Expr::unary(Unary::Tanh, (x() - 0.85) * steep);
        let bump = Expr::unary(Unary::Exp, (x() - 0.85).powi(2) * -steep * steep);
        for (name, formula) in [("step", ahead), ("bump", bump)] {
            let bound = bounded(&formula, 0.3).1;
            assert!(bound.is_nan() || bound > 1.0, "{name} {steep}: {bound:e}");
        }
    }
}
