//! Formulas that are shown: any quantity of the motion.

use tumble_expr::{Binary, Dimension, Expr, Node, Unary};

use crate::document::Field;
use crate::draft::Draft;
use crate::formula::Want;
use crate::names::Level;
use crate::study::{Curve, Quantity};

/// A formula that may hold every name of the scene.
pub(crate) fn read(draft: &mut Draft, field: &Field) -> Option<Curve> {
    let want = Want::any().at(Level::Output);
    let formula = draft.number(field, want)?;
    let text = draft.text(field, want)?.text;
    Some(Curve { text, quantity: quantity(formula) })
}

pub(crate) fn quantity(formula: Expr) -> Quantity {
    let dimension = formula.dimension().unwrap_or(Dimension::NONE);
    Quantity { angle: dimension == Dimension::NONE && is_angular(&formula), dimension, formula }
}

/// Whether a formula is an angle, or an angle per time: one of a body's, or a sum or multiple of such.
pub(crate) fn is_angular(formula: &Expr) -> bool {
    let mut parts = vec![formula];
    let mut found = false;
    while let Some(part) = parts.pop() {
        match part.node() {
            Node::Symbol(symbol) if is_angular_name(&symbol.name) => found = true,
            Node::Unary(Unary::Asin | Unary::Acos | Unary::Atan, _) | Node::Binary(Binary::Atan2, ..) => {
                found = true
            }
            Node::Unary(Unary::Neg | Unary::Abs, a) => parts.push(a),
            Node::Binary(Binary::Add | Binary::Sub | Binary::Min | Binary::Max, a, b) => parts.extend([a, b]),
            Node::Binary(Binary::Mul, a, b) if b.as_number().is_some() || a.as_number().is_some() => {
                parts.extend([a, b])
            }
            Node::Binary(Binary::Div, a, b) if b.as_number().is_some() => parts.push(a),
            Node::Number(_) | Node::Pi => {}
            _ => return false,
        }
    }
    found
}

fn is_angular_name(name: &str) -> bool {
    [".angle", ".omega", ".alpha"].iter().any(|end| name.ends_with(end))
}
