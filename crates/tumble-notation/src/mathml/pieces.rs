//! Where a formula in a line of text may be broken.
//!
//! A line is broken before relations and before the terms of the outermost sum, or of a long sum in brackets that ends
//! a product. What is still too wide for a telephone is opened further: brackets at their terms, products between
//! factors, and a fraction is written as a factor before its numerator.

use super::{THIN_SPACE, element, is_tall, name, sign};
use crate::layout::{Math, Operator};

/// The widest piece that stays whole, in em: a line of a telephone has about 18.
const WIDEST: f64 = 16.0;
/// A sum of more signs than this in brackets is long: it may be broken wherever it stands.
const LONG: usize = 2;
/// Behind a space, a sign has its own space on its right only.
const SPACED: &str = "<mo form=\"infix\" lspace=\"0\" rspace=\"0.25em\">";
/// How a sign of two sides begins.
const INFIX: &str = "<mo form=\"infix\">";

/// What stays together.
struct Part {
    /// As MathML.
    shown: String,
    /// In em.
    width: f64,
    /// A line may be broken before it.
    begins: bool,
}

impl Part {
    fn of(math: &Math) -> Self {
        Self { shown: element(math), width: width(math), begins: false }
    }

    /// A bracket whose other half stands in another piece, as high as what is between asks for.
    fn fence(form: &str, sign: &str, tall: bool) -> Self {
        let size = if tall { "stretchy=\"true\" minsize=\"2.2em\"" } else { "stretchy=\"false\"" };
        let shown = format!(
            "<mo form=\"{form}\" fence=\"true\" {size} lspace=\"0.05em\" rspace=\"0.05em\">{sign}</mo>"
        );
        Self { shown, width: BRACKET, begins: false }
    }

    fn space() -> Self {
        Self { shown: THIN_SPACE.to_owned(), width: SPACE, begins: false }
    }
}

/// The terms of a formula in pieces, each the content of a `math` element.
pub(super) fn terms(math: &Math) -> Vec<Vec<String>> {
    let mut terms: Vec<Vec<Part>> = vec![vec![]];
    for part in outermost(math) {
        match terms.last_mut() {
            Some(last) if !matches!(part, Math::Operator(sign) if is_break(*sign)) => {
                last.extend(parts(part))
            }
            _ => terms.push(parts(part)),
        }
    }
    terms.into_iter().filter(|term| !term.is_empty()).map(pieces).collect()
}

/// Signs and what is between them, outside all brackets.
fn outermost(math: &Math) -> Vec<&Math> {
    match math {
        Math::Row(inside) => inside.iter().flat_map(outermost).collect(),
        _ => vec![math],
    }
}

fn pieces(parts: Vec<Part>) -> Vec<String> {
    let mut pieces: Vec<Vec<String>> = vec![vec![]];
    for part in parts {
        match pieces.last_mut() {
            Some(last) if !part.begins || last.is_empty() => last.push(part.shown),
            _ => pieces.push(vec![part.shown]),
        }
    }
    pieces.into_iter().map(joined).collect()
}

/// One piece in an element.
fn joined(mut parts: Vec<String>) -> String {
    if let Some(first) = parts.first_mut().filter(|first| first.starts_with(INFIX)) {
        *first = first.replacen(INFIX, SPACED, 1);
    }
    if parts.len() == 1 { parts.concat() } else { super::mrow(parts.concat()) }
}

fn parts(math: &Math) -> Vec<Part> {
    match math {
        Math::Row(inside) => inside.iter().flat_map(parts).collect(),
        Math::Operator(operator) => vec![Part { begins: is_break(*operator), ..Part::of(math) }],
        Math::Product(factors) if ends_long(factors) || is_wide(math) => product(factors),
        _ if !is_wide(math) => vec![Part::of(math)],
        Math::Brackets(inside) => between("(", inside, Part::fence("postfix", ")", is_tall(inside))),
        Math::Bars(inside) => between("|", inside, Part::fence("postfix", "|", is_tall(inside))),
        Math::Power(base, exponent) => powered(math, base, exponent),
        Math::Root(inside) => {
            let half = Math::Row(vec![Math::digits(1), Math::Operator(Operator::Over), Math::digits(2)]);
            raised(inside, &half)
        }
        Math::Fraction(above, below) => fraction(above, below),
        Math::Call { function, power: None, arguments, bare: false } if arguments.len() == 1 => {
            let head = Part {
                shown: name(function),
                width: width(&Math::Identifier(function.clone())),
                begins: false,
            };
            let inside = &arguments[0];
            let arguments = between("(", inside, Part::fence("postfix", ")", is_tall(inside)));
            [head].into_iter().chain(arguments).collect()
        }
        other => vec![Part::of(other)],
    }
}

fn is_break(operator: Operator) -> bool {
    use Operator::{Equals, Less, LessEqual, Minus, Plus};
    matches!(operator, Plus | Minus | Equals | Less | LessEqual)
}

/// Whether a product ends in a long sum, whose brackets need not grow.
fn ends_long(factors: &[Math]) -> bool {
    let Some(Math::Brackets(sum)) = factors.last() else { return false };
    let Math::Row(parts) = &**sum else { return false };
    let signs = parts.iter().filter(|part| matches!(part, Math::Operator(Operator::Plus | Operator::Minus)));
    signs.count() >= LONG && !is_tall(sum)
}

/// Factors, the last one open if it is a long sum, with breaks where the line would become too wide.
fn product(factors: &[Math]) -> Vec<Part> {
    let mut all: Vec<Part> = Vec::new();
    let mut filled = 0.0;
    for (index, factor) in factors.iter().enumerate() {
        let is_last = index + 1 == factors.len();
        let mut inside = match factor {
            Math::Brackets(sum) if is_last && ends_long(factors) => {
                between("(", sum, Part::fence("postfix", ")", false))
            }
            _ => parts(factor),
        };
        let first = inside
            .iter()
            .enumerate()
            .find(|(at, part)| *at > 0 && part.begins)
            .map_or(inside.len(), |(at, _)| at);
        let needed: f64 = inside[..first].iter().map(|part| part.width).sum();
        if filled > 0.0 && filled + needed > WIDEST {
            inside[0].begins = true;
            filled = 0.0;
        } else if index > 0 {
            all.push(Part::space());
        }
        filled =
            inside.iter().fold(filled, |filled, part| part.width + if part.begins { 0.0 } else { filled });
        all.extend(inside);
    }
    all
}

/// What stands between two signs.
fn between(open: &str, inside: &Math, close: Part) -> Vec<Part> {
    let mut all = vec![Part::fence("prefix", open, is_tall(inside))];
    all.extend(parts(inside));
    all.push(close);
    all
}

fn powered(math: &Math, base: &Math, exponent: &Math) -> Vec<Part> {
    match base {
        Math::Brackets(inside) => raised(inside, exponent),
        _ => vec![Part::of(math)],
    }
}

/// A sum in brackets with an exponent.
fn raised(inside: &Math, exponent: &Math) -> Vec<Part> {
    let fence = Part::fence("postfix", ")", is_tall(inside));
    let close = Part {
        // In a row of its own it grows.
        shown: format!("<msup><mrow>{}</mrow>{}</msup>", fence.shown, element(exponent)),
        width: fence.width + SCRIPT * width(exponent),
        begins: false,
    };
    between("(", inside, close)
}

/// A fraction as a factor before its numerator, or with a stroke if what is below is wide too.
fn fraction(above: &Math, below: &Math) -> Vec<Part> {
    let above = parts(&above.clone().into_term());
    if is_wide(below) {
        let stroke = Part { shown: sign(Operator::Over), width: SPACE, begins: false };
        let mut all = above;
        all.push(stroke);
        all.extend(parts(&below.clone().bracketed()));
        return all;
    }
    let mut all = vec![Part::of(&Math::digits(1).over(below.clone())), Part::space()];
    all.extend(above);
    all
}

fn is_wide(math: &Math) -> bool {
    width(math) > WIDEST
}

/// The width of a letter, of a digit, of one side of a bracket, of the space between factors, and of a sign with its
/// spaces, in em; of what is raised or lowered, as a part of its own width. Of the font of the pages, rounded up.
const LETTER: f64 = 0.6;
const DIGIT: f64 = 0.5;
const BRACKET: f64 = 0.45;
const SPACE: f64 = 0.17;
const SIGN: f64 = 1.35;
const SCRIPT: f64 = 0.7;

/// About how wide something is, in em.
fn width(math: &Math) -> f64 {
    let widest = |parts: &mut dyn Iterator<Item = f64>| parts.fold(0.0, f64::max);
    match math {
        Math::Row(parts) => parts.iter().map(width).sum(),
        Math::Product(factors) => factors.iter().map(|factor| width(factor) + SPACE).sum(),
        Math::Number(digits) => DIGIT * length(digits),
        Math::Identifier(identifier) => {
            let below: f64 = identifier.subscript.iter().map(|part| length(part) + 0.5).sum();
            LETTER * length(&identifier.head) + DIGIT * SCRIPT * below
        }
        Math::Operator(Operator::Negative) => LETTER,
        Math::Operator(Operator::Over) => DIGIT,
        Math::Operator(_) => SIGN,
        Math::Text(words) => DIGIT * length(words),
        Math::Fraction(above, below) => width(above).max(width(below)) + SPACE,
        Math::Power(base, exponent) => width(base) + SCRIPT * width(exponent),
        Math::Root(inside) => LETTER + width(inside),
        Math::Bars(inside) | Math::Brackets(inside) => 2.0 * BRACKET + width(inside),
        Math::Call { function, arguments, .. } => {
            let arguments: f64 = arguments.iter().map(|argument| width(argument) + DIGIT).sum();
            DIGIT * length(&function.head) + 2.0 * BRACKET + arguments
        }
        Math::Cases(cases) => {
            let condition =
                |condition: &Option<Math>| condition.as_ref().map_or(4.0, |math| 1.0 + width(math));
            2.0 + widest(&mut cases.iter().map(|(value, when)| width(value) + 1.0 + condition(when)))
        }
        Math::Derivative { of, .. } => width(&Math::Identifier(of.clone())) + SPACE,
        Math::Matrix(rows) => {
            2.0 * BRACKET
                + widest(&mut rows.iter().map(|row| row.iter().map(|entry| width(entry) + 0.8).sum()))
        }
        Math::Integral { of, over, limits } => {
            let limits = widest(&mut limits.iter().map(|limit| SCRIPT * width(limit)));
            2.0 * LETTER + limits + width(of) + width(over)
        }
        Math::Component(of, _) => 3.0 * BRACKET + width(of),
    }
}

/// How many signs a text has.
fn length(text: &str) -> f64 {
    text.chars().fold(0.0, |count, _| count + 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::mathml_in_pieces;
    use super::*;

    fn sum_of(names: &[&str]) -> Math {
        let terms = names.iter().enumerate().flat_map(|(index, name)| {
            let plus = (index > 0).then_some(Math::Operator(Operator::Plus));
            plus.into_iter().chain([Math::symbol(name)])
        });
        Math::Row(terms.collect())
    }

    fn count(math: &Math) -> usize {
        mathml_in_pieces(math).matches("<math>").count()
    }

    #[test]
    fn lines_may_be_broken_before_relations_and_terms() {
        let sum = Math::Row(vec![Math::symbol("a"), Math::Operator(Operator::Minus), Math::symbol("b")]);
        let shown = mathml_in_pieces(&Math::equation(Math::symbol("x"), sum.clone()));
        let minus =
            "<math><mrow><mo form=\"infix\" lspace=\"0\" rspace=\"0.25em\">−</mo><mi>b</mi></mrow></math>";
        assert!(
            shown.starts_with("<math><mi>x</mi></math> <math><mrow><mo form=\"infix\" lspace"),
            "{shown}"
        );
        assert!(shown.ends_with(minus), "{shown}");
        assert_eq!(count(&sum.bracketed()), 1);
    }

    #[test]
    fn words_beside_a_formula_are_words() {
        let [before, behind] = ["with the speed\u{a0}", " of it"].map(|words| Math::Text(words.to_owned()));
        let shown = mathml_in_pieces(&Math::Row(vec![before, Math::symbol("s"), behind]));
        assert_eq!(shown, "with the speed\u{a0}<math><mi>s</mi></math> of it");
    }

    #[test]
    fn the_pieces_of_a_term_are_together() {
        let wide = sum_of(&["a_first", "b_second", "c_third", "d_fourth", "e_fifth", "f_sixth"]).bracketed();
        let term = Math::Product(vec![Math::symbol("k"), wide]);
        let sum = Math::Row(vec![Math::symbol("a"), Math::Operator(Operator::Plus), term]);
        let shown = mathml_in_pieces(&Math::equation(Math::symbol("x"), sum));
        let (before, term) = shown.split_once("<span class=\"term\">").unwrap_or_default();
        assert_eq!(before.matches("<math>").count(), 2, "{shown}");
        assert!(
            term.contains("<mo form=\"infix\" lspace=\"0\"") && term.ends_with("</math></span>"),
            "{shown}"
        );
    }

    #[test]
    fn brackets_of_a_short_sum_stay_whole_those_of_a_long_one_do_not() {
        let with = |names: &[&str]| Math::Product(vec![Math::symbol("c"), sum_of(names).bracketed()]);
        assert_eq!(count(&with(&["a", "b"])), 1);
        assert_eq!(count(&with(&["a", "b", "a", "b"])), 4);
    }

    #[test]
    fn no_piece_is_wider_than_a_telephone() {
        let wide = || sum_of(&["a_first", "b_second", "c_third", "d_fourth", "e_fifth", "f_sixth"]);
        let m = || Math::symbol("m");
        let tall = || m().over(Math::symbol("L"));
        let formulas = [
            wide().over(m()),
            wide().over(wide()),
            wide().bracketed().raised_to(Math::digits(2)),
            Math::Root(Box::new(wide())),
            Math::Bars(Box::new(wide())),
            Math::Product(vec![m(), wide().bracketed(), wide().bracketed().raised_to(m()), m()]),
            Math::Product(vec![
                tall(),
                Math::Row(vec![wide(), Math::Operator(Operator::Plus), tall()]).bracketed(),
                m(),
            ]),
            Math::Product((0..30).map(|_| Math::symbol("m_b")).collect()),
        ];
        for formula in formulas {
            assert!(count(&formula) > 1, "{formula:?}");
            let mut filled = 0.0;
            for part in parts(&formula) {
                filled = part.width + if part.begins { 0.0 } else { filled };
                assert!(filled <= WIDEST + 2.0 * SIGN, "{filled} em: {formula:?}");
            }
        }
    }

    #[test]
    fn every_sign_of_a_formula_is_in_its_pieces() {
        let letters = |shown: &str| shown.matches("<mi>").count();
        let wide = sum_of(&["a_first", "b_second", "c_third", "d_fourth", "e_fifth", "f_sixth"]);
        let formula =
            Math::Product(vec![Math::symbol("k"), wide.clone().bracketed(), wide.over(Math::symbol("m"))]);
        assert_eq!(letters(&mathml_in_pieces(&formula)), letters(&element(&formula)));
    }
}
