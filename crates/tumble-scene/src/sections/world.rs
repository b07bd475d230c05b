//! `[world]`: what surrounds the bodies.

use tumble_expr::Dimension;
use tumble_mech::{Gravity, MultipleImpacts, Painleve, Wind};

use super::only;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, may, must};

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[world]", &[&[
    must("gravity", Takes::Quantity(Dimension::ACCELERATION), "\"9.81 m/s^2\"`, or without gravity `gravity = \"0 m/s^2\"",
        "acceleration of free fall; without gravity say `\"0 m/s^2\"`"),
    may("wind", Takes::Vector(Dimension::SPEED), "still air", "[\"3 m/s\", 0]",
        "velocity of the air `[x, y]`, a formula of the time `t` and of the place, which is `x` and `y` here"),
    may("impacts", Takes::Word(&IMPACTS), "`\"simultaneous\"`", "\"sequential\"",
        "impacts at several points at one instant, of one body or of several that meet: all at once, or \
         `\"sequential\"`, see [contact](contact.md)"),
    may("painleve", Takes::Word(&PAINLEVE), "`\"refused\"`", "\"impact\"",
        "what becomes of contacts that slip so that no forces hold what presses on them: refused, or `\"impact\"`, an impact without \
         collision, see [where there is no motion](contact.md#where-there-is-no-motion)"),
]]);

const IMPACTS: [&str; 2] = ["simultaneous", "sequential"];
const PAINLEVE: [&str; 2] = ["refused", "impact"];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    only(draft, section, &KEYS, world);
}

/// Gravity is never taken for granted: without it, `gravity = "0 m/s^2"` says so.
fn world(draft: &mut Draft, table: &mut Table) {
    wind(draft, table);
    impacts(draft, table);
    painleve(draft, table);
    let Some(field) = draft.required(table, "gravity") else { return };
    let Some(g) = draft.number(&field, Want::constant(Dimension::ACCELERATION)) else { return };
    draft.remember("gravity", &field.span);
    draft.model.gravity = if draft.horizontal { Gravity::Horizontal(g) } else { Gravity::Vertical(g) };
}

/// How one body's impacts at several points at one instant are taken.
fn impacts(draft: &mut Draft, table: &mut Table) {
    let Some(field) = table.take("impacts") else { return };
    draft.model.multiple_impacts = match draft.choice(&field, &IMPACTS) {
        Some("sequential") => MultipleImpacts::Sequential,
        _ => MultipleImpacts::Simultaneous,
    };
}

/// What becomes of contacts that friction leaves no forces.
fn painleve(draft: &mut Draft, table: &mut Table) {
    let Some(field) = table.take("painleve") else { return };
    if draft.choice(&field, &PAINLEVE) == Some("impact") {
        draft.model.painleve = Painleve::Impact;
    }
}

/// Velocity of the air, a formula of the time and of the place; without it the air is at rest.
fn wind(draft: &mut Draft, table: &mut Table) {
    let Some(field) = table.take("wind") else { return };
    draft.remember("wind", &field.span);
    let wind = draft.vector(&field, Want::constant(Dimension::SPEED).everywhere());
    draft.model.wind = wind.map_or_else(Wind::still, Wind);
}
