//! Pictures from drawings, by the embedded fonts alone: equal drawings give
//! equal bytes on every machine.

use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Source};
use resvg::usvg::{Options, Tree};

use crate::font::{EMBEDDED_FAMILY, Face};
use crate::svg::Svg;

/// Largest side of a picture in pixels: 1 GB at four bytes a pixel.
const LARGEST_SIDE: f64 = 16_384.0;

/// Why a picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The drawing is no SVG that the rasteriser reads.
    #[error("the drawing cannot be read: {0}")]
    Drawing(#[from] resvg::usvg::Error),
    /// The picture would be empty or too large.
    #[error("a picture of {width} by {height} pixels cannot be made")]
    Size {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// The picture could not be compressed.
    #[error("the picture cannot be encoded: {0}")]
    Encoding(String),
}

/// The bytes of a PNG file with `scale` pixels for each pixel of the drawing.
pub fn png(svg: &Svg, scale: f64) -> Result<Vec<u8>, PngError> {
    drawn(svg, scale)?.encode_png().map_err(|error| PngError::Encoding(error.to_string()))
}

/// The pixels of a drawing that covers its page.
pub(crate) fn drawn(svg: &Svg, scale: f64) -> Result<Pixmap, PngError> {
    let tree = tree(svg)?;
    let mut pixmap = pixmap(svg.width * scale, svg.height * scale)?;
    let scale = scale as f32;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// The drawing as the rasteriser reads it. It shapes the runs of a label as one, and an f would join the first letter of its index.
fn tree(svg: &Svg) -> Result<Tree, PngError> {
    let text = svg.to_string().replace("f</tspan><tspan", "f\u{200c}</tspan><tspan");
    Ok(Tree::from_str(&text, &options())?)
}

fn pixmap(width: f64, height: f64) -> Result<Pixmap, PngError> {
    let side = |length: f64| (0.0..=LARGEST_SIDE).contains(&length).then_some(length.ceil() as u32);
    let pixmap = side(width).zip(side(height)).and_then(|(w, h)| Pixmap::new(w, h));
    pixmap.ok_or(PngError::Size { width, height })
}

fn options() -> Options<'static> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    let fontdb = FONTS.get_or_init(|| Arc::new(fonts())).clone();
    Options { fontdb, font_family: EMBEDDED_FAMILY.to_owned(), ..Options::default() }
}

fn fonts() -> Database {
    let mut fonts = Database::new();
    for data in Face::ALL.into_iter().filter_map(Face::data) {
        fonts.load_font_source(Source::Binary(Arc::new(data)));
    }
    fonts.set_serif_family(EMBEDDED_FAMILY);
    fonts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::{Label, PlacedText, TextAnchor};

    fn drawing(label: &Label) -> Svg {
        let mut svg = Svg::new(400.0, 40.0, "");
        svg.push(PlacedText::new(label, [20.0, 25.0], 20.0, TextAnchor::Start).element());
        svg
    }

    #[test]
    fn equal_drawings_give_equal_bytes() {
        let svg = drawing(&Label::equation("omega0", "-3", "rad/s"));
        let first = png(&svg, 1.0).expect("a picture");
        assert_eq!(first, png(&svg, 1.0).expect("a picture"));
        assert!(first.starts_with(b"\x89PNG"));
    }

    #[test]
    fn measured_widths_agree_with_drawn_ones() {
        for text in ["Wind $w1$ in metres a second, $omega0$", "$f_f$"] {
            let label = Label::markup(text);
            let tree = tree(&drawing(&label)).expect("a drawing");
            let drawn = f64::from(tree.root().abs_bounding_box().width());
            let measured = label.width(20.0);
            assert!((drawn / measured - 1.0).abs() < 0.03, "{text}: {drawn} {measured}");
        }
    }

    #[test]
    fn hostile_labels_are_drawn() {
        let svg = drawing(&Label::plain("]]> <!-- & \u{0}\u{1}\u{FFFF} \"'"));
        assert!(png(&svg, 1.0).is_ok());
    }

    #[test]
    fn impossible_sizes_are_refused() {
        for scale in [0.0, -1.0, f64::NAN, 1e9] {
            assert!(matches!(png(&drawing(&Label::plain("a")), scale), Err(PngError::Size { .. })));
        }
    }
}
