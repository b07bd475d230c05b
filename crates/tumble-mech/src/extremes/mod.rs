//! When a quantity is greatest or least along a motion.
//!
//! Within a piece the states are polynomials, so that any formula of them can be bounded over a part of the piece
//! ([`tumble_ode::Enclosure`]). The search is a branch and bound: see `search`. Pieces end at events, so that both sides of
//! every jump of the motion count. Pieces with the best values at their ends come first, because a part that cannot be better
//! than the best value so far is not looked into.
//!
//! A quantity that has kinks, or no value, at many thousand instants of one piece is refused. `tests/extremes.rs` checks all
//! this against closed forms.

mod search;

use tumble_expr::{Expr, Interval, Jets};
use tumble_ode::{Enclosure, Piece, Reason, Side};

use crate::run::{Run, RunError};
use search::Search;

/// A later value has to be larger by this part to be another.
const SAME: f64 = 8.0 * f64::EPSILON;
/// A value that is smaller by this part is smaller by more than all that rounding adds up to.
const FAR: f64 = 1e-9;
/// Taylor coefficients up to here: of value, slope and bend.
const ORDER: usize = 2;
/// An instant is that of a turn if the slope and the bend there put the turn no farther away, in parts of the piece.
const AT_TURN: f64 = 1e-6;

/// Which extreme is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The greatest value.
    Greatest,
    /// The least value.
    Least,
}

impl Extreme {
    /// What is to be as large as possible, +1 or -1 times the quantity.
    fn sign(self) -> f64 {
        match self {
            Self::Greatest => 1.0,
            Self::Least => -1.0,
        }
    }
}

/// An extreme that was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// When, s; the first time, if there are several.
    pub time: f64,
    /// Of an event at that time, the side that it is on.
    pub side: Side,
    /// The value, SI units.
    pub value: f64,
    /// What makes it an extreme.
    pub kind: PeakKind,
}

/// What makes an instant that of an extreme. It says how far an error of the quantity moves the time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PeakKind {
    /// The slope is zero there: an error e of the slope moves the time by `e / bend`.
    Turn {
        /// Second derivative with respect to time, SI units.
        bend: f64,
    },
    /// The first or last instant that was looked at: its time has no error of its own.
    Edge,
    /// The quantity or its slope jumps there, by an event or by a branch of a formula: the time is that of the jump.
    Kink,
}

impl Run {
    /// The greatest or least value of a formula of the motion between two times, s.
    ///
    /// `None` where nothing of the motion is between them, or where the formula has no finite value there.
    pub fn extreme(
        &self,
        formula: &Expr,
        which: Extreme,
        [from, to]: [f64; 2],
    ) -> Result<Option<Peak>, RunError> {
        self.along(std::slice::from_ref(formula)).peak(formula, which, [from, to])
    }

    /// The same along one motion.
    fn peak(&self, formula: &Expr, which: Extreme, [from, to]: [f64; 2]) -> Result<Option<Peak>, RunError> {
        let mut evaluators: Vec<Option<Evaluator>> = vec![];
        evaluators.resize_with(self.trajectory().modes.len(), || None);
        let mut best = Best { sign: which.sign(), found: None };
        let mut order = vec![];
        for (index, piece) in self.trajectory().pieces.iter().enumerate() {
            if piece.end < from || piece.start > to {
                continue;
            }
            let [low, high] = [from, to].map(|time| piece.parameter_at(time.clamp(piece.start, piece.end)));
            let evaluator = self.evaluator_in(&mut evaluators, piece.mode, formula)?;
            let mut search = Search::new(piece, index, evaluator, &mut best);
            let most = search.at_most(high);
            if search.best.is_far_above(most) {
                continue;
            }
            let gains = search.gains([low, high]);
            order.push(Begun { index, ends: [low, high], gains, most });
        }
        let larger = |begun: &Begun| begun.gains[0].max(begun.gains[1]);
        order.sort_by(|a, b| larger(b).total_cmp(&larger(a)));
        for begun in order {
            let piece = &self.trajectory().pieces[begun.index];
            let evaluator = self.evaluator_in(&mut evaluators, piece.mode, formula)?;
            let mut search = Search::new(piece, begun.index, evaluator, &mut best);
            search.whole(&begun).map_err(|at| cornered(piece, at))?;
        }
        let Some(found) = best.found else { return Ok(None) };
        let piece = &self.trajectory().pieces[found.piece];
        let evaluator = self.evaluator_in(&mut evaluators, piece.mode, formula)?;
        let ends = [from, to].map(|time| self.within(time));
        let kind = kind_of(&found, Search::new(piece, found.piece, evaluator, &mut best), ends);
        Ok(Some(Peak { time: found.time, side: found.side, value: which.sign() * found.gain, kind }))
    }

    fn evaluator_in<'a>(
        &self,
        evaluators: &'a mut [Option<Evaluator>],
        mode: usize,
        formula: &Expr,
    ) -> Result<&'a mut Evaluator, RunError> {
        match &mut evaluators[mode] {
            Some(found) => Ok(found),
            empty => {
                let of = std::slice::from_ref(formula);
                let jets =
                    self.equations.expander(&self.trajectory().modes[mode], of, &self.inputs, ORDER)?;
                let enclosure = Enclosure::new(jets.tape().clone(), &self.inputs);
                let inputs: Vec<Interval> = self.inputs.iter().map(|value| Interval::point(*value)).collect();
                let ranges = Jets::new(jets.tape().clone(), 0, &inputs);
                Ok(empty.insert(Evaluator { jets, ranges, enclosure, states: vec![], state_ranges: vec![] }))
            }
        }
    }

    /// A time, or the end of the motion that is nearest.
    fn within(&self, time: f64) -> f64 {
        let (start, end) = (self.trajectory().start(), self.trajectory().end());
        time.clamp(start.unwrap_or(time), end.unwrap_or(time))
    }
}

fn cornered(piece: &Piece, s: f64) -> Reason {
    let time = piece.time_at(s);
    Reason::Model(format!(
        "a quantity has kinks or no value at so many instants after {time} s that its extremes cannot be told"
    ))
}

fn kind_of(found: &Candidate, mut search: Search<'_>, edges: [f64; 2]) -> PeakKind {
    let [slope, bend] = search.slopes(found.s);
    let rate = search.piece.time_rate(found.s);
    let is_near = (slope / bend).abs() <= AT_TURN * search.piece.length;
    if is_near && search.best.sign * bend < 0.0 && rate > 0.0 {
        PeakKind::Turn { bend: bend / (rate * rate) }
    } else if edges.contains(&found.time) {
        PeakKind::Edge
    } else {
        PeakKind::Kink
    }
}

/// A formula in the states of one mode.
struct Evaluator {
    jets: Jets<f64>,
    /// For all values between two of the states at once.
    ranges: Jets<Interval>,
    enclosure: Enclosure,
    /// The states at the place that was looked at last, and their ranges.
    states: Vec<f64>,
    state_ranges: Vec<Interval>,
}

/// A piece whose ends have been looked at.
struct Begun {
    index: usize,
    /// Values of its parameter.
    ends: [f64; 2],
    /// What they have to offer.
    gains: [f64; 2],
    /// What nothing between them has more of.
    most: f64,
}

/// The best value so far.
struct Best {
    sign: f64,
    found: Option<Candidate>,
}

#[derive(Clone, Copy)]
struct Candidate {
    piece: usize,
    s: f64,
    time: f64,
    side: Side,
    /// The value by its sign: what is to be large.
    gain: f64,
}

impl Best {
    fn offer(&mut self, new: Candidate) {
        let is_better = |best: Candidate| {
            let (more, same) = (new.gain - best.gain, SAME * best.gain.abs());
            more > same || (more >= -same && new.time < best.time)
        };
        if new.gain.is_finite() && self.found.is_none_or(is_better) {
            self.found = Some(new);
        }
    }

    /// Whether something of at most that gain is worse, whatever rounding does to both.
    fn is_far_above(&self, most: f64) -> bool {
        self.found.is_some_and(|best| most < best.gain - FAR * best.gain.abs())
    }

    /// Whether something of at most that gain, from a time on, may be better.
    fn may_yield_to(&self, most: f64, time: f64) -> bool {
        let is_better = |best: Candidate| {
            let more = most - best.gain;
            more > 0.0 || (time < best.time && more >= -SAME * best.gain.abs())
        };
        self.found.is_none_or(is_better)
    }
}
