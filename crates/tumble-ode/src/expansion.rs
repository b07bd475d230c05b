//! The Taylor expansion of a solution at one instant.

use tumble_expr::{Branches, Jets};

use crate::Reason;
use crate::compiled::Compiled;

/// Series of every state, and of the time where the clock is not the time, at one instant.
#[derive(Clone, Debug)]
pub(crate) struct Expansion {
    /// `[state][order]`, orders 0 to `order`.
    pub(crate) states: Vec<Vec<f64>>,
    /// Series of the time in the clock, where they differ.
    pub(crate) time: Option<Vec<f64>>,
}

impl Expansion {
    /// Highest order.
    pub(crate) fn order(&self) -> usize {
        self.states.first().or(self.time.as_ref()).map_or(1, |series| series.len() - 1)
    }
}

/// Expands the solution through `states` at `time`: `(k + 1) x_(k+1)` is the rate's coefficient of order k.
pub(crate) fn expand(
    system: &Compiled,
    jets: &mut Jets<f64>,
    order: usize,
    time: f64,
    states: &[f64],
) -> Result<Expansion, Reason> {
    let count = system.len();
    jets.start(time, states, Branches::Free);
    for k in 0..order {
        let next = (k + 1) as f64;
        for state in 0..count {
            let coefficient = jets.output(state)[k] / next;
            if !coefficient.is_finite() {
                return Err(Reason::NotFinite { state: system.names[state].clone() });
            }
            jets.set(state, k + 1, coefficient);
        }
        let clock = if system.own_clock { jets.output(count)[k] } else { f64::from(k == 0) };
        jets.set(count, k + 1, clock / next);
        if k + 1 < order {
            jets.extend(k + 1);
        }
    }
    let series = |slot: usize| jets.slot(slot as u32)[..=order].to_vec();
    Ok(Expansion { states: (0..count).map(series).collect(), time: system.own_clock.then(|| series(count)) })
}
