//! What has a form of its own in a report, as plain tables.

use crate::report::math::Typeset;
use crate::report::parts::{BodyModel, BodyRow, CheckRow, ForceRow, QuantityRow};
use crate::report::prose::Text;
use crate::report::table::{Column, PrintedTable};
use tumble_drawing::text::Label;

/// The bodies with their properties, a row each.
pub(super) fn bodies(bodies: &[BodyRow]) -> PrintedTable {
    let most = bodies.iter().max_by_key(|body| body.properties.len());
    let names = most.iter().flat_map(|body| &body.properties).map(|property| property.name.clone());
    let columns = std::iter::once("Body".into()).chain(names).map(Column::words).collect();
    bodies.iter().map(body).fold(
        PrintedTable { stacked: true, ..PrintedTable::new("The bodies have these properties.", columns) },
        PrintedTable::row,
    )
}

fn body(body: &BodyRow) -> Vec<Text> {
    let shape =
        if body.shape.is_empty() { Text::default() } else { Text::from(", ").and(body.shape.clone()) };
    std::iter::once(body.name.clone().and(shape)).chain(body.properties.iter().map(property)).collect()
}

/// `I = m L^2/12 = 0.08 kg m^2`, with a remark; the formula says its own left side.
fn property(quantity: &QuantityRow) -> Text {
    let left = quantity.formula.as_ref().map_or_else(|| quantity.symbol.clone(), shown);
    let space = if quantity.formula.is_some() { " =\u{a0}" } else { "\u{a0}=\u{a0}" };
    let left = if left.is_empty() { left } else { left.and(space) };
    let note =
        if quantity.note.is_empty() { Text::default() } else { Text::from(", ").and(quantity.note.clone()) };
    left.and(value(quantity)).and(note)
}

/// Quantities with their values.
pub(super) fn quantities(caption: &str, quantities: &[QuantityRow]) -> PrintedTable {
    let columns = ["Quantity", "Symbol", "Value", "Remark"].map(Column::words);
    let rows = quantities.iter().map(|one| quantity(one).into());
    let table = PrintedTable { stacked: true, ..PrintedTable::new(caption, columns.into()) };
    rows.fold(table, PrintedTable::row)
}

/// Name, symbol, value after what it is computed by, remark.
fn quantity(quantity: &QuantityRow) -> [Text; 4] {
    let equals = if quantity.value.is_empty() { "" } else { " = " };
    let formula = quantity.formula.as_ref().map(|formula| shown(formula).and(equals));
    [
        quantity.name.clone(),
        quantity.symbol.clone(),
        formula.unwrap_or_default().and(value(quantity)),
        quantity.note.clone(),
    ]
}

/// The value with its unit.
fn value(quantity: &QuantityRow) -> Text {
    let space = if quantity.unit.is_empty() || quantity.unit == "deg" { "" } else { "\u{a0}" };
    quantity.value.clone().and(space).and(Label::unit(&quantity.unit))
}

fn shown(math: &Typeset) -> Text {
    math.clone().into()
}

/// A law with what its names stand for, each on a line of its own.
fn stated(lines: &[Typeset]) -> Text {
    let between = |index: usize| if index == 1 { "\nwith " } else { "\n" };
    let add = |text: Text, (index, line): (usize, &Typeset)| match index {
        0 => text.and(line.clone()),
        _ => text.and(between(index)).and(line.clone()),
    };
    lines.iter().enumerate().fold(Text::default(), add)
}

/// The forces on a body, and the impulses.
pub(super) fn acting(body: &BodyModel) -> [PrintedTable; 2] {
    [
        acts(
            "These forces and couples act on it.",
            ["Force", "Law", "Torque about the centre of mass"],
            &body.forces,
        ),
        acts(
            "These impulses act on it, each in an instant.",
            ["Impulse", "Law", "Angular impulse about the centre of mass"],
            &body.impulses,
        ),
    ]
}

fn acts(caption: &str, columns: [&str; 3], forces: &[ForceRow]) -> PrintedTable {
    let row = |force: &ForceRow| {
        let name = force.name.clone().and(" ").and(shown(&force.symbol));
        let name = if force.point.is_empty() { name } else { name.and("\nat ").and(force.point.clone()) };
        vec![name, stated(&force.law), stated(&force.torque)]
    };
    let columns = columns.map(Column::words);
    let table = PrintedTable { stacked: true, ..PrintedTable::new(caption, columns.into()) };
    forces.iter().map(row).fold(table, PrintedTable::row)
}

/// What is said of a check that does not hold where values were set.
pub(super) const OF_OTHER_VALUES: &str = "stated for the scene's own values";
/// What is said of a check that holds: its error may be larger than it may be off, or not.
pub(super) const PASSED: [&str; 2] = ["passed, within its error", "passed"];

/// The column of a check's result.
pub(super) const RESULT: usize = 4;

/// Checks with their results.
pub(super) fn checks(checks: &[CheckRow]) -> PrintedTable {
    let columns = ["Check", "Expected", "Found", "Within", "Result"].map(Column::words);
    let row = |check: &CheckRow| {
        let result = match (check.passed, check.is_of_other_values) {
            (true, _) => PASSED[usize::from(check.is_sure)],
            (false, true) => OF_OTHER_VALUES,
            (false, false) => "FAILED",
        };
        let [expected, found, within] = [&check.expected, &check.found, &check.within].map(Clone::clone);
        vec![check.what.clone(), expected, found, within, result.into()]
    };
    checks
        .iter()
        .map(row)
        .fold(PrintedTable::new("The claims of the scene were checked.", columns.into()), PrintedTable::row)
}
