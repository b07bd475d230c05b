//! Exact simplifications of a node whose parts are already in the graph.
//!
//! A rule is allowed here only if the result is the same number for every value the symbols can take.
//! (`0 * x` is 0 although an infinite x would make it undefined: no formula that is evaluated holds infinities.)

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::expr::{Binary, Node, Relation, Unary};
use crate::graph::{Graph, NodeId};

/// Bits beyond which exact numbers are no longer folded: powers of powers would outgrow memory.
const LARGEST_EXACT_BITS: u64 = 2048;

pub(crate) enum Simplified {
    Known(NodeId),
    Node(Node<NodeId>),
}
use Simplified::Known;

pub(crate) fn simplify(graph: &mut Graph, node: Node<NodeId>) -> Simplified {
    let simpler = match &node {
        Node::Unary(op, a) => unary(graph, *op, *a),
        Node::Binary(op, a, b) => binary(graph, *op, *a, *b),
        Node::Select(condition, a, b) => select(graph, *condition, *a, *b),
        Node::Norm(parts) => norm(graph, parts),
        Node::Unknown(system, row) => graph.peeled(*system, *row).map(Known),
        _ => None,
    };
    simpler.unwrap_or(Simplified::Node(node))
}

fn number(graph: &Graph, id: NodeId) -> Option<&BigRational> {
    match graph.node(id) {
        Node::Number(value) => Some(value),
        _ => None,
    }
}

/// The part under a minus sign.
fn negated(graph: &Graph, id: NodeId) -> Option<NodeId> {
    match graph.node(id) {
        Node::Unary(Unary::Neg, a) => Some(*a),
        _ => None,
    }
}

fn exact(value: BigRational) -> Option<Simplified> {
    let small = value.numer().bits().max(value.denom().bits()) <= LARGEST_EXACT_BITS;
    small.then_some(Simplified::Node(Node::Number(value)))
}

fn of_unary(graph: &mut Graph, op: Unary, a: NodeId) -> Option<Simplified> {
    Some(Known(graph.add(Node::Unary(op, a))))
}

fn of_binary(graph: &mut Graph, op: Binary, a: NodeId, b: NodeId) -> Option<Simplified> {
    Some(Known(graph.add(Node::Binary(op, a, b))))
}

fn unary(graph: &mut Graph, op: Unary, a: NodeId) -> Option<Simplified> {
    if op == Unary::Sqrt
        && let Some(parts) = squares(graph, a)
    {
        return Some(Known(graph.add(Node::Norm(parts))));
    }
    if let Some(inner) = negated(graph, a) {
        match op {
            Unary::Neg => return Some(Known(inner)),
            Unary::Cos | Unary::Cosh | Unary::Abs => return of_unary(graph, op, inner),
            _ => {}
        }
    }
    let value = number(graph, a)?;
    match op {
        Unary::Neg => exact(-value.clone()),
        Unary::Abs => exact(value.abs()),
        Unary::Sign => exact(value.signum()),
        Unary::Step => exact(if value.is_negative() { BigRational::zero() } else { BigRational::one() }),
        Unary::Cos | Unary::Cosh | Unary::Exp if value.is_zero() => exact(BigRational::one()),
        Unary::Log if value.is_one() => exact(BigRational::zero()),
        Unary::Log | Unary::Acos => None,
        Unary::Sqrt if value.is_one() => exact(BigRational::one()),
        _ if value.is_zero() => exact(BigRational::zero()),
        _ => None,
    }
}

/// The roots of a sum's terms, where all of them are squares: the root of the sum is a length, which evaluators know how
/// to handle near zero.
fn squares(graph: &Graph, sum: NodeId) -> Option<Vec<NodeId>> {
    match graph.node(sum) {
        Node::Binary(Binary::Add, a, b) => {
            let (mut left, right) = (squares(graph, *a)?, squares(graph, *b)?);
            left.extend(right);
            Some(left)
        }
        Node::Binary(Binary::Mul, a, b) if a == b => Some(vec![*a]),
        Node::Binary(Binary::Pow, a, b) => {
            let two = number(graph, *b)?.to_f64()? == 2.0;
            two.then(|| vec![*a])
        }
        _ => None,
    }
}

fn binary(graph: &mut Graph, op: Binary, a: NodeId, b: NodeId) -> Option<Simplified> {
    if let (Some(x), Some(y)) = (number(graph, a), number(graph, b))
        && let Some(folded) = fold(op, x, y)
    {
        return Some(folded);
    }
    match op {
        Binary::Add => sum(graph, a, b),
        Binary::Sub => difference(graph, a, b),
        Binary::Mul => product(graph, a, b),
        Binary::Div => quotient(graph, a, b),
        Binary::Pow => power(graph, a, b),
        Binary::Min | Binary::Max if a == b => Some(Known(a)),
        Binary::SquareOver if number(graph, a).is_some_and(Zero::is_zero) => Some(Known(a)),
        Binary::Atan2 | Binary::Min | Binary::Max | Binary::SquareOver => None,
    }
}

fn fold(op: Binary, x: &BigRational, y: &BigRational) -> Option<Simplified> {
    match op {
        Binary::Add => exact(x + y),
        Binary::Sub => exact(x - y),
        Binary::Mul => exact(x * y),
        Binary::Div if !y.is_zero() => exact(x / y),
        Binary::Min => exact(x.min(y).clone()),
        Binary::Max => exact(x.max(y).clone()),
        Binary::Pow if y.is_integer() => {
            let exponent = y.numer().to_i32()?;
            let bits = x.numer().bits().max(x.denom().bits()) * u64::from(exponent.unsigned_abs());
            let defined = !(x.is_zero() && exponent <= 0);
            if defined && bits <= LARGEST_EXACT_BITS { exact(x.pow(exponent)) } else { None }
        }
        _ => None,
    }
}

fn sum(graph: &mut Graph, a: NodeId, b: NodeId) -> Option<Simplified> {
    if number(graph, a).is_some_and(Zero::is_zero) {
        return Some(Known(b));
    }
    if number(graph, b).is_some_and(Zero::is_zero) {
        return Some(Known(a));
    }
    if let Some(inner) = negated(graph, b) {
        return of_binary(graph, Binary::Sub, a, inner);
    }
    if let Some(inner) = negated(graph, a) {
        return of_binary(graph, Binary::Sub, b, inner);
    }
    ordered(Binary::Add, a, b)
}

fn difference(graph: &mut Graph, a: NodeId, b: NodeId) -> Option<Simplified> {
    if a == b {
        return exact(BigRational::zero());
    }
    if number(graph, b).is_some_and(Zero::is_zero) {
        return Some(Known(a));
    }
    if number(graph, a).is_some_and(Zero::is_zero) {
        return of_unary(graph, Unary::Neg, b);
    }
    let inner = negated(graph, b)?;
    of_binary(graph, Binary::Add, a, inner)
}

fn product(graph: &mut Graph, a: NodeId, b: NodeId) -> Option<Simplified> {
    for (this, other) in [(a, b), (b, a)] {
        if let Some(value) = number(graph, this) {
            if value.is_zero() {
                return Some(Known(this));
            }
            if value.is_one() {
                return Some(Known(other));
            }
            if (-value).is_one() {
                return of_unary(graph, Unary::Neg, other);
            }
        }
        if let Some(inner) = negated(graph, this) {
            let positive = graph.add(Node::Binary(Binary::Mul, inner, other));
            return of_unary(graph, Unary::Neg, positive);
        }
    }
    ordered(Binary::Mul, a, b)
}

/// Sums and products are the same in either order, to the bit: the smaller index goes first.
fn ordered(op: Binary, a: NodeId, b: NodeId) -> Option<Simplified> {
    (b < a).then_some(Simplified::Node(Node::Binary(op, b, a)))
}

fn quotient(graph: &mut Graph, a: NodeId, b: NodeId) -> Option<Simplified> {
    // A quotient by a literal zero is left for the evaluator to refuse, with its place and time.
    if number(graph, b).is_some_and(Zero::is_zero) {
        return None;
    }
    if number(graph, a).is_some_and(Zero::is_zero) || number(graph, b).is_some_and(One::is_one) {
        return Some(Known(a));
    }
    if let Some(inner) = negated(graph, a) {
        let positive = graph.add(Node::Binary(Binary::Div, inner, b));
        return of_unary(graph, Unary::Neg, positive);
    }
    let inner = negated(graph, b)?;
    let positive = graph.add(Node::Binary(Binary::Div, a, inner));
    of_unary(graph, Unary::Neg, positive)
}

fn power(graph: &mut Graph, a: NodeId, b: NodeId) -> Option<Simplified> {
    let exponent = number(graph, b)?;
    if exponent.is_zero() {
        return exact(BigRational::one());
    }
    exponent.is_one().then_some(Known(a))
}

fn select(graph: &mut Graph, condition: NodeId, a: NodeId, b: NodeId) -> Option<Simplified> {
    if a == b {
        return Some(Known(a));
    }
    let Node::Compare(relation, x, y) = graph.node(condition) else { return None };
    let (x, y) = (number(graph, *x)?, number(graph, *y)?);
    let holds = match relation {
        Relation::Less => x < y,
        Relation::LessEqual => x <= y,
    };
    Some(Known(if holds { a } else { b }))
}

fn norm(graph: &mut Graph, parts: &[NodeId]) -> Option<Simplified> {
    // In one order, so that equal lengths are one node.
    let mut nonzero: Vec<NodeId> =
        parts.iter().copied().filter(|part| !number(graph, *part).is_some_and(Zero::is_zero)).collect();
    nonzero.sort_unstable();
    match nonzero.as_slice() {
        [] => exact(BigRational::zero()),
        [only] => of_unary(graph, Unary::Abs, *only),
        _ if nonzero != parts => Some(Simplified::Node(Node::Norm(nonzero))),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::{Dimension, Expr, Graph, Node};

    fn simplified(formula: &Expr) -> (Graph, Node<crate::NodeId>) {
        let mut graph = Graph::default();
        let id = graph.import(std::slice::from_ref(formula))[0];
        let node = graph.node(id).clone();
        (graph, node)
    }

    #[test]
    fn exact_arithmetic_folds() {
        let third = Expr::from(1) / 3;
        let (_, node) = simplified(&(&third + &third + &third));
        assert_eq!(node, simplified(&Expr::one()).1);
    }

    #[test]
    fn zero_and_one_vanish() {
        let x = Expr::symbol("x", Dimension::LENGTH);
        let bare = simplified(&x).1;
        for same in [&x + 0, 0 + &x, &x - 0, &x * 1, 1 * &x, &x / 1, x.powi(1), -(-&x)] {
            assert_eq!(simplified(&same).1, bare, "{same:?}");
        }
        for zero in [&x * 0, &x - &x, Expr::zero() / &x, (&x * 0).sin(), Expr::norm(vec![&x * 0])] {
            assert_eq!(simplified(&zero).1, simplified(&Expr::zero()).1);
        }
    }

    #[test]
    fn the_root_of_a_sum_of_squares_is_a_length() {
        let (x, y) = (Expr::symbol("x", Dimension::LENGTH), Expr::symbol("y", Dimension::LENGTH));
        let written = (x.powi(2) + &y * &y).sqrt();
        let ids = Graph::default().import(&[written, Expr::norm(vec![y, x])]);
        assert_eq!(ids[0], ids[1]);
    }

    #[test]
    fn parameters_are_never_folded() {
        let m = Expr::symbol("m", Dimension::MASS);
        let (graph, _) = simplified(&(&m * 2 / &m));
        assert_eq!(graph.nodes().len(), 4);
    }

    #[test]
    fn powers_too_large_to_be_exact_are_left_to_the_evaluator() {
        let huge = Expr::from(10).powi(1000).powi(1000).powi(1000);
        assert!(matches!(simplified(&huge).1, Node::Binary(..)));
    }
}
