//! The font of figures, and the widths of its glyphs.
//!
//! Libertinus Serif has true italics, Greek and the signs that figures need. An SVG file names the family and falls back
//! to a serif of the reader's machine; PNG use the font itself. Layout needs widths alone, which are a table of this crate,
//! so that it is the same where no font is.

use std::collections::HashMap;
use std::sync::OnceLock;

/// The family named in SVG files, with fallbacks.
pub const FAMILY: &str = "'Libertinus Serif', 'Linux Libertine O', 'Times New Roman', serif";

/// The font's own name.
pub const EMBEDDED_FAMILY: &str = "Libertinus Serif";

/// Widths of all glyphs: a line a face and run of characters, with the first character's number in hexadecimal and the widths
/// from it on in thousandths of an em.
const WIDTHS: &str = include_str!("../font/widths.txt");

/// Width of a glyph that the font lacks, in em.
const MISSING_GLYPH: f64 = 0.5;

/// Height of capitals and figures above the baseline, in em.
pub const CAP_HEIGHT: f64 = 0.645;

/// Height of ascenders above the baseline, in em.
pub const ASCENT: f64 = 0.73;

/// A face of the family.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Face {
    /// Upright: words, units, numbers.
    #[default]
    Regular,
    /// Italic: symbols of quantities.
    Italic,
    /// Bold: titles and vectors.
    Bold,
}

impl Face {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Regular, Self::Italic, Self::Bold];

    fn name(self) -> &'static str {
        match self {
            Self::Regular => "Regular",
            Self::Italic => "Italic",
            Self::Bold => "Bold",
        }
    }

    fn advance(self, c: char) -> Option<f64> {
        static WIDTHS: OnceLock<HashMap<(Face, char), u16>> = OnceLock::new();
        let width = WIDTHS.get_or_init(widths).get(&(self, c))?;
        Some(f64::from(*width) / 1000.0)
    }
}

fn widths() -> HashMap<(Face, char), u16> {
    WIDTHS.lines().flat_map(run).collect()
}

/// The characters of a line with their widths.
fn run(line: &str) -> Vec<((Face, char), u16)> {
    let mut words = line.split(' ');
    let face = Face::ALL.into_iter().find(|face| words.clone().next() == Some(face.name()));
    let first = words.nth(1).and_then(|number| u32::from_str_radix(number, 16).ok());
    let (Some(face), Some(first)) = (face, first) else { return vec![] };
    let of = |(number, width): (u32, &str)| Some(((face, char::from_u32(number)?), width.parse().ok()?));
    (first..).zip(words).filter_map(of).collect()
}

/// Width of `text` in em. Kerning is left out, which overstates a word by a per cent or two: layout errs on the roomy side.
pub fn width(text: &str, face: Face) -> f64 {
    text.chars().map(|c| face.advance(c).unwrap_or(MISSING_GLYPH)).sum()
}

/// The font's files.
#[cfg(feature = "png")]
mod files {
    use skrifa::string::StringId;
    use skrifa::{FontRef, MetadataProvider};

    use super::{EMBEDDED_FAMILY, Face};

    impl Face {
        /// The file of this face; `None` where the program was built without it.
        pub fn data(self) -> Option<&'static [u8]> {
            typst_assets::fonts().find(|data| FontRef::new(data).is_ok_and(|font| self.names(&font)))
        }

        fn names(self, font: &FontRef<'_>) -> bool {
            let has = |id, name: &str| font.localized_strings(id).any(|s| s.chars().eq(name.chars()));
            has(StringId::FAMILY_NAME, EMBEDDED_FAMILY) && has(StringId::SUBFAMILY_NAME, self.name())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_face_has_the_glyphs_figures_need() {
        for face in Face::ALL {
            for c in "aΩθωαπ0123456789−×·°µ−ΔΣ…–\u{a0}\u{2004}\u{2009}".chars() {
                assert!(face.advance(c).is_some(), "{face:?} lacks {c}");
            }
        }
    }

    #[test]
    fn widths_differ_by_letter_and_face() {
        assert!(width("i", Face::Regular) < width("m", Face::Regular));
        assert!((width("00", Face::Regular) - 2.0 * width("0", Face::Regular)).abs() < 1e-12);
        assert_ne!(width("theta", Face::Italic), width("theta", Face::Bold));
        assert_eq!(width("\u{10ffff}", Face::Regular), MISSING_GLYPH);
    }

    /// `UPDATE_WIDTHS=1 cargo test -p tumble-drawing --features png` writes the table anew.
    #[cfg(feature = "png")]
    #[test]
    fn the_table_is_that_of_the_font() {
        let text: String = Face::ALL.map(table).concat();
        if std::env::var_os("UPDATE_WIDTHS").is_some() {
            std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/font/widths.txt"), &text).expect("writable");
        }
        assert_eq!(text, WIDTHS);
    }

    #[cfg(feature = "png")]
    fn table(face: Face) -> String {
        use skrifa::instance::{LocationRef, Size};
        use skrifa::{FontRef, MetadataProvider};

        let font = FontRef::new(face.data().expect("the font")).expect("a font");
        let glyphs = font.glyph_metrics(Size::new(1000.0), LocationRef::default());
        let mut known: Vec<(u32, f32)> = font
            .charmap()
            .mappings()
            .map(|(number, glyph)| (number, glyphs.advance_width(glyph).expect("a width")))
            .collect();
        known.sort_by_key(|(number, _)| *number);
        let runs = known.chunk_by(|a, b| a.0 + 1 == b.0);
        let line = |run: &[(u32, f32)]| {
            let widths: String = run.iter().map(|(_, width)| format!(" {width}")).collect();
            format!("{} {:x}{widths}\n", face.name(), run[0].0)
        };
        runs.map(line).collect()
    }
}
