//! A motion: polynomial pieces one after the other, and the events between them.

use crate::hybrid::Cause;
use crate::polynomial;
use crate::work::Work;

/// A motion from its start to its end, or as far as it was found.
#[derive(Clone, Debug)]
pub struct Trajectory<Mode> {
    /// The modes that occurred, in order of first entry.
    pub modes: Vec<Mode>,
    /// Pieces in order of time; each begins where the one before ends.
    pub pieces: Vec<Piece>,
    /// Events in order of time.
    pub events: Vec<Event>,
    /// What it cost.
    pub work: Work,
    /// Order of the Taylor steps.
    pub order: usize,
    /// Scales that errors are relative to, one a group of states.
    pub scales: Vec<f64>,
}

/// A stretch of motion in one mode, as polynomials in its own clock s, which begins at 0.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Time at s = 0, s.
    pub start: f64,
    /// Time at s = `length`, s.
    pub end: f64,
    /// Index in [`Trajectory::modes`].
    pub mode: usize,
    /// Length in units of the clock.
    pub length: f64,
    /// Coefficients `[state][order]` in s.
    pub states: Vec<Vec<f64>>,
    /// Coefficients of the time in s; where there are none, the time is `start + s`.
    pub clock: Option<Vec<f64>>,
}

/// Something that happened at one instant.
#[derive(Clone, Debug)]
pub struct Event {
    /// When, s.
    pub time: f64,
    /// What the integrator saw.
    pub causes: Vec<Cause>,
    /// What it means, in the model's words.
    pub tags: Vec<String>,
    /// States just before.
    pub before: Vec<f64>,
    /// States just after.
    pub after: Vec<f64>,
    /// Index in [`Trajectory::modes`] of the mode that ended.
    pub mode_before: usize,
    /// Index in [`Trajectory::modes`] of the mode that began.
    pub mode_after: usize,
}

/// Which value is meant at the instant of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Just before.
    Before,
    /// Just after.
    After,
}

impl<Mode> Trajectory<Mode> {
    /// Time of the start, s; `None` if nothing was integrated.
    pub fn start(&self) -> Option<f64> {
        self.pieces.first().map(|piece| piece.start)
    }

    /// Time up to which the motion is known, s; `None` if nothing was integrated.
    pub fn end(&self) -> Option<f64> {
        self.pieces.last().map(|piece| piece.end)
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
        Some(self.mode_and_states_at(time, side)?.1)
    }

    /// Index of the mode that holds at `time`, and the states; `None` outside the motion.
    ///
    /// After an event at the very end, those that follow it: no piece begins with them.
    pub fn mode_and_states_at(&self, time: f64, side: Side) -> Option<(usize, Vec<f64>)> {
        match self.last_event() {
            Some(last) if last.time == time && side == Side::After => {
                Some((last.mode_after, last.after.clone()))
            }
            _ => self.piece_at(time, side).map(|piece| (piece.mode, piece.states_at(time))),
        }
    }

    /// States at the end, after what happens there; `None` if nothing was integrated.
    pub fn last_states(&self) -> Option<Vec<f64>> {
        self.states_at(self.end()?, Side::After)
    }

    /// The event at the very end, if there is one.
    pub fn last_event(&self) -> Option<&Event> {
        let end = self.end()?;
        self.events.last().filter(|event| event.time == end)
    }
}

impl Piece {
    /// States at a time within the piece.
    pub fn states_at(&self, time: f64) -> Vec<f64> {
        let s = self.clock_at(time);
        self.states.iter().map(|series| polynomial::value(series, s)).collect()
    }

    /// States at a reading of the piece's clock.
    pub fn states_at_clock(&self, s: f64) -> Vec<f64> {
        self.states.iter().map(|series| polynomial::value(series, s)).collect()
    }

    /// The states as series about a reading of the piece's clock, and the time as one.
    pub fn series_at(&self, s: f64) -> (Vec<Vec<f64>>, Vec<f64>) {
        let states = self.states.iter().map(|series| polynomial::shifted(series, s)).collect();
        let mut time =
            self.clock.as_ref().map_or_else(|| vec![0.0, 1.0], |series| polynomial::shifted(series, s));
        time[0] = self.time_at(s);
        (states, time)
    }

    /// How fast the time passes at a reading of the piece's clock, s per unit of the clock.
    pub fn clock_rate(&self, s: f64) -> f64 {
        self.clock.as_ref().map_or(1.0, |series| polynomial::slope(series, s))
    }

    /// Reading of the piece's clock at a time within the piece.
    pub fn clock_at(&self, time: f64) -> f64 {
        match &self.clock {
            None => time - self.start,
            Some(series) => invert(series, time - self.start, self.length),
        }
    }

    /// Time at a reading of the piece's clock.
    pub fn time_at(&self, s: f64) -> f64 {
        match &self.clock {
            None => self.start + s,
            Some(series) => self.start + polynomial::increment(series, s),
        }
    }
}

/// Newton steps that a clock's inversion may take; each at least halves the bracket where Newton's own fails.
const INVERSION_STEPS: usize = 100;

/// The s in `[0, length]` at which an increasing clock has advanced by `elapsed`: Newton's method inside a bracket.
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
    fn a_clock_is_inverted() {
        // t = s + s^3
        let series = [5.0, 1.0, 0.0, 1.0];
        for s in [0.0, 1e-12, 0.3, 1.7, 2.0] {
            let elapsed = polynomial::increment(&series, s);
            assert!((invert(&series, elapsed, 2.0) - s).abs() < 1e-15 * s.max(1.0), "{s}");
        }
    }
}
