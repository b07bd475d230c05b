//! The report of a study: what it says of the model, the equations and the motion, as plain data for the page.
//!
//! Everything in it is read from what ran: equations from the graph that was integrated, forces from its terms, numbers
//! from the trajectory. No file is read or written here, no thread begun and no time asked for: it is the same in a browser.

mod analyze;
mod animation;
mod balance;
mod equations;
mod findings;
mod identify;
mod model;
mod names;
mod reduced;
mod solve;
mod texts;

use tumble_report::report::{Report, Text};
use tumble_scene::Study;

use crate::pipeline::{PipelineError, Runs};

use names::Names;
pub(crate) use names::quantity_to;

/// Identify, model, solve, analyze.
pub(crate) fn of(study: &Study, runs: Runs<'_>) -> Result<Report, PipelineError> {
    let cases = runs.cases;
    let first = study.with(&cases[0].parameters);
    let names = Names::of(&first)?;
    let mut report = Report {
        title: study.title.clone(),
        language: "en".to_owned(),
        lesson: None,
        intro: interrupted(runs).into_iter().collect(),
        meta: vec![],
        math_font_css: Some(tumble_math::page_font().to_owned()).filter(|css| !css.is_empty()),
        identify: identify::of(&first, &names, &cases[0])?,
        model: model::of(&first, &names, &cases[0])?,
        solve: solve::of(&first, &names, cases)?,
        analyze: analyze::of(study, &names, cases)?,
    };
    texts::into(&mut report, &study.texts);
    Ok(report)
}

/// That runs are missing.
fn interrupted(runs: Runs<'_>) -> Option<Text> {
    let all = runs.cases.len() + runs.missing.len();
    let words =
        format!("Interrupted: {} of {all} runs were made, and this report has no others.", runs.cases.len());
    (!runs.missing.is_empty()).then(|| words.into())
}

/// The motion of every run, to be drawn frame by frame.
#[cfg(feature = "png")]
pub(crate) fn animation(
    study: &Study,
    cases: &[crate::case::Case],
) -> Result<tumble_report::report::Animation, PipelineError> {
    animation::of(study, cases)
}
