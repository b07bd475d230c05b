//! The word that was probably meant.

use strsim::damerau_levenshtein;

/// The word that differs in upper and lower case only.
pub(super) fn same_letters<'w>(word: &str, words: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    let lower = word.to_lowercase();
    words.into_iter().find(|known| known.to_lowercase() == lower)
}

/// Letters; longer words are not slips of a name.
const LONGEST: usize = 100;
/// Only so many words are looked at.
const MOST_WORDS: usize = 20_000;
/// Of those that have nearly the same letters only so many are compared: the time is the product of both lengths.
const MOST_COMPARED: usize = 500;

/// Letters are told apart by this many of their bits: enough for a bound.
const KINDS: usize = 64;

/// How often a word has each letter, upper and lower case alike. Two words are at least as many slips apart as letters of the
/// one are not in the other, which is soon counted.
#[derive(Clone, Debug)]
struct Letters([i16; KINDS]);

impl Letters {
    /// Those of a word.
    fn of(word: &str) -> Self {
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
    fn slips_to(&self, other: &str) -> usize {
        let mut difference = self.clone();
        difference.count(other, -1);
        let sum = |counts: [i16; KINDS]| {
            counts.iter().map(|count| usize::from(count.max(&0).unsigned_abs())).sum::<usize>()
        };
        sum(difference.0).max(sum(difference.0.map(i16::saturating_neg)))
    }
}

/// The word fewest slips of the keyboard away, if they are so few that no other can be meant: a slip rarely is that of the first
/// letter, and `wind` is not `find`. One of upper and lower case is none.
pub fn nearest<'w>(word: &str, words: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    let length = word.chars().count();
    let allowed = match length {
        0..=5 => 1,
        6..=11 => 2,
        _ => 3,
    };
    if length > LONGEST {
        return None;
    }
    let letters = Letters::of(word);
    let fits = |known: &&str| {
        known.len() <= 2 * LONGEST && begins_like(word, known) && letters.slips_to(known) <= allowed
    };
    let near = words.into_iter().take(MOST_WORDS).filter(fits).take(MOST_COMPARED);
    let folded = word.to_lowercase();
    // Of words as near the one is meant that has more capitals in common.
    let slips = |known: &str| match is_reordered(&folded, known) {
        true => 0,
        false => damerau_levenshtein(&folded, known),
    };
    let scored = near.map(|known| (slips(&known.to_lowercase()), damerau_levenshtein(word, known), known));
    let (least, _, best) = scored.min_by_key(|(least, exact, _)| (*least, *exact))?;
    (least <= allowed).then_some(best)
}

/// Whether two names have the same parts, `c.red.white` and `c.white.red`.
fn is_reordered(one: &str, other: &str) -> bool {
    let parts = |name: &str| {
        let mut parts: Vec<String> = name.split('.').map(str::to_owned).collect();
        parts.sort_unstable();
        parts
    };
    one.len() == other.len() && parts(one) == parts(other)
}

fn begins_like(word: &str, known: &str) -> bool {
    let first = |word: &str| word.chars().next().map(|letter| letter.to_lowercase().to_string());
    first(word) == first(known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_alone_tell_no_more_slips_than_there_are() {
        let words =
            ["gravity", "gravty", "GRAVITY", "rod.angle", "rod.anlge", "m", "L", "球", "", "Länge", "laenge"];
        for (a, b) in words.iter().flat_map(|a| words.map(|b| (*a, b))) {
            let slips = damerau_levenshtein(&a.to_lowercase(), &b.to_lowercase());
            assert!(Letters::of(a).slips_to(b) <= slips, "{a} {b}");
        }
        assert_eq!(Letters::of("knowm7x").slips_to("unknown1"), 4);
    }

    #[test]
    fn few_slips_are_forgiven() {
        let names = ["gravity", "rod.angle", "m", "L"];
        let nearest = |word| nearest(word, names);
        assert_eq!(nearest("gravty"), Some("gravity"));
        assert_eq!(nearest("rod.anlge"), Some("rod.angle"));
        assert_eq!(nearest("M"), Some("m"));
        assert_eq!(super::nearest("c.white.red.gap", ["c.red.white.gap"]), Some("c.red.white.gap"));
        assert_eq!(super::nearest("TT", ["t", "T"]), Some("T"));
        assert_eq!(nearest("x"), None);
        assert_eq!(nearest("trod.angle"), None, "the first letter is rarely a slip");
        assert_eq!(nearest("temperature"), None);
    }
}
