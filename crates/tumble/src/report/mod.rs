//! The report of a study: what it says of the model, the equations and the motion, as plain data for the page.
//!
//! Everything in it is read from what ran: equations from the graph that was integrated, forces from its terms, numbers
//! from the trajectory.

mod analyze;
mod animation;
mod balance;
mod equations;
mod findings;
mod identify;
mod model;
mod names;
mod solve;

use tumble_report::report::{Report, Text};
use tumble_scene::Study;

use crate::output::Folder;
use crate::pipeline::{PipelineError, Runs};
use crate::summary::Source;

use names::Names;
pub(crate) use names::quantity_to;

/// How a report is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// One page that opens in any browser: `report.html`.
    #[default]
    Html,
    /// Text with formulas and links to the figures: `report.md`.
    Markdown,
    /// None.
    None,
}

/// Writes the report of a study beside its figures.
pub(crate) fn write(
    source: &Source,
    study: &Study,
    runs: Runs<'_>,
    folder: &Folder,
    form: Form,
) -> Result<(), PipelineError> {
    let (file, content) = match form {
        Form::None => return Ok(()),
        Form::Html => ("report.html", build(source, study, runs)?.html()),
        Form::Markdown => ("report.md", build(source, study, runs)?.markdown()),
    };
    Ok(folder.write(file, content.as_bytes())?)
}

/// Identify, model, solve, analyze.
fn build(source: &Source, study: &Study, runs: Runs<'_>) -> Result<Report, PipelineError> {
    let cases = runs.cases;
    let first = study.with(&cases[0].parameters);
    let names = Names::of(&first)?;
    Ok(Report {
        title: study.title.clone(),
        language: "en".to_owned(),
        intro: interrupted(runs).into_iter().collect(),
        meta: meta(source),
        math_font_css: Some(tumble_math::page_font().to_owned()).filter(|css| !css.is_empty()),
        identify: identify::of(&first, &names, &cases[0])?,
        model: model::of(&first, &names, &cases[0])?,
        solve: solve::of(&first, &names, cases)?,
        analyze: analyze::of(study, &names, cases)?,
    })
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

fn meta(source: &Source) -> Vec<(String, String)> {
    let program = format!("tumble {}", env!("CARGO_PKG_VERSION"));
    let hash = source.hash().map(|hash| ("SHA-256 of the scene".to_owned(), hash));
    let kind = if hash.is_some() { "Scene" } else { "Study" };
    let name = (kind.to_owned(), source.shown_name());
    [name].into_iter().chain(hash).chain([("Program".to_owned(), program)]).collect()
}
