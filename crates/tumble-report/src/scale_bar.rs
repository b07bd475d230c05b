//! The bar that tells how long a metre is on the page.

use crate::numeral::round_decimal;
use crate::svg::{Element, PathData};
use crate::text::{Anchor, Label, PlacedText};
use crate::theme::{GAP, INK, LEADING, SMALL};

/// Height of the bar with its label, in pixels.
pub const HEIGHT: f64 = 2.0 * GAP + SMALL * LEADING;

/// Greatest length of the bar in pixels; the least is a bit less than half of it.
const LONGEST: f64 = 150.0;
/// Half the height of the strokes at its ends.
const END: f64 = 4.0;
/// Lengths beyond this power of ten are not written out.
const LARGEST_EXPONENT: f64 = 300.0;
/// Thickness of the bar.
const THICKNESS: f64 = 1.4;

/// A bar of round length whose right end is at `right_end` (`[x, y]`, pixels),
/// for `density` pixels per unit.
pub fn draw(right_end: [f64; 2], density: f64, unit: &str) -> Element {
    let (mantissa, exponent) = round_length(LONGEST / density);
    let length = mantissa as f64 * 10f64.powi(exponent) * density;
    let [right, y] = [right_end[0], right_end[1] + END];
    let left = right - length;
    let mut path = PathData::polyline(&[[left, y], [right, y]]);
    path.add_polyline(&[[left, y - END], [left, y + END]]);
    path.add_polyline(&[[right, y - END], [right, y + END]]);
    let bar = path.stroke().attr("stroke", INK).attr("stroke-width", THICKNESS);
    let label = Label::quantity(&round_decimal(mantissa, exponent), unit);
    let at = [left + length / 2.0, y + END + SMALL];
    Element::new("g").child(bar).child(PlacedText::new(&label, at, SMALL, Anchor::Middle).element())
}

/// The longest of 1, 2, 5 times a power of ten that is at most `longest`.
fn round_length(longest: f64) -> (i64, i32) {
    let exponent = longest.log10().floor().clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT) as i32;
    let part = longest / 10f64.powi(exponent);
    let mantissa = [5, 2, 1].into_iter().find(|m| *m as f64 <= part).unwrap_or(1);
    (mantissa, exponent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_round() {
        assert_eq!(round_length(7.3), (5, 0));
        assert_eq!(round_length(0.29), (2, -1));
        assert_eq!(round_length(1500.0), (1, 3));
    }

    #[test]
    fn the_label_names_the_length() {
        assert!(draw([100.0, 10.0], 100.0, "m").to_string().contains("1\u{a0}m"));
    }
}
