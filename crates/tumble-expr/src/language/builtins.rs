//! The functions every formula knows.

use super::value::{Value, ValueError, alike};
use crate::expr::{Binary, Unary};
use crate::{Expr, Vector};

/// A function every formula knows.
pub struct Builtin {
    /// Its name.
    pub name: &'static str,
    /// Its arguments as a reader is shown them.
    pub arguments: &'static str,
    /// What it is, in a few words.
    pub summary: &'static str,
    least: usize,
    most: usize,
    rule: Rule,
}

enum Rule {
    Unary(Unary),
    Pair(Binary),
    Fold(Binary),
    Other(fn(&[Value]) -> Result<Value, ValueError>),
}

/// The one name that every formula knows.
pub const PI: &str = "pi";

const fn one(name: &'static str, arguments: &'static str, op: Unary, summary: &'static str) -> Builtin {
    Builtin { name, arguments, summary, least: 1, most: 1, rule: Rule::Unary(op) }
}

const fn other(
    name: &'static str,
    arguments: &'static str,
    count: usize,
    rule: fn(&[Value]) -> Result<Value, ValueError>,
    summary: &'static str,
) -> Builtin {
    Builtin { name, arguments, summary, least: count, most: count, rule: Rule::Other(rule) }
}

const fn extreme(name: &'static str, op: Binary, summary: &'static str) -> Builtin {
    let most = usize::MAX;
    Builtin { name, arguments: "a, b, ...", summary, least: 2, most, rule: Rule::Fold(op) }
}

/// Every function there is without the user's own.
pub const BUILTINS: &[Builtin] = &[
    one("sin", "angle", Unary::Sin, "sine"),
    one("cos", "angle", Unary::Cos, "cosine"),
    one("tan", "angle", Unary::Tan, "tangent"),
    one("asin", "x", Unary::Asin, "angle whose sine is x"),
    one("acos", "x", Unary::Acos, "angle whose cosine is x"),
    one("atan", "x", Unary::Atan, "angle whose tangent is x"),
    Builtin {
        name: "atan2",
        arguments: "y, x",
        summary: "angle of the point (x, y)",
        least: 2,
        most: 2,
        rule: Rule::Pair(Binary::Atan2),
    },
    one("sinh", "x", Unary::Sinh, "hyperbolic sine"),
    one("cosh", "x", Unary::Cosh, "hyperbolic cosine"),
    one("tanh", "x", Unary::Tanh, "hyperbolic tangent"),
    one("exp", "x", Unary::Exp, "exponential"),
    one("log", "x", Unary::Log, "natural logarithm"),
    one("sqrt", "x", Unary::Sqrt, "square root, of any dimension"),
    one("abs", "x", Unary::Abs, "absolute value"),
    one("sign", "x", Unary::Sign, "-1, 0 or 1"),
    extreme("min", Binary::Min, "the least"),
    extreme("max", Binary::Max, "the greatest"),
    one("step", "x", Unary::Step, "0 before zero, 1 from zero on"),
    other("pulse", "t, from, to", 3, pulse, "1 from `from` on and before `to`, else 0"),
    other("if", "condition, then, otherwise", 3, select, "the one value or the other"),
    other("dot", "a, b", 2, dot, "scalar product"),
    other("cross", "a, b", 2, cross, "vector product; in the plane, its component out of it"),
    other("norm", "a", 1, norm, "length of a vector"),
];

/// Names of functions in other languages.
const ELSEWHERE: &[(&str, &str)] = &[
    ("ln", "log"),
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("tg", "tan"),
    ("sgn", "sign"),
    ("heaviside", "step"),
    ("mag", "norm"),
    ("magnitude", "norm"),
    ("length", "norm"),
    ("hypot", "norm([a, b])"),
    ("pow", "a^b"),
    ("where", "if"),
    ("select", "if"),
];

/// The function of this name.
pub fn builtin(name: &str) -> Option<&'static Builtin> {
    BUILTINS.iter().find(|builtin| builtin.name == name)
}

/// Whether every formula gives this name a meaning, so that no scene may.
pub fn is_reserved(name: &str) -> bool {
    name == PI || builtin(name).is_some()
}

/// What a function of another language is called here.
pub(super) fn elsewhere(name: &str) -> Option<&'static str> {
    ELSEWHERE.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, here)| *here)
}

impl Builtin {
    /// Whether it takes so many arguments.
    pub(super) fn takes(&self, count: usize) -> bool {
        (self.least..=self.most).contains(&count)
    }

    /// How many arguments it takes, in words.
    pub(super) fn count(&self) -> String {
        match (self.least, self.most) {
            (1, 1) => "1 argument".to_owned(),
            (least, most) if least == most => format!("{least} arguments"),
            (least, _) => format!("{least} arguments or more"),
        }
    }

    /// Its value for arguments of the right number.
    pub(super) fn call(&self, arguments: &[Value]) -> Result<Value, ValueError> {
        let number = |at: usize| arguments[at].number(self.name).cloned();
        let value = match self.rule {
            Rule::Unary(op) => Expr::unary(op, number(0)?).into(),
            Rule::Pair(op) => Expr::binary(op, number(0)?, number(1)?).into(),
            Rule::Fold(op) => self.fold(op, arguments)?.into(),
            Rule::Other(rule) => rule(arguments)?,
        };
        value.checked()
    }

    fn fold(&self, op: Binary, arguments: &[Value]) -> Result<Expr, ValueError> {
        let numbers: Vec<_> =
            arguments.iter().map(|a| a.number(self.name).cloned()).collect::<Result<_, _>>()?;
        let folded = numbers.into_iter().reduce(|a, b| Expr::binary(op, a, b));
        Ok(folded.unwrap_or_else(Expr::zero))
    }
}

fn pulse(arguments: &[Value]) -> Result<Value, ValueError> {
    let number = |at: usize| arguments[at].number("pulse");
    Ok(Expr::pulse(number(0)?, number(1)?, number(2)?).into())
}

fn select(arguments: &[Value]) -> Result<Value, ValueError> {
    let condition = arguments[0].number("the condition of if")?;
    let choose = |a: &Expr, b: &Expr| Expr::select(condition.clone(), a.clone(), b.clone());
    arguments[1].zip(&arguments[2], "chooses between", choose)
}

fn dot(arguments: &[Value]) -> Result<Value, ValueError> {
    Ok(arguments[0].vector("dot")?.dot(arguments[1].vector("dot")?)?.into())
}

fn cross(arguments: &[Value]) -> Result<Value, ValueError> {
    let (a, b) = (arguments[0].vector("cross")?, arguments[1].vector("cross")?);
    alike("multiplies", a.components().len(), b.components().len())?;
    match a.components().len() {
        2 => Ok(a.cross_planar(b).into()),
        _ => Ok(a.cross(b)?.into()),
    }
}

fn norm(arguments: &[Value]) -> Result<Value, ValueError> {
    Ok(Vector::norm(arguments[0].vector("norm")?).into())
}
