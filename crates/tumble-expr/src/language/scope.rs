//! What names mean: the values and functions a formula may use.

use std::collections::BTreeMap;
use std::sync::Arc;

use thiserror::Error;

use super::Formula;
use super::builtins::is_reserved;
use super::error::FormulaError;
use super::header::Header;
use super::lexer::name_end;
use super::value::Value;
use crate::Table;

/// A function the user wrote: `w(t)` with its body.
#[derive(Clone, Debug)]
pub struct Function {
    /// Name and arguments.
    pub header: Header,
    /// What it computes of them.
    pub body: Formula,
}

impl Function {
    /// Reads the header, such as `w(t)`, and the body.
    ///
    /// The mistakes of the header come first; where it has any the body is not read, so that all spans are
    /// of one text.
    pub fn parse(header: &str, body: &str) -> Result<Self, FunctionError> {
        let header = Header::parse(header).map_err(FunctionError::Header)?;
        let body = super::parse(body).map_err(FunctionError::Body)?;
        Ok(Self { header, body })
    }
}

/// A function that was measured: `gust(t)`.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Its values; the table's name is the function's.
    pub table: Arc<Table>,
    /// What its variable is called, for messages.
    pub variable: String,
}

/// Mistakes of a function, by the text they are in.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FunctionError {
    /// Mistakes in the header.
    #[error("mistakes in the header of a function")]
    Header(Vec<FormulaError>),
    /// Mistakes in the body.
    #[error("mistakes in the body of a function")]
    Body(Vec<FormulaError>),
}

/// A name that cannot be given a meaning.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum ScopeError {
    /// Every formula knows it already.
    #[error("`{0}` is a name that every formula knows, and cannot be given another meaning")]
    Reserved(Arc<str>),
    /// It has a meaning already.
    #[error("`{0}` is defined twice")]
    Twice(Arc<str>),
    /// It is not spelled like a name.
    #[error("`{0}` is not a name: names begin with a letter and go on with letters, digits and underscores")]
    NotAName(Arc<str>),
}

/// The names formulas are checked with.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    values: BTreeMap<Arc<str>, Value>,
    functions: BTreeMap<Arc<str>, Arc<Function>>,
    measured: BTreeMap<Arc<str>, Measured>,
}

impl Scope {
    /// A scope in which only the built-in functions and pi have a meaning.
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives a name, which may have dots, to a number or a vector.
    pub fn define(&mut self, name: &str, value: impl Into<Value>) -> Result<(), ScopeError> {
        let name = self.free(name)?;
        self.values.insert(name, value.into());
        Ok(())
    }

    /// Adds a function; what its body calls may be added later, but before it is used.
    pub fn define_function(&mut self, function: Function) -> Result<(), ScopeError> {
        let name = self.free(&function.header.name)?;
        self.functions.insert(name, Arc::new(function));
        Ok(())
    }

    /// Adds a measured function of one variable.
    pub fn define_measured(&mut self, measured: Measured) -> Result<(), ScopeError> {
        let name = self.free(&measured.table.name)?;
        self.measured.insert(name, measured);
        Ok(())
    }

    /// The value of a name.
    pub fn value(&self, name: &str) -> Option<&Value> {
        self.values.get(name)
    }

    /// The user's function of a name.
    pub fn function(&self, name: &str) -> Option<&Arc<Function>> {
        self.functions.get(name)
    }

    /// The measured function of a name.
    pub fn measured(&self, name: &str) -> Option<&Measured> {
        self.measured.get(name)
    }

    /// Whether a name can be called: a function of the user's, or a measured one.
    pub fn is_function(&self, name: &str) -> bool {
        self.functions.contains_key(name) || self.measured.contains_key(name)
    }

    /// The names of all values, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> + Clone {
        self.values.keys().map(|name| &**name)
    }

    /// The names of the user's functions, sorted.
    pub fn function_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.functions.keys().map(|name| &**name)
    }

    /// The names of all measured functions, sorted.
    pub fn measured_names(&self) -> impl Iterator<Item = &str> + Clone {
        self.measured.keys().map(|name| &**name)
    }

    fn free(&self, name: &str) -> Result<Arc<str>, ScopeError> {
        let shared: Arc<str> = name.into();
        if !is_name(name) {
            Err(ScopeError::NotAName(shared))
        } else if is_reserved(name) {
            Err(ScopeError::Reserved(shared))
        } else if self.values.contains_key(name) || self.is_function(name) {
            Err(ScopeError::Twice(shared))
        } else {
            Ok(shared)
        }
    }
}

/// Whether formulas can refer to it: words joined by dots.
pub fn is_name(text: &str) -> bool {
    let begins = text.starts_with(super::characters::begins_word);
    let mixed = super::characters::mixed_alphabets(text, 0).is_some();
    begins && name_end(text, 0) == text.len() && !mixed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Expr;

    #[test]
    fn names_are_defined_once_and_no_builtin_is_shadowed() {
        let mut scope = Scope::new();
        assert_eq!(scope.define("rod.tip.x", Expr::one()), Ok(()));
        assert_eq!(scope.define("rod.tip.x", Expr::one()), Err(ScopeError::Twice("rod.tip.x".into())));
        assert_eq!(scope.define("sin", Expr::one()), Err(ScopeError::Reserved("sin".into())));
        assert_eq!(scope.define("pi", Expr::one()), Err(ScopeError::Reserved("pi".into())));
        for word in ["", "2x", "a b", "x.", "a-b", "%", "mа"] {
            assert_eq!(scope.define(word, Expr::one()), Err(ScopeError::NotAName(word.into())), "{word}");
        }
    }

    #[test]
    fn a_function_and_a_value_cannot_share_a_name() {
        let mut scope = Scope::new();
        let function = || Function::parse("w(t)", "2*t").expect("parses");
        assert_eq!(scope.define_function(function()), Ok(()));
        assert_eq!(scope.define("w", Expr::one()), Err(ScopeError::Twice("w".into())));
        assert!(matches!(Function::parse("w(t", "2"), Err(FunctionError::Header(_))));
        assert!(matches!(Function::parse("w(t)", "2+"), Err(FunctionError::Body(_))));
    }

    #[test]
    fn a_measured_function_takes_what_it_was_measured_over() {
        use super::super::{Code, parse};
        use crate::{Dimension, Interpolation, Outside};

        let rows = [[0.0, 1.0], [1.0, 3.0]];
        let dimensions = [Dimension::TIME, Dimension::SPEED];
        let table =
            Table::new("gust", dimensions, &rows, Interpolation::Linear, Outside::Hold).expect("a table");
        let mut scope = Scope::new();
        scope.define("t", Expr::symbol("t", Dimension::TIME)).expect("free");
        scope.define("h", Expr::symbol("h", Dimension::LENGTH)).expect("free");
        let measured = Measured { table: Arc::new(table), variable: "t".into() };
        assert_eq!(scope.define_measured(measured.clone()), Ok(()));
        assert_eq!(scope.define_measured(measured), Err(ScopeError::Twice("gust".into())));
        assert!(scope.is_function("gust") && scope.function("gust").is_none());

        let speed = |text: &str| parse(text).expect("parses").check_number(&scope, Dimension::SPEED);
        assert!(speed("2*gust(t - 1 s) + gust(0)").is_ok());
        let code = |text: &str| speed(text).expect_err(text)[0].code;
        assert_eq!(code("gust(h)"), Code::Variable);
        assert_eq!(code("gust([t, t])"), Code::Variable);
        assert_eq!(code("gust()"), Code::ArgumentCount);
        assert_eq!(code("gust"), Code::NotCallable);
        assert_eq!(code("gast(t)"), Code::UnknownFunction);
        assert_eq!(code("gust(t)*(1 s)"), Code::Expected);
    }

    #[test]
    fn names_of_one_formula_are_not_those_of_functions() {
        use super::super::parse;
        use crate::Dimension;

        let mut scope = Scope::new();
        scope.define("x", Expr::symbol("parameter", Dimension::TIME)).expect("free");
        scope.define_function(Function::parse("f(a)", "a*x").expect("parses")).expect("free");
        let own: [(Arc<str>, Value); 1] = [("x".into(), Expr::symbol("x", Dimension::LENGTH).into())];
        let dimension = |text: &str| match parse(text).expect("parses").check_with(&scope, &own) {
            Ok(Value::Scalar(value)) => value.dimension().expect("typed"),
            other => panic!("{other:?}"),
        };
        assert_eq!(dimension("x"), Dimension::LENGTH);
        assert_eq!(dimension("f(1)"), Dimension::TIME);
    }
}
