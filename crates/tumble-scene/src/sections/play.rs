//! `[play]`: what a reader of the page may change, from where to where, and presets.

use toml::de::{DeTable, DeValue};

use super::sweep;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table, fields};
use crate::draft::Draft;
use crate::formula::{self, Want};
use crate::keys::{Keys, Takes, may, must};
use crate::play::{Asked, Preset, Settable, settable};
use crate::suggest;

/// The key that is no value to change.
const PRESETS: &str = "presets";

pub(super) const TAKES: Takes = Takes::Named(&Takes::Either(&[
    Takes::Pair(&Takes::Formula),
    Takes::Table(&RANGE),
    // Starts have dots in their names, which TOML reads as tables.
    Takes::Open,
]));

#[rustfmt::skip]
const RANGE: Keys = Keys::of("range of a slider", &[&[
    must("from", Takes::Formula, "\"0.2 s\"", "the least value"),
    must("to", Takes::Formula, "\"6 s\"", "the greatest value"),
    sweep::SPACING,
]]);

/// Presets stand among the names of what may be changed.
#[rustfmt::skip]
pub(crate) const PRESET: Keys = Keys::of("[play.presets.NAME]", &[&[
    may("label", Takes::Text, "its name", "\"slow\"", "what its button says"),
    must("set", Takes::Open, "{ T = \"2 s\" }", "values by their names"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    let DeValue::Table(table) = section.value else {
        return draft.wrong_type(section, "a section, such as `play = { T = [\"0.5 s\", \"4 s\"] }`");
    };
    let known = settable(draft);
    ranges(draft, &known, "", table);
}

/// TOML takes a dot without quotes for a table in a table; a name with a dot is meant either way.
fn ranges(draft: &mut Draft, known: &[Settable], before: &str, table: &DeTable) {
    for field in fields(table) {
        let name = format!("{before}{}", field.key);
        match field.value {
            DeValue::Table(inner) if name == PRESETS => presets(draft, known, inner),
            DeValue::Table(inner) if !inner.contains_key("from") => {
                ranges(draft, known, &format!("{name}."), inner)
            }
            _ => {
                let asked = value(draft, known, &name, &field).and_then(|of| range(draft, &field, of));
                draft.asked_to_play.extend(asked);
            }
        }
    }
}

/// What is called so, or the mistake.
fn value<'k>(draft: &mut Draft, known: &'k [Settable], name: &str, field: &Field) -> Option<&'k Settable> {
    let found = known.iter().find(|of| of.name == name);
    if found.is_none() && !draft.names.is_broken(name) && !known.is_empty() {
        let help =
            suggest::name(name, "names that can be played with", known.iter().map(|of| of.name.as_str()));
        let message = format!("nothing that could be changed is named `{name}`");
        let mistake = Diagnostic::new(Code::UnknownParameter, field.key_span.clone(), message);
        draft.note(mistake.label("unknown name").help(help));
    }
    found
}

/// `["0.2 s", "6 s"]` or `{ from = "0.2 s", to = "6 s", spacing = "log" }`
fn range(draft: &mut Draft, field: &Field, of: &Settable) -> Option<Asked> {
    let (ends, is_log) = match field.value {
        DeValue::Table(_) => spaced(draft, field, of.want)?,
        _ => {
            let ends = draft.pair(field, "[from, to]")?;
            (ends, None)
        }
    };
    let [from, to] = ends.map(|end| draft.number(&end, of.want));
    let values = draft.model.parameters.evaluate(&[from?, to?]).ok()?;
    let range = [values[0], values[1]];
    let is_log = is_log.unwrap_or(range[0] > 0.0 && range[1] > crate::play::DECADES * range[0]);
    refuse(draft, field, range, is_log)?;
    Some(Asked { name: of.name.clone(), range, is_log })
}

fn spaced<'t>(draft: &mut Draft, field: &Field<'t>, want: Want) -> Option<([Field<'t>; 2], Option<bool>)> {
    let mut table = draft.inline(field, &RANGE)?;
    let example = format!("\"{}\"", want.example("1"));
    let ends = ["from", "to"].map(|key| draft.required_like(&mut table, key, &example));
    let spacing = table.take("spacing").map(|field| draft.choice(&field, &sweep::SPACINGS));
    draft.done(table);
    let [from, to] = ends;
    let is_log = match spacing {
        None => None,
        Some(word) => Some(word? == "log"),
    };
    Some(([from?, to?], is_log))
}

/// A range has something in it, and equal ratios need positive ends.
fn refuse(draft: &mut Draft, field: &Field, [from, to]: [f64; 2], is_log: bool) -> Option<()> {
    let fault = match from.is_finite() && to.is_finite() && from < to {
        false => Some("a range goes from a value to a greater one"),
        true if is_log && from <= 0.0 => {
            Some("a range of equal ratios goes from a positive value to a positive one")
        }
        true => None,
    };
    let Some(message) = fault else { return Some(()) };
    draft.note(Diagnostic::new(Code::Value, field.span.clone(), message).label("no such range"));
    None
}

/// `[play.presets.NAME]`
fn presets(draft: &mut Draft, known: &[Settable], table: &DeTable) {
    for field in fields(table) {
        let Some(mut inner) = draft.titled(&field, &PRESET, format!("[play.presets.{}]", field.key)) else {
            continue;
        };
        let preset = preset(draft, known, &field, &mut inner);
        draft.done(inner);
        draft.presets.extend(preset);
    }
}

fn preset(draft: &mut Draft, known: &[Settable], field: &Field, table: &mut Table) -> Option<Preset> {
    let label = table.take("label").map(|label| draft.line(&label));
    let text = table.take("text").map(|text| draft.line(&text));
    let set = draft.required(table, "set")?;
    let DeValue::Table(values) = set.value else {
        draft.wrong_type(&set, "a table of values, such as `{ T = \"2 s\" }`");
        return None;
    };
    let mut found = vec![];
    settings(draft, known, "", values, &mut found);
    let label = label.unwrap_or_else(|| Some(field.key.to_owned()))?;
    Some(Preset { label, text: text.unwrap_or_else(|| Some(String::new()))?, set: found })
}

fn settings(
    draft: &mut Draft,
    known: &[Settable],
    before: &str,
    table: &DeTable,
    found: &mut Vec<(String, String)>,
) {
    for field in fields(table) {
        let name = format!("{before}{}", field.key);
        if let DeValue::Table(inner) = field.value {
            settings(draft, known, &format!("{name}."), inner, found);
            continue;
        }
        let Some(of) = value(draft, known, &name, &field) else { continue };
        let Some(text) = draft.text(&field, of.want) else { continue };
        let checked = formula::number(&draft.names, &text, of.want);
        if draft.all_noted(checked).is_some() {
            found.push((name, text.text));
        }
    }
}
