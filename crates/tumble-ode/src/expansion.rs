//! The Taylor expansion of a solution at one instant, with all functions that are watched along it.

use tumble_expr::{Branches, Jets, Slot, Turning};

use crate::compiled::Compiled;
use crate::polynomial::value;
use crate::{Coefficients, Reason};

/// Series at one instant, in the parameter that starts there.
#[derive(Clone, Debug)]
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
    /// Lazily evaluated guards that may be reached, each by its index.
    pub(crate) near: Vec<(usize, Vec<f64>)>,
}

/// A length, root or power along a step.
#[derive(Clone, Debug)]
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
}

impl Expansion {
    /// Highest order.
    pub(crate) fn order(&self) -> usize {
        self.states.get(0).or(self.time.as_deref()).map_or(1, |series| series.len() - 1)
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
) -> Result<Expansion, Reason> {
    let count = system.len();
    jets.set_vanishing(frozen.vanishing);
    jets.start(time, states, Branches::Frozen(frozen.signs));
    let mut known = order;
    'orders: for k in 0..order {
        let next = (k + 1) as f64;
        for state in 0..count {
            let rate = if moves { jets.output(state)[k] } else { 0.0 };
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
        let time_rate = if system.transformed { jets.output(count)[k] } else { f64::from(k == 0) };
        jets.set(count, k + 1, time_rate / next);
        if k + 1 < order || system.is_watched {
            jets.extend(k + 1);
        }
    }
    Ok(collect(system, (jets, known), turnings, time))
}

fn collect(
    system: &Compiled,
    (jets, order): (&Jets<f64>, usize),
    turnings: &[Turning],
    start: f64,
) -> Expansion {
    let tape = &system.tape;
    let row = |slot: Slot| &jets.slot(slot)[..=order];
    let slots = |slots: &[Slot]| Coefficients::of(slots.iter().map(|slot| row(*slot)));
    let first_guard = system.len() + usize::from(system.transformed);
    Expansion {
        start,
        states: Coefficients::of((0..system.len()).map(|state| row(state as Slot))),
        time: system.transformed.then(|| row(tape.time_slot()).to_vec()),
        branches: slots(tape.guards()),
        turnings: turnings.iter().map(|turning| turn(turning, (jets, order))).collect(),
        arguments: Coefficients::of(tape.tables().iter().map(|lookup| row(lookup.of))),
        guards: slots(&tape.outputs()[first_guard..][..system.guards]),
        near: vec![],
    }
}

fn turn(turning: &Turning, (jets, order): (&Jets<f64>, usize)) -> Turn {
    let row = |slot: Slot| &jets.slot(slot)[..=order];
    match turning {
        Turning::Power { of } => Turn { square: row(*of).to_vec(), components: Coefficients::default() },
        Turning::Norm { parts, index } => {
            let components = Coefficients::of(parts.iter().map(|part| row(*part)));
            Turn { square: jets.square_of_norm(*index)[..=order].to_vec(), components }
        }
    }
}
