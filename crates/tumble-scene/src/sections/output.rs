//! `[output]`: how dense the tables are.

use tumble_expr::Dimension;

use super::only;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    only(draft, section, output);
}

fn output(draft: &mut Draft, table: &mut Table) {
    let Some(field) = draft.required(table, "every", "\"10 ms\"") else { return };
    draft.remember("output", &field.span);
    draft.output_every = draft.number(&field, Want::constant(Dimension::TIME));
}
