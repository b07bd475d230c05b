//! How far the rows of joints are from losing rank.

use nalgebra::DMatrix;
use tumble_ode::{Piece, Reason};

use super::pose::Pose;
use super::states_beyond;
use crate::assembly::Rows;
use crate::equations::Equations;
use crate::gauge::Gauge;
use crate::mode::Mode;

/// A singular value is zero at its least if it is this part of what it is elsewhere on the way.
pub(super) const ZERO: f64 = 1e-7;
/// Rows that are farther than this from depending on each other are far from a singular pose: the most that rows of length one change by a
/// unit of motion is some few, and poses matter that are a tenth of this away.
pub(super) const NEAR: f64 = 1e-4;
/// Rows that were looked at are looked at again once they are this part as far from depending on each other.
const NEARER_YET: f64 = 0.5;
/// What grows in proportion is, an eighth as far away, an eighth; what grows with the square a sixty-fourth.
const NEARER: f64 = 1.0 / 8.0;
/// Between both.
const PROPORTIONAL: f64 = 0.35;
/// Corrections of the instant, each with a base that is a sixteenth of the one before, or four corrections.
const CORRECTIONS: usize = 12;
/// The narrowest base: there rounding errors of the values are still small parts of them.
const NARROWEST: f64 = 1e-5;
/// Parts of the way to a guess of the instant in which the least value is looked for.
const PARTS: usize = 16;
/// A guess that is so many long steps ahead is too far.
const FAR: f64 = 2.0;
/// Rows of a mode, and which of them are kept.
pub(super) struct Rank {
    gauge: Gauge,
    left_out: Vec<usize>,
    /// Kinds of what the rows are, by their indices: groups of scales of places and rates.
    groups: Vec<[usize; 2]>,
    /// How far they were from depending on each other when they were last looked at, and no singular pose was about.
    looked_at: f64,
}

/// What becomes of the rows ahead.
pub(super) enum Zero {
    /// They do not lose rank.
    None,
    /// At a time, s, known but for a blur, they do, for that instant.
    Crossed {
        at: f64,
        blur: f64,
        /// Whether it is not only those that are kept.
        is_singular: bool,
    },
    /// They do, and no velocity tells what comes after it.
    Touched { at: f64 },
}

impl Rank {
    pub(super) fn of(equations: &Equations, mode: &Mode, inputs: &[f64]) -> Result<Self, Reason> {
        let groups = equations.joint_rows(mode);
        let groups = groups.map(|(_, row)| [row.measure as usize, row.measure.rate() as usize]).collect();
        let gauge = Gauge::of(equations, mode, &equations.rows_by_joint(mode), inputs)?;
        Ok(Self { gauge, left_out: mode.redundant.clone(), groups, looked_at: f64::INFINITY })
    }

    /// About when they lose rank, s, as a piece of the motion ends: within a step or two of that length, if they do.
    pub(super) fn ahead(&mut self, piece: &Piece, longest: f64) -> Option<f64> {
        let [before, after] = [piece.start, piece.end].map(|time| self.kept(piece, time));
        let rate = (before - after) / (piece.end - piece.start);
        let ahead = piece.end + after / rate;
        (rate > 0.0 && ahead - piece.end < FAR * longest).then_some(ahead)
    }

    /// The pose at the end of a piece, if it is near to one where they depend on each other; `is_stuck` where that is why no step was found.
    pub(super) fn near(&mut self, piece: &Piece, is_stuck: bool) -> Option<Pose> {
        let away = self.rows(piece, piece.end).without(&self.left_out).gradient.independence();
        if !is_stuck && away > NEAR.min(NEARER_YET * self.looked_at) {
            return None;
        }
        self.looked_at = away;
        Some(self.pose(piece.end, &states_beyond(piece, piece.end)))
    }

    /// The pose at some states.
    pub(super) fn pose(&mut self, time: f64, states: &[f64]) -> Pose {
        Pose::at(&mut self.gauge, &self.left_out, (time, states), None)
    }

    /// What becomes of them up to about `ahead` along a piece, and as far again.
    pub(super) fn zero(&mut self, piece: &Piece, ahead: f64) -> Zero {
        let part = (ahead - piece.start) / PARTS as f64;
        let values: Vec<f64> =
            (0..=2 * PARTS).map(|at| self.kept(piece, piece.start + at as f64 * part)).collect();
        let valley = (1..2 * PARTS).find(|at| values[*at] <= values[at - 1] && values[*at] <= values[at + 1]);
        let Some(valley) = valley else { return Zero::None };
        let (at, blur) = self.least(piece, piece.start + valley as f64 * part, part);
        if !(at > piece.start && at.is_finite()) {
            return Zero::None;
        }
        let (way, least) = (at - piece.start, self.kept(piece, at));
        if least > ZERO * self.kept(piece, piece.start) {
            return Zero::None;
        }
        let near = 0.05 * way;
        let is_singular = self.all(piece, at) < ZERO.sqrt() * self.all(piece, piece.start);
        let grows = |side: f64| {
            let [far, close] = [near, NEARER * near].map(|away| self.kept(piece, at + side * away));
            close / far
        };
        let shares = [-1.0, 1.0].map(grows);
        match shares.into_iter().all(|share| share < PROPORTIONAL && share > NEARER * PROPORTIONAL) {
            true => Zero::Crossed { at, blur, is_singular },
            false => Zero::Touched { at },
        }
    }

    /// Where the smallest singular value of the rows that are kept is least: it falls to zero and rises again in straight lines but for
    /// their bend, and where these meet is found from ever nearer.
    fn least(&mut self, piece: &Piece, ahead: f64, part: f64) -> (f64, f64) {
        let (mut at, mut base, mut slope) = (ahead, part, 0.0);
        for _ in 0..CORRECTIONS {
            let [before, after] = [-base, base].map(|away| self.kept(piece, at + away));
            slope = (before + after) / (2.0 * base);
            let step = base * (before - after) / (before + after);
            at += step;
            base = (base / 16.0).max(4.0 * step.abs()).max(NARROWEST * part).min(base);
        }
        (at, f64::EPSILON * (self.largest(piece, at) / slope).abs() + 4.0 * f64::EPSILON * at.abs())
    }

    /// Whether all rows, those that are left out too, hold at a time beyond the start of a piece.
    pub(super) fn holds(&mut self, piece: &Piece, time: f64, scales: &[f64], part: f64) -> bool {
        let rows = self.gauge.at(time, &states_beyond(piece, time));
        let scale = |group: usize| scales.get(group).copied().unwrap_or(0.0).max(f64::MIN_POSITIVE);
        let values = rows.position.iter().zip(&rows.rate).zip(&self.groups);
        let mut off = values.map(|((place, rate), [of_place, of_rate])| {
            (place.value.abs() / scale(*of_place)).max(rate.value.abs() / scale(*of_rate))
        });
        off.all(|off| off <= part)
    }

    fn rows(&mut self, piece: &Piece, time: f64) -> Rows {
        self.gauge.at(time, &states_beyond(piece, time))
    }

    /// The smallest singular value of the rows that are kept.
    fn kept(&mut self, piece: &Piece, time: f64) -> f64 {
        let rows = self.rows(piece, time).without(&self.left_out);
        values(&rows).last().copied().unwrap_or(f64::NAN)
    }

    /// That of all rows which is not zero elsewhere.
    fn all(&mut self, piece: &Piece, time: f64) -> f64 {
        let kept = self.groups.len() - self.left_out.len();
        let rows = self.rows(piece, time);
        kept.checked_sub(1).and_then(|last| values(&rows).get(last).copied()).unwrap_or(f64::NAN)
    }

    fn largest(&mut self, piece: &Piece, time: f64) -> f64 {
        values(&self.rows(piece, time)).first().copied().unwrap_or(f64::NAN)
    }
}

/// Singular values of rows in units of one over the root of a mass, from the largest.
pub(super) fn values(rows: &Rows) -> Vec<f64> {
    let mut values: Vec<f64> = scaled(rows).singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// Slopes by velocities that are measured so that a unit of each is as much energy; those without mass as they are.
pub(super) fn scaled(rows: &Rows) -> DMatrix<f64> {
    let unit = rows.mass.map(|mass| if mass > 0.0 { 1.0 / libm::sqrt(mass) } else { 1.0 });
    rows.gradient.dense() * DMatrix::from_diagonal(&unit)
}
