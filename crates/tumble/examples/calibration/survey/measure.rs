//! What the program says of a problem. Nothing else here knows how it is asked.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use tumble::pipeline::run_text;
use tumble::{Case, CaseError, PipelineError};

use super::setup::{Asked, Place, Problem};

/// The answers to a problem, or why there are none.
#[derive(Clone, Debug)]
pub(crate) enum Measured {
    /// One answer for each value that is asked for.
    Answers(Vec<Answer>),
    /// The motion was refused.
    Refused(String),
    /// The program broke down, or the scene has a mistake.
    Broken(String),
}

/// What the program says of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Answer {
    /// The value; `None` where what it is asked at does not happen.
    pub(crate) value: Option<f64>,
    /// The error that is stated of it, if anything is.
    pub(crate) stated: Option<f64>,
    /// Whether the motion is known up to its end.
    pub(crate) is_known: bool,
}

/// Runs a problem's scene as users do.
pub(crate) fn measure(problem: &Problem) -> Measured {
    catch_unwind(AssertUnwindSafe(|| run(problem))).unwrap_or_else(|panic| Measured::Broken(words(&*panic)))
}

fn run(problem: &Problem) -> Measured {
    let case = match run_text("problem", &problem.scene) {
        Ok(mut cases) => cases.swap_remove(0),
        Err(PipelineError::Case(CaseError::Run(error))) => return Measured::Refused(error.to_string()),
        Err(PipelineError::Case(CaseError::Scene(mistakes))) => {
            return Measured::Broken(mistakes.to_string());
        }
        Err(error) => return Measured::Broken(error.to_string()),
    };
    if let Some(refusal) = case.refusal {
        return Measured::Refused(refusal.to_string());
    }
    let is_known = case.trust.as_ref().is_some_and(|trust| trust.horizon.is_none());
    let answer = |asked: &Asked| {
        let (value, stated) = match asked.place {
            Place::Find => find(&case, &asked.name),
            Place::Rest => rest(&case),
        };
        let finite = |number: Option<f64>| number.filter(|number| number.is_finite());
        Answer { value: finite(value), stated: finite(stated), is_known }
    };
    Measured::Answers(problem.asked.iter().map(answer).collect())
}

fn find(case: &Case, name: &str) -> (Option<f64>, Option<f64>) {
    let find = case.finds.iter().find(|find| find.name == name);
    (find.map(|find| find.value), find.and_then(|find| find.error))
}

/// The start of the contact that lasts to the end.
fn rest(case: &Case) -> (Option<f64>, Option<f64>) {
    let start = case.run.contacts().iter().find(|contact| contact.is_open).map(|contact| contact.start);
    (start, start.zip(case.trust.as_ref()).and_then(|(start, trust)| trust.event_error(&case.run, start)))
}

fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without words").to_owned()
}
