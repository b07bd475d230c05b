//! The pendulum in the wind as JSON, for programs that compare it with others.

use serde_json::{Value, json};

use crate::layers::Layers;
use crate::measure::{Patience, micros};
use crate::problems;

const ACCURACIES: [f64; 3] = [1e-6, 1e-9, 1e-12];

/// Prints a list with an entry for each accuracy; times in microseconds, the least of many.
pub(crate) fn print() {
    let problem = problems::wind_pendulum();
    let of = |accuracy: f64| -> Value {
        let found = Layers::of(&problem, accuracy, Patience::of(false));
        json!({
            "accuracy": accuracy,
            "steps": found.steps,
            "order": found.order,
            "error": found.error,
            "bare_us": micros(found.bare),
            "checked_us": micros(found.checked),
            "built_bare_us": micros(found.built_bare),
            "built_checked_us": micros(found.built_checked),
            "trusted_us": micros(found.trusted),
        })
    };
    println!("{}", Value::from_iter(ACCURACIES.map(of)));
}
