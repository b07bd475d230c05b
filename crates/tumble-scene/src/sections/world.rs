//! `[world]`: what surrounds the bodies.

use tumble_expr::Dimension;
use tumble_mech::{Gravity, MultipleImpacts, Wind};

use super::only;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    only(draft, section, world);
}

/// Gravity is never taken for granted: without it, `gravity = "0 m/s^2"` says so.
fn world(draft: &mut Draft, table: &mut Table) {
    wind(draft, table);
    impacts(draft, table);
    let example = "\"9.81 m/s^2\"`, or without gravity `gravity = \"0 m/s^2\"";
    let Some(field) = draft.required(table, "gravity", example) else { return };
    let Some(g) = draft.number(&field, Want::constant(Dimension::ACCELERATION)) else { return };
    draft.remember("gravity", &field.span);
    draft.model.gravity = if draft.horizontal { Gravity::Horizontal(g) } else { Gravity::Vertical(g) };
}

/// How one body's impacts at several points at one instant are taken.
fn impacts(draft: &mut Draft, table: &mut Table) {
    let Some(field) = table.take("impacts") else { return };
    draft.model.multiple_impacts = match draft.choice(&field, &["simultaneous", "sequential"]) {
        Some("sequential") => MultipleImpacts::Sequential,
        _ => MultipleImpacts::Simultaneous,
    };
}

/// Velocity of the air, a formula of the time and of the place; without it the air is at rest.
fn wind(draft: &mut Draft, table: &mut Table) {
    let Some(field) = table.take("wind") else { return };
    draft.remember("wind", &field.span);
    let wind = draft.vector(&field, Want::constant(Dimension::SPEED).everywhere());
    draft.model.wind = wind.map_or_else(Wind::still, Wind);
}
