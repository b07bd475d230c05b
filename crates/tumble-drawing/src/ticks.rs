//! Where an axis has its ticks and what they say.
//!
//! Decimal ticks stand at multiples of 1, 2 or 5 times a power of ten. They
//! are kept as integers times that power, so labels are exact decimals. Very
//! small, very large or nearly equal values share a common factor or offset
//! that is written once, at the end of the axis.

use std::ops::RangeInclusive;

use crate::scale::Range;
use crate::text::Label;
use crate::units::MINUS;
use tumble_notation::numeral::{decimal, round_decimal};

/// Fewest and most labelled ticks of an axis.
const COUNTS: RangeInclusive<usize> = 3..=10;

/// Steps as parts of a power of ten, with the number of minor steps in each.
const MANTISSAS: [(i64, u32); 3] = [(1, 5), (2, 4), (5, 5)];

/// A tick this many steps outside the range still counts as its end.
const SLACK: f64 = 1e-9;

/// Values from this power of ten on are written with a common factor.
const LARGE_EXPONENT: i32 = 5;
/// Values below this power of ten are written with a common factor.
const SMALL_EXPONENT: i32 = -2;

/// Ticks of this many steps from zero are written with a common offset.
const FAR_STEPS: i64 = 1_000_000;

/// A labelled tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where it stands, in the axis's unit.
    pub value: f64,
    /// What it says.
    pub label: Label,
}

/// The ticks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ticks {
    /// Labelled ticks in increasing order.
    pub major: Vec<Tick>,
    /// Values of the ticks between them.
    pub minor: Vec<f64>,
    /// Common factor and offset of all labels, for instance `×10⁻³`; mostly empty.
    pub note: Label,
}

impl Ticks {
    /// Ticks for a range that is not constant, about `wanted` labelled ones and
    /// always between 3 and 10.
    pub fn new(range: Range, wanted: usize) -> Self {
        let top = range.span().log10().floor() as i32;
        let all =
            (top - 2..=top).flat_map(|exponent| MANTISSAS.map(|choice| Steps::of(choice, exponent, range)));
        let best = all.flatten().min_by_key(|steps| steps.count().abs_diff(wanted));
        best.map_or_else(Ticks::default, |steps| steps.ticks(range))
    }

    /// Widest label in pixels at text size `size`.
    pub fn label_width(&self, size: f64) -> f64 {
        self.major.iter().map(|tick| tick.label.width(size)).fold(0.0, f64::max)
    }
}

/// Ticks at the multiples `first..=last` of `mantissa` times ten to the `exponent`.
#[derive(Clone, Copy, Debug)]
struct Steps {
    mantissa: i64,
    exponent: i32,
    minor: u32,
    first: i64,
    last: i64,
}

impl Steps {
    /// Those in the range, if they are exact integers and neither few nor many.
    fn of((mantissa, minor): (i64, u32), exponent: i32, range: Range) -> Option<Self> {
        const EXACT: f64 = 4e15;
        let mut steps = Self { mantissa, exponent, minor, first: 0, last: 0 };
        let first = (range.low / steps.step() - SLACK).ceil();
        let last = (range.high / steps.step() + SLACK).floor();
        if first.abs().max(last.abs()) * mantissa as f64 > EXACT {
            return None;
        }
        (steps.first, steps.last) = (first as i64, last as i64);
        COUNTS.contains(&steps.count()).then_some(steps)
    }

    fn step(&self) -> f64 {
        10f64.powi(self.exponent) * self.mantissa as f64
    }

    fn count(&self) -> usize {
        usize::try_from(self.last - self.first + 1).unwrap_or(0)
    }

    /// The value of multiple `k`. Division by a positive power of ten is
    /// correctly rounded where multiplication by a negative one is not.
    fn value(&self, k: i64, range: Range) -> f64 {
        let n = (k * self.mantissa) as f64;
        let value = match self.exponent {
            -22..0 => n / 10f64.powi(-self.exponent),
            _ => n * 10f64.powi(self.exponent),
        };
        value.clamp(range.low, range.high)
    }

    fn minor_values(&self, range: Range) -> Vec<f64> {
        let step = self.step() / f64::from(self.minor);
        let (parts, all) = (i64::from(self.minor), (self.first - 1) * i64::from(self.minor));
        let between = (all..(self.last + 1) * parts).filter(|k| k % parts != 0);
        between.map(|k| k as f64 * step).filter(|v| range.contains(*v)).collect()
    }

    fn ticks(&self, range: Range) -> Ticks {
        let (first, last) = (self.first * self.mantissa, self.last * self.mantissa);
        let offset = common_offset(first, last);
        let largest = (first - offset).abs().max((last - offset).abs());
        let factor = common_exponent(largest, self.exponent);
        let label = |n: i64| Label::plain(&decimal(n - offset, self.exponent - factor));
        let tick = |k| Tick { value: self.value(k, range), label: label(k * self.mantissa) };
        Ticks {
            major: (self.first..=self.last).map(tick).collect(),
            minor: self.minor_values(range),
            note: note(factor, offset, self.exponent),
        }
    }
}

/// What to subtract from ticks far from zero, a round number, else 0.
fn common_offset(first: i64, last: i64) -> i64 {
    let span = last - first;
    if first.abs().max(last.abs()) < FAR_STEPS.max(span.saturating_mul(1000)) {
        return 0;
    }
    // The roundest number inside the ticks, else one a little outside.
    let nearest = |round: i64| (first + span / 2 + round / 2).div_euclid(round) * round;
    let rounds = (0..=span.ilog10() + 2).rev().map(|e| nearest(10i64.pow(e)));
    let mut inside = rounds.filter(|offset| (first..=last).contains(offset));
    inside.next().unwrap_or(first)
}

/// The power of ten taken out of labels whose largest is `largest` times ten to `exponent`.
fn common_exponent(largest: i64, exponent: i32) -> i32 {
    let leading = largest.max(1).ilog10() as i32 + exponent;
    if (SMALL_EXPONENT..LARGE_EXPONENT).contains(&leading) { 0 } else { leading }
}

fn note(factor: i32, offset: i64, exponent: i32) -> Label {
    let factor = if factor == 0 { Label::default() } else { Label::power_of_ten(factor) };
    if offset == 0 {
        return factor;
    }
    let sign = if offset < 0 { MINUS } else { "+" };
    let space = if factor.is_empty() { "" } else { " " };
    factor.then(Label::plain(&format!("{space}{sign} {}", round_decimal(offset.abs(), exponent))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(low: f64, high: f64) -> (String, String) {
        let ticks = Ticks::new(Range::new(low, high), 5);
        let labels: Vec<String> = ticks.major.iter().map(|t| t.label.to_plain()).collect();
        (labels.join(" "), ticks.note.to_plain())
    }

    #[test]
    fn plain_ranges() {
        assert_eq!(labels(0.0, 20.0).0, "0 5 10 15 20");
        assert_eq!(labels(-0.6, 0.6).0, "−0.6 −0.4 −0.2 0 0.2 0.4 0.6");
        assert_eq!(labels(0.0, 0.3).0, "0 0.1 0.2 0.3");
        assert_eq!(labels(0.0, 4e4).0, "0 10\u{2009}000 20\u{2009}000 30\u{2009}000 40\u{2009}000");
    }

    #[test]
    fn tiny_and_huge_values_share_a_factor() {
        assert_eq!(labels(0.0, 4e-12), ("0 1 2 3 4".into(), "×10^−12".into()));
        assert_eq!(labels(-2.5e8, 2.5e8).1, "×10^8");
    }

    #[test]
    fn values_far_from_zero_share_an_offset() {
        let (labels, note) = labels(1e6, 1e6 + 1e-3);
        assert_eq!(labels, "0 0.2 0.4 0.6 0.8 1.0");
        assert_eq!(note, "×10^−3 + 1\u{2009}000\u{2009}000");
    }

    proptest! {
        #[test]
        fn ticks_are_few_increasing_and_inside(
            middle in -1.0..1.0f64, size in -200i32..200, narrow in 0i32..11, wanted in 1usize..20,
        ) {
            let middle = middle * 10f64.powi(size);
            let span = 10f64.powi(size - narrow) * 1.7;
            let range = Range::new(middle - span, middle + span);
            let ticks = Ticks::new(range, wanted);
            prop_assert!(COUNTS.contains(&ticks.major.len()), "{} ticks", ticks.major.len());
            prop_assert!(ticks.major.iter().all(|t| range.contains(t.value)));
            prop_assert!(ticks.major.windows(2).all(|w| w[0].value < w[1].value));
            prop_assert!(ticks.minor.iter().all(|v| range.contains(*v)));
            let texts: Vec<_> = ticks.major.iter().map(|t| t.label.to_plain()).collect();
            prop_assert!(texts.windows(2).all(|w| w[0] != w[1]), "{texts:?}");
        }
    }
}
