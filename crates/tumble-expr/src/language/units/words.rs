//! What the writer of a word that is no unit most likely meant.

use super::super::suggest;
use super::{UNITS, unit};

/// What the writer of a word that is no unit most likely meant, as units.
pub fn nearest_unit(word: &str) -> Option<String> {
    let everyday =
        || EVERYDAY.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, unit)| *unit);
    let symbols = || UNITS.iter().map(|unit| unit.symbol);
    let exact = everyday().or_else(|| suggest::same_letters(word, symbols())).map(str::to_owned);
    exact
        .or_else(|| with_micro(word))
        .or_else(|| with_power(word))
        .or_else(|| suggest::nearest(word, symbols()).map(str::to_owned))
}

/// The Greek letter of the prefix micro, which is written `u` here.
fn with_micro(word: &str) -> Option<String> {
    let micro = format!("u{}", word.strip_prefix('\u{3bc}')?);
    unit(&micro).map(|unit| unit.symbol.to_owned())
}

/// `m2` is the way some write `m^2`.
fn with_power(word: &str) -> Option<String> {
    let symbol = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let power = &word[symbol.len()..];
    (!power.is_empty() && unit(symbol).is_some()).then(|| format!("{symbol}^{power}"))
}

/// Words that are written for units elsewhere.
const EVERYDAY: &[(&str, &str)] = &[
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("inch", "in"),
    ("inches", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("yard", "yd"),
    ("mi", "mile"),
    ("miles", "mile"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hr", "h"),
    ("hour", "h"),
    ("hours", "h"),
    ("d", "day"),
    ("days", "day"),
    ("gram", "g"),
    ("kilogram", "kg"),
    ("kilo", "kg"),
    ("tonne", "t"),
    ("lbs", "lb"),
    ("lbm", "lb"),
    ("pound", "lb"),
    ("newton", "N"),
    ("newtons", "N"),
    ("joule", "J"),
    ("watt", "W"),
    ("pascal", "Pa"),
    ("hertz", "Hz"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("rot", "rev"),
    ("turn", "rev"),
    ("turns", "rev"),
    ("rps", "rev/s"),
    ("kph", "km/h"),
    ("kmh", "km/h"),
    ("kmph", "km/h"),
    ("mps", "m/s"),
    ("kn", "knot"),
    ("kt", "knot"),
    ("kts", "knot"),
    ("NM", "nmi"),
    ("Nm", "N*m"),
    ("bhp", "hp"),
    ("horsepower", "hp"),
    ("kgm", "kg*m"),
    ("cc", "cm^3"),
    ("l", "L"),
    ("liter", "L"),
    ("litre", "L"),
    ("percent", "%"),
    ("calorie", "cal"),
    ("atmosphere", "atm"),
    ("м", "m"),
    ("см", "cm"),
    ("км", "km"),
    ("с", "s"),
    ("ч", "h"),
    ("кг", "kg"),
    ("Н", "N"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_find_their_unit() {
        let cases = [
            ("Kg", "kg"),
            ("sec", "s"),
            ("metres", "m"),
            ("m2", "m^2"),
            ("hz", "Hz"),
            ("kmh", "km/h"),
            ("raad", "rad"),
            ("degs", "deg"),
            ("кг", "kg"),
            ("\u{3bc}m", "um"),
            ("\u{3bc}N", "uN"),
            ("l", "L"),
        ];
        for (word, expected) in cases {
            assert_eq!(nearest_unit(word).as_deref(), Some(expected), "{word}");
        }
        assert_eq!(nearest_unit("zorkmid"), None);
    }

    #[test]
    fn what_is_offered_is_written_in_units() {
        let is_word = |c: char| c.is_alphabetic() || c == '%';
        for (_, offered) in EVERYDAY {
            let words = offered.split(|c| !is_word(c)).filter(|word| !word.is_empty());
            words.for_each(|word| assert!(unit(word).is_some(), "{offered}"));
        }
    }
}
