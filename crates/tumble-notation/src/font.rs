//! A font for pages: the mathematics font's glyphs that formulas need, as a data URL.
//!
//! Browsers draw fractions, roots and tall brackets from the measures and glyph variants in a font's MATH table; on a
//! machine without such a font they look wrong. The page therefore carries one: New Computer Modern Math, GUST Font
//! License, reduced to what formulas use and renamed, as that licence asks of derived fonts (`font/subset.py`).

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// The family of the page's font.
pub const FAMILY: &str = "Tumble Math";

const FONT: &[u8] = include_bytes!("../font/tumble-math.woff2");

/// A style sheet's `@font-face` with the font inside, and the rule that formulas use it.
pub fn page_font() -> String {
    let data = STANDARD.encode(FONT);
    format!(
        "@font-face {{ font-family: \"{FAMILY}\"; src: url(\"data:font/woff2;base64,{data}\") format(\"woff2\"); }}\n\
         math {{ font-family: \"{FAMILY}\", math; }}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the font was made for.
    const CHARACTERS: &str = include_str!("../font/characters.txt");
    /// A page has a font, figures and text; the font must stay a small part of two megabytes.
    const LARGEST: usize = 120_000;

    #[test]
    fn the_font_is_small() {
        assert!(page_font().len() < LARGEST, "{}", page_font().len());
    }

    #[test]
    fn letters_that_formulas_print_are_in_the_font() {
        let plain = (' '..='~').chain('Α'..='Ρ').chain('Σ'..='Ω').chain('α'..='ρ').chain('σ'..='ω');
        let italic = plain.clone().map(crate::mathml::italic);
        let missing: Vec<char> = plain.chain(italic).filter(|c| !CHARACTERS.contains(*c)).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}
