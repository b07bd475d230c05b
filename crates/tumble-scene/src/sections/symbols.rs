//! `[symbols]`: `"rod.angle" = "theta"`, how names are written in figures and equations.

use toml::de::{DeTable, DeValue};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, fields};
use crate::draft::Draft;
use crate::keys::Takes;
use crate::names::Level;
use crate::suggest;

/// A name with a dot in it may also be written as tables in tables.
pub(super) const TAKES: Takes = Takes::Named(&Takes::Either(&[Takes::Text, Takes::Open]));

pub(super) fn read(draft: &mut Draft, section: &Field) {
    match section.value {
        DeValue::Table(table) => all(draft, "", table),
        _ => draft.wrong_type(section, "a section, such as `symbols = { \"rod.angle\" = \"theta\" }`"),
    }
}

/// TOML takes a dot without quotes for a table in a table; a name with a dot is meant either way.
fn all(draft: &mut Draft, before: &str, table: &DeTable) {
    for field in fields(table) {
        let name = format!("{before}{}", field.key);
        match field.value {
            DeValue::Table(inner) => all(draft, &format!("{name}."), inner),
            _ => one(draft, name, &field),
        }
    }
}

fn one(draft: &mut Draft, name: String, field: &Field) {
    let Some(symbol) = draft.line(field) else { return };
    let scope = draft.names.scope(Level::Output);
    if scope.value(&name).is_none() && !scope.is_function(&name) {
        if !draft.names.is_broken(&name) {
            let help = suggest::name(&name, "names", scope.names());
            let mistake = Diagnostic::new(
                Code::UnknownKey,
                field.key_span.clone(),
                format!("nothing is named `{name}`"),
            );
            draft.note(mistake.label("unknown name").help(help));
        }
        return;
    }
    draft.symbols.insert(name, symbol);
}
