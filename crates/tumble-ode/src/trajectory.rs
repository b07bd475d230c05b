//! A motion: polynomial pieces one after the other, and the events between them.

use tumble_expr::Interval;

use crate::Coefficients;
use crate::hybrid::Cause;
use crate::polynomial;
use crate::work::Work;

/// A motion from its start to its end, or as far as it was found.
#[derive(Clone, Debug)]
pub struct Trajectory<Mode, Record = ()> {
    /// The modes that occurred, in order of first entry.
    pub modes: Vec<Mode>,
    /// Pieces in order of time; each begins where the one before ends.
    pub pieces: Vec<Piece>,
    /// Events in order of time.
    pub events: Vec<Occurrence<Record>>,
    /// What it cost.
    pub work: Work,
    /// Order of the Taylor steps.
    pub order: usize,
    /// Scales that errors are relative to, one a group of states.
    pub scales: Vec<f64>,
    /// What rounding errors of the rates may have done to each group: less than that is no motion.
    pub rounding: Vec<f64>,
}

/// A stretch of motion in one mode, as polynomials in its own parameter s, which begins at 0.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Time at s = 0, s.
    pub start: f64,
    /// What rounding left out of `start`, s: s is counted from the sum of both.
    pub left_out: f64,
    /// Time at s = `length`, s.
    pub end: f64,
    /// Index in [`Trajectory::modes`].
    pub mode: usize,
    /// Length in units of the parameter.
    pub length: f64,
    /// Coefficients `[state][order]` in s.
    pub states: Coefficients,
    /// Coefficients of the time in s; where there are none, the time is `start + s`.
    pub time_series: Option<Vec<f64>>,
}

/// Something that happened at one instant.
#[derive(Clone, Debug)]
pub struct Occurrence<Record = ()> {
    /// When, s.
    pub time: f64,
    /// What the integrator saw.
    pub causes: Vec<Cause>,
    /// What happened, in the model's terms.
    pub record: Record,
    /// States just before.
    pub before: Vec<f64>,
    /// States just after.
    pub after: Vec<f64>,
    /// By how much rounding errors of what was crossed may have moved the time, and what was left out before it, s.
    pub blur: f64,
    /// Index in [`Trajectory::modes`] of the mode that ended.
    pub mode_before: usize,
    /// Index in [`Trajectory::modes`] of the mode that began.
    pub mode_after: usize,
}

/// The motion at one time.
#[derive(Clone, Debug)]
pub struct MotionState<'a> {
    /// Index in [`Trajectory::modes`].
    pub mode: usize,
    /// s
    pub time: f64,
    /// In the order of the mode.
    pub states: Vec<f64>,
    /// The piece that it lies on, perhaps at its end.
    pub piece: Option<&'a Piece>,
}

/// Where in a motion was looked at last: what comes next is found from there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cursor(usize);

/// What the motion at one time is known by.
#[derive(Clone, Copy, Debug)]
pub struct Spot<'a> {
    /// Index in [`Trajectory::modes`].
    pub mode: usize,
    of: Known<'a>,
}

#[derive(Clone, Copy, Debug)]
enum Known<'a> {
    /// Before an event at the very start, or after one at the very end.
    States(&'a [f64]),
    Piece(&'a Piece),
}

impl<'a> Spot<'a> {
    /// The piece that it lies on, if there is one.
    pub fn piece(self) -> Option<&'a Piece> {
        match self.of {
            Known::States(_) => None,
            Known::Piece(piece) => Some(piece),
        }
    }

    /// The states at that time, added to the end of `states`.
    pub fn states_into(self, time: f64, states: &mut Vec<f64>) {
        match self.of {
            Known::States(known) => states.extend_from_slice(known),
            Known::Piece(piece) => piece.states_into(piece.parameter_at(time), states),
        }
    }
}

/// Which value is meant at the instant of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Just before.
    Before,
    /// Just after.
    After,
}

impl<Mode, Record> Trajectory<Mode, Record> {
    /// Time of the start, s; `None` if nothing was integrated and nothing happened.
    pub fn start(&self) -> Option<f64> {
        let first = || self.events.first().map(|event| event.time);
        self.pieces.first().map(|piece| piece.start).or_else(first)
    }

    /// Time up to which the motion is known, s; `None` if nothing was integrated and nothing happened.
    pub fn end(&self) -> Option<f64> {
        let last = || self.events.last().map(|event| event.time);
        self.pieces.last().map(|piece| piece.end).or_else(last)
    }

    /// The piece that holds `time`; `None` outside the motion. At a joint, the side says which.
    pub fn piece_at(&self, time: f64, side: Side) -> Option<&Piece> {
        let index = match side {
            Side::After => self.pieces.partition_point(|piece| piece.end <= time),
            Side::Before => self.pieces.partition_point(|piece| piece.end < time),
        };
        let piece = self.pieces.get(index).or(self.pieces.last())?;
        (piece.start <= time && time <= piece.end).then_some(piece)
    }

    /// States at `time`; `None` outside the motion.
    pub fn states_at(&self, time: f64, side: Side) -> Option<Vec<f64>> {
        Some(self.place_at(time, side)?.states)
    }

    /// The motion at `time`; `None` outside it.
    ///
    /// Before an event at the very start, and after one at the very end, there is no piece.
    pub fn place_at(&self, time: f64, side: Side) -> Option<MotionState<'_>> {
        let at =
            |mode: usize, states: &[f64]| MotionState { mode, time, states: states.to_vec(), piece: None };
        match (side, self.first_event(), self.last_event()) {
            (Side::Before, Some(first), _) if first.time == time => {
                Some(at(first.mode_before, &first.before))
            }
            (Side::After, _, Some(last)) if last.time == time => Some(at(last.mode_after, &last.after)),
            _ => {
                let piece = self.piece_at(time, side)?;
                let states = piece.states_at(time);
                Some(MotionState { mode: piece.mode, time, states, piece: Some(piece) })
            }
        }
    }

    /// Where `time` lies; `None` outside the motion. Times in order are found without a search.
    pub fn spot_at(&self, time: f64, side: Side, cursor: &mut Cursor) -> Option<Spot<'_>> {
        match (side, self.first_event(), self.last_event()) {
            (Side::Before, Some(first), _) if first.time == time => {
                Some(Spot { mode: first.mode_before, of: Known::States(&first.before) })
            }
            (Side::After, _, Some(last)) if last.time == time => {
                Some(Spot { mode: last.mode_after, of: Known::States(&last.after) })
            }
            _ => {
                let piece = self.piece_from(time, side, cursor)?;
                Some(Spot { mode: piece.mode, of: Known::Piece(piece) })
            }
        }
    }

    /// [`Trajectory::piece_at`], looked for from where the cursor is.
    fn piece_from(&self, time: f64, side: Side, cursor: &mut Cursor) -> Option<&Piece> {
        let is_over = |piece: &Piece| match side {
            Side::After => piece.end <= time,
            Side::Before => piece.end < time,
        };
        let index = &mut cursor.0;
        *index = (*index).min(self.pieces.len());
        while *index > 0 && !is_over(&self.pieces[*index - 1]) {
            *index -= 1;
        }
        while self.pieces.get(*index).is_some_and(is_over) {
            *index += 1;
        }
        let piece = self.pieces.get(*index).or(self.pieces.last())?;
        (piece.start <= time && time <= piece.end).then_some(piece)
    }

    /// The mode that it starts in.
    pub(crate) fn first_mode(&self) -> Option<usize> {
        let piece = || self.pieces.first().map(|piece| piece.mode);
        self.first_event().map(|event| event.mode_before).or_else(piece)
    }

    /// Leaves out all that comes after a time; the piece that it lies in ends there.
    pub fn cut(&mut self, time: f64) {
        self.events.retain(|event| event.time <= time);
        self.pieces.retain(|piece| piece.start < time);
        if let Some(last) = self.pieces.last_mut().filter(|last| last.end > time) {
            last.length = last.parameter_at(time);
            last.end = time;
        }
    }

    fn first_event(&self) -> Option<&Occurrence<Record>> {
        let start = self.start()?;
        self.events.first().filter(|event| event.time == start)
    }

    /// States at the end, after what happens there; `None` if nothing was integrated.
    pub fn last_states(&self) -> Option<Vec<f64>> {
        self.states_at(self.end()?, Side::After)
    }

    /// The event at the very end, if there is one.
    pub fn last_event(&self) -> Option<&Occurrence<Record>> {
        let end = self.end()?;
        self.events.last().filter(|event| event.time == end)
    }
}

impl Piece {
    /// States at a time within the piece.
    pub fn states_at(&self, time: f64) -> Vec<f64> {
        self.states_at_parameter(self.parameter_at(time))
    }

    /// States at a value of the piece's parameter.
    pub fn states_at_parameter(&self, s: f64) -> Vec<f64> {
        self.states.iter().map(|series| polynomial::value(series, s)).collect()
    }

    /// The same, added to the end of `states`.
    pub fn states_into(&self, s: f64, states: &mut Vec<f64>) {
        let value = |series: &[f64]| match series.first() {
            // Horner's rule comes to the same, but for the sign of zero.
            Some(first) if s == 0.0 && *first != 0.0 => *first,
            _ => polynomial::value(series, s),
        };
        states.extend(self.states.iter().map(value));
    }

    /// Ranges that hold all states from the start of the piece up to `s`, added to the end of `states`, and that of the time.
    pub fn ranges_into(&self, s: f64, states: &mut Vec<Interval>) -> Interval {
        states.extend(self.states.iter().map(|series| range(series, s)));
        match &self.time_series {
            None => range(&[self.start, 1.0], s),
            Some(series) => range(series, s),
        }
    }

    /// Ranges that hold all states between two times within the piece, added to the end of `states`.
    pub fn ranges_between(&self, [from, to]: [f64; 2], states: &mut Vec<Interval>) {
        let [from, to] = [from, to].map(|time| self.parameter_at(time));
        let about = |series: &[f64]| range(&polynomial::shifted(series, from), (to - from).max(0.0));
        states.extend(self.states.iter().map(about));
    }

    /// The states as series about a value of the piece's parameter, and the time as one.
    pub fn series_at(&self, s: f64) -> (Vec<Vec<f64>>, Vec<f64>) {
        let states = self.states.iter().map(|series| polynomial::shifted(series, s).into_vec()).collect();
        let series = self.time_series.as_deref().unwrap_or(&[0.0, 1.0]);
        let mut time = polynomial::shifted(series, s).into_vec();
        time[0] = self.time_at(s);
        (states, time)
    }

    /// How fast the time passes at a value of the piece's parameter, s per unit of the parameter.
    pub fn time_rate(&self, s: f64) -> f64 {
        self.time_series.as_ref().map_or(1.0, |series| polynomial::slope(series, s))
    }

    /// Value of the piece's parameter at a time within the piece.
    pub fn parameter_at(&self, time: f64) -> f64 {
        match &self.time_series {
            // What rounding left out of times is in the length.
            None if time == self.end => self.length,
            None => (time - self.start - self.left_out).max(0.0),
            Some(series) => invert(series, time - self.start, self.length),
        }
    }

    /// Time at a value of the piece's parameter.
    pub fn time_at(&self, s: f64) -> f64 {
        match &self.time_series {
            None => self.start + (s + self.left_out),
            Some(series) => self.start + polynomial::increment(series, s),
        }
    }
}

/// Rounding errors of a range, and of the values in it, in units of the last place of the sum of all terms.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A range that holds all values of a series from 0 up to `s`: Horner's rule with all that lies between.
fn range(series: &[f64], s: f64) -> Interval {
    let wider = |(low, high, size): (f64, f64, f64), c: &f64| {
        (c + (low * s).min(0.0), c + (high * s).max(0.0), size * s + c.abs())
    };
    let (low, high, size) = series.iter().rev().fold((0.0, 0.0, 0.0), wider);
    Interval::new(low - ROUNDING * size, high + ROUNDING * size)
}

/// Newton steps that the inversion of a time series may take; each at least halves the bracket where Newton's own
/// fails.
const INVERSION_STEPS: usize = 100;

/// The s in `[0, length]` at which an increasing time series has advanced by `elapsed`: Newton's method inside a
/// bracket.
pub(crate) fn invert(series: &[f64], elapsed: f64, length: f64) -> f64 {
    let (mut low, mut high) = (0.0, length);
    let mut s = length * (elapsed / polynomial::increment(series, length)).clamp(0.0, 1.0);
    for _ in 0..INVERSION_STEPS {
        let error = polynomial::increment(series, s) - elapsed;
        if error == 0.0 {
            return s;
        }
        if error > 0.0 {
            high = s
        } else {
            low = s
        }
        let newton = s - error / polynomial::slope(series, s);
        let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
        if next == s || next <= low || next >= high {
            return next;
        }
        s = next;
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_hold_all_values() {
        let series = [0.3, -2.0, 0.5, 3.0, -1.0];
        let Interval { low, high } = range(&series, 1.5);
        for part in 0..=100 {
            let value = polynomial::value(&series, 1.5 * f64::from(part) / 100.0);
            assert!(low <= value && value <= high, "{value} outside {low} and {high}");
        }
    }

    #[test]
    fn a_time_series_is_inverted() {
        // t = s + s^3
        let series = [5.0, 1.0, 0.0, 1.0];
        for s in [0.0, 1e-12, 0.3, 1.7, 2.0] {
            let elapsed = polynomial::increment(&series, s);
            assert!((invert(&series, elapsed, 2.0) - s).abs() < 1e-15 * s.max(1.0), "{s}");
        }
    }
}
