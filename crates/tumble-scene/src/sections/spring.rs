//! `[spring.NAME]`: pulls two points together, or pushes them apart, along the line between them.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Anchor, Spring};

use super::{each, points};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::names::Level;

pub(super) const STIFFNESS: Dimension = Dimension::new(0, 1, -2);
pub(super) const DAMPING: Dimension = Dimension::new(0, 1, -1);

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[spring.NAME]", &[&[
    BETWEEN,
    must("stiffness", Takes::Quantity(STIFFNESS), "\"100 N/m\"", "N/m"),
    must("rest_length", Takes::LENGTH, "\"0.5 m\"`, or without a length of its own `rest_length = 0",
        "a length; `0` says that it has none"),
    may("damping", Takes::Quantity(DAMPING), "0", "\"0.5 kg/s\"", "kg/s, of the rate of the distance"),
]]);

#[rustfmt::skip]
pub(super) const BETWEEN: Declared = must("between", Takes::Pair(&Takes::Either(&[Takes::POINT, Takes::Table(&WORLD)])), "[\"rod.tip\", { world = [0, 0] }]",
    "two ends: `\"rod.tip\"`, or `{ world = [x, y] }`, which may depend on the time");

#[rustfmt::skip]
pub(super) const WORLD: Keys = Keys::of("end in the world", &[&[must("world", Takes::PLACE, "[0, 0]",
    "a place; it may depend on the time"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, spring);
}

/// The rest length is never taken for granted: `rest_length = 0` says that there is none.
fn spring(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a spring", field);
    let ends = between(draft, table);
    let stiffness = draft.coefficient(table, field.key, "stiffness");
    let rest_length = draft.coefficient(table, field.key, "rest_length");
    let damping = draft.coefficient_or(table, field.key, "damping", Expr::zero());
    let all = (ends, stiffness, rest_length, damping);
    let (Some(ends), Some(stiffness), Some(rest_length), Some(damping)) = all else { return };
    draft.model.interact(Spring { name, ends, stiffness, rest_length, damping });
}

/// `between = ["rod.tip", { world = [0, 0] }]`
pub(super) fn between(draft: &mut Draft, table: &mut Table) -> Option<[Anchor; 2]> {
    let field = draft.required(table, "between")?;
    let ends = draft.pair(&field, "[one end, the other end]")?;
    let [first, second] = ends.each_ref().map(|end| anchor(draft, end));
    let ends = [first?, second?];
    let mistake = match &ends {
        [Anchor::World(_), Anchor::World(_)] => "both ends belong to the world, and nothing is moved",
        [Anchor::Material(a), Anchor::Material(b)] if a.body == b.body => {
            "both ends belong to one rigid body, and nothing is moved"
        }
        _ => return Some(ends),
    };
    draft.note(
        Diagnostic::new(Code::Exclusive, field.span, mistake).label("nothing can change between these"),
    );
    None
}

pub(super) fn anchor(draft: &mut Draft, field: &Field) -> Option<Anchor> {
    if field.value.as_str().is_some() {
        return points::named_anywhere(draft, field).map(Anchor::Material);
    }
    if !field.value.is_table() {
        draft.wrong_type(field, "the name of a point such as \"rod.tip\", or { world = [..] }");
        return None;
    }
    let mut inner = draft.titled(field, &WORLD, "{ world = [..] }".to_owned())?;
    inner.span = field.span.clone();
    let place = draft.required(&mut inner, "world");
    let moving = Want::constant(Dimension::LENGTH).at(Level::Time);
    let place = place.and_then(|field| draft.vector(&field, moving));
    draft.done(inner);
    place.map(Anchor::World)
}
