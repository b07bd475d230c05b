//! `[sweep]`: parameters, and the accuracy, that take several values, one run each.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

use tumble_expr::{Dimension, Expr, Substitution};
use tumble_mech::{Known, Parameters};

use super::run::possible;
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, fields};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::names::ACCURACY;
use crate::printable::one_line;
use crate::sweep::{Range, SweepAxis, SweepValue, SweepValues, Swept, Written};
use crate::unit_text::UnitText;

/// More runs than this are a slip of a count.
const MAX_RUNS: usize = 10_000;

pub(super) const VALUES: Takes = Takes::Either(&[
    Takes::List(1, Takes::MOST, &Takes::Either(&[Takes::Formula, Takes::Table(&LABELLED)])),
    Takes::Table(&RANGE),
]);

#[rustfmt::skip]
const LABELLED: Keys = Keys::of("value of a sweep", &[&[
    must("value", Takes::Formula, "\"1 m\"", "a value"),
    must("label", Takes::Text, "\"..\"", "how figures call it"),
]]);

#[rustfmt::skip]
const RANGE: Keys = Keys::of("range of a sweep", &[&[
    must("from", Takes::Formula, "\"0.5 s\"", "the first value"),
    must("to", Takes::Formula, "\"4 s\"", "the last value"),
    must("count", Takes::Count(2, MAX_RUNS), "8", "how many, both ends included"),
    SPACING,
]]);

#[rustfmt::skip]
pub(super) const SPACING: Declared = may("spacing", Takes::Word(&SPACINGS), "`\"linear\"`", "\"log\"",
    "`\"linear\"`: equal distances, `\"log\"`: equal ratios");
pub(super) const SPACINGS: [&str; 2] = ["linear", "log"];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    let Some(table) = section.value.as_table() else { return draft.wrong_type(section, "a section") };
    let fields = fields(table);
    let parameters = draft.model.parameters.clone();
    // A parameter without a value is reported where it stands.
    let known = parameters.known().ok();
    let mut axes = vec![];
    for field in &fields {
        let want = match field.key {
            ACCURACY => Some(Want::constant(Dimension::NONE)),
            _ => draft.parameter(field),
        };
        let values = want.and_then(|want| values(draft, field, want, known.as_ref()));
        if let Some(values) = &values {
            refuse_same(draft, field, values);
        }
        // What the command line sets takes that value only.
        let is_set = draft.settings.iter().any(|setting| setting.name == field.key);
        axes.extend(values.filter(|_| !is_set).map(|values| (field, values)));
    }
    refuse_number(draft, section, &axes);
    let closing = Closing::of(&parameters, &axes.iter().map(|(field, _)| field.key).collect());
    for (field, written) in axes {
        if follows_swept(draft, field, &closing, &written) {
            continue;
        }
        let dimension = draft.model.parameters.symbol(field.key).map(|symbol| symbol.dimension);
        let values = SweepValues { written, closing: closing.written.clone(), dimension };
        let of = match field.key {
            ACCURACY => Swept::Accuracy,
            parameter => Swept::Parameter(parameter.to_owned()),
        };
        if of == Swept::Accuracy {
            refuse_accuracies(draft, field, &values);
        }
        draft.sweep.push(SweepAxis { of, values: values.into() });
    }
}

/// The first value that is no accuracy.
fn refuse_accuracies(draft: &mut Draft, field: &Field, values: &SweepValues) {
    let formulas: Vec<Expr> = values.iter().map(|value| value.value).collect();
    let Ok(numbers) = draft.model.parameters.evaluate(&formulas) else { return };
    let elements = field.elements();
    let span = |at: usize| elements.as_ref().map_or(field.span.clone(), |all| all[at].span.clone());
    let mistake = numbers.iter().enumerate().find_map(|(at, value)| possible(*value, span(at)).err());
    mistake.into_iter().for_each(|mistake| draft.note(mistake));
}

/// Two runs of one label are one run twice, or cannot be told apart in a legend.
fn refuse_same(draft: &mut Draft, field: &Field, values: &Written) {
    let Some([first, again]) = same(values) else { return };
    let label = values.label(again);
    let elements = field.elements();
    let span = |at: usize| elements.as_ref().map_or(field.span.clone(), |all| all[at].span.clone());
    let message = format!("two runs of this sweep are called \"{label}\"");
    let mistake = Diagnostic::new(Code::NameTaken, span(again), message).label("again here");
    let mistake = if span(first) == span(again) { mistake } else { mistake.also(span(first), "first here") };
    draft.note(mistake.help("take each value once, and give each its own label"));
}

/// The first two values of one label.
fn same(values: &Written) -> Option<[usize; 2]> {
    match values {
        Written::List(list) => {
            let mut seen = BTreeMap::new();
            let mut labels = list.iter().map(|value| value.label.as_str()).enumerate();
            labels.find_map(|(at, label)| Some([seen.insert(label, at)?, at]))
        }
        // Those of one label stand beside each other.
        Written::Range(range) => (1..range.count)
            .map(|at| [at - 1, at])
            .find(|[first, again]| range.label(*first) == range.label(*again)),
    }
}

fn refuse_number(draft: &mut Draft, section: &Field, axes: &[(&Field, Written)]) {
    let runs = axes.iter().fold(1usize, |runs, (_, values)| runs.saturating_mul(values.count()));
    if runs > MAX_RUNS {
        let counts: Vec<_> = axes.iter().map(|(_, values)| values.count().to_string()).collect();
        let message = format!("this sweep has {runs} runs, more than {MAX_RUNS}");
        let mistake = Diagnostic::new(Code::TooMany, section.key_span.clone(), message);
        draft.note(mistake.label(counts.join(" x ")).help("every combination is one run: take fewer values"));
    }
}

fn values(draft: &mut Draft, field: &Field, want: Want, known: Option<&Known<'_>>) -> Option<Written> {
    if field.value.is_table() {
        return range(draft, field, want, known?).map(Written::Range);
    }
    let Some(elements) = field.elements() else {
        draft.wrong_type(field, "a list of values, or { from = .., to = .., count = .. }");
        return None;
    };
    if elements.is_empty() {
        draft.note(Diagnostic::new(Code::Length, field.span.clone(), "this sweep has no value"));
        return None;
    }
    if elements.len() > MAX_RUNS {
        let message = format!("this sweep has {} runs, more than {MAX_RUNS}", elements.len());
        draft.note(Diagnostic::new(Code::TooMany, field.key_span.clone(), message).help("take fewer values"));
        return None;
    }
    let values: Vec<_> = elements.iter().map(|element| one(draft, element, want)).collect();
    values.into_iter().collect::<Option<_>>().map(Written::List)
}

/// `"0.5 s"` or `{ value = "0.5 s", label = "fast gusts" }`
fn one(draft: &mut Draft, field: &Field, want: Want) -> Option<SweepValue> {
    if !field.value.is_table() {
        let value = draft.number(field, want)?;
        let text = draft.text(field, want)?.text;
        return Some(SweepValue { value, label: format!("{} = {}", field.key, one_line(&text)) });
    }
    let mut inner = draft.inline(field, &LABELLED)?;
    let example = format!("\"{}\"", want.example("1"));
    let value =
        draft.required_like(&mut inner, "value", &example).and_then(|field| draft.number(&field, want));
    let label = draft.required(&mut inner, "label").and_then(|field| draft.line(&field));
    draft.done(inner);
    Some(SweepValue { value: value?, label: label? })
}

/// `{ from = "0.5 s", to = "4 s", count = 8, spacing = "log" }`
fn range(draft: &mut Draft, field: &Field, want: Want, known: &Known<'_>) -> Option<Range> {
    let mut inner = draft.inline(field, &RANGE)?;
    let ends = ["from", "to"].map(|key| {
        let field = draft.required_like(&mut inner, key, &format!("\"{}\"", want.example("1")))?;
        let unit = field.value.as_str().and_then(UnitText::of);
        Some((draft.number(&field, want)?, unit))
    });
    let count = draft.required(&mut inner, "count").and_then(|field| count(draft, &field));
    let spacing = inner.take("spacing").map(|field| draft.choice(&field, &SPACINGS));
    draft.done(inner);
    let ([Some((from, unit)), Some((to, other))], Some(count)) = (ends, count) else { return None };
    let is_log = match spacing {
        None => false,
        Some(word) => word? == "log",
    };
    let unit = unit.or(other).unwrap_or_else(|| UnitText::si(want));
    let numbers = numbers(draft, field, known, [&from, &to], is_log)?;
    Some(Range { ends: [from, to], numbers, count, is_log, name: field.key.to_owned(), unit })
}

/// How many values a range has, both ends included.
fn count(draft: &mut Draft, field: &Field) -> Option<usize> {
    let Some(integer) = field.value.as_integer() else {
        draft.wrong_type(field, "a whole number without quotes");
        return None;
    };
    match integer.to_string().parse::<usize>() {
        Ok(count @ 2..=MAX_RUNS) => Some(count),
        _ => {
            let message = format!("`count` is {integer}: a range has from 2 to {MAX_RUNS} values");
            draft.note(Diagnostic::new(Code::TooMany, field.span.clone(), message).label("out of range"));
            None
        }
    }
}

/// The ends of a range as numbers; one of equal ratios needs ends of one sign.
fn numbers(
    draft: &mut Draft,
    field: &Field,
    known: &Known<'_>,
    ends: [&Expr; 2],
    log: bool,
) -> Option<[f64; 2]> {
    let values = known.evaluate(&ends.map(Clone::clone)).ok()?;
    let [from, to] = [values[0], values[1]];
    let positive = from > 0.0 && to > 0.0;
    if log && !positive {
        let message = "a range of equal ratios goes from a positive value to a positive one";
        let mistake =
            Diagnostic::new(Code::Value, field.span.clone(), message).label("touches or crosses zero");
        draft.note(mistake.help("leave `spacing` out for equal distances"));
        return None;
    }
    Some([from, to])
}

/// The parameters that are not swept, without names, and those that follow from a swept one.
#[derive(Default)]
struct Closing {
    written: Substitution,
    /// The name of the swept parameter.
    swept: HashMap<Arc<str>, Arc<str>>,
}

impl Closing {
    /// Every formula is written out once, of those before it that are written out already.
    fn of(parameters: &Parameters, swept: &HashSet<&str>) -> Self {
        let mut closing = Self::default();
        for (symbol, formula) in parameters.formulas() {
            let own = swept.contains(&*symbol.name).then(|| Arc::clone(&symbol.name));
            match own.or_else(|| closing.follows(formula)) {
                Some(swept) => _ = closing.swept.insert(Arc::clone(&symbol.name), swept),
                None => {
                    let written = closing.written.apply(formula);
                    closing.written.insert(symbol.clone(), written);
                }
            }
        }
        closing
    }

    /// The swept parameter that a formula depends on, the first by name.
    fn follows(&self, formula: &Expr) -> Option<Arc<str>> {
        formula.symbols().iter().filter_map(|symbol| self.swept.get(&symbol.name)).min().cloned()
    }
}

/// Refuses values that depend on what is swept; whether there is one.
fn follows_swept(draft: &mut Draft, field: &Field, closing: &Closing, values: &Written) -> bool {
    // In a range all but the first are formulas of both ends.
    let different = if let Written::Range(_) = values { 2 } else { values.count() };
    let follows = |index: usize| closing.follows(&values.at(index).value);
    let Some(swept) = (0..different).find_map(follows) else { return false };
    let message = format!("a value of `{}` depends on `{swept}`, which is swept", field.key);
    let mistake = Diagnostic::new(Code::SweepCycle, field.span.clone(), message);
    let help = "the values of a sweep are numbers, or formulas of parameters that are not swept";
    draft.note(mistake.help(help));
    true
}
