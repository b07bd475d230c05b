//! Intervals and rounding errors: what they say of every operation holds for the numbers themselves.

use std::sync::Arc;

use tumble_expr::{
    Binary, Branches, Dimension, Expr, Interval, Jets, Kernels, Layout, Rounded, Rounding, Scalar, Symbol,
    Tape, Unary,
};

const ORDER: usize = 5;

fn t() -> Expr {
    Expr::symbol("t", Dimension::NONE)
}

/// Formulas with a place that they are smooth about, and how far.
fn cases() -> Vec<(&'static str, Expr, f64, f64)> {
    let unary = |op| Expr::unary(op, t() * 1.7 - 0.3);
    let inner = t() * 0.4 + t().sin() * 0.1;
    let solved = || {
        let matrix = vec![vec![t().cos() + 3, t()], vec![t() * 0.5, t().exp() + 1]];
        Expr::solve(matrix, vec![t().sin(), Expr::from(1) + t()])
    };
    // Of so many unknowns that no inverse is found.
    let large = || {
        let entry = |i: i32, j: i32| match (i - j).abs() {
            0 => t().cos() + 4,
            1 => (t() + i.min(j)).sin(),
            _ => Expr::zero(),
        };
        let matrix = (0..20).map(|i| (0..20).map(|j| entry(i, j)).collect()).collect();
        Expr::solve(matrix, (0..20).map(|i| t() * i + 1).collect())
    };
    vec![
        ("sum", t().sin() + t().exp() * t() - 0.3, 0.7, 1.0),
        ("quotient", t().sin() / (t() + 2), 0.7, 0.5),
        ("powers", t().powi(3) + (t() + 2).powr(tumble_expr::Exponent::new(3, 2)) + t().powi(-2), 1.7, 0.3),
        ("variable exponent", Expr::binary(Binary::Pow, t() + 2, t()), 0.7, 0.2),
        ("root", (t() + 2).sqrt(), 0.7, 0.5),
        ("exp", unary(Unary::Exp), 0.7, 0.5),
        ("log", unary(Unary::Log), 0.7, 0.2),
        ("waves", t().sin() * t().cos() + (t() * 9).cos(), 0.7, 2.0),
        ("tan", t().tan(), 0.7, 0.3),
        ("tanh", unary(Unary::Tanh), 0.7, 1.0),
        ("steep tanh", Expr::unary(Unary::Tanh, (t() - 0.7) * 100), 0.7, 1.0),
        ("hyperbolic", unary(Unary::Sinh) + unary(Unary::Cosh), 0.7, 0.5),
        ("inverse", Expr::unary(Unary::Asin, inner.clone()) + Expr::unary(Unary::Acos, inner), 0.7, 0.5),
        ("atan", unary(Unary::Atan), 0.7, 1.0),
        ("atan2", Expr::binary(Binary::Atan2, t().sin() + 0.2, t().cos() + 0.3), 0.7, 0.4),
        ("abs", (t().sin() - 3).abs() + t().sign() * t(), 0.7, 0.5),
        ("norm", Expr::norm(vec![t().sin(), t().cos() * 2, t()]), 0.7, 0.5),
        ("square over", Expr::binary(Binary::SquareOver, t().sin(), t() + 2), 0.7, 0.5),
        ("unknowns", solved().remove(0) + solved().remove(1), 0.2, 0.2),
        ("unknowns of a large system", large().remove(0) + large().remove(11), 0.2, 0.05),
    ]
}

fn tape(formula: &Expr, rounding: Rounding) -> Arc<Tape> {
    let layout = Layout { rounding, ..Layout::new(vec![], Symbol::new("t", Dimension::NONE), vec![]) };
    Arc::new(Tape::compile(&layout, std::slice::from_ref(formula)).expect("typed"))
}

fn series<S: Kernels>(jets: &mut Jets<S>, at: S) -> Vec<S> {
    jets.start(at, &[], Branches::Free);
    for k in 1..=ORDER {
        jets.set(0, k, if k == 1 { S::one() } else { S::zero() });
        jets.extend(k);
    }
    jets.output(0).to_vec()
}

/// Coefficients about every place of an interval lie in those of the interval, and the interval shrinks with its width.
#[test]
fn coefficients_are_enclosed() {
    for (name, formula, middle, reach) in cases() {
        let tape = tape(&formula, Rounding::NEAREST);
        let mut boxes = Jets::<Interval>::new(tape.clone(), ORDER, &[]);
        let mut numbers = Jets::<f64>::new(tape, ORDER, &[]);
        for reach in [reach, reach * 1e-3, reach * 1e-6] {
            let enclosed = series(&mut boxes, Interval::new(middle - reach, middle + reach));
            for part in 0..=20 {
                let at = middle + reach * (f64::from(part) / 10.0 - 1.0);
                for (k, number) in series(&mut numbers, at).into_iter().enumerate() {
                    // The last digit of the number itself is rounded.
                    let slack = 1e-13 * number.abs();
                    let holds = enclosed[k].low - slack <= number && number <= enclosed[k].high + slack;
                    assert!(holds, "{name}: order {k} at {at} is {number}, not in {:?}", enclosed[k]);
                }
            }
        }
        let narrow = series(&mut boxes, Interval::new(middle - reach * 1e-6, middle + reach * 1e-6));
        // Orders are compared on the way that the formula changes within.
        let size = narrow.iter().map(|part| part.magnitude()).fold(1.0, f64::max);
        for (k, part) in narrow.iter().enumerate() {
            assert!(part.high - part.low <= 1e-3 * size, "{name}: order {k} is {part:?}");
        }
    }
}

/// From where a length or a quotient vanishes on, their coefficients are enclosed too.
#[test]
fn what_vanishes_is_enclosed() {
    let speed = Expr::norm(vec![t().sin() * 3, t() * 4 + t().powi(2)]);
    let quotient = Expr::binary(Binary::SquareOver, t().sin() * 2, t() * 3 + t().powi(2));
    for (name, formula) in [("speed", speed.clone()), ("drag", &speed * (t() + 1)), ("quotient", quotient)] {
        let tape = tape(&formula, Rounding::NEAREST);
        let mut boxes = Jets::<Interval>::new(tape.clone(), ORDER, &[]);
        let way = Interval::new(0.0, 0.1);
        boxes.forget(Interval::ENTIRE);
        boxes.set_vanishing(&[true]);
        boxes.set_elapsed(way);
        series(&mut boxes, way);
        let enclosed = series(&mut boxes, way);
        let mut numbers = Jets::<f64>::new(tape, ORDER, &[]);
        for place in 1..=20 {
            let at = 0.005 * f64::from(place);
            for (k, number) in series(&mut numbers, at).into_iter().enumerate().take(ORDER) {
                let slack = 1e-9 * number.abs();
                let Interval { low, high } = enclosed[k];
                assert!(
                    low - slack <= number && number <= high + slack,
                    "{name}: order {k} at {at}: {number} in {enclosed:?}"
                );
                assert!(high - low < 100.0, "{name}: order {k} is {:?}", enclosed[k]);
            }
        }
    }
}

/// Rounding in the numbers of a formula changes its value by no more than some of the error that is told.
#[test]
fn rounding_errors_cover_what_perturbed_numbers_do() {
    for (name, formula, at, _) in cases() {
        let formula = &formula * (Expr::from(0.1) + 0.7) - Expr::from(0.3);
        let value = |rounding| {
            let mut jets = Jets::<f64>::new(tape(&formula, rounding), 0, &[]);
            jets.start(at, &[], Branches::Free);
            jets.value_of(0)
        };
        let mut rounded = Jets::<Rounded>::new(tape(&formula, Rounding::NEAREST), 0, &[]);
        rounded.start(Rounded::splat(at), &[], Branches::Free);
        let (nearest, noise) = (value(Rounding::NEAREST), rounded.value_of(0).noise());
        let worst =
            (0..50).map(|seed| (value(Rounding::perturbed(seed)) - nearest).abs()).fold(0.0, f64::max);
        assert!(worst <= 5.0 * noise, "{name}: {worst:e} and {noise:e}");
        assert!(noise <= 1e3 * worst, "{name}: {worst:e} and {noise:e}");
    }
}
