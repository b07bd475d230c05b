//! One suite for every evaluator and every operation.
//!
//! The reference shares no code with the evaluators: formulas are evaluated on a circle of complex numbers by
//! another library, and Cauchy's integral formula gives their Taylor coefficients.

mod links;
mod systems;

use std::sync::Arc;

use num_complex::Complex64;
use tumble_expr::{
    Binary, Branches, Dimension, Expr, Jets, Lanes, Layout, Node, Symbol, Tape, Unary, nearest,
};

const ORDER: usize = 14;
/// Points on the circle: enough that what aliases onto low orders is below rounding on the radii used.
const POINTS: usize = 256;
/// Relative agreement asked for; Cauchy's formula itself loses some digits at high orders.
const TOLERANCE: f64 = 2e-12;

struct Case {
    name: &'static str,
    formula: Expr,
    /// Where the series is taken.
    at: f64,
    /// Radius of the circle: inside the domain where the formula is analytic.
    radius: f64,
}

fn t() -> Expr {
    Expr::symbol("t", Dimension::NONE)
}

fn p() -> Expr {
    Expr::symbol("p", Dimension::NONE)
}

const P: f64 = 1.7;

fn cases() -> Vec<Case> {
    let case = |name, formula, at, radius| Case { name, formula, at, radius };
    let unary = |op| Expr::unary(op, t() * p() - 0.3);
    let binary = |op, a: Expr, b: Expr| Expr::binary(op, a, b);
    let inner = t() * 0.4 + t().sin() * 0.1;
    let mut cases = vec![
        case("number", t() * 0 + 2.5, 0.7, 1.0),
        case("pi", t() + Expr::pi(), 0.7, 1.0),
        case("neg", -(t().sin()), 0.7, 1.0),
        case("add", t().sin() + t().exp(), 0.7, 1.0),
        case("sub", t().sin() - t().exp(), 0.7, 1.0),
        case("mul", t().sin() * t().exp(), 0.7, 1.0),
        case("scale", p() * t().exp(), 0.7, 1.0),
        case("div", t().sin() / (t() + 2), 0.7, 1.5),
        case("shrink", t().exp() / p(), 0.7, 1.0),
        case("square", &t().sin() * &t().sin(), 0.7, 1.0),
        case("cube", t().sin().powi(3), 0.7, 1.0),
        case("inverse square", t().powi(-2), 1.7, 1.0),
        case("sqrt", (t() + 2).sqrt(), 0.7, 1.5),
        case("power 3/2", (t() + 2).powr(tumble_expr::Exponent::new(3, 2)), 0.7, 1.5),
        case("power of a parameter", binary(Binary::Pow, t() + 2, p()), 0.7, 1.5),
        case("variable exponent", binary(Binary::Pow, t() + 2, t()), 0.7, 1.5),
        case("high integer power", t().powi(100), 1.01, 0.03),
        case("exp", unary(Unary::Exp), 0.7, 1.0),
        case("log", unary(Unary::Log), 0.7, 0.4),
        case("sin", unary(Unary::Sin), 0.7, 1.0),
        case("cos", unary(Unary::Cos), 0.7, 1.0),
        case("sin and cos", t().cos() * t().sin(), 0.7, 1.0),
        case("tan", t().tan() + t().tan() * t(), 0.7, 0.6),
        case("tanh", unary(Unary::Tanh), 0.7, 0.6),
        case("sinh", unary(Unary::Sinh), 0.7, 1.0),
        case("cosh", unary(Unary::Cosh), 0.7, 1.0),
        case("asin", Expr::unary(Unary::Asin, inner.clone()), 0.7, 0.8),
        case("acos", Expr::unary(Unary::Acos, inner.clone()), 0.7, 0.8),
        case("atan", Expr::unary(Unary::Atan, inner.clone()), 0.7, 0.8),
        case("atan2", binary(Binary::Atan2, t().sin() + 0.2, t().cos() + 0.3), 0.7, 0.4),
        case("square over", binary(Binary::SquareOver, t().sin(), t() + 2), 0.7, 1.5),
        case("table", Expr::table(&measured(), t().sin()), 0.7, 0.3),
        case("abs, positive", unary(Unary::Abs), 0.7, 0.3),
        case("abs, negative", Expr::unary(Unary::Abs, t().sin() - 3), 0.7, 0.5),
        case("sign", unary(Unary::Sign) * t(), 0.7, 0.3),
        case("step", (t() - 0.9).step() * t() + (t() - 0.2).step() * t().exp(), 0.7, 0.1),
        case("min", binary(Binary::Min, t().sin(), t().exp()), 0.7, 0.5),
        case("max", binary(Binary::Max, t().sin(), t().exp()), 0.7, 0.5),
        case("if", choose(t(), Expr::from(0.9)), 0.7, 0.1),
        case("if, other side", choose(t(), Expr::from(0.2)), 0.7, 0.1),
        case("norm", Expr::norm(vec![t().sin(), t().cos() * 2, t()]), 0.7, 0.5),
        case("norm of one", Expr::norm(vec![t().sin() - 2]), 0.7, 0.5),
    ];
    cases.extend(systems::cases());
    cases
}

/// A straight line, measured: its spline is the line itself, so the reference is known on the complex plane.
fn measured() -> std::sync::Arc<tumble_expr::Table> {
    let rows: Vec<[f64; 2]> = [0.0, 0.5, 1.5, 3.0].map(|x| [x, 2.0 * x - 1.0]).into();
    let dimensions = [Dimension::NONE; 2];
    let (linear, hold) = (tumble_expr::Interpolation::Cubic, tumble_expr::Outside::Hold);
    std::sync::Arc::new(
        tumble_expr::Table::new("measured", dimensions, &rows, linear, hold).expect("a table"),
    )
}

fn choose(a: Expr, b: Expr) -> Expr {
    Expr::select(Expr::compare(tumble_expr::Relation::Less, a, b), t().sin(), t().exp())
}

fn tape(formula: &Expr) -> Arc<Tape> {
    let symbol = |name: &str| Symbol::new(name, Dimension::NONE);
    let layout = Layout::new(vec![], symbol("t"), vec![symbol("p")]);
    Arc::new(Tape::compile(&layout, std::slice::from_ref(formula)).expect("a well-typed formula"))
}

/// Coefficients of the formula's series around `at`, in as many lanes as S has (lane i is expanded around `at[i]`).
fn series<S: tumble_expr::Kernels>(formula: &Expr, at: S) -> Vec<S> {
    let mut jets = Jets::new(tape(formula), ORDER, &[S::splat(P)]);
    jets.start(at, &[], Branches::Free);
    for k in 1..=ORDER {
        jets.set(0, k, if k == 1 { S::one() } else { S::zero() });
        jets.extend(k);
    }
    jets.output(0).to_vec()
}

/// The formula at a complex time, on the branch that holds at the real time `at`.
fn complex(formula: &Expr, z: Complex64, at: f64) -> Complex64 {
    let value = |part: &Expr| complex(part, z, at);
    let here = |part: &Expr| complex(part, Complex64::new(at, 0.0), at).re;
    let side = |part: &Expr| Complex64::from(here(part).signum());
    match formula.node() {
        Node::Number(number) => nearest(number).into(),
        Node::Pi => std::f64::consts::PI.into(),
        Node::Symbol(symbol) => {
            if &*symbol.name == "t" {
                z
            } else {
                P.into()
            }
        }
        Node::Unary(op, a) => match op {
            Unary::Neg => -value(a),
            Unary::Sin => value(a).sin(),
            Unary::Cos => value(a).cos(),
            Unary::Tan => value(a).tan(),
            Unary::Asin => value(a).asin(),
            Unary::Acos => value(a).acos(),
            Unary::Atan => value(a).atan(),
            Unary::Sinh => value(a).sinh(),
            Unary::Cosh => value(a).cosh(),
            Unary::Tanh => value(a).tanh(),
            Unary::Exp => value(a).exp(),
            Unary::Log => value(a).ln(),
            Unary::Sqrt => value(a).sqrt(),
            Unary::Abs => side(a) * value(a),
            Unary::Sign => side(a),
            Unary::Step => (0.5 * (here(a).signum() + 1.0)).into(),
        },
        Node::Binary(op, a, b) => match op {
            Binary::Add => value(a) + value(b),
            Binary::Sub => value(a) - value(b),
            Binary::Mul => value(a) * value(b),
            Binary::Div => value(a) / value(b),
            Binary::Pow => value(a).powc(value(b)),
            // The angle of x + i y, continued: the imaginary part's logarithm is not enough off the real line.
            Binary::Atan2 => {
                let i = Complex64::i();
                (((value(b) + i * value(a)) / (value(b) - i * value(a))).ln()) / (2.0 * i)
            }
            Binary::SquareOver => value(a) * value(a) / value(b),
            Binary::Min => {
                if here(a) < here(b) {
                    value(a)
                } else {
                    value(b)
                }
            }
            Binary::Max => {
                if here(a) > here(b) {
                    value(a)
                } else {
                    value(b)
                }
            }
        },
        Node::Compare(..) => unreachable!("conditions are read by `if`"),
        Node::Select(condition, a, b) => {
            let [left, right] = condition.children()[..] else { unreachable!("two sides") };
            if here(left) < here(right) { value(a) } else { value(b) }
        }
        Node::Table(..) => {
            // The line that `measured` was read off.
            2.0 * value(formula.children()[0]) - 1.0
        }
        Node::System(..) => unreachable!("systems are read by their unknowns"),
        Node::Unknown(system, row) => {
            let Node::System(shape, parts) = system.node() else { unreachable!("unknowns are of systems") };
            systems::cramer(shape, &parts.iter().map(value).collect::<Vec<_>>(), *row as usize)
        }
        Node::Norm(parts) => parts.iter().map(|part| value(part).powi(2)).sum::<Complex64>().sqrt(),
    }
}

/// Cauchy's formula: the trapezoidal rule on a circle is exact to rounding for analytic functions.
fn cauchy(case: &Case) -> Vec<f64> {
    let angle = |j: usize| std::f64::consts::TAU * j as f64 / POINTS as f64;
    let values: Vec<Complex64> = (0..POINTS)
        .map(|j| complex(&case.formula, case.at + Complex64::from_polar(case.radius, angle(j)), case.at))
        .collect();
    let coefficient = |k: usize| {
        let sum: Complex64 = values
            .iter()
            .enumerate()
            .map(|(j, f)| f * Complex64::from_polar(1.0, -(k as f64) * angle(j)))
            .sum();
        sum.re / POINTS as f64 / case.radius.powi(k as i32)
    };
    (0..=ORDER).map(coefficient).collect()
}

#[test]
fn series_agree_with_cauchys_formula() {
    for case in cases() {
        let (ours, reference) = (series(&case.formula, case.at), cauchy(&case));
        // A coefficient matters by what it adds on the circle.
        let size = (0..=ORDER).map(|k| (reference[k] * case.radius.powi(k as i32)).abs()).fold(0.0, f64::max);
        for k in 0..=ORDER {
            let error = ((ours[k] - reference[k]) * case.radius.powi(k as i32)).abs() / size;
            assert!(error < TOLERANCE, "{}: order {k} is {} not {}", case.name, ours[k], reference[k]);
        }
    }
}

#[test]
fn values_are_the_series_at_order_zero() {
    for case in cases() {
        let mut values = Jets::new(tape(&case.formula), 0, &[P]);
        values.start(case.at, &[], Branches::Free);
        assert_eq!(
            values.value_of(0).to_bits(),
            series(&case.formula, case.at)[0].to_bits(),
            "{}",
            case.name
        );
    }
}

#[test]
fn every_width_gives_the_same_bits() {
    fn check<const N: usize>(case: &Case) {
        let at: [f64; N] = std::array::from_fn(|lane| case.at + 0.01 * lane as f64);
        let lanes = series(&case.formula, Lanes(at));
        for (lane, at) in at.into_iter().enumerate() {
            for (k, single) in series(&case.formula, at).into_iter().enumerate() {
                let bits = (lanes[k].0[lane].to_bits(), single.to_bits());
                assert_eq!(bits.0, bits.1, "{}: lane {lane}, order {k}", case.name);
            }
        }
    }
    for case in cases() {
        check::<1>(&case);
        check::<4>(&case);
        check::<8>(&case);
        check::<16>(&case);
    }
}

/// Speed of a body released from rest: components that vanish together leave a series, not a singular root.
#[test]
fn norm_factors_out_the_common_power() {
    let v = vec![t().sin() * 3, Expr::from(4) * t() + t().powi(2)];
    let ours = series(&Expr::norm(v.clone()), 0.0);
    let quotient = v.into_iter().map(|part| part / t()).collect();
    let case = Case { name: "quotient", formula: Expr::norm(quotient), at: 0.0, radius: 0.5 };
    let reference = cauchy(&case);
    assert_eq!(ours[0], 0.0);
    for k in 1..=ORDER {
        let error = (ours[k] - reference[k - 1]).abs() * case.radius.powi(k as i32);
        assert!(error < TOLERANCE, "order {k}: {} not {}", ours[k], reference[k - 1]);
    }
}

/// Numerator and denominator that vanish together leave a series.
#[test]
fn square_over_factors_out_the_common_power() {
    let (a, b) = (t().sin() * t(), t() * 3 + t().powi(2));
    let ours = series(&Expr::binary(Binary::SquareOver, a, b), 0.0);
    let formula = t().sin() * t() * t().sin() / (t() + 3);
    let reference = cauchy(&Case { name: "quotient", formula, at: 0.0, radius: 1.0 });
    for k in 0..=ORDER {
        assert!((ours[k] - reference[k]).abs() < TOLERANCE, "order {k}: {} not {}", ours[k], reference[k]);
    }
}

#[test]
fn norm_neither_overflows_nor_vanishes() {
    for scale in [1e200, 1e-200] {
        let length = series(&Expr::norm(vec![t() * 3 * scale, t() * 4 * scale]), 1.0)[0];
        assert!((length / (5.0 * scale) - 1.0).abs() < 4.0 * f64::EPSILON, "{length}");
    }
}

#[test]
fn comparisons_at_equality() {
    let at_equality = |relation| {
        let condition = Expr::compare(relation, t(), Expr::from(2));
        series(&Expr::select(condition, Expr::from(1), Expr::from(0) + t()), 2.0)[0]
    };
    assert_eq!(at_equality(tumble_expr::Relation::LessEqual), 1.0);
    assert_eq!(at_equality(tumble_expr::Relation::Less), 2.0);
}

#[test]
fn frozen_branches_stay_on_their_side() {
    let mut values = Jets::new(tape(&t().abs()), 0, &[P]);
    values.start(2.0, &[], Branches::Frozen(&[-1.0]));
    assert_eq!(values.value_of(0), -2.0);
    values.start(-2.0, &[], Branches::Free);
    assert_eq!(values.value_of(0), 2.0);
    assert_eq!(values.signs(), [-1.0]);
}

#[test]
fn zero_to_a_power_is_no_special_case() {
    assert_eq!(series(&t().powi(3), 0.0)[..5], [0.0, 0.0, 0.0, 1.0, 0.0]);
}

/// What overflows far from a bump leaves nothing of it, to every order.
#[test]
fn one_over_what_overflows_is_zero() {
    let bump = Expr::from(1) / Expr::unary(Unary::Cosh, t() * 1000).powi(2);
    assert_eq!(series(&bump, 1.0), [0.0; ORDER + 1]);
    assert_eq!(series(&bump, -1.0), [0.0; ORDER + 1]);
}
