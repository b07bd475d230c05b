//! `[functions]`: `"w(t)" = "0.5*w1*(1 + cos(2*pi*t/T))"`.

use std::sync::Arc;

use tumble_expr::Expr;
use tumble_expr::language::{self, Function, FunctionError, NameUse, Value};

use crate::diagnostic::Diagnostic;
use crate::document::{Field, fields};
use crate::draft::Draft;
use crate::formula::{Origin, Want, translate};
use crate::names::{Level, Names};

pub(super) const SAYS: &str = "functions, `\"name(argument, ...)\" = \"formula\"`";

pub(super) fn read(draft: &mut Draft, section: &Field) {
    let Some(table) = section.value.as_table() else { return draft.wrong_type(section, "a section") };
    for field in fields(table) {
        if function(draft, &field).is_none() {
            draft.names.break_name(field.key.split('(').next().unwrap_or_default().trim());
        }
    }
}

fn function(draft: &mut Draft, field: &Field) -> Option<()> {
    let body = draft.words(field)?;
    let file = &draft.sources[0].text;
    let header = Origin::of(file, field.key_span.clone(), field.key);
    let origin = Origin::of(file, field.span.clone(), &body);
    let parsed = Function::parse(field.key, &body).map_err(|error| match error {
        FunctionError::Header(errors) => {
            translate(&draft.names, &header, Want::any().at(Level::Output), errors)
        }
        FunctionError::Body(errors) => {
            translate(&draft.names, &origin, Want::any().at(Level::Output), errors)
        }
    });
    let function = draft.all_noted(parsed)?;
    let claimed = draft.names.claim("a function", &function.header.name, header.map(&function.header.span));
    draft.noted(claimed)?;
    draft.names.define_function(&function, origin);
    Some(())
}

/// The functions that the time can be given to, by their calls `w(t)`; each with its value.
pub(crate) fn of_time(names: &Names) -> Vec<(String, Expr)> {
    let scope = names.scope(Level::Time);
    let value = |name: &str| {
        let call = format!("{name}(t)");
        let found = language::parse(&call).ok()?.check(scope).ok()?;
        match found {
            Value::Scalar(formula) => Some((call, formula)),
            Value::Vector(_) => None,
        }
    };
    scope.function_names().filter_map(value).collect()
}

/// What a function's body names must exist, whether it is called or not. The dimensions of its arguments are known
/// only at a call.
pub(super) fn check_unused(draft: &mut Draft) {
    let scope = draft.names.scope(Level::Output);
    let names: Vec<String> = scope.function_names().map(str::to_owned).collect();
    for name in names {
        let Some(function) = draft.names.scope(Level::Output).function(&name).map(Arc::clone) else {
            continue;
        };
        let mistakes = unknown_names(draft, &function);
        let known = |mistake: &Diagnostic| draft.mistakes.iter().any(|other| same_place(other, mistake));
        let new: Vec<_> = mistakes.into_iter().filter(|mistake| !known(mistake)).collect();
        draft.mistakes.extend(new);
    }
}

fn same_place(a: &Diagnostic, b: &Diagnostic) -> bool {
    a.source == b.source && a.labels.first().map(|l| &l.span) == b.labels.first().map(|l| &l.span)
}

fn unknown_names(draft: &Draft, function: &Function) -> Vec<Diagnostic> {
    let is_argument = |name: &str| function.header.arguments.iter().any(|(argument, _)| **argument == *name);
    let uses = function.body.names().into_iter().filter(|name| name.called || !is_argument(name.name));
    uses.flat_map(|name| unknown_name(draft, function, &name)).collect()
}

/// The mistake in a formula that is this name alone.
fn unknown_name(draft: &Draft, function: &Function, name: &NameUse) -> Vec<Diagnostic> {
    let Some(origin) = draft.names.functions.get(&*function.header.name) else { return vec![] };
    let scope = draft.names.scope(Level::Output);
    if name.called && scope.is_function(name.name) {
        return vec![];
    }
    let alone = if name.called { format!("{}(1)", name.name) } else { name.name.to_owned() };
    let Ok(formula) = language::parse(&alone) else { return vec![] };
    let Err(mut errors) = formula.check(scope) else { return vec![] };
    for (span, _) in errors.iter_mut().flat_map(|error| &mut error.labels) {
        *span = name.span.start + span.start..name.span.start + span.end;
    }
    translate(&draft.names, origin, Want::any().at(Level::Output), errors)
}
