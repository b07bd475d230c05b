//! Units as print shows them.

/// A piece of a unit: a name, and its exponent as text, empty for 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct UnitPart {
    /// What stands between the previous factor and this one: nothing, `·` or `/`.
    pub(crate) separator: &'static str,
    /// The unit's sign.
    pub(crate) name: String,
    /// The exponent with a true minus sign; empty for 1.
    pub(crate) exponent: String,
}

/// Takes a unit such as `kg*m^2/s` apart.
pub(crate) fn unit_parts(unit: &str) -> Vec<UnitPart> {
    let mut parts = Vec::new();
    let mut separator = "";
    let mut rest = unit.trim();
    while !rest.is_empty() {
        let end = rest.find(['*', '/', ' ', '·']).unwrap_or(rest.len());
        let (factor, tail) = rest.split_at(end);
        if !factor.is_empty() {
            parts.push(unit_part(separator, factor));
        }
        let mut signs = tail.chars();
        separator = match signs.next() {
            Some('/') => "/",
            // A blank before another sign, as in "m / s", means that sign.
            Some(' ') if signs.as_str().trim_start().starts_with(['/', '*', '·']) => separator,
            Some(' ') if factor.is_empty() => separator,
            _ => "·",
        };
        rest = signs.as_str();
    }
    parts
}

fn unit_part(separator: &'static str, factor: &str) -> UnitPart {
    let (name, exponent) = factor.split_once('^').unwrap_or((factor, ""));
    let name = match name {
        "deg" => "°",
        "um" => "µm",
        "ohm" => "Ω",
        name => name,
    };
    UnitPart { separator, name: name.to_owned(), exponent: exponent.replace('-', MINUS) }
}

/// The true minus sign; a hyphen is too short beside figures.
pub(crate) const MINUS: &str = "−";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_come_apart() {
        let text = |unit: &str| {
            let parts = unit_parts(unit);
            parts.iter().map(|p| format!("{}{}({})", p.separator, p.name, p.exponent)).collect::<String>()
        };
        assert_eq!(text("m/s^2"), "m()/s(2)");
        assert_eq!(text("kg*m^2/s"), "kg()·m(2)/s()");
        assert_eq!(text("N m"), "N()·m()");
        assert_eq!(text("m / s"), "m()/s()");
        assert_eq!(text("s^-1"), "s(−1)");
        assert_eq!(text("1/s"), "1()/s()");
        assert_eq!(text(""), "");
    }
}
