//! A formula as its writer has it: nothing is worked out, names have their symbols.

use tumble_expr::language::{BinaryOperator as Sign, Formula, Span, Syntax};

use crate::layout::{Math, Operator};
use crate::symbol::Identifier;

/// Functions that stand before one letter without brackets.
const BARE: [&str; 4] = ["sin", "cos", "tan", "log"];

/// The mathematics of a formula; `symbol` says what stands for a name.
pub fn as_written(formula: &Formula, symbol: &dyn Fn(&str) -> Math) -> Math {
    let text = |span: &Span| &formula.text()[span.clone()];
    let mut parts: Vec<Math> = vec![];
    // Each node stands behind those that it is made of.
    for node in &formula.tree().nodes {
        let part = |id: &usize| parts[*id].clone();
        parts.push(match &node.syntax {
            Syntax::Quantity { .. } => quantity(text(&node.span)),
            Syntax::Name(span) => symbol(text(span)),
            Syntax::Sign { minus: false, operand } => part(operand),
            Syntax::Sign { minus: true, operand } => part(operand).into_term().negative(),
            Syntax::Infix(sign, left, right) => infix(*sign, part(left), part(right)),
            Syntax::Call(span, arguments) => call(text(span), arguments.iter().map(part).collect()),
            Syntax::Vector(rows) => Math::Matrix(rows.iter().map(|row| vec![part(row)]).collect()),
            Syntax::Broken => Math::Text(text(&node.span).to_owned()),
        });
    }
    parts.pop().unwrap_or_else(|| Math::Text(formula.text().to_owned()))
}

fn quantity(text: &str) -> Math {
    let text = text.trim_matches(['(', ')', ' ']);
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = (Math::Number(text[..end].to_owned()), text[end..].trim());
    match unit {
        "" => number,
        unit => Math::Product(vec![
            number,
            Math::Text(unit.replace("^2", "²").replace("^3", "³").replace('*', "·")),
        ]),
    }
}

fn infix(sign: Sign, left: Math, right: Math) -> Math {
    let listed = |math: Math| if let Math::Row(terms) = math { terms } else { vec![math] };
    let row = |operator: Operator, left: Math, right: Vec<Math>| {
        let operator = std::iter::once(Math::Operator(operator));
        Math::Row(listed(left).into_iter().chain(operator).chain(right).collect())
    };
    match sign {
        // Brackets around a sum that is added say nothing.
        Sign::Plus => row(Operator::Plus, left, listed(right)),
        Sign::Minus => row(Operator::Minus, left, vec![right.into_term()]),
        Sign::Times => {
            let factors = |math: Math| match math.into_term() {
                Math::Product(factors) => factors,
                other => vec![other],
            };
            Math::Product(factors(left).into_iter().chain(factors(right)).collect())
        }
        Sign::Divide => left.over(right),
        Sign::Power => match left {
            Math::Call { function, power: None, arguments, bare: true } => {
                Math::Call { function, power: Some(Box::new(right)), arguments, bare: true }
            }
            Math::Identifier(_) | Math::Number(_) | Math::Bars(_) => left.raised_to(right),
            other => other.bracketed().raised_to(right),
        },
        Sign::Less => row(Operator::Less, left, vec![right]),
        Sign::LessEqual => row(Operator::LessEqual, left, vec![right]),
        Sign::Greater => row(Operator::Less, right, vec![left]),
        Sign::GreaterEqual => row(Operator::LessEqual, right, vec![left]),
    }
}

fn call(name: &str, mut arguments: Vec<Math>) -> Math {
    match (name, &arguments[..]) {
        ("sqrt", [_]) => Math::Root(Box::new(arguments.remove(0))),
        ("abs" | "norm", [_]) => Math::Bars(Box::new(arguments.remove(0))),
        ("dot", [_, _]) => {
            let [left, right] = [0, 1].map(|side| arguments[side].clone().into_term());
            Math::Row(vec![left, Math::Operator(Operator::Dot), right])
        }
        _ => Math::Call {
            bare: BARE.contains(&name) && matches!(arguments[..], [Math::Identifier(_)]),
            function: Identifier::parse(name),
            power: None,
            arguments,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::text;
    use tumble_expr::language::parse;

    fn shown(formula: &str) -> String {
        text(&as_written(&parse(formula).expect("a formula"), &|name| Math::symbol(&name.replace('.', "_"))))
    }

    #[test]
    fn a_formula_stands_as_it_was_written() {
        assert_eq!(shown("sqrt(rod.vx^2 + 2*m*(1 - cos(a))/I)"), "√(rod_vx² + 2 m (1 − cos a)/I)");
        assert_eq!(shown("a - (b - c)"), "a − (b − c)");
        assert_eq!(shown("-(a + b)^2"), "−(a + b)²");
        assert_eq!(shown("a + (b + c) + 3 m/s"), "a + b + c + 3 m/s");
        assert_eq!(shown("sin(a)^2"), "sin² a");
        assert_eq!(shown("felt(x)*w"), "felt(x) w");
        assert_eq!(shown("2 < x"), "2 < x");
    }
}
