//! Characters that look like those of a formula but are others, and what to write instead.

use super::error::{Code, FormulaError, Span};

/// (character, its name, what to write)
const SIGNS: &[(char, &str, &str)] = &[
    ('\u{2212}', "minus sign", "-"),
    ('\u{2010}', "hyphen", "-"),
    ('\u{2011}', "non-breaking hyphen", "-"),
    ('\u{2012}', "figure dash", "-"),
    ('\u{2013}', "en dash", "-"),
    ('\u{2014}', "em dash", "-"),
    ('\u{2015}', "horizontal bar", "-"),
    ('\u{fe63}', "small hyphen-minus", "-"),
    ('\u{ad}', "soft hyphen", ""),
    ('\u{00d7}', "multiplication sign", "*"),
    ('\u{00b7}', "middle dot", "*"),
    ('\u{22c5}', "dot operator", "*"),
    ('\u{2219}', "bullet operator", "*"),
    ('\u{2022}', "bullet", "*"),
    ('\u{2217}', "asterisk operator", "*"),
    ('\u{00f7}', "division sign", "/"),
    ('\u{2215}', "division slash", "/"),
    ('\u{2044}', "fraction slash", "/"),
    ('\u{221a}', "square root", "sqrt(...)"),
    ('\u{00b0}', "degree sign", "deg"),
    ('\u{00ba}', "ordinal indicator", "deg"),
    ('\u{00bc}', "fraction one quarter", "0.25"),
    ('\u{00bd}', "fraction one half", "0.5"),
    ('\u{00be}', "fraction three quarters", "0.75"),
    ('\u{066b}', "Arabic decimal separator", "."),
    ('\u{2236}', "ratio", "/"),
    ('\u{2260}', "not equal to", "< or >"),
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
const LOOK_ALIKES: &[(&str, &str)] = &[
    ("аеорсухіјѕкһԁԛԝАВЕКМНОРСТУХІЈЅ", "aeopcyxijskhdqwABEKMHOPCTYXIJS"),
    ("ΑΒΕΖΗΙΚΜΝΟΡΤΥΧο", "ABEZHIKMNOPTYXo"),
];

/// Digits and signs of exponents.
const SUPERSCRIPTS: (&str, &str) = ("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻", "0123456789+-");

/// The zeros of other scripts; the nine digits follow each.
const ZEROS: &[char] = &[
    '\u{0660}',
    '\u{06f0}',
    '\u{07c0}',
    '\u{0966}',
    '\u{09e6}',
    '\u{0a66}',
    '\u{0ae6}',
    '\u{0b66}',
    '\u{0be6}',
    '\u{0c66}',
    '\u{0ce6}',
    '\u{0d66}',
    '\u{0e50}',
    '\u{0ed0}',
    '\u{0f20}',
    '\u{1040}',
    '\u{17e0}',
    '\u{1810}',
    '\u{2080}',
    '\u{1d7ce}',
    '\u{1d7d8}',
    '\u{1d7e2}',
    '\u{1d7ec}',
    '\u{1d7f6}',
];

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

/// The first letter of a word that only looks like a Latin one, or is Cyrillic, with its number and alphabet.
pub(super) fn foreign_letter(word: &str) -> Option<String> {
    let foreign = word.chars().find(|c| latin(*c).is_some() || is_cyrillic(*c))?;
    Some(named(foreign.encode_utf8(&mut [0; 4])))
}

/// What to write instead of a character that is foreign to formulas, where that is known.
fn cure(c: char) -> Option<String> {
    ascii_form(c).map(String::from).or_else(|| sign(c).map(|(_, cure)| cure.to_owned()))
}

/// What to write instead of a run of foreign characters.
fn cure_of_run(run: &str) -> Option<String> {
    let exponent: Option<String> = run.chars().map(raised).collect();
    exponent.map(|exponent| format!("^{exponent}")).or_else(|| run.chars().map(cure).collect())
}

/// The mistake of a run of characters that no formula is written with.
pub(super) fn foreign(text: &str, span: Span) -> FormulaError {
    let run = &text[span.clone()];
    let error = FormulaError::new(Code::Character, span, format!("{} cannot stand in a formula", named(run)));
    let error = error.label("this character");
    match cure_of_run(run).as_deref() {
        None if run == "\u{221e}" => error.help("formulas are computed with finite numbers"),
        Some("") => error.help("remove it"),
        Some(" ") => error.help("write an ordinary space"),
        Some(cure) => error.help(format!("write `{cure}`")),
        None => error,
    }
}

/// The end of the run of foreign characters that have a cure and begin at `start`; one character at least.
pub(super) fn foreign_run(text: &str, start: usize) -> usize {
    let rest = &text[start..];
    let first = rest.chars().next().map_or(0, char::len_utf8);
    let run_of = |alike: fn(char) -> bool| rest.find(|c| !alike(c)).unwrap_or(rest.len());
    let alike = run_of(|c| ascii_form(c).is_some()).max(run_of(|c| raised(c).is_some()));
    start + alike.max(first)
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
        (Some(c), _) => format!("`{run}` (from U+{:04X} on{})", u32::from(c), kind(c)),
        _ => String::new(),
    }
}

fn visible(c: char) -> String {
    let invisible = c.is_control() || c.is_whitespace() || matches!(c, '\u{200b}'..='\u{200f}' | '\u{feff}');
    if invisible { "an invisible character".to_owned() } else { format!("`{c}`") }
}

fn kind(c: char) -> String {
    match (sign(c), ascii_form(c)) {
        (Some((name, _)), _) => format!(", {name}"),
        (_, Some(digit)) if digit.is_ascii_digit() => ", another form of a digit".to_owned(),
        (_, Some(_)) => ", another form of an ASCII character".to_owned(),
        _ if raised(c).is_some() => ", superscript".to_owned(),
        _ if is_cyrillic(c) => ", Cyrillic".to_owned(),
        _ if latin(c).is_some() => ", Greek".to_owned(),
        _ => String::new(),
    }
}

fn sign(c: char) -> Option<(&'static str, &'static str)> {
    SIGNS.iter().find(|(sign, ..)| *sign == c).map(|(_, name, cure)| (*name, *cure))
}

fn latin(c: char) -> Option<char> {
    LOOK_ALIKES.iter().find_map(|pair| paired(*pair, c))
}

/// The digit or sign that a superscript raises.
fn raised(c: char) -> Option<char> {
    paired(SUPERSCRIPTS, c)
}

fn paired((from, to): (&str, &str), c: char) -> Option<char> {
    // Most text is ASCII, and nothing of that is paired.
    if c.is_ascii() {
        return None;
    }
    let at = from.chars().position(|other| other == c)?;
    to.chars().nth(at)
}

fn is_cyrillic(c: char) -> bool {
    matches!(c, '\u{0400}'..='\u{052f}')
}

/// The ASCII character of which this one is the full-width form or, of letters, a mathematical style, or the digit of
/// another script.
fn ascii_form(c: char) -> Option<char> {
    let digit = |zero: &char| u32::from(c).checked_sub(u32::from(*zero)).filter(|digit| *digit < 10);
    if let Some(digit) = ZEROS.iter().find_map(digit) {
        return char::from_digit(digit, 10);
    }
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
    fn zeros_begin_ten_digits() {
        assert_eq!(SUPERSCRIPTS.0.chars().count(), SUPERSCRIPTS.1.len());
        for zero in ZEROS {
            let digits = (0..10).filter_map(|digit| char::from_u32(u32::from(*zero) + digit));
            let plain: String = digits.filter_map(ascii_form).collect();
            assert_eq!(plain, "0123456789", "U+{:04X}", u32::from(*zero));
            assert!(zero.is_numeric(), "U+{:04X}", u32::from(*zero));
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
