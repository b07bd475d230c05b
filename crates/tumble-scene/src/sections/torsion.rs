//! `[torsion.NAME]`: a spring that turns a body back to an angle.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Kinematics, Torsion};

use super::{body, each};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;

const DAMPING: Dimension = Dimension::new(2, 1, -1);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, torsion);
}

fn torsion(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a torsion spring", field);
    let on = draft.required(table, "on", "\"rod\"").and_then(|field| body(draft, &field));
    let stiffness = draft.coefficient(table, field.key, "stiffness", "\"0.5 N*m/rad\"", Dimension::TORQUE);
    let example = "\"10 deg\"`, or `rest_angle = 0";
    let rest_angle = draft.required(table, "rest_angle", example);
    let rest_angle = rest_angle.and_then(|value| {
        draft.remember(format!("rest angle of `{}`", field.key), &value.span);
        draft.number(&value, Want::angular(Dimension::NONE))
    });
    let damping = match table.take("damping") {
        Some(value) => {
            draft.remember(format!("damping of `{}`", field.key), &value.span);
            draft.number(&value, Want::constant(DAMPING))
        }
        None => Some(Expr::zero()),
    };
    let all = (on, stiffness, rest_angle, damping);
    let (Some(on), Some(stiffness), Some(rest_angle), Some(damping)) = all else { return };
    draft.model.interact(Torsion { name, body: Kinematics::new(&on), stiffness, rest_angle, damping });
}
