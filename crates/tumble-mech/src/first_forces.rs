//! Loads at the start of a run: what is infinite or no number then is named, before a step is tried.

use std::collections::{HashMap, HashSet};

use tumble_expr::Expr;
use tumble_ode::InitialState;

use crate::equations::Equations;
use crate::error::{ModelError, ModelErrors};
use crate::interaction::Interaction;
use crate::mode::Mode;
use crate::parameters::Parameters;
use crate::term::Term;

/// Outputs a term: two of the force, one of the couple.
const OUTPUTS: usize = 3;

impl Equations {
    /// The start of a run as [`Equations::start`] finds it, and that every load has a value then.
    pub fn check(&self, parameters: &Parameters) -> Result<InitialState<Mode>, ModelErrors> {
        let start = self.start(parameters)?;
        self.refuse_loads(&start)?;
        Ok(start)
    }

    /// A mistake if a load has no value at the start.
    pub(crate) fn refuse_loads(&self, start: &InitialState<Mode>) -> Result<(), ModelErrors> {
        let mistakes = self.mistakes_at(start)?;
        if mistakes.is_empty() { Ok(()) } else { Err(ModelErrors(mistakes)) }
    }

    /// Loads that are infinite or no number at the start. Contacts come after it, and reactions follow from the others.
    fn mistakes_at(&self, start: &InitialState<Mode>) -> Result<Vec<ModelError>, ModelError> {
        let terms: Vec<Term> =
            self.terms(&start.mode).into_iter().filter(|term| !term.law.is_reaction()).collect();
        let outputs = |term: &Term| [term.force.components(), std::slice::from_ref(&term.couple)].concat();
        let formulas: Vec<Expr> = terms.iter().flat_map(outputs).collect();
        let values = self.values_at(start, &formulas)?;
        let mut told = HashSet::new();
        let bad = terms.iter().zip(values.chunks(OUTPUTS)).filter_map(|(term, values)| {
            let value = *values.iter().find(|value| !value.is_finite())?;
            told.insert(term.load.clone()).then(|| (term.load.clone(), value))
        });
        let bad: Vec<(String, f64)> = bad.collect();
        let ends = self.without_span(start, &bad)?;
        Ok(bad.into_iter().map(|(load, value)| no_force(load, value, &ends)).collect())
    }

    /// Those of some loads that are springs with both ends at one place.
    fn without_span(
        &self,
        start: &InitialState<Mode>,
        loads: &[(String, f64)],
    ) -> Result<HashSet<String>, ModelError> {
        let known: HashMap<&str, &dyn Interaction> =
            self.model().interactions.iter().map(|known| (known.name(), &**known)).collect();
        let spans = loads.iter().filter_map(|(load, _)| {
            let [from, to] = known.get(load.as_str())?.ends()?;
            Some((load.clone(), (to - from).norm()))
        });
        let (names, spans): (Vec<String>, Vec<Expr>) = spans.unzip();
        let lengths = self.values_at(start, &spans)?;
        Ok(names
            .into_iter()
            .zip(lengths)
            .filter(|(_, length)| *length == 0.0)
            .map(|(name, _)| name)
            .collect())
    }
}

fn no_force(load: String, value: f64, without_span: &HashSet<String>) -> ModelError {
    match without_span.contains(&load) {
        true => ModelError::NoSpan { load },
        false => ModelError::NoForce { load, value },
    }
}
