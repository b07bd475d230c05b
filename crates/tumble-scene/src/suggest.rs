//! What was probably meant.

use tumble_expr::language::Letters;

use crate::words;

/// Longer words, characters, are not slips of a name.
const LONGEST: usize = 100;
/// Only so many words are looked at.
const MOST_WORDS: usize = 20_000;
/// Of those that have nearly the same letters only so many are compared: the time is the product of both lengths.
const MOST_COMPARED: usize = 500;
/// A longer list helps nobody.
const MOST_LISTED: usize = 40;

/// The word fewest slips away, if they are so few that no other word can be meant: a slip rarely is that of the first letter,
/// and `wind` is not `find`.
pub(crate) fn nearest<'w>(word: &str, words: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    let length = word.chars().count();
    let most = match length {
        0..=5 => 1,
        6..=11 => 2,
        _ => 3,
    };
    if length > LONGEST {
        return None;
    }
    let letters = Letters::of(word);
    let fits = |known: &&str| {
        known.len() <= 2 * LONGEST && begins_like(word, known) && letters.slips_to(known) <= most
    };
    let near = words.into_iter().take(MOST_WORDS).filter(fits).take(MOST_COMPARED);
    let scored = near.map(|known| (slips(word, known), known));
    let (least, best) = scored.min_by_key(|(slips, _)| *slips)?;
    (least <= most).then_some(best)
}

fn begins_like(word: &str, known: &str) -> bool {
    let first = |word: &str| word.chars().next().map(|letter| letter.to_lowercase().to_string());
    first(word) == first(known)
}

fn slips(word: &str, known: &str) -> usize {
    strsim::damerau_levenshtein(&word.to_lowercase(), &known.to_lowercase())
}

/// Help on a section, or a key at the top of the file, that there is not.
pub(crate) fn section(word: &str, known: &[&str]) -> String {
    if let Some(meaning) = words::section(word) {
        return meaning.to_owned();
    }
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("a scene is made of {}", list(known.iter().copied())),
    }
}

/// Help on a key that the section of that title does not have.
pub(crate) fn key(title: &str, word: &str, known: &[&str]) -> String {
    let top = crate::sections::SECTIONS.iter().any(|section| section.key == word);
    if let Some(meaning) = words::key(title, word) {
        return meaning.to_owned();
    }
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if top => format!("`{word}` stands at the top level of the file, outside of any section"),
        None if known.is_empty() => "the keys are none: the section says it all by itself".to_owned(),
        None => format!("the keys are {}", list(known.iter().copied())),
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
