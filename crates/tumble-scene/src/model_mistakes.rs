//! Mistakes that the model finds, at their places in the file.

use tumble_mech::{Equations, ModelError, ModelErrors};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::draft::Draft;
use crate::study::Swept;

/// So many values of each axis of a sweep are tried before the run.
const TRIED: usize = 100;

/// What can be proved wrong once everything has been read: values out of range, bodies held twice and the like.
pub(crate) fn check(draft: &mut Draft) {
    let equations = Equations::new(draft.model.clone());
    let own =
        equations.as_ref().map_err(Clone::clone).and_then(|e| e.start(&draft.model.parameters).map(drop));
    note_all(draft, own, None);
    if let (Ok(equations), true) = (equations, draft.mistakes.is_empty()) {
        check_sweep(draft, &equations);
    }
}

/// The first value of each axis that is wrong, the other parameters being what they are.
fn check_sweep(draft: &mut Draft, equations: &Equations) {
    for axis in draft.sweep.clone() {
        let Swept::Parameter(name) = &axis.of else { continue };
        for value in axis.values.iter().take(TRIED) {
            let mut parameters = draft.model.parameters.clone();
            let outcome = parameters.set(name, value.value.clone()).map_err(ModelErrors::from);
            let outcome = outcome.and_then(|_| equations.start(&parameters).map(drop));
            if outcome.is_err() {
                note_all(draft, outcome, Some(&value.label));
                break;
            }
        }
    }
}

/// The mistakes, each with the run of the sweep that makes it.
fn note_all(draft: &mut Draft, outcome: Result<(), ModelErrors>, run: Option<&str>) {
    for error in outcome.err().into_iter().flat_map(|errors| errors.0) {
        let mut mistake = diagnose(draft, &error);
        if let Some(run) = run {
            mistake.message = format!("in the run `{run}`: {}", mistake.message);
        }
        draft.note(mistake);
    }
}

fn diagnose(draft: &Draft, error: &ModelError) -> Diagnostic {
    let place = Place { draft };
    match error {
        ModelError::NotPositive { what, .. } => place.at(Code::Value, what, error).label("must be positive"),
        ModelError::Negative { what, .. } => place.at(Code::Value, what, error).label("must not be negative"),
        ModelError::NotFinite { what, .. } => {
            place.at(Code::NotFinite, what, error).label("not a finite number")
        }
        ModelError::Window { load, .. } => place
            .at(Code::Window, &format!("times of `{load}`"), error)
            .label("ends before it begins")
            .help("write `during = [start, end]`"),
        ModelError::PointTurned { body, load } => place
            .at(Code::PointTurned, &format!("`{load}`"), error)
            .label("turns it")
            .help(format!("let it act at \"{body}.cm\", or give `{body}` an extent, such as `ball`")),
        ModelError::HeldTwice { first, second, .. } => place.held_twice(first, second, error),
        ModelError::Start { body, .. } => {
            place.at(Code::Start, &format!("start of `{body}`"), error).label("does not fit the body")
        }
        ModelError::Restitution { what, .. } => place.at(Code::Value, what, error).label("from 0 to 1"),
        ModelError::Inside { body, depth, .. } => place
            .at(Code::Inside, &format!("start of `{body}`"), error)
            .label("inside the surface")
            .help(format!("start it {depth} m farther out, or a little more")),
        ModelError::CorneredPath { what } => place.at(Code::Model, what, error),
        ModelError::Type { what, .. } | ModelError::Compile { what, .. } => {
            place.at(Code::Model, what, error)
        }
        other => place.at(Code::Model, "", other),
    }
}

struct Place<'d> {
    draft: &'d Draft,
}

impl Place<'_> {
    /// Where what the model speaks of stands; at least where its body or its section does.
    fn at(&self, code: Code, what: &str, error: &ModelError) -> Diagnostic {
        let places = &self.draft.places;
        let owner = || {
            let name = what.split('`').nth(1)?;
            places.get(&format!("body `{name}`")).or_else(|| places.get(&format!("`{name}`")))
        };
        match places.get(what).or_else(owner) {
            Some(span) => Diagnostic::new(code, span.clone(), error.to_string()),
            None => Diagnostic::new(code, 0..0, error.to_string()).nowhere(),
        }
    }

    fn held_twice(&self, first: &str, second: &str, error: &ModelError) -> Diagnostic {
        let mistake = self.at(Code::HeldTwice, &format!("pivot `{second}`"), error).label("held again");
        let mistake = match self.draft.places.get(&format!("pivot `{first}`")) {
            Some(span) => mistake.also(span.clone(), "held first"),
            None => mistake,
        };
        mistake.help("a body that is held at two points cannot move: leave one of them out")
    }
}
