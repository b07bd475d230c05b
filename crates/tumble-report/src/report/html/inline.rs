//! Words, labels and formulas as HTML.

use super::page::Page;
use crate::report::markup::Markup;
use crate::report::math::Typeset;
use crate::report::prose::Text;
use tumble_drawing::svg::escape;

impl Markup for Page {
    fn words(text: &str) -> String {
        text.split('\n').map(escape).collect::<Vec<_>>().join("<br>")
    }

    /// Its text stands where it has no MathML.
    fn math(math: &Typeset) -> String {
        let (mathml, spoken) = (&math.mathml, escape(&math.text));
        match (mathml.is_empty(), spoken.is_empty()) {
            (true, true) => String::new(),
            (true, false) => format!("<span class=\"math plain\">{spoken}</span>"),
            (false, _) => {
                format!("<span class=\"math\" role=\"math\" aria-label=\"{spoken}\">{mathml}</span>")
            }
        }
    }
}

/// Running text, for other pages.
pub(crate) fn text(text: &Text) -> String {
    Page::text(text)
}

/// Content in an element of a class; nothing for no content.
pub(super) fn tagged(element: &str, class: &str, content: &str) -> String {
    match (content, class) {
        ("", _) => String::new(),
        (_, "") => format!("<{element}>{content}</{element}>\n"),
        _ => format!("<{element} class=\"{class}\">{content}</{element}>\n"),
    }
}
