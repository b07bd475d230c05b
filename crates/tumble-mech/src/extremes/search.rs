//! The extremes of one formula in one piece, by branch and bound.
//!
//! A piece, or a part of it, whose range cannot be better than the best value so far is done with. Where the slope keeps its
//! sign the ends count; where the formula bends to one side only, its turn and the ends. Any other part is halved, and so is
//! one in which a branch of the formula may change its sign, down to [`SHORTEST`] of the piece: what is left is at a kink or
//! a jump of the formula, and both its ends count.
//!
//! Source: Horst and Tuy, Global Optimization; Hansen and Walster, Global Optimization Using Interval Analysis.

use tumble_expr::{Branches, Interval, Stage};
use tumble_ode::{Bounds, MotionState, Path, Piece, Side};

use super::{Begun, Best, Candidate, Evaluator};
use crate::evaluator::{evaluate, evaluate_in};

/// Where rounding is measured, in parts of a piece.
const PLACES: [f64; 5] = [0.125, 0.25, 0.5, 0.618, 0.8];
/// What rounding makes of any bound, relative to the best value: some times what enclosures widen by; ...
const ROUNDING: f64 = 512.0 * f64::EPSILON;
/// ... or, where it is a small difference of large ones, to what it changes by when the states change by one ulp; ...
const CANCELLATION: f64 = 64.0;
/// ... or the square root of the least number: what squares of zero are rounded up to.
const UNDERFLOW: f64 = 1e-150;
/// Shorter parts of a piece are not halved any more.
const SHORTEST: f64 = 1e-13;
/// A piece is cut into no more parts: one kink takes some fifty, one turn some ten.
const MOST_PARTS: usize = 100_000;
/// A guard that is beyond zero by this part of its range only is so by rounding.
const NEAR_ZERO: f64 = 1e-13;
/// Newton's steps to a turn, or halvings where they fail; both end earlier where nothing changes any more.
const TURN_STEPS: usize = 60;

/// One piece of the motion.
pub(super) struct Search<'a> {
    pub(super) piece: &'a Piece,
    index: usize,
    evaluator: &'a mut Evaluator,
    pub(super) best: &'a mut Best,
    /// What a rounding error of the states changes the value by.
    noise: f64,
}

/// A part of the piece, and what its ends have to offer.
#[derive(Clone, Copy)]
struct Part {
    ends: [f64; 2],
    gains: [f64; 2],
}

impl<'a> Search<'a> {
    pub(super) fn new(
        piece: &'a Piece,
        index: usize,
        evaluator: &'a mut Evaluator,
        best: &'a mut Best,
    ) -> Self {
        Self { piece, index, evaluator, best, noise: 0.0 }
    }

    /// Offers two instants, and says what they have.
    pub(super) fn gains(&mut self, ends: [f64; 2]) -> [f64; 2] {
        ends.map(|s| self.offer(s))
    }

    /// All between two values of the parameter; the value at which there are too many parts is an error.
    ///
    /// All parts of one size come before smaller ones, so that good values are known early.
    pub(super) fn whole(&mut self, begun: &Begun) -> Result<(), f64> {
        let Begun { ends, gains, most, .. } = *begun;
        if !self.best.may_yield_to(most, self.time(ends[0])) {
            return Ok(());
        }
        let mut level = vec![Part { ends, gains }];
        let mut looked = 0;
        let mut is_first = true;
        while !level.is_empty() {
            let mut next = vec![];
            for part in level {
                looked += 1;
                if looked > MOST_PARTS {
                    return Err(part.ends[0]);
                }
                if !self.is_settled(&part) {
                    if std::mem::take(&mut is_first) {
                        self.find_noise(ends);
                    }
                    next.extend(self.halves(part));
                }
            }
            level = next;
        }
        Ok(())
    }

    /// What nothing from the start of the piece up to `s` has more of, by the ranges of the states alone: most pieces are far from
    /// the best value.
    pub(super) fn at_most(&mut self, s: f64) -> f64 {
        let Evaluator { ranges, state_ranges, .. } = &mut *self.evaluator;
        state_ranges.clear();
        let time = self.piece.ranges_into(s, state_ranges);
        ranges.start(time, state_ranges, Branches::Free);
        let most = ranges.value_of(0);
        self.most(most)
    }

    fn halves(&mut self, Part { ends: [low, high], gains: [first, last] }: Part) -> [Part; 2] {
        let middle = 0.5 * (low + high);
        let gain = self.offer(middle);
        [
            Part { ends: [low, middle], gains: [first, gain] },
            Part { ends: [middle, high], gains: [gain, last] },
        ]
    }

    /// Whether nothing better is in a part than what was offered.
    fn is_settled(&mut self, part: &Part) -> bool {
        let [low, high] = part.ends;
        if high - low <= SHORTEST * self.piece.length {
            return true;
        }
        let path = self.path();
        self.evaluator.enclosure.survey(path, part.ends);
        let most = self.most(self.evaluator.enclosure.value(0));
        if !self.promises(most, part) {
            return true;
        }
        let kept = self.evaluator.enclosure.kept_signs();
        let signs = match &kept {
            Some(signs) => signs.clone(),
            None => self.evaluator.enclosure.signs(path, part.ends),
        };
        self.evaluator.enclosure.look(path, part.ends, &signs, None);
        if kept.is_none() && !self.keeps(&signs) {
            return self.is_flat(most, part);
        }
        self.is_settled_by_slopes(part)
    }

    /// The same where all branches keep their signs.
    fn is_settled_by_slopes(&mut self, part: &Part) -> bool {
        let bounds = self.evaluator.enclosure.output(0);
        let most = self.most(bounds.range(0));
        let (slope, bend) = (bounds.range(1).definite_sign(), bounds.range(2).definite_sign());
        if slope != 0.0 || !self.promises(most, part) {
            return true;
        }
        if bend == 0.0 {
            return self.is_flat(most, part);
        }
        // What bends the other way is least between its ends.
        if bend * self.best.sign < 0.0 {
            let [low, high] = part.ends;
            let near = 0.5 * ((low + high) + bounds.turn() * (high - low));
            let turn = self.turn(near, part.ends, bend);
            self.offer(turn);
        }
        true
    }

    /// Whether branches and tables keep their signs and segments over the part that was looked at.
    fn keeps(&self, signs: &[f64]) -> bool {
        let enclosure = &self.evaluator.enclosure;
        let tape = enclosure.tape();
        let is_fixed = |slot| tape.stage(slot) != Stage::Varying;
        let (branches, segments) = signs.split_at(tape.guards().len());
        let mut guards = tape.guards().iter().zip(branches);
        let mut tables = tape.tables().iter().zip(segments);
        guards.all(|(slot, sign)| is_fixed(*slot) || is_of_sign(enclosure.of(*slot), *sign))
            && tables.all(|(lookup, segment)| {
                let [low, high] = lookup.table.0.ends(*segment as usize);
                let argument = enclosure.of(lookup.of);
                let is_above = !low.is_finite() || is_of_sign(argument.less(low), 1.0);
                let is_below = !high.is_finite() || is_of_sign(argument.less(high), -1.0);
                is_fixed(lookup.of) || (is_above && is_below)
            })
    }

    /// The most that a range has to offer.
    fn most(&self, range: Interval) -> f64 {
        if self.best.sign > 0.0 { range.high } else { -range.low }
    }

    fn promises(&self, most: f64, part: &Part) -> bool {
        self.best.may_yield_to(most, self.time(part.ends[0]))
    }

    /// Whether a part is better than its own ends, or a later one than the best value, by rounding only.
    fn is_flat(&self, most: f64, part: &Part) -> bool {
        let own = part.gains[0].max(part.gains[1]);
        let time = self.time(part.ends[0]);
        let best = self.best.found.filter(|best| best.time <= time).map_or(own, |best| best.gain.max(own));
        most - best <= ROUNDING * best.abs() + CANCELLATION * self.noise + UNDERFLOW
    }

    fn offer(&mut self, s: f64) -> f64 {
        let (time, gain) = (self.time(s), self.best.sign * self.value(s));
        // In a transformed time what is before the end of the piece may be at it but for rounding: after it another piece follows.
        let side = if time < self.piece.end { Side::After } else { Side::Before };
        self.best.offer(Candidate { piece: self.index, s, time, side, gain });
        gain
    }

    fn value(&mut self, s: f64) -> f64 {
        let time = self.time(s);
        let Evaluator { jets, states, .. } = &mut *self.evaluator;
        states.clear();
        self.piece.states_into(s, states);
        evaluate_in(jets, Some(self.piece), time, states);
        jets.value_of(0)
    }

    /// The value where every other state is off by one part of itself, and those between them by another.
    fn value_with(&mut self, s: f64, off: [f64; 2]) -> f64 {
        let mut states = self.piece.states_at_parameter(s);
        states.iter_mut().zip(off.iter().cycle()).for_each(|(state, off)| *state *= 1.0 + off);
        let jets = &mut self.evaluator.jets;
        jets.start(self.piece.time_at(s) * (1.0 + off[0]), &states, Branches::Free);
        jets.value_of(0)
    }

    /// The middle one of several places: at a jump or a corner a rounding error changes more.
    fn find_noise(&mut self, [low, high]: [f64; 2]) {
        let change = |place: &f64| {
            let s = low + place * (high - low);
            let value = self.value(s);
            let off = [[1.0, -1.0], [1.0, 1.0]].map(|off| off.map(|off| off * f64::EPSILON));
            off.map(|off| (self.value_with(s, off) - value).abs()).into_iter().fold(0.0, f64::max)
        };
        let mut changes: Vec<f64> = PLACES.iter().map(change).filter(|change| change.is_finite()).collect();
        changes.sort_by(f64::total_cmp);
        self.noise = changes.get(changes.len() / 2).copied().unwrap_or(0.0);
    }

    /// First and second derivative with respect to the parameter.
    pub(super) fn slopes(&mut self, s: f64) -> [f64; 2] {
        let (states, time) = self.piece.series_at(s);
        let place = self.place(s);
        let jets = &mut self.evaluator.jets;
        evaluate(jets, &place);
        for k in 1..=super::ORDER {
            for (leaf, series) in states.iter().map(Vec::as_slice).chain([&time[..]]).enumerate() {
                jets.set(leaf, k, series.get(k).copied().unwrap_or(0.0));
            }
            jets.extend(k);
        }
        let series = jets.output(0);
        [series[1], 2.0 * series[2]]
    }

    /// Where the slope of what bends to that side is zero, or the end next to it: Newton's method inside a bracket.
    fn turn(&mut self, near: f64, [mut low, mut high]: [f64; 2], bend: f64) -> f64 {
        let mut s = near.clamp(low, high);
        for _ in 0..TURN_STEPS {
            let [slope, change] = self.slopes(s);
            if slope * bend > 0.0 {
                high = s;
            } else {
                low = s;
            }
            let newton = s - slope / change;
            // Half a unit in the last place beyond the bracket is the bracket's own end.
            let next = if low <= newton && newton <= high { newton } else { 0.5 * (low + high) };
            if next == s || slope == 0.0 {
                break;
            }
            s = next;
        }
        s
    }

    fn path(&self) -> Path<'a> {
        let Piece { start, states, time_series, .. } = self.piece;
        Path { start: *start, states, time: time_series.as_deref() }
    }

    /// The time at the parameter's end may miss the piece's by a rounding error.
    fn time(&self, s: f64) -> f64 {
        if s < self.piece.length { self.piece.time_at(s).min(self.piece.end) } else { self.piece.end }
    }

    fn place(&self, s: f64) -> MotionState<'a> {
        let states = self.piece.states_at_parameter(s);
        MotionState { mode: self.piece.mode, time: self.time(s), states, piece: Some(self.piece) }
    }
}

/// Whether a function has that sign, but for rounding where it comes to zero at an end.
fn is_of_sign(bounds: Bounds<'_>, sign: f64) -> bool {
    let range = bounds.range(0);
    let range = match bounds.range(1).definite_sign() {
        0.0 => range,
        _ => bounds.at(-1.0).hull(bounds.at(1.0)).both(range),
    };
    let Interval { low, high } = if sign < 0.0 { -range } else { range };
    high.is_finite() && low >= -NEAR_ZERO * high
}
