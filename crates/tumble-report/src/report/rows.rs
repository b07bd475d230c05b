//! What has a form of its own in a report, as plain tables.

use crate::report::analyze::Check;
use crate::report::identify::{BodyRow, Quantity};
use crate::report::math::Math;
use crate::report::model::ForceRow;
use crate::report::prose::Text;
use crate::report::table::{Column, Table};
use crate::text::Label;

/// The bodies with their properties.
pub(super) fn bodies(bodies: &[BodyRow]) -> Table {
    let columns = ["Body", "Property", "Symbol", "Value", "Computed by", "Remark"].map(Column::words);
    bodies.iter().flat_map(body).fold(Table::new("Bodies", columns.into()), Table::row)
}

/// A row for each property; the first of them names the body.
fn body(body: &BodyRow) -> Vec<Vec<Text>> {
    let shape =
        if body.shape.is_empty() { Text::default() } else { Text::from(", ").and(body.shape.clone()) };
    let mut name = body.name.clone().and(shape);
    let nothing = [Quantity::default()];
    let properties = if body.properties.is_empty() { &nothing } else { &body.properties[..] };
    let row = |property| std::iter::once(std::mem::take(&mut name)).chain(quantity(property)).collect();
    properties.iter().map(row).collect()
}

/// Quantities with their values.
pub(super) fn quantities(caption: &str, quantities: &[Quantity]) -> Table {
    let columns = ["Quantity", "Symbol", "Value", "Computed by", "Remark"].map(Column::words);
    let rows = quantities.iter().map(|one| quantity(one).into());
    rows.fold(Table::new(caption, columns.into()), Table::row)
}

/// Name, symbol, value, what it is computed by, remark.
pub(super) fn quantity(quantity: &Quantity) -> [Text; 5] {
    [
        quantity.name.clone(),
        quantity.symbol.clone(),
        value(quantity),
        quantity.formula.as_ref().map(shown).unwrap_or_default(),
        quantity.note.clone(),
    ]
}

/// The value with its unit.
fn value(quantity: &Quantity) -> Text {
    let space = if quantity.unit.is_empty() || quantity.unit == "deg" { "" } else { "\u{a0}" };
    quantity.value.clone().and(space).and(Label::unit(&quantity.unit))
}

fn shown(math: &Math) -> Text {
    math.clone().into()
}

/// A law with what its names stand for.
fn stated(lines: &[Math]) -> Text {
    let between = |index: usize| if index == 1 { " with " } else { ", " };
    let add = |text: Text, (index, line): (usize, &Math)| match index {
        0 => text.and(line.clone()),
        _ => text.and(between(index)).and(line.clone()),
    };
    lines.iter().enumerate().fold(Text::default(), add)
}

/// The forces on a body.
pub(super) fn forces(forces: &[ForceRow]) -> Table {
    let columns = ["Force", "Symbol", "Law", "Acts at", "Torque about the centre of mass"].map(Column::words);
    let row = |force: &ForceRow| {
        let symbol = shown(&force.symbol);
        vec![force.name.clone(), symbol, stated(&force.law), force.point.clone(), stated(&force.torque)]
    };
    forces.iter().map(row).fold(Table::new("Forces and couples", columns.into()), Table::row)
}

/// Checks with their results.
pub(super) fn checks(checks: &[Check]) -> Table {
    let columns = ["Check", "Expected", "Found", "Within", "Result"].map(Column::words);
    let row = |check: &Check| {
        let result = if check.passed { "passed" } else { "FAILED" };
        let [expected, found, within] = [&check.expected, &check.found, &check.within].map(Clone::clone);
        vec![check.what.clone(), expected, found, within, result.into()]
    };
    checks.iter().map(row).fold(Table::new("Checks", columns.into()), Table::row)
}
