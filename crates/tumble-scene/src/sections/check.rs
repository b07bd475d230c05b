//! `[check.NAME]`: what must hold at one time of the run.

use super::each;
use crate::curve;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::moments;
use crate::names::Level;
use crate::names::fit_file;
use crate::study::Check;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, check);
}

/// How close is close enough is the user's to say: there is no default.
fn check(draft: &mut Draft, field: &Field, table: &mut Table) {
    draft.noted(fit_file(field));
    let name = field.key;
    let that = draft.required(table, "that", "\"rod.angle\"").and_then(|field| curve::in_si(draft, &field));
    let want = that
        .as_ref()
        .map_or(Want::any(), |curve| Want { dimension: Some(curve.quantity.dimension), ..Want::any() });
    let angular = that.as_ref().is_some_and(|curve| curve::is_angular(&curve.quantity.formula));
    let want = Want { angle: angular, ..want };
    let equals = draft.required(table, "equals", &format!("\"{}\"", want.example("1"))).and_then(|field| {
        draft.remember(format!("equals of `{name}`"), &field.span);
        draft.number(&field, Want { moments: true, ..want.at(Level::Output) })
    });
    let at = table.take("at").map(|field| {
        draft.remember(format!("at of `{name}`"), &field.span);
        moments::instant(draft, &field)
    });
    let within =
        draft.required(table, "within", &format!("\"{}\"", want.example("1e-9"))).and_then(|field| {
            draft.remember(format!("within of `{name}`"), &field.span);
            draft.number(&field, want)
        });
    let (Some(that), Some(equals), None | Some(Some(_)), Some(within)) = (that, equals, &at, within) else {
        return;
    };
    draft.checks.push(Check { name: name.to_owned(), that, equals, at: at.flatten(), within });
}
