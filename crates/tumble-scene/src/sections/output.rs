//! `[output]`: how dense the tables are.

use tumble_expr::Dimension;

use super::only;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, must};

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[output]", &[&[
    must("every", Takes::TIME, "\"10 ms\"", "time between lines of the tables; a thousandth of the run without the section"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    only(draft, section, &KEYS, output);
}

fn output(draft: &mut Draft, table: &mut Table) {
    let Some(field) = draft.required(table, "every") else { return };
    draft.remember("output", &field.span);
    draft.output_every = draft.number(&field, Want::constant(Dimension::TIME));
}
