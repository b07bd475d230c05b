//! `text = """..."""`: the problem in words at the top of the file, and what is to be said of a section within it.

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Origin;
use crate::keys::{Declared, Takes, may};
use crate::printable::is_unseen;
use crate::study::Commentary;

#[rustfmt::skip]
pub(super) const OF_SCENE: Declared = may("text", Takes::Text, "none", "\"\"\"..\"\"\"",
    "the problem in words, `\"\"\"` .. `\"\"\"`: it stands in the report. Empty lines part paragraphs; between dollar \
     signs stand names, as `$theta$`.");

/// What every section has beside its own keys.
#[rustfmt::skip]
pub(crate) const KEY: &[Declared] = &[may(
    "text",
    Takes::Text,
    "none",
    "\"\"\"..\"\"\"",
    "what the report says of it; empty lines part paragraphs",
)];

/// At the top of the file.
pub(super) fn of_scene(draft: &mut Draft, field: &Field) {
    add(draft, "", "", field);
}

/// In a section, of the user's name if it has one.
pub(super) fn of_section(draft: &mut Draft, section: &Field, own: Option<&Field>, table: &mut Table) {
    if let Some(field) = table.take("text") {
        add(draft, section.key, own.map_or("", |own| own.key), &field);
    }
}

fn add(draft: &mut Draft, section: &str, name: &str, field: &Field) {
    let Some(text) = words(draft, field) else { return };
    let paragraphs = paragraphs(&text);
    draft.texts.push(Commentary { section: section.to_owned(), name: name.to_owned(), paragraphs });
}

/// Its lines may end, but nothing in it may turn the direction of what follows or be obeyed otherwise.
fn words(draft: &mut Draft, field: &Field) -> Option<String> {
    let text = draft.words(field)?;
    let is_hidden = |c: &(usize, char)| is_unseen(c.1) && !matches!(c.1, '\n' | '\r' | '\t');
    let Some((at, unseen)) = text.char_indices().find(is_hidden) else { return Some(text) };
    let origin = Origin::of(&draft.sources[0].text, field.span.clone(), &text);
    let span = origin.map(&(at..at + unseen.len_utf8()));
    let message = format!("`text` has the character U+{:04X}, which is not shown", u32::from(unseen));
    draft.note(
        Diagnostic::new(Code::Unseen, span, message).label("not shown").help("leave this character out"),
    );
    None
}

/// Paragraphs are what empty lines part; within them lines are as long as the page.
fn paragraphs(text: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    for line in text.lines().map(str::trim) {
        match (line.is_empty(), all.last_mut()) {
            (false, Some(last)) if last.is_empty() => last.push_str(line),
            (false, Some(last)) => *last += &format!(" {line}"),
            _ => all.push(String::new()),
        }
    }
    all.retain(|paragraph| !paragraph.is_empty());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_lines_part_paragraphs() {
        let text = "\n  A rod\nhangs.\r\n\n \nHow far?\n";
        assert_eq!(paragraphs(text), ["A rod hangs.", "How far?"]);
        assert!(paragraphs(" \n").is_empty());
    }
}
