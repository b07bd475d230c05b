//! Numbers as text: the shortest decimal that reads back as the same number, as Rust's `{:?}` writes it.

use std::io::Write;

/// Sizes that are written without an exponent, from the first up to the second.
const PLAIN: [f64; 2] = [1e-4, 1e16];
/// Bits of a double after the leading one, and the exponent of its last bit where its own is zero.
const FRACTION: u32 = 52;
const LAST_BIT: i64 = 1075;

/// No number that is written without an exponent has so many digits after the point.
const MOST_PLACES: i64 = 24;

/// Writes numbers into a buffer of its own.
#[derive(Default)]
pub(crate) struct Decimal {
    digits: zmij::Buffer,
    rare: Vec<u8>,
}

impl Decimal {
    /// The number as text.
    pub(crate) fn of(&mut self, value: f64) -> &[u8] {
        if is_plain(value) {
            let text = self.digits.format_finite(value);
            let last_bit = last_bit(value);
            if last_bit < -MOST_PLACES || !is_between(last_bit, text) {
                return text.as_bytes();
            }
        }
        self.rare.clear();
        // Writing to memory does not fail.
        let _ = write!(self.rare, "{value:?}");
        &self.rare
    }
}

fn is_plain(value: f64) -> bool {
    value == 0.0 || (PLAIN[0]..PLAIN[1]).contains(&value.abs())
}

/// Exponent of the last bit of a number that is one.
fn last_bit(value: f64) -> i64 {
    let bits = value.abs().to_bits();
    let fraction = (bits & ((1 << FRACTION) - 1)) | (1 << FRACTION);
    (bits >> FRACTION) as i64 - LAST_BIT + i64::from(fraction.trailing_zeros())
}

/// Whether a number with that last bit may lie in the middle of two decimals of as many places: which of them is written is a
/// matter of taste.
fn is_between(last_bit: i64, text: &str) -> bool {
    let places = text.find('.').map_or(0, |point| text.len() - point - 1);
    last_bit == -(places as i64 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_rust_shows_them() {
        let mut decimal = Decimal::default();
        let powers = (-1074..1024).map(|power| 2.0_f64.powi(power));
        let near = powers.flat_map(|power| [power, power.next_up(), power.next_down(), 3.0 * power]);
        let short =
            (0..40).flat_map(|places| (1..999).map(move |part| f64::from(part) / 2.0_f64.powi(places)));
        let tens =
            (-30..30).flat_map(|power| (1..99).map(move |part| f64::from(part) * 10.0_f64.powi(power)));
        let special = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, 1e16, 1e-4, 5e-324];
        let middle = [2.0_f64.powi(50) + 0.25, 2.0_f64.powi(52) + 1.5];
        for value in near.chain(short).chain(tens).chain(special).chain(middle) {
            for value in [value, -value, value / 3.0] {
                assert_eq!(String::from_utf8_lossy(decimal.of(value)), format!("{value:?}"));
            }
        }
    }
}
