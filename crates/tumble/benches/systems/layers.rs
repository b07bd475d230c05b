//! What the layers of an answer cost, and what a peer takes for the same error.
//!
//! - *bare*: expansions, radii, guards, and the defect at two places of each step, which cannot be left out;
//! - *checked*: enclosures of every step besides;
//! - *trusted*: the check runs besides, building of all of them included.
//!
//! Building is deriving the equations from the model, and a tape for each mode that the motion enters.

use std::time::Duration;

use crate::measure::{Patience, in_turn, micros, ratio, timed};
use crate::peer;
use crate::problems::{self, Motion, Problem};

/// Accuracies, each with how much longer the peer should take than we do.
const ACCURACIES: [(f64, f64); 3] = [(1e-6, 0.75), (1e-9, 1.2), (1e-12, 1.5)];
/// Checked steps should take at most so many times as long as bare ones.
const MOST_CHECKED: f64 = 1.5;
/// And the whole answer with its check runs.
const MOST_TRUSTED: f64 = 3.0;

/// No smaller error is asked of the peer: it would be rounding.
const LEAST_ERROR: f64 = 1e-15;

/// The times of one system at one accuracy.
pub(crate) struct Layers {
    pub(crate) steps: u64,
    pub(crate) order: usize,
    /// Largest error of a state at the end, relative where the state is larger than 1.
    pub(crate) error: f64,
    /// Steps alone.
    pub(crate) bare: Duration,
    pub(crate) checked: Duration,
    /// With building.
    pub(crate) built_bare: Duration,
    pub(crate) built_checked: Duration,
    pub(crate) trusted: Duration,
    /// The peer's time and error.
    pub(crate) peer: Duration,
    pub(crate) peer_error: f64,
}

impl Layers {
    pub(crate) fn of(problem: &Problem, accuracy: f64, patience: Patience) -> Self {
        let equations = problem.equations();
        let checked = problem.motion(&equations, accuracy, true);
        let error = problem.error(&checked.states);
        let (tolerance, peer_error) = peer::tolerance(problem, error.max(LEAST_ERROR));
        let steps = |is_proved| problem.motion(&equations, accuracy, is_proved).steps_alone();
        let built = |is_proved| timed(|| problem.motion(&problem.equations(), accuracy, is_proved).states);
        let [bare, checked_time, built_bare, built_checked, trusted, peer] = in_turn(
            patience,
            [
                &mut || steps(false),
                &mut || steps(true),
                &mut || built(false),
                &mut || built(true),
                &mut || timed(|| problem.trusted(accuracy)),
                &mut || timed(|| peer::solve(problem, tolerance)),
            ],
        );
        let Motion { steps, order, .. } = checked;
        let checked = checked_time;
        Self { steps, order, error, bare, checked, built_bare, built_checked, trusted, peer, peer_error }
    }
}

/// Both tables.
pub(crate) fn tables(is_long: bool) {
    let patience = Patience::of(is_long);
    let mut all = vec![];
    println!(
        "time of the layers, and of a step; checked to be {MOST_CHECKED} of bare, trusted {MOST_TRUSTED} of built"
    );
    println!(
        "{:<26} {:>8} {:>5} {:>5} | {:>8} {:>7} {:>8} | {:>8} {:>7} {:>8} {:>6} {:>6} | {:>8} {:>6}",
        "system",
        "accuracy",
        "steps",
        "order",
        "bare us",
        "us/step",
        "built us",
        "check us",
        "us/step",
        "built us",
        "ratio",
        "share",
        "trust us",
        "ratio"
    );
    for problem in problems::all(is_long) {
        for (accuracy, target) in ACCURACIES {
            let found = Layers::of(&problem, accuracy, patience);
            of_layers(&problem, accuracy, &found);
            all.push((problem.name, accuracy, target, found));
        }
    }
    println!(
        "\ntime of the peer over ours at the same error, which should be the target or more; *: its error is never so small"
    );
    println!(
        "{:<26} {:>8} {:>8} {:>8} {:>8} | {:>6} {:>7} {:>7} {:>6} {:>6}",
        "system", "accuracy", "error", "peer", "peer us", "bare", "checked", "b.built", "built", "target"
    );
    for (name, accuracy, target, found) in &all {
        of_peer(name, *accuracy, *target, found);
    }
}

fn of_layers(problem: &Problem, accuracy: f64, found: &Layers) {
    let each = |time: Duration| micros(time) / found.steps as f64;
    println!(
        "{:<26} {accuracy:>8.0e} {:>5} {:>5} | {:>8.0} {:>7.3} {:>8.0} | {:>8.0} {:>7.3} {:>8.0} {:>6.2} {:>5.0}% | {:>8.0} {:>6.2}",
        problem.name,
        found.steps,
        found.order,
        micros(found.bare),
        each(found.bare),
        micros(found.built_bare),
        micros(found.checked),
        each(found.checked),
        micros(found.built_checked),
        ratio(found.checked, found.bare),
        100.0 * (1.0 - ratio(found.bare, found.checked)),
        micros(found.trusted),
        ratio(found.trusted, found.built_bare),
    );
}

fn of_peer(name: &str, accuracy: f64, target: f64, found: &Layers) {
    let over = |ours: Duration| ratio(found.peer, ours);
    let mark = if found.peer_error > found.error.max(LEAST_ERROR) { '*' } else { ' ' };
    println!(
        "{name:<26} {accuracy:>8.0e} {:>8.1e} {:>8.1e}{mark}{:>8.0} | {:>6.2} {:>7.2} {:>7.2} {:>6.2} {target:>6.2}",
        found.error,
        found.peer_error,
        micros(found.peer),
        over(found.bare),
        over(found.checked),
        over(found.built_bare),
        over(found.built_checked),
    );
}
