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
mod laws;
mod lift;
mod meaning;
mod output;
mod parameters;
mod pivot;
pub(crate) mod play;
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
pub(crate) mod text;
mod torsion;
mod world;

use toml::de::DeTable;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table, fields};
use crate::draft::Draft;
use crate::keys::{Declared, Keys, Takes, may};
use crate::names::Names;
use crate::suggest;

/// A section, or a key at the top of the file.
pub(crate) struct Section {
    pub(crate) declared: Declared,
    read: fn(&mut Draft, &Field),
}

const fn key(declared: Declared, read: fn(&mut Draft, &Field)) -> Section {
    Section { declared, read }
}

/// A section `[NAME]` without a second name.
const fn section(
    name: &'static str,
    takes: Takes,
    says: &'static str,
    read: fn(&mut Draft, &Field),
) -> Section {
    key(may(name, takes, "", "", says), read)
}

/// Sections `[NAME.OWN]`, each with these keys.
const fn sections(
    name: &'static str,
    each: &'static Takes,
    says: &'static str,
    read: fn(&mut Draft, &Field),
) -> Section {
    section(name, Takes::Named(each), says, read)
}

impl Section {
    /// The same, which every scene has: the lines are those of an example.
    const fn needed(self, lines: &'static str) -> Self {
        Self { declared: Declared { default: None, lines: Some(lines), ..self.declared }, ..self }
    }
}

/// Every section, in the order in which they are read: each uses names of those before it only.
pub(crate) const SECTIONS: &[Section] = &[
    key(header::VERSION, header::version).needed("version = 1"),
    key(header::TITLE, header::title),
    key(text::OF_SCENE, text::of_scene),
    key(header::PLANE, header::plane),
    sections(
        "table",
        &Takes::Table(&table::KEYS),
        "functions of one variable that were measured",
        table::read,
    ),
    section("functions", Takes::Named(&Takes::Text), functions::SAYS, functions::read),
    section("parameters", Takes::Named(&Takes::Formula), parameters::SAYS, parameters::read),
    section(
        "sweep",
        Takes::Named(&sweep::VALUES),
        "parameters that take several values, one run each",
        sweep::read,
    ),
    section("world", Takes::Table(&world::KEYS), "what surrounds the bodies", world::read)
        .needed("[world]\ngravity = \"9.81 m/s^2\""),
    sections("body", &Takes::Table(&body::KEYS), body::SAYS, body::read)
        .needed("[body.ball]\nball = { radius = \"0.1 m\" }\nmass = \"1 kg\""),
    sections(
        "pivot",
        &Takes::Table(&pivot::KEYS),
        "points of bodies that are held at a place in the world",
        pivot::read,
    ),
    sections(
        "pin",
        &Takes::Table(&joint::PIN),
        "joints about which bodies turn, without friction",
        joint::read_pins,
    ),
    sections("weld", &Takes::Table(&joint::WELD), "joints that leave nothing free", joint::read_welds),
    // What a contact says counts on surfaces too.
    sections("contact", &Takes::Table(&contact::KEYS), contact::SAYS, contact::read),
    sections("surface", &Takes::Table(&surface::KEYS), surface::SAYS, surface::read),
    sections(
        "event",
        &Takes::Table(&event::KEYS),
        "what happens each time a formula passes a value",
        event::read,
    ),
    sections("force", &Takes::Table(&force::KEYS), "forces at points of bodies, and torques", force::read),
    sections(
        "impulse",
        &Takes::Table(&force::IMPULSES),
        "impulses that events apply to bodies",
        force::read_impulses,
    ),
    sections("drag", &Takes::Table(&drag::KEYS), "resistance of the air", drag::read),
    sections("lift", &Takes::Table(&lift::KEYS), "lift on spinning bodies", lift::read),
    sections("spring", &Takes::Table(&spring::KEYS), "springs between two points", spring::read),
    sections("damper", &Takes::Table(&damper::KEYS), "dampers between two points", damper::read),
    sections(
        "torsion",
        &Takes::Table(&torsion::KEYS),
        "springs that turn a body back to an angle",
        torsion::read,
    ),
    section("run", Takes::Table(&run::KEYS), "how long, and how accurately", run::read)
        .needed("[run]\nuntil = \"10 s\""),
    section("equilibrium", Takes::Table(&equilibrium::KEYS), equilibrium::SAYS, equilibrium::read),
    section("output", Takes::Table(&output::KEYS), "how dense the tables are", output::read),
    sections("plot", &Takes::Table(&plot::KEYS), "curves against the time or another quantity", plot::read),
    sections("stroboscope", &Takes::Table(&stroboscope::KEYS), stroboscope::SAYS, stroboscope::read),
    sections("balance", &Takes::Table(&balance::KEYS), "energies and works along the run", balance::read),
    sections("free_body", &Takes::Table(&free_body::KEYS), free_body::SAYS, free_body::read),
    sections("find", &Takes::Table(&check::FINDS), check::SAYS_FIND, check::read_finds),
    sections("check", &Takes::Table(&check::KEYS), check::SAYS, check::read),
    section("play", play::TAKES, "what a reader of the report may change", play::read),
    section("symbols", symbols::TAKES, "how names are written in figures and equations", symbols::read),
    section("meaning", meaning::TAKES, "what parameters are, in words", meaning::read),
];

/// Of a figure.
const TITLE: Declared = may("title", Takes::Text, "the scene's and NAME", "\"Angles\"", "above the figure");

/// Reads all sections of a document.
pub(crate) fn read(draft: &mut Draft, document: &DeTable) {
    let top = fields(document);
    draft.names.bodies = second_names(&top, "body");
    draft.names.points = points::all_names(&top);
    draft.names.events = second_names(&top, "event");
    draft.names.joints =
        ["pivot", "pin", "weld"].iter().flat_map(|section| second_names(&top, section)).collect();
    draft.names.surfaces = second_names(&top, "surface");
    draft.names.contacts = second_names(&top, "contact");
    for section in SECTIONS {
        if draft.is_full() {
            return;
        }
        let declared = &section.declared;
        match (top.iter().find(|field| field.key == declared.name), declared.lines) {
            (Some(field), _) => (section.read)(draft, field),
            (None, Some(lines)) => draft.note(missing(declared.name, lines)),
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
    let is_known = |field: &&Field| SECTIONS.iter().any(|section| section.declared.name == field.key);
    for field in top.iter().filter(|field| !is_known(field)) {
        let (code, what) = match field.value.is_table() {
            true => (Code::UnknownSection, "section"),
            false => (Code::UnknownKey, "key"),
        };
        let message = format!("there is no {what} `{}`", field.key);
        let help = suggest::section(field.key);
        let mistake = Diagnostic::new(code, field.key_span.clone(), message);
        draft.note(mistake.label(format!("unknown {what}")).help(help));
    }
}

/// Reads each table of a section whose second name is the user's, such as `[body.rod]`.
fn each(draft: &mut Draft, section: &Field, keys: &'static Keys, read: fn(&mut Draft, &Field, &mut Table)) {
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
        let mut inner =
            Table::new(keys, format!("[{}.{}]", section.key, field.key), field.key_span.clone(), inner);
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
fn only(draft: &mut Draft, section: &Field, keys: &'static Keys, read: fn(&mut Draft, &mut Table)) {
    let Some(mut table) = draft.titled(section, keys, keys.title.to_owned()) else { return };
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
