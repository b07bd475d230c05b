//! `[check.NAME]`: what must hold at one time of the run.

use tumble_mech::Extreme;

use super::each;
use crate::code::Code;
use crate::curve;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::moments;
use crate::names::Level;
use crate::names::fit_file;
use crate::study::{Check, When};

/// Times that depend on what is looked at. No formula has two words beside each other.
const EXTREMES: [(&str, Extreme); 2] = [("its greatest", Extreme::Greatest), ("its least", Extreme::Least)];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, check);
}

/// How close is close enough is the user's to say: there is no default.
fn check(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.noted(fit_file(field));
    let name = field.key;
    let at = when(draft, table, name);
    let works = !matches!(at, Some(When::Extreme { .. }));
    let that =
        draft.required(table, "that", "\"rod.angle\"").and_then(|field| curve::in_si(draft, &field, works));
    let want = that
        .as_ref()
        .map_or(Want::any(), |curve| Want { dimension: Some(curve.quantity.dimension), ..Want::any() });
    let angular = that.as_ref().is_some_and(|curve| curve::is_angular(&curve.quantity.formula));
    let want = Want { angle: angular, ..want };
    let equals = draft.required(table, "equals", &format!("\"{}\"", want.example("1"))).and_then(|field| {
        draft.remember(format!("equals of `{name}`"), &field.span);
        draft.number(&field, Want { moments: true, works, ..want.at(Level::Output) })
    });
    let within =
        draft.required(table, "within", &format!("\"{}\"", want.example("1e-9"))).and_then(|field| {
            draft.remember(format!("within of `{name}`"), &field.span);
            draft.number(&field, want)
        });
    let (Some(that), Some(equals), Some(at), Some(within)) = (that, equals, at, within) else { return };
    draft.checks.push(Check { name: name.to_owned(), that, equals, at, within });
}

/// The end of the run, an instant, or where what is looked at is greatest or least.
fn when(draft: &mut Draft, table: &mut Table, name: &str) -> Option<When> {
    let (at, during) = (table.take("at"), table.take("during"));
    let words = at.as_ref().and_then(|field| field.value.as_str());
    let extreme = EXTREMES.iter().find(|(known, _)| Some(*known) == words);
    if let (None, Some(during)) = (extreme, &during) {
        draft.note(without_extreme(during));
        return None;
    }
    if let Some((_, which)) = extreme {
        let during = during.map(|field| {
            draft.remember(format!("during of `{name}`"), &field.span);
            moments::pair(draft, &field)
        });
        return match during {
            None => Some(When::Extreme { which: *which, during: None }),
            Some(pair) => pair.map(|pair| When::Extreme { which: *which, during: Some(pair) }),
        };
    }
    let Some(at) = at else { return Some(When::End) };
    draft.remember(format!("at of `{name}`"), &at.span);
    moments::instant(draft, &at).map(When::At)
}

/// A window, and one time to look at.
fn without_extreme(during: &Field) -> Diagnostic {
    let message = "a check with `during` looks for a greatest or least value".to_owned();
    let mistake = Diagnostic::new(Code::Exclusive, during.key_span.clone(), message);
    mistake.label("of which value?").help("add `at = \"its greatest\"` or `at = \"its least\"`")
}
