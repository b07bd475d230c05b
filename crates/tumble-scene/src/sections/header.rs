//! The keys at the top of the file: `version`, `title`, `plane`.

use toml::de::DeValue;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::Field;
use crate::draft::Draft;
use crate::keys::{Declared, Takes, may, must};

#[rustfmt::skip]
pub(super) const VERSION: Declared = must("version", Takes::Exactly(1), "1",
    "`1`, the version of this language. What it means does not change; a scene of a later version needs a later \
     program.");
#[rustfmt::skip]
pub(super) const TITLE: Declared = may("title", Takes::Text, "none", "\"A rod falls\"",
    "a line of text, without control characters and marks of direction");
#[rustfmt::skip]
pub(super) const PLANE: Declared = may("plane", Takes::Word(&PLANES), "`\"vertical\"`", "\"horizontal\"",
    "`\"vertical\"`: the weight acts along -y. `\"horizontal\"`: seen from above, the weight acts into the page and is \
     carried.");
const PLANES: [&str; 2] = ["vertical", "horizontal"];

/// `version = 1`: the version of the language, so that later ones can read old scenes.
pub(super) fn version(draft: &mut Draft, field: &Field) {
    match field.value {
        DeValue::Integer(integer) if integer.to_string() == "1" => {}
        DeValue::Integer(_) => {
            let message = "this program reads version 1 of the scene language";
            let mistake = Diagnostic::new(Code::Version, field.span.clone(), message);
            let help = "write `version = 1`; what that means does not change, and a scene of a later version needs a later program";
            draft.note(mistake.label("another version").help(help));
        }
        _ => draft.wrong_type(field, "the number 1"),
    }
}

/// `title = "..."`
pub(super) fn title(draft: &mut Draft, field: &Field) {
    draft.title = draft.line(field).unwrap_or_default();
}

/// `plane = "vertical"`, with the weight along -y, or `"horizontal"`, seen from above.
pub(super) fn plane(draft: &mut Draft, field: &Field) {
    draft.horizontal = draft.choice(field, &PLANES) == Some("horizontal");
}
