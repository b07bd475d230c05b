//! Mathematics as notation writes it, and blocks of it.

use super::prose::Text;
use tumble_notation::{latex, mathml_in_pieces, text};

/// A formula in three notations of the same content.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Typeset {
    /// One or more `math` elements of MathML, between which a line may be broken, with words before them; what has none is shown as `text`. Only notation
    /// writes it, so that it stands in pages as it is.
    pub(crate) mathml: String,
    /// The formula in LaTeX, without dollar signs.
    pub(crate) latex: String,
    /// The formula in words or plain signs, for screen readers and where MathML fails.
    pub(crate) text: String,
}

impl Typeset {
    /// Words in the place of a formula: they are no mathematics, and their lines break as those of words do.
    pub fn words(words: &str) -> Self {
        Self { text: words.to_owned(), ..Self::default() }
    }
}

impl From<&tumble_notation::Math> for Typeset {
    fn from(formula: &tumble_notation::Math) -> Self {
        Self { mathml: mathml_in_pieces(formula), latex: latex(formula), text: text(formula) }
    }
}

/// Lines of mathematics with the meaning of their symbols.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// What the lines state; may be empty.
    pub title: Text,
    /// One formula a line.
    pub lines: Vec<Typeset>,
    /// What follows "where".
    pub definitions: Vec<Definition>,
}

/// The meaning of a symbol.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Definition {
    /// The symbol, or an equation that defines it.
    pub symbol: Typeset,
    /// Its meaning, with the unit.
    pub meaning: Text,
}
