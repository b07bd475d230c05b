//! Values to start a run from: checked numbers for the parameters, the states and the mode.

use tumble_ode::{InitialState, Reason};

use crate::equations::Equations;
use crate::error::{ModelError, ModelErrors};
use crate::mode::Mode;
use crate::parameters::{Known, Parameters};
use crate::placement::Placement;
use crate::uniqueness::Spot;

impl Equations {
    /// Start of a run at time 0 with these parameters, which have the model's names.
    ///
    /// Everything whose value must be positive, finite or in order is checked here, all at once; so is what events that set
    /// parameters make of it.
    pub fn start(&self, parameters: &Parameters) -> Result<InitialState<Mode>, ModelErrors> {
        let known = parameters.known()?;
        let mut mistakes = self.value_mistakes(&known);
        let (mut states, mut compensation) = self.initial_states(&known, &mut mistakes)?;
        let mut mode = self.initial_mode(&known, &mut mistakes)?;
        states.resize(self.algebraic_places(&mode).end, 0.0);
        compensation.resize(states.len(), 0.0);
        if !mistakes.is_empty() {
            return Err(ModelErrors(mistakes));
        }
        let inputs = known.values().to_vec();
        self.assemble(&mut mode, &mut states, &mut compensation, &inputs)?;
        let causes = self.first_contacts(&mode, &states, &inputs, &mut mistakes)?;
        if causes.is_empty() && mistakes.is_empty() {
            let problem = |reason: Reason| ModelError::Feedback { problem: reason.to_string() };
            self.brake_at_start(&mut mode, &mut states, &inputs).map_err(problem)?;
            let now = Spot { mode: &mode, time: 0.0, states: &states, inputs: &inputs };
            self.refuse_feedback(now, &[]).map_err(problem)?;
            self.find_forces(&mode, 0.0, &mut states, &inputs).map_err(problem)?;
        }
        match mistakes.is_empty() {
            true => {
                let rounding = parameters.rounding();
                let is_proved = true;
                Ok(InitialState {
                    time: 0.0,
                    mode,
                    states,
                    compensation,
                    inputs,
                    causes,
                    rounding,
                    is_proved,
                    stride: 1.0,
                })
            }
            false => Err(ModelErrors(mistakes)),
        }
    }

    /// States, and what rounding left out of each.
    fn initial_states(
        &self,
        known: &Known<'_>,
        mistakes: &mut Vec<ModelError>,
    ) -> Result<(Vec<f64>, Vec<f64>), ModelError> {
        let placements = self.model().placements();
        let (mut formulas, mut first) = (vec![], vec![]);
        for (index, Placement { position, velocity, angle, omega }) in placements.into_iter().enumerate() {
            first.push(formulas.len());
            if !self.is_pivoted(index) {
                formulas.extend_from_slice(position.components());
                formulas.extend_from_slice(velocity.components());
            }
            formulas.extend([angle, omega]);
        }
        // All at once: where a body starts may follow from where others do.
        let values = known.evaluate(&formulas)?;
        for (index, value) in values.iter().enumerate().filter(|(_, value)| !value.is_finite()) {
            let body = &self.model().bodies[first.partition_point(|first| *first <= index) - 1];
            note(
                mistakes,
                ModelError::NotFinite { what: format!("start of `{}`", body.name), value: *value },
            );
        }
        Ok(known.rounded(&values, &formulas, 0).into_iter().unzip())
    }

    /// The mode of all bodies in which nothing touches and no load acts that does not always.
    pub fn idle_mode(&self) -> Mode {
        Mode { bodies: (0..self.model().bodies.len()).collect(), ..Mode::default() }
    }

    fn initial_mode(&self, known: &Known<'_>, mistakes: &mut Vec<ModelError>) -> Result<Mode, ModelError> {
        let mut windows = vec![];
        for window in self.windows() {
            let (mut from, mut to) = (f64::INFINITY, f64::INFINITY);
            for (ends, time) in window.times() {
                let value = known.evaluate(std::slice::from_ref(time))?[0];
                if !value.is_finite() {
                    note(
                        mistakes,
                        ModelError::NotFinite { what: format!("times of `{}`", window.load), value },
                    );
                }
                *(if ends { &mut to } else { &mut from }) = value;
            }
            // A start that is an event has not happened yet; an end that is one has not either.
            if from.is_finite() && to < from {
                mistakes.push(ModelError::Window { load: window.load.clone(), from, to });
            }
            windows.push(from <= 0.0 && 0.0 < to);
        }
        Ok(Mode { windows, ..self.idle_mode() })
    }
}

/// A formula may hold the mistake that its value has.
fn note(mistakes: &mut Vec<ModelError>, mistake: ModelError) {
    if mistakes.iter().all(|known| known.what() != mistake.what()) {
        mistakes.push(mistake);
    }
}
