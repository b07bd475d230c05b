//! The units that formulas are written with: one table, every factor exact.

use num_rational::BigRational;

use super::{numbers, suggest};
use crate::Dimension;

/// A unit: what it measures and how many SI units it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedUnit {
    /// As it is written in a formula.
    pub symbol: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// How many coherent SI units it is: a decimal or a quotient of two, exact.
    pub factor: &'static str,
    /// How many times the factor is to be multiplied by pi.
    pub pi: i32,
    /// What it says beyond its dimension.
    pub tag: UnitTag,
    /// Its definition in a few words.
    pub definition: &'static str,
}

/// What a unit says that its dimension does not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnitTag {
    /// Nothing.
    Plain,
    /// That an angle is meant, or an angle per time.
    Angle,
    /// That a frequency is meant: cycles, which are no angle.
    Frequency,
}

impl NamedUnit {
    /// The factor as a number, pi left out.
    pub fn ratio(&self) -> BigRational {
        let (above, below) = self.factor.split_once('/').unwrap_or((self.factor, "1"));
        let exact = |text| numbers::decimal(text).expect("the table holds decimals");
        exact(above) / exact(below)
    }
}

/// The unit of exactly this symbol.
pub fn unit(symbol: &str) -> Option<&'static NamedUnit> {
    UNITS.iter().find(|unit| unit.symbol == symbol)
}

/// What the writer of a word that is no unit most likely meant, as units.
pub fn nearest_unit(word: &str) -> Option<String> {
    let everyday =
        || EVERYDAY.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, unit)| *unit);
    let symbols = || UNITS.iter().map(|unit| unit.symbol);
    let exact = everyday().or_else(|| suggest::same_letters(word, symbols())).map(str::to_owned);
    exact.or_else(|| with_power(word)).or_else(|| suggest::nearest(word, symbols()).map(str::to_owned))
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
    ("μm", "um"),
    ("μs", "us"),
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
    ("liter", "L"),
    ("litre", "L"),
    ("percent", "%"),
    ("м", "m"),
    ("см", "cm"),
    ("км", "km"),
    ("с", "s"),
    ("ч", "h"),
    ("кг", "kg"),
    ("Н", "N"),
];

const fn plain(
    symbol: &'static str,
    dimension: Dimension,
    factor: &'static str,
    definition: &'static str,
) -> NamedUnit {
    NamedUnit { symbol, dimension, factor, pi: 0, tag: UnitTag::Plain, definition }
}

const fn angle(
    symbol: &'static str,
    dimension: Dimension,
    factor: &'static str,
    pi: i32,
    definition: &'static str,
) -> NamedUnit {
    NamedUnit { symbol, dimension, factor, pi, tag: UnitTag::Angle, definition }
}

const fn frequency(symbol: &'static str, factor: &'static str, definition: &'static str) -> NamedUnit {
    let dimension = Dimension::ANGULAR_RATE;
    NamedUnit { symbol, dimension, factor, pi: 0, tag: UnitTag::Frequency, definition }
}

const VOLUME: Dimension = Dimension::new(3, 0, 0);
const POWER: Dimension = Dimension::new(2, 1, -3);
const PRESSURE: Dimension = Dimension::new(-1, 1, -2);

/// Every unit there is.
pub const UNITS: &[NamedUnit] = &[
    plain("m", Dimension::LENGTH, "1", "metre, SI"),
    plain("km", Dimension::LENGTH, "1000", "kilometre"),
    plain("cm", Dimension::LENGTH, "0.01", "centimetre"),
    plain("mm", Dimension::LENGTH, "1e-3", "millimetre"),
    plain("um", Dimension::LENGTH, "1e-6", "micrometre"),
    plain("nm", Dimension::LENGTH, "1e-9", "nanometre"),
    plain("in", Dimension::LENGTH, "0.0254", "inch, international, 1959"),
    plain("ft", Dimension::LENGTH, "0.3048", "foot, 12 in"),
    plain("yd", Dimension::LENGTH, "0.9144", "yard, 3 ft"),
    plain("mile", Dimension::LENGTH, "1609.344", "statute mile, 1760 yd"),
    plain("kg", Dimension::MASS, "1", "kilogram, SI"),
    plain("g", Dimension::MASS, "1e-3", "gram"),
    plain("mg", Dimension::MASS, "1e-6", "milligram"),
    plain("t", Dimension::MASS, "1000", "tonne"),
    plain("lb", Dimension::MASS, "0.45359237", "pound, avoirdupois, 1959"),
    plain("s", Dimension::TIME, "1", "second, SI"),
    plain("ms", Dimension::TIME, "1e-3", "millisecond"),
    plain("us", Dimension::TIME, "1e-6", "microsecond"),
    plain("min", Dimension::TIME, "60", "minute"),
    plain("h", Dimension::TIME, "3600", "hour"),
    plain("day", Dimension::TIME, "86400", "day of 24 h"),
    angle("rad", Dimension::NONE, "1", 0, "radian, SI"),
    angle("mrad", Dimension::NONE, "1e-3", 0, "milliradian"),
    angle("deg", Dimension::NONE, "1/180", 1, "degree, pi/180"),
    angle("rev", Dimension::NONE, "2", 1, "revolution, 2 pi"),
    angle("rpm", Dimension::ANGULAR_RATE, "1/30", 1, "revolution per minute"),
    frequency("Hz", "1", "hertz, a cycle per second"),
    frequency("kHz", "1000", "kilohertz"),
    plain("N", Dimension::FORCE, "1", "newton, kg m/s^2"),
    plain("mN", Dimension::FORCE, "1e-3", "millinewton"),
    plain("kN", Dimension::FORCE, "1000", "kilonewton"),
    plain("MN", Dimension::FORCE, "1e6", "meganewton"),
    plain("lbf", Dimension::FORCE, "4.4482216152605", "pound-force, lb at 9.80665 m/s^2"),
    plain("kgf", Dimension::FORCE, "9.80665", "kilogram-force, kg at 9.80665 m/s^2"),
    plain("J", Dimension::TORQUE, "1", "joule, N m"),
    plain("kJ", Dimension::TORQUE, "1000", "kilojoule"),
    plain("MJ", Dimension::TORQUE, "1e6", "megajoule"),
    plain("cal", Dimension::TORQUE, "4.184", "calorie, thermochemical"),
    plain("Wh", Dimension::TORQUE, "3600", "watt-hour"),
    plain("kWh", Dimension::TORQUE, "3.6e6", "kilowatt-hour"),
    plain("W", POWER, "1", "watt, J/s"),
    plain("kW", POWER, "1000", "kilowatt"),
    plain("hp", POWER, "745.69987158227022", "horsepower, mechanical, 550 ft lbf/s"),
    plain("Pa", PRESSURE, "1", "pascal, N/m^2"),
    plain("kPa", PRESSURE, "1000", "kilopascal"),
    plain("MPa", PRESSURE, "1e6", "megapascal"),
    plain("bar", PRESSURE, "1e5", "bar"),
    plain("atm", PRESSURE, "101325", "standard atmosphere"),
    plain("L", VOLUME, "1e-3", "litre, dm^3"),
    plain("mph", Dimension::SPEED, "0.44704", "mile per hour"),
    plain("knot", Dimension::SPEED, "1852/3600", "knot, nautical mile of 1852 m per hour"),
    plain("%", Dimension::NONE, "0.01", "per cent"),
];

#[cfg(test)]
mod tests {
    use num_traits::ToPrimitive;

    use super::*;

    /// From tables of units, rounded to the digits given there; independent of the table above.
    const FACTS: &[(&str, f64)] = &[
        ("m", 1.0),
        ("km", 1e3),
        ("cm", 1e-2),
        ("mm", 1e-3),
        ("um", 1e-6),
        ("nm", 1e-9),
        ("in", 0.0254),
        ("ft", 0.3048),
        ("yd", 0.9144),
        ("mile", 1609.344),
        ("kg", 1.0),
        ("g", 1e-3),
        ("mg", 1e-6),
        ("t", 1e3),
        ("lb", 0.453_592_37),
        ("s", 1.0),
        ("ms", 1e-3),
        ("us", 1e-6),
        ("min", 60.0),
        ("h", 3600.0),
        ("day", 86400.0),
        ("rad", 1.0),
        ("mrad", 1e-3),
        ("deg", 0.017_453_292_519_943_295),
        ("rev", 2.0 * std::f64::consts::PI),
        ("rpm", 0.104_719_755_119_659_77),
        ("Hz", 1.0),
        ("kHz", 1e3),
        ("N", 1.0),
        ("mN", 1e-3),
        ("kN", 1e3),
        ("MN", 1e6),
        ("lbf", 4.448_221_615_260_5),
        ("kgf", 9.806_65),
        ("J", 1.0),
        ("kJ", 1e3),
        ("MJ", 1e6),
        ("cal", 4.184),
        ("Wh", 3600.0),
        ("kWh", 3.6e6),
        ("W", 1.0),
        ("kW", 1e3),
        ("hp", 745.699_871_582_270_2),
        ("Pa", 1.0),
        ("kPa", 1e3),
        ("MPa", 1e6),
        ("bar", 1e5),
        ("atm", 101_325.0),
        ("L", 1e-3),
        ("mph", 0.447_04),
        ("knot", 0.514_444_444_444_444_4),
        ("%", 0.01),
    ];

    #[test]
    fn every_factor_is_the_one_of_the_tables() {
        assert_eq!(FACTS.len(), UNITS.len());
        for (symbol, expected) in FACTS {
            let unit = unit(symbol).expect(symbol);
            let found = unit.ratio().to_f64().expect("finite") * std::f64::consts::PI.powi(unit.pi);
            assert!((found / expected - 1.0).abs() < 4e-16, "{symbol}: {found} is not {expected}");
        }
    }

    #[test]
    fn factors_agree_with_their_definitions() {
        let ratio = |symbol| unit(symbol).expect(symbol).ratio();
        assert_eq!(ratio("lbf"), ratio("lb") * ratio("kgf"));
        let fifty_five = BigRational::from_integer(550.into());
        assert_eq!(ratio("hp"), fifty_five * ratio("ft") * ratio("lbf"));
        assert_eq!(ratio("mph"), ratio("mile") / ratio("h"));
    }

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
        ];
        for (word, expected) in cases {
            assert_eq!(nearest_unit(word).as_deref(), Some(expected), "{word}");
        }
        assert_eq!(nearest_unit("zorkmid"), None);
    }
}
