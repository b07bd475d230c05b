//! Text of scenes, of tables and of command lines as a terminal may show it: nothing in it moves the cursor, changes
//! colours, begins a line or turns the direction of what follows.

use std::borrow::Cow;

/// Whether a terminal or a page obeys a character instead of showing it: controls, and marks of direction.
pub fn is_unseen(c: char) -> bool {
    let marks_direction = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{206f}'
    );
    c.is_control() || marks_direction
}

/// A text in one line, with each character that would be obeyed as its number: `\u{1b}`, `\n`.
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, |_| false)
}

/// The same of a text of several lines, which stay lines.
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c == '\n')
}

/// A formula in one line: between its words it may have any white space.
pub(crate) fn one_line(formula: &str) -> String {
    formula.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn escaped(text: &str, is_kept: fn(char) -> bool) -> Cow<'_, str> {
    let is_obeyed = |c: char| is_unseen(c) && !is_kept(c);
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let shown = |c: char| if is_obeyed(c) { c.escape_default().to_string() } else { c.to_string() };
    Cow::Owned(text.chars().map(shown).collect())
}

/// A source with each character that would be obeyed as its number, and where its bytes have gone.
pub(crate) struct Shown {
    pub(crate) text: String,
    /// Where a character has ended, and by how many bytes its number has moved what follows.
    moved: Vec<(usize, usize)>,
}

impl Shown {
    /// Lines stay lines, whichever way they end, and tabs are drawn as spaces where the source is.
    pub(crate) fn of(source: &str) -> Self {
        let (mut text, mut moved) = (String::with_capacity(source.len()), vec![]);
        for (at, c) in source.char_indices() {
            let ends_line = c == '\n' || source[at..].starts_with("\r\n");
            if !is_unseen(c) || ends_line || c == '\t' {
                text.push(c);
                continue;
            }
            text.extend(c.escape_default());
            let end = at + c.len_utf8();
            moved.push((end, text.len() - end));
        }
        Self { text, moved }
    }

    /// The place of a byte of the source.
    pub(crate) fn place(&self, at: usize) -> usize {
        let passed = self.moved.partition_point(|(end, _)| *end <= at);
        at + passed.checked_sub(1).map_or(0, |last| self.moved[last].1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_obeys_is_shown_as_its_number() {
        assert_eq!(printable("a\u{1b}[2Jb"), "a\\u{1b}[2Jb");
        assert_eq!(printable("a\u{9b}2J\u{7f}\u{202e}b\u{2066}"), "a\\u{9b}2J\\u{7f}\\u{202e}b\\u{2066}");
        assert_eq!(printable("one\r\ntwo\tthree"), "one\\r\\ntwo\\tthree");
        assert_eq!(printable_lines("one\r\ntwo\u{1b}"), "one\\r\ntwo\\u{1b}");
    }

    #[test]
    fn what_is_seen_stays() {
        for text in ["Öse", "摆", "שלום", "a ÷ b", "👩‍🔬", "x\u{a0}y"] {
            assert!(matches!(printable(text), Cow::Borrowed(same) if same == text), "{text}");
        }
    }

    #[test]
    fn places_move_with_the_text() {
        let source = "a\u{1b}\u{202e}b\r\n\tc\rd";
        let shown = Shown::of(source);
        assert_eq!(shown.text, "a\\u{1b}\\u{202e}b\r\n\tc\\rd");
        for letter in ["a", "b", "c", "d"] {
            let at = shown.place(source.find(letter).expect("there"));
            assert!(shown.text[at..].starts_with(letter), "{letter} at {at}");
        }
        assert_eq!(shown.place(source.len()), shown.text.len());
    }
}
