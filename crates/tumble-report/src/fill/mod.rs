//! The report of a study: what it says of the model, the equations and the motion, as plain data for the page.
//!
//! Everything in it is read from what ran: equations from the graph that was integrated, forces from its terms, numbers
//! from the trajectory. No file is read or written here, no thread begun and no time asked for: it is the same in a browser.

mod alike;
mod analyze;
mod animation;
mod balance;
mod closed;
mod conditions;
mod equations;
mod events;
mod findings;
mod forces;
mod identify;
mod impacts;
mod incline;
mod laws;
mod model;
mod motion;
mod names;
mod once;
mod passed;
mod pivots;
mod reduced;
mod sizes;
mod solve;
mod sweep;
mod texts;
pub(crate) mod words;

use crate::report::{Report, Text, Typeset};
use tumble_expr::{Expr, Substitution, Symbol, Vector};
use tumble_scene::Study;

use crate::results::{CaseError, Runs};

pub(crate) use alike::listed;
use names::Names;
pub(crate) use names::{quantity, quantity_to};

/// Identify, model, solve, analyze.
pub fn of(study: &Study, runs: Runs<'_>) -> Result<Report, CaseError> {
    let cases = runs.cases;
    let first = study.with(&cases[0].parameters);
    let names = Names::of(&first)?;
    let analyze = analyze::of(study, &names, runs)?;
    let mut report = Report {
        lead: lead(&analyze.findings),
        title: study.title.clone(),
        language: "en".to_owned(),
        lesson: None,
        ways: None,
        intro: interrupted(runs).into_iter().collect(),
        meta: vec![],
        lab: None,
        identify: identify::of(&first, &names, &cases[0])?,
        model: model::of(&first, &names, cases)?,
        solve: solve::of(&first, &names, cases)?,
        analyze,
    };
    say_once(&mut report);
    texts::into(&mut report, &study.texts);
    Ok(report)
}

/// What stands in the table of bodies the laws and equations do not say again.
fn say_once(report: &mut Report) {
    let properties = report.identify.bodies.iter().flat_map(|body| &body.properties);
    let said: Vec<&Typeset> = properties.filter_map(|property| property.formula.as_ref()).collect();
    let laws = report.model.bodies.iter_mut().flat_map(|body| &mut body.laws);
    let modes = report.model.modes.iter_mut().flat_map(|mode| &mut mode.equations);
    laws.chain(modes)
        .for_each(|law| law.definitions.retain(|definition| !said.contains(&&definition.symbol)));
}

fn sum(parts: impl IntoIterator<Item = Expr>) -> Expr {
    parts.into_iter().fold(Expr::zero(), |sum, part| sum + part)
}

/// What makes these symbols zero.
fn zeros(symbols: impl IntoIterator<Item = Symbol>) -> Substitution {
    let mut none = Substitution::default();
    symbols.into_iter().for_each(|symbol| none.insert(symbol, Expr::zero()));
    none
}

/// The velocity of the air at the world's origin.
fn wind_at_origin(study: &Study) -> Vector {
    let origin = zeros(tumble_mech::place_symbols());
    study.model.wind.0.map(|component| origin.apply(component))
}

/// What was found, in a line: the first finding.
fn lead(findings: &[Text]) -> Text {
    findings.first().cloned().unwrap_or_default()
}

/// That runs are missing.
fn interrupted(runs: Runs<'_>) -> Option<Text> {
    let all = runs.cases.len() + runs.missing.len();
    let words =
        format!("Interrupted: {} of {all} runs were made, and this report has no others.", runs.cases.len());
    (!runs.missing.is_empty()).then(|| words.into())
}

/// The motion of every run, to be drawn frame by frame.
pub fn animation(
    study: &Study,
    cases: &[crate::results::Case],
) -> Result<tumble_drawing::Animation, CaseError> {
    animation::of(study, &cases.iter().collect::<Vec<_>>())
}

#[cfg(test)]
mod tests;
