//! What was probably meant.

/// Longer words, characters, are not slips of a name.
const LONGEST: usize = 100;
/// Only so many words are compared: the time is the product of both lengths, for each of them.
const MOST_WORDS: usize = 5000;

/// The word fewest slips away, if they are few.
pub(crate) fn nearest<'w>(word: &str, words: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    let length = word.chars().count();
    let most = length.div_ceil(3);
    if length > LONGEST {
        return None;
    }
    let near =
        words.into_iter().take(MOST_WORDS).filter(|known| known.chars().count().abs_diff(length) <= most);
    let scored = near.map(|known| (slips(word, known), known));
    let (least, best) = scored.min_by_key(|(slips, _)| *slips)?;
    (least <= most).then_some(best)
}

fn slips(word: &str, known: &str) -> usize {
    strsim::damerau_levenshtein(&word.to_lowercase(), &known.to_lowercase())
}

/// Help on a key that its section does not have.
pub(crate) fn key(word: &str, known: &[&str]) -> String {
    let top = crate::sections::SECTIONS.iter().any(|section| section.key == word);
    match nearest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if top => format!("`{word}` stands at the top level of the file, outside of any section"),
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
    let mut quoted: Vec<String> = words.into_iter().map(|word| format!("`{word}`")).collect();
    let last = quoted.pop().unwrap_or_default();
    if quoted.is_empty() { last } else { format!("{} and {last}", quoted.join(", ")) }
}
