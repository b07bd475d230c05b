//! The states of a mode, and which of them are of a body.

use tumble_expr::{Expr, Symbol};

use super::Equations;
use crate::body_equations::BodyEquations;
use crate::coordinates::{Coordinates, Measure, StateRate};
use crate::laws;
use crate::mode::Mode;

impl Equations {
    /// The states of a mode in order.
    pub fn states(&self, mode: &Mode) -> Vec<Symbol> {
        let symbol = |state: &StateRate| state.symbol.clone();
        let bodies = mode.bodies.iter().flat_map(|body| self.parts.bodies[*body].states.iter().map(symbol));
        let roots = self.roots(mode).into_iter().map(|pair| self.parts.pairs.all[pair].root_symbol());
        let others = self.seats(mode).into_iter().chain(self.algebraic_states(mode));
        bodies.chain(others.map(|state| state.symbol)).chain(roots).collect()
    }

    /// The states of a mode: those of the bodies, then where events have made joints, then forces that loads read otherwise than linearly,
    /// then the roots of the depths of Hertzian contacts.
    pub(crate) fn state_rates(&self, mode: &Mode) -> Vec<StateRate> {
        let bodies = mode.bodies.iter().flat_map(|body| {
            let is_still = mode.still.binary_search(body).is_ok();
            let rate = move |state: StateRate| match is_still || self.is_braked(mode, &state.symbol) {
                true => StateRate { rate: Expr::zero(), ..state },
                false => state,
            };
            self.parts.bodies[*body].states.iter().cloned().map(rate)
        });
        let roots = self.roots(mode);
        let root = |index: &usize| {
            let pair = &self.parts.pairs.all[*index];
            let others = roots.iter().filter(|other| *other != index);
            let others = others.map(|other| Expr::from(self.parts.pairs.all[*other].root_symbol()));
            StateRate {
                symbol: pair.root_symbol(),
                rate: laws::compliant::root_rate(pair, others),
                measure: Measure::Root,
                per_parameter: true,
            }
        };
        let algebraic = self.algebraic_states(mode);
        bodies.chain(self.seats(mode)).chain(algebraic).chain(roots.iter().map(root)).collect()
    }

    /// Pairs whose depth's root is a state of a mode.
    pub(crate) fn roots(&self, mode: &Mode) -> Vec<usize> {
        mode.pressed().filter(|pair| self.parts.pairs.all[*pair].is_hertzian()).collect()
    }

    /// Index of a body's first state in a mode; of a body after all others, where the states of bodies end.
    pub(crate) fn first_state(&self, mode: &Mode, body: usize) -> usize {
        if mode.bodies.len() == self.parts.bodies.len() {
            return self.parts.first_states[body];
        }
        let before = mode.bodies.iter().take_while(|before| **before < body);
        before.map(|before| self.parts.bodies[*before].coordinates.count()).sum()
    }

    /// Indices of a body's velocities among the states of a mode.
    pub(crate) fn velocity_states(&self, mode: &Mode, body: usize) -> Vec<usize> {
        let first = self.first_state(mode, body);
        self.parts.bodies[body].coordinates.velocity_states().iter().map(|state| first + state).collect()
    }

    /// The same of some bodies, one after the other.
    pub(crate) fn velocities_of(&self, mode: &Mode, bodies: &[usize]) -> Vec<usize> {
        bodies.iter().flat_map(|body| self.velocity_states(mode, *body)).collect()
    }

    /// The same of those that something has to hold: a point that does not turn will not.
    pub(crate) fn free_velocity_states(&self, mode: &Mode, body: usize, states: &[f64]) -> Vec<usize> {
        let mut velocities = self.velocity_states(mode, body);
        let is_point = matches!(self.parts.bodies[body].coordinates, Coordinates::Free { is_point: true });
        let turns = velocities.last().is_some_and(|omega| states[*omega] != 0.0);
        if is_point && !turns && !self.is_turned_by_joints(mode, body) {
            velocities.pop();
        }
        velocities
    }

    /// Indices of the states of a mode that a body's velocities are the rates of.
    pub(crate) fn coordinate_states(&self, mode: &Mode, body: usize) -> Vec<usize> {
        let first = self.first_state(mode, body);
        self.parts.bodies[body].coordinates.coordinate_states().iter().map(|state| first + state).collect()
    }

    /// What each of a body's coordinates measures.
    pub(crate) fn coordinate_measures(&self, body: usize) -> Vec<Measure> {
        let BodyEquations { coordinates, states, .. } = &self.parts.bodies[body];
        coordinates.coordinate_states().iter().map(|state| states[*state].measure).collect()
    }
}
