//! `[find.NAME]` and `[check.NAME]`: what is asked for, and what must hold, at one time of the run.

use tumble_mech::Extreme;
use tumble_ode::Side;

use super::each;
use crate::code::Code;
use crate::curve;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::moments;
use crate::names::Level;
use crate::names::fit_label;
use crate::study::{Check, Question, When};

pub(super) const SAYS_FIND: &str = "what is asked for: values at an instant, or the greatest and least";
pub(super) const SAYS: &str = "claims; if one does not hold, the command ends with 1";

pub(super) const FINDS: Keys = Keys::of("[find.NAME]", &[QUESTION]);
pub(super) const KEYS: Keys = Keys::of("[check.NAME]", &[QUESTION, CLAIM]);

#[rustfmt::skip]
const QUESTION: &[Declared] = &[
    must("that", Takes::Formula, "\"rod.angle\"",
        "a formula of the motion; `\"rod.angle in deg\"` gives it in that unit"),
    may("at", Takes::Instant, "end of the run", "\"1 s\"",
        "an [instant](#instants) within the run, `\"its greatest\"` or `\"its least\"`"),
    may("side", Takes::Word(&SIDES), "`\"after\"`", "\"before\"",
        "where a value jumps at that instant: `\"before\"` or `\"after\"`"),
    may("during", Takes::Pair(&Takes::Instant), "the whole run", "[\"1 s\", \"2 s\"]",
        "with a greatest or least value: `[from, to]`, two [instants](#instants)"),
];

#[rustfmt::skip]
const CLAIM: &[Declared] = &[
    must("equals", Takes::Formula, "\"1 m\"",
        "what it must be, a formula of the parameters or of the motion at that time"),
    must("within", Takes::Formula, "\"1e-9 m\"", "the largest difference allowed"),
];

const SIDES: [&str; 2] = ["before", "after"];

/// Times that depend on what is looked at. No formula has two words beside each other.
const EXTREMES: [(&str, Extreme); 2] = [("its greatest", Extreme::Greatest), ("its least", Extreme::Least)];

pub(super) fn read_finds(draft: &mut Draft, section: &Field) {
    each(draft, section, &FINDS, |draft, field, table| {
        let question = question(draft, "find", field, table);
        draft.finds.extend(question);
    });
}

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, check);
}

/// What is looked at, and when.
fn question(draft: &mut Draft, kind: &str, field: &Field, table: &mut Table) -> Option<Question> {
    draft.noted(fit_label(field));
    let name = field.key;
    let title = format!("the {kind} `{name}`");
    let at = when(draft, table, &title);
    let side = side(draft, table, at.as_ref());
    let works = knows_works(at.as_ref());
    let that = draft.required(table, "that").and_then(|field| {
        draft.remember(format!("that of {title}"), &field.span);
        curve::read(draft, &field, works)
    });
    Some(Question { name: name.to_owned(), title, that: that?, at: at?, side: side? })
}

/// Where something is greatest its works are not known.
fn knows_works(at: Option<&When>) -> bool {
    !matches!(at, Some(When::Extreme { .. }))
}

/// How close is close enough is the user's to say: there is no default.
fn check(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = field.key;
    let question = question(draft, "check", field, table);
    let that = question.as_ref().map(|question| &question.that);
    let want = that.map_or(Want::any(), |curve| Want {
        dimension: Some(curve.quantity.dimension),
        angle: curve.angle,
        ..Want::any()
    });
    let works = knows_works(question.as_ref().map(|question| &question.at));
    let equals =
        draft.required_like(table, "equals", &format!("\"{}\"", want.example("1"))).and_then(|field| {
            draft.remember(format!("equals of `{name}`"), &field.span);
            draft.number(&field, Want { moments: true, works, ..want.at(Level::Output) })
        });
    let within =
        draft.required_like(table, "within", &format!("\"{}\"", want.example("1e-9"))).and_then(|field| {
            draft.remember(format!("within of `{name}`"), &field.span);
            draft.number(&field, want)
        });
    let (Some(question), Some(equals), Some(within)) = (question, equals, within) else { return };
    let size = question.that.size.clone();
    draft.checks.push(Check { question, equals: equals / &size, within: within / size });
}

/// The end of the run, an instant, or where what is looked at is greatest or least.
fn when(draft: &mut Draft, table: &mut Table, title: &str) -> Option<When> {
    let (at, during) = (table.take("at"), table.take("during"));
    let words = at.as_ref().and_then(|field| field.value.as_str());
    let extreme = EXTREMES.iter().find(|(known, _)| Some(*known) == words);
    if let (None, Some(during)) = (extreme, &during) {
        draft.note(without_extreme(during));
        return None;
    }
    if let Some((_, which)) = extreme {
        let during = during.map(|field| {
            draft.remember(format!("during of {title}"), &field.span);
            moments::pair(draft, &field)
        });
        return match during {
            None => Some(When::Extreme { which: *which, during: None }),
            Some(pair) => pair.map(|pair| When::Extreme { which: *which, during: Some(pair) }),
        };
    }
    let Some(at) = at else { return Some(When::End) };
    draft.remember(format!("at of {title}"), &at.span);
    moments::instant(draft, &at).map(When::At)
}

/// A window, and one time to look at.
fn without_extreme(during: &Field) -> Diagnostic {
    let message = "`during` is where a greatest or least value is looked for".to_owned();
    let mistake = Diagnostic::new(Code::Exclusive, during.key_span.clone(), message);
    mistake.label("of which value?").help("add `at = \"its greatest\"` or `at = \"its least\"`")
}

/// After what happens at the instant, where nothing else is said.
fn side(draft: &mut Draft, table: &mut Table, at: Option<&When>) -> Option<Side> {
    let Some(field) = table.take("side") else { return Some(Side::After) };
    if let Some(When::Extreme { .. }) = at {
        let message = "the side of a greatest or least value is the one on which it is";
        let mistake = Diagnostic::new(Code::Exclusive, field.key_span.clone(), message);
        draft.note(mistake.label("both sides count").help("leave `side` out"));
        return None;
    }
    match draft.choice(&field, &SIDES)? {
        "before" => Some(Side::Before),
        _ => Some(Side::After),
    }
}
