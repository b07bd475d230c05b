//! `[plot.NAME]`: curves against the time or another quantity.

use tumble_expr::Dimension;

use super::{TITLE, each};
use crate::code::Code;
use crate::curve;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::keys::{Keys, Takes, may, must};
use crate::moments;
use crate::study::{Curve, Plot};

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[plot.NAME]", &[&[
    must("y", Takes::Either(&[CURVE, Takes::List(1, Takes::MOST, &CURVE)]), "\"rod.angle\"",
        "a formula, or a list of formulas of one dimension; `\"rod.angle in deg\"` shows the axis in that unit; `{ \
         value = \"FORMULA\", label = \"tilt\" }` where the formula is no good name"),
    may("x", CURVE, "the time", "\"rod.x\"", "a formula, written as in `y`"),
    may("during", Takes::Pair(&Takes::Instant), "the whole run", "[\"1 s\", \"2 s\"]",
        "`[from, to]`, two [instants](#instants)"),
    TITLE,
]]);

const CURVE: Takes = Takes::Either(&[Takes::Formula, Takes::Table(&curve::LABELLED)]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, plot);
}

fn plot(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.figure_name(field);
    let title = table.take("title").and_then(|field| draft.line(&field));
    let name = field.key;
    let x = table.take("x").map(|field| {
        draft.remember(format!("x of the plot `{name}`"), &field.span);
        curve::labelled(draft, &field)
    });
    let y = draft.required(table, "y").and_then(|field| {
        draft.remember(format!("y of the plot `{name}`"), &field.span);
        curves(draft, &field)
    });
    let during = table.take("during").map(|given| {
        draft.remember(format!("during of the plot `{}`", field.key), &given.span);
        moments::pair(draft, &given)
    });
    let (Some(y), None | Some(Some(_)), None | Some(Some(_))) = (y, &x, &during) else { return };
    let (x, during) = (x.flatten(), during.flatten());
    draft.plots.push(Plot { name: field.key.to_owned(), title, x, y, during });
}

/// One formula or a list of formulas, all of one dimension.
fn curves(draft: &mut Draft, field: &Field) -> Option<Vec<Curve>> {
    let fields = field.elements().unwrap_or_else(|| vec![field.clone()]);
    if fields.is_empty() {
        draft.note(Diagnostic::new(Code::Length, field.span.clone(), "this figure has no curve"));
    }
    let curves: Vec<_> = fields.iter().map(|field| curve::labelled(draft, field)).collect();
    let curves = curves.into_iter().collect::<Option<Vec<_>>>()?;
    let first = curves.first()?.quantity.dimension;
    let unlike = curves.iter().position(|curve| curve.quantity.dimension != first);
    if let Some(other) = unlike {
        draft.note(unlike_curves([&fields[0], &fields[other]], [first, curves[other].quantity.dimension]));
    }
    let first = curve::written_unit(&fields[0]);
    let other = fields.iter().position(|field| curve::written_unit(field) != first);
    if let Some(other) = other.filter(|_| unlike.is_none()) {
        draft.note(unlike_units([&fields[0], &fields[other]], [&curves[0], &curves[other]]));
    }
    (unlike.is_none() && other.is_none()).then_some(curves)
}

fn unlike_units(fields: [&Field; 2], curves: [&Curve; 2]) -> Diagnostic {
    let [first, other] = curves.map(|curve| match curve.quantity.unit.as_str() {
        "" => "no unit".to_owned(),
        unit => format!("`{unit}`"),
    });
    let message = format!("this figure would show {first} and {other} on one axis");
    Diagnostic::new(Code::UnlikeCurves, fields[1].span.clone(), message)
        .label(other)
        .also(fields[0].span.clone(), first)
        .help("write the same `in UNIT` behind each formula")
}

fn unlike_curves(fields: [&Field; 2], dimensions: [Dimension; 2]) -> Diagnostic {
    let [first, other] = dimensions.map(Dimension::describe);
    let message = format!("this figure would show {first} and {other} on one axis");
    Diagnostic::new(Code::UnlikeCurves, fields[1].span.clone(), message)
        .label(other)
        .also(fields[0].span.clone(), first)
        .help("make them two figures")
}
