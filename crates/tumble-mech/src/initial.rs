//! Values to start a run from: checked numbers for the parameters, the states and the mode.

use tumble_expr::{Expr, Vector};
use tumble_ode::Start as NumericStart;

use crate::body::Body;
use crate::equations::Equations;
use crate::error::{ModelError, ModelErrors};
use crate::interaction::Interaction;
use crate::mode::Mode;
use crate::parameters::Parameters;
use crate::start::Start;
use crate::surface::Surface;

impl Equations {
    /// Start of a run at time 0 with these parameters, which have the model's names.
    ///
    /// Everything whose value must be positive, finite or in order is checked here, all at once.
    pub fn start(&self, parameters: &Parameters) -> Result<NumericStart<Mode>, ModelErrors> {
        let inputs = parameters.values()?;
        let mut mistakes = vec![];
        for body in &self.model().bodies {
            mistakes.extend(body_mistakes(body, parameters)?);
        }
        for interaction in &self.model().interactions {
            mistakes.extend(coefficient_mistakes(&**interaction, parameters)?);
        }
        for surface in &self.model().surfaces {
            mistakes.extend(surface_mistakes(surface, parameters)?);
        }
        let states = self.initial_states(parameters, &mut mistakes)?;
        let mode = self.initial_mode(parameters, &mut mistakes)?;
        if !mistakes.is_empty() {
            return Err(ModelErrors(mistakes));
        }
        let causes = self.first_contacts(&mode, &states, &inputs, &mut mistakes)?;
        match mistakes.is_empty() {
            true => {
                Ok(NumericStart { time: 0.0, mode, states, inputs, causes, rounding: parameters.rounding() })
            }
            false => Err(ModelErrors(mistakes)),
        }
    }

    fn initial_states(
        &self,
        parameters: &Parameters,
        mistakes: &mut Vec<ModelError>,
    ) -> Result<Vec<f64>, ModelError> {
        let mut states = vec![];
        for (index, body) in self.model().bodies.iter().enumerate() {
            let start = self.model().start_of(&body.name);
            let formulas = if self.model().pivot_of(&body.name).is_some() {
                turning(&start)
            } else {
                let drawn = &self.mass_properties(index).centre;
                moving(&start, drawn).into_iter().chain(turning(&start)).collect()
            };
            let values = parameters.evaluate(&formulas)?;
            let bad = values.iter().filter(|value| !value.is_finite());
            mistakes.extend(bad.map(|value| ModelError::NotFinite {
                what: format!("start of `{}`", body.name),
                value: *value,
            }));
            let rounding = parameters.rounding();
            let key = |place: usize| (index * values.len() + place) as u64;
            let rounded =
                values.iter().enumerate().map(|(place, value)| rounding.computed(*value, key(place)));
            states.extend(rounded);
        }
        Ok(states)
    }

    fn initial_mode(
        &self,
        parameters: &Parameters,
        mistakes: &mut Vec<ModelError>,
    ) -> Result<Mode, ModelError> {
        let mut windows = vec![];
        for window in self.windows() {
            let (mut from, mut to) = (f64::INFINITY, f64::INFINITY);
            for (ends, time) in window.times() {
                let value = parameters.evaluate(std::slice::from_ref(time))?[0];
                if !value.is_finite() {
                    mistakes
                        .push(ModelError::NotFinite { what: format!("times of `{}`", window.load), value });
                }
                *(if ends { &mut to } else { &mut from }) = value;
            }
            // A start that is an event has not happened yet; an end that is one has not either.
            if from.is_finite() && to < from {
                mistakes.push(ModelError::Window { load: window.load.clone(), from, to });
            }
            windows.push(from <= 0.0 && 0.0 < to);
        }
        Ok(Mode { windows, ..Mode::default() })
    }
}

/// Coefficients of contact that no surface has.
fn surface_mistakes(surface: &Surface, parameters: &Parameters) -> Result<Vec<ModelError>, ModelError> {
    let mut mistakes = vec![];
    for (key, formula, _) in surface.law.dimensions() {
        let value = parameters.evaluate(std::slice::from_ref(formula))?[0];
        let what = format!("{key} of `{}`", surface.name);
        match key {
            "restitution" if !(0.0..=1.0).contains(&value) => {
                mistakes.push(ModelError::Restitution { what, value })
            }
            "stiffness" if value <= 0.0 => {
                mistakes.push(ModelError::NotPositive { what, value, unit: "N/m" })
            }
            "damping" if value < 0.0 => mistakes.push(ModelError::Negative { what, value, unit: "kg/s" }),
            _ if !value.is_finite() => mistakes.push(ModelError::NotFinite { what, value }),
            _ => {}
        }
    }
    Ok(mistakes)
}

fn coefficient_mistakes(
    interaction: &dyn Interaction,
    parameters: &Parameters,
) -> Result<Vec<ModelError>, ModelError> {
    let mut mistakes = vec![];
    let known = parameters.symbols();
    // A coefficient that changes with the time or the motion has no value yet.
    let fixed = |formula: &Expr| formula.symbols().iter().all(|symbol| known.contains(symbol));
    for (key, formula, unit) in interaction.nonnegative().into_iter().filter(|(_, formula, _)| fixed(formula))
    {
        let value = parameters.evaluate(&[formula])?[0];
        let what = format!("{key} of `{}`", interaction.name());
        if value < 0.0 {
            mistakes.push(ModelError::Negative { what, value, unit });
        } else if !value.is_finite() {
            mistakes.push(ModelError::NotFinite { what, value });
        }
    }
    Ok(mistakes)
}

fn moving(start: &Start, drawn: &Vector) -> Vec<Expr> {
    let at = start.at.as_ref().unwrap_or(drawn).components().to_vec();
    let rest = Vector::planar(Expr::zero(), Expr::zero());
    let velocity = start.velocity.as_ref().unwrap_or(&rest).components().to_vec();
    at.into_iter().chain(velocity).collect()
}

fn turning(start: &Start) -> Vec<Expr> {
    let value = |formula: &Option<Expr>| formula.clone().unwrap_or_else(Expr::zero);
    vec![value(&start.angle), value(&start.omega)]
}

/// Masses and lengths that must be positive, and inertias that must not be negative.
fn body_mistakes(body: &Body, parameters: &Parameters) -> Result<Vec<ModelError>, ModelError> {
    let mut mistakes = vec![];
    let properties = body.mass_properties();
    let mut positive = vec![("mass".to_owned(), properties.mass.clone(), "kg")];
    for part in &body.parts {
        positive.extend(part.shape.sizes().into_iter().map(|(name, size)| (name.to_owned(), size, "m")));
    }
    for (name, formula, unit) in positive {
        let value = parameters.evaluate(&[formula])?[0];
        let what = format!("{name} of `{}`", body.name);
        if !value.is_finite() {
            mistakes.push(ModelError::NotFinite { what, value });
        } else if value <= 0.0 {
            mistakes.push(ModelError::NotPositive { what, value, unit });
        }
    }
    if let Some(restitution) = &body.restitution {
        let value = parameters.evaluate(std::slice::from_ref(restitution))?[0];
        if !(0.0..=1.0).contains(&value) {
            let what = format!("restitution of `{}`", body.name);
            mistakes.push(ModelError::Restitution { what, value });
        }
    }
    if mistakes.is_empty() {
        let value = parameters.evaluate(&[properties.inertia])?[0];
        let what = format!("moment of inertia of `{}`", body.name);
        if !value.is_finite() {
            mistakes.push(ModelError::NotFinite { what, value });
        } else if value < 0.0 {
            mistakes.push(ModelError::Negative { what, value, unit: "kg m^2" });
        }
    }
    Ok(mistakes)
}
