//! A TOML document as sections read it: tables whose keys are asked for one by one, and what is left over is unknown.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::diagnostic::Span;
use crate::keys::Keys;

/// A key with its value and where both stand.
#[derive(Clone)]
pub(crate) struct Field<'t> {
    /// The last part of the key.
    pub(crate) key: &'t str,
    pub(crate) key_span: Span,
    pub(crate) value: &'t DeValue<'t>,
    pub(crate) span: Span,
}

impl<'t> Field<'t> {
    /// An element of this field's list, called by the same key.
    pub(crate) fn element(&self, value: &'t Spanned<DeValue<'t>>) -> Field<'t> {
        Field { value: value.get_ref(), span: value.span(), ..self.clone() }
    }

    /// The elements of this field's list, if it is one.
    pub(crate) fn elements(&self) -> Option<Vec<Field<'t>>> {
        let array = self.value.as_array()?;
        Some(array.iter().map(|value| self.element(value)).collect())
    }

    /// What the value is, in words.
    pub(crate) fn describe(&self) -> String {
        match self.value {
            DeValue::String(_) => "a text in quotes".into(),
            DeValue::Integer(_) | DeValue::Float(_) => "a number".into(),
            DeValue::Boolean(value) => format!("`{value}`"),
            DeValue::Datetime(_) => "a date".into(),
            DeValue::Array(array) => format!("a list of {}", array.len()),
            DeValue::Table(_) => "a table".into(),
        }
    }
}

/// The fields of a table in the order of the text.
pub(crate) fn fields<'t>(table: &'t DeTable<'t>) -> Vec<Field<'t>> {
    let field = |(key, value): (&'t Spanned<_>, &'t Spanned<DeValue<'t>>)| Field {
        key: std::borrow::Cow::as_ref(key.get_ref()),
        key_span: key.span(),
        value: value.get_ref(),
        span: value.span(),
    };
    let mut fields: Vec<_> = table.iter().map(field).collect();
    fields.sort_by_key(|field| field.key_span.start);
    fields
}

/// A table whose keys are declared.
pub(crate) struct Table<'t> {
    /// What a reader calls it: `[body.rod]`, or the key of an inline table.
    pub(crate) title: String,
    /// Where its name stands.
    pub(crate) span: Span,
    pub(crate) keys: &'static Keys,
    pub(crate) fields: Vec<Field<'t>>,
}

impl<'t> Table<'t> {
    pub(crate) fn new(keys: &'static Keys, title: String, span: Span, table: &'t DeTable<'t>) -> Self {
        Self { title, span, keys, fields: fields(table) }
    }

    /// One without keys, for what is not there.
    pub(crate) fn empty(keys: &'static Keys) -> Self {
        Self { title: keys.title.to_owned(), span: 0..0, keys, fields: vec![] }
    }

    /// The field of that key, one of those declared.
    pub(crate) fn take(&mut self, key: &str) -> Option<Field<'t>> {
        debug_assert!(self.keys.find(key).is_some(), "`{key}` is not declared in {}", self.keys.title);
        let at = self.fields.iter().position(|field| field.key == key)?;
        Some(self.fields.remove(at))
    }

    /// Forgets what is declared: it is no mistake where another one is told.
    pub(crate) fn ignore(&mut self) {
        self.fields.retain(|field| self.keys.find(field.key).is_none());
    }
}
