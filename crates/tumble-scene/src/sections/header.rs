//! The keys at the top of the file: `version`, `title`, `plane`.

use toml::de::DeValue;

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::Field;
use crate::draft::Draft;

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
    draft.horizontal = draft.choice(field, &["vertical", "horizontal"]) == Some("horizontal");
}
