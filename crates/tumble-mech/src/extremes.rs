//! When a quantity is greatest or least along a motion.
//!
//! Within a piece the states are polynomials, so that any formula of them has a Taylor series about any instant of it.
//! Where that series agrees with the formula's values, the extremes are at the ends and where the series has no slope.
//! A part where it does not is halved, down to [`SHORTEST`] of the piece: what is left is at a kink or a jump of the
//! formula, and both its ends are looked at. Pieces end at events, so that both sides of every jump of the motion
//! count.
//!
//! A quantity that has kinks, or no value, at more than some hundred instants of one piece is refused. Something that
//! is over within a small part of a step, and that neither series nor values tell of, is not seen. `tests/extremes.rs`
//! checks it against closed forms.

use tumble_expr::{Branches, Expr, Jets};
use tumble_ode::{Piece, Place, Reason, Side, turns};

use crate::evaluator::evaluate;
use crate::run::{Run, RunError};

/// Where a series is compared with the values, in parts of its length.
const PLACES: [f64; 6] = [0.125, 0.25, 0.5, 0.618, 0.8, 1.0];
/// What they may differ by, relative to the series' terms; the instant of a turn is corrected afterwards.
const AGREES: f64 = 1e-9;
/// What rounding makes of any value, relative to the largest; ...
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// ... or, where it is a small difference of large ones, to what it changes by when the states change by one ulp.
const CANCELLATION: f64 = 64.0;
/// Shorter parts of a piece are not halved any more.
const SHORTEST: f64 = 1e-13;
/// A piece is cut into no more parts: one kink takes some fifty.
const MOST_PARTS: usize = 10_000;
/// A later value has to be larger by this part to be another.
const SAME: f64 = 8.0 * f64::EPSILON;

/// Which extreme is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extreme {
    /// The greatest value.
    Greatest,
    /// The least value.
    Least,
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
        let mut jets: Vec<Option<Jets<f64>>> = vec![None; self.trajectory.modes.len()];
        let mut best = Best { which, peak: None };
        for piece in self.trajectory.pieces.iter().filter(|piece| piece.end >= from && piece.start <= to) {
            let jets = match &mut jets[piece.mode] {
                Some(jets) => jets,
                empty => empty.insert(self.expander(piece.mode, formula)?),
            };
            let [low, high] = [from, to].map(|time| piece.parameter_at(time.clamp(piece.start, piece.end)));
            let mut search = Search { piece, jets, best: &mut best, parts: 0, largest: 0.0, noise: 0.0 };
            search.find_noise([low, high]);
            search.part([low, high]).map_err(|at| cornered(piece, at))?;
        }
        Ok(best.peak)
    }

    fn expander(&self, mode: usize, formula: &Expr) -> Result<Jets<f64>, RunError> {
        let (mode, order) = (&self.trajectory.modes[mode], self.trajectory.order);
        Ok(self.equations.expander(mode, std::slice::from_ref(formula), &self.inputs, order)?)
    }
}

fn cornered(piece: &Piece, s: f64) -> Reason {
    let time = piece.time_at(s);
    Reason::Model(format!(
        "a quantity has kinks or no value at so many instants after {time} s that its extremes cannot be told"
    ))
}

struct Best {
    which: Extreme,
    peak: Option<Peak>,
}

impl Best {
    fn offer(&mut self, peak: Peak) {
        let is_more = |best: Peak| {
            let gain = match self.which {
                Extreme::Greatest => peak.value - best.value,
                Extreme::Least => best.value - peak.value,
            };
            gain > SAME * best.value.abs()
        };
        if peak.value.is_finite() && self.peak.is_none_or(is_more) {
            self.peak = Some(peak);
        }
    }
}

/// One piece of the motion.
struct Search<'a> {
    piece: &'a Piece,
    jets: &'a mut Jets<f64>,
    best: &'a mut Best,
    parts: usize,
    /// Largest size of a value so far.
    largest: f64,
    /// What a rounding error of the states changes the value by.
    noise: f64,
}

impl Search<'_> {
    /// From one value of the piece's parameter to another; the value at which there are too many parts is an error.
    fn part(&mut self, [low, high]: [f64; 2]) -> Result<(), f64> {
        self.parts += 1;
        if self.parts > MOST_PARTS {
            return Err(low);
        }
        self.offer(low);
        let length = high - low;
        if length > SHORTEST * self.piece.length {
            let series = self.series(low);
            if !self.agrees(&series, low, length) {
                let middle = 0.5 * (low + high);
                self.part([low, middle])?;
                return self.part([middle, high]);
            }
            for turn in turns(&series, length) {
                let at = self.corrected(low + turn, length).clamp(low, high);
                self.offer(at);
            }
        }
        self.offer(high);
        Ok(())
    }

    fn offer(&mut self, s: f64) {
        let side = if s < self.piece.length { Side::After } else { Side::Before };
        let (time, value) = (place(self.piece, s).time, self.value(s));
        self.best.offer(Peak { time, side, value });
    }

    fn value(&mut self, s: f64) -> f64 {
        evaluate(self.jets, &place(self.piece, s));
        let value = self.jets.value_of(0);
        if value.is_finite() {
            self.largest = self.largest.max(value.abs());
        }
        value
    }

    /// The value where every other state is off by one part of itself, and those between them by another.
    fn value_with(&mut self, s: f64, off: [f64; 2]) -> f64 {
        let mut states = self.piece.states_at_parameter(s);
        states.iter_mut().zip(off.iter().cycle()).for_each(|(state, off)| *state *= 1.0 + off);
        self.jets.start(self.piece.time_at(s) * (1.0 + off[0]), &states, Branches::Free);
        self.jets.value_of(0)
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

    /// The formula's series about a value of the parameter.
    fn series(&mut self, s: f64) -> Vec<f64> {
        let (states, time) = self.piece.series_at(s);
        evaluate(self.jets, &place(self.piece, s));
        let order = self.jets.output(0).len() - 1;
        for k in 1..=order {
            for (leaf, series) in states.iter().chain([&time]).enumerate() {
                self.jets.set(leaf, k, series.get(k).copied().unwrap_or(0.0));
            }
            self.jets.extend(k);
        }
        self.jets.output(0).to_vec()
    }

    fn agrees(&mut self, series: &[f64], from: f64, length: f64) -> bool {
        if !series.iter().all(|c| c.is_finite()) {
            // A length that stays zero has no series, and needs none.
            return PLACES.iter().all(|place| self.value(from + place * length) == series[0]);
        }
        let rounding = ROUNDING * self.largest + CANCELLATION * self.noise;
        PLACES.iter().all(|place| {
            let s = place * length;
            let (mut sum, mut terms) = (0.0, 0.0);
            for c in series.iter().rev() {
                (sum, terms) = (sum * s + c, terms * s + c.abs());
            }
            (self.value(from + s) - sum).abs() <= AGREES * terms + rounding
        })
    }

    /// A step of Newton's towards where the slope is zero, by the series about the place itself.
    fn corrected(&mut self, s: f64, length: f64) -> f64 {
        let series = self.series(s);
        let by = match series[..] {
            [_, slope, half_bend, ..] => -slope / (2.0 * half_bend),
            _ => 0.0,
        };
        // What is no number, or farther than the part, is no correction.
        if by.abs() <= AGREES.sqrt() * length { s + by } else { s }
    }
}

fn place(piece: &Piece, s: f64) -> Place<'_> {
    // The time at the parameter's end may miss the piece's by a rounding error.
    let time = if s < piece.length { piece.time_at(s) } else { piece.end };
    Place { mode: piece.mode, time, states: piece.states_at_parameter(s), piece: Some(piece) }
}
