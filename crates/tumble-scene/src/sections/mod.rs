//! The sections of a scene, one a file, and the one table that lists them.

mod balance;
mod body;
mod check;
mod contact;
mod damper;
mod drag;
mod equilibrium;
mod event;
mod force;
mod free_body;
pub(crate) mod functions;
mod header;
mod joint;
mod lift;
mod output;
mod parameters;
mod pivot;
mod play;
mod plot;
mod points;
mod round;
mod run;
mod shape;
mod spring;
pub(crate) mod start;
mod stroboscope;
mod surface;
mod sweep;
mod symbols;
mod table;
mod text;
mod torsion;
mod world;

use toml::de::DeTable;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table, fields};
use crate::draft::Draft;
use crate::names::Names;
use crate::suggest;

/// A section, or a key at the top of the file.
pub(crate) struct Section {
    pub(crate) key: &'static str,
    /// What to add where a scene that needs it has none.
    needed: Option<&'static str>,
    read: fn(&mut Draft, &Field),
}

const fn optional(key: &'static str, read: fn(&mut Draft, &Field)) -> Section {
    Section { key, needed: None, read }
}

const fn needed(key: &'static str, example: &'static str, read: fn(&mut Draft, &Field)) -> Section {
    Section { key, needed: Some(example), read }
}

/// Every section, in the order in which they are read: each uses names of those before it only.
pub(crate) const SECTIONS: &[Section] = &[
    needed("version", "version = 1", header::version),
    optional("title", header::title),
    optional("text", text::of_scene),
    optional("plane", header::plane),
    optional("table", table::read),
    optional("functions", functions::read),
    optional("parameters", parameters::read),
    optional("sweep", sweep::read),
    needed("world", "[world]\ngravity = \"9.81 m/s^2\"", world::read),
    needed("body", "[body.ball]\nball = { radius = \"0.1 m\" }\nmass = \"1 kg\"", body::read),
    optional("pivot", pivot::read),
    optional("pin", joint::read_pins),
    optional("weld", joint::read_welds),
    optional("surface", surface::read),
    optional("contact", contact::read),
    optional("event", event::read),
    optional("force", force::read),
    optional("impulse", force::read_impulses),
    optional("drag", drag::read),
    optional("lift", lift::read),
    optional("spring", spring::read),
    optional("damper", damper::read),
    optional("torsion", torsion::read),
    needed("run", "[run]\nuntil = \"10 s\"", run::read),
    optional("equilibrium", equilibrium::read),
    optional("output", output::read),
    optional("plot", plot::read),
    optional("stroboscope", stroboscope::read),
    optional("balance", balance::read),
    optional("free_body", free_body::read),
    optional("find", check::read_finds),
    optional("check", check::read),
    optional("play", play::read),
    optional("symbols", symbols::read),
];

/// Reads all sections of a document.
pub(crate) fn read(draft: &mut Draft, document: &DeTable) {
    let top = fields(document);
    draft.names.bodies = second_names(&top, "body");
    draft.names.points = points::all_names(&top);
    draft.names.events = second_names(&top, "event");
    draft.names.joints =
        ["pivot", "pin", "weld"].iter().flat_map(|section| second_names(&top, section)).collect();
    draft.names.surfaces =
        ["surface", "contact"].iter().flat_map(|section| second_names(&top, section)).collect();
    for section in SECTIONS {
        if draft.is_full() {
            return;
        }
        match (top.iter().find(|field| field.key == section.key), section.needed) {
            (Some(field), _) => (section.read)(draft, field),
            (None, Some(example)) => draft.note(missing(section.key, example)),
            (None, None) => {}
        }
    }
    functions::check_unused(draft);
    refuse_unknown(draft, &top);
}

/// The names that the user gives in a section, known before anything of them is read.
fn second_names(top: &[Field], section: &str) -> Vec<String> {
    let tables = top.iter().find(|field| field.key == section).and_then(|field| field.value.as_table());
    tables.map(|tables| fields(tables).iter().map(|one| one.key.to_owned()).collect()).unwrap_or_default()
}

fn missing(key: &str, example: &str) -> Diagnostic {
    let (code, what) = match example.starts_with('[') {
        true => (Code::MissingSection, format!("there is no section `[{key}]`")),
        false => (Code::MissingKey, format!("`{key}` is missing at the top of the file")),
    };
    Diagnostic::new(code, 0..0, what).nowhere().help(format!("add, for example,\n{example}"))
}

fn refuse_unknown(draft: &mut Draft, top: &[Field]) {
    let known: Vec<_> = SECTIONS.iter().map(|section| section.key).collect();
    for field in top.iter().filter(|field| !known.contains(&field.key)) {
        let (code, what) = match field.value.is_table() {
            true => (Code::UnknownSection, "section"),
            false => (Code::UnknownKey, "key"),
        };
        let message = format!("there is no {what} `{}`", field.key);
        let help = suggest::section(field.key, &known);
        let mistake = Diagnostic::new(code, field.key_span.clone(), message);
        draft.note(mistake.label(format!("unknown {what}")).help(help));
    }
}

/// Reads each table of a section whose second name is the user's, such as `[body.rod]`.
fn each(draft: &mut Draft, section: &Field, read: fn(&mut Draft, &Field, &mut Table)) {
    let Some(table) = section.value.as_table() else {
        let expected = format!("a section, such as `[{}.NAME]`", section.key);
        return draft.wrong_type(section, &expected);
    };
    for field in fields(table) {
        if draft.is_full() {
            return;
        }
        let Some(inner) = field.value.as_table() else {
            draft.note(unnamed(section.key, &field));
            continue;
        };
        let mut inner = Table::new(format!("[{}.{}]", section.key, field.key), field.key_span.clone(), inner);
        text::of_section(draft, section, Some(&field), &mut inner);
        read(draft, &field, &mut inner);
        draft.done(inner);
    }
}

/// `[body]` with the keys of a body directly inside, or `[[body.rod]]`.
fn unnamed(section: &str, field: &Field) -> Diagnostic {
    let tables = field.value.as_array().is_some_and(|list| list.iter().any(|one| one.get_ref().is_table()));
    let (message, label, help) = match tables {
        true => (
            format!("there is more than one pair of brackets around `{section}.{}`", field.key),
            "in two pairs of brackets".to_owned(),
            format!("write `[{section}.{}]`", field.key),
        ),
        false => (
            format!("`{}` stands in `[{section}]`, which has no name", field.key),
            format!("which {section}?"),
            format!("give the {section} a name: `[{section}.NAME]`"),
        ),
    };
    Diagnostic::new(Code::WrongType, field.key_span.clone(), message).label(label).help(help)
}

/// A section without a second name, such as `[run]`.
fn only(draft: &mut Draft, section: &Field, read: fn(&mut Draft, &mut Table)) {
    let Some(mut table) = draft.table(section, format!("[{}]", section.key)) else { return };
    text::of_section(draft, section, None, &mut table);
    read(draft, &mut table);
    draft.done(table);
}

/// The name of a body, which must exist.
fn body(draft: &mut Draft, field: &Field) -> Option<String> {
    known(draft, field, Code::UnknownBody, ["body", "bodies"], |names| &names.bodies)
}

/// The name of an event, which must exist.
fn event_named(draft: &mut Draft, field: &Field) -> Option<String> {
    known(draft, field, Code::UnknownEvent, ["event", "events"], |names| &names.events)
}

/// A name that one of a kind must have; the kind as messages call one and several.
fn known(
    draft: &mut Draft,
    field: &Field,
    code: Code,
    [one, several]: [&str; 2],
    of: impl Fn(&Names) -> &Vec<String>,
) -> Option<String> {
    let name = draft.words(field)?;
    if of(&draft.names).contains(&name) {
        return Some(name);
    }
    let help = suggest::name(&name, several, of(&draft.names).iter().map(String::as_str));
    let message = format!("there is no {one} \"{name}\"");
    let mistake = Diagnostic::new(code, field.span.clone(), message);
    draft.note(mistake.label(format!("unknown {one}")).help(help));
    None
}
