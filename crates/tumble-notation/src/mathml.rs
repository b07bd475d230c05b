//! Mathematics as MathML Core, presentation elements only.

mod pieces;

use crate::layout::{Math, Operator};
use crate::symbol::{self, Identifier};
use crate::text::primes;

/// The space between factors, as on paper.
const THIN_SPACE: &str = "<mspace width=\"0.1667em\"/>";
/// The sign of a function applied, which has no width.
const APPLIED: &str = "<mo>\u{2061}</mo>";

/// A formula in a line of text as `math` elements between which the line may be broken, none wider than a telephone if it
/// can be helped. Those of one term are in an element of the class `term`, which should move to the next line as a whole. Words
/// before or behind a formula are no part of it: their lines break as those of words do.
pub fn mathml_in_pieces(math: &Math) -> String {
    let is_said = |words: &str| words.contains(' ');
    if let Math::Row(parts) = math {
        match &parts[..] {
            [only] => return mathml_in_pieces(only),
            [Math::Text(words), rest @ ..] if is_said(words) => {
                return escaped(words) + &mathml_in_pieces(&Math::Row(rest.to_vec()));
            }
            [rest @ .., Math::Text(words)] if is_said(words) => {
                return mathml_in_pieces(&Math::Row(rest.to_vec())) + &escaped(words);
            }
            _ => {}
        }
    }
    let piece = |piece: &String| format!("<math>{piece}</math>");
    let term = |term: Vec<String>| match term.iter().map(piece).collect::<Vec<_>>() {
        pieces if pieces.len() > 1 => format!("<span class=\"term\">{}</span>", pieces.join(" ")),
        pieces => pieces.concat(),
    };
    pieces::terms(math).into_iter().map(term).collect::<Vec<_>>().join(" ")
}

/// Text with the characters that HTML reads as markup escaped.
pub(crate) fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        '\'' => "&#39;".to_owned(),
        _ => c.to_string(),
    };
    text.chars().map(escape).collect()
}

/// One element.
fn element(math: &Math) -> String {
    match math {
        Math::Row(parts) => mrow(parts.iter().map(element).collect()),
        Math::Product(factors) => mrow(factors.iter().map(element).collect::<Vec<_>>().join(THIN_SPACE)),
        Math::Number(digits) => format!("<mn>{}</mn>", escaped(digits)),
        Math::Identifier(identifier) => name(identifier),
        Math::Operator(operator) => sign(*operator),
        Math::Text(words) => format!("<mtext>{}</mtext>", escaped(words)),
        Math::Fraction(above, below) => format!("<mfrac>{}{}</mfrac>", element(above), element(below)),
        Math::Power(of, exponent) => power(of, exponent),
        Math::Root(inside) => format!("<msqrt>{}</msqrt>", element(inside)),
        Math::Bars(inside) => fenced("|", "|", &element(inside), true),
        Math::Brackets(inside) => fenced("(", ")", &element(inside), is_tall(inside)),
        Math::Call { function, power, arguments, bare } => call(function, power.as_deref(), arguments, *bare),
        Math::Cases(cases) => {
            let rows: String = cases.iter().map(case).collect();
            let table = format!("<mtable>{rows}</mtable>");
            mrow(format!("<mo form=\"prefix\" stretchy=\"true\" fence=\"true\">{{</mo>{table}"))
        }
        Math::Derivative { of, order } => derivative(of, *order),
        Math::Matrix(rows) => {
            let cell = |part: &Math| format!("<mtd>{}</mtd>", element(part));
            let row = |row: &Vec<Math>| format!("<mtr>{}</mtr>", row.iter().map(cell).collect::<String>());
            let rows: String = rows.iter().map(row).collect();
            fenced("(", ")", &format!("<mtable>{rows}</mtable>"), true)
        }
        Math::Integral { of, over, limits } => {
            let [from, to] = limits.each_ref().map(element);
            let sign = format!("<msubsup><mo stretchy=\"false\">∫</mo>{from}{to}</msubsup>");
            let variable = format!("{THIN_SPACE}<mi mathvariant=\"normal\">d</mi>{}", element(over));
            mrow(format!("{sign}{}{variable}", element(of)))
        }
        Math::Component(of, index) => {
            let of = fenced("(", ")", &element(of), true);
            format!("<msub>{of}<mn>{index}</mn></msub>")
        }
    }
}

fn mrow(content: String) -> String {
    format!("<mrow>{content}</mrow>")
}

/// Whether round brackets have to grow. Those that need not must not be allowed to: browsers keep the width of the
/// tallest form free for any that may.
fn is_tall(math: &Math) -> bool {
    match math {
        Math::Row(parts) | Math::Product(parts) => parts.iter().any(is_tall),
        Math::Fraction(..)
        | Math::Cases(_)
        | Math::Matrix(_)
        | Math::Component(..)
        | Math::Integral { .. } => true,
        Math::Power(inside, _) | Math::Root(inside) | Math::Bars(inside) | Math::Brackets(inside) => {
            is_tall(inside)
        }
        Math::Call { arguments, .. } => arguments.iter().any(is_tall),
        Math::Number(_)
        | Math::Identifier(_)
        | Math::Operator(_)
        | Math::Text(_)
        | Math::Derivative { .. } => false,
    }
}

fn fenced(open: &str, close: &str, content: &str, grows: bool) -> String {
    let fence = |form: &str, sign: &str| {
        format!(
            "<mo form=\"{form}\" fence=\"true\" stretchy=\"{grows}\" lspace=\"0.05em\" rspace=\"0.05em\">{sign}</mo>"
        )
    };
    mrow(format!("{}{content}{}", fence("prefix", open), fence("postfix", close)))
}

fn sign(operator: Operator) -> String {
    let (form, sign) = match operator {
        Operator::Over => return "<mo lspace=\"0\" rspace=\"0\" stretchy=\"false\">/</mo>".to_owned(),
        Operator::Negative => ("prefix", operator.text()),
        _ => ("infix", operator.text().trim()),
    };
    format!("<mo form=\"{form}\">{}</mo>", escaped(sign))
}

fn power(of: &Math, exponent: &Math) -> String {
    match of {
        Math::Identifier(identifier) if !identifier.subscript.is_empty() => {
            let (head, below) = (head(identifier), subscript(identifier));
            format!("<msubsup>{head}{below}{}</msubsup>", element(exponent))
        }
        _ => format!("<msup>{}{}</msup>", element(of), element(exponent)),
    }
}

fn name(identifier: &Identifier) -> String {
    with_subscript(&head(identifier), identifier)
}

fn with_subscript(head: &str, identifier: &Identifier) -> String {
    if identifier.subscript.is_empty() {
        return head.to_owned();
    }
    format!("<msub>{head}{}</msub>", subscript(identifier))
}

/// One letter is set in italics by itself; more are not, so they are asked for by their characters.
fn head(identifier: &Identifier) -> String {
    letters(&identifier.head, identifier.is_italic())
}

fn letters(word: &str, is_italic: bool) -> String {
    match (word.chars().count(), is_italic) {
        (1, true) => format!("<mi>{}</mi>", escaped(word)),
        (1, false) => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(word)),
        (_, true) => format!("<mi>{}</mi>", word.chars().map(italic).collect::<String>()),
        (_, false) => format!("<mi>{}</mi>", escaped(word)),
    }
}

/// The italic letter of mathematics, where there is one.
pub(crate) fn italic(letter: char) -> char {
    let from = |first: char, base: u32| char::from_u32(base + (letter as u32 - first as u32));
    let found = match letter {
        // The italic h has been Planck's constant since before the others were added.
        'h' => Some('\u{210e}'),
        'A'..='Z' => from('A', 0x1d434),
        'a'..='z' => from('a', 0x1d44e),
        'Α'..='Ω' => from('Α', 0x1d6e2),
        'α'..='ω' => from('α', 0x1d6fc),
        _ => None,
    };
    found.unwrap_or(letter)
}

fn subscript(identifier: &Identifier) -> String {
    let part = |part: &String| {
        if part.chars().all(|c| c.is_ascii_digit()) {
            format!("<mn>{}</mn>", escaped(part))
        } else if symbol::is_letter(part) {
            letters(part, true)
        } else {
            format!("<mtext>{}</mtext>", escaped(part))
        }
    };
    let parts: Vec<String> = identifier.subscript.iter().map(part).collect();
    if parts.len() == 1 { parts.concat() } else { mrow(parts.join("<mo separator=\"true\">,</mo>")) }
}

fn call(function: &Identifier, power: Option<&Math>, arguments: &[Math], bare: bool) -> String {
    let head = name(function);
    let head = match power {
        Some(power) => format!("<msup>{head}{}</msup>", element(power)),
        None => head,
    };
    let comma = "<mo separator=\"true\">,</mo>";
    let grows = arguments.iter().any(is_tall);
    let arguments = arguments.iter().map(element).collect::<Vec<_>>().join(comma);
    if bare {
        mrow(format!("{head}{APPLIED}{THIN_SPACE}{arguments}"))
    } else {
        mrow(format!("{head}{APPLIED}{}", fenced("(", ")", &arguments, grows)))
    }
}

fn case((value, condition): &(Math, Option<Math>)) -> String {
    let condition = match condition {
        Some(condition) => format!("<mtext>if\u{a0}</mtext>{}", element(condition)),
        None => "<mtext>otherwise</mtext>".to_owned(),
    };
    let style = "text-align: -webkit-left; padding: 0.15em 0.5em";
    format!(
        "<mtr><mtd style=\"{style}\">{}</mtd><mtd style=\"{style}\"><mrow>{condition}</mrow></mtd></mtr>",
        element(value)
    )
}

fn derivative(of: &Identifier, order: u8) -> String {
    if order == 0 {
        return name(of);
    }
    let primes = format!("<mo lspace=\"0\" rspace=\"0\">{}</mo>", primes(order));
    // The sign has its size and height by itself.
    with_subscript(&mrow(format!("{}{primes}", head(of))), of)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mathml(math: &Math) -> String {
        format!("<math>{}</math>", element(math))
    }

    #[test]
    fn names_cannot_become_markup() {
        let hostile = Math::symbol("<script>alert('1')</script>&\"_<b>");
        for text in [mathml(&hostile), mathml(&Math::Text("<b>&".to_owned()))] {
            assert!(!text.contains("<script") && !text.contains("<b>") && !text.contains("&\""), "{text}");
        }
    }

    #[test]
    fn letters_are_italic_and_words_upright() {
        assert_eq!(mathml(&Math::symbol("theta")), "<math><mi>θ</mi></math>");
        assert_eq!(mathml(&Math::symbol("dt")), "<math><mi>𝑑𝑡</mi></math>");
        assert_eq!(mathml(&Math::symbol("mass")), "<math><mi>mass</mi></math>");
        assert_eq!(mathml(&Math::symbol("w1")), "<math><msub><mi>w</mi><mn>1</mn></msub></math>");
    }

    #[test]
    fn only_elements_of_mathml_core_are_used() {
        let known = [
            "math", "mrow", "mi", "mn", "mo", "mfrac", "msup", "msub", "msubsup", "msqrt", "mover", "mtable",
            "mtr", "mtd", "mtext", "mspace",
        ];
        let x = || Math::symbol("x_1");
        let all = Math::Row(vec![
            x().over(Math::Root(Box::new(x().raised_to(Math::digits(2))))),
            Math::Cases(vec![(x(), Some(x())), (x(), None)]),
            Math::Matrix(vec![vec![x()]]),
            Math::derivative("theta_1", 3),
        ]);
        for tag in mathml(&all).split('<').skip(1) {
            let name: String =
                tag.trim_start_matches('/').chars().take_while(char::is_ascii_alphabetic).collect();
            assert!(known.contains(&name.as_str()), "{name}");
        }
    }

    #[test]
    fn only_brackets_around_something_tall_grow() {
        let grows = |inside: Math| mathml(&inside.bracketed()).contains("stretchy=\"true\"");
        assert!(!grows(Math::symbol("x")));
        assert!(grows(Math::symbol("x").over(Math::symbol("y")).raised_to(Math::digits(2))));
    }
}
