//! Mistakes that the model finds, at their places in the file.

use tumble_mech::{Equations, ModelErrors};

use crate::draft::Draft;
use crate::sweep::Swept;

/// So many values of a sweep are tried before the run.
const TRIED: usize = 100;

/// What can be proved wrong once everything has been read: values out of range, bodies held twice and the like.
pub(crate) fn check(draft: &mut Draft) {
    if !draft.mistakes.is_empty() {
        // What the rest says of the parts that are sound need not be true of the whole; what they are worth is.
        let values = ModelErrors(draft.model.value_mistakes(&draft.model.parameters));
        return note_all(draft, Err(values), None);
    }
    let equations = match Equations::new(draft.model.clone()) {
        Ok(equations) => equations,
        Err(mistakes) => {
            let values = draft.model.value_mistakes(&draft.model.parameters);
            return note_all(draft, Err(ModelErrors([mistakes.0, values].concat())), None);
        }
    };
    let warnings = equations.check(&draft.model.parameters).and_then(|start| equations.warnings(&start));
    let warnings = warnings.map(|warnings| {
        draft.warnings.extend(warnings.iter().map(|warning| draft.places.warning(warning)));
    });
    note_all(draft, warnings, None);
    if draft.mistakes.is_empty() {
        check_sweep(draft, &equations);
    }
    draft.equations = Some(equations);
}

/// The first value of each axis that is wrong, the other parameters being what they are.
fn check_sweep(draft: &mut Draft, equations: &Equations) {
    let axes = draft.sweep.clone();
    let of_each = (TRIED / axes.len().max(1)).max(1);
    for axis in axes.iter().take(TRIED) {
        let Swept::Parameter(name) = &axis.of else { continue };
        for value in axis.values.iter().take(of_each) {
            let mut parameters = draft.model.parameters.clone();
            let outcome = parameters.set(name, value.value).map_err(ModelErrors::from);
            let outcome = outcome.and_then(|_| equations.check(&parameters).map(drop));
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
        let mut mistake = draft.places.mistake(&error);
        if let Some(run) = run {
            mistake.message = format!("in the run `{run}`: {}", mistake.message);
        }
        draft.note(mistake);
    }
}
