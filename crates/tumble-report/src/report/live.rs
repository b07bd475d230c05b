//! What a page is sent while it plays: the parts of a report as the page itself has them, and what is to be said, as JSON.

use tumble_drawing::Label;
use tumble_scene::{Diagnostic, Diagnostics, Preset, Severity, Study, Underlined};

use crate::figures::symbols;

use super::html;
use super::json::{list, number, object, string};

pub use super::html::{living, motion, parts};

/// What is to be said of a scene: each with its code, its place, its message and its cure, the words of the command.
pub fn said(diagnostics: &Diagnostics) -> String {
    let each = diagnostics.list.iter().map(|one| said_one(diagnostics, one));
    object([("list", list(each))])
}

fn said_one(all: &Diagnostics, one: &Diagnostic) -> String {
    let source = all.sources.get(one.source);
    let text = source.map_or("", |source| source.text.as_str());
    let (line, column) = all.position(one).unwrap_or((0, 0));
    object([
        ("code", string(one.code.as_str())),
        ("severity", string(if one.severity == Severity::Error { "error" } else { "warning" })),
        ("message", string(&one.message)),
        ("source", one.source.to_string()),
        ("name", string(source.map_or("", |source| &source.name))),
        ("line", line.to_string()),
        ("column", column.to_string()),
        ("text", string(text.lines().nth(line.max(1) - 1).filter(|_| line > 0).unwrap_or_default())),
        ("labels", list(one.labels.iter().map(|label| place(text, label)))),
        ("help", string(one.help.as_deref().unwrap_or_default())),
    ])
}

/// Where a label is, in the units that scripts count texts in.
fn place(text: &str, label: &Underlined) -> String {
    let units = |to: usize| text.get(..to).map_or(0, |before| before.encode_utf16().count());
    object([
        ("from", units(label.span.start).to_string()),
        ("to", units(label.span.end).to_string()),
        ("text", string(&label.text)),
    ])
}

/// What may be changed in a scene, with what it is called: by its symbol, or in words.
pub fn play(study: &Study) -> String {
    let (play, symbols) = (&study.play, symbols::all(study));
    let joints = &study.model.joints;
    let is_assembled = joints.iter().any(|joint| joint.assemble);
    let holds = |body: &str| joints.iter().any(|joint| joint.bodies().any(|own| own == body));
    let called = |name: &str| match name.split_once(".start.") {
        Some((body, quantity)) => {
            let name = format!("{body}.{quantity}");
            // Of several bodies the symbol says of which.
            let called = match study.model.bodies.len() {
                1 => symbols::called(study, &symbols, &name),
                _ => symbols::label(&symbols, &name),
            };
            // What joints bring to where it fits is not what the body starts with.
            match is_assembled && holds(body) {
                true => Label::plain("first guess of ").then(called),
                false => called.then(Label::plain(" at the start")),
            }
        }
        None => symbols::label(&symbols, name),
    };
    let knob = |knob: &tumble_scene::Knob| {
        object([
            ("name", string(&knob.name)),
            ("label", html::label(&called(&knob.name))),
            ("text", string(&knob.text)),
            ("value", number(knob.value)),
            ("unit", string(&knob.unit)),
            ("size", number(knob.size)),
            ("range", list(knob.range.map(number))),
            ("log", knob.is_log.to_string()),
            ("first", knob.is_first.to_string()),
        ])
    };
    let preset = |preset: &Preset| {
        let set = preset.set.iter().map(|(name, text)| list([string(name), string(text)]));
        object([("label", string(&preset.label)), ("text", string(&preset.text)), ("set", list(set))])
    };
    object([("knobs", list(play.knobs.iter().map(knob))), ("presets", list(play.presets.iter().map(preset)))])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn starts_that_joints_bring_to_where_they_fit_are_first_guesses() {
        let of = |name: &str| play(&crate::scenes::motions_called(name).0);
        assert!(of("13-four-bar-linkage").contains("first guess of "));
        let rod = of("02-thrown-rod");
        assert!(rod.contains(" at the start") && !rod.contains("first guess of "));
    }
}
