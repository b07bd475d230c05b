//! Mathematics as Typst, for PDF.

use crate::layout::{Mark, Math, Operator};
use crate::symbol::Identifier;

/// Typst for mathematics mode, without the dollar signs. Names and words stand between quotes; the only functions
/// that are called are those of mathematics.
pub fn typst(math: &Math) -> String {
    match math {
        Math::Row(parts) => parts.iter().map(typst).collect::<Vec<_>>().join(" "),
        Math::Product(factors) => factors.iter().map(typst).collect::<Vec<_>>().join(" thin "),
        Math::Number(digits) => number(digits),
        Math::Identifier(identifier) => name(identifier, &head(identifier)),
        Math::Operator(operator) => sign(*operator).to_owned(),
        Math::Text(words) => quoted(words),
        Math::Fraction(above, below) => format!("frac({}, {})", typst(above), typst(below)),
        Math::Power(of, exponent) => format!("{}^({})", base(of), typst(exponent)),
        Math::Root(inside) => format!("sqrt({})", typst(inside)),
        Math::Bars(inside) => format!("abs({})", typst(inside)),
        Math::Brackets(inside) => format!("({})", typst(inside)),
        Math::Call { function, power, arguments, bare } => call(function, power.as_deref(), arguments, *bare),
        Math::Cases(cases) => {
            let cases: Vec<String> = cases.iter().map(case).collect();
            format!("cases({})", cases.join(", "))
        }
        Math::Derivative { of, order, mark } => derivative(of, *order, *mark),
        Math::Matrix(rows) => {
            let rows: Vec<String> =
                rows.iter().map(|row| row.iter().map(typst).collect::<Vec<_>>().join(", ")).collect();
            format!("mat({})", rows.join("; "))
        }
        Math::Integral { of, over, limits } => {
            let [from, to] = limits.each_ref().map(typst);
            format!("integral_({from})^({to}) {} thin dif {}", typst(of), typst(over))
        }
        Math::Component(of, index) => format!("{}_({index})", base(of)),
    }
}

fn sign(operator: Operator) -> &'static str {
    match operator {
        Operator::Plus => "+",
        Operator::Minus | Operator::Negative => "−",
        Operator::Equals => "=",
        Operator::Less => "<",
        Operator::LessEqual => "≤",
        Operator::Times => "dot.op",
        // A bare slash would make a fraction.
        Operator::Over => "slash",
        Operator::Cross => "times",
    }
}

/// Digits as they are; a number that is cut off ends in dots, which are no digits.
fn number(digits: &str) -> String {
    if digits.chars().all(|c| c.is_ascii_digit() || c == '.') { digits.to_owned() } else { quoted(digits) }
}

/// What a power or an index refers to: it must be one thing, and a power of a power stands in brackets.
fn base(math: &Math) -> String {
    match math {
        Math::Number(_) | Math::Brackets(_) | Math::Bars(_) | Math::Identifier(_) => typst(math),
        _ => format!("({})", typst(math)),
    }
}

fn head(identifier: &Identifier) -> String {
    match (identifier.is_italic(), letter(&identifier.head)) {
        (true, Some(letter)) => letter.to_string(),
        (true, None) => format!("italic({})", quoted(&identifier.head)),
        (false, _) => quoted(&identifier.head),
    }
}

/// The only character, if it is a letter.
fn letter(text: &str) -> Option<char> {
    let mut characters = text.chars();
    characters.next().filter(|c| c.is_alphabetic() && characters.next().is_none())
}

fn name(identifier: &Identifier, head: &str) -> String {
    if identifier.subscript.is_empty() {
        return head.to_owned();
    }
    let part = |part: &String| letter(part).map_or_else(|| quoted(part), String::from);
    let parts: Vec<String> = identifier.subscript.iter().map(part).collect();
    format!("{head}_({})", parts.join(","))
}

fn call(function: &Identifier, power: Option<&Math>, arguments: &[Math], bare: bool) -> String {
    let head = format!("op({})", quoted(&function.head));
    let mut text = name(function, &head);
    if let Some(power) = power {
        text = format!("{text}^({})", typst(power));
    }
    let arguments = arguments.iter().map(typst).collect::<Vec<_>>().join(", ");
    // The space keeps brackets from being read as a subscript's or a call's.
    if bare { format!("{text} {arguments}") } else { format!("{text} ({arguments})") }
}

fn case((value, condition): &(Math, Option<Math>)) -> String {
    match condition {
        Some(condition) => format!("{} & \"if \" {}", typst(value), typst(condition)),
        None => format!("{} & \"otherwise\"", typst(value)),
    }
}

fn derivative(of: &Identifier, order: u8, mark: Mark) -> String {
    let plain = head(of);
    let marked = match (mark, order) {
        (Mark::Dots, 1) => format!("dot({plain})"),
        (Mark::Dots, 2) => format!("dot.double({plain})"),
        _ => format!("{plain}{}", "'".repeat(usize::from(order))),
    };
    name(of, &marked)
}

/// A string of Typst: whatever is in it is shown as it is.
fn quoted(text: &str) -> String {
    let escape = |c: char| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() => " ".to_owned(),
        _ => c.to_string(),
    };
    format!("\"{}\"", text.chars().map(escape).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_and_letters() {
        assert_eq!(typst(&Math::symbol("theta")), "θ");
        assert_eq!(typst(&Math::symbol("v_max")), "v_(\"max\")");
        assert_eq!(typst(&Math::symbol("rod.tip.vx")), "v_(x,\"rod.tip\")");
        assert_eq!(typst(&Math::derivative("theta", 2, Mark::Dots)), "dot.double(θ)");
        assert_eq!(typst(&Math::derivative("theta", 2, Mark::Primes)), "θ''");
        assert_eq!(typst(&Math::symbol("x").over(Math::digits(2))), "frac(x, 2)");
        assert_eq!(typst(&Math::symbol("|u|")), "abs(u)");
    }

    #[test]
    fn powers_take_brackets_as_they_need_them() {
        let (x, two) = (|| Math::symbol("x"), || Math::digits(2));
        assert_eq!(typst(&x().raised_to(two())), "x^(2)");
        assert_eq!(typst(&x().raised_to(two()).raised_to(two())), "(x^(2))^(2)");
        assert_eq!(typst(&Math::product(vec![x(), two()]).raised_to(two())), "(x thin 2)^(2)");
    }

    #[test]
    fn names_cannot_become_commands() {
        assert_eq!(typst(&Math::symbol("50%$")), "\"50%$\"");
        assert_eq!(typst(&Math::Text("#panic(\"a\\b\")".to_owned())), "\"#panic(\\\"a\\\\b\\\")\"");
        assert_eq!(typst(&Math::Number("0.33…".to_owned())), "\"0.33…\"");
    }
}
