//! Mathematics as it stands on paper, before it becomes MathML, LaTeX or text.

use crate::numbers;
use crate::numeral::Numeral;
use crate::symbol::Identifier;

/// A sign between or before parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Operator {
    Plus,
    Minus,
    /// The minus sign of one part.
    Negative,
    Equals,
    Less,
    LessEqual,
    /// A multiplication that must be seen.
    Times,
    /// A fraction within a line, as in an exponent.
    Over,
    /// A vector product.
    Cross,
    /// A scalar product.
    Dot,
}

impl Operator {
    /// As it stands in a line of text, and in LaTeX.
    fn signs(self) -> [&'static str; 2] {
        match self {
            Self::Plus => [" + ", " + "],
            Self::Minus => [" − ", " - "],
            Self::Negative => ["−", "-"],
            Self::Equals => [" = ", " = "],
            Self::Less => [" < ", " < "],
            Self::LessEqual => [" ≤ ", " \\le "],
            Self::Times => ["·", " \\cdot "],
            Self::Over => ["/", "/"],
            Self::Cross => [" × ", " \\times "],
            Self::Dot => [" · ", " \\cdot "],
        }
    }

    pub(crate) fn text(self) -> &'static str {
        self.signs()[0]
    }

    pub(crate) fn latex(self) -> &'static str {
        self.signs()[1]
    }
}

/// A piece of mathematics.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Math {
    /// One after another.
    Row(Vec<Self>),
    /// Factors without a sign between them.
    Product(Vec<Self>),
    /// Digits.
    Number(String),
    /// A letter or word with its subscript.
    Identifier(Identifier),
    /// A sign.
    Operator(Operator),
    /// Upright words, such as units.
    Text(String),
    /// Numerator and denominator.
    Fraction(Box<Self>, Box<Self>),
    /// Base and exponent.
    Power(Box<Self>, Box<Self>),
    /// Square root.
    Root(Box<Self>),
    /// Between bars: an absolute value, or the length of a vector.
    Bars(Box<Self>),
    /// Between round brackets.
    Brackets(Box<Self>),
    /// A function.
    Call {
        /// Its name.
        function: Identifier,
        /// The power it is raised to, as in sin².
        power: Option<Box<Self>>,
        /// Its arguments.
        arguments: Vec<Self>,
        /// Written without brackets, as in sin θ.
        bare: bool,
    },
    /// Values with the conditions under which they hold; the last one's may be left out.
    Cases(Vec<(Self, Option<Self>)>),
    /// Derivative by time, with primes.
    Derivative {
        /// Of what.
        of: Identifier,
        /// How often; 0 is not at all.
        order: u8,
    },
    /// Rows of a matrix; a vector has rows of one entry.
    Matrix(Vec<Vec<Self>>),
    /// An integral.
    Integral {
        /// Of what.
        of: Box<Self>,
        /// The variable.
        over: Box<Self>,
        /// Its limits.
        limits: Box<[Self; 2]>,
    },
    /// A component of a vector, counted from 1.
    Component(Box<Self>, u32),
}

impl Math {
    /// A symbol by its name, such as `theta`, `v_x`, `w1` or `w(t)`. A name between bars, `|u|`, is the length of what is named.
    pub fn symbol(name: &str) -> Self {
        let inside = name.strip_prefix('|').and_then(|rest| rest.strip_suffix('|'));
        match inside.filter(|inside| !inside.is_empty()) {
            Some(inside) => Self::Bars(Box::new(Self::symbol(inside))),
            None => Self::called(name).unwrap_or_else(|| Self::Identifier(Identifier::parse(name))),
        }
    }

    /// A number rounded to at most so many significant digits.
    pub fn number(value: f64, digits: usize) -> Self {
        let Numeral { digits, power } = Numeral::significant(value, digits);
        let mantissa = Self::Number(digits);
        match power {
            None => mantissa,
            Some(power) => {
                let power = Self::digits(10).raised_to(numbers::signed(power.into()));
                Self::Row(vec![mantissa, Self::Operator(Operator::Times), power])
            }
        }
    }

    /// `w(t)` as a function of a letter.
    fn called(name: &str) -> Option<Self> {
        let (function, rest) = name.split_once('(')?;
        let argument = rest.strip_suffix(')').filter(|argument| !argument.contains(['(', ',']))?;
        let is_plain = !function.is_empty() && !argument.is_empty();
        is_plain.then(|| Self::Call {
            function: Identifier::parse(function),
            power: None,
            arguments: vec![Self::symbol(argument)],
            bare: false,
        })
    }

    /// The derivative of that order of a symbol by time.
    pub fn derivative(name: &str, order: u8) -> Self {
        Self::Derivative { of: Identifier::parse(name), order }
    }

    /// Terms one after another, each behind its sign; true is a minus.
    pub fn terms(terms: impl IntoIterator<Item = (bool, Self)>) -> Vec<Self> {
        let signed = |(index, (minus, math)): (usize, (bool, Self))| {
            let sign = match (index, minus) {
                (0, false) => None,
                (0, true) => Some(Operator::Negative),
                (_, false) => Some(Operator::Plus),
                (_, true) => Some(Operator::Minus),
            };
            sign.map(Self::Operator).into_iter().chain([math])
        };
        terms.into_iter().enumerate().flat_map(signed).collect()
    }

    /// With a minus sign before it.
    pub fn negative(self) -> Self {
        Self::Row(Self::terms([(true, self)]))
    }

    /// `left = right`
    pub fn equation(left: Self, right: Self) -> Self {
        Self::Row(vec![left, Self::Operator(Operator::Equals), right])
    }

    pub(crate) fn digits(value: impl ToString) -> Self {
        Self::Number(value.to_string())
    }

    pub(crate) fn over(self, below: Self) -> Self {
        Self::Fraction(Box::new(self), Box::new(below))
    }

    pub(crate) fn raised_to(self, exponent: Self) -> Self {
        Self::Power(Box::new(self), Box::new(exponent))
    }

    /// With brackets if it is a row of terms.
    pub(crate) fn into_term(self) -> Self {
        if matches!(self, Self::Row(_)) { self.bracketed() } else { self }
    }

    pub(crate) fn bracketed(self) -> Self {
        Self::Brackets(Box::new(self))
    }

    /// One factor as it is, several as a product, none as the number 1.
    pub(crate) fn product(mut factors: Vec<Self>) -> Self {
        match factors.len() {
            0 => Self::digits(1),
            1 => factors.swap_remove(0),
            _ => Self::Product(factors),
        }
    }
}
