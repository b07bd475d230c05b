//! Mathematics as LaTeX, for Markdown.

use crate::layout::Math;
use crate::symbol::{self, Identifier};

/// Functions that LaTeX knows by name.
const KNOWN: [&str; 13] =
    ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "sinh", "cosh", "tanh", "ln", "exp", "min", "max"];

/// LaTeX for mathematics mode, without the dollar signs.
pub fn latex(math: &Math) -> String {
    match math {
        Math::Row(parts) => parts.iter().map(latex).collect(),
        Math::Product(factors) => factors.iter().map(latex).collect::<Vec<_>>().join(" \\, "),
        Math::Number(digits) => digits.replace('…', "\\ldots ").replace('\u{2009}', "\\,"),
        Math::Identifier(identifier) => name(identifier, &head(identifier)),
        Math::Operator(operator) => operator.latex().to_owned(),
        Math::Text(words) => format!("\\text{{{}}}", escaped(words)).replace("\\text{}", ""),
        Math::Fraction(above, below) => format!("\\frac{{{}}}{{{}}}", latex(above), latex(below)),
        Math::Power(of, exponent) => format!("{}^{{{}}}", base(of), latex(exponent)),
        Math::Root(inside) => format!("\\sqrt{{{}}}", latex(inside)),
        Math::Bars(inside) => format!("\\left| {} \\right|", latex(inside)),
        Math::Brackets(inside) => format!("\\left( {} \\right)", latex(inside)),
        Math::Call { function, power, arguments, bare } => call(function, power.as_deref(), arguments, *bare),
        Math::Cases(cases) => {
            let cases: Vec<String> = cases.iter().map(case).collect();
            format!("\\begin{{cases}} {} \\end{{cases}}", cases.join(" \\\\ "))
        }
        Math::Derivative { of, order } => derivative(of, *order),
        Math::Matrix(rows) => {
            let rows: Vec<String> =
                rows.iter().map(|row| row.iter().map(latex).collect::<Vec<_>>().join(" & ")).collect();
            format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.join(" \\\\ "))
        }
        Math::Integral { of, over, limits } => {
            let [from, to] = limits.each_ref().map(latex);
            format!("\\int_{{{from}}}^{{{to}}} {} \\, \\mathrm{{d}}{}", latex(of), latex(over))
        }
        Math::Component(of, index) => format!("{}_{{{index}}}", base(of)),
    }
}

/// What a power refers to: more than one sign must stand in braces, and a power of a power in brackets.
fn base(math: &Math) -> String {
    match math {
        Math::Number(_) | Math::Brackets(_) | Math::Bars(_) => latex(math),
        Math::Identifier(_) => format!("{{{}}}", latex(math)),
        _ => format!("\\left( {} \\right)", latex(math)),
    }
}

fn head(identifier: &Identifier) -> String {
    if let Some(greek) = symbol::greek_name(&identifier.head) {
        return format!("\\{greek}");
    }
    let text = escaped(&identifier.head);
    match identifier.head.chars().count() {
        1 if identifier.is_italic() => text,
        _ if identifier.is_italic() => format!("\\mathit{{{text}}}"),
        _ => format!("\\mathrm{{{text}}}"),
    }
}

fn name(identifier: &Identifier, head: &str) -> String {
    if identifier.subscript.is_empty() {
        return head.to_owned();
    }
    let parts: Vec<String> = identifier.subscript.iter().map(|part| subscript(part)).collect();
    format!("{head}_{{{}}}", parts.join(","))
}

fn subscript(part: &str) -> String {
    if let Some(greek) = symbol::greek_name(part) {
        return format!("\\{greek}");
    }
    let plain = part.chars().all(|c| c.is_ascii_digit()) || part.chars().count() == 1;
    if plain { escaped(part) } else { format!("\\mathrm{{{}}}", escaped(part)) }
}

fn call(function: &Identifier, power: Option<&Math>, arguments: &[Math], bare: bool) -> String {
    let known = function.subscript.is_empty() && KNOWN.contains(&function.head.as_str());
    let mut text = match known {
        true => format!("\\{}", function.head),
        false => {
            let head = format!("\\operatorname{{{}}}", escaped(&function.head));
            name(function, &head)
        }
    };
    if let Some(power) = power {
        text = format!("{text}^{{{}}}", latex(power));
    }
    let arguments = arguments.iter().map(latex).collect::<Vec<_>>().join(", ");
    if bare { format!("{text} {arguments}") } else { format!("{text}\\left( {arguments} \\right)") }
}

fn case((value, condition): &(Math, Option<Math>)) -> String {
    match condition {
        Some(condition) => format!("{} & \\text{{if }} {}", latex(value), latex(condition)),
        None => format!("{} & \\text{{otherwise}}", latex(value)),
    }
}

fn derivative(of: &Identifier, order: u8) -> String {
    format!("{}{}", name(of, &head(of)), "'".repeat(usize::from(order)))
}

/// Characters that LaTeX reads as commands become themselves.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '#' | '$' | '%' | '&' | '_' | '{' | '}' => format!("\\{c}"),
        '\\' => "\\backslash{}".to_owned(),
        '^' => "\\hat{}".to_owned(),
        '~' => "\\sim{}".to_owned(),
        // An exponent of a unit within text.
        '²' => "}^{2}\\text{".to_owned(),
        '³' => "}^{3}\\text{".to_owned(),
        _ => c.to_string(),
    };
    text.chars().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_and_braces() {
        assert_eq!(latex(&Math::symbol("theta")), "\\theta");
        assert_eq!(latex(&Math::symbol("v_max")), "v_{\\mathrm{max}}");
        assert_eq!(latex(&Math::derivative("theta", 2)), "\\theta''");
        assert_eq!(latex(&Math::symbol("x").over(Math::digits(2))), "\\frac{x}{2}");
        assert_eq!(latex(&Math::symbol("|u|")), "\\left| u \\right|");
    }

    #[test]
    fn names_cannot_become_commands() {
        assert_eq!(latex(&Math::symbol("50%$")), "\\mathrm{50\\%\\$}");
        assert_eq!(latex(&Math::Text("a_b{}".to_owned())), "\\text{a\\_b\\{\\}}");
    }
}
