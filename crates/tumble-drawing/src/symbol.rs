//! From names as scenes spell them to symbols and units as print shows them.

/// Greek letters by name. Names of letters that look Latin are left out.
const GREEK: [(&str, char); 34] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("pi", 'π'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("upsilon", 'υ'),
    ("phi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Xi", 'Ξ'),
    ("Pi", 'Π'),
    ("Sigma", 'Σ'),
    ("Upsilon", 'Υ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
];

/// A name taken apart: a letter or word, and what belongs below the line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// The main letter (Greek already replaced) or a word.
    pub head: String,
    /// The subscript; empty if there is none.
    pub subscript: String,
}

impl Symbol {
    /// Takes a name apart: `omega0` is ω with subscript 0, `v_max` is v with subscript max.
    pub fn parse(name: &str) -> Self {
        if let Some((head, subscript)) = name.split_once('_').filter(|(h, s)| !h.is_empty() && !s.is_empty())
        {
            let subscript = subscript.split('_').map(greek).collect::<Vec<_>>().join(",");
            return Self { head: greek(head), subscript };
        }
        let head = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let (head, digits) = if head.is_empty() { (name, "") } else { name.split_at(head.len()) };
        Self { head: greek(head), subscript: digits.to_owned() }
    }
}

/// Whether print sets the word in italics: single letters stand for
/// quantities, and so do short ones such as `dt`; longer words are words.
pub fn is_quantity(word: &str) -> bool {
    word.chars().all(char::is_alphabetic) && word.chars().count() <= 2
}

/// The Greek letter of that name, or the name itself.
fn greek(name: &str) -> String {
    let letter = GREEK.iter().find(|(known, _)| *known == name);
    letter.map_or_else(|| name.to_owned(), |(_, letter)| letter.to_string())
}

/// A piece of a unit: a name, and its exponent as text, empty for 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitPart {
    /// What stands between the previous factor and this one: nothing, `·` or `/`.
    pub separator: &'static str,
    /// The unit's sign.
    pub name: String,
    /// The exponent with a true minus sign; empty for 1.
    pub exponent: String,
}

/// Takes a unit such as `kg*m^2/s` apart.
pub fn unit_parts(unit: &str) -> Vec<UnitPart> {
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
pub const MINUS: &str = "−";

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(name: &str) -> (String, String) {
        let symbol = Symbol::parse(name);
        (symbol.head, symbol.subscript)
    }

    #[test]
    fn names_become_letters_and_subscripts() {
        for (name, head, subscript) in [
            ("theta", "θ", ""),
            ("w1", "w", "1"),
            ("omega0", "ω", "0"),
            ("v_x", "v", "x"),
            ("I_cm", "I", "cm"),
            ("omega_rod_0", "ω", "rod,0"),
            ("Omega12", "Ω", "12"),
            ("mass", "mass", ""),
            ("42", "42", ""),
            ("_x", "_x", ""),
        ] {
            assert_eq!(parsed(name), (head.to_owned(), subscript.to_owned()), "{name}");
        }
    }

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
