//! `[damper.NAME]`: resists the change of the distance of two points.

use tumble_expr::Expr;
use tumble_mech::Spring;

use super::{each, spring};
use crate::document::{Field, Table};
use crate::draft::Draft;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, damper);
}

fn damper(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a damper", field);
    let ends = spring::between(draft, table);
    let damping = draft.required(table, "damping", "\"0.5 kg/s\"");
    let damping = damping.and_then(|value| spring::damping(draft, field.key, &value));
    let (Some(ends), Some(damping)) = (ends, damping) else { return };
    draft.model.interact(Spring { name, ends, stiffness: Expr::zero(), rest_length: Expr::zero(), damping });
}
