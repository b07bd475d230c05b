//! Whether a step is known everywhere by its series alone.
//!
//! The series of the step are there already, and what they leave out has a bound that costs a part of what they cost ([`Remainders`]). Most
//! steps obey the equations by it and keep away from every zero that is watched; nothing more need be done then. The others are
//! looked at by intervals. A bound that is infinite says nothing.
//!
//! Formulas that may be narrow are held to what every step may be off by: the check run with a finer tolerance is held to less, so
//! what is passed over in the motion and not there is in the error stated.
//!
//! [`Remainders`]: tumble_expr::Remainders

use tumble_expr::least;

use super::{Demand, Stretch, VANISHES};
use crate::engine::{Engine, Hit};
use crate::expansion::Expansion;

impl Engine {
    /// Whether a step obeys the equations, with nothing hidden in it, and comes to no zero that is watched.
    pub(super) fn is_clear(&mut self, step: Stretch<'_>, demand: &Demand<'_>) -> bool {
        let Stretch { expansion, length, hits } = step;
        if hits.iter().any(|hit| !matches!(hit, Hit::Turning(_))) || self.system.transformed {
            return false;
        }
        // Of what is not watched the last order is not found.
        let order = expansion.order() - usize::from(!self.system.is_watched);
        self.jets.remainders(&mut self.remainders, order, length);
        self.keeps_away(expansion, length)
            && (0..self.system.len()).all(|state| self.is_obedient(state, (expansion, length, order), demand))
    }

    /// Whether the polynomial of a state obeys its equation.
    fn is_obedient(
        &self,
        state: usize,
        (expansion, length, order): (&Expansion, f64, usize),
        demand: &Demand<'_>,
    ) -> bool {
        let slot = self.system.tape.outputs()[state];
        let (series, rate) = (&expansion.states[state], &self.jets.slot(slot)[..=order]);
        let (mut defect, mut slope, mut power) = (self.remainders.of(slot), 0.0, 1.0);
        for (k, rate) in rate.iter().enumerate() {
            let own = (k + 1) as f64 * series.get(k + 1).copied().unwrap_or(0.0);
            defect += (own - rate).abs() * power;
            slope += own.abs() * power;
            power *= length;
        }
        match self.system.may_be_narrow {
            true => {
                self.is_of_tolerance(state, defect, length, demand) || self.is_harmless(state, defect, demand)
            }
            false => self.obeys(state, [defect, slope], length, demand),
        }
    }

    /// Whether nothing that is watched comes to zero, but what is zero at the start.
    fn keeps_away(&self, expansion: &Expansion, length: f64) -> bool {
        let (tape, active) = (&self.system.tape, self.active());
        let away = |slot: u32, series: &[f64], zeros: usize, offset: f64| {
            let mut power = 1.0;
            let terms = series.iter().enumerate().map(|(k, c)| {
                let term = if k == 0 { c - offset } else { c * power };
                power *= length;
                term
            });
            let rounding = VANISHES * (self.size_of(slot) + offset.abs());
            least(terms.skip(zeros)) > self.remainders.of(slot) + if zeros == 0 { rounding } else { 0.0 }
        };
        let branches = tape.guards().iter().zip(expansion.branches.iter()).enumerate();
        let mut branches = branches.filter(|(branch, _)| active.branches[*branch]);
        let first = self.system.len();
        let mut guards = tape.outputs()[first..].iter().zip(expansion.guards.iter()).enumerate();
        let mut tables = tape.tables().iter().zip(expansion.arguments.iter()).enumerate();
        branches.all(|(branch, (slot, series))| {
            away(*slot, series, usize::from(self.is_zero_branch(branch)), 0.0)
        }) && guards.all(|(guard, (slot, series))| away(*slot, series, self.zeros_of_guard(guard), 0.0))
            && tables.all(|(lookup, (table, series))| {
                let segment = self.signs()[tape.guards().len() + lookup] as usize;
                let ends = table.table.0.ends(segment).into_iter().filter(|knot| knot.is_finite());
                !active.tables[lookup] || { ends }.all(|knot| away(table.of, series, 0, knot))
            })
    }
}
