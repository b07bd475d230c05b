//! A formula: an immutable, shared tree whose every node knows its dimension.

use std::collections::HashSet;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::same;
use crate::shape::SparsityPattern;
use crate::table::{Table, TableRef};
use crate::traces::Traces;
use crate::typing::{self, Kind, TypeError};
use crate::{Dimension, Exponent};

/// A named leaf: a parameter, a state, the time. Two symbols are one if their names are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Name as the user writes it, such as `rod.tip.vx`.
    pub name: Arc<str>,
    /// What it measures.
    pub dimension: Dimension,
}

impl Hash for Symbol {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl Symbol {
    /// A symbol of that name and dimension.
    pub fn new(name: impl Into<Arc<str>>, dimension: Dimension) -> Self {
        Self { name: name.into(), dimension }
    }
}

/// Functions of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Unary {
    Neg,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Log,
    Sqrt,
    Abs,
    /// -1, 0 or 1.
    Sign,
    /// 0 below zero, 1 from zero on.
    Step,
}

/// Functions of two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Pow,
    /// `atan2(y, x)`
    Atan2,
    Min,
    Max,
    /// `a^2 / b`, with its limit where both vanish together and a at least as fast as b.
    SquareOver,
}

/// Comparisons; `a > b` is written `b < a`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Relation {
    Less,
    LessEqual,
}

/// What a formula is made of, over whatever stands for its parts: [`Expr`] in a tree, an index in a graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node<Part = Expr> {
    /// An exact number, in SI units.
    Number(BigRational),
    /// The ratio of a circle's circumference to its diameter, as exact as the evaluator's number.
    Pi,
    /// A named leaf.
    Symbol(Symbol),
    /// A function of one formula.
    Unary(Unary, Part),
    /// A function of two formulas.
    Binary(Binary, Part, Part),
    /// A comparison; its kind is [`Kind::Truth`].
    Compare(Relation, Part, Part),
    /// `if(condition, then, otherwise)`
    Select(Part, Part, Part),
    /// Euclidean length of the components.
    Norm(Vec<Part>),
    /// A measured function.
    Table(TableRef, Part),
    /// A linear system: the entries of its matrix that are not bare zeros, row by row, then its right sides. Its kind is
    /// [`Kind::System`].
    System(Arc<SparsityPattern>, Vec<Part>),
    /// An unknown of a linear system, by its index.
    Unknown(Part, u32),
}

impl<Part> Node<Part> {
    /// The parts this node is made of, left to right.
    pub fn parts(&self) -> Vec<&Part> {
        match self {
            Self::Number(_) | Self::Pi | Self::Symbol(_) => vec![],
            Self::Unary(_, a) => vec![a],
            Self::Binary(_, a, b) | Self::Compare(_, a, b) => vec![a, b],
            Self::Select(a, b, c) => vec![a, b, c],
            Self::Norm(parts) | Self::System(_, parts) => parts.iter().collect(),
            Self::Table(_, a) | Self::Unknown(a, _) => vec![a],
        }
    }

    /// Hands over each of the parts, left to right.
    pub fn each_part<'a>(&'a self, mut f: impl FnMut(&'a Part)) {
        match self {
            Self::Number(_) | Self::Pi | Self::Symbol(_) => {}
            Self::Unary(_, a) | Self::Table(_, a) | Self::Unknown(a, _) => f(a),
            Self::Binary(_, a, b) | Self::Compare(_, a, b) => [a, b].into_iter().for_each(f),
            Self::Select(a, b, c) => [a, b, c].into_iter().for_each(f),
            Self::Norm(parts) | Self::System(_, parts) => parts.iter().for_each(&mut f),
        }
    }

    /// The same node over other parts.
    pub fn map<Other>(&self, mut f: impl FnMut(&Part) -> Other) -> Node<Other> {
        match self {
            Self::Number(value) => Node::Number(value.clone()),
            Self::Pi => Node::Pi,
            Self::Symbol(symbol) => Node::Symbol(symbol.clone()),
            Self::Unary(op, a) => Node::Unary(*op, f(a)),
            Self::Binary(op, a, b) => Node::Binary(*op, f(a), f(b)),
            Self::Compare(relation, a, b) => Node::Compare(*relation, f(a), f(b)),
            Self::Select(a, b, c) => Node::Select(f(a), f(b), f(c)),
            Self::Norm(parts) => Node::Norm(parts.iter().map(f).collect()),
            Self::Table(table, a) => Node::Table(table.clone(), f(a)),
            Self::System(shape, parts) => Node::System(Arc::clone(shape), parts.iter().map(f).collect()),
            Self::Unknown(system, row) => Node::Unknown(f(system), *row),
        }
    }
}

/// A formula with its dimension; cheap to clone.
///
/// The operators never fail: a formula that adds a length to a mass carries that error, and
/// [`Expr::kind`] and everything that compiles formulas report it.
#[derive(Clone)]
pub struct Expr(pub(crate) Arc<Inner>);

pub(crate) struct Inner {
    pub(crate) node: Node,
    /// Which symbols may be in it.
    pub(crate) traces: Traces,
    /// Equal for formulas that are written alike.
    pub(crate) hash: u64,
    pub(crate) kind: Result<Kind, Arc<TypeError>>,
}

impl Expr {
    /// A number in SI units with its dimension. A bare zero has every dimension.
    pub fn quantity(value: BigRational, dimension: Dimension) -> Self {
        let kind = if value.is_zero() { Kind::Zero } else { Kind::Quantity(dimension) };
        Self::make(Node::Number(value), Ok(kind))
    }

    /// A pure number.
    pub fn number(value: BigRational) -> Self {
        Self::quantity(value, Dimension::NONE)
    }

    /// The pure number 0, of every dimension.
    pub fn zero() -> Self {
        Self::number(BigRational::zero())
    }

    /// The pure number 1.
    pub fn one() -> Self {
        Self::number(BigRational::one())
    }

    /// pi
    pub fn pi() -> Self {
        Self::make(Node::Pi, Ok(Kind::Quantity(Dimension::NONE)))
    }

    /// A named leaf.
    pub fn symbol(name: impl Into<Arc<str>>, dimension: Dimension) -> Self {
        Self::from(Symbol::new(name, dimension))
    }

    /// A function of one argument.
    pub fn unary(op: Unary, a: Self) -> Self {
        let kind = a.kind().and_then(|a| typing::unary(op, a));
        Self::checked(Node::Unary(op, a), kind)
    }

    /// A function of two arguments.
    pub fn binary(op: Binary, a: Self, b: Self) -> Self {
        let kind = match op {
            Binary::Pow => typing::power(&a, &b),
            _ => a.kind().and_then(|a| typing::binary(op, a, b.kind()?)),
        };
        Self::checked(Node::Binary(op, a, b), kind)
    }

    /// `a < b` or `a <= b`.
    pub fn compare(relation: Relation, a: Self, b: Self) -> Self {
        let kind = a.kind().and_then(|a| typing::same("compares", a, b.kind()?)).map(|_| Kind::Truth);
        Self::checked(Node::Compare(relation, a, b), kind)
    }

    /// `then` where `condition` holds, else `otherwise`; both must have one dimension.
    pub fn select(condition: Self, then: Self, otherwise: Self) -> Self {
        let kind = typing::select(&condition, &then, &otherwise);
        Self::checked(Node::Select(condition, then, otherwise), kind)
    }

    /// Euclidean length of the components, which must have one dimension.
    pub fn norm(components: Vec<Self>) -> Self {
        let kind = typing::norm(&components);
        Self::checked(Node::Norm(components), kind)
    }

    /// A measured function of `x`, whose dimension must be the table's.
    pub fn table(table: &Arc<Table>, x: Self) -> Self {
        let kind = x.expect(table.x).map(|_| Kind::Quantity(table.y));
        Self::checked(Node::Table(TableRef(Arc::clone(table)), x), kind)
    }

    /// `1` from `from` on and before `to`, else `0`; never where `to` comes first.
    pub fn pulse(t: &Self, from: &Self, to: &Self) -> Self {
        (t - from).step() * (1 - (t - to).step())
    }

    /// What this formula measures, or the first mistake in it.
    pub fn kind(&self) -> Result<Kind, TypeError> {
        self.0.kind.clone().map_err(|e| (*e).clone())
    }

    /// Dimension of the value; a bare zero counts as a pure number here.
    pub fn dimension(&self) -> Result<Dimension, TypeError> {
        self.kind()?.dimension()
    }

    /// This formula, if its value may stand where `expected` is asked for.
    pub fn expect(&self, expected: Dimension) -> Result<&Self, TypeError> {
        match self.kind()? {
            Kind::Zero => Ok(self),
            Kind::Quantity(found) if found == expected => Ok(self),
            found => Err(TypeError::Expected { expected, found }),
        }
    }

    /// The node at the root.
    pub fn node(&self) -> &Node {
        &self.0.node
    }

    /// The exact number, where this formula is one.
    pub fn as_number(&self) -> Option<&BigRational> {
        match self.node() {
            Node::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Whether this is the literal zero.
    pub fn is_zero(&self) -> bool {
        self.as_number().is_some_and(Zero::is_zero)
    }

    /// The formulas this one is made of, left to right.
    pub fn children(&self) -> Vec<&Self> {
        self.node().parts()
    }

    /// The symbols in it, each once.
    pub fn symbols(&self) -> HashSet<Symbol> {
        Self::symbols_of(std::slice::from_ref(self))
    }

    /// The symbols in any of some formulas; what these share is looked through once.
    pub fn symbols_of(formulas: &[Self]) -> HashSet<Symbol> {
        let (mut seen, mut found) = (HashSet::new(), HashSet::new());
        let mut pending: Vec<&Self> = formulas.iter().collect();
        while let Some(next) = pending.pop() {
            if let Node::Symbol(symbol) = next.node() {
                found.insert(symbol.clone());
            }
            if next.0.traces.any() && seen.insert(Arc::as_ptr(&next.0)) {
                pending.extend(next.children());
            }
        }
        found
    }

    /// Whether it has a branch (abs, sign, step, min, max, if, a table) whose side depends on one of these symbols.
    pub fn branches_on(&self, symbols: &[Symbol]) -> bool {
        let traces = symbols.iter().fold(Traces::default(), |all, symbol| all | Traces::of_symbol(symbol));
        let depends = |part: &Self| {
            part.0.traces.meet(traces) && part.symbols().iter().any(|symbol| symbols.contains(symbol))
        };
        let (mut seen, mut pending) = (HashSet::new(), vec![self]);
        while let Some(next) = pending.pop() {
            if !next.0.traces.meet(traces) || !seen.insert(Arc::as_ptr(&next.0)) {
                continue;
            }
            let on = match next.node() {
                Node::Unary(Unary::Abs | Unary::Sign | Unary::Step, a) | Node::Table(_, a) => depends(a),
                Node::Binary(Binary::Min | Binary::Max, ..) => depends(next),
                Node::Select(condition, ..) => depends(condition),
                _ => false,
            };
            if on {
                return true;
            }
            pending.extend(next.children());
        }
        false
    }

    /// Raises to a rational power.
    pub fn powr(&self, exponent: Exponent) -> Self {
        let exponent = BigRational::new((*exponent.numer()).into(), (*exponent.denom()).into());
        Self::binary(Binary::Pow, self.clone(), Self::number(exponent))
    }

    /// Raises to an integer power.
    pub fn powi(&self, exponent: i32) -> Self {
        self.powr(Exponent::from_integer(exponent))
    }

    pub(crate) fn make(node: Node, kind: Result<Kind, Arc<TypeError>>) -> Self {
        Self(Arc::new(Inner { traces: Traces::of(&node), hash: same::hash_of(&node), node, kind }))
    }

    /// A formula that carries a mistake.
    pub(crate) fn mistaken(error: TypeError) -> Self {
        Self::make(Node::Pi, Err(Arc::new(error)))
    }

    pub(crate) fn checked(node: Node, kind: Result<Kind, TypeError>) -> Self {
        Self::make(node, kind.map_err(Arc::new))
    }
}

macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident => $op:ident;)*) => {
        impl Expr {
            $($(#[$doc])* pub fn $name(&self) -> Self { Self::unary(Unary::$op, self.clone()) })*
        }
    };
}

functions! {
    /// Sine of an angle in radians.
    sin => Sin;
    /// Cosine of an angle in radians.
    cos => Cos;
    /// Tangent of an angle in radians.
    tan => Tan;
    /// Exponential.
    exp => Exp;
    /// Natural logarithm.
    log => Log;
    /// Square root, of any dimension.
    sqrt => Sqrt;
    /// Absolute value.
    abs => Abs;
    /// -1, 0 or 1.
    sign => Sign;
    /// 0 below zero, 1 from zero on.
    step => Step;
}

impl From<Symbol> for Expr {
    fn from(symbol: Symbol) -> Self {
        let dimension = symbol.dimension;
        Self::make(Node::Symbol(symbol), Ok(Kind::Quantity(dimension)))
    }
}

impl From<i32> for Expr {
    fn from(value: i32) -> Self {
        Self::number(BigRational::from_integer(value.into()))
    }
}

/// The shortest decimal that reads back as this number; a number that is not finite is a mistake the formula carries.
impl From<f64> for Expr {
    fn from(value: f64) -> Self {
        match crate::unit::decimal(value) {
            Some(exact) => Self::number(exact),
            None => Self::mistaken(TypeError::NotFinite { value }),
        }
    }
}

impl fmt::Debug for Expr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.node() {
            Node::Number(value) => write!(f, "{value}"),
            Node::Pi => write!(f, "pi"),
            Node::Symbol(symbol) => write!(f, "{}", symbol.name),
            _ => write!(f, "Expr(..)"),
        }
    }
}
