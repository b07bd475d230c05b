//! One mode's equations with their evaluators, and the signs of its branches.

mod beyond;
mod branches;
mod hits;
mod off;

use smallvec::{SmallVec, smallvec};
use tumble_expr::{Active, Branches, Jets, Remainders, Rounded, Row, Turning};

use crate::Reason;
use crate::check::{Check, Verdict};
use crate::compiled::{Compiled, Limit};
use crate::enclosure::Enclosure;
use crate::expansion::{Expansion, Frozen, expand};
use crate::invariants::Invariants;
use crate::lazy_guards::{self, LazyGuards};
use crate::polynomial::value;
use crate::program::Plan;
use crate::radius::{of_own_size, of_series};
use crate::scale::Scales;
use crate::signs::{leading_sign, sign_after, sign_before};
use crate::whole::{Demand, Halvings, Noise};
use crate::work::Work;
use branches::BranchSigns;
pub(crate) use hits::{Hit, Hits};
use off::Off;

/// A guard is beyond zero if it is so by more than this part of its scale: where it was located it is there but for rounding.
const KEPT: f64 = 1e-11;
/// Roots closer than this part of a step are one instant.
const SIMULTANEOUS_PART: f64 = 4.0 * f64::EPSILON;

pub(crate) struct Engine {
    pub(crate) system: Compiled,
    pub(crate) lazy_guards: LazyGuards,
    pub(crate) invariants: Invariants,
    pub(crate) jets: Jets<f64>,
    values: Jets<f64>,
    turnings: Vec<Turning>,
    branch_signs: BranchSigns,
    order: usize,
    pub(crate) inputs: Vec<f64>,
    /// Rates and guards with their rounding errors.
    pub(crate) rounded: Jets<Rounded>,
    /// Room for what they are evaluated at.
    pub(crate) rounded_leaves: Vec<Rounded>,
    pub(crate) rounded_signs: Vec<Rounded>,
    /// Made where a motion is rounded in another way.
    off: Option<Box<Off>>,
    /// Made when the first step needs it.
    pub(crate) enclosure: Option<Enclosure>,
    pub(crate) halvings: Halvings,
    /// Bounds of what series leave out.
    pub(crate) remainders: Remainders,
    /// Room for what matters with other signs.
    inactive: Active,
    /// Room for the check.
    places: Vec<[f64; 3]>,
    here: Vec<f64>,
}

impl Engine {
    pub(crate) fn new(
        system: Compiled,
        (lazy_guards, invariants): (LazyGuards, Invariants),
        order: usize,
        inputs: &[f64],
    ) -> Self {
        let order = system.exact_degree.unwrap_or(order).max(1);
        let mut jets = Jets::new(system.tape.clone(), order, inputs);
        jets.set_time_is_parameter(!system.transformed);
        let values = Jets::new(system.tape.clone(), 0, inputs);
        let turnings = system.tape.turnings();
        let leaves: Vec<Rounded> = inputs.iter().map(|value| Rounded::leaf(*value)).collect();
        let rounded = Jets::new(system.tape.clone(), 0, &leaves);
        Self {
            system,
            lazy_guards,
            invariants,
            jets,
            values,
            turnings,
            branch_signs: BranchSigns::default(),
            order,
            inputs: inputs.to_vec(),
            rounded,
            rounded_leaves: vec![],
            rounded_signs: vec![],
            off: None,
            enclosure: None,
            halvings: Halvings::default(),
            remainders: Remainders::default(),
            inactive: Active::default(),
            places: vec![],
            here: vec![],
        }
    }

    /// Expands the solution, with the branch signs that its own first coefficients ask for.
    ///
    /// A function that is zero now has the sign of its first coefficient that matters. If each side's motion leads to
    /// the other, there is no motion on either.
    pub(crate) fn expand(
        &mut self,
        (time, states): (f64, &[f64]),
        off: &[f64],
        work: &mut Work,
        found: &mut Expansion,
    ) -> Result<(), Reason> {
        let mut turned: SmallVec<[usize; 8]> = smallvec![];
        loop {
            work.expansions += 1;
            self.refuse_segments(time, states)?;
            let frozen = Frozen { signs: &self.branch_signs.signs, vanishing: &self.branch_signs.vanishing };
            let along = (frozen, &self.turnings[..]);
            expand(&self.system, &mut self.jets, self.order, along, (time, states, true), off, found)?;
            self.watch_scales(found);
            if self.enter_segments(found) {
                continue;
            }
            let Some(branch) = self.wrong_side(found, time) else { return Ok(()) };
            if turned.contains(&branch) {
                let slot = self.system.tape.guards()[branch];
                return Err(Reason::Sliding {
                    guard: self.system.tape.describe_with(slot, &self.system.names),
                });
            }
            turned.push(branch);
            self.branch_signs.signs[branch] = -self.branch_signs.signs[branch];
            self.look_again(time, states);
        }
    }

    /// Finds what is watched along a motion that stays where it is, if it may: all its rates are zero but for this part of their
    /// rounding errors; each rate is off by so much. How far that can be told: rates and what is watched may change with the time.
    pub(crate) fn rest(
        &mut self,
        (time, states): (f64, &[f64]),
        noise: &Noise,
        (part, off): (f64, &[f64]),
        found: &mut Expansion,
    ) -> Option<f64> {
        let is_still = noise.values.iter().zip(&noise.rates).all(|(rate, error)| rate.abs() <= part * error);
        if self.system.transformed || self.system.exact_degree.is_some() || !is_still {
            return None;
        }
        let frozen = Frozen { signs: &self.branch_signs.signs, vanishing: &self.branch_signs.vanishing };
        let now = (time, states, false);
        let along = (frozen, &self.turnings[..]);
        expand(&self.system, &mut self.jets, self.order, along, now, off, found).ok()?;
        if self.wrong_side(found, time).is_some() {
            return None;
        }
        let known = found.order();
        let rates = self.system.tape.outputs()[..self.system.len()].iter();
        let rates = rates.map(|slot| &self.jets.slot(*slot)[..known]);
        Some(
            rates
                .chain(self.watched_series(found))
                .fold(f64::INFINITY, |radius, series| of_own_size(series, radius)),
        )
    }

    /// How much later than `s` a guard is zero by its value, where its series misses that: the terms of a long step's series are
    /// larger than their sum, and at a modest accuracy they end early; `known` are the scales, and what rounding left out of the states.
    pub(crate) fn delay(
        &mut self,
        guard: usize,
        expansion: &Expansion,
        s: f64,
        known: (&Scales, &[f64]),
    ) -> Option<f64> {
        if let Some(lazy) = guard.checked_sub(self.system.guards) {
            return self.lazy_guards.delay(lazy, expansion, s, known);
        }
        lazy_guards::delay(&expansion.guards[guard], s, 0.0, |s| self.guard_at(guard, expansion, s))
    }

    /// Value of a guard at the states that the series come to.
    fn guard_at(&mut self, guard: usize, expansion: &Expansion, s: f64) -> f64 {
        let states: Row = expansion.states.iter().map(|series| value(series, s)).collect();
        let time = expansion.time.as_ref().map_or(expansion.start + s, |series| value(series, s));
        self.values.start(time, &states, Branches::Frozen(&self.branch_signs.signs));
        self.values.value_of(self.output_of(guard))
    }

    /// Moves to the segment ahead where an argument stands on a knot. Whether it moved at all.
    fn enter_segments(&mut self, expansion: &Expansion) -> bool {
        let tape = self.system.tape.clone();
        let mut moved = false;
        for (lookup, series) in expansion.arguments.iter().enumerate() {
            let side = &mut self.branch_signs.signs[tape.guards().len() + lookup];
            let ahead = leading_sign(&series[1..]);
            let [low, high] = tape.tables()[lookup].table.0.ends(*side as usize);
            let step = if series[0] >= high && ahead > 0.0 {
                1.0
            } else if series[0] <= low && ahead < 0.0 {
                -1.0
            } else {
                continue;
            };
            *side += step;
            moved = true;
        }
        moved
    }

    /// Refuses to go on where a table says nothing.
    fn refuse_segments(&mut self, time: f64, states: &[f64]) -> Result<(), Reason> {
        let tape = self.system.tape.clone();
        let segments = &self.branch_signs.signs[tape.guards().len()..];
        let mut lookups = tape.tables().iter().zip(segments);
        let Some((lookup, _)) = lookups.find(|(lookup, segment)| lookup.table.0.refuses(**segment as usize))
        else {
            return Ok(());
        };
        self.values.start(time, states, Branches::Free);
        let at = self.values.slot(lookup.of)[0];
        Err(Reason::OutsideTable { table: lookup.table.0.name.clone(), at })
    }

    fn watch_scales(&mut self, expansion: &Expansion) {
        let raise = |scale: &mut f64, value: f64| *scale = scale.max(value.abs());
        for (scale, turn) in self.branch_signs.turning_scales.iter_mut().zip(&expansion.turnings) {
            raise(scale, turn.length(0.0));
        }
    }

    /// A branch whose guard does not have the sign it was given.
    fn wrong_side(&self, expansion: &Expansion, time: f64) -> Option<usize> {
        let wrong = |branch: &usize| {
            let series = &expansion.branches[*branch];
            let instant = SIMULTANEOUS_PART * time.abs().max(1.0);
            let slope = series.get(1).map_or(0.0, |slope| slope.abs());
            let zero = self.branch_signs.zero_branches[*branch] || series[0].abs() <= 2.0 * instant * slope;
            let sign = match (zero, series[0]) {
                (true, _) => leading_sign(&series[1..]),
                (false, 0.0) => leading_sign(series),
                (false, value) => value.signum(),
            };
            sign * self.branch_signs.signs[*branch] < 0.0
        };
        (0..expansion.branches.len()).filter(|branch| self.branch_signs.active.branches[*branch]).find(wrong)
    }

    /// Sees what matters after a branch has changed its sign; what did not matter before takes its sign by value.
    fn look_again(&mut self, time: f64, states: &[f64]) {
        let tape = self.system.tape.clone();
        let mut active = std::mem::take(&mut self.inactive);
        tape.find_active(&self.branch_signs.signs, &mut active);
        self.values.start(time, states, Branches::Free);
        let here = self.values.signs();
        let (before, first_table) = (&self.branch_signs.active, tape.guards().len());
        let matters = active.branches.iter().chain(&active.tables);
        let mattered = before.branches.iter().chain(&before.tables);
        for (side, (now, then)) in matters.zip(mattered).enumerate() {
            let known_zero = side < first_table && self.branch_signs.zero_branches[side];
            if *now && !*then && !known_zero {
                self.branch_signs.signs[side] = here[side];
            }
        }
        self.inactive = std::mem::replace(&mut self.branch_signs.active, active);
    }

    /// How far the expansion reaches, guards included: infinite where nothing in the coefficients limits it.
    pub(crate) fn radius(&self, expansion: &Expansion, scales: &Scales) -> f64 {
        let states = expansion.states.iter().enumerate();
        let states = states.map(|(state, series)| of_series(series, scales.of(self.system.group(state))));
        let time = expansion.time.iter().map(|series| of_series(series, series[0].abs()));
        let own = states.chain(time).fold(f64::INFINITY, f64::min);
        self.watched_series(expansion).fold(own, |radius, series| of_own_size(series, radius))
    }

    /// The series of branches that matter and of guards.
    fn watched_series<'a>(&'a self, expansion: &'a Expansion) -> impl Iterator<Item = &'a [f64]> {
        let active = self.branch_signs.active.branches.iter();
        let branches =
            expansion.branches.iter().zip(active).filter(|(_, active)| **active).map(|(series, _)| series);
        branches.chain(expansion.guards.iter())
    }

    /// Name of what limits the radius: a state, an event or a formula with a branch.
    pub(crate) fn narrowest(&self, expansion: &Expansion, scales: &Scales) -> String {
        let (tape, Plan { names, guard_names, .. }) = (&self.system.tape, &*self.system);
        let states = expansion.states.iter().enumerate();
        let states = states.map(|(state, series)| {
            (of_series(series, scales.of(self.system.group(state))), names[state].clone())
        });
        let branches = expansion.branches.iter().zip(tape.guards());
        let branches = branches
            .map(|(series, slot)| (of_own_size(series, f64::INFINITY), tape.describe_with(*slot, names)));
        let guards = expansion.guards.iter().zip(guard_names);
        let guards =
            guards.map(|(series, name)| (of_own_size(series, f64::INFINITY), format!("event {name}")));
        let all = states.chain(branches).chain(guards);
        all.min_by(|a, b| a.0.total_cmp(&b.0)).map_or_else(String::new, |(_, name)| name)
    }

    /// Expands the lazily evaluated guards that a step of this length may reach, and shortens it to what their
    /// expansions can tell; `reach` is the length of an ordinary step in units of the radius.
    pub(crate) fn approach(
        &mut self,
        expansion: &mut Expansion,
        length: f64,
        (reach, compensation): (f64, &[f64]),
        work: &mut Work,
    ) -> Result<f64, Reason> {
        if self.lazy_guards.is_empty() {
            return Ok(length);
        }
        self.lazy_guards.approach(expansion, length, compensation)?;
        work.near += expansion.near.len() as u64;
        Ok(length.min(reach * lazy_guards::radius(expansion)))
    }

    /// The step's independent check; see [`Check`].
    pub(crate) fn check(
        &mut self,
        expansion: &Expansion,
        length: f64,
        demand: &Demand<'_>,
        work: &mut Work,
    ) -> Verdict {
        let Self { system, values, branch_signs, places, here, .. } = self;
        let mut check = Check { system, values, demand, signs: &branch_signs.signs, places, here };
        check.step(expansion, length, work)
    }

    /// Finds the signs that guards have where a step ends.
    pub(crate) fn look_back(&mut self, expansion: &Expansion, length: f64) {
        let BranchSigns { zero_guards, sides, .. } = &mut self.branch_signs;
        for ((side, series), zeros) in sides.iter_mut().zip(expansion.guards.iter()).zip(zero_guards.iter()) {
            if length > 0.0 || *side == 0.0 {
                *side = sign_before(ahead(series, *zeros), length);
            }
        }
        self.branch_signs.sides_are_carried &= length == 0.0;
    }

    /// Refuses a step at the end of which a guard is beyond zero that the flow holds on one side of only, and that has not ended it: one that has is
    /// zero there by its value, and by its series but for what the accuracy leaves out of that. What a jump has put beyond zero may be on its way back.
    pub(crate) fn refuse_beyond(
        &self,
        expansion: &Expansion,
        (length, hits): (f64, &Hits),
        scales: &Scales,
    ) -> Result<(), Reason> {
        for (guard, series) in expansion.guards.iter().enumerate() {
            let Limit::Kept(group) = self.system.guard_limits[guard] else { continue };
            if hits.contains(&Hit::Guard(guard)) {
                continue;
            }
            let (start, end) = (series[0], value(series, length));
            let direction = self.system.guard_directions[guard];
            let comes_back = direction.allows(start) && end.abs() <= start.abs();
            if direction.allows(end) && end.abs() > KEPT * scales.of(group) && !comes_back {
                return Err(Reason::Beyond { guard: self.system.guard_names[guard].clone() });
            }
        }
        Ok(())
    }

    /// Guards that end the flow where a step ended.
    ///
    /// Where a branch changes its sign other things matter, and a guard that holds it may jump over zero without
    /// crossing it, or turn back from zero instead of crossing it: what counts is its sign before, with the old branch
    /// signs, and after, with the new ones.
    pub(crate) fn fired(
        &mut self,
        hits: &[Hit],
        (time, states): (f64, &[f64]),
        work: &mut Work,
    ) -> Result<Vec<usize>, Reason> {
        let crossed = |hit: &Hit| if let Hit::Guard(guard) = hit { Some(*guard) } else { None };
        let crossed: Vec<usize> = hits.iter().filter_map(crossed).collect();
        if !hits.iter().any(|hit| matches!(hit, Hit::Branch(..) | Hit::Knot(..))) {
            return Ok(crossed);
        }
        self.look_again(time, states);
        let lazy_guards = crossed.iter().copied().filter(|guard| *guard >= self.system.guards);
        let lazy_guards: Vec<usize> = lazy_guards.collect();
        if self.system.guards == 0 {
            return Ok(lazy_guards);
        }
        let mut ahead = Expansion::default();
        match self.expand((time, states), &[], work, &mut ahead) {
            // There is no motion on either side of the branch: what crosses zero then can still end the flow.
            Err(Reason::Sliding { .. }) if !crossed.is_empty() => return Ok(crossed),
            other => other?,
        }
        let crosses = |guard: &usize| {
            let after = sign_after(&ahead.guards[*guard]);
            let before = self.branch_signs.sides[*guard];
            let is_limit = self.system.guard_limits[*guard].may_end();
            let passes = before * after < 0.0 || (is_limit && before == 0.0 && after != 0.0);
            passes && self.system.guard_directions[*guard].allows(after)
        };
        let fired: Vec<usize> = (0..ahead.guards.len()).filter(crosses).collect();
        for guard in &fired {
            self.branch_signs.zero_guards[*guard] = 1;
        }
        Ok(fired.into_iter().chain(lazy_guards).collect())
    }
}

/// The series without its first coefficients that are zero now: its roots are those ahead.
pub(crate) fn ahead(series: &[f64], zeros: usize) -> &[f64] {
    let series = series.get(zeros..).unwrap_or_default();
    let first = series.iter().position(|c| *c != 0.0).unwrap_or(series.len());
    &series[first..]
}
