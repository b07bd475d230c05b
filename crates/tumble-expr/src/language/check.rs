//! A parsed formula and a scope to a value, node by node, so that every mistake knows its place.

use std::collections::HashMap;
use std::sync::Arc;

use super::builtins::{Builtin, builtin};
use super::error::{CallSite, FormulaError, Span, SpannedText};
use super::names;
use super::quantity::Written;
use super::scope::{Function, Measured, Scope};
use super::syntax::{NodeId, Syntax, SyntaxNode};
use super::value::{Value, ValueError};
use super::{Formula, MAX_ERRORS};
use crate::Expr;

/// Calls may be nested this deep.
pub(super) const MAX_CALLS: usize = 64;
/// A formula may have this many parts when its calls are written out.
pub(super) const MAX_PARTS: usize = 100_000;

pub(super) fn check(
    formula: &Formula,
    scope: &Scope,
    arguments: &[(Arc<str>, Value)],
) -> Result<Value, Vec<FormulaError>> {
    let frame = Frame { formula, place: SpannedText::Formula, arguments, calls: None };
    let mut checker = Checker { scope, parts: 0, known: HashMap::new(), errors: Vec::new() };
    match checker.formula(&frame) {
        Some(value) if checker.errors.is_empty() => Ok(value),
        _ => Err(checker.errors),
    }
}

/// The text that is being checked, and how it was reached.
pub(super) struct Frame<'f> {
    pub(super) formula: &'f Formula,
    pub(super) place: SpannedText,
    pub(super) arguments: &'f [(Arc<str>, Value)],
    pub(super) calls: Option<&'f Call<'f>>,
}

/// A call that is being written out.
pub(super) struct Call<'f> {
    function: Arc<str>,
    span: Span,
    note: String,
    caller: &'f Frame<'f>,
    depth: usize,
}

impl<'f> Frame<'f> {
    pub(super) fn text(&self, span: &Span) -> &'f str {
        &self.formula.text()[span.clone()]
    }

    pub(super) fn argument(&self, name: &str) -> Option<&Value> {
        self.arguments.iter().find(|(other, _)| &**other == name).map(|(_, value)| value)
    }

    /// The calls that lead here, innermost first.
    fn stack(&self) -> impl Iterator<Item = &'f Call<'f>> {
        std::iter::successors(self.calls, |call| call.caller.calls)
    }

    /// The mistake with the text it is in and the calls that lead there.
    fn locate(&self, mut error: FormulaError) -> FormulaError {
        error.place = self.place.clone();
        let site = |call: &Call| CallSite {
            place: call.caller.place.clone(),
            span: call.span.clone(),
            note: call.note.clone(),
        };
        error.calls = self.stack().map(site).collect();
        error
    }
}

/// Why a node has no value.
pub(super) enum Failure {
    /// A part of it has none, which has been reported.
    Reported,
    /// For this reason.
    New(FormulaError),
}

impl From<FormulaError> for Failure {
    fn from(error: FormulaError) -> Self {
        Self::New(error)
    }
}

type Outcome = Result<Value, Failure>;

struct Checker<'s> {
    scope: &'s Scope,
    parts: usize,
    known: HashMap<(Arc<str>, Vec<usize>), Known>,
    errors: Vec<FormulaError>,
}

/// The outcome of a call. The arguments are kept so that their addresses, which are the key, stay theirs.
struct Known {
    value: Option<Value>,
    _arguments: Vec<Value>,
}

impl Checker<'_> {
    fn formula(&mut self, frame: &Frame) -> Option<Value> {
        let nodes = &frame.formula.tree().nodes;
        let mut values: Vec<Option<Value>> = Vec::with_capacity(nodes.len());
        for node in nodes {
            if self.parts > MAX_PARTS {
                return None;
            }
            self.parts += 1;
            let outcome = self.node(frame, node, &values);
            values.push(self.record(frame, outcome));
        }
        values.pop().flatten()
    }

    fn record(&mut self, frame: &Frame, outcome: Outcome) -> Option<Value> {
        match outcome {
            Ok(value) => return Some(value),
            Err(Failure::Reported) => {}
            Err(Failure::New(error)) => self.report(frame.locate(error)),
        }
        None
    }

    /// A mistake in a body does not become another one when the function is called again.
    fn report(&mut self, error: FormulaError) {
        let place = |e: &FormulaError| (e.place.clone(), e.labels.first().map(|(span, _)| span.clone()));
        let same = |e: &FormulaError| place(e) == place(&error) && e.message == error.message;
        if self.errors.len() < MAX_ERRORS && !self.errors.iter().any(same) {
            self.errors.push(error);
        }
    }

    fn node(&mut self, frame: &Frame, node: &SyntaxNode, values: &[Option<Value>]) -> Outcome {
        let parts = Parts { frame, values };
        match &node.syntax {
            Syntax::Quantity { value, chain: None, .. } => Ok(Expr::number(value.clone()).into()),
            Syntax::Quantity { value, chain: Some(chain), standing } => {
                let span = quantity_start(frame, node)..chain.span.end;
                let (text, standing) = (frame.formula.text(), *standing);
                let written = Written { text, span, value, chain, standing };
                Ok(written.resolve(&|name| self.is_name(frame, name))?.into())
            }
            Syntax::Name(span) => names::value(self.scope, frame, span),
            Syntax::Sign { minus: false, operand } => parts.get(*operand).cloned(),
            Syntax::Sign { operand, .. } => {
                let value = parts.get(*operand)?;
                value.negated().map_err(|error| parts.explain(&error, &node.span, &[*operand]))
            }
            Syntax::Infix(operator, a, b) => {
                let (left, right) = (parts.get(*a), parts.get(*b));
                let value = Value::infix(*operator, left?, right?);
                value.map_err(|error| parts.explain(&error, &node.span, &[*a, *b]))
            }
            Syntax::Vector(components) => parts.vector(&node.span, components),
            Syntax::Call(name, arguments) => self.call(&parts, &node.span, name, arguments),
            Syntax::Broken => Err(Failure::Reported),
        }
    }

    fn is_name(&self, frame: &Frame, name: &str) -> bool {
        frame.argument(name).is_some() || self.scope.value(name).is_some()
    }

    fn call(&mut self, parts: &Parts, span: &Span, name: &Span, arguments: &[NodeId]) -> Outcome {
        let word = parts.frame.text(name);
        if let Some(function) = self.scope.function(word) {
            return self.call_user(&Arc::clone(function), parts, span, arguments);
        }
        if let Some(measured) = self.scope.measured(word) {
            return parts.measured(measured, span, arguments);
        }
        match builtin(word) {
            Some(builtin) => parts.call(builtin, span, arguments),
            None => Err(names::no_function(self.scope, parts.frame, name, span).into()),
        }
    }

    fn call_user(
        &mut self,
        function: &Function,
        parts: &Parts,
        span: &Span,
        arguments: &[NodeId],
    ) -> Outcome {
        let header = &function.header;
        if arguments.len() != header.arguments.len() {
            return Err(names::user_arguments(parts.frame, header, span, arguments).into());
        }
        let given = parts.all(arguments)?;
        let key = (Arc::clone(&header.name), given.iter().flat_map(identity).collect());
        if let Some(known) = self.known.get(&key) {
            return known.value.clone().ok_or(Failure::Reported);
        }
        let value = self.write_out(function, parts.frame, span, &given)?;
        self.known.insert(key, Known { value: value.clone(), _arguments: given });
        value.ok_or(Failure::Reported)
    }

    /// The body with the arguments put in.
    fn write_out(
        &mut self,
        function: &Function,
        caller: &Frame,
        span: &Span,
        given: &[Value],
    ) -> Result<Option<Value>, Failure> {
        let name = &function.header.name;
        let depth = caller.calls.map_or(0, |call| call.depth) + 1;
        if caller.stack().any(|call| call.function == *name) {
            return Err(names::recursion(name, span).into());
        }
        if depth > MAX_CALLS {
            return Err(names::too_deep(span, MAX_CALLS).into());
        }
        let names = function.header.arguments.iter().map(|(name, _)| Arc::clone(name));
        let arguments: Vec<_> = names.zip(given.iter().cloned()).collect();
        let note = names::call_note(&arguments);
        let call = Call { function: Arc::clone(name), span: span.clone(), note, caller, depth };
        let place = SpannedText::Body(Arc::clone(name));
        let frame = Frame { formula: &function.body, place, arguments: &arguments, calls: Some(&call) };
        let value = self.formula(&frame);
        self.within_bounds(span, depth)?;
        Ok(value)
    }

    /// Said once, at the outermost call.
    fn within_bounds(&self, span: &Span, depth: usize) -> Result<(), Failure> {
        match depth {
            1 if self.parts > MAX_PARTS => Err(names::too_large(span, MAX_PARTS).into()),
            _ => Ok(()),
        }
    }
}

/// The quantity's own beginning, without brackets around it.
fn quantity_start(frame: &Frame, node: &SyntaxNode) -> usize {
    let written = frame.text(&node.span);
    let bare = written.trim_start_matches(|c: char| !c.is_ascii_digit() && c != '.');
    node.span.end - bare.len()
}

/// What tells one value from another without looking into it.
fn identity(value: &Value) -> Vec<usize> {
    value.parts().iter().map(|part| Arc::as_ptr(&part.0).addr()).collect()
}

/// The values of the parts of a node.
struct Parts<'f> {
    frame: &'f Frame<'f>,
    values: &'f [Option<Value>],
}

impl Parts<'_> {
    fn get(&self, id: NodeId) -> Result<&Value, Failure> {
        self.values[id].as_ref().ok_or(Failure::Reported)
    }

    fn all(&self, ids: &[NodeId]) -> Result<Vec<Value>, Failure> {
        ids.iter().map(|id| self.get(*id).cloned()).collect()
    }

    fn span(&self, id: NodeId) -> &Span {
        &self.frame.formula.tree().nodes[id].span
    }

    fn call(&self, builtin: &Builtin, span: &Span, arguments: &[NodeId]) -> Outcome {
        if !builtin.takes(arguments.len()) {
            return Err(names::builtin_arguments(self.frame, builtin, span, arguments).into());
        }
        let given = self.all(arguments)?;
        builtin.call(&given).map_err(|error| self.explain(&error, span, arguments))
    }

    fn measured(&self, measured: &Measured, span: &Span, arguments: &[NodeId]) -> Outcome {
        let [argument] = arguments else {
            return Err(names::measured_arguments(self.frame, measured, span, arguments).into());
        };
        let given = self.get(*argument)?;
        match given {
            Value::Scalar(x) if x.expect(measured.table.x).is_ok() => {
                Ok(Expr::table(&measured.table, x.clone()).into())
            }
            other => Err(names::other_variable(measured, self.span(*argument), other).into()),
        }
    }

    /// Components must be numbers of one dimension.
    fn vector(&self, span: &Span, components: &[NodeId]) -> Outcome {
        let parts = self.all(components)?;
        Value::of_components(&parts).map_err(|error| self.explain(&error, span, components))
    }

    /// The mistake with every operand labelled by what it is.
    fn explain(&self, error: &ValueError, whole: &Span, operands: &[NodeId]) -> Failure {
        let label = |id: &NodeId| Some((self.span(*id).clone(), self.values[*id].as_ref()?.describe()));
        let mut labels: Vec<_> = operands.iter().filter_map(label).collect();
        if labels.is_empty() {
            labels.push((whole.clone(), String::new()));
        }
        let found = FormulaError::between(error.code(), error.to_string(), labels);
        let comma = || names::decimal_comma(self.frame, operands);
        let point = || {
            comma().map(|number| format!("a decimal point is written `{number}`; a comma separates values"))
        };
        Failure::New(match error.help().map(str::to_owned).or_else(point) {
            Some(help) => found.help(help),
            None => found,
        })
    }
}
