//! What may be combined with what: the dimension rules, one function a shape of node.

use num_traits::ToPrimitive;
use thiserror::Error;

use crate::expr::{Binary, Expr, Unary};
use crate::{Dimension, Exponent};

/// What a formula's value is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A literal zero, which has every dimension.
    Zero,
    /// A number with its dimension.
    Quantity(Dimension),
    /// The outcome of a comparison.
    Truth,
    /// A linear system, of whose unknowns each is a formula with its own dimension.
    System,
}

impl Kind {
    /// The dimension; a bare zero counts as a pure number.
    pub fn dimension(self) -> Result<Dimension, TypeError> {
        match self {
            Self::Zero => Ok(Dimension::NONE),
            Self::Quantity(dimension) => Ok(dimension),
            Self::Truth => Err(TypeError::TruthAsNumber),
            Self::System => Err(TypeError::SystemAsNumber),
        }
    }

    /// In words, with an article.
    pub fn describe(self) -> String {
        match self {
            Self::Zero => "a bare zero".to_owned(),
            Self::Quantity(dimension) => dimension.describe(),
            Self::Truth => "a comparison".to_owned(),
            Self::System => "a linear system".to_owned(),
        }
    }
}

/// A formula whose parts do not fit together.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TypeError {
    /// Two quantities that must be alike are not.
    #[error("this {verb} {} and {}", .left.describe(), .right.describe())]
    Unlike {
        /// What is done with them: "adds", "compares", ...
        verb: &'static str,
        /// Left operand.
        left: Kind,
        /// Right operand.
        right: Kind,
    },
    /// A function wants a pure number.
    #[error("{function} takes a pure number or an angle, not {}", .found.describe())]
    NotPure {
        /// Name of the function.
        function: &'static str,
        /// What it was given.
        found: Kind,
    },
    /// A dimension other than the one asked for.
    #[error("expected {}, found {}", .expected.describe(), .found.describe())]
    Expected {
        /// What the place asks for.
        expected: Dimension,
        /// What stands there.
        found: Kind,
    },
    /// A quantity with a dimension was raised to a power that is not a plain number.
    #[error("{} can only be raised to a plain number, not to a formula", .base.describe())]
    VariableExponent {
        /// The base.
        base: Kind,
    },
    /// Exponents beyond what is kept.
    #[error("the exponents of this dimension are out of range")]
    ExponentRange,
    /// A comparison stands where a number is needed.
    #[error("a comparison is not a number: use if(condition, a, b)")]
    TruthAsNumber,
    /// A number stands where a comparison is needed.
    #[error("expected a comparison such as a < b, found {}", .found.describe())]
    NumberAsTruth {
        /// What stands there.
        found: Kind,
    },
    /// A number that is infinite or not a number.
    #[error("{value} is not a finite number")]
    NotFinite {
        /// The number.
        value: f64,
    },
    /// A vector operation on vectors of unequal length.
    #[error("this {verb} a vector of {left} components and one of {right}")]
    Lengths {
        /// What is done with them.
        verb: &'static str,
        /// Components of the left one.
        left: usize,
        /// Components of the right one.
        right: usize,
    },
    /// A linear system whose matrix is not square, or does not fit its right sides.
    #[error(
        "a linear system of {equations} right sides has a matrix of {rows} rows, one of them with {columns} entries"
    )]
    NotSquare {
        /// Right sides.
        equations: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Entries of the first row that has the wrong number of them, or of the first row.
        columns: usize,
    },
    /// A linear system stands where one of its unknowns is needed.
    #[error("a linear system is not a number: one of its unknowns is")]
    SystemAsNumber,
}

pub(crate) fn unary(op: Unary, a: Kind) -> Result<Kind, TypeError> {
    let dimension = a.dimension()?;
    match op {
        Unary::Neg | Unary::Abs => Ok(a),
        Unary::Sqrt => power_of(a, Exponent::new(1, 2)),
        Unary::Sign | Unary::Step => Ok(Kind::Quantity(Dimension::NONE)),
        _ if dimension == Dimension::NONE => Ok(Kind::Quantity(Dimension::NONE)),
        _ => Err(TypeError::NotPure { function: op.name(), found: a }),
    }
}

pub(crate) fn binary(op: Binary, a: Kind, b: Kind) -> Result<Kind, TypeError> {
    let (left, right) = (a.dimension()?, b.dimension()?);
    let overflow = TypeError::ExponentRange;
    match op {
        Binary::Add => same("adds", a, b),
        Binary::Sub => same("subtracts", a, b),
        Binary::Min | Binary::Max => same("compares", a, b),
        Binary::Atan2 => same("takes the angle of", a, b).map(|_| Kind::Quantity(Dimension::NONE)),
        Binary::Mul if a == Kind::Zero || b == Kind::Zero => Ok(Kind::Zero),
        Binary::Mul => left.times(right).map(Kind::Quantity).ok_or(overflow),
        Binary::Div if a == Kind::Zero => Ok(Kind::Zero),
        Binary::Div => left.over(right).map(Kind::Quantity).ok_or(overflow),
        Binary::SquareOver if a == Kind::Zero => Ok(Kind::Zero),
        Binary::SquareOver => {
            let square = left.times(left).ok_or(overflow.clone())?;
            square.over(right).map(Kind::Quantity).ok_or(overflow)
        }
        Binary::Pow => unreachable!("powers are typed by `power`, which sees the exponent's value"),
    }
}

/// The common kind of two operands that must be alike.
pub(crate) fn same(verb: &'static str, a: Kind, b: Kind) -> Result<Kind, TypeError> {
    for kind in [a, b] {
        kind.dimension()?;
    }
    match (a, b) {
        (Kind::Zero, other) | (other, Kind::Zero) => Ok(other),
        (a, b) if a == b => Ok(a),
        (left, right) => Err(TypeError::Unlike { verb, left, right }),
    }
}

pub(crate) fn power(base: &Expr, exponent: &Expr) -> Result<Kind, TypeError> {
    let (kind, exponent_kind) = (base.kind()?, exponent.kind()?);
    if exponent_kind.dimension()? != Dimension::NONE {
        return Err(TypeError::NotPure { function: "an exponent", found: exponent_kind });
    }
    if kind.dimension()? == Dimension::NONE {
        return Ok(Kind::Quantity(Dimension::NONE));
    }
    let exact = plain(exponent, PLAIN_DEPTH).ok_or(TypeError::VariableExponent { base: kind })?;
    power_of(kind, exact)
}

/// Plain exponents are looked for this deep, so that no formula can overflow the stack.
const PLAIN_DEPTH: usize = 16;

/// The exponent, where the formula is a (negated) plain number or a quotient of such.
fn plain(exponent: &Expr, depth: usize) -> Option<Exponent> {
    use crate::expr::Node;
    let deeper = depth.checked_sub(1)?;
    match exponent.node() {
        Node::Number(value) => Some(Exponent::new(value.numer().to_i32()?, value.denom().to_i32()?)),
        Node::Unary(Unary::Neg, a) => Some(-plain(a, deeper)?),
        Node::Binary(Binary::Div, a, b) if !b.is_zero() => {
            num_traits::CheckedDiv::checked_div(&plain(a, deeper)?, &plain(b, deeper)?)
        }
        _ => None,
    }
}

fn power_of(kind: Kind, exponent: Exponent) -> Result<Kind, TypeError> {
    match kind {
        Kind::Quantity(dimension) => {
            dimension.power(exponent).map(Kind::Quantity).ok_or(TypeError::ExponentRange)
        }
        other => Ok(other),
    }
}

pub(crate) fn select(condition: &Expr, then: &Expr, otherwise: &Expr) -> Result<Kind, TypeError> {
    match condition.kind()? {
        Kind::Truth => same("chooses between", then.kind()?, otherwise.kind()?),
        found => Err(TypeError::NumberAsTruth { found }),
    }
}

pub(crate) fn norm(components: &[Expr]) -> Result<Kind, TypeError> {
    components.iter().try_fold(Kind::Zero, |kind, part| same("takes the length of", kind, part.kind()?))
}

impl Unary {
    /// The function's name in formulas.
    pub fn name(self) -> &'static str {
        match self {
            Self::Neg => "-",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Exp => "exp",
            Self::Log => "log",
            Self::Sqrt => "sqrt",
            Self::Abs => "abs",
            Self::Sign => "sign",
            Self::Step => "step",
        }
    }
}
