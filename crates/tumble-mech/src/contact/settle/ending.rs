//! Impacts that end by themselves, too low to be followed: who takes part, and how long they go on.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};

use super::{Settling, Touched};
use crate::contact::grip::Grip;
use crate::contact::sticking::{Patch, Pushes};
use crate::contact::touch::Touch;
use crate::contact::zeno::{LOWEST, ZenoSequence, alone, falls, flight, is_low};
use crate::coordinates::Measure;

/// Impacts end by themselves if no other contact of the body comes within this many times the time they take.
const UNDISTURBED: f64 = 8.0;
/// Friction of that time is done at once, which takes as much speed as closes a gap in twice the time.
const AT_ONCE: f64 = 2.0;

/// Impacts that end by themselves, too low to be followed.
pub(super) struct Ending {
    /// Who takes part, by position.
    pub(super) members: Vec<usize>,
    /// Time until they have ended, s.
    pub(super) time: f64,
    pub(super) slow: Slow,
}

/// What some contacts come to when they bounce no more.
struct Pressed {
    /// Accelerations along their normals by unit forces, 1/kg, and without forces, m/s^2.
    response: DMatrix<f64>,
    free: DVector<f64>,
    /// Their forces, N.
    pushes: DVector<f64>,
    /// Accelerations of all gaps and slips with these, m/s^2.
    then: DVector<f64>,
}

/// Slips that end before they are anything.
#[derive(Default)]
pub(super) struct Slow {
    /// Pairs that slip so.
    pub(super) pairs: BTreeSet<usize>,
    /// Time until the last of them has ended, s.
    pub(super) time: f64,
}

impl Settling<'_> {
    /// Time until the bounces that are left have ended, where they are too low to be followed; with who takes part.
    pub(super) fn zeno(&self) -> Option<Ending> {
        if self.impulses.amax() == 0.0 {
            return None;
        }
        let size = self.touch.size;
        let size = if size > 0.0 { size } else { self.now.scales[Measure::Length as usize] };
        // What is lower than the rounding of its gap, which is large far from the origin, never ends by itself.
        let blur = self.part.iter().map(|position| self.touch.blur[*position]).fold(0.0, f64::max);
        let lowest = blur.max(LOWEST * size);
        let may_end = |position: &usize| {
            let rigid = self.equations.pairs()[self.touch.pairs[*position]].is_rigid();
            let is_there = rigid && !self.beyond.contains(position);
            is_there && (self.part.contains(position) || self.touch.gap[*position] <= lowest)
        };
        let stands = |position: usize| self.stands(position) && self.part.contains(&position);
        // What closes now has no gap but for rounding, which late in a Zeno sequence is as large as the bounces.
        let touches = |position: usize| {
            self.part.contains(&position) && self.touch.gap[position].abs() <= self.touch.blur[position]
        };
        let Touch { gap, rate, .. } = &self.touch;
        let gap = DVector::from_fn(gap.len(), |i, _| if stands(i) || touches(i) { 0.0 } else { gap[i] });
        let rate = DVector::from_fn(rate.len(), |i, _| if stands(i) { 0.0 } else { rate[i] });
        let low: Vec<usize> = (0..self.touch.pairs.len()).filter(may_end).collect();
        let ends = |slow: Slow| self.ends(low.clone(), [&gap, &rate], lowest, slow);
        let as_they_slip = ends(Slow::default());
        // What slips and will not go as far as a bounce is high sticks; until it does it may let others fall that it holds then.
        let slow = self.slow(&low, lowest);
        let as_they_stick = if slow.pairs.is_empty() { None } else { ends(slow) };
        let count = |ending: &Option<Ending>| ending.as_ref().map_or(0, |ending| ending.members.len());
        if count(&as_they_stick) > count(&as_they_slip) { as_they_stick } else { as_they_slip }
    }

    /// How bounces end, of some contacts, with slips that are taken to have stopped; `None` if they do not.
    fn ends(
        &self,
        low: Vec<usize>,
        [gap, rate]: [&DVector<f64>; 2],
        lowest: f64,
        slow: Slow,
    ) -> Option<Ending> {
        let (members, Pressed { response, free, then, pushes }) =
            self.ending(low, [gap, rate], lowest, &slow.pairs)?;
        let zeno = ZenoSequence {
            rule: self.equations.model().multiple_impacts,
            response: &response,
            restitution: &self.some(&members, &self.touch.restitution),
            free: &free,
            lowest,
            resolution: f64::EPSILON * self.now.time.abs(),
        };
        let time = zeno.remaining(&self.some(&members, gap), &self.some(&members, rate), &pushes)?;
        (AT_ONCE * time <= self.next_without(&members, &then)).then_some(Ending { members, time, slow })
    }

    /// Of some contacts those that stand, and those whose bounces are too low to be followed and end before another contact comes: what
    /// moves and is not pressed parts.
    fn ending(
        &self,
        mut some: Vec<usize>,
        [gap, rate]: [&DVector<f64>; 2],
        lowest: f64,
        slow: &BTreeSet<usize>,
    ) -> Option<(Vec<usize>, Pressed)> {
        loop {
            let pressed = self.pressed_by(&some, slow)?;
            let falls = falls(&pressed.response, &pressed.free, &pressed.pushes);
            let next = self.next_without(&some, &pressed.then);
            let ends = |(index, position): &(usize, &usize)| {
                let (gap, rate) = (gap[**position], rate[**position]);
                let (a, e) = (falls[*index], self.touch.restitution[**position]);
                let stands = gap == 0.0 && rate == 0.0;
                // What rounding alone presses would take for ever.
                let is_low = a > self.zero() && is_low(gap, rate, a, lowest);
                stands || (is_low && UNDISTURBED * alone(gap, rate, a, e) <= next)
            };
            let left: Vec<usize> =
                some.iter().enumerate().filter(ends).map(|(_, position)| *position).collect();
            if left.len() == some.len() {
                return Some((left, pressed));
            }
            some = left;
        }
    }

    /// How some contacts press in the end, with the friction of those that slip now, but for the slow ones, and with the others stuck.
    fn pressed_by(&self, some: &[usize], slow: &BTreeSet<usize>) -> Option<Pressed> {
        let patches = self.patches(some, false);
        let stopped = Touched { stopped: slow.clone(), ..Touched::default() };
        let grip = |patch: &Patch| self.slips_now(patch, &stopped).map_or(Grip::Sticks, Grip::Slides);
        let grips: Vec<Grip> = patches.iter().map(grip).collect();
        let of = |patches: &[Patch], grips: &[Grip]| {
            let rough = self.rough(some, patches, self.accelerations());
            let reduced = rough.reduced(grips)?;
            let (response, free) = (reduced.matrix.clone(), reduced.without.clone());
            let Pushes { pushes, then, .. } = rough.solved(grips, reduced)?;
            Some(Pressed { response, free, pushes: self.some(some, &pushes), then })
        };
        of(&patches, &grips).or_else(|| of(&[], &[]))
    }

    /// Time until the first of all contacts but some closes, as they move now or, where that is sooner, with the forces of those, s.
    fn next_without(&self, some: &[usize], then: &DVector<f64>) -> f64 {
        let Touch { gap, rate, free, .. } = &self.touch;
        let is_other = |position: &usize| !some.contains(position) && !self.beyond.contains(position);
        let others = (0..self.touch.pairs.len()).filter(is_other);
        let closes = |position: usize| {
            let closes = |a: f64| flight(gap[position].max(0.0), rate[position], a);
            closes(free[position]).min(closes(then[position]))
        };
        others.map(closes).fold(f64::INFINITY, f64::min)
    }

    /// Slips of some contacts that friction stops before they go as far as a bounce is high.
    fn slow(&self, some: &[usize], lowest: f64) -> Slow {
        let slips = &self.touch.slips;
        let mut slow = Slow::default();
        for slip in (0..slips.of.len()).filter(|slip| some.contains(&slips.of[*slip]) && !slips.rolls[*slip])
        {
            let (rate, stopping) = (slips.rate[slip].abs(), slips.friction[slip][1] * self.touch.strength);
            let moves = rate > self.still(slip);
            if moves && rate * rate <= 2.0 * stopping * lowest {
                slow.pairs.insert(slips.pairs[slip]);
                slow.time = slow.time.max(rate / stopping);
            }
        }
        slow
    }
}
