//! Words, labels and formulas as Typst.
//!
//! Everything that somebody wrote becomes a string, which Typst shows as it is; it never stands in markup. Formulas
//! are the exception, and only those of [`is_mathematics`].

use typst::syntax::{SyntaxKind, SyntaxNode, parse_math};

use crate::font::Face;
use crate::report::markup::Markup;
use crate::report::math::{Block, Definition, Math};
use crate::report::prose::Text;
use crate::text::{Label, Level};

/// The functions and symbols that formulas may name.
const NAMES: [&str; 12] =
    ["abs", "cases", "dot", "dot.double", "dot.op", "frac", "italic", "mat", "op", "slash", "sqrt", "thin"];

/// The parts a formula may have beside names, none of which leaves mathematics.
const PARTS: [SyntaxKind; 21] = [
    SyntaxKind::Math,
    SyntaxKind::MathText,
    SyntaxKind::MathShorthand,
    SyntaxKind::MathAlignPoint,
    SyntaxKind::MathCall,
    SyntaxKind::MathArgs,
    SyntaxKind::MathDelimited,
    SyntaxKind::MathAttach,
    SyntaxKind::MathPrimes,
    SyntaxKind::Array,
    SyntaxKind::Str,
    SyntaxKind::Space,
    SyntaxKind::LeftParen,
    SyntaxKind::RightParen,
    SyntaxKind::Comma,
    SyntaxKind::Semicolon,
    SyntaxKind::Underscore,
    SyntaxKind::Hat,
    SyntaxKind::Plus,
    SyntaxKind::Eq,
    SyntaxKind::Lt,
];

/// A string of Typst.
pub(super) fn string(text: &str) -> String {
    let escape = |c: char| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') => " ".to_owned(),
        c if crate::svg::turns(c) => "\u{FFFD}".to_owned(),
        _ => c.to_string(),
    };
    format!("\"{}\"", text.chars().map(escape).collect::<String>())
}

/// Words within markup.
pub(super) fn words(text: &str) -> String {
    format!("#{}", string(text))
}

/// The language of Typst's markup.
struct Typst;

impl Markup for Typst {
    fn words(text: &str) -> String {
        words(text)
    }

    fn math(formula: &Math) -> String {
        math(formula)
    }

    fn faced(face: Face, words: String) -> String {
        match face {
            Face::Regular => words,
            Face::Italic => format!("#emph[{words}]"),
            Face::Bold => format!("#strong[{words}]"),
        }
    }

    fn leveled(level: Level, words: String) -> String {
        match level {
            Level::Base => words,
            Level::Subscript => format!("#sub[{words}]"),
            Level::Superscript => format!("#super[{words}]"),
        }
    }
}

/// Running text within markup.
pub(super) fn text(text: &Text) -> String {
    Typst::text(text)
}

/// A label with its italics, subscripts and superscripts.
pub(super) fn label(label: &Label) -> String {
    Typst::label(label)
}

/// A formula in a line of text.
pub(super) fn math(math: &Math) -> String {
    formula("formula", math)
}

/// A formula on a line of its own.
fn display(math: &Math) -> String {
    format!("#line-of[{}]\n", formula("display", math))
}

/// A formula by one of the functions for them; its text stands in where it is not mathematics.
fn formula(function: &str, math: &Math) -> String {
    if !is_mathematics(&math.typst) {
        return words(&math.text);
    }
    format!("#{function}($ {} $, {})", math.typst, string(&math.text))
}

/// Whether a formula is mathematics and nothing else. Words alone are none: they would stand in one line.
fn is_mathematics(formula: &str) -> bool {
    let parsed = parse_math(formula);
    let mut parts = parsed.children().filter(|part| part.kind() != SyntaxKind::Space);
    let is_more = parts.next().is_some_and(|part| part.kind() != SyntaxKind::Str) || parts.next().is_some();
    is_more && is_harmless(&parsed)
}

fn is_harmless(part: &SyntaxNode) -> bool {
    match part.kind() {
        SyntaxKind::MathIdent => NAMES.contains(&part.leaf_text().as_str()),
        SyntaxKind::MathFieldAccess => NAMES.contains(&part.full_text().as_str()),
        kind => PARTS.contains(&kind) && part.children().all(is_harmless),
    }
}

/// What stands above something and must not be parted from it.
pub(super) fn lead(title: &Text) -> String {
    if title.is_empty() { String::new() } else { format!("#lead[{}]\n", text(title)) }
}

/// A block of formulas with the meaning of its symbols.
pub(super) fn block(block: &Block) -> String {
    let lines: String = block.lines.iter().map(display).collect();
    let meaning = |d: &Definition| format!("[{} {}], ", math(&d.symbol), text(&d.meaning));
    let meanings: String = block.definitions.iter().map(meaning).collect();
    let meanings = if meanings.is_empty() { meanings } else { format!("#where({meanings})\n") };
    [lead(&block.title), lines, meanings].concat()
}

/// Paragraphs.
pub(super) fn paragraphs(texts: &[Text]) -> String {
    texts.iter().filter(|words| !words.is_empty()).map(|words| format!("\n{}\n", text(words))).collect()
}

/// A list; nothing for no items.
pub(super) fn list(items: &[Text]) -> String {
    let all: String = items.iter().map(|item| format!("[{}], ", text(item))).collect();
    if all.is_empty() { all } else { format!("#list({all})\n") }
}
