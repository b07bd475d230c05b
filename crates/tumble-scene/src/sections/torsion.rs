//! `[torsion.NAME]`: a spring that turns a body back to an angle.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Kinematics, Torsion};

use super::{body, each};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::keys::{Keys, Takes, may, must};

const DAMPING: Dimension = Dimension::new(2, 1, -1);

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[torsion.NAME]", &[&[
    must("on", Takes::BODY, "\"rod\"", "name of the body"),
    must("stiffness", Takes::Quantity(Dimension::TORQUE), "\"0.5 N*m/rad\"", "torque for an angle, N*m/rad"),
    must("rest_angle", Takes::Angle(Dimension::NONE), "\"10 deg\"`, or `rest_angle = 0",
        "where it has no torque"),
    may("damping", Takes::Quantity(DAMPING), "0", "\"0.1 N*m*s\"", "torque for an angular velocity, N*m*s"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, torsion);
}

fn torsion(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a torsion spring", field);
    let on = draft.required(table, "on").and_then(|field| body(draft, &field));
    let stiffness = draft.coefficient(table, field.key, "stiffness");
    let rest_angle = draft.coefficient(table, field.key, "rest_angle");
    let damping = draft.coefficient_or(table, field.key, "damping", Expr::zero());
    let all = (on, stiffness, rest_angle, damping);
    let (Some(on), Some(stiffness), Some(rest_angle), Some(damping)) = all else { return };
    draft.model.interact(Torsion { name, body: Kinematics::new(&on), stiffness, rest_angle, damping });
}
