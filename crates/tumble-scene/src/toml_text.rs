//! From text to a TOML document, or what is wrong with the text as TOML.

use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};

/// So many mistakes of TOML itself are reported: what follows the first few is mostly their echo.
const MAX_ERRORS: usize = 10;

/// The document as far as it can be read, and the mistakes. With mistakes other than keys given twice, the document
/// has holes that are no mistakes of the scene: it is `None` then.
pub(crate) fn parse(text: &str) -> (Option<Spanned<DeTable<'_>>>, Vec<Diagnostic>) {
    let (document, errors) = DeTable::parse_recoverable(text);
    let whole = errors.iter().all(is_duplicate);
    let mistakes = errors.iter().take(MAX_ERRORS).map(|error| diagnose(text, error)).collect();
    (whole.then_some(document), mistakes)
}

fn is_duplicate(error: &Error) -> bool {
    error.message().starts_with("duplicate key")
}

fn diagnose(text: &str, error: &Error) -> Diagnostic {
    let end = text.len();
    let span = error.span().filter(|span| span.end <= end).unwrap_or(end..end);
    if is_duplicate(error) { duplicate(text, span) } else { syntax(text, span, error.message()) }
}

fn syntax(text: &str, span: Span, message: &str) -> Diagnostic {
    let mistake = |what: &str| Diagnostic::new(Code::Toml, span.clone(), format!("this is not TOML: {what}"));
    match unquoted(line_around(text, span.start)) {
        Some(cure) => mistake("a text stands without its quotes").help(cure),
        None => match foreign(text.get(span.clone()).unwrap_or_default()) {
            Some(cure) => mistake(message).help(cure),
            None => mistake(message),
        },
    }
}

fn line_around(text: &str, at: usize) -> &str {
    let (before, after) = text.split_at(floor(text, at));
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let end = after.find(['\n', '\r']).unwrap_or(after.len());
    &text[start..before.len() + end]
}

fn floor(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

/// A name in letters that are not Latin, which TOML knows in quotes only.
fn foreign(name: &str) -> Option<String> {
    let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
    (is_name && !name.is_ascii()).then(|| {
        format!("TOML wants quotes about letters that are not Latin: write `\"{name}\"`, as in `[body.\"{name}\"]`")
    })
}

/// The commonest slip: a quantity or formula without its quotes.
fn unquoted(line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let value = value.split('#').next().unwrap_or(value).trim();
    let plain = !value.is_empty() && !value.contains(['"', '\'', '[', '{', '=']);
    plain.then(|| format!("quantities and formulas stand in quotes: write `{} = \"{value}\"`", key.trim()))
}

fn duplicate(text: &str, second: Span) -> Diagnostic {
    let key = text[second.clone()].to_owned();
    let mistake = Diagnostic::new(Code::DuplicateKey, second.clone(), format!("`{key}` is given twice"));
    let mistake = mistake.label("again here").help("keep one of them");
    match first_of(text, &second) {
        Some(first) => mistake.also(first, "first here"),
        None => mistake,
    }
}

/// Where the key at `second` was given first.
///
/// The parser does not say. But once the second one has a name of its own, both stand in the same table.
fn first_of(text: &str, second: &Span) -> Option<Span> {
    let word = decoded(&text[second.clone()])?;
    let own = (0..).map(|n| format!("own{n}")).find(|own| !text.contains(own.as_str()))?;
    let renamed = format!("{}{own}{}", &text[..second.start], &text[second.end..]);
    let (document, _) = DeTable::parse_recoverable(&renamed);
    let mut tables = vec![document.get_ref()];
    while let Some(table) = tables.pop() {
        if table.keys().any(|key| key.get_ref() == own.as_str()) {
            let first = table.keys().find(|key| *key.get_ref() == word)?;
            return Some(first.span()).filter(|span| span.end <= second.start);
        }
        tables.extend(table.values().flat_map(|value| inner_tables(value.get_ref())));
    }
    None
}

/// A key without its quotes and escapes.
fn decoded(key: &str) -> Option<String> {
    let line = format!("{key} = 0");
    let (document, _) = DeTable::parse_recoverable(&line);
    document.get_ref().keys().next().map(|key| key.get_ref().to_string())
}

fn inner_tables<'t, 'i>(value: &'t DeValue<'i>) -> Vec<&'t DeTable<'i>> {
    match value {
        DeValue::Table(table) => vec![table],
        DeValue::Array(array) => array.iter().flat_map(|value| inner_tables(value.get_ref())).collect(),
        _ => vec![],
    }
}
