//! `[pivot.NAME]`: a point of a body held at a place in the world, fixed or moved on a given path.

use tumble_expr::Dimension;
use tumble_mech::Pivot;

use super::{body, each, points};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, must};
use crate::names::Level;
use crate::quantities;

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[pivot.NAME]", &[&[
    must("body", Takes::BODY, "\"rod\"", "name of the body; a body is held once"),
    must("point", Takes::Either(&[Takes::POINT, Takes::PLACE]), "[0, 0]",
        "its point: `\"rod.tip\"` or `[x, y]` in body coordinates"),
    must("world", Takes::PLACE, "[0, 0]",
        "where that point is held; it may depend on the time, and the place then moves"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, pivot);
}

fn pivot(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a pivot", field);
    draft.remember(format!("pivot `{}`", field.key), &field.key_span);
    let held = draft.required(table, "body").and_then(|field| body(draft, &field));
    let point = draft.required(table, "point");
    let point = point.zip(held.as_deref()).and_then(|(field, held)| points::of_body(draft, held, &field));
    let moving = Want::constant(Dimension::LENGTH).at(Level::Time);
    let world = draft.required(table, "world").and_then(|field| draft.vector(&field, moving));
    let (Some(body), Some(point), Some(world)) = (held, point, world) else { return };
    let pivot = Pivot { name, body, point, world };
    quantities::define_joint(&mut draft.names, &pivot.name, pivot.force_symbols().into());
    draft.model.pivots.push(pivot);
}
