//! Mathematics on one line of Unicode text.

use crate::layout::{Math, Operator};
use crate::symbol::Identifier;

/// One line, such as `θ″ = −(3 g/(2 L)) sin θ`.
pub fn text(math: &Math) -> String {
    match math {
        Math::Row(parts) => parts.iter().map(text).collect(),
        Math::Product(factors) => factors.iter().map(factor).collect::<Vec<_>>().join(" "),
        Math::Number(digits) | Math::Text(digits) => digits.clone(),
        Math::Identifier(identifier) => name(identifier),
        Math::Operator(operator) => operator.text().to_owned(),
        Math::Fraction(above, below) => format!("{}/{}", numerator(above), denominator(below)),
        Math::Power(of, exponent) => raised(&base(of), exponent),
        Math::Root(inside) => format!("√{}", base(inside)),
        Math::Bars(inside) => format!("|{}|", text(inside)),
        Math::Brackets(inside) => format!("({})", text(inside)),
        Math::Call { function, power, arguments, bare } => call(function, power.as_deref(), arguments, *bare),
        Math::Cases(cases) => {
            let cases: Vec<String> = cases.iter().map(case).collect();
            format!("{{{}}}", cases.join("; "))
        }
        Math::Derivative { of, order } => derivative(of, *order),
        Math::Matrix(rows) => {
            let rows: Vec<String> =
                rows.iter().map(|row| row.iter().map(text).collect::<Vec<_>>().join(", ")).collect();
            format!("({})", rows.join("; "))
        }
        Math::Integral { of, over, limits } => {
            let [from, to] = limits.each_ref().map(base);
            format!("∫_{from}^{to} {} d{}", text(of), text(over))
        }
        Math::Component(of, index) => format!("{}_{index}", base(of)),
    }
}

/// As a factor: a fraction needs brackets where a line of fractions would be read otherwise.
fn factor(math: &Math) -> String {
    match math {
        Math::Row(parts) if parts.get(1) == Some(&Math::Operator(Operator::Times)) => text(math),
        Math::Fraction(..) | Math::Row(_) => format!("({})", text(math)),
        _ => text(math),
    }
}

fn numerator(math: &Math) -> String {
    match math {
        Math::Row(_) | Math::Fraction(..) => format!("({})", text(math)),
        // What follows a function's name up to the line would be its argument.
        Math::Call { bare: true, .. } => format!("({})", text(math)),
        Math::Product(factors) if matches!(factors.last(), Some(Math::Call { bare: true, .. })) => {
            format!("({})", text(math))
        }
        _ => text(math),
    }
}

fn denominator(math: &Math) -> String {
    match math {
        Math::Power(..) | Math::Root(_) => text(math),
        _ => base(math),
    }
}

/// The base of a power or what stands under a root.
fn base(math: &Math) -> String {
    match math {
        Math::Row(_) | Math::Product(_) | Math::Fraction(..) | Math::Power(..) | Math::Root(_) => {
            format!("({})", text(math))
        }
        Math::Call { bare: true, .. } => format!("({})", text(math)),
        _ => text(math),
    }
}

fn raised(base: &str, exponent: &Math) -> String {
    let exponent = text(exponent);
    let small: Option<String> = exponent.chars().map(superscript).collect();
    small.map_or_else(|| format!("{base}^({exponent})"), |small| format!("{base}{small}"))
}

fn superscript(c: char) -> Option<char> {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    match c {
        '−' => Some('⁻'),
        _ => c.to_digit(10).map(|digit| digits[digit as usize]),
    }
}

fn name(identifier: &Identifier) -> String {
    let subscript = identifier.subscript_text();
    if subscript.is_empty() {
        return identifier.head.clone();
    }
    let digits: Option<String> = subscript.chars().map(|c| subscript_digit(c).filter(|_| c != ',')).collect();
    match digits {
        Some(digits) => format!("{}{digits}", identifier.head),
        None if subscript.contains(',') => format!("{}_({subscript})", identifier.head),
        None => format!("{}_{subscript}", identifier.head),
    }
}

fn subscript_digit(c: char) -> Option<char> {
    let digits = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    c.to_digit(10).map(|digit| digits[digit as usize])
}

fn call(function: &Identifier, power: Option<&Math>, arguments: &[Math], bare: bool) -> String {
    let mut head = name(function);
    if let Some(power) = power {
        head = raised(&head, power);
    }
    let arguments = arguments.iter().map(text).collect::<Vec<_>>().join(", ");
    if bare { format!("{head} {arguments}") } else { format!("{head}({arguments})") }
}

fn case((value, condition): &(Math, Option<Math>)) -> String {
    match condition {
        Some(condition) => format!("{} if {}", text(value), text(condition)),
        None => format!("{} otherwise", text(value)),
    }
}

fn derivative(of: &Identifier, order: u8) -> String {
    name(&Identifier { head: format!("{}{}", of.head, primes(order)), ..of.clone() })
}

/// The sign of a derivative of that order.
pub(crate) fn primes(order: u8) -> String {
    let known = ["", "′", "″", "‴"].get(usize::from(order));
    known.map_or_else(|| "′".repeat(usize::from(order)), |sign| (*sign).to_owned())
}
