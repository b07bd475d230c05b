//! Decimal numbers, read exactly.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use super::error::{Code, FormulaError, Span};

/// A number literal found in a text.
pub(super) struct Literal {
    /// One past its last byte.
    pub end: usize,
    /// Its exact value, unless it is not a number that can be computed with.
    pub value: Result<BigRational, FormulaError>,
}

/// Reads the number that begins at `start`, where a digit or a point and a digit stand.
pub(super) fn read(text: &str, start: usize) -> Literal {
    let end = mantissa_end(text, start);
    match malformed(text, start, end) {
        Some((end, error)) => Literal { end, value: Err(error) },
        None => {
            let end = exponent_end(text, end).unwrap_or(end);
            Literal { end, value: exact(text, start..end) }
        }
    }
}

/// The exact value of a decimal such as `-0.3048` or `4.5e-3`; `None` where the text is no such number.
pub(super) fn decimal(text: &str) -> Option<BigRational> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = format!("{whole}{fraction}").parse().ok()?;
    if digits.is_zero() {
        return Some(BigRational::zero());
    }
    let shift = exponent.parse::<i32>().ok()?.checked_sub(i32::try_from(fraction.len()).ok()?)?;
    if shift == 0 {
        return Some(BigRational::from_integer(digits));
    }
    Some(BigRational::from_integer(digits) * BigRational::from_integer(10.into()).pow(shift))
}

/// Whether a double holds it without becoming infinite or, unless it is zero, zero.
pub(super) fn is_representable(value: &BigRational) -> bool {
    value.is_zero() || value.to_f64().is_some_and(|double| double.is_finite() && double != 0.0)
}

/// The mistake of a number that no double holds.
pub(super) fn out_of_range(span: Span, too_large: bool) -> FormulaError {
    let (size, limit) = if too_large { ("large", "1.8e308") } else { ("small", "4.9e-324") };
    FormulaError::new(Code::Magnitude, span, format!("this number is too {size} to compute with"))
        .label(format!("the limit is about {limit}"))
        .help("choose a unit in which the number is of ordinary size")
}

fn mantissa_end(text: &str, start: usize) -> usize {
    let whole = digits_end(text, start);
    match text[whole..].strip_prefix('.') {
        // A point before a letter would be a dotted name, which no number begins.
        Some(rest) if !rest.starts_with('.') => digits_end(text, whole + 1),
        _ => whole,
    }
}

fn digits_end(text: &str, start: usize) -> usize {
    let digits = text[start..].bytes().take_while(u8::is_ascii_digit).count();
    start + digits
}

/// One past the exponent, where a complete one stands at `at`.
fn exponent_end(text: &str, at: usize) -> Option<usize> {
    let rest = text[at..].strip_prefix(['e', 'E'])?;
    let digits = rest.strip_prefix(['+', '-']).unwrap_or(rest);
    let start = text.len() - digits.len();
    Some(digits_end(text, start)).filter(|end| *end > start)
}

/// The end and the mistake of what begins like a number and is none.
fn malformed(text: &str, start: usize, end: usize) -> Option<(usize, FormulaError)> {
    let rest = &text[end..];
    if rest.starts_with(['.', '_']) {
        let end = end + rest.bytes().take_while(|b| b.is_ascii_digit() || matches!(b, b'.' | b'_')).count();
        return Some((end, not_a_number(text, start..end)));
    }
    let after = rest.strip_prefix(['e', 'E'])?;
    let word_goes_on = after.starts_with(|c: char| super::characters::begins_word(c));
    if word_goes_on || exponent_end(text, end).is_some() {
        return None;
    }
    let sign = usize::from(after.starts_with(['+', '-']));
    Some((end + 1 + sign, missing_exponent(text, start..end + 1)))
}

fn not_a_number(text: &str, span: Span) -> FormulaError {
    let written = &text[span.clone()];
    let error = FormulaError::new(Code::Number, span, format!("`{written}` is not a number"));
    let plain = written.replace('_', "");
    match plain.matches('.').count() {
        0 | 1 => error.label("digits are not grouped").help(format!("write `{plain}`")),
        _ => error.label("two decimal points").help("a number has one decimal point, as in `1.5`"),
    }
}

fn missing_exponent(text: &str, span: Span) -> FormulaError {
    let mantissa = &text[span.start..span.end - 1];
    FormulaError::new(Code::Number, span, "the exponent of this number is missing")
        .label("a number should follow the e")
        .help(format!("write `{mantissa}e3` for {mantissa} times 1000, or `{mantissa}` alone"))
}

/// The size is checked on the double first, so that `1e999999999` builds no such integer.
fn exact(text: &str, span: Span) -> Result<BigRational, FormulaError> {
    let written = &text[span.clone()];
    let mantissa = written.split(['e', 'E']).next().unwrap_or(written);
    let is_zero = !mantissa.contains(|c: char| c.is_ascii_digit() && c != '0');
    match written.parse::<f64>() {
        _ if is_zero => Ok(BigRational::zero()),
        Ok(double) if double.is_infinite() || double == 0.0 => Err(out_of_range(span, double.is_infinite())),
        _ => decimal(written).ok_or_else(|| not_a_number(text, span)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> BigRational {
        let literal = read(text, 0);
        assert_eq!(literal.end, text.len(), "{text}");
        literal.value.unwrap_or_else(|e| panic!("{text}: {e}"))
    }

    fn ratio(numerator: i64, denominator: i64) -> BigRational {
        BigRational::new(numerator.into(), denominator.into())
    }

    #[test]
    fn numbers_are_exact() {
        assert_eq!(value("1e-1"), ratio(1, 10));
        assert_eq!(value(".5"), ratio(1, 2));
        assert_eq!(value("1."), ratio(1, 1));
        assert_eq!(value("9.81"), ratio(981, 100));
        assert_eq!(value("2.5E+3"), ratio(2500, 1));
        assert_eq!(value("0e999999999999"), ratio(0, 1));
        assert_eq!(value(&format!("0.{}1e400", "0".repeat(399))), ratio(1, 1));
    }

    #[test]
    fn numbers_that_no_double_holds_are_refused() {
        for (text, size) in [("1e999", "large"), ("1e-999", "small"), ("1e99999999999", "large")] {
            let error = read(text, 0).value.expect_err(text);
            assert_eq!(error.code, Code::Magnitude);
            assert!(error.message.contains(size), "{text}: {error}");
        }
        assert!(is_representable(&value("4.9e-324")) && is_representable(&value("1.7e308")));
    }

    #[test]
    fn what_is_no_number_is_named() {
        for (text, end) in [("1.5.2 + 3", 5), ("1e", 2), ("1e+ 2", 3), ("1_000", 5), ("1..2", 4)] {
            let literal = read(text, 0);
            assert_eq!(literal.value.expect_err(text).code, Code::Number);
            assert_eq!(literal.end, end, "{text}");
        }
    }

    #[test]
    fn a_unit_may_begin_with_e() {
        assert_eq!(read("2exp(x)", 0).end, 1);
    }
}
