//! What is said of a value that a motion leaves open: more contacts or joints bear than are needed, or the instant has none.

use tumble_mech::Spread;

/// What becomes of a question about such a value.
pub(crate) const NOT_UNIQUE: &str = "not unique";
/// What becomes of a question about what has no value at its instant.
pub(crate) const NO_VALUE: &str = "no value";
/// Digits of the ends of a range.
const READ: usize = 4;

/// What is said instead of a value; `None` where there is one.
pub(crate) fn instead_of(value: f64, spread: Option<&Spread>, unit: &str) -> Option<String> {
    match spread {
        Some(spread) => Some(words(spread, unit)),
        None => value.is_nan().then(|| format!("has {NO_VALUE}")),
    }
}

/// `is between 0 N and 14.72 N: not unique, more contacts or joints bear than are needed`
fn words(spread: &Spread, unit: &str) -> String {
    let value = |value: f64| {
        let rounded: f64 = format!("{value:.*e}", READ - 1).parse().unwrap_or(value);
        if unit.is_empty() { rounded.to_string() } else { format!("{rounded} {unit}") }
    };
    let Spread { least, greatest } = *spread;
    let range = match (least.is_finite(), greatest.is_finite()) {
        (true, true) => format!("between {} and {}", value(least), value(greatest)),
        (true, false) => format!("at least {}", value(least)),
        (false, true) => format!("at most {}", value(greatest)),
        (false, false) => "open".to_owned(),
    };
    format!("is {range}: {NOT_UNIQUE}, more contacts or joints bear than are needed")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_rounded() {
        let said = |least: f64, greatest: f64| words(&Spread { least, greatest }, "N");
        let why = ": not unique, more contacts or joints bear than are needed";
        assert_eq!(said(0.0, 14.7150001), format!("is between 0 N and 14.72 N{why}"));
        assert_eq!(said(0.0, f64::INFINITY), format!("is at least 0 N{why}"));
        assert_eq!(said(f64::NEG_INFINITY, 9.81), format!("is at most 9.81 N{why}"));
        assert_eq!(said(f64::NEG_INFINITY, f64::INFINITY), format!("is open{why}"));
    }
}
