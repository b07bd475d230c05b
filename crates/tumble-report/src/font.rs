//! The embedded fonts and the widths of their glyphs.
//!
//! Libertinus Serif has true italics, Greek and the signs that figures need.
//! An SVG file names the family and falls back to a serif of the reader's
//! machine; layout and PNG use the embedded fonts alone.

use std::sync::OnceLock;

use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::GlyphMetrics;
use skrifa::raw::TableProvider;
use skrifa::string::StringId;
use skrifa::{FontRef, MetadataProvider};

/// The family named in SVG files, with fallbacks.
pub const FAMILY: &str = "'Libertinus Serif', 'Linux Libertine O', 'Times New Roman', serif";

/// The embedded family.
pub const EMBEDDED_FAMILY: &str = "Libertinus Serif";

/// Width of a glyph that the font lacks, in em.
const MISSING_GLYPH: f64 = 0.5;

/// Height of capitals and figures above the baseline, in em.
pub const CAP_HEIGHT: f64 = 0.645;

/// Depth of descenders below the baseline, in em.
pub const DESCENT: f64 = 0.24;

/// Height of ascenders above the baseline, in em.
pub const ASCENT: f64 = 0.73;

/// A face of the embedded family.
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

const FACES: [Face; 3] = [Face::Regular, Face::Italic, Face::Bold];

impl Face {
    fn subfamily(self) -> &'static str {
        match self {
            Face::Regular => "Regular",
            Face::Italic => "Italic",
            Face::Bold => "Bold",
        }
    }

    /// The font file of this face.
    pub fn data(self) -> Option<&'static [u8]> {
        typst_assets::fonts().find(|data| FontRef::new(data).is_ok_and(|font| self.names(&font)))
    }

    fn names(self, font: &FontRef<'_>) -> bool {
        let has = |id, name: &str| font.localized_strings(id).any(|s| s.chars().eq(name.chars()));
        has(StringId::FAMILY_NAME, EMBEDDED_FAMILY) && has(StringId::SUBFAMILY_NAME, self.subfamily())
    }

    fn metrics(self) -> Option<&'static Metrics> {
        static METRICS: OnceLock<[Option<Metrics>; 3]> = OnceLock::new();
        METRICS.get_or_init(|| FACES.map(Metrics::load))[self as usize].as_ref()
    }
}

struct Metrics {
    font: FontRef<'static>,
    glyphs: GlyphMetrics<'static>,
    units_per_em: f64,
}

impl Metrics {
    fn load(face: Face) -> Option<Self> {
        let font = FontRef::new(face.data()?).ok()?;
        let units_per_em = f64::from(font.head().ok()?.units_per_em());
        let glyphs = font.glyph_metrics(Size::unscaled(), LocationRef::default());
        Some(Self { font, glyphs, units_per_em })
    }

    fn advance(&self, c: char) -> Option<f64> {
        let glyph = self.font.charmap().map(c)?;
        Some(f64::from(self.glyphs.advance_width(glyph)?) / self.units_per_em)
    }
}

/// Width of `text` in em. Kerning is left out, which overstates a word by
/// a per cent or two: layout errs on the roomy side.
pub fn width(text: &str, face: Face) -> f64 {
    let metrics = face.metrics();
    text.chars().map(|c| metrics.and_then(|m| m.advance(c)).unwrap_or(MISSING_GLYPH)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_face_is_embedded_with_the_glyphs_figures_need() {
        for face in FACES {
            let metrics = face.metrics().expect("embedded face");
            for c in "aΩθωαπ0123456789−×·°µ−ΔΣ…–\u{a0}\u{2004}\u{2009}".chars() {
                assert!(metrics.advance(c).is_some(), "{face:?} lacks {c}");
            }
        }
    }

    #[test]
    fn widths_come_from_the_font() {
        assert!(width("i", Face::Regular) < width("m", Face::Regular));
        assert!((width("00", Face::Regular) - 2.0 * width("0", Face::Regular)).abs() < 1e-12);
        assert_ne!(width("theta", Face::Italic), width("theta", Face::Bold));
    }
}
