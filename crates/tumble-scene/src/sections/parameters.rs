//! `[parameters]`: quantities, and formulas of other parameters in any order.

use std::collections::{BTreeMap, BTreeSet};

use tumble_expr::language::{Formula, StatedUnit, parse};
use tumble_expr::{Binary, Dimension, Expr};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, fields};
use crate::draft::Draft;
use crate::formula::{self, Text, Want};
use crate::names::{Level, Names};

/// A longer circle is not named whole.
const MOST_NAMED: usize = 12;

struct Parameter {
    name: String,
    text: Text,
    /// The text read, unless it has mistakes.
    formula: Option<Formula>,
    /// What the command line puts in its place.
    setting: Option<Text>,
}

impl Parameter {
    /// Its name with the formula that it has.
    fn written(&self) -> (String, String) {
        (self.name.clone(), self.setting.as_ref().unwrap_or(&self.text).text.clone())
    }
}

pub(super) const SAYS: &str = "named quantities, `name = \"formula\"`, in any order";

pub(super) fn read(draft: &mut Draft, section: &Field) {
    let Some(table) = section.value.as_table() else { return draft.wrong_type(section, "a section") };
    let mut parameters = vec![];
    for field in fields(table) {
        match parameter(draft, &field) {
            Some(parameter) => parameters.push(parameter),
            None => draft.names.break_name(field.key),
        }
    }
    draft.parameter_texts = parameters.iter().map(Parameter::written).collect();
    for index in in_order(draft, &parameters) {
        if draft.is_full() {
            return;
        }
        define(draft, &parameters[index]);
    }
}

fn parameter(draft: &mut Draft, field: &Field) -> Option<Parameter> {
    let claimed = draft.names.claim("a parameter", field.key, field.key_span.clone());
    let (claimed, text) = (draft.noted(claimed), draft.text(field, Want::any()));
    let (_, text) = (claimed?, text?);
    draft.remember(format!("parameter `{}`", field.key), &field.span);
    let setting = draft.setting(field.key);
    let formula = parse(&text.text).ok();
    Some(Parameter { name: field.key.to_owned(), text, formula, setting })
}

fn define(draft: &mut Draft, parameter: &Parameter) {
    match value(draft, parameter) {
        Some(value) => {
            // A formula without a dimension has been reported with its place.
            if let Ok(symbol) = draft.model.parameters.set(&parameter.name, value) {
                draft.names.define(Level::Constant, &parameter.name, &symbol);
            }
        }
        None => draft.names.break_name(&parameter.name),
    }
}

fn value(draft: &mut Draft, parameter: &Parameter) -> Option<Expr> {
    let own = formula::number(&draft.names, &parameter.text, Want::any());
    let own = draft.all_noted(own)?;
    if parameter.formula.as_ref().is_some_and(|formula| formula.stated_unit() == StatedUnit::Angle) {
        draft.angular.insert(parameter.name.clone());
    }
    let Some(setting) = &parameter.setting else { return Some(own) };
    let dimension = own.dimension().unwrap_or(Dimension::NONE);
    let want = Want { angle: draft.angular.contains(&parameter.name), ..Want::constant(dimension) };
    let set = formula::number(&draft.names, setting, want);
    let set = draft.all_noted(set)?;
    // A bare zero takes the dimension of what it replaces.
    Some(if set.is_zero() { Expr::binary(Binary::Sub, own.clone(), own) } else { set })
}

/// Indices in an order in which each parameter uses earlier ones only; those of circles are left out and reported.
fn in_order(draft: &mut Draft, parameters: &[Parameter]) -> Vec<usize> {
    let uses = dependencies(&draft.names, parameters);
    let mut waits: Vec<usize> = uses.iter().map(BTreeSet::len).collect();
    let mut users = vec![vec![]; parameters.len()];
    for (user, used) in uses.iter().enumerate() {
        used.iter().for_each(|used| users[*used].push(user));
    }
    let mut ready: BTreeSet<usize> = (0..parameters.len()).filter(|index| waits[*index] == 0).collect();
    let mut order = vec![];
    while let Some(next) = ready.pop_first() {
        order.push(next);
        for user in &users[next] {
            waits[*user] -= 1;
            ready.extend((waits[*user] == 0).then_some(*user));
        }
    }
    report_circle(draft, parameters, &uses, &waits);
    order
}

fn dependencies(names: &Names, parameters: &[Parameter]) -> Vec<BTreeSet<usize>> {
    let index: BTreeMap<&str, usize> =
        parameters.iter().enumerate().map(|(i, p)| (p.name.as_str(), i)).collect();
    let of = |parameter: &Parameter| {
        let set = parameter.setting.as_ref().and_then(|text| parse(&text.text).ok());
        let formulas = parameter.formula.iter().chain(&set);
        let used = formulas.flat_map(|formula| used_names(names, formula));
        used.filter_map(|name| index.get(name.as_str()).copied()).collect()
    };
    parameters.iter().map(of).collect()
}

/// The names a formula uses, those in the functions it calls included.
fn used_names(names: &Names, formula: &Formula) -> BTreeSet<String> {
    let (mut used, mut called) = (BTreeSet::new(), vec![]);
    let mut seen = BTreeSet::new();
    let mut collect = |formula: &Formula, called: &mut Vec<String>| {
        for name in formula.names() {
            let into = if name.called {
                &mut *called
            } else {
                used.insert(name.name.to_owned());
                continue;
            };
            into.push(name.name.to_owned());
        }
    };
    collect(formula, &mut called);
    while let Some(name) = called.pop() {
        let function = names.scope(Level::Constant).function(&name);
        if let Some(function) = function.filter(|_| seen.insert(name)) {
            collect(&function.body, &mut called);
        }
    }
    used
}

/// One circle among the parameters that still wait for others.
fn report_circle(draft: &mut Draft, parameters: &[Parameter], uses: &[BTreeSet<usize>], waits: &[usize]) {
    let waiting = |index: &usize| waits[*index] > 0;
    for index in (0..waits.len()).filter(waiting) {
        draft.names.break_name(&parameters[index].name);
    }
    let Some(mut at) = (0..waits.len()).find(waiting) else { return };
    let (mut path, mut places) = (vec![], BTreeMap::new());
    while !places.contains_key(&at) {
        places.insert(at, path.len());
        path.push(at);
        let Some(next) = uses[at].iter().copied().find(waiting) else { return };
        at = next;
    }
    let begins = places[&at];
    let circle: Vec<&Parameter> = path[begins..].iter().map(|index| &parameters[*index]).collect();
    draft.note(circular(&circle));
}

fn circular(circle: &[&Parameter]) -> Diagnostic {
    let all = circle.iter().map(|parameter| parameter.name.as_str());
    let shown = if circle.len() > MOST_NAMED { MOST_NAMED } else { circle.len() };
    let left_out = (shown < circle.len()).then_some("...");
    let names: Vec<_> = all.clone().take(shown).chain(left_out).chain(all.take(1)).collect();
    let message = format!("these parameters depend on each other in a circle: {}", names.join(" -> "));
    let span = |parameter: &Parameter| parameter.text.origin.span.clone();
    let next = |index: usize| &circle[(index + 1) % circle.len()].name;
    let first = Diagnostic::new(Code::Cycle, span(circle[0]), message).label(format!("needs `{}`", next(0)));
    let labelled = circle.iter().enumerate().skip(1).take(5);
    let all = labelled.fold(first, |mistake, (i, p)| mistake.also(span(p), format!("needs `{}`", next(i))));
    all.help("give one of them a value of its own")
}
