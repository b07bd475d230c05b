//! Help on words that a scene does not know: what was probably meant, or what there is.

use tumble_expr::language::nearest;

use crate::document::Table;
use crate::{keys, words};

/// A longer list helps nobody.
const MOST_LISTED: usize = 40;

/// Help on a section, or a key at the top of the file, that there is not.
pub(crate) fn section(word: &str) -> String {
    if let Some(meaning) = words::section(word) {
        return meaning.to_owned();
    }
    let known = keys::of_scene().map(|section| section.name);
    match nearest(word, known.clone()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("a scene is made of {}", list(known)),
    }
}

/// Help on a key that this table does not have.
pub(crate) fn key(table: &Table, word: &str) -> String {
    if let Some(meaning) = words::key(&table.title, word) {
        return meaning.to_owned();
    }
    let known = table.keys.iter().map(|key| key.name);
    match nearest(word, known.clone()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if keys::of_scene().any(|section| section.name == word) => {
            format!("`{word}` stands at the top level of the file, outside of any section")
        }
        None => format!("the keys are {}", list(known)),
    }
}

/// Help on a name that nothing of its kind has.
pub(crate) fn name<'w>(word: &str, kind: &str, known: impl IntoIterator<Item = &'w str> + Clone) -> String {
    match nearest(word, known.clone()) {
        Some(near) => format!("did you mean \"{near}\"?"),
        None if known.clone().into_iter().next().is_none() => format!("there are no {kind}"),
        None => format!("the {kind} are {}", list(known)),
    }
}

/// `a`, `b` and `c`
pub(crate) fn list<'w>(words: impl IntoIterator<Item = &'w str>) -> String {
    let mut words = words.into_iter();
    let mut quoted: Vec<String> = words.by_ref().take(MOST_LISTED).map(|word| format!("`{word}`")).collect();
    let last = match words.count() {
        0 => quoted.pop().unwrap_or_default(),
        more => format!("{more} more"),
    };
    if quoted.is_empty() { last } else { format!("{} and {last}", quoted.join(", ")) }
}
