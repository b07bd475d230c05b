//! The table of units: every factor exact, and who fixed it.

use super::{NamedUnit, POWER, PRESSURE, UnitTag, VOLUME};
use crate::Dimension;

const SI: &str = "SI";
const BESIDE_SI: &str = "SI Brochure, 9th edition, table 8: accepted for use with the SI";
const YARD_AND_POUND: &str = "yard and pound agreement of 1959: 1 yd = 0.9144 m, 1 lb = 0.45359237 kg";
const FREE_FALL: &str = "3rd CGPM 1901: standard acceleration of free fall 9.80665 m/s^2";
const POUND_FORCE: &str = "pound of 1959, standard acceleration of free fall of 1901";
const NAUTICAL: &str = "hydrographic conference of 1929, Monaco: 1 nmi = 1852 m";
const NIST: &str = "NIST SP 811, appendix B.8";
const BY_DEFINITION: &str = "by definition";

const fn si(
    symbol: &'static str,
    dimension: Dimension,
    factor: &'static str,
    definition: &'static str,
) -> NamedUnit {
    other(symbol, dimension, factor, definition, SI)
}

const fn other(
    symbol: &'static str,
    dimension: Dimension,
    factor: &'static str,
    definition: &'static str,
    source: &'static str,
) -> NamedUnit {
    NamedUnit { symbol, dimension, factor, pi: 0, tag: UnitTag::Plain, definition, source }
}

/// `pi` tells whether the factor is to be multiplied by pi.
const fn angle(
    symbol: &'static str,
    dimension: Dimension,
    (factor, pi): (&'static str, i32),
    definition: &'static str,
    source: &'static str,
) -> NamedUnit {
    NamedUnit { symbol, dimension, factor, pi, tag: UnitTag::Angle, definition, source }
}

const fn frequency(symbol: &'static str, factor: &'static str, definition: &'static str) -> NamedUnit {
    NamedUnit { tag: UnitTag::Frequency, ..si(symbol, Dimension::ANGULAR_RATE, factor, definition) }
}

/// Every unit there is; those of one measure stand together.
pub const UNITS: &[NamedUnit] = &[
    si("m", Dimension::LENGTH, "1", "metre, SI"),
    si("km", Dimension::LENGTH, "1000", "kilometre"),
    si("dm", Dimension::LENGTH, "0.1", "decimetre"),
    si("cm", Dimension::LENGTH, "0.01", "centimetre"),
    si("mm", Dimension::LENGTH, "1e-3", "millimetre"),
    si("um", Dimension::LENGTH, "1e-6", "micrometre"),
    si("nm", Dimension::LENGTH, "1e-9", "nanometre"),
    other("in", Dimension::LENGTH, "0.0254", "inch, yd/36", YARD_AND_POUND),
    other("ft", Dimension::LENGTH, "0.3048", "foot, yd/3", YARD_AND_POUND),
    other("yd", Dimension::LENGTH, "0.9144", "yard", YARD_AND_POUND),
    other("mile", Dimension::LENGTH, "1609.344", "statute mile, 1760 yd", YARD_AND_POUND),
    other("nmi", Dimension::LENGTH, "1852", "nautical mile", NAUTICAL),
    si("kg", Dimension::MASS, "1", "kilogram, SI"),
    si("g", Dimension::MASS, "1e-3", "gram"),
    si("mg", Dimension::MASS, "1e-6", "milligram"),
    si("ug", Dimension::MASS, "1e-9", "microgram"),
    other("t", Dimension::MASS, "1000", "tonne", BESIDE_SI),
    other("lb", Dimension::MASS, "0.45359237", "pound, avoirdupois", YARD_AND_POUND),
    si("s", Dimension::TIME, "1", "second, SI"),
    si("ms", Dimension::TIME, "1e-3", "millisecond"),
    si("us", Dimension::TIME, "1e-6", "microsecond"),
    si("ns", Dimension::TIME, "1e-9", "nanosecond"),
    other("min", Dimension::TIME, "60", "minute", BESIDE_SI),
    other("h", Dimension::TIME, "3600", "hour, 60 min", BESIDE_SI),
    other("day", Dimension::TIME, "86400", "day of 24 h", BESIDE_SI),
    angle("rad", Dimension::NONE, ("1", 0), "radian, SI", SI),
    angle("mrad", Dimension::NONE, ("1e-3", 0), "milliradian", SI),
    angle("deg", Dimension::NONE, ("1/180", 1), "degree, pi/180 rad", BESIDE_SI),
    angle("rev", Dimension::NONE, ("2", 1), "revolution, 2 pi rad", BY_DEFINITION),
    angle("rpm", Dimension::ANGULAR_RATE, ("1/30", 1), "revolution per minute, pi/30 rad/s", BY_DEFINITION),
    frequency("Hz", "1", "hertz, a cycle per second"),
    frequency("mHz", "1e-3", "millihertz"),
    frequency("kHz", "1000", "kilohertz"),
    frequency("MHz", "1e6", "megahertz"),
    frequency("GHz", "1e9", "gigahertz"),
    other("mph", Dimension::SPEED, "0.44704", "mile per hour", YARD_AND_POUND),
    other("knot", Dimension::SPEED, "1852/3600", "knot, nmi/h", NAUTICAL),
    si("N", Dimension::FORCE, "1", "newton, kg*m/s^2"),
    si("uN", Dimension::FORCE, "1e-6", "micronewton"),
    si("mN", Dimension::FORCE, "1e-3", "millinewton"),
    si("kN", Dimension::FORCE, "1000", "kilonewton"),
    si("MN", Dimension::FORCE, "1e6", "meganewton"),
    other(
        "lbf",
        Dimension::FORCE,
        "4.4482216152605",
        "pound-force, the weight of 1 lb at 9.80665 m/s^2",
        POUND_FORCE,
    ),
    other(
        "kgf",
        Dimension::FORCE,
        "9.80665",
        "kilogram-force, the weight of 1 kg at 9.80665 m/s^2",
        FREE_FALL,
    ),
    si("J", Dimension::TORQUE, "1", "joule, N*m"),
    si("uJ", Dimension::TORQUE, "1e-6", "microjoule"),
    si("mJ", Dimension::TORQUE, "1e-3", "millijoule"),
    si("kJ", Dimension::TORQUE, "1000", "kilojoule"),
    si("MJ", Dimension::TORQUE, "1e6", "megajoule"),
    si("GJ", Dimension::TORQUE, "1e9", "gigajoule"),
    other("cal", Dimension::TORQUE, "4.184", "calorie, thermochemical", NIST),
    other("kcal", Dimension::TORQUE, "4184", "kilocalorie, thermochemical", NIST),
    other("Wh", Dimension::TORQUE, "3600", "watt-hour", BY_DEFINITION),
    other("kWh", Dimension::TORQUE, "3.6e6", "kilowatt-hour", BY_DEFINITION),
    si("W", POWER, "1", "watt, J/s"),
    si("uW", POWER, "1e-6", "microwatt"),
    si("mW", POWER, "1e-3", "milliwatt"),
    si("kW", POWER, "1000", "kilowatt"),
    si("MW", POWER, "1e6", "megawatt"),
    si("GW", POWER, "1e9", "gigawatt"),
    other("hp", POWER, "745.69987158227022", "horsepower, mechanical, 550 ft*lbf/s", NIST),
    si("Pa", PRESSURE, "1", "pascal, N/m^2"),
    si("mPa", PRESSURE, "1e-3", "millipascal"),
    si("hPa", PRESSURE, "100", "hectopascal"),
    si("kPa", PRESSURE, "1000", "kilopascal"),
    si("MPa", PRESSURE, "1e6", "megapascal"),
    si("GPa", PRESSURE, "1e9", "gigapascal"),
    other("bar", PRESSURE, "1e5", "bar", NIST),
    other("mbar", PRESSURE, "100", "millibar", NIST),
    other("atm", PRESSURE, "101325", "standard atmosphere", "10th CGPM 1954, resolution 4"),
    other("psi", PRESSURE, "4.4482216152605/0.00064516", "pound-force per square inch", POUND_FORCE),
    other("L", VOLUME, "1e-3", "litre, dm^3", BESIDE_SI),
    other("mL", VOLUME, "1e-6", "millilitre, cm^3", BESIDE_SI),
    other("%", Dimension::NONE, "0.01", "per cent", BY_DEFINITION),
];
