//! What ends a step: the first zero of what is watched along it.

use smallvec::{SmallVec, smallvec};
use tumble_expr::{Branches, Row};

use super::beyond::Passing;
use super::{BranchSigns, Engine, SIMULTANEOUS_PART, ahead};
use crate::Cause;
use crate::compiled::Limit;
use crate::expansion::{Expansion, Turn};
use crate::hybrid::Direction;
use crate::polynomial;
use crate::roots::roots;
use crate::scale::Scales;
use crate::signs::{leading_sign, sign_after};

/// A length that turns slower than this many steps has its singularity far enough for the coefficients to show it.
const CLOSE_TURN_STEPS: f64 = 4.0;
/// What moves by less than this part of the scale does not move.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A value that is more than this part of what it is made of, where a mode begins, has jumped there and not come to zero.
const JUMPED: f64 = 1e-10;
/// What a jump takes away from zero was this part of it before, or less: rounding.
const CARRIED: f64 = 1e-12;

/// Something that ends a step before its length does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Hit {
    /// A branch of the tape changes to this sign.
    Branch(usize, f64),
    /// A length, root or power has its least value.
    Turning(usize),
    /// The argument of a table passes a knot into this segment.
    Knot(usize, usize),
    /// A guard of the model, or after them a lazily evaluated guard, crosses zero.
    Guard(usize),
}

/// What ends a step at one instant.
pub(crate) type Hits = SmallVec<[Hit; 2]>;

/// Whether a guard is zero where a step begins, between the end of the last step and here.
enum Passage {
    /// As far as is known it is not, or it was counted.
    None,
    /// It crosses there.
    Now,
    /// It is beyond zero by rounding alone, and comes back.
    OfRounding,
}

impl Engine {
    /// What happens first within a length of the parameter, and when; all that happens at that instant.
    pub(crate) fn first_hits(
        &self,
        expansion: &Expansion,
        length: f64,
        scales: &Scales,
    ) -> Option<(f64, Hits)> {
        let mut hits = self.hits(expansion, length, scales);
        hits.sort_by(|a, b| a.0.total_cmp(&b.0));
        let first = hits.first()?.0;
        let instant = first + SIMULTANEOUS_PART * length.max(expansion.start.abs());
        let same = hits.into_iter().take_while(|(at, _)| *at <= instant);
        Some((first, same.map(|(_, hit)| hit).collect()))
    }

    fn hits(&self, expansion: &Expansion, length: f64, scales: &Scales) -> SmallVec<[(f64, Hit); 4]> {
        let crossings = |series: &[f64], zeros: usize| {
            roots(ahead(series, zeros), length)
                .into_iter()
                .filter_map(|root| Some((root.at, root.crosses_to?)))
        };
        let mut hits = smallvec![];
        let active = &self.branch_signs.active;
        for (branch, series) in
            expansion.branches.iter().enumerate().filter(|(branch, _)| active.branches[*branch])
        {
            let found = crossings(series, usize::from(self.branch_signs.zero_branches[branch]));
            hits.extend(found.take(1).map(|(at, to)| (at, Hit::Branch(branch, to))));
        }
        for (turning, turn) in
            expansion.turnings.iter().enumerate().filter(|(turning, _)| active.turnings[*turning])
        {
            let slope = polynomial::derivative(&turn.square);
            let least = crossings(&slope, usize::from(self.branch_signs.zero_turnings[turning]))
                .filter(|(_, to)| *to > 0.0);
            let close = least.filter(|(at, _)| is_close_turn(turn, &slope, *at, length)).take(1);
            hits.extend(close.map(|(at, _)| (at, Hit::Turning(turning))));
        }
        let branches = expansion.branches.len();
        for (lookup, series) in
            expansion.arguments.iter().enumerate().filter(|(lookup, _)| active.tables[*lookup])
        {
            let segment = self.branch_signs.signs[branches + lookup] as usize;
            let ends = self.system.tape.tables()[lookup].table.0.ends(segment);
            for (knot, direction) in ends.into_iter().zip([-1.0, 1.0]).filter(|(knot, _)| knot.is_finite()) {
                let mut distance = Row::from_slice(series);
                distance[0] -= knot;
                let beyond = if direction > 0.0 { segment + 1 } else { segment.saturating_sub(1) };
                let outward =
                    crossings(&distance, usize::from(distance[0] == 0.0)).filter(|(_, to)| *to == direction);
                hits.extend(outward.take(1).map(|(at, _)| (at, Hit::Knot(lookup, beyond))));
            }
        }
        for (guard, series) in expansion.guards.iter().enumerate() {
            let (direction, zeros) =
                (self.system.guard_directions[guard], self.branch_signs.zero_guards[guard]);
            if let Limit::IfBeyond(group) | Limit::Kept(group) = self.system.guard_limits[guard] {
                let passing = Passing { series, conditions: &[], direction, zeros, length };
                hits.extend(passing.first(scales.of(group)).map(|at| (at, Hit::Guard(guard))));
                continue;
            }
            if self.is_limit(guard, series, (expansion, length), scales) {
                hits.push((0.0, Hit::Guard(guard)));
                continue;
            }
            let zeros = match self.passage(guard, series) {
                Passage::None => zeros,
                Passage::Now => {
                    hits.push((0.0, Hit::Guard(guard)));
                    continue;
                }
                Passage::OfRounding => 1,
            };
            // What is zero now does not cross again at the same instant: that is rounding of a turn.
            let now = if zeros > 0 { SIMULTANEOUS_PART * length.max(expansion.start.abs()) } else { 0.0 };
            let found = crossings(series, zeros).filter(|(at, to)| *at > now && direction.allows(*to));
            hits.extend(found.take(1).map(|(at, _)| (at, Hit::Guard(guard))));
        }
        for near in &expansion.near {
            let (guard, series) = (self.system.guards + near.index, &near.series);
            let direction = self.system.guard_directions[guard];
            let zeros = self.branch_signs.zero_guards[guard];
            if let Limit::IfBeyond(group) = self.system.guard_limits[guard] {
                let passing = Passing { series, conditions: &near.conditions, direction, zeros, length };
                hits.extend(passing.first(scales.of(group)).map(|at| (at, Hit::Guard(guard))));
                continue;
            }
            if self.is_limit(guard, series, (expansion, length), scales) {
                hits.push((0.0, Hit::Guard(guard)));
                continue;
            }
            let first = |zeros: usize| {
                let mut found = crossings(series, zeros).filter(|(_, to)| direction.allows(*to));
                found.next().map_or(f64::INFINITY, |(at, _)| at)
            };
            // A simple zero that is being left has its sign ahead; what it is short of zero delays the next crossing.
            // Where rounding has left it beyond zero, so far that the arc ahead does not come back from there, the arc
            // is taken from zero.
            let at = match zeros {
                0 | 1 if direction.allows(series[0]) => first(0).min(first(1)),
                0 | 1 => first(0),
                _ => first(zeros),
            };
            hits.extend(at.is_finite().then_some((at, Hit::Guard(guard))));
        }
        hits
    }

    /// Values of guards that causes are, by name, lazily evaluated ones left out.
    pub(crate) fn crossed_values(
        &mut self,
        causes: &[Cause],
        (time, states): (f64, &[f64]),
    ) -> Vec<(String, f64)> {
        let crossed = causes.iter().filter_map(|cause| match cause {
            Cause::Guard(guard) => Some(*guard),
            _ => None,
        });
        let crossed: Vec<usize> = crossed.collect();
        if crossed.is_empty() {
            return vec![];
        }
        self.values.start(time, states, Branches::Free);
        let named = |guard: usize| {
            (self.system.guard_names[guard].clone(), self.values.value_of(self.output_of(guard)))
        };
        crossed.into_iter().map(named).collect()
    }

    /// A jump may take a guard that has made it away from zero: it is then zero no more, and may cross again.
    pub(crate) fn carry_away(&mut self, before: &[(String, f64)], (time, states): (f64, &[f64])) {
        for (name, before) in before {
            let named = self.system.guard_names[..self.system.guards].iter().position(|known| known == name);
            let Some(guard) = named else { continue };
            self.noise(time, states, &vec![0.0; states.len()]);
            let slot = self.system.tape.outputs()[self.output_of(guard)];
            let (after, size) = (self.rounded.value_of(self.output_of(guard)).value, self.size_of(slot));
            if before.abs() <= CARRIED * after.abs() && after.abs() > JUMPED * size {
                self.branch_signs.zero_guards[guard] = 0;
            }
        }
    }

    /// Index of a guard among the outputs of the tape.
    pub(super) fn output_of(&self, guard: usize) -> usize {
        self.system.len() + usize::from(self.system.transformed) + guard
    }

    /// Whether a guard has passed zero between the end of the last step and here, where rounding has moved it by as much as was left.
    fn passage(&self, guard: usize, series: &[f64]) -> Passage {
        let BranchSigns { sides, zero_guards, .. } = &self.branch_signs;
        let side = sides[guard];
        let is_limit = self.system.guard_limits[guard].may_end();
        if is_limit || side == 0.0 || zero_guards[guard] > 0 || series[0] * side > 0.0 {
            return Passage::None;
        }
        // Where it may have jumped, only what is zero has passed it; a jump across zero is the model's to tell.
        let slot = self.system.tape.outputs()[self.output_of(guard)];
        if self.branch_signs.sides_are_carried && series[0].abs() > JUMPED * self.size_of(slot) {
            return Passage::None;
        }
        let sign = sign_after(series);
        match (sign * side < 0.0, sign * side > 0.0) {
            (true, _) if self.system.guard_directions[guard].allows(sign) => Passage::Now,
            (_, true) => Passage::OfRounding,
            _ => Passage::None,
        }
    }

    /// Whether a guard that is found beyond zero, or at zero and about to cross, ends the flow at the start of a step.
    fn is_limit(
        &self,
        guard: usize,
        series: &[f64],
        (expansion, length): (&Expansion, f64),
        scales: &Scales,
    ) -> bool {
        let (direction, zeros) = (self.system.guard_directions[guard], self.branch_signs.zero_guards[guard]);
        match self.system.guard_limits[guard] {
            Limit::None | Limit::Kept(_) | Limit::IfBeyond(_) => false,
            Limit::Always => is_overdue(series, zeros, direction),
            Limit::IfItMoves { again, .. } => {
                let is_beyond = zeros == 0 && direction.allows(series[0]);
                // What is beyond zero and comes back moves something until then only.
                let back = if is_beyond { roots(series, length).first().map(|root| root.at) } else { None };
                let until = back.unwrap_or(length);
                let most = [0.0, 0.5 * until, until].map(|s| polynomial::value(series, s).abs());
                let push = if back.is_some() { most[0].max(most[1]) } else { most[2] };
                let moves = push > self.moves_nothing(guard, (expansion, until), scales);
                // What has just been zero ends it again where it goes on beyond zero: the jump has not dealt with it.
                let goes_beyond = again && zeros > 0 && direction.allows(leading_sign(ahead(series, zeros)));
                (is_beyond || goes_beyond || is_overdue(series, zeros, direction)) && moves
            }
        }
    }

    /// What a guard may be without moving anything along a step of that length; zero where its sign is all that counts.
    pub(crate) fn moves_nothing(
        &self,
        guard: usize,
        (expansion, length): (&Expansion, f64),
        scales: &Scales,
    ) -> f64 {
        let Limit::IfItMoves { response, group, .. } = self.system.guard_limits[guard] else { return 0.0 };
        let time = expansion.time.as_ref();
        let elapsed = time.map_or(length, |series| polynomial::increment(series, length));
        let rounding = ROUNDING * scales.of(group);
        if rounding > 0.0 { rounding / (response * elapsed * elapsed) } else { 0.0 }
    }
}

/// Whether a guard that should be on one side is found on, or beyond, zero and goes on beyond: it crosses now, or
/// rounding has hidden that it did.
fn is_overdue(series: &[f64], zeros: usize, direction: Direction) -> bool {
    let beyond = leading_sign(&series[1..]);
    zeros == 0 && direction != Direction::Both && direction.allows(beyond) && series[0] * beyond >= 0.0
}

/// Whether a square turns so sharply at its least value that a step would not see it in its coefficients.
///
/// Near the turn the square is `least + curvature s^2`, with zeros at a distance `sqrt(least / curvature)` off the real
/// line.
fn is_close_turn(turn: &Turn, slope: &[f64], at: f64, length: f64) -> bool {
    let least = turn.length(at);
    let curvature = 0.5 * polynomial::slope(slope, at);
    least * least < curvature * (CLOSE_TURN_STEPS * length) * (CLOSE_TURN_STEPS * length)
}
