//! Mathematics that arrives ready made, and blocks of it.

use super::prose::Text;

/// A formula in three notations of the same content.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Math {
    /// One or more `math` elements of MathML, between which a line may be broken; what is none is shown as `text` instead.
    pub mathml: String,
    /// The formula in LaTeX, without dollar signs.
    pub latex: String,
    /// The formula in words or plain signs, for screen readers and where MathML fails.
    pub text: String,
}

/// Lines of mathematics with the meaning of their symbols.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// What the lines state; may be empty.
    pub title: Text,
    /// One formula a line.
    pub lines: Vec<Math>,
    /// What follows "where".
    pub definitions: Vec<Definition>,
}

/// The meaning of a symbol.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Definition {
    /// The symbol, or an equation that defines it.
    pub symbol: Math,
    /// Its meaning, with the unit.
    pub meaning: Text,
}
