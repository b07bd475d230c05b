//! Characters that look like those of a formula but are others, and what to write instead.

use super::error::{Code, FormulaError, Span};

/// (character, its name, what to write)
const SIGNS: &[(char, &str, &str)] = &[
    ('\u{2212}', "minus sign", "-"),
    ('\u{2010}', "hyphen", "-"),
    ('\u{2011}', "non-breaking hyphen", "-"),
    ('\u{2013}', "en dash", "-"),
    ('\u{2014}', "em dash", "-"),
    ('\u{00d7}', "multiplication sign", "*"),
    ('\u{00b7}', "middle dot", "*"),
    ('\u{22c5}', "dot operator", "*"),
    ('\u{2219}', "bullet operator", "*"),
    ('\u{2022}', "bullet", "*"),
    ('\u{2217}', "asterisk operator", "*"),
    ('\u{00f7}', "division sign", "/"),
    ('\u{2215}', "division slash", "/"),
    ('\u{2044}', "fraction slash", "/"),
    ('\u{00b9}', "superscript one", "^1"),
    ('\u{00b2}', "superscript two", "^2"),
    ('\u{00b3}', "superscript three", "^3"),
    ('\u{207b}', "superscript minus", "^-"),
    ('\u{221a}', "square root", "sqrt(...)"),
    ('\u{00b0}', "degree sign", "deg"),
    ('\u{2264}', "less-than or equal sign", "<="),
    ('\u{2265}', "greater-than or equal sign", ">="),
    ('\u{2030}', "per mille sign", "*0.001"),
    ('\u{00b5}', "micro sign", "u"),
    ('\u{2126}', "ohm sign", "\u{03a9}"),
    ('\u{00a0}', "no-break space", " "),
    ('\u{202f}', "narrow no-break space", " "),
    ('\u{2009}', "thin space", " "),
    ('\u{3000}', "ideographic space", " "),
    ('\u{2018}', "quotation mark", ""),
    ('\u{2019}', "quotation mark", ""),
    ('\u{201c}', "quotation mark", ""),
    ('\u{201d}', "quotation mark", ""),
    ('\u{200b}', "zero-width space", ""),
    ('\u{200d}', "zero-width joiner", ""),
    ('\u{feff}', "byte order mark", ""),
    ('{', "brace", "("),
    ('}', "brace", ")"),
];

/// Letters of other alphabets that look like a Latin one.
const LOOK_ALIKES: &[(&str, &str)] =
    &[("аеорсухіјѕкАВЕКМНОРСТУХІЈЅ", "aeopcyxijskABEKMHOPCTYXIJS"), ("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧο", "ABEZHIKMNOPTYXo")];

/// Whether a name or a unit may begin with it.
pub(super) fn begins_word(c: char) -> bool {
    (c.is_alphabetic() || c == '_') && ascii_form(c).is_none() && sign(c).is_none()
}

/// Whether a name or a unit may go on with it.
pub(super) fn continues_word(c: char) -> bool {
    begins_word(c) || c.is_ascii_digit()
}

/// Whether white space may be written with it.
pub(super) fn is_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r')
}

/// The name with every look-alike letter replaced by the Latin one.
pub(super) fn skeleton(name: &str) -> String {
    name.chars().map(|c| latin(c).unwrap_or(c)).collect()
}

/// What to write instead of a character that is foreign to formulas, where that is known.
fn cure(c: char) -> Option<String> {
    ascii_form(c).map(String::from).or_else(|| sign(c).map(|(_, cure)| cure.to_owned()))
}

/// The mistake of a run of characters that no formula is written with.
pub(super) fn foreign(text: &str, span: Span) -> FormulaError {
    let run = &text[span.clone()];
    let cures: Option<String> = run.chars().map(cure).collect();
    let error = FormulaError::new(Code::Character, span, format!("{} cannot stand in a formula", named(run)));
    let error = error.label("this character");
    match cures.as_deref() {
        Some("") => error.help("remove it"),
        Some(" ") => error.help("write an ordinary space"),
        Some(cure) => error.help(format!("write `{cure}`")),
        None => error,
    }
}

/// The end of the run of foreign characters that have a cure and begin at `start`; one character at least.
pub(super) fn foreign_run(text: &str, start: usize) -> usize {
    let mut rest = text[start..].char_indices();
    let first = rest.next().map_or(0, |(_, c)| c.len_utf8());
    let full_width = |c: char| ascii_form(c).is_some();
    if !text[start..].starts_with(full_width) {
        return start + first;
    }
    let end = text[start..].find(|c| !full_width(c)).unwrap_or(text.len() - start);
    start + end
}

/// The mistake of a name that mixes look-alike letters of two alphabets, if it does.
pub(super) fn mixed_alphabets(name: &str, start: usize) -> Option<FormulaError> {
    if !name.contains(|c: char| c.is_ascii_alphabetic()) {
        return None;
    }
    let foreign = |c: char| latin(c).is_some() || is_cyrillic(c);
    let (at, c) = name.char_indices().find(|(_, c)| foreign(*c))?;
    let span = start + at..start + at + c.len_utf8();
    let message = format!("the name `{name}` mixes Latin letters with {}", named(c.encode_utf8(&mut [0; 4])));
    let error = FormulaError::new(Code::Character, span, message).label("this letter");
    Some(match latin(c) {
        Some(plain) => error.help(format!("it looks like the Latin `{plain}`: write `{}`", skeleton(name))),
        None => error.help("write the name in one alphabet"),
    })
}

fn named(run: &str) -> String {
    let mut characters = run.chars();
    match (characters.next(), characters.next()) {
        (Some(c), None) => format!("{} (U+{:04X}{})", visible(c), u32::from(c), kind(c)),
        _ => format!("`{run}` (full-width characters)"),
    }
}

fn visible(c: char) -> String {
    let invisible = c.is_control() || c.is_whitespace() || matches!(c, '\u{200b}'..='\u{200f}' | '\u{feff}');
    if invisible { "an invisible character".to_owned() } else { format!("`{c}`") }
}

fn kind(c: char) -> String {
    match (sign(c), ascii_form(c)) {
        (Some((name, _)), _) => format!(", {name}"),
        (_, Some(_)) => ", another form of an ASCII character".to_owned(),
        _ if is_cyrillic(c) => ", Cyrillic".to_owned(),
        _ if latin(c).is_some() => ", Greek".to_owned(),
        _ => String::new(),
    }
}

fn sign(c: char) -> Option<(&'static str, &'static str)> {
    SIGNS.iter().find(|(sign, ..)| *sign == c).map(|(_, name, cure)| (*name, *cure))
}

fn latin(c: char) -> Option<char> {
    LOOK_ALIKES.iter().find_map(|(from, to)| {
        let at = from.chars().position(|other| other == c)?;
        to.chars().nth(at)
    })
}

fn is_cyrillic(c: char) -> bool {
    matches!(c, '\u{0400}'..='\u{052f}')
}

/// The ASCII character of which this one is the full-width form or, of letters, a mathematical style.
fn ascii_form(c: char) -> Option<char> {
    match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(c) - 0xfee0),
        '\u{1d400}'..='\u{1d6a3}' => {
            let letter = u8::try_from((u32::from(c) - 0x1d400) % 52).ok()?;
            Some(char::from(if letter < 26 { b'A' + letter } else { b'a' + letter - 26 }))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn look_alike_tables_are_paired() {
        for (from, to) in LOOK_ALIKES {
            assert_eq!(from.chars().count(), to.chars().count());
            assert!(from.chars().all(|c| !c.is_ascii()) && to.is_ascii());
        }
    }

    #[test]
    fn styled_letters_have_a_plain_form() {
        assert_eq!(ascii_form('\u{1d465}'), Some('x'));
        assert_eq!(ascii_form('\u{ff11}'), Some('1'));
        assert!(begins_word('θ') && begins_word('_') && !begins_word('\u{b5}'));
    }

    #[test]
    fn greek_and_latin_mix_unless_they_look_alike() {
        assert_eq!(mixed_alphabets("ωmax", 0), None);
        assert_eq!(mixed_alphabets("масса", 0), None);
        assert!(mixed_alphabets("mаss", 0).is_some(), "the second letter is Cyrillic");
        assert!(mixed_alphabets("Αx", 0).is_some(), "the first letter is Greek");
    }
}
