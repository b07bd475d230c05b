//! `[meaning]`: `L = "length of the rod"`, what parameters are, in words.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, fields};
use crate::draft::Draft;
use crate::keys::Takes;
use crate::suggest;

pub(super) const TAKES: Takes = Takes::Named(&Takes::Text);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    let Some(table) = section.value.as_table() else {
        return draft.wrong_type(section, "a section, such as `meaning = { L = \"length of the rod\" }`");
    };
    for field in fields(table) {
        let Some(words) = draft.line(&field) else { continue };
        match draft.model.parameters.symbol(field.key) {
            Some(_) => _ = draft.meanings.insert(field.key.to_owned(), words),
            // A parameter with a mistake has been reported.
            None if draft.names.is_broken(field.key) => {}
            None => draft.note(unknown(draft, &field)),
        }
    }
}

fn unknown(draft: &Draft, field: &Field) -> Diagnostic {
    let symbols = draft.model.parameters.symbols();
    let help = suggest::name(field.key, "parameters", symbols.iter().map(|symbol| &*symbol.name));
    let message = format!("no parameter is named `{}`", field.key);
    Diagnostic::new(Code::UnknownKey, field.key_span.clone(), message).label("unknown parameter").help(help)
}
