//! Names in formulas: what they stand for, and what to say of those that stand for nothing.

use std::sync::Arc;

use super::builtins::{self, Builtin, PI, builtin};
use super::check::{Failure, Frame};
use super::error::{Code, FormulaError, Span};
use super::header::Header;
use super::quantity::{name_hint, unit_hint};
use super::scope::{Measured, Scope};
use super::syntax::{NodeId, Syntax};
use super::value::Value;
use crate::Expr;

/// The value of the name at `span`: an argument, a name of the scene or pi.
pub(super) fn value(scope: &Scope, frame: &Frame, span: &Span) -> Result<Value, Failure> {
    let name = frame.text(span);
    match frame.argument(name).or_else(|| scope.value(name)) {
        Some(value) => Ok(value.clone()),
        None if name == PI => Ok(Expr::pi().into()),
        None => Err(unknown(scope, frame, span).into()),
    }
}

fn unknown(scope: &Scope, frame: &Frame, span: &Span) -> FormulaError {
    let name = frame.text(span);
    if let Some(arguments) = function_arguments(scope, name) {
        return FormulaError::new(Code::NotCallable, span.clone(), format!("`{name}` is a function"))
            .label("its arguments are missing")
            .help(format!("write `{name}({arguments})`"));
    }
    let error = FormulaError::new(Code::UnknownName, span.clone(), format!("nothing is named `{name}`"));
    let error = error.label("unknown name");
    match hint(scope, frame, name) {
        Some(help) => error.help(help),
        None => error,
    }
}

fn hint(scope: &Scope, frame: &Frame, name: &str) -> Option<String> {
    let arguments = frame.arguments.iter().map(|(name, _)| &**name);
    let names = arguments.chain(scope.names()).chain([PI]);
    let circle = matches!(name, "π" | "PI" | "Pi").then(|| format!("write `{PI}`"));
    let special = circle.or_else(|| not_finite(name));
    special.or_else(|| unit_hint(name)).or_else(|| name_hint(name, names))
}

/// Other languages have names for what is no number.
fn not_finite(name: &str) -> Option<String> {
    let known = ["nan", "inf", "infinity"].iter().any(|word| name.eq_ignore_ascii_case(word));
    known.then(|| {
        "formulas are computed with finite numbers: write the number, or leave the limit out".to_owned()
    })
}

fn function_arguments(scope: &Scope, name: &str) -> Option<String> {
    let user = || scope.function(name).map(|function| argument_list(&function.header));
    let measured = || scope.measured(name).map(|measured| measured.variable.clone());
    builtin(name).map(|builtin| builtin.arguments.to_owned()).or_else(user).or_else(measured)
}

fn argument_list(header: &Header) -> String {
    let names: Vec<_> = header.arguments.iter().map(|(name, _)| &**name).collect();
    names.join(", ")
}

/// The mistake of a call of what is no function.
pub(super) fn no_function(scope: &Scope, frame: &Frame, name: &Span, call: &Span) -> FormulaError {
    let word = frame.text(name);
    let is_value = frame.argument(word).or_else(|| scope.value(word)).is_some() || word == PI;
    if is_value {
        let inner = &frame.text(call)[word.len()..];
        return FormulaError::new(Code::NotCallable, name.clone(), format!("`{word}` is not a function"))
            .label("a value")
            .help(format!("a product is written `{word}*{}`", inner.trim_start()));
    }
    let error =
        FormulaError::new(Code::UnknownFunction, name.clone(), format!("no function is named `{word}`"));
    let error = error.label("unknown function");
    let known = builtins::BUILTINS.iter().map(|builtin| builtin.name);
    let known = known.chain(scope.function_names()).chain(scope.measured_names());
    let elsewhere = builtins::elsewhere(word).map(|here| format!("it is written `{here}` here"));
    match elsewhere.or_else(|| name_hint(word, known)) {
        Some(help) => error.help(help),
        None => error,
    }
}

/// The mistake of a call of a built-in function with the wrong number of arguments.
pub(super) fn builtin_arguments(
    frame: &Frame,
    builtin: &Builtin,
    call: &Span,
    given: &[NodeId],
) -> FormulaError {
    wrong_count(frame, builtin.name, &builtin.count(), builtin.arguments, call, given)
}

/// The mistake of a call of a user's function with the wrong number of arguments.
pub(super) fn user_arguments(frame: &Frame, header: &Header, call: &Span, given: &[NodeId]) -> FormulaError {
    let count = match header.arguments.len() {
        1 => "1 argument".to_owned(),
        count => format!("{count} arguments"),
    };
    wrong_count(frame, &header.name, &count, &argument_list(header), call, given)
}

/// The mistake of a call of a measured function with the wrong number of arguments.
pub(super) fn measured_arguments(
    frame: &Frame,
    measured: &Measured,
    call: &Span,
    given: &[NodeId],
) -> FormulaError {
    wrong_count(frame, &measured.table.name, "1 argument", &measured.variable, call, given)
}

/// The mistake of a measured function of another variable than its own.
pub(super) fn other_variable(measured: &Measured, argument: &Span, given: &Value) -> FormulaError {
    let Measured { table, variable } = measured;
    let (name, wanted) = (&table.name, table.x.describe());
    let message = format!("`{name}` was measured over {wanted}, not over {}", given.describe());
    FormulaError::new(Code::Variable, argument.clone(), message)
        .label(given.describe())
        .help(format!("write `{name}({variable})` with {wanted} for `{variable}`"))
}

fn wrong_count(
    frame: &Frame,
    name: &str,
    takes: &str,
    arguments: &str,
    call: &Span,
    given: &[NodeId],
) -> FormulaError {
    let message = format!("{name} takes {takes}, not {}", given.len());
    let error = FormulaError::new(Code::ArgumentCount, call.clone(), message);
    match decimal_comma(frame, given) {
        Some(number) => {
            error.help(format!("a decimal point is written `{number}`; a comma separates arguments"))
        }
        None => error.help(format!("write `{name}({arguments})`")),
    }
}

/// The number with a point, where two values look like one number with a decimal comma.
pub(super) fn decimal_comma(frame: &Frame, given: &[NodeId]) -> Option<String> {
    let nodes = &frame.formula.tree().nodes;
    let plain = |id: NodeId| matches!(nodes[id].syntax, Syntax::Quantity { chain: None, .. });
    let number = |id: NodeId| matches!(nodes[id].syntax, Syntax::Quantity { .. }) && !nodes[id].bracketed;
    let between =
        |pair: &[NodeId]| frame.formula.text().get(nodes[pair[0]].span.end..nodes[pair[1]].span.start);
    let joined = |pair: &&[NodeId]| between(pair) == Some(",");
    let pair = given.windows(2).filter(joined).find(|pair| plain(pair[0]) && number(pair[1]))?;
    let (whole, fraction) = (frame.text(&nodes[pair[0]].span), frame.text(&nodes[pair[1]].span));
    // A fraction has no point of its own.
    let digits = fraction.bytes().take_while(u8::is_ascii_digit).count();
    (digits > 0 && !whole.contains('.') && !fraction[digits..].starts_with('.'))
        .then(|| format!("{whole}.{fraction}"))
}

/// What a call gave to a function, in words.
pub(super) fn call_note(arguments: &[(Arc<str>, Value)]) -> String {
    let given: Vec<_> =
        arguments.iter().map(|(name, value)| format!("{name} = {}", value.describe())).collect();
    format!("called here with {}", given.join(", "))
}

pub(super) fn recursion(name: &str, call: &Span) -> FormulaError {
    FormulaError::new(Code::Recursion, call.clone(), format!("the function `{name}` calls itself"))
        .label("while it is being computed")
        .help("a formula is finite: write the function without itself")
}

pub(super) fn too_deep(call: &Span, limit: usize) -> FormulaError {
    FormulaError::new(
        Code::CallDepth,
        call.clone(),
        format!("functions call functions more than {limit} deep"),
    )
}

pub(super) fn too_large(call: &Span, limit: usize) -> FormulaError {
    let message = format!("this call has more than {limit} parts when it is written out");
    FormulaError::new(Code::Expansion, call.clone(), message)
        .help("give arguments that are used several times names of their own")
}
