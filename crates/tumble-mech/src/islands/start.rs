//! A start of all bodies, taken apart.

use std::collections::HashMap;

use tumble_expr::Symbol;
use tumble_ode::{Cause, InitialState};

use crate::equations::Equations;
use crate::mode::Mode;

/// Where the states of a start are.
pub(super) struct Places<'a> {
    equations: &'a Equations,
    whole: &'a InitialState<Mode>,
    states: HashMap<Symbol, usize>,
    apart: Vec<usize>,
}

impl<'a> Places<'a> {
    pub(super) fn of(equations: &'a Equations, whole: &'a InitialState<Mode>) -> Self {
        let states = equations.states(&whole.mode).into_iter().enumerate();
        let states = states.map(|(place, symbol)| (symbol, place)).collect();
        Self { equations, whole, states, apart: equations.apart(&whole.mode) }
    }

    pub(super) fn start(&self) -> &'a InitialState<Mode> {
        self.whole
    }

    /// The start of some bodies alone.
    pub(super) fn of_some(&self, bodies: &[usize]) -> InitialState<Mode> {
        let Self { equations, whole, .. } = self;
        let mode = equations.restricted(&whole.mode, bodies);
        let places: Vec<usize> = equations.states(&mode).iter().map(|symbol| self.states[symbol]).collect();
        let some = |of: &[f64]| places.iter().map(|place| of[*place]).collect();
        let apart = equations.apart(&mode);
        let causes = whole.causes.iter().filter_map(|cause| match cause {
            Cause::LazyGuard(index) => apart.binary_search(&self.apart[*index]).ok().map(Cause::LazyGuard),
            other => Some(*other),
        });
        InitialState {
            states: some(&whole.states),
            compensation: some(&whole.compensation),
            causes: causes.collect(),
            inputs: whole.inputs.clone(),
            mode,
            ..**whole
        }
    }
}
