//! `[damper.NAME]`: resists the change of the distance of two points.

use tumble_expr::Expr;
use tumble_mech::Spring;

use super::{each, spring};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::keys::{Keys, Takes, must};

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[damper.NAME]", &[&[
    spring::BETWEEN,
    must("damping", Takes::Quantity(spring::DAMPING), "\"0.5 kg/s\"", "kg/s, of the rate of the distance"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, damper);
}

fn damper(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a damper", field);
    let ends = spring::between(draft, table);
    let damping = draft.coefficient(table, field.key, "damping");
    let (Some(ends), Some(damping)) = (ends, damping) else { return };
    draft.model.interact(Spring { name, ends, stiffness: Expr::zero(), rest_length: Expr::zero(), damping });
}
