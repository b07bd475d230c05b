//! The shape of a formula before its names have a meaning.

use num_rational::BigRational;

use super::error::Span;
use super::unit_chain::Chain;

/// Where a node stands in its [`Tree`].
pub type NodeId = usize;

/// A formula as its nodes, each behind the nodes it is made of, so that nothing that walks it recurses.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// The nodes; the last one is the whole formula.
    pub nodes: Vec<SyntaxNode>,
}

/// A part of a formula and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct SyntaxNode {
    /// What it is.
    pub syntax: Syntax,
    /// Where it stands, brackets around it included.
    pub span: Span,
    /// Whether brackets stand around it.
    pub bracketed: bool,
}

/// What a part of a formula is.
#[derive(Clone, Debug, PartialEq)]
pub enum Syntax {
    /// A number with or without units.
    Quantity {
        /// The number as written, units not yet counted in.
        value: BigRational,
        /// Its units.
        chain: Option<Chain>,
        /// What stands around it.
        standing: Standing,
    },
    /// A name; the span of the name without brackets.
    Name(Span),
    /// `-a`, or `+a` where it is not negative.
    Sign {
        /// Whether the sign is a minus.
        minus: bool,
        /// What it stands before.
        operand: NodeId,
    },
    /// `a + b` and the like.
    Infix(BinaryOperator, NodeId, NodeId),
    /// `f(a, b)`, with the span of the function's name.
    Call(Span, Vec<NodeId>),
    /// `[a, b]`
    Vector(Vec<NodeId>),
    /// A part with a mistake that has been reported.
    Broken,
}

/// What stands around a quantity, which decides whether its units may be taken for names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Operators other than its sign.
    Within,
    /// Nothing, or the commas and brackets of arguments and vectors.
    Alone,
    /// Brackets of its own.
    Bracketed,
}

/// What stands between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOperator {
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Times,
    /// `/`
    Divide,
    /// `^`
    Power,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
}

impl BinaryOperator {
    pub(super) fn from_sign(sign: char, equal: bool) -> Option<Self> {
        Some(match (sign, equal) {
            ('+', _) => Self::Plus,
            ('-', _) => Self::Minus,
            ('*', _) => Self::Times,
            ('/', _) => Self::Divide,
            ('^', _) => Self::Power,
            ('<', false) => Self::Less,
            ('<', true) => Self::LessEqual,
            ('>', false) => Self::Greater,
            ('>', true) => Self::GreaterEqual,
            _ => return None,
        })
    }

    /// Whether it compares.
    pub fn compares(self) -> bool {
        self.binding() == 1
    }

    /// How tightly it binds; a leading sign binds with [`SIGN_BINDING`].
    pub(super) fn binding(self) -> u8 {
        match self {
            Self::Less | Self::LessEqual | Self::Greater | Self::GreaterEqual => 1,
            Self::Plus | Self::Minus => 2,
            Self::Times | Self::Divide => 3,
            Self::Power => 5,
        }
    }
}

/// A sign binds tighter than a product and looser than a power: `-2^2` is -4.
pub(super) const SIGN_BINDING: u8 = 4;
