//! The word that was probably meant.

/// The candidate that differs in upper and lower case only.
pub(super) fn same_letters<'c>(word: &str, candidates: impl Iterator<Item = &'c str>) -> Option<&'c str> {
    let lower = word.to_lowercase();
    candidates.into_iter().find(|candidate| candidate.to_lowercase() == lower)
}

/// Bytes; longer words are not slips of a name.
const LONGEST: usize = 200;
/// Only so many candidates are looked at.
const MOST_CANDIDATES: usize = 20_000;
/// Of those that have nearly the same letters only so many are compared: the time is the product of both lengths.
const MOST_COMPARED: usize = 500;

/// Letters are told apart by this many of their bits: enough for a bound.
const KINDS: usize = 64;

/// How often a word has each letter, upper and lower case alike. Two words are at least as many slips apart as letters of the
/// one are not in the other, which is soon counted.
#[derive(Clone, Debug)]
pub struct Letters([i16; KINDS]);

impl Letters {
    /// Those of a word.
    pub fn of(word: &str) -> Self {
        let mut letters = Self([0; KINDS]);
        letters.count(word, 1);
        letters
    }

    fn count(&mut self, word: &str, by: i16) {
        for letter in word.chars().flat_map(char::to_lowercase) {
            let place = &mut self.0[letter as usize % KINDS];
            *place = place.saturating_add(by);
        }
    }

    /// Fewer slips than these do not lead to another word.
    pub fn slips_to(&self, other: &str) -> usize {
        let mut difference = self.clone();
        difference.count(other, -1);
        let sum = |counts: [i16; KINDS]| {
            counts.iter().map(|count| usize::from(count.max(&0).unsigned_abs())).sum::<usize>()
        };
        sum(difference.0).max(sum(difference.0.map(i16::saturating_neg)))
    }
}

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
    let letters = Letters::of(word);
    let fits = |candidate: &&str| candidate.len() <= LONGEST && letters.slips_to(candidate) <= slips_allowed;
    let near = candidates.take(MOST_CANDIDATES).filter(fits).take(MOST_COMPARED);
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
    fn letters_alone_tell_no_more_slips_than_there_are() {
        let words =
            ["gravity", "gravty", "GRAVITY", "rod.angle", "rod.anlge", "m", "L", "球", "", "Länge", "laenge"];
        for (a, b) in words.iter().flat_map(|a| words.map(|b| (*a, b))) {
            let slips = strsim::damerau_levenshtein(&a.to_lowercase(), &b.to_lowercase());
            assert!(Letters::of(a).slips_to(b) <= slips, "{a} {b}");
        }
        assert_eq!(Letters::of("knowm7x").slips_to("unknown1"), 4);
    }

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
