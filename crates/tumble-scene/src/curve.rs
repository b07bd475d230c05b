//! Formulas that are shown: any quantity of the motion.

use tumble_expr::{Binary, Dimension, Expr, Node, Unary, language};

use crate::document::Field;
use crate::draft::Draft;
use crate::formula::Want;
use crate::names::Level;
use crate::study::{Curve, Quantity};

/// A formula that may hold every name of the scene.
pub(crate) fn read(draft: &mut Draft, field: &Field) -> Option<Curve> {
    let want = Want { moments: true, ..Want::any().at(Level::Output) };
    let formula = draft.number(field, want)?;
    let text = draft.text(field, want)?.text;
    let parsed = language::parse(&text).ok();
    let names = parsed.iter().flat_map(|formula| formula.names()).map(|name| name.name);
    Some(Curve { quantity: quantity(formula, names), text: text.clone() })
}

/// A formula that was written with these names.
pub(crate) fn quantity<'n>(formula: Expr, names: impl IntoIterator<Item = &'n str>) -> Quantity {
    let dimension = formula.dimension().unwrap_or(Dimension::NONE);
    let unit = unit(dimension, is_angular(&formula), names.into_iter().any(is_energy_name));
    Quantity { unit, dimension, formula }
}

/// What newton metres measure the dimension does not tell: an energy is what was made of energies.
fn unit(dimension: Dimension, angular: bool, energy: bool) -> String {
    let is_torque = dimension == Dimension::TORQUE && !energy;
    let special = UNITS.iter().find(|(known, of_angle, _)| *known == dimension && (!of_angle || angular));
    match special {
        _ if is_torque => "N m".to_owned(),
        Some((_, _, unit)) => (*unit).to_owned(),
        None => dimension.to_string(),
    }
}

/// Units that are not the dimension's own text, and whether only angles have them.
const UNITS: &[(Dimension, bool, &str)] = &[
    (Dimension::NONE, true, "rad"),
    (Dimension::ANGULAR_RATE, true, "rad/s"),
    (Dimension::ANGULAR_ACCELERATION, true, "rad/s^2"),
    (Dimension::NONE, false, ""),
    (Dimension::FORCE, false, "N"),
    (Dimension::TORQUE, false, "J"),
    (Dimension::new(2, 1, -3), false, "W"),
];

fn is_energy_name(name: &str) -> bool {
    [".energy", ".kinetic", ".potential", ".work"].iter().any(|end| name.ends_with(end))
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
