//! A font for pages: the mathematics font's glyphs that formulas need, as a data URL.
//!
//! Browsers draw fractions, roots and tall brackets from the measures and glyph variants in a font's MATH table; on a
//! machine without such a font they look wrong. The page therefore carries one: New Computer Modern Math, GUST Font
//! License, reduced to what formulas use and renamed, as that licence asks of derived fonts.

mod base64;
mod cff;
mod math_table;
mod sfnt;
mod subroutines;

use std::collections::BTreeMap;
use std::sync::OnceLock;

use sfnt::Reader;

/// The family of the page's font.
pub const FAMILY: &str = "Tumble Math";

/// How the font of which this one is a part is called in its file.
const SOURCE: &[u8] = b"NewCMMath-Regular";

/// Signs of formulas besides letters and digits, spacing and combining ones included.
const SIGNS: &str =
    "+-−=<>≤≥±·×/|‖()[]{},.:;…′″‴°√∞˙¨\u{302}\u{303}\u{307}\u{308}\u{a0}\u{2009}\u{2061}²³µ∂∑∫";

/// A style sheet's `@font-face` with the font inside, and the rule that formulas use it.
///
/// Empty if the font is not among the program's, so that a page still shows its formulas in what the reader has.
pub fn page_font() -> &'static str {
    static CSS: OnceLock<String> = OnceLock::new();
    CSS.get_or_init(|| font().map_or_else(String::new, |font| css(&font)))
}

fn css(font: &[u8]) -> String {
    let data = base64::encoded(font);
    format!(
        "@font-face {{ font-family: \"{FAMILY}\"; src: url(\"data:font/otf;base64,{data}\") format(\"opentype\"); }}\n\
         math {{ font-family: \"{FAMILY}\", math; }}\n"
    )
}

/// The reduced font file.
fn font() -> Option<Vec<u8>> {
    let source = typst_assets::fonts().find(|data| has(data, SOURCE))?;
    sfnt::reduced(source, FAMILY, &characters())
}

fn has(data: &[u8], name: &[u8]) -> bool {
    let cff = Reader::new(data).table(b"CFF ").unwrap_or(&[]);
    // The name stands near the beginning of this table, behind its header.
    cff.get(..64).is_some_and(|start| start.windows(name.len()).any(|window| window == name))
}

/// Characters of the font: ASCII, Greek, their italics, and signs.
fn characters() -> Vec<char> {
    let mut all: BTreeMap<char, ()> =
        (' '..='~').chain('Α'..='Ω').chain('α'..='ω').map(|c| (c, ())).collect();
    let italics: Vec<char> = all.keys().map(|c| crate::mathml::italic(*c)).collect();
    all.extend(italics.into_iter().chain(SIGNS.chars()).map(|c| (c, ())));
    all.into_keys().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A page has a font, figures and text; the font must stay a small part of two megabytes.
    const LARGEST: usize = 200_000;

    #[test]
    fn the_font_is_small_and_keeps_what_layout_needs() {
        let font = font().expect("the font is among the assets");
        let reader = Reader::new(&font);
        for table in
            [b"CFF ", b"MATH", b"OS/2", b"cmap", b"head", b"hhea", b"hmtx", b"maxp", b"name", b"post"]
        {
            assert!(reader.table(table).is_some_and(|data| !data.is_empty()), "{table:?}");
        }
        println!("{} bytes, {} as CSS", font.len(), page_font().len());
        assert!(page_font().len() < LARGEST);
        assert!(page_font().len() > font.len());
    }

    #[test]
    fn every_character_that_formulas_print_has_a_glyph() {
        let source = typst_assets::fonts().find(|data| has(data, SOURCE)).expect("the font");
        let map = Reader::new(source).characters().expect("a map");
        // Invisible: browsers draw nothing for it.
        let missing: Vec<char> = characters()
            .into_iter()
            .filter(|c| !map.contains_key(c) && *c != '\u{2061}' && *c != 'ς')
            .collect();
        // There is no capital letter at U+03A2.
        assert!(missing.iter().all(|c| *c == '\u{3a2}' || *c == '\u{1d6f3}'), "{missing:?}");
    }

    #[test]
    fn what_is_no_font_gives_no_font() {
        assert!(sfnt::reduced(b"", FAMILY, &['a']).is_none());
        let source = typst_assets::fonts().find(|data| has(data, SOURCE)).expect("the font");
        for length in (0..source.len()).step_by(source.len() / 50) {
            // Any answer but a panic.
            let _ = sfnt::reduced(&source[..length], FAMILY, &['a']);
        }
    }
}
