//! Numbers as print shows them, in figures, tables and formulas: true minus signs, no needless zeros, groups of three digits.

const MINUS: &str = "−";
const THIN_SPACE: &str = "\u{2009}";
/// Numbers of fewer digits are not grouped.
const LEAST_GROUPED: usize = 5;
/// Powers of ten that are written out; others get a factor.
const WRITTEN_OUT: std::ops::Range<i32> = -3..6;
/// The same where every digit is shown.
const EXACTLY_WRITTEN_OUT: std::ops::Range<i32> = -4..16;

/// A number in print: `1.25`, or `3` with the power of ten that follows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numeral {
    /// The digits, with their sign.
    pub digits: String,
    /// The power of ten that they are multiplied by, if it is not written out.
    pub power: Option<i32>,
}

impl Numeral {
    /// A number rounded to at most `digits` (1 to 17) significant digits; what is no number is a dash.
    pub fn significant(value: f64, digits: usize) -> Self {
        Self::of(&format!("{value:.*e}", digits.clamp(1, 17) - 1), WRITTEN_OUT)
    }

    /// A number with all digits that tell it from its neighbours.
    pub fn exact(value: f64) -> Self {
        Self::of(&format!("{value:e}"), EXACTLY_WRITTEN_OUT)
    }

    /// From what Rust writes in scientific notation.
    fn of(scientific: &str, written_out: std::ops::Range<i32>) -> Self {
        let parts = scientific.split_once('e').and_then(|(mantissa, exponent)| {
            let places = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
            let digits = mantissa.replace('.', "").parse::<i64>().ok()?;
            Some((digits, exponent.parse::<i32>().ok()?, i32::try_from(places).ok()?))
        });
        match parts {
            None => Self { digits: "–".to_owned(), power: None },
            Some((n, exponent, places)) if n == 0 || written_out.contains(&exponent) => {
                Self { digits: round_decimal(n, exponent - places), power: None }
            }
            Some((n, exponent, places)) => Self { digits: round_decimal(n, -places), power: Some(exponent) },
        }
    }
}

/// `n` times ten to `exponent`, as an exact decimal.
pub fn decimal(n: i64, exponent: i32) -> String {
    let sign = if n < 0 { MINUS } else { "" };
    let digits = n.unsigned_abs().to_string();
    match n {
        0 => "0".to_owned(),
        _ => format!("{sign}{}", placed(&digits, digits.len() as i64 + i64::from(exponent))),
    }
}

/// As [`decimal`], without zeros at the end of the fraction.
pub fn round_decimal(n: i64, exponent: i32) -> String {
    if exponent < 0 && n % 10 == 0 && n != 0 {
        return round_decimal(n / 10, exponent + 1);
    }
    decimal(n, exponent)
}

/// Digits with the decimal point behind so many of them.
pub(crate) fn placed(digits: &str, point: i64) -> String {
    let before = usize::try_from(point).unwrap_or(0);
    let zeros = usize::try_from(-point).unwrap_or(0);
    if before >= digits.len() {
        return grouped(&format!("{digits}{}", "0".repeat(before - digits.len())));
    }
    let (whole, part) = digits.split_at(before);
    let whole = if whole.is_empty() { "0" } else { whole };
    format!("{}.{}{part}", grouped(whole), "0".repeat(zeros))
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

    fn shown(numeral: Numeral) -> String {
        numeral.digits + &numeral.power.map_or_else(String::new, |power| format!("e{power}"))
    }

    #[test]
    fn numbers_are_rounded_and_short() {
        let four = |value| shown(Numeral::significant(value, 4));
        assert_eq!([0.0, 1.2, 0.1 + 0.2, -2.0, 1234.5678].map(four), ["0", "1.2", "0.3", "−2", "1235"]);
        assert_eq!([3e-7, -1.5e9, f64::NAN].map(four), ["3e-7", "−1.5e9", "–"]);
        assert_eq!(four(123_456.0), "123\u{2009}500");
    }

    #[test]
    fn exact_numbers_have_all_digits() {
        let exact = |value| shown(Numeral::exact(value));
        assert_eq!([0.0, 0.1 + 0.2, -1e-12, 0.0001], [0.0, 0.30000000000000004, -1e-12, 1e-4]);
        assert_eq!(
            [0.0, 0.1 + 0.2, -1e-12, 0.0001].map(exact),
            ["0", "0.30000000000000004", "−1e-12", "0.0001"]
        );
    }
}
