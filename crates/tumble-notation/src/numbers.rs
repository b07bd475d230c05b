//! Exact numbers as they are printed.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::layout::{Math, Operator};
use crate::numeral::placed;
use crate::rational::Rational;

/// The largest denominator that stands below a line even where a decimal would be exact.
const LARGEST_FRACTION: u32 = 16;
/// Digits of an exact decimal.
const MOST_DIGITS: usize = 8;
/// Digits of a fraction's numerator or denominator.
const MOST_FRACTION_DIGITS: usize = 4;
/// Digits of a number that is cut off.
const CUT_DIGITS: usize = 6;
/// Zeros before or behind the digits, beyond which a power of ten is written.
const MOST_ZEROS: i64 = 4;

/// A number that is not negative: what stands above, and what stands below a line.
pub(crate) struct Shape {
    /// `None` for 1.
    pub(crate) above: Option<Math>,
    pub(crate) below: Option<Math>,
}

/// How a number that is not negative is printed.
pub(crate) fn shape(value: &Rational) -> Shape {
    let whole = |above| Shape { above: Some(above), below: None };
    if value.is_one() {
        return Shape { above: None, below: None };
    }
    let digits = |part: &BigInt| part.to_string().len();
    let small = value.denom() <= &LARGEST_FRACTION.into();
    let short =
        digits(value.numer()) <= MOST_FRACTION_DIGITS && digits(value.denom()) <= MOST_FRACTION_DIGITS;
    if !value.is_integer() && short && (small || !ends(value)) {
        let above = (!value.numer().is_one()).then(|| Math::digits(value.numer()));
        return Shape { above, below: Some(Math::digits(value.denom())) };
    }
    whole(decimal(value))
}

/// The digits of a number that is not negative; where they do not end soon they are cut, and dots say so.
pub(crate) fn decimal(value: &Rational) -> Math {
    if value.is_zero() {
        return Math::digits(0);
    }
    let (digits, exponent, exact) = leading(value);
    let tail = if exact { "" } else { "…" };
    let point = exponent + 1;
    let length = i64::try_from(digits.len()).unwrap_or(i64::MAX);
    if point > length.max(CUT_DIGITS as i64) + MOST_ZEROS || point < -MOST_ZEROS {
        let (first, rest) = digits.split_at(1);
        let point = if rest.is_empty() { "" } else { "." };
        let mantissa = Math::Number(format!("{first}{point}{rest}{tail}"));
        let power = Math::digits(10).raised_to(signed(exponent));
        return Math::Row(vec![mantissa, Math::Operator(Operator::Times), power]);
    }
    Math::Number(format!("{}{tail}", placed(&digits, point)))
}

/// An integer of either sign.
pub(crate) fn signed(value: i64) -> Math {
    let digits = Math::digits(value.unsigned_abs());
    if value < 0 { digits.negative() } else { digits }
}

/// Whether the decimal of a number ends.
fn ends(value: &Rational) -> bool {
    let mut rest = value.denom().clone();
    for prime in [BigInt::from(2), BigInt::from(5)] {
        while (&rest % &prime).is_zero() {
            rest /= &prime;
        }
    }
    rest.is_one()
}

/// The first digits without zeros at the end, the power of ten of the first, and whether that is all.
fn leading(value: &Rational) -> (String, i64, bool) {
    let exact_digits = exact(value).filter(|(digits, _)| digits.len() <= MOST_DIGITS);
    if let Some((digits, exponent)) = exact_digits {
        return (digits, exponent, true);
    }
    // Digits cut off, not rounded: the dots say that more follow.
    let mut exponent = magnitude(value);
    let keep = i64::try_from(CUT_DIGITS).unwrap_or(1);
    let mut scaled = shifted(value, keep - 1 - exponent).to_integer().to_string();
    if scaled.len() > CUT_DIGITS {
        exponent += 1;
        scaled.truncate(CUT_DIGITS);
    } else if scaled.len() < CUT_DIGITS {
        exponent -= 1;
        scaled = shifted(value, keep - 1 - exponent).to_integer().to_string();
    }
    (scaled, exponent, false)
}

/// All digits of a number whose decimal ends soon.
fn exact(value: &Rational) -> Option<(String, i64)> {
    let most = i64::try_from(MOST_DIGITS).ok()?;
    let guess = magnitude(value);
    // One more for a guess that is one too high.
    let scaled = shifted(value, most - guess);
    if !scaled.is_integer() {
        return None;
    }
    let digits = scaled.to_integer().to_string();
    let exponent = i64::try_from(digits.len()).ok()? - 1 - (most - guess);
    Some((digits.trim_end_matches('0').to_owned(), exponent))
}

/// The power of ten of the first digit, or one more or less.
fn magnitude(value: &Rational) -> i64 {
    let bits = |part: &BigInt| part.bits().to_f64().unwrap_or(0.0);
    let log = (bits(value.numer()) - bits(value.denom())) * std::f64::consts::LOG10_2;
    log.floor().to_i64().unwrap_or(0)
}

/// `value 10^places`
fn shifted(value: &Rational, places: i64) -> Rational {
    let ten = Rational::from_integer(10.into());
    value.abs() * ten.pow(i32::try_from(places).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn text(numerator: i64, denominator: i64) -> String {
        crate::text::text(&decimal(&ratio(numerator, denominator)))
    }

    #[test]
    fn short_decimals_are_exact_and_long_ones_say_that_they_are_not() {
        assert_eq!(text(0, 1), "0");
        assert_eq!(text(981, 100), "9.81");
        assert_eq!(text(1, 50), "0.02");
        assert_eq!(text(9_810_000, 1), "9\u{2009}810\u{2009}000");
        assert_eq!(text(1, 3), "0.333333…");
        assert_eq!(text(2_000_000, 3), "666\u{2009}666…");
        assert_eq!(text(999_999_999, 1_000_000_000), "0.999999…");
        assert_eq!(text(1, 1_000_000), "1·10⁻⁶");
        assert_eq!(text(123, 100_000_000_000), "1.23·10⁻⁹");
        assert_eq!(text(602_214_076_000_000_000, 1), "6.02214…·10¹⁷");
    }

    #[test]
    fn fractions_of_small_numbers_stay_fractions() {
        let both = |n, d| {
            let shape = shape(&ratio(n, d));
            [shape.above, shape.below].map(|side| side.map(|side| crate::text::text(&side)))
        };
        assert_eq!(both(2, 3), [Some("2".to_owned()), Some("3".to_owned())]);
        assert_eq!(both(1, 2), [None, Some("2".to_owned())]);
        assert_eq!(both(7, 36), [Some("7".to_owned()), Some("36".to_owned())]);
        assert_eq!(both(1, 50), [Some("0.02".to_owned()), None]);
        assert_eq!(both(1, 1), [None, None]);
    }
}
