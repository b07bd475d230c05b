//! What goes wrong after a scene was read, at its place in the scene.

use tumble_mech::{Happening, Others, RunError};
use tumble_ode::Reason;
use tumble_scene::{Diagnostics, Question, Study, When};

use crate::results::moments::Moments;
use crate::results::{Case, CaseError};

impl CaseError {
    /// The same with the place that it is about.
    pub fn placed(self, study: &Study) -> Self {
        match self {
            Self::Model(mistakes) => Self::Scene(Box::new(study.mistakes(&mistakes))),
            Self::Run(error) => match *error {
                RunError::Model(mistakes) => Self::Scene(Box::new(study.mistakes(&mistakes))),
                RunError::Refused { ref refusal, .. } => {
                    refused(study, &refusal.reason, &refusal.to_string())
                }
                RunError::Formula(reason) => refused(study, &reason, &reason.to_string()),
                other => Self::Run(Box::new(other)),
            },
            other => other,
        }
    }

    /// The same, said of one run of several.
    pub(crate) fn in_run(mut self, label: &str) -> Self {
        if let Self::Scene(diagnostics) | Self::Refused(diagnostics) = &mut self {
            name_run(diagnostics, label);
        }
        self
    }

    /// The same, where a question has no answer because of it.
    pub(crate) fn of_question(self, study: &Study, question: &Question) -> Self {
        match &self {
            Self::Run(error) => match &**error {
                RunError::Formula(reason) => Self::Refused(Box::new(study.no_answer(question, reason))),
                _ => self,
            },
            _ => self,
        }
    }
}

fn refused(study: &Study, reason: &Reason, message: &str) -> CaseError {
    CaseError::Refused(Box::new(study.refusal(reason, message)))
}

/// What a user should know of a run that was made: why it stopped early, values that are none, spans of time that end before
/// they begin.
pub(crate) fn said(study: &Study, case: &Case) -> Result<Diagnostics, CaseError> {
    let mut said = Diagnostics::default();
    if let Some(refusal) = &case.refusal {
        said.extend(study.refusal(&refusal.reason, &refusal.to_string()));
    }
    if study.model.stops_at_rest && case.refusal.is_none() && case.run.rest().map_err(Box::new)?.is_none() {
        said.extend(study.no_rest(case.run.end().unwrap_or_default()));
    }
    let finds =
        study.finds.iter().zip(&case.finds).map(|(question, find)| (question, find.at, [find.value; 2]));
    let checks = study.checks.iter().zip(&case.checks);
    let checks = checks.map(|(check, result)| (&check.question, result.at, [result.found, result.expected]));
    let is_singular = |at: f64| {
        let mut events = case.run.events().filter(|event| event.time == at);
        events.any(|event| event.record.happened.contains(&Happening::Singular))
    };
    for (question, at, values) in finds.chain(checks) {
        let value = values.into_iter().find(|value| !value.is_finite());
        if let Some(value) = value.filter(|_| at.is_finite()) {
            said.extend(match value.is_nan() && is_singular(at) {
                true => study.no_force(question, at),
                false => study.no_number(question, value, at),
            });
        }
    }
    if case.refusal.is_none() {
        never_comes(study, case, &mut said);
    }
    other_motions(study, case, &mut said);
    empty_windows(study, case, &mut said)?;
    name_run(&mut said, &case.label);
    Ok(said)
}

pub(crate) fn name_run(said: &mut Diagnostics, label: &str) {
    for diagnostic in said.list.iter_mut().filter(|_| !label.is_empty()) {
        diagnostic.message = format!("in the run `{label}`: {}", diagnostic.message);
    }
}

/// Joints and impulses that wait for events which do not happen.
fn never_comes(study: &Study, case: &Case, said: &mut Diagnostics) {
    let has = |wanted: &Happening| case.run.events().any(|event| event.record.happened.contains(wanted));
    let mut tell = |what: String, stays: &str, event: &Option<String>, wanted: Happening| {
        if let Some(event) = event.as_ref().filter(|_| !has(&wanted)) {
            said.extend(study.never_comes(&what, stays, event));
        }
    };
    for (index, joint) in study.model.joints.iter().enumerate() {
        let what = || format!("joint `{}`", joint.name);
        let event = joint.from.clone().filter(|_| joint.captured_by.is_none());
        tell(what(), "never begins to hold", &event, Happening::Joint { joint: index, holds: true });
        tell(what(), "is never released", &joint.until, Happening::Joint { joint: index, holds: false });
    }
    for (index, impulse) in study.model.impulses.iter().enumerate() {
        let what = format!("impulse `{}`", impulse.name);
        tell(what, "never acts", &Some(impulse.when.clone()), Happening::Impulse(index));
    }
}

/// Where rigid bodies with friction might go on otherwise.
fn other_motions(study: &Study, case: &Case, said: &mut Diagnostics) {
    let others = case.run.events().flat_map(|event| event.record.others.iter().map(|one| (event.time, one)));
    let mut unexamined = vec![];
    for (time, others) in others {
        match others {
            Others::Possible(motions) => {
                said.extend(study.other_motions(time, &motions.told(&case.run.equations)));
            }
            Others::Unexamined => unexamined.push(time),
        }
    }
    if let Some(first) = unexamined.first() {
        said.extend(study.unexamined_motions(*first, unexamined.len()));
    }
}

fn empty_windows(study: &Study, case: &Case, said: &mut Diagnostics) -> Result<(), CaseError> {
    let moments = Moments::of(study, case.solution());
    let plots = study.plots.iter().map(|plot| (format!("the plot `{}`", plot.name), plot.during.as_ref()));
    let checks = study.checks.iter().map(|check| &check.question);
    let questions = study.finds.iter().chain(checks).map(|question| match &question.at {
        When::Extreme { during, .. } => (question.title.clone(), during.as_ref()),
        _ => (question.title.clone(), None),
    });
    for (of, during) in plots.chain(questions) {
        if let Some(ends) = moments.ends(during)?.filter(|[from, to]| from > to) {
            said.extend(study.empty_window(&of, ends));
        }
    }
    Ok(())
}
