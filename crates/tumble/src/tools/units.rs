//! `tumble units`: the table of units, one unit, or a quantity in other units.

use tumble_expr::language::{
    Code, Formula, FormulaError, NamedUnit, Scope, StatedUnit, UNITS, UnitTag, Value, parse, unit,
};
use tumble_expr::{Dimension, Expr};
use tumble_mech::Parameters;
use tumble_scene::{Diagnostic, Diagnostics, Severity, SourceText, Underlined};

use super::say::{colour, say, tell, width, wrapped};
use crate::commands::Ending;

/// Chains of units that people use beside those of the table.
const CHAINS: &[&str] = &[
    "km/h", "cm/s", "ft/s", "cm/s^2", "ft/s^2", "cm^2", "ft^2", "cm^3", "ft^3", "g/cm^3", "kg/L", "lb/ft^3",
    "g*cm^2", "lb*ft^2", "N*m", "lbf*ft", "lbf*in", "kgf*m", "N/m", "N/mm", "lbf/in", "lbf/ft", "deg/s",
    "rev/s", "deg/s^2", "rev/s^2", "g/m", "lb/ft",
];

/// Digits that are shown of a value that was converted.
const DIGITS: usize = 12;

/// Values beyond this are of no everyday size, and their unit is left out.
const EVERYDAY: std::ops::RangeInclusive<f64> = 1e-3..=1e6;

/// Answers what the words of the command line ask for.
pub(crate) fn run(words: &[String]) -> Ending {
    let asked = words.join(" ");
    let asked = asked.trim();
    let of_measure: Vec<_> = UNITS.iter().filter(|unit| is_of(unit, asked)).collect();
    match unit(asked) {
        _ if asked.is_empty() => say!("{}", table(&UNITS.iter().collect::<Vec<_>>())),
        Some(unit) => say!("{}", one(unit)),
        None if !of_measure.is_empty() => say!("{}", table(&of_measure)),
        None => return converted(asked),
    }
    Ending::Success
}

/// Whether the unit measures that: `energy` is enough for `energy, torque`.
fn is_of(unit: &NamedUnit, measure: &str) -> bool {
    unit.measure() == measure || unit.measure().split(", ").any(|part| part == measure)
}

/// Units by what they measure, each with its factor; who fixed it stands below.
fn table(units: &[&NamedUnit]) -> String {
    let longest = units.iter().map(|unit| factor(unit).chars().count()).max().unwrap_or(0);
    let (mut lines, mut sources): (Vec<String>, Vec<&str>) = (vec![], vec![]);
    for (index, unit) in units.iter().enumerate() {
        if index == 0 || units[index - 1].measure() != unit.measure() {
            let blank = if index == 0 { "" } else { "\n" };
            lines.push(format!("{blank}{}, in {}", unit.measure(), si(unit)));
        }
        let note = note(unit.source, &mut sources);
        lines.push(format!("  {:<5}{:<longest$}  {}{note}", unit.symbol, factor(unit), unit.definition));
    }
    let footnotes = sources.iter().zip(1..).map(|(source, number)| format!("[{number}] {source}"));
    let blank = (!sources.is_empty()).then(String::new);
    lines.into_iter().chain(blank).chain(footnotes).collect::<Vec<_>>().join("\n")
}

/// The number of a source among those that are named below; the SI itself needs none.
fn note(source: &'static str, sources: &mut Vec<&'static str>) -> String {
    if source == "SI" {
        return String::new();
    }
    let known = sources.iter().position(|known| *known == source);
    let index = known.unwrap_or_else(|| {
        sources.push(source);
        sources.len() - 1
    });
    format!(" [{}]", index + 1)
}

fn one(unit: &NamedUnit) -> String {
    let others = UNITS.iter().filter(|other| other.measure() == unit.measure() && *other != unit);
    let others: Vec<_> = others.map(|other| other.symbol).collect();
    let others = match others.len() {
        0 => "the only unit of its kind".to_owned(),
        _ => wrapped(&format!("beside it: {}", others.join(" ")), width()),
    };
    format!(
        "{}: {}\n1 {} = {} {}, exactly\nmeasures: {}\nsource: {}\n{others}",
        unit.symbol,
        unit.definition,
        unit.symbol,
        factor(unit),
        si(unit),
        unit.measure(),
        unit.source
    )
}

/// The factor to SI units as it is exact: `0.3048`, `1852/3600`, `pi/180`.
fn factor(unit: &NamedUnit) -> String {
    match (unit.pi, unit.factor.strip_prefix("1/")) {
        (0, _) => unit.factor.to_owned(),
        (_, Some(divisor)) => format!("pi/{divisor}"),
        (_, None) => format!("{}*pi", unit.factor),
    }
}

/// The unit of the table that is one SI unit, or the chain of base units.
fn si(of: &NamedUnit) -> String {
    let coherent =
        UNITS.iter().find(|unit| unit.measure() == of.measure() && unit.factor == "1" && unit.pi == 0);
    let radian = if of.tag == UnitTag::Angle { "rad" } else { "" };
    match coherent {
        Some(unit) => unit.symbol.to_owned(),
        None => chain(of.dimension, radian),
    }
}

fn chain(dimension: Dimension, radian: &str) -> String {
    let text = dimension.to_string();
    if radian.is_empty() { text } else { radian.to_owned() + text.strip_prefix('1').unwrap_or(&text) }
}

/// A quantity such as `3 ft/s`, or a chain of units without its number, in SI units and in others.
fn converted(asked: &str) -> Ending {
    let numbered = asked.starts_with(|c: char| c.is_ascii_digit() || "+-.([".contains(c));
    let with_one = format!("1 {asked}");
    // A word that is neither a unit nor a measure was meant for a unit.
    let text = if numbered || parse(&with_one).is_err() { asked } else { &with_one };
    match quantity(text) {
        Ok(quantity) => {
            say!("{}", quantity.lines(text).join("\n"));
            Ending::Success
        }
        Err(mistakes) => {
            tell!("{}", rendered(text, mistakes).trim_end());
            Ending::Mistake
        }
    }
}

/// The mistakes as those of a scene are shown.
fn rendered(text: &str, mistakes: Vec<FormulaError>) -> String {
    let list = mistakes.into_iter().map(|mistake| Diagnostic {
        severity: Severity::Error,
        code: mistake.code.into(),
        message: mistake.message,
        source: 0,
        labels: mistake.labels.into_iter().map(|(span, text)| Underlined { span, text }).collect(),
        help: mistake.help,
    });
    let sources = vec![SourceText { name: "the quantity".to_owned(), text: text.to_owned() }];
    Diagnostics { sources, list: list.collect() }.render(colour(&std::io::stderr()), width())
}

/// What a text came to.
struct Quantity {
    /// SI units.
    value: f64,
    dimension: Dimension,
    stated: StatedUnit,
}

fn quantity(text: &str) -> Result<Quantity, Vec<FormulaError>> {
    let formula = parse(text)?;
    let value = formula.check(&Scope::new())?;
    let dimension = match &value {
        Value::Scalar(number) => number.dimension().ok(),
        Value::Vector(_) => None,
    };
    let dimension = dimension.ok_or_else(|| vec![no_number(&formula, &value)])?;
    let number = formula.number(value, dimension)?;
    let value = size(&number).filter(|value| value.is_finite()).ok_or_else(|| vec![not_finite(&formula)])?;
    Ok(Quantity { value, dimension, stated: formula.stated_unit() })
}

fn no_number(formula: &Formula, found: &Value) -> FormulaError {
    let message = format!("expected a quantity, found {}", found.describe());
    FormulaError::new(Code::Shape, 0..formula.text().len(), message)
}

fn not_finite(formula: &Formula) -> FormulaError {
    FormulaError::new(Code::Magnitude, 0..formula.text().len(), "this is not a finite number")
}

fn size(formula: &Expr) -> Option<f64> {
    Parameters::default().evaluate(std::slice::from_ref(formula)).ok()?.first().copied()
}

impl Quantity {
    /// `3 ft/s = 0.9144 m/s`, and a line for each other unit of everyday size.
    fn lines(&self, text: &str) -> Vec<String> {
        let in_units = |(unit, size): (String, f64)| (rounded(self.value / size), unit);
        let radian = if self.stated == StatedUnit::Angle { "rad" } else { "" };
        let si = (rounded(self.value), chain(self.dimension, radian));
        let others =
            self.others().into_iter().filter(|(_, size)| EVERYDAY.contains(&(self.value / size).abs()));
        let all: Vec<_> = std::iter::once(si).chain(others.map(in_units)).collect();
        let longest = all.iter().map(|(number, _)| number.chars().count()).max().unwrap_or(0);
        let line = |(number, unit): &(String, String)| {
            let unit = if self.dimension == Dimension::NONE && unit == "1" { "" } else { unit };
            format!("  = {number:>longest$} {unit}").trim_end().to_owned()
        };
        std::iter::once(text.trim().to_owned()).chain(all.iter().map(line)).collect()
    }

    /// Other units of the dimension with their sizes, SI units; those of angles only for angles.
    fn others(&self) -> Vec<(String, f64)> {
        let named = UNITS.iter().map(|unit| unit.symbol);
        let fits = |text: &&str| {
            let stated = parse(&format!("1 {text}")).map(|formula| formula.stated_unit());
            let special = |unit| matches!(unit, StatedUnit::Angle | StatedUnit::Frequency);
            stated.is_ok_and(|other| other == self.stated || (!special(other) && !special(self.stated)))
        };
        let size = |text: &str| Some((text.to_owned(), quantity(&format!("1 {text}")).ok()?));
        let sized = named.chain(CHAINS.iter().copied()).filter(fits).filter_map(size);
        let alike = sized.filter(|(text, one)| {
            one.dimension == self.dimension
                && *text != chain(self.dimension, "")
                && text != "rad"
                && text != "%"
        });
        alike.map(|(text, one)| (text, one.value)).collect()
    }
}

/// The number in so many digits, zeros behind it left out.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.*e}", DIGITS - 1);
    let number: f64 = digits.parse().unwrap_or(value);
    let ordinary = number == 0.0 || (1e-5..1e15).contains(&number.abs());
    if ordinary { format!("{number}") } else { format!("{number:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_chain_is_one_of_units() {
        for text in CHAINS {
            assert!(quantity(&format!("1 {text}")).is_ok(), "{text}");
        }
    }

    #[test]
    fn every_unit_is_listed_once_with_its_measure() {
        let text = table(&UNITS.iter().collect::<Vec<_>>());
        for unit in UNITS {
            let line = format!("\n  {:<5}{}", unit.symbol, factor(unit));
            assert_eq!(text.matches(&line).count(), 1, "{line}");
        }
    }

    #[test]
    fn numbers_have_twelve_digits() {
        assert_eq!(rounded(0.1 + 0.2), "0.3");
        assert_eq!(rounded(1.0 / 3.0), "0.333333333333");
        assert_eq!(rounded(6.02e23), "6.02e23");
        assert_eq!(rounded(-0.0), "-0");
    }
}
