//! What can be wrong with a formula, as values that point into its text.

use std::ops::Range;
use std::sync::Arc;

use thiserror::Error;

use crate::TypeError;

/// A range of bytes in the text of a formula.
pub type Span = Range<usize>;

crate::codes! {
    /// The kind of a mistake; prints as a short code that never changes its meaning.
    enum Code;
    /// There is no formula.
    Empty = "E0101";
    /// The formula is longer than a formula may be.
    TooLong = "E0102";
    /// Brackets are nested too deep.
    TooDeep = "E0103";
    /// A character that formulas are not written with.
    Character = "E0104";
    /// A number that is not written as one.
    Number = "E0105";
    /// A number too large or too small for a double.
    Magnitude = "E0106";
    /// A decimal comma.
    DecimalComma = "E0107";
    /// A bracket without its partner.
    Bracket = "E0108";
    /// A value is missing.
    MissingValue = "E0109";
    /// Two values stand side by side without an operator.
    MissingOperator = "E0110";
    /// An operator of another language.
    BinaryOperator = "E0111";
    /// A comparison of a comparison.
    ChainedComparison = "E0112";
    /// A power of a quantity that can be read in two ways.
    PowerOfQuantity = "E0113";
    /// A comma outside of arguments and vectors.
    Comma = "E0114";
    /// A vector that has neither two nor three components.
    Components = "E0115";
    /// The header of a function is not `name(argument, ...)`.
    Header = "E0116";
    /// A word after a number that is no unit.
    UnknownUnit = "E0201";
    /// A unit that is also a name of the scene.
    UnitOrName = "E0202";
    /// The power of a unit is not a plain number in range.
    UnitExponent = "E0203";
    /// An angle without its unit.
    AngleUnit = "E0204";
    /// Hertz where an angular velocity is asked for.
    Hertz = "E0205";
    /// A name that nothing has.
    UnknownName = "E0301";
    /// A function that does not exist.
    UnknownFunction = "E0302";
    /// A call with too few or too many arguments.
    ArgumentCount = "E0303";
    /// A function that calls itself.
    Recursion = "E0304";
    /// Functions that call functions too deep.
    CallDepth = "E0305";
    /// A formula that grows too large when its calls are written out.
    Expansion = "E0306";
    /// A function used as a value, or a value used as a function.
    NotCallable = "E0307";
    /// Two quantities that must be alike are not.
    Unlike = "E0401";
    /// A function of pure numbers was given a quantity.
    NotPure = "E0402";
    /// A quantity is raised to a power that is not a plain number.
    Exponent = "E0403";
    /// Another dimension was asked for.
    Expected = "E0404";
    /// A comparison where a number is needed, or a number where a comparison is needed.
    Truth = "E0405";
    /// A vector where a number is needed, or a number where a vector is needed.
    Shape = "E0406";
    /// Vectors of unequal length.
    Lengths = "E0407";
    /// A division by zero.
    DivisionByZero = "E0408";
    /// The exponents of a dimension are out of range.
    ExponentRange = "E0409";
    /// A measured function of a quantity other than the one it was measured over.
    Variable = "E0410";
}

impl From<&TypeError> for Code {
    fn from(error: &TypeError) -> Self {
        match error {
            TypeError::Unlike { .. } => Self::Unlike,
            TypeError::NotPure { .. } => Self::NotPure,
            TypeError::Expected { .. } => Self::Expected,
            TypeError::VariableExponent { .. } => Self::Exponent,
            TypeError::ExponentRange => Self::ExponentRange,
            TypeError::TruthAsNumber | TypeError::NumberAsTruth { .. } => Self::Truth,
            TypeError::NotFinite { .. } => Self::Magnitude,
            TypeError::Lengths { .. } | TypeError::NotSquare { .. } | TypeError::SystemAsNumber => {
                Self::Lengths
            }
        }
    }
}

/// The text that spans count in.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Default)]
pub enum SpannedText {
    /// The formula itself.
    #[default]
    Formula,
    /// The body of the function of this name.
    Body(Arc<str>),
}

/// A call on the way from the formula to the mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CallSite {
    /// The text in which the call stands.
    pub place: SpannedText,
    /// Where it stands there.
    pub span: Span,
    /// What was called with what, such as "called here with t = a length (m)".
    pub note: String,
}

/// A mistake in a formula.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct FormulaError {
    /// The kind of mistake.
    pub code: Code,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// The parts of the text that are wrong, and what each of them is.
    pub labels: Vec<(Span, String)>,
    /// How to put it right.
    pub help: Option<String>,
    /// The text that the labels count in.
    pub place: SpannedText,
    /// Where the labels are in the body of a function: the calls that lead there, innermost first.
    pub calls: Vec<CallSite>,
}

impl FormulaError {
    /// A mistake at `span`.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self::between(code, message, vec![(span, String::new())])
    }

    /// A mistake that lies in several labelled places together.
    pub fn between(code: Code, message: impl Into<String>, labels: Vec<(Span, String)>) -> Self {
        let (place, calls) = (SpannedText::Formula, Vec::new());
        Self { code, message: message.into(), labels, help: None, place, calls }
    }

    /// This mistake with the text of its first label.
    #[must_use]
    pub fn label(mut self, text: impl Into<String>) -> Self {
        if let Some((_, label)) = self.labels.first_mut() {
            *label = text.into();
        }
        self
    }

    /// This mistake with a second place.
    #[must_use]
    pub fn also(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push((span, text.into()));
        self
    }

    /// This mistake with its cure.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_unique_and_documented() {
        let mut seen = std::collections::HashSet::new();
        for code in Code::ALL {
            assert!(seen.insert(code.as_str()), "{code} twice");
            assert!(code.summary().ends_with('.'), "{code}: {}", code.summary());
        }
        assert_eq!(Code::MissingOperator.to_string(), "E0110");
    }
}
