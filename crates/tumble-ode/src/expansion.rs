//! The Taylor expansion of a solution at one instant, with all functions that are watched along it.

use tumble_expr::{Branches, Jets, Row, Slot, Turning};

use crate::compiled::Compiled;
use crate::polynomial::value;
use crate::{Coefficients, Reason};

/// Series at one instant, in the parameter that starts there; kept to be used again for the next one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Expansion {
    /// Time of the instant, s.
    pub(crate) start: f64,
    /// `[state][order]`, orders 0 to `order`.
    pub(crate) states: Coefficients,
    /// Series of the time in the parameter, where they differ.
    pub(crate) time: Option<Vec<f64>>,
    /// Guards of the tape's branches.
    pub(crate) branches: Coefficients,
    /// What turns, in the tape's order.
    pub(crate) turnings: Vec<Turn>,
    /// Arguments of the tape's tables.
    pub(crate) arguments: Coefficients,
    /// Guards of the model.
    pub(crate) guards: Coefficients,
    /// Lazily evaluated guards that may be reached.
    pub(crate) near: Vec<Near>,
}

/// A lazily evaluated guard that may be reached.
#[derive(Clone, Debug)]
pub(crate) struct Near {
    /// Among all of them.
    pub(crate) index: usize,
    /// Its series.
    pub(crate) series: Row,
    /// Those of what must not be negative for its zeros to count.
    pub(crate) conditions: Vec<Row>,
}

/// A length, root or power along a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Turn {
    /// Series of the square of a length, or of the argument of a root or power: smooth where the function is not.
    pub(crate) square: Vec<f64>,
    /// Components of a length. At its least value their squares cancel, so it is found from them and not from the
    /// square.
    pub(crate) components: Coefficients,
}

impl Turn {
    /// The length at s; the root of the argument's size for a root or power.
    pub(crate) fn length(&self, s: f64) -> f64 {
        if self.components.is_empty() {
            return value(&self.square, s).abs().sqrt();
        }
        self.components.iter().map(|component| value(component, s)).fold(0.0, libm::hypot)
    }

    fn collect(&mut self, turning: &Turning, (jets, order): (&Jets<f64>, usize)) {
        let row = |slot: Slot| &jets.slot(slot)[..=order];
        let (square, parts) = match turning {
            Turning::Power { of } => (row(*of), &[][..]),
            Turning::Norm { parts, index } => (&jets.square_of_norm(*index)[..=order], &parts[..]),
        };
        self.square.clear();
        self.square.extend_from_slice(square);
        self.components.refill(parts.iter().map(|part| row(*part)));
    }
}

impl Expansion {
    /// Highest order.
    pub(crate) fn order(&self) -> usize {
        self.states.get(0).or(self.time.as_deref()).map_or(1, |series| series.len() - 1)
    }

    /// Copies what was found, up to that order.
    fn collect(&mut self, system: &Compiled, (jets, order): (&Jets<f64>, usize), turnings: &[Turning]) {
        let tape = &system.tape;
        let row = |slot: Slot| &jets.slot(slot)[..=order];
        let first_guard = system.len() + usize::from(system.transformed);
        let guards = &tape.outputs()[first_guard..][..system.guards];
        self.states.refill((0..system.len()).map(|state| row(state as Slot)));
        self.time = system.transformed.then(|| {
            let mut series = self.time.take().unwrap_or_default();
            series.clear();
            series.extend_from_slice(row(tape.time_slot()));
            series
        });
        self.branches.refill(tape.guards().iter().map(|slot| row(*slot)));
        self.turnings.resize_with(turnings.len(), Turn::default);
        for (turn, turning) in self.turnings.iter_mut().zip(turnings) {
            turn.collect(turning, (jets, order));
        }
        self.arguments.refill(tape.tables().iter().map(|lookup| row(lookup.of)));
        self.guards.refill(guards.iter().map(|slot| row(*slot)));
        self.near.clear();
    }
}

/// Branch signs that hold along an expansion.
#[derive(Clone, Copy)]
pub(crate) struct Frozen<'a> {
    pub(crate) signs: &'a [f64],
    pub(crate) vanishing: &'a [bool],
}

/// Coefficients of higher orders than this may be beyond the range of numbers, next to a sharp turn: the expansion then ends before
/// them, and the check says how far it reaches.
const ENOUGH: usize = 8;

/// Expands the solution through `states` at `time`: `(k + 1) x_(k+1)` is the rate's coefficient of order k, or zero in what
/// does not move. Every rate is off by the same all along, if any are.
pub(crate) fn expand(
    system: &Compiled,
    jets: &mut Jets<f64>,
    order: usize,
    (frozen, turnings): (Frozen<'_>, &[Turning]),
    (time, states, moves): (f64, &[f64], bool),
    off: &[f64],
    found: &mut Expansion,
) -> Result<(), Reason> {
    let (count, outputs) = (system.len(), system.tape.outputs());
    let rates = &outputs[..count];
    jets.set_vanishing(frozen.vanishing);
    jets.start(time, states, Branches::Frozen(frozen.signs));
    let mut known = order;
    'orders: for k in 0..order {
        let next = (k + 1) as f64;
        for (state, slot) in rates.iter().enumerate() {
            let rate = if moves { jets.coefficient(*slot, k) } else { 0.0 };
            let off = off.get(state).filter(|_| k == 0).unwrap_or(&0.0);
            let coefficient = (rate + off) / next;
            if !coefficient.is_finite() && k > ENOUGH {
                known = k - 1;
                break 'orders;
            }
            if !coefficient.is_finite() {
                return Err(Reason::NotFinite { state: system.names[state].clone() });
            }
            jets.set(state, k + 1, coefficient);
        }
        let time_rate =
            if system.transformed { jets.coefficient(outputs[count], k) } else { f64::from(k == 0) };
        jets.set(count, k + 1, time_rate / next);
        if k + 1 < order || system.is_watched {
            jets.extend(k + 1);
        }
    }
    found.start = time;
    found.collect(system, (jets, known), turnings);
    Ok(())
}
