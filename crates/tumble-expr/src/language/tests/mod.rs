//! The language as a whole: meanings, mistakes, and texts that mean nothing.

mod meaning;
mod mistakes;
mod robust;
mod scenes;

use super::{FormulaError, Function, Scope, Value, parse};
use crate::expr::Node;
use crate::{Binary, Dimension, Expr, Relation, Unary, Vector};

/// Names of a small scene: a pendulum's parameters, the time, a body.
fn scope() -> Scope {
    let mut scope = Scope::new();
    let scalars = [
        ("t", Dimension::TIME),
        ("T", Dimension::TIME),
        ("m", Dimension::MASS),
        ("L", Dimension::LENGTH),
        ("R", Dimension::LENGTH),
        ("V", Dimension::SPEED),
        ("w1", Dimension::SPEED),
        ("gravity", Dimension::ACCELERATION),
        ("rod.angle", Dimension::NONE),
        ("rod.tip.vx", Dimension::SPEED),
    ];
    for (name, dimension) in scalars {
        scope.define(name, Expr::symbol(name, dimension)).expect("names are fit");
    }
    let component = |name| Expr::symbol(name, Dimension::LENGTH);
    let vector = Vector::planar(component("r.x"), component("r.y"));
    scope.define("r", vector).expect("name is fit");
    let wind = Function::parse("w(t)", "0.5*w1*(1 + cos(2*pi*t/T))").expect("parses");
    scope.define_function(wind).expect("name is fit");
    scope
}

fn check(text: &str) -> Result<Value, Vec<FormulaError>> {
    parse(text)?.check(&scope())
}

fn number(text: &str) -> Expr {
    match check(text) {
        Ok(Value::Scalar(expr)) => expr,
        other => panic!("{text}: {other:?}"),
    }
}

/// The value where every symbol is 2, by plain recursion: an evaluator that shares nothing with the others.
fn evaluate(expr: &Expr) -> f64 {
    use num_traits::ToPrimitive;
    match expr.node() {
        Node::Number(value) => value.to_f64().expect("finite"),
        Node::Pi => std::f64::consts::PI,
        Node::Symbol(_) => 2.0,
        Node::Unary(op, a) => unary(*op, evaluate(a)),
        Node::Binary(op, a, b) => binary(*op, evaluate(a), evaluate(b)),
        Node::Compare(Relation::Less, a, b) => f64::from(evaluate(a) < evaluate(b)),
        Node::Compare(Relation::LessEqual, a, b) => f64::from(evaluate(a) <= evaluate(b)),
        Node::Select(condition, a, b) => evaluate(if evaluate(condition) > 0.0 { a } else { b }),
        Node::Table(..) | Node::System(..) | Node::Unknown(..) => unreachable!("none is read from text here"),
        Node::Norm(parts) => parts.iter().map(|part| evaluate(part).powi(2)).sum::<f64>().sqrt(),
    }
}

fn unary(op: Unary, a: f64) -> f64 {
    match op {
        Unary::Neg => -a,
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Asin => a.asin(),
        Unary::Acos => a.acos(),
        Unary::Atan => a.atan(),
        Unary::Sinh => a.sinh(),
        Unary::Cosh => a.cosh(),
        Unary::Tanh => a.tanh(),
        Unary::Exp => a.exp(),
        Unary::Log => a.ln(),
        Unary::Sqrt => a.sqrt(),
        Unary::Abs => a.abs(),
        Unary::Sign => f64::from(i8::from(a > 0.0) - i8::from(a < 0.0)),
        Unary::Step => f64::from(a >= 0.0),
    }
}

fn binary(op: Binary, a: f64, b: f64) -> f64 {
    match op {
        Binary::Add => a + b,
        Binary::Sub => a - b,
        Binary::Mul => a * b,
        Binary::Div => a / b,
        Binary::Pow => a.powf(b),
        Binary::Atan2 => a.atan2(b),
        Binary::SquareOver => a * a / b,
        Binary::Min => a.min(b),
        Binary::Max => a.max(b),
    }
}
