//! `[run]`: how long and how accurately.

use tumble_expr::Dimension;
use tumble_ode::Accuracy;

use super::only;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::quantities;

/// The model is complete here: the sections that follow speak of what comes of it.
pub(super) fn read(draft: &mut Draft, section: &Field) {
    quantities::define_works(&mut draft.names, &draft.model);
    only(draft, section, run);
}

fn run(draft: &mut Draft, table: &mut Table) {
    if let Some(field) = draft.required(table, "until", "\"10 s\"") {
        draft.remember("until", &field.span);
        draft.until = draft.number(&field, Want::constant(Dimension::TIME));
    }
    if let Some(field) = table.take("accuracy") {
        accuracy(draft, &field);
    }
}

/// A plain number, relative to the size of the motion.
fn accuracy(draft: &mut Draft, field: &Field) {
    let Some(value) = draft.bare_number(field) else { return };
    match Accuracy::new(value) {
        Ok(accuracy) => draft.accuracy = accuracy,
        Err(error) => {
            let mistake = Diagnostic::new(Code::Accuracy, field.span.clone(), error.to_string());
            draft.note(mistake.label("out of range").help("write `accuracy = 1e-9`"));
        }
    }
}
