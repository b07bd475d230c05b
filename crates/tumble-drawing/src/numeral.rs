//! Numbers as print shows them: true minus signs, no needless zeros.

use crate::text::Label;
use crate::units::MINUS;

/// Powers of ten that are written out; others get a factor.
const WRITTEN_OUT: std::ops::Range<i32> = -3..6;

/// Numbers of fewer digits are not grouped.
const LEAST_GROUPED: usize = 5;
const THIN_SPACE: &str = "\u{2009}";

/// `n` times ten to `exponent`, as an exact decimal.
pub fn decimal(n: i64, exponent: i32) -> String {
    let sign = if n < 0 { MINUS } else { "" };
    let digits = n.unsigned_abs().to_string();
    let places = usize::try_from(-exponent).unwrap_or(0);
    match (n, exponent) {
        (0, _) => "0".to_owned(),
        (_, 0..) => {
            let zeros = "0".repeat(exponent.unsigned_abs() as usize);
            format!("{sign}{}", grouped(&format!("{digits}{zeros}")))
        }
        _ => {
            let padded = format!("{digits:0>width$}", width = places + 1);
            let (whole, part) = padded.split_at(padded.len() - places);
            format!("{sign}{}.{part}", grouped(whole))
        }
    }
}

/// Digits in groups of three with thin spaces, from five digits on.
fn grouped(digits: &str) -> String {
    if digits.len() < LEAST_GROUPED {
        return digits.to_owned();
    }
    let head = (digits.len() + 2) % 3 + 1;
    let (head, rest) = digits.split_at(head);
    let groups = (0..rest.len() / 3).map(|i| &rest[3 * i..3 * i + 3]);
    std::iter::once(head).chain(groups).collect::<Vec<_>>().join(THIN_SPACE)
}

/// As [`decimal`], without zeros at the end of the fraction.
pub fn round_decimal(n: i64, exponent: i32) -> String {
    if exponent < 0 && n % 10 == 0 && n != 0 {
        return round_decimal(n / 10, exponent + 1);
    }
    decimal(n, exponent)
}

/// A number rounded to at most `digits` (1 to 17) significant digits, for
/// instance `1.25` or `3×10⁻⁷`; what is no number prints as a dash.
pub fn significant(value: f64, digits: usize) -> Label {
    let places = digits.clamp(1, 17) - 1;
    let shown = format!("{value:.places$e}");
    let parts = shown.split_once('e').and_then(|(mantissa, exponent)| {
        Some((mantissa.replace('.', "").parse::<i64>().ok()?, exponent.parse::<i32>().ok()?))
    });
    match parts {
        None => Label::plain("–"),
        Some((n, exponent)) if n == 0 || WRITTEN_OUT.contains(&exponent) => {
            Label::plain(&round_decimal(n, exponent - places as i32))
        }
        Some((n, exponent)) => {
            Label::plain(&round_decimal(n, -(places as i32))).then(Label::power_of_ten(exponent))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact() {
        assert_eq!(decimal(-5, -2), "−0.05");
        assert_eq!(decimal(10, -1), "1.0");
        assert_eq!(decimal(3, 3), "3000");
        assert_eq!(decimal(-1234, 3), "−1\u{2009}234\u{2009}000");
        assert_eq!(decimal(123456, -1), "12\u{2009}345.6");
        assert_eq!(decimal(0, -4), "0");
        assert_eq!(round_decimal(1200, -3), "1.2");
    }

    #[test]
    fn numbers_are_rounded_and_short() {
        let shown = |value| significant(value, 4).to_plain();
        assert_eq!([0.0, 1.2, 0.1 + 0.2, -2.0, 1234.5678].map(shown), ["0", "1.2", "0.3", "−2", "1235"]);
        assert_eq!([3e-7, -1.5e9, f64::NAN].map(shown), ["3×10^−7", "−1.5×10^9", "–"]);
        assert_eq!(shown(123_456.0), "123\u{2009}500");
    }
}
