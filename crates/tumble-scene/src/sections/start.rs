//! `start = { at = [..], velocity = [..], angle = "..", omega = ".." }`: what a body starts from.

use tumble_expr::{Dimension, Expr};
use tumble_mech::Start;

use crate::document::Table;
use crate::draft::Draft;
use crate::formula::Want;

/// Place and velocity are those of the centre of mass; what is not given is as drawn, and at rest.
pub(super) fn read(draft: &mut Draft, body: &str, table: &mut Table) {
    let Some(field) = table.take("start") else { return };
    draft.remember(format!("start of `{body}`"), &field.key_span);
    let Some(mut inner) = draft.table(&field, "start".to_owned()) else { return };
    let at = inner.take("at").and_then(|field| draft.place(&field));
    let speed = Want::constant(Dimension::SPEED);
    let velocity = inner.take("velocity").and_then(|field| draft.vector(&field, speed));
    let angle = angular(draft, &mut inner, "angle", Dimension::NONE);
    let omega = angular(draft, &mut inner, "omega", Dimension::ANGULAR_RATE);
    draft.done(inner);
    draft.model.starts.push((body.to_owned(), Start { at, velocity, angle, omega }));
}

fn angular(draft: &mut Draft, table: &mut Table, key: &'static str, dimension: Dimension) -> Option<Expr> {
    table.take(key).and_then(|field| draft.number(&field, Want::angular(dimension)))
}
