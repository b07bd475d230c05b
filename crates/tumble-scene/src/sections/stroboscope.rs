//! `[stroboscope.NAME]`: the bodies at equal steps of time in one picture.

use tumble_expr::Dimension;

use super::{TITLE, body, each};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, may, must};
use crate::study::Stroboscope;

pub(super) const SAYS: &str = "bodies at equal steps of time in one picture";

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[stroboscope.NAME]", &[&[
    must("every", Takes::TIME, "\"0.1 s\"", "time between two instants"),
    may("body", Takes::Either(&[Takes::BODY, Takes::List(0, Takes::MOST, &Takes::BODY)]), "all", "\"rod\"",
        "a name or a list of names"),
    may("trace", Takes::Flag, "`true`", "false", "whether the paths of the centres are drawn"),
    TITLE,
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, stroboscope);
}

fn stroboscope(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.figure_name(field);
    let title = table.take("title").and_then(|field| draft.line(&field));
    let bodies = match table.take("body") {
        Some(field) => bodies(draft, &field),
        None => Some((0..draft.model.bodies.len()).collect()),
    };
    let trace = table.take("trace").is_none_or(|field| draft.flag(&field).unwrap_or(true));
    let every = draft.required(table, "every").and_then(|every| {
        draft.remember(format!("stroboscope `{}`", field.key), &every.span);
        draft.number(&every, Want::constant(Dimension::TIME))
    });
    let (Some(bodies), Some(every)) = (bodies, every) else { return };
    draft.stroboscopes.push(Stroboscope { name: field.key.to_owned(), title, bodies, every, trace });
}

/// One name or a list of names, as indices.
fn bodies(draft: &mut Draft, field: &Field) -> Option<Vec<usize>> {
    let fields = field.elements().unwrap_or_else(|| vec![field.clone()]);
    let names: Vec<_> = fields.iter().map(|field| body(draft, field)).collect();
    names.into_iter().map(|name| draft.model.body_index(&name?)).collect()
}
