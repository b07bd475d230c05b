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

use tumble_expr::{Bernstein, Slot};

use super::{Demand, Doubt, Stretch, Unknown, VANISHES};
use crate::engine::{Engine, Hit};
use crate::expansion::Expansion;
use crate::scale::Scales;

/// What is zero at the end of a step is so but for this part of it.
const END: f64 = 1e-9;
/// Parts of a step that are tried where the whole does not obey by its bound: some more steps cost less than intervals.
const PARTS: [f64; 3] = [0.8, 0.6, 0.4];

/// What its series tell of a step.
pub(super) enum Clear {
    /// All that is asked.
    Whole,
    /// That it is to be shorter.
    Part(Unknown),
    /// Nothing.
    Not,
}

impl Engine {
    /// Whether a step obeys the equations, with nothing hidden in it, and comes to no zero that is watched.
    pub(super) fn clear(&mut self, step: Stretch<'_>, demand: &Demand<'_>) -> Clear {
        let Stretch { expansion, length, hits } = step;
        if self.system.transformed {
            return Clear::Not;
        }
        let found = self.disobedient(expansion, length, demand);
        if !self.keeps_away(step, demand.scales) {
            return Clear::Not;
        }
        let Some(state) = found else { return Clear::Whole };
        // A length that vanishes where the step ends has no bound before, and shorter steps would never come there. What may be narrow
        // is held to so much that intervals cost less than shorter steps.
        if !hits.is_empty() || self.system.may_be_narrow {
            return Clear::Not;
        }
        let obeys = |part: &f64| self.disobedient(expansion, part * length, demand).is_none();
        match PARTS.into_iter().find(obeys) {
            Some(part) => Clear::Part(Unknown { length: part * length, of: Doubt::Leaf(state) }),
            None => Clear::Not,
        }
    }

    /// A state that does not obey its equation by the bound, along a step of that length.
    fn disobedient(&mut self, expansion: &Expansion, length: f64, demand: &Demand<'_>) -> Option<usize> {
        // Of what is not watched the last order is not found.
        let order = expansion.order() - usize::from(!self.system.is_watched);
        self.jets.remainders(&mut self.remainders, order, length);
        (0..self.system.len()).find(|state| !self.is_obedient(*state, (expansion, length, order), demand))
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

    /// Whether nothing that is watched comes to zero within a step: at its start what is zero now, at its end what ends it.
    fn keeps_away(&self, step: Stretch<'_>, scales: &Scales) -> bool {
        let Stretch { expansion, length, hits } = step;
        let (tape, active) = (&self.system.tape, self.active());
        let is_hit = |hit: &dyn Fn(&Hit) -> bool| hits.iter().any(hit);
        let branch = |(branch, (slot, series)): (usize, (&Slot, &[f64]))| {
            let ends = is_hit(&|hit| matches!(hit, Hit::Branch(hit, _) if *hit == branch));
            let zeros = usize::from(self.is_zero_branch(branch));
            !active.branches[branch] || self.is_away((*slot, series, 0.0), length, (zeros, ends), 0.0)
        };
        let guard = |(guard, (slot, series)): (usize, (&Slot, &[f64]))| {
            let ends = is_hit(&|hit| *hit == Hit::Guard(guard));
            let nothing = self.moves_nothing(guard, (expansion, length), scales);
            self.is_away((*slot, series, 0.0), length, (self.zeros_of_guard(guard), ends), nothing)
        };
        let guards = &tape.outputs()[self.system.len()..];
        tape.guards().iter().zip(expansion.branches.iter()).enumerate().all(branch)
            && guards.iter().zip(expansion.guards.iter()).enumerate().all(guard)
            && (0..tape.tables().len()).all(|lookup| {
                !active.tables[lookup] || self.stays_on_segment(lookup, &expansion.arguments[lookup], length)
            })
    }

    /// Whether the argument of a measured function comes to no knot.
    fn stays_on_segment(&self, lookup: usize, series: &[f64], length: f64) -> bool {
        let tape = &self.system.tape;
        let (table, segment) = (&tape.tables()[lookup], self.signs()[tape.guards().len() + lookup] as usize);
        let mut ends = table.table.0.ends(segment).into_iter().filter(|knot| knot.is_finite());
        ends.all(|knot| self.is_away((table.of, series, knot), length, (0, false), 0.0))
    }

    /// Whether a function, less an offset, has no zero along a step, but so many at its start, and perhaps one at its end; or is not
    /// larger than what has no effect.
    fn is_away(
        &self,
        (slot, series, offset): (Slot, &[f64], f64),
        length: f64,
        (zeros, ends): (usize, bool),
        nothing: f64,
    ) -> bool {
        let powers = std::iter::successors(Some(1.0), |power| Some(power * length));
        let term = |(k, (c, power)): (usize, (&f64, f64))| if k == 0 { c - offset } else { c * power };
        let terms = series.iter().zip(powers).enumerate().map(term);
        let size = terms.clone().map(f64::abs).sum::<f64>();
        if size + self.remainders.of(slot) <= nothing {
            return true;
        }
        let own = if zeros == 0 { VANISHES * (self.size_of(slot) + offset.abs()) } else { 0.0 };
        let noise = own.max(f64::EPSILON * size) + self.remainders.of(slot);
        let mut terms = terms.skip(zeros);
        let first = terms.next().unwrap_or(0.0);
        if !ends && terms.clone().fold(first.abs(), |least, term| least - term.abs()) > noise {
            return true;
        }
        let whole = Bernstein::new(std::iter::once(first).chain(terms));
        // Over the way from the end on, what it is there is its slope: the zero is known to this part of the step.
        if ends { whole.without_end().least() * END > noise } else { whole.least() > noise }
    }
}
