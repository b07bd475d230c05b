//! Formulas that are shown: any quantity of the motion.

use tumble_expr::{Binary, Dimension, Expr, Node, Unary, Unit, language};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::Field;
use crate::draft::Draft;
use crate::formula::{self, Text, Want};
use crate::keys::{Keys, Takes, must};
use crate::names::{Level, Names};
use crate::printable::one_line;
use crate::study::{Curve, Quantity};
use crate::unit_text;

fn of_text(draft: &mut Draft, text: Text, works: bool) -> Option<Curve> {
    let want = Want { moments: true, works, ..Want::any().at(Level::Output) };
    let value = formula::number(&draft.names, &text, want);
    let value = draft.all_noted(value)?;
    let parsed = language::parse(&text.text).ok();
    let names = parsed.iter().flat_map(|formula| formula.names()).map(|name| name.name);
    let angle = is_angular(&value);
    let quantity = quantity(value, names);
    Some(Curve { quantity, text: one_line(&text.text), angle, size: Expr::one(), label: None })
}

/// Between a formula and the unit that an axis shows it in.
const IN: &str = " in ";

/// A formula that may hold every name of the scene, perhaps in a unit of its own: `"rod.angle in deg"`. The formula's values
/// are then numbers of that unit. `works` says whether it may hold works.
pub(crate) fn read(draft: &mut Draft, field: &Field, works: bool) -> Option<Curve> {
    let written = draft.text(field, Want::any())?;
    let Some((before, unit)) = field.value.as_str().and_then(in_unit) else {
        return of_text(draft, written, works);
    };
    let part = |start: usize, text: &str| Text {
        text: text.to_owned(),
        origin: written.origin.part(start..start + text.len()),
        ..written.clone()
    };
    let chain = part(written.text.len() - unit.len(), unit);
    let si = of_text(draft, part(0, before), works);
    refuse_no_unit(draft, &chain)?;
    let si = si?;
    let one = one_of(draft, &chain, &si.quantity)?;
    let size = one / (1 * Unit(si.quantity.dimension));
    let unit = unit.trim().to_owned();
    let quantity = Quantity { formula: &si.quantity.formula / &size, unit, ..si.quantity };
    Some(Curve { quantity, size, ..si })
}

#[rustfmt::skip]
pub(crate) const LABELLED: Keys = Keys::of("labelled formula", &[&[
    must("value", Takes::Formula, "\"rod.angle\"", "the formula"),
    must("label", Takes::Text, "\"..\"", "how figures call it"),
]]);

/// The same, perhaps with a label: `{ value = "rod.angle in deg", label = "tilt" }`.
pub(crate) fn labelled(draft: &mut Draft, field: &Field) -> Option<Curve> {
    if !field.value.is_table() {
        return read(draft, field, false);
    }
    let mut table = draft.inline(field, &LABELLED)?;
    let value = draft.required(&mut table, "value").and_then(|field| read(draft, &field, false));
    let label = draft.required(&mut table, "label").and_then(|field| draft.line(&field));
    draft.done(table);
    Some(Curve { label: Some(label?), ..value? })
}

/// The unit behind the formula of such a field, as it is written.
pub(crate) fn written_unit(field: &Field) -> Option<String> {
    let inner = field.value.as_table().and_then(|table| table.get("value")).map(|value| value.get_ref());
    let (_, unit) = in_unit(inner.unwrap_or(field.value).as_str()?)?;
    Some(unit.trim().to_owned())
}

/// The formula and its unit. No formula goes on with a word behind a space, so that nothing else can be meant.
pub(crate) fn in_unit(text: &str) -> Option<(&str, &str)> {
    let (before, unit) = text.rsplit_once(IN)?;
    let begins = unit.trim_start().starts_with(|c: char| c.is_alphabetic() || c == '%');
    (begins && !before.trim().is_empty()).then_some((before, unit))
}

fn refuse_no_unit(draft: &mut Draft, chain: &Text) -> Option<()> {
    let word = chain.text.trim();
    if unit_text::unit(word).is_some() {
        return Some(());
    }
    let message = format!("`{word}` is no unit");
    let mistake = Diagnostic::new(Code::Choice, chain.origin.whole(), message).label("unknown unit");
    draft.note(mistake.help("behind `in` stands a unit alone, such as `deg`, `cm` or `km/h`"));
    None
}

/// One of the unit, which must measure what the formula does, and an angle where that is one.
fn one_of(draft: &mut Draft, chain: &Text, shown: &Quantity) -> Option<Expr> {
    let word = chain.text.trim();
    let want = Want { angle: shown.unit.starts_with("rad"), ..Want::constant(shown.dimension) };
    let one = format!("1 {word}");
    let one = Text { text: one, origin: chain.origin.without_parts(), ..chain.clone() };
    let number = formula::number(&Names::default(), &one, want);
    draft.all_noted(number)
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
    is_angular_by(formula, &is_angular_name)
}

/// The same where it is known which names are of angles.
pub(crate) fn is_angular_by(formula: &Expr, is_of_angle: &dyn Fn(&str) -> bool) -> bool {
    let mut parts = vec![formula];
    let mut found = false;
    while let Some(part) = parts.pop() {
        match part.node() {
            Node::Symbol(symbol) if is_of_angle(&symbol.name) => found = true,
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
