//! The formula language: text to checked formulas.
//!
//! ```
//! use tumble_expr::language::{Scope, Value, parse};
//! use tumble_expr::{Dimension, Expr};
//!
//! let mut scope = Scope::new();
//! scope.define("V", Expr::symbol("V", Dimension::SPEED))?;
//! let formula = parse("V*20 ms + 3 cm").map_err(|errors| errors[0].clone())?;
//! let Value::Scalar(length) = formula.check(&scope).map_err(|errors| errors[0].clone())? else { panic!() };
//! assert_eq!(length.dimension()?, Dimension::LENGTH);
//!
//! let mistakes = parse("V + 3 cm").unwrap().check(&scope).unwrap_err();
//! assert_eq!(mistakes[0].code.as_str(), "E0401");
//! assert_eq!(mistakes[0].labels[1], (4..8, "a length (m)".to_owned()));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Grammar
//!
//! From loose to tight: comparisons `< <= > >=` (which do not chain), `+ -`, `* /`, a leading sign, `^` (to the
//! right, so that `2^3^2` is 2^9 and `-2^2` is -4); calls `f(a, b)`, vectors `[a, b]`, brackets. Names begin
//! with a letter of any alphabet and go on with letters, digits and underscores; dots join them (`rod.tip.vx`)
//! and counts tell repetitions apart (`floor.contact[1].start`).
//!
//! # Units
//!
//! A number directly followed, spaces allowed, by a chain of units *without inner spaces* is a quantity:
//! `9.81 m/s^2`, `3 kg*m^2/s^2`, `1 m^(1/2)`, `10%`. The chain ends at the first space, before a number, before
//! a name with a dot and before a call: `2 m / L` divides by what is named `L`. Everything else that is a
//! word is a name. Brackets behind a slash belong to the chain where they hold units only, `2 kg/(m*s)`, and a chain
//! may begin with `1/`: `20 1/s`. Every dimension prints as a chain that reads back as itself.
//!
//! A scene may have names that are also units (`m`, `L`). What a unit's word stands for is decided so:
//!
//! - in a quantity with brackets of its own, `(2 m)`, units are units;
//! - in a quantity that is a whole formula, argument or component, `m = "1 kg"`, `[0, 2 m]`, units are units too,
//!   unless the chain has several words and *every* one of them is a name (`2 m/L`), or every word in a pair of its
//!   brackets is one (`2 kg/(m*L)`): that is an error;
//! - among operators, `x + 2 m`, a chain with a word that is also a name is an error, which offers `2*m` and `(2 m)`;
//! - a word that is a name but no unit is never part of a chain: `2 m/R` is an error, which offers `2 m / R`.
//!
//! A bare `0` has every dimension; a zero with a unit has the unit's.
//!
//! # Functions
//!
//! Besides those that every formula knows there are the user's own, which are written out where they are called, and
//! measured ones of one variable, whose argument must measure what the table's variable does.
//!
//! # Mistakes
//!
//! Every independent mistake of a formula is reported (up to [`MAX_ERRORS`]), each with a [`Code`], the parts
//! of the text it lies in and, mostly, its cure. Nothing recurses over the text, so no text overflows the stack.

mod builtins;
mod characters;
mod check;
mod codes;
mod complaints;
mod error;
mod header;
mod lexer;
mod names;
mod numbers;
mod parser;
mod quantity;
mod scope;
mod stated_unit;
mod suggest;
mod syntax;
mod unit_chain;
mod units;
mod value;

#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use builtins::{BUILTINS, Builtin, PI, builtin, is_reserved};
pub use error::{CallSite, Code, FormulaError, Span, SpannedText};
pub use header::Header;
pub use scope::{Function, FunctionError, Measured, Scope, ScopeError, is_name};
pub use stated_unit::StatedUnit;
pub use suggest::nearest;
pub use syntax::{BinaryOperator, NodeId, Standing, Syntax, SyntaxNode, Tree};
pub use unit_chain::{Chain, Factor};
pub use units::{NamedUnit, UNITS, UnitTag, nearest_unit, unit};
pub use value::Value;

use crate::{Dimension, Expr, Kind, TypeError, Vector};

/// A formula may have this many bytes.
pub const MAX_LENGTH: usize = 64 * 1024;

/// This many mistakes of a formula are reported.
pub const MAX_ERRORS: usize = 100;

/// A formula whose text is well formed; its names have no meaning yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    text: Arc<str>,
    tree: Tree,
}

/// A name that stands in a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameUse<'f> {
    /// The name.
    pub name: &'f str,
    /// Where it stands.
    pub span: Span,
    /// Whether it is called, `w(t)`, or stands for a value.
    pub called: bool,
}

/// Reads a formula.
pub fn parse(text: &str) -> Result<Formula, Vec<FormulaError>> {
    refuse_size(text).map_err(|error| vec![error])?;
    let lexed = lexer::lex(text);
    let mut errors = lexed.errors;
    match parser::parse(text, lexed.tokens) {
        Ok(tree) if errors.is_empty() => return Ok(Formula { text: text.into(), tree }),
        Err(found) if lexed.complete => errors.extend(found),
        _ => {}
    }
    errors.sort_by_key(|error| error.labels.first().map_or(0, |(span, _)| span.start));
    errors.truncate(MAX_ERRORS);
    Err(errors)
}

fn refuse_size(text: &str) -> Result<(), FormulaError> {
    if text.len() > MAX_LENGTH {
        let message = format!("a formula has at most {MAX_LENGTH} bytes, not {}", text.len());
        return Err(FormulaError::new(Code::TooLong, 0..text.len(), message));
    }
    if text.trim().is_empty() {
        return Err(FormulaError::new(Code::Empty, 0..text.len(), "there is no formula"));
    }
    Ok(())
}

impl Formula {
    /// The text as it was read.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its parts, in which every part stands behind those it is made of.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The names it uses as they follow each other, those that every formula knows left out.
    pub fn names(&self) -> Vec<NameUse<'_>> {
        let mut names: Vec<_> =
            self.tree.nodes.iter().filter_map(|node| self.name_use(&node.syntax)).collect();
        names.sort_by_key(|name| name.span.start);
        names
    }

    fn name_use(&self, syntax: &Syntax) -> Option<NameUse<'_>> {
        let (span, called) = match syntax {
            Syntax::Name(span) => (span, false),
            Syntax::Call(span, _) => (span, true),
            _ => return None,
        };
        let name = &self.text[span.clone()];
        (!is_reserved(name)).then(|| NameUse { name, span: span.clone(), called })
    }

    /// Its value in a scope, or every independent mistake.
    pub fn check(&self, scope: &Scope) -> Result<Value, Vec<FormulaError>> {
        check::check(self, scope, &[])
    }

    /// The same with names that only this formula knows; the bodies of functions that it calls do not.
    pub fn check_with(&self, scope: &Scope, own: &[(Arc<str>, Value)]) -> Result<Value, Vec<FormulaError>> {
        check::check(self, scope, own)
    }

    /// Its value, which must be a number of this dimension.
    pub fn check_number(&self, scope: &Scope, dimension: Dimension) -> Result<Expr, Vec<FormulaError>> {
        self.number(self.check(scope)?, dimension)
    }

    /// A value of this formula, which must be a number of this dimension.
    pub fn number(&self, value: Value, dimension: Dimension) -> Result<Expr, Vec<FormulaError>> {
        self.demand(value.expect(dimension))?;
        match value {
            Value::Scalar(expr) => Ok(expr),
            Value::Vector(_) => Err(vec![self.shape("a number", &value)]),
        }
    }

    /// Its value, which must be a vector of this dimension.
    pub fn check_vector(&self, scope: &Scope, dimension: Dimension) -> Result<Vector, Vec<FormulaError>> {
        let value = self.check(scope)?;
        self.demand(value.expect(dimension))?;
        match value {
            Value::Vector(vector) => Ok(vector),
            Value::Scalar(_) => Err(vec![self.shape("a vector", &value)]),
        }
    }

    /// Its value, which must be a comparison.
    pub fn check_condition(&self, scope: &Scope) -> Result<Expr, Vec<FormulaError>> {
        let value = self.check(scope)?;
        match value {
            Value::Scalar(expr) if expr.kind() == Ok(Kind::Truth) => Ok(expr),
            other => Err(vec![self.shape("a comparison such as `a < b`", &other)]),
        }
    }

    /// Which unit it states, for places where an angle must say that it is one.
    pub fn stated_unit(&self) -> StatedUnit {
        stated_unit::stated_unit(self)
    }

    /// A mistake unless the formula may stand for an angle, or an angle per time: `35` and `2 Hz` may not.
    pub fn demand_angle_unit(&self) -> Result<(), FormulaError> {
        stated_unit::demand_angle(self)
    }

    fn demand(&self, outcome: Result<(), TypeError>) -> Result<(), Vec<FormulaError>> {
        outcome.map_err(|error| vec![FormulaError::new(Code::from(&error), self.span(), error.to_string())])
    }

    fn shape(&self, expected: &str, found: &Value) -> FormulaError {
        let message = format!("expected {expected}, found {}", found.describe());
        FormulaError::new(Code::Shape, self.span(), message)
    }

    /// The text without the spaces around it.
    fn span(&self) -> Span {
        self.text.len() - self.text.trim_start().len()..self.text.trim_end().len()
    }
}
