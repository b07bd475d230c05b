//! The word that was probably meant.

/// The candidate that differs in upper and lower case only.
pub(super) fn same_letters<'c>(word: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    let lower = word.to_lowercase();
    candidates.into_iter().find(|candidate| candidate.to_lowercase() == lower)
}

/// Bytes; longer words are not slips of a name.
const LONGEST: usize = 200;
/// Only so many candidates are compared: the time is the product of both lengths, for each of them.
const MOST_CANDIDATES: usize = 5000;

/// The candidate fewest slips of the keyboard away, if they are few for so short a word.
pub(super) fn nearest<'c>(word: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    if word.len() > LONGEST {
        return None;
    }
    let slips_allowed = match word.chars().count() {
        0..=2 => 1,
        3..=5 => 2,
        _ => 3,
    };
    let length = word.chars().count();
    let fits = |candidate: &&str| candidate.chars().count().abs_diff(length) <= slips_allowed;
    let near = candidates.take(MOST_CANDIDATES).filter(fits);
    let scored = near.map(|candidate| (distance(word, candidate), candidate));
    let (slips, best) = scored.min_by_key(|(slips, _)| *slips)?;
    let shares_something = slips < word.chars().count();
    (slips <= slips_allowed && shares_something).then_some(best)
}

/// A slip of case counts less than any other slip.
fn distance(word: &str, candidate: &str) -> usize {
    match candidate.to_lowercase() == word.to_lowercase() {
        true => 0,
        false => strsim::damerau_levenshtein(word, candidate),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_slips_are_forgiven() {
        let names = ["gravity", "rod.angle", "m", "L"];
        let nearest = |word| nearest(word, names.into_iter());
        assert_eq!(nearest("gravty"), Some("gravity"));
        assert_eq!(nearest("rod.anlge"), Some("rod.angle"));
        assert_eq!(nearest("M"), Some("m"));
        assert_eq!(nearest("x"), None);
        assert_eq!(nearest("temperature"), None);
    }
}
