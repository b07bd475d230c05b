//! `[free_body.NAME]`: free-body diagrams of one body at some instants, on one sheet.

use super::{TITLE, body, each};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::keys::{Keys, Takes, may, must};
use crate::moments;
use crate::study::{FreeBody, Instant};

pub(super) const SAYS: &str = "free-body diagrams of one body at some instants";

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[free_body.NAME]", &[&[
    must("body", Takes::BODY, "\"rod\"", "name of the body"),
    must("at", Takes::Either(&[ONE, Takes::List(1, MOST, &ONE)]), "[\"0 s\", \"1 s\"]",
        "an [instant](#instants) or a list of up to 12, each a text or `{ at = \"..\", label = \"..\" }`"),
    TITLE,
]]);

const ONE: Takes = Takes::Either(&[Takes::Instant, Takes::Table(&LABELLED)]);

#[rustfmt::skip]
const LABELLED: Keys = Keys::of("labelled instant", &[&[
    must("at", Takes::Instant, "\"1 s\"", "an [instant](#instants)"),
    may("label", Takes::Text, "its instant", "\"falling\"", "how the diagram is called"),
]]);

/// More diagrams than this are no sheet.
const MOST: usize = 12;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, free_body);
}

fn free_body(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.figure_name(field);
    let title = table.take("title").and_then(|field| draft.line(&field));
    let body = draft.required(table, "body").and_then(|field| body(draft, &field));
    let at = draft.required(table, "at").and_then(|given| {
        draft.remember(format!("free body `{}`", field.key), &given.span);
        instants(draft, &given)
    });
    let (Some(body), Some(at)) = (body.and_then(|name| draft.model.body_index(&name)), at) else { return };
    draft.free_bodies.push(FreeBody { name: field.key.to_owned(), title, body, at });
}

/// One instant or a list.
fn instants(draft: &mut Draft, field: &Field) -> Option<Vec<(Instant, String)>> {
    let fields = field.elements().unwrap_or_else(|| vec![field.clone()]);
    if fields.is_empty() || fields.len() > MOST {
        let message = format!("a sheet has 1 to {MOST} diagrams, not {}", fields.len());
        draft.note(Diagnostic::new(Code::Length, field.span.clone(), message));
        return None;
    }
    let instants: Vec<_> = fields.iter().map(|field| labelled(draft, field)).collect();
    instants.into_iter().collect()
}

/// `"1 s"` or `{ at = "1 s", label = "falling" }`
fn labelled(draft: &mut Draft, field: &Field) -> Option<(Instant, String)> {
    if !field.value.is_table() {
        let instant = moments::instant(draft, field)?;
        let label = instant.text.clone();
        return Some((instant, label));
    }
    let mut table = draft.inline(field, &LABELLED)?;
    let at = draft.required(&mut table, "at").and_then(|at| moments::instant(draft, &at));
    let label = table.take("label").map(|label| draft.line(&label));
    draft.done(table);
    let at = at?;
    let label = label.unwrap_or_else(|| Some(at.text.clone()));
    Some((at, label?))
}
