//! The bar that tells how long a metre is on the page.

use crate::svg::{Element, PathData};
use crate::text::{Label, PlacedText, TextAnchor};
use crate::theme::{INK, SMALL};
use tumble_notation::numeral::round_decimal;

/// Greatest length of the bar in pixels; the least is a bit less than half of it.
const LONGEST: f64 = 150.0;
/// Half the height of the strokes at its ends.
const END: f64 = 4.0;
/// Lengths beyond this power of ten are not written out.
const LARGEST_EXPONENT: f64 = 300.0;
/// Powers of ten that are written out; others get a factor.
const WRITTEN_OUT: std::ops::Range<i32> = -4..7;
/// Thickness of the bar.
const THICKNESS: f64 = 1.4;

/// A bar of round length whose right end is at `right_end` (`[x, y]`, pixels),
/// for `density` pixels per unit.
pub fn draw(right_end: [f64; 2], density: f64, unit: &str) -> Element {
    let bar = Bar::new(LONGEST, density, unit);
    let [right, y] = [right_end[0], right_end[1] + END];
    let left = right - bar.length;
    let at = [left + bar.length / 2.0, y + END + SMALL];
    let label = PlacedText::new(&bar.label, at, SMALL, TextAnchor::Middle).element();
    Element::new("g").child(bar.draw([left, y])).child(label)
}

/// A bar of round length.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Its length in pixels.
    pub length: f64,
    /// What it stands for, with the unit.
    pub label: Label,
}

impl Bar {
    /// The longest bar of at most `longest` pixels that stands for 1, 2 or 5
    /// times a power of ten, for `density` pixels per unit.
    pub fn new(longest: f64, density: f64, unit: &str) -> Self {
        let (mantissa, exponent) = round_length(longest / density);
        let length = mantissa as f64 * 10f64.powi(exponent) * density;
        let label = if WRITTEN_OUT.contains(&exponent) {
            Label::quantity(&round_decimal(mantissa, exponent), unit)
        } else {
            Label::plain(&mantissa.to_string()).then(Label::power_of_ten(exponent)).in_unit(unit)
        };
        Self { length, label }
    }

    /// The bar without its label, from `left` (`[x, y]`, pixels) to the right.
    pub fn draw(&self, [left, y]: [f64; 2]) -> Element {
        let right = left + self.length;
        let mut path = PathData::polyline(&[[left, y], [right, y]]);
        path.add_polyline(&[[left, y - END], [left, y + END]]);
        path.add_polyline(&[[right, y - END], [right, y + END]]);
        path.stroke(INK, THICKNESS)
    }
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
