//! Every unit of the table against an independent library of units, with which it shares no number.

use num_rational::BigRational;
use num_traits::ToPrimitive;
use tumble_expr::language::{NamedUnit, UNITS, UnitTag};

/// What the library calls a unit for which it has no sign.
const CALLED: &[(&str, &str)] =
    &[("mrad", "milliradian"), ("%", "percent"), ("in", "inch"), ("mbar", "millibar")];

/// Rounding of the library's approximation of pi and of ours to the nearest double, with two roundings of a product.
const ROUNDING: f64 = 1e-15;

fn called(unit: &NamedUnit) -> &'static str {
    CALLED.iter().find(|(symbol, _)| *symbol == unit.symbol).map_or(unit.symbol, |(_, called)| called)
}

/// The coherent SI unit of what a unit measures, in the library's words.
fn si(unit: &NamedUnit) -> String {
    let powers = [(unit.dimension.length, "m"), (unit.dimension.mass, "kg"), (unit.dimension.time, "s")];
    let angle = (unit.tag == UnitTag::Angle).then(|| "radian".to_owned());
    let factor = |(power, base): (tumble_expr::Exponent, &str)| format!("{base}^{power}");
    let factors = powers.into_iter().filter(|(power, _)| *power.numer() != 0).map(factor);
    let factors: Vec<_> = angle.into_iter().chain(factors).collect();
    if factors.is_empty() { "1".to_owned() } else { factors.join(" ") }
}

/// How many SI units the library takes one of the unit for, and whether it knows that exactly.
fn by_the_library(unit: &NamedUnit) -> (BigRational, bool) {
    let question = format!("1 {} to {} to fraction", called(unit), si(unit));
    let answer = fend_core::evaluate(&question, &mut fend_core::Context::new());
    let answer = answer.unwrap_or_else(|error| panic!("{question}: {error}")).get_main_result().to_owned();
    let (number, exact) =
        answer.strip_prefix("approx. ").map_or((answer.as_str(), true), |number| (number, false));
    let number = number.split(' ').next().unwrap_or_default();
    let ratio = number.parse().unwrap_or_else(|error| panic!("{question}: {answer}: {error}"));
    (ratio, exact)
}

#[test]
fn every_factor_is_the_librarys() {
    for unit in UNITS {
        let (expected, exact) = by_the_library(unit);
        if unit.pi == 0 {
            assert!(exact, "{}", unit.symbol);
            assert_eq!(unit.ratio(), expected, "{}", unit.symbol);
        } else {
            let found = unit.ratio().to_f64().expect("finite") * std::f64::consts::PI.powi(unit.pi);
            let expected = expected.to_f64().expect("finite");
            assert!((found / expected - 1.0).abs() < ROUNDING, "{}: {found} is not {expected}", unit.symbol);
        }
    }
}

#[test]
fn the_units_that_mechanics_is_written_with_are_there() {
    let families = [
        "m km cm mm um nm in ft yd mile",
        "kg g mg t lb",
        "s ms us min h day",
        "rad mrad deg rev rpm Hz kHz",
        "N mN kN MN lbf kgf",
        "J mJ kJ MJ cal Wh kWh",
        "W mW kW MW hp",
        "Pa hPa kPa MPa GPa bar atm psi",
        "L mL mph knot %",
    ];
    for symbol in families.iter().flat_map(|family| family.split(' ')) {
        assert!(UNITS.iter().any(|unit| unit.symbol == symbol), "{symbol}");
    }
}
