//! `[event.NAME]`: `when = "rod.vy falls through 0 m/s"`, and what then happens.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Action, Event};
use tumble_ode::Direction;

use super::each;
use crate::code::Code;
use crate::curve;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table, fields};
use crate::draft::Draft;
use crate::formula::{self, Text, Want};
use crate::keys::{Keys, Takes, may, must};
use crate::names::Level;

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[event.NAME]", &[&[
    must("when", Takes::Text, "\"rod.vy falls through 0 m/s\"",
        "`\"A rises through B\"`, `\"A falls through B\"` or `\"A passes through B\"`; B is often a number"),
    may("action", Takes::Either(&[Takes::Word(&WORDS), Takes::Table(&SET)]), "`\"record\"`", "\"stop\"",
        "`\"record\"`: nothing but a line in the tables; `\"stop\"`: the run ends; `{ set = { D = \"0.04 kg/m\" } \
         }`: parameters get other values from then on"),
]]);

#[rustfmt::skip]
const SET: Keys = Keys::of("action", &[&[
    must("set", Takes::Named(&Takes::Formula), "{ D = \"0.04 kg/m\" }", "parameters and their values from then on"),
]]);

const WORDS: [&str; 2] = ["record", "stop"];

const PASSES: &[(&str, Direction)] = &[
    ("rises through", Direction::Rising),
    ("falls through", Direction::Falling),
    ("passes through", Direction::Both),
];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, event);
}

fn event(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("an event", field);
    draft.remember(format!("event `{name}`"), &field.key_span);
    let when = draft.required(table, "when");
    let when = when.and_then(|field| condition(draft, &field));
    let action = match table.take("action") {
        Some(field) => action(draft, &name, &field),
        None => Some(Action::Record),
    };
    let (Some((when, direction)), Some(action)) = (when, action) else { return };
    draft.model.events.push(Event { name, when, direction, action });
}

/// The formula that passes zero.
fn condition(draft: &mut Draft, field: &Field) -> Option<(Expr, Direction)> {
    let text = draft.words(field)?;
    let found = PASSES.iter().find_map(|(words, direction)| {
        let (left, right) = text.split_once(words)?;
        (left.ends_with(char::is_whitespace) || left.is_empty()).then_some((left, right, *direction))
    });
    let Some((left, right, direction)) = found else {
        draft.note(not_a_condition(field));
        return None;
    };
    let whole = draft.text(field, Want::any())?;
    let part = |part: &str, start: usize| Text {
        text: part.to_owned(),
        origin: whole.origin.part(start..start + part.len()),
        ..whole.clone()
    };
    let (left, right) = (part(left, 0), part(right, text.len() - right.len()));
    let value = formula::number(&draft.names, &left, Want::any().at(Level::Output));
    let Some(value) = draft.all_noted(value) else {
        let level = formula::number(&draft.names, &right, Want::any().at(Level::Output));
        draft.all_noted(level);
        return None;
    };
    let level = against(draft, &value, &right)?;
    Some((if level.is_zero() { value } else { value - level }, direction))
}

/// What is passed, of the same dimension.
fn against(draft: &mut Draft, value: &Expr, text: &Text) -> Option<Expr> {
    let dimension = value.dimension().unwrap_or(Dimension::NONE);
    let angular = curve::is_angular(value);
    let want = Want { angle: angular, ..Want::constant(dimension) }.at(Level::Output);
    let level = formula::number(&draft.names, text, want);
    draft.all_noted(level)
}

fn not_a_condition(field: &Field) -> Diagnostic {
    let message = "this does not say which quantity passes which value";
    Diagnostic::new(Code::When, field.span.clone(), message)
        .label("expected `rises through`, `falls through` or `passes through`")
        .help("write `when = \"rod.vy falls through 0 m/s\"`: a formula, how it passes, and a formula")
}

/// `"record"`, `"stop"` or `{ set = { D = "0.04 kg/m" } }`
fn action(draft: &mut Draft, name: &str, field: &Field) -> Option<Action> {
    if field.value.as_str().is_some() {
        let word = draft.choice(field, &WORDS)?;
        return Some(if word == "stop" { Action::Stop } else { Action::Record });
    }
    if !field.value.is_table() {
        draft.wrong_type(field, "\"record\", \"stop\" or { set = { .. } }");
        return None;
    }
    let mut inner = draft.inline(field, &SET)?;
    let set = draft.required(&mut inner, "set");
    draft.done(inner);
    let set = set?;
    let Some(table) = set.value.as_table() else {
        draft.wrong_type(&set, "a table of parameters, such as `{ D = \"0.04 kg/m\" }`");
        return None;
    };
    draft.remember(format!("settings of `{name}`"), &set.span);
    let settings: Vec<_> = fields(table).iter().map(|field| setting(draft, name, field)).collect();
    settings.into_iter().collect::<Option<Vec<_>>>().map(Action::Set)
}

fn setting(draft: &mut Draft, event: &str, field: &Field) -> Option<(String, Expr)> {
    draft.remember(format!("`{}` as event `{event}` sets it", field.key), &field.span);
    let want = draft.parameter(field)?;
    draft.number(field, want).map(|value| (field.key.to_owned(), value))
}
