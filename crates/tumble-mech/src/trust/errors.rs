//! Errors of quantities along a motion, from its difference to a check run.

use tumble_expr::Expr;
use tumble_ode::Side;

use crate::observer::Observer;
use crate::run::{Run, RunError};
use crate::trust::phases::{Phases, Stretch};
use crate::trust::{SAFETY, ULPS};

/// A phase pressed into a surface and shorter than this part of the longest so far is an impact: what is off within one
/// passes with it.
const BRIEF: f64 = 0.05;
/// Parts of a step at whose ends the two runs are compared.
const PARTS: usize = 4;

/// Errors of quantities along a motion.
#[derive(Clone, Debug)]
pub struct Errors {
    rows: Vec<(f64, Vec<f64>)>,
    largest: Vec<f64>,
    until: f64,
}

impl Errors {
    pub(super) fn of(
        run: &Run,
        check: &Run,
        phases: &Phases,
        until: f64,
        formulas: &[Expr],
    ) -> Result<Self, RunError> {
        let mut both = [run.observe(formulas)?, check.observe(formulas)?];
        let rounding = ULPS * f64::EPSILON + run.quadrature.map_or(0.0, |quadrature| quadrature.change);
        let (mut difference, mut size) = (vec![0.0_f64; formulas.len()], vec![0.0_f64; formulas.len()]);
        let (mut rows, mut longest) = (vec![], 0.0_f64);
        let mut phases = phases.all.iter();
        let mut phase = phases.next();
        for piece in run.trajectory.pieces.iter().take_while(|piece| piece.start < until) {
            while phase.is_some_and(|[here, _]| here.end <= piece.start) {
                phase = phases.next();
            }
            let Some(phase) = phase else { break };
            let length = phase[0].end - phase[0].start;
            longest = longest.max(length);
            let is_pressed = run.trajectory.modes[piece.mode].pressed().next().is_some();
            let is_impact = is_pressed && length < BRIEF * longest;
            for part in 0..=PARTS {
                let time = piece.start + (piece.end - piece.start) * part as f64 / PARTS as f64;
                let (time, side) =
                    if part == PARTS { (piece.end, Side::Before) } else { (time, Side::After) };
                let Some(found) = Compared::at(&mut both, *phase, (time, side)) else { continue };
                let stated = found.differences().enumerate().map(|(index, (now, later))| {
                    if !is_impact {
                        difference[index] = larger(difference[index], later);
                    }
                    size[index] = larger(size[index], found.here[index].abs());
                    SAFETY * larger(difference[index], now) + rounding * size[index]
                });
                rows.push((time, stated.collect()));
            }
        }
        Ok(Self { rows, largest: size, until })
    }

    /// The errors at a time, s, in the order of the formulas; `None` where nothing can be said.
    pub fn at(&self, time: f64) -> Option<Vec<f64>> {
        let next = self.rows.partition_point(|(known, _)| *known < time).min(self.rows.len().checked_sub(1)?);
        let [before, after] = [next.saturating_sub(1), next].map(|row| &self.rows[row].1);
        let worst = before.iter().zip(after).map(|(before, after)| larger(*before, *after));
        (time <= self.until).then(|| worst.collect())
    }

    /// The errors at the end; `None` where nothing can be said of it.
    pub fn last(&self) -> Option<&[f64]> {
        if self.until.is_finite() { None } else { self.rows.last().map(|(_, row)| &**row) }
    }

    /// Largest absolute value of each quantity, SI units.
    pub(super) fn largest(&self) -> &[f64] {
        &self.largest
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.rows.iter().map(|(time, row)| (*time, &**row))
    }
}

/// Unlike `f64::max`, keeps what is not a number.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

/// Values of both runs at one time of the first.
struct Compared {
    here: Vec<f64>,
    /// At the same time since the phase began.
    since: Vec<f64>,
    /// At the same time, where both runs are in the phase.
    same: Option<Vec<f64>>,
}

impl Compared {
    fn at(
        [first, check]: &mut [Observer<'_>; 2],
        [here, there]: [Stretch; 2],
        (time, side): (f64, Side),
    ) -> Option<Self> {
        let since = (there.start + (time - here.start)).clamp(there.start, there.end);
        let is_in = there.start <= time && time <= there.end;
        Some(Self {
            here: first.at(time, side)?,
            since: check.at(since, side)?,
            same: if is_in { check.at(time, side) } else { None },
        })
    }

    /// How far each value is off now, and by how much of that it may stay so.
    fn differences(&self) -> impl Iterator<Item = (f64, f64)> {
        (0..self.here.len()).map(|index| {
            let since = (self.here[index] - self.since[index]).abs();
            let now = self.same.as_ref().map_or(since, |same| (self.here[index] - same[index]).abs());
            (now, if now < since { now } else { since })
        })
    }
}
