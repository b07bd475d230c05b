//! `[run]`: how long and how accurately.

use tumble_expr::{Dimension, Expr};
use tumble_ode::Accuracy;

use super::only;
use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::{Text, Want};
use crate::keys::{Keys, Takes, may, must};
use crate::names::ACCURACY;
use crate::quantities;

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[run]", &[&[
    must("until", Takes::Either(&[Takes::TIME, Takes::Table(&AT_REST)]), "\"10 s\"",
        "end of the run; it starts at 0, and an event may stop it before. `{ rest = true, at_most = \"60 s\" }` \
         ends it where all bodies have come to rest for good, or at the latest then"),
    may(ACCURACY, Takes::Number(1e-14, 1e-3), "`1e-9`", "1e-9",
        "a number without quotes from 1e-14 to 1e-3, see [numerics](numerics.md); `--set accuracy=1e-6` gives \
         another"),
]]);

#[rustfmt::skip]
const AT_REST: Keys = Keys::of("end at rest", &[&[
    must("rest", Takes::True, "true", "the run ends where all bodies have come to rest for good"),
    must("at_most", Takes::TIME, "\"60 s\"", "the latest end"),
]]);

/// The model is complete here: the sections that follow speak of what comes of it.
pub(super) fn read(draft: &mut Draft, section: &Field) {
    quantities::define_works(&mut draft.names, &draft.model);
    only(draft, section, &KEYS, run);
}

fn run(draft: &mut Draft, table: &mut Table) {
    if let Some(field) = draft.required(table, "until") {
        draft.remember("until", &field.span);
        draft.until = match field.value.is_table() {
            true => at_rest(draft, &field),
            false => draft.number(&field, Want::constant(Dimension::TIME)),
        };
    }
    if let Some(field) = table.take(ACCURACY) {
        accuracy(draft, &field);
    }
    set_accuracy(draft);
}

/// `until = { rest = true, at_most = "60 s" }`: the latest end. That nothing moves may never come about.
fn at_rest(draft: &mut Draft, field: &Field) -> Option<Expr> {
    let mut table = draft.table(field, &AT_REST)?;
    let rest = draft.required(&mut table, "rest");
    let is_true = rest.as_ref().and_then(|rest| draft.flag(rest));
    let latest = draft.required(&mut table, "at_most");
    let latest = latest.and_then(|field| {
        draft.remember("until", &field.span);
        draft.number(&field, Want::constant(Dimension::TIME))
    });
    draft.done(table);
    if let (Some(rest), Some(false)) = (rest, is_true) {
        let message = "a run that does not end at rest ends at a time";
        let mistake = Diagnostic::new(Code::Exclusive, rest.span, message).label("says nothing");
        draft.note(mistake.help("write `until = \"60 s\"`, or `rest = true`"));
    }
    draft.model.stops_at_rest = is_true == Some(true);
    if draft.model.stops_at_rest {
        draft.names.happenings.insert("rest".to_owned());
    }
    latest
}

/// A plain number, relative to the size of the motion.
fn accuracy(draft: &mut Draft, field: &Field) {
    let Some(value) = draft.bare_number(field) else { return };
    let accuracy = possible(value, field.span.clone());
    draft.accuracy = draft.noted(accuracy).unwrap_or_default();
}

/// What the command line asks for stands in the place of what the scene does.
fn set_accuracy(draft: &mut Draft) {
    let Some(setting) = draft.settings.iter().rev().find(|setting| setting.name == ACCURACY) else { return };
    let Text { text, origin, .. } = &setting.text;
    let accuracy = match text.trim().parse() {
        Ok(value) => possible(value, origin.whole()),
        Err(_) => {
            let message = format!("`{ACCURACY}` is a number, not `{text}`");
            Err(Diagnostic::new(Code::WrongType, origin.whole(), message).label("not a number"))
        }
    };
    let accuracy = accuracy.map_err(|mistake| mistake.within(origin.source));
    draft.accuracy = draft.noted(accuracy).unwrap_or_default();
}

/// An accuracy that can be asked for, or the mistake.
pub(super) fn possible(value: f64, span: Span) -> Result<Accuracy, Diagnostic> {
    Accuracy::new(value).map_err(|error| {
        let mistake = Diagnostic::new(Code::Accuracy, span, error.to_string());
        mistake.label("out of range").help("write `accuracy = 1e-9`")
    })
}
