//! What the forms of a report have in common in writing running text.

use super::math::Typeset;
use super::prose::{Inline, Text};
use tumble_drawing::font::Face;
use tumble_drawing::text::{Label, Level, TextRun};

/// A language in which running text is written.
pub(super) trait Markup {
    /// Words as they are, whatever they hold.
    fn words(text: &str) -> String;

    /// A formula in a line of text.
    fn math(math: &Typeset) -> String;

    /// In italics or bold.
    fn faced(face: Face, words: String) -> String {
        match face {
            Face::Regular => words,
            Face::Italic => format!("<i>{words}</i>"),
            Face::Bold => format!("<b>{words}</b>"),
        }
    }

    /// Below or above the line.
    fn leveled(level: Level, words: String) -> String {
        match level {
            Level::Base => words,
            Level::Subscript => format!("<sub>{words}</sub>"),
            Level::Superscript => format!("<sup>{words}</sup>"),
        }
    }

    /// Running text.
    fn text(text: &Text) -> String {
        let piece = |piece: &Inline| match piece {
            Inline::Words(words) => Self::words(words),
            Inline::Label(label) => Self::label(label),
            Inline::Math(math) => Self::math(math),
        };
        text.pieces.iter().map(piece).collect()
    }

    /// A label with its italics, subscripts and superscripts.
    fn label(label: &Label) -> String {
        let run = |run: &TextRun| Self::leveled(run.level, Self::faced(run.face, Self::words(&run.text)));
        label.runs.iter().map(run).collect()
    }
}
