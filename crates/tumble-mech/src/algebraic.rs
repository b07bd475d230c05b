//! # Law
//! A load may depend on forces of contacts and joints in any way, as friction in a pin does on `sqrt(fx^2 + fy^2)`. The forces z that it reads so
//! obey `z = lambda(x, t, z)`, where lambda follows from linear equations once z is given. That is an algebraic part of the equations of
//! motion, of index one while the matrix `E = 1 - d lambda/d z` is regular: z is a state, with the rate `E z' = d lambda/d t + d lambda/d x x'`, and
//! `lambda - z = 0` is an invariant. Newton's method finds z where a mode begins and after each step, and Taylor's coefficients of higher order
//! are linear in it, with the same E.
//! # Symbols and units
//! z and lambda (N, or N m of couples), x states, t time (s), E a pure number for one force.
//! # Sign and frame
//! Those of the forces.
//! # Validity
//! The determinant of E has to be positive. The part that the loads leave of what a unit of a force does to its own equation, `1/(E^-1)_jj`, has to be positive, as where the loads are
//! linear. Of several solutions at an instant the one is continued that was there before; where there was none, several are refused with their
//! values, as is none. The loads on these bodies must not jump but at events: no `if`, `step` or `sign` of anything but a rate that it brakes.
//! # Source
//! Differential-algebraic equations of index one (Brenan, Campbell, Petzold 1996).
//! # Checked by
//! `tests/implicit.rs`: friction in a pin against closed forms and an independent integration, thresholds, forces with two solutions and with none.

mod newton;

use std::collections::{HashMap, HashSet};
use std::ops::Range;

use tumble_expr::{Dimension, Expr, Substitution, Symbol};

use crate::contact::Grip;
use crate::coordinates::{Measure, StateRate};
use crate::equations::Equations;
use crate::error::ModelError;
use crate::mode::Mode;
use crate::term::Term;

/// A force that loads read in a way that is not linear.
#[derive(Clone, Debug)]
pub(crate) struct Algebraic {
    pub(crate) force: Symbol,
    /// Stands for it in the loads.
    pub(crate) state: Symbol,
    /// Stands for the rate of that.
    pub(crate) rate: Symbol,
    /// A body that a load acts on which reads it.
    pub(crate) body: usize,
    /// The loads, by index.
    pub(crate) loads: Vec<usize>,
}

/// The forces that loads read so: in the loads their states take their places.
pub(crate) fn all(terms: &mut [Term], forces: &HashSet<Symbol>) -> Vec<Algebraic> {
    let mut found: Vec<Algebraic> = vec![];
    for (index, term) in terms.iter_mut().enumerate() {
        let parts = stated(term);
        if parts.iter().all(|part| part.nonlinear_part(forces).is_none()) {
            continue;
        }
        let mut read: Vec<Symbol> =
            Expr::symbols_of(&parts).into_iter().filter(|symbol| forces.contains(symbol)).collect();
        read.sort_unstable_by(|a, b| a.name.cmp(&b.name));
        let mut states = Substitution::default();
        for force in read {
            let known = found.iter().position(|known| known.force == force).unwrap_or_else(|| {
                found.push(Algebraic::of(force.clone(), term.body));
                found.len() - 1
            });
            found[known].loads.push(index);
            states.insert(force, found[known].state.clone().into());
        }
        term.force = term.force.map(|part| states.apply(part));
        term.couple = states.apply(&term.couple);
    }
    found
}

/// Loads that jump and act on bodies of these groups.
pub(crate) fn jumps(
    terms: &[Term],
    known: &[Algebraic],
    group_of: impl Fn(usize) -> usize,
) -> Vec<ModelError> {
    let groups: HashSet<usize> = known.iter().map(|known| group_of(known.body)).collect();
    let own = terms.iter().filter(|term| groups.contains(&group_of(term.body)));
    let jumps = own.filter(|term| stated(term).iter().any(Expr::may_jump));
    let read: Vec<String> = known.iter().map(|known| known.force.name.to_string()).collect();
    let mistakes = jumps.map(|term| ModelError::Jumps { load: term.load.clone(), read: read.clone() });
    mistakes.collect()
}

/// What a load does: along x and y, and the couple.
pub(crate) fn stated(term: &Term) -> [Expr; 3] {
    [term.force.x().clone(), term.force.y().clone(), term.couple.clone()]
}

impl Algebraic {
    fn of(force: Symbol, body: usize) -> Self {
        let per_time = force.dimension.over(Dimension::TIME).unwrap_or(force.dimension);
        Self {
            state: Symbol::new(format!("{} in loads", force.name), force.dimension),
            rate: Symbol::new(format!("rate of {} in loads", force.name), per_time),
            force,
            body,
            loads: vec![],
        }
    }

    pub(crate) fn measure(&self) -> Measure {
        if self.force.dimension == Dimension::TORQUE { Measure::Torque } else { Measure::Force }
    }
}

impl Equations {
    /// Those whose states are among those of a mode, by index.
    pub(crate) fn algebraic_in(&self, mode: &Mode) -> Vec<usize> {
        let all = self.algebraic().iter().enumerate();
        all.filter(|(_, known)| mode.has(known.body)).map(|(index, _)| index).collect()
    }

    /// Those on which the motion in a mode depends: loads that read them act, and not by the sign of a rate that is held.
    pub(crate) fn implicit(&self, mode: &Mode) -> Vec<usize> {
        let mut own = self.algebraic_in(mode);
        let mut held = Substitution::default();
        for brake in
            self.acting_brakes(mode).into_iter().filter(|brake| mode.brake(*brake) == Some(Grip::Sticks))
        {
            held.insert(self.brakes()[brake].sign.clone(), Expr::zero());
        }
        let acts = |load: usize| self.loads()[load].window.is_none_or(|window| mode.windows[window]);
        own.retain(|index| {
            let known = &self.algebraic()[*index];
            known.loads.iter().filter(|load| acts(**load)).any(|load| {
                let mut parts = stated(&self.loads()[*load]).into_iter();
                parts.any(|part| held.apply(&part).symbols().contains(&known.state))
            })
        });
        own
    }

    /// Where their states are.
    pub(crate) fn algebraic_places(&self, mode: &Mode) -> Range<usize> {
        let first = self.first_state(mode, self.model().bodies.len()) + self.seats(mode).len();
        first..first + self.algebraic_in(mode).len()
    }

    /// Their states.
    pub(crate) fn algebraic_states(&self, mode: &Mode) -> Vec<StateRate> {
        let of = |index: usize| {
            let known = &self.algebraic()[index];
            StateRate {
                symbol: known.state.clone(),
                rate: known.rate.clone().into(),
                measure: known.measure(),
                per_parameter: !self.roots(mode).is_empty(),
            }
        };
        self.algebraic_in(mode).into_iter().map(of).collect()
    }
}

/// How forces change with states, in the states of a mode and the parameters as they were at the start.
pub(crate) struct Slopes {
    /// By force, its slope by the time.
    pub(crate) by_time: Vec<Expr>,
    /// By force, its slopes by those states that it depends on, each with the state's rate; states of algebraic forces left out.
    pub(crate) by_state: Vec<Vec<(Expr, StateRate)>>,
    /// By force, what a unit of the state of each does to it.
    pub(crate) among: Vec<Vec<Expr>>,
}

impl Slopes {
    /// Those of some formulas, the forces of these.
    pub(crate) fn of(equations: &Equations, mode: &Mode, own: &[usize], forces: &[Expr]) -> Self {
        let symbol = |index: &usize| &equations.algebraic()[*index].state;
        let states = equations.state_rates(mode);
        let implicit: HashMap<&Symbol, ()> = own.iter().map(|index| (symbol(index), ())).collect();
        let by_state = |force: &Expr| {
            let used = force.symbols();
            let other =
                |state: &&StateRate| used.contains(&state.symbol) && !implicit.contains_key(&state.symbol);
            let slopes = states.iter().filter(other);
            slopes.map(|state| (force.derivative(&state.symbol), state.clone())).collect()
        };
        let time = crate::parameters::time_symbol();
        Self {
            by_time: forces.iter().map(|force| force.derivative(&time)).collect(),
            by_state: forces.iter().map(by_state).collect(),
            among: forces
                .iter()
                .map(|force| own.iter().map(|index| force.derivative(symbol(index))).collect())
                .collect(),
        }
    }
}
