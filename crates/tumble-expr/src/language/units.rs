//! The units that formulas are written with: one table, every factor exact.

mod table;
mod words;

use num_rational::BigRational;

use super::numbers;
use crate::Dimension;

pub use table::UNITS;
pub use words::nearest_unit;

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
    /// Who fixed the factor: `SI`, or the agreement or table that states it.
    pub source: &'static str,
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
    /// What it measures, in words: `length`, `angle per time`. Units of one measure can be converted into each other.
    pub fn measure(&self) -> &'static str {
        let known =
            MEASURES.iter().find(|(dimension, tag, _)| (*dimension, *tag) == (self.dimension, self.tag));
        known.map_or("", |(.., measure)| measure)
    }

    /// Whether it is one SI unit, pi left out.
    pub(super) fn is_coherent(&self) -> bool {
        self.factor == "1"
    }

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

/// What units measure, in the order of the table.
const MEASURES: &[(Dimension, UnitTag, &str)] = &[
    (Dimension::LENGTH, UnitTag::Plain, "length"),
    (Dimension::MASS, UnitTag::Plain, "mass"),
    (Dimension::TIME, UnitTag::Plain, "time"),
    (Dimension::NONE, UnitTag::Angle, "angle"),
    (Dimension::ANGULAR_RATE, UnitTag::Angle, "angle per time"),
    (Dimension::ANGULAR_RATE, UnitTag::Frequency, "frequency"),
    (Dimension::SPEED, UnitTag::Plain, "speed"),
    (Dimension::FORCE, UnitTag::Plain, "force"),
    (Dimension::TORQUE, UnitTag::Plain, "energy, torque"),
    (POWER, UnitTag::Plain, "power"),
    (PRESSURE, UnitTag::Plain, "pressure"),
    (VOLUME, UnitTag::Plain, "volume"),
    (Dimension::NONE, UnitTag::Plain, "pure number"),
];

const VOLUME: Dimension = Dimension::new(3, 0, 0);
const POWER: Dimension = Dimension::new(2, 1, -3);
const PRESSURE: Dimension = Dimension::new(-1, 1, -2);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_agree_with_their_definitions() {
        let ratio = |symbol| unit(symbol).expect(symbol).ratio();
        assert_eq!(ratio("lbf"), ratio("lb") * ratio("kgf"));
        let five_hundred_fifty = BigRational::from_integer(550.into());
        assert_eq!(ratio("hp"), five_hundred_fifty * ratio("ft") * ratio("lbf"));
        assert_eq!(ratio("mph"), ratio("mile") / ratio("h"));
        assert_eq!(ratio("psi"), ratio("lbf") / (ratio("in") * ratio("in")));
        assert_eq!(ratio("knot"), ratio("nmi") / ratio("h"));
        assert_eq!(ratio("kWh"), ratio("kW") * ratio("h"));
        assert_eq!(ratio("rpm") * ratio("min"), ratio("rev"));
    }

    #[test]
    fn every_unit_has_one_symbol_a_measure_and_a_source() {
        let mut seen = std::collections::HashSet::new();
        for unit in UNITS {
            assert!(seen.insert(unit.symbol), "{} twice", unit.symbol);
            assert!(!unit.measure().is_empty(), "{} measures nothing", unit.symbol);
            assert!(!unit.definition.is_empty() && !unit.source.is_empty(), "{}", unit.symbol);
        }
    }

    #[test]
    fn units_of_one_measure_stand_together() {
        let mut measures: Vec<_> = UNITS.iter().map(NamedUnit::measure).collect();
        measures.dedup();
        let listed: Vec<_> = MEASURES.iter().map(|(.., measure)| *measure).collect();
        assert_eq!(measures, listed);
    }
}
