//! Words, labels and formulas as HTML.

use crate::report::markup::Markup;
use crate::report::math::{Block, Definition, Typeset};
use crate::report::prose::Text;
use tumble_drawing::svg::escape;
use tumble_drawing::text::Label;

/// The language of pages.
struct Html;

impl Markup for Html {
    fn words(text: &str) -> String {
        text.split('\n').map(escape).collect::<Vec<_>>().join("<br>")
    }

    fn math(formula: &Typeset) -> String {
        math(formula)
    }
}

/// Running text.
pub(super) fn text(text: &Text) -> String {
    Html::text(text)
}

/// A label with its italics, subscripts and superscripts.
pub(super) fn label(label: &Label) -> String {
    Html::label(label)
}

/// A formula; its text stands where it has no MathML.
pub(super) fn math(math: &Typeset) -> String {
    let (mathml, spoken) = (&math.mathml, escape(&math.text));
    match (mathml.is_empty(), spoken.is_empty()) {
        (true, true) => String::new(),
        (true, false) => format!("<span class=\"math plain\">{spoken}</span>"),
        (false, _) => format!("<span class=\"math\" role=\"math\" aria-label=\"{spoken}\">{mathml}</span>"),
    }
}

/// A block of formulas with the meaning of its symbols.
pub(super) fn block(block: &Block) -> String {
    let title = tagged("p", "block-title", &text(&block.title));
    let lines: String = block.lines.iter().map(|line| tagged("div", "line", &math(line))).collect();
    let definitions: String = block.definitions.iter().map(definition).collect();
    let definitions = if definitions.is_empty() {
        definitions
    } else {
        format!("<p class=\"where\">where</p>\n<dl class=\"where\">{definitions}</dl>\n")
    };
    format!("<div class=\"block\">\n{title}<div class=\"lines\">{lines}</div>\n{definitions}</div>\n")
}

fn definition(definition: &Definition) -> String {
    let (symbol, meaning) = (math(&definition.symbol), text(&definition.meaning));
    // An equation that says it all may be as long as any: it scrolls where it is wider than the page.
    let class = if meaning.is_empty() { " class=\"line\"" } else { "" };
    format!("<div><dt{class}>{symbol}</dt><dd>{meaning}</dd></div>\n")
}

/// Content in an element of a class; nothing for no content.
pub(super) fn tagged(element: &str, class: &str, content: &str) -> String {
    match (content, class) {
        ("", _) => String::new(),
        (_, "") => format!("<{element}>{content}</{element}>\n"),
        _ => format!("<{element} class=\"{class}\">{content}</{element}>\n"),
    }
}

/// Paragraphs.
pub(super) fn paragraphs(texts: &[Text]) -> String {
    texts.iter().map(|p| tagged("p", "", &text(p))).collect()
}

/// A list; nothing for no items.
pub(super) fn list(items: &[Text]) -> String {
    let items: String = items.iter().map(|item| tagged("li", "", &text(item))).collect();
    tagged("ul", "", &items)
}
