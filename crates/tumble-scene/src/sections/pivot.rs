//! `[pivot.NAME]`: a point of a body held at a place in the world.

use tumble_mech::Pivot;

use super::{body, each, points};
use crate::document::{Field, Table};
use crate::draft::Draft;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, pivot);
}

fn pivot(draft: &mut Draft, field: &Field, table: &mut Table) {
    let claimed = draft.names.claim("a pivot", field.key, field.key_span.clone());
    draft.noted(claimed);
    draft.remember(format!("pivot `{}`", field.key), &field.key_span);
    let held = draft.required(table, "body", "\"rod\"").and_then(|field| body(draft, &field));
    let point = draft.required(table, "point", "[0, 0]");
    let point = point.zip(held.as_deref()).and_then(|(field, held)| points::of_body(draft, held, &field));
    let world = draft.required(table, "world", "[0, 0]").and_then(|field| draft.place(&field));
    let (Some(body), Some(point), Some(world)) = (held, point, world) else { return };
    draft.model.pivots.push(Pivot { name: field.key.to_owned(), body, point, world });
}
