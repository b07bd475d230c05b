//! Errors of quantities along a motion, from its difference to a check run.

use std::collections::VecDeque;

use tumble_expr::Expr;
use tumble_ode::{Piece, Side};

use crate::observer::Observer;
use crate::run::{Run, RunError};
use crate::trust::ULPS;
use crate::trust::check_run::CheckRun;
use crate::trust::phases::Stretch;

/// A phase pressed into a surface and shorter than this part of the longest so far is an impact, and one in a Zeno sequence is of
/// its last: what is off within them passes with them.
pub(super) const BRIEF: f64 = 0.05;
/// Steps before that of a time whose differences count: one may be small by accident, and a value too. What decays is known ever
/// better, and what was off long ago and is not now has passed.
const RECENT: usize = 1;
/// Parts of a step at whose ends the runs are compared, at least; as many as the steps of a check run where those are more.
const PARTS: usize = 4;

/// Errors of quantities along a motion.
#[derive(Clone, Debug)]
pub struct Errors {
    rows: Vec<Row>,
    largest: Vec<f64>,
    until: f64,
}

/// Errors at one time.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// s
    pub(super) time: f64,
    /// By formula.
    pub(super) errors: Vec<f64>,
    /// Whether they are those of an impact, or next to an event that not every run has come to, and pass with it.
    pub(super) passes: bool,
}

/// A check run on its way along the motion.
struct Beside<'a> {
    observer: Observer<'a>,
    phases: std::iter::Peekable<std::slice::Iter<'a, [Stretch; 2]>>,
    safety: f64,
    /// Differences that stay, by formula.
    differences: Recent,
    longest: f64,
}

/// The largest values of some quantities over the last steps.
struct Recent {
    /// Of each step before this one.
    steps: VecDeque<Vec<f64>>,
    /// Of this step and those.
    largest: Vec<f64>,
    /// Of this step.
    now: Vec<f64>,
}

impl Recent {
    fn new(quantities: usize) -> Self {
        let none = vec![0.0; quantities];
        Self { steps: VecDeque::new(), largest: none.clone(), now: none }
    }

    /// Begins another step.
    fn advance(&mut self) {
        let quantities = self.now.len();
        self.steps.push_back(std::mem::replace(&mut self.now, vec![0.0; quantities]));
        if self.steps.len() > RECENT {
            self.steps.pop_front();
        }
        let of_all = |index: usize| self.steps.iter().map(|step| step[index]).fold(0.0, larger);
        self.largest = (0..quantities).map(of_all).collect();
    }

    fn add(&mut self, index: usize, value: f64) {
        self.now[index] = larger(self.now[index], value);
        self.largest[index] = larger(self.largest[index], value);
    }
}

impl<'a> Beside<'a> {
    fn new(check: &'a CheckRun, formulas: &[Expr]) -> Result<Self, RunError> {
        Ok(Self {
            observer: check.run.observe(formulas)?,
            phases: check.phases.all.iter().peekable(),
            safety: check.safety,
            differences: Recent::new(formulas.len()),
            longest: 0.0,
        })
    }

    /// The stretch that a piece of the motion lies in.
    fn phase(&mut self, piece: &Piece) -> Option<[Stretch; 2]> {
        while self.phases.next_if(|[here, _]| here.end <= piece.start).is_some() {}
        let phase = **self.phases.peek()?;
        self.longest = self.longest.max(phase[0].end - phase[0].start);
        self.differences.advance();
        Some(phase)
    }

    /// Errors that this run tells of, of values of the motion at an instant within a stretch, and whether they pass.
    fn errors(
        &mut self,
        here: &[f64],
        phase: [Stretch; 2],
        (time, side): (f64, Side),
        stays: bool,
    ) -> Option<(Vec<f64>, bool)> {
        let found = Compared::at(&mut self.observer, phase, (time, side))?;
        let passes = !stays || found.same.is_none();
        let stated = found.differences(here).enumerate().map(|(index, (now, later))| {
            if stays {
                self.differences.add(index, later);
            }
            self.safety * larger(self.differences.largest[index], now)
        });
        Some((stated.collect(), passes))
    }
}

impl Errors {
    pub(super) fn of(
        run: &Run,
        checks: &[CheckRun],
        until: f64,
        formulas: &[Expr],
    ) -> Result<Self, RunError> {
        let mut observer = run.observe(formulas)?;
        let mut beside =
            checks.iter().map(|check| Beside::new(check, formulas)).collect::<Result<Vec<_>, _>>()?;
        let mut sizes = Recent::new(formulas.len());
        let mut largest = vec![0.0_f64; formulas.len()];
        let mut rows = vec![];
        for piece in run.trajectory.pieces.iter().take_while(|piece| piece.start < until) {
            let phases: Option<Vec<[Stretch; 2]>> =
                beside.iter_mut().map(|check| check.phase(piece)).collect();
            let Some(phases) = phases else { break };
            sizes.advance();
            let is_pressed = run.trajectory.modes[piece.mode].pressed().next().is_some();
            let most =
                checks.iter().map(|check| check.pieces_between(piece.start, piece.end)).max().unwrap_or(0);
            for (time, side) in places(piece, most.max(PARTS)) {
                let Some(here) = observer.at(time, side) else { continue };
                for (index, value) in here.iter().enumerate().filter(|(_, value)| value.is_finite()) {
                    sizes.add(index, value.abs());
                    largest[index] = largest[index].max(value.abs());
                }
                let rounding: Vec<f64> =
                    sizes.largest.iter().map(|size| ULPS * f64::EPSILON * size).collect();
                let mut row = rounding.clone();
                let (mut is_compared, mut passes) = (true, false);
                for (check, phase) in beside.iter_mut().zip(&phases) {
                    let is_impact = is_pressed && phase[0].end - phase[0].start < BRIEF * check.longest;
                    let stays = !is_impact && !phase[0].ends_zeno_sequence;
                    match check.errors(&here, *phase, (time, side), stays) {
                        None => is_compared = false,
                        Some((errors, pass)) => {
                            passes |= pass;
                            let stated =
                                errors.iter().zip(&rounding).map(|(error, rounding)| error + rounding);
                            row.iter_mut().zip(stated).for_each(|(row, stated)| *row = larger(*row, stated));
                        }
                    }
                }
                if is_compared {
                    rows.push(Row { time, errors: row, passes });
                }
            }
        }
        Ok(Self { rows, largest, until })
    }

    /// The errors at a time, s, in the order of the formulas; `None` where nothing can be said.
    ///
    /// At an event they are the larger of those before and after it, which are rows of one time.
    pub fn at(&self, time: f64) -> Option<Vec<f64>> {
        let last = self.rows.len().checked_sub(1)?;
        let next = self.rows.partition_point(|row| row.time < time);
        let after = self.rows.partition_point(|row| row.time <= time);
        // Between two rows both count; a row at the time itself tells of it alone.
        let near = if next < after { next..after } else { next.saturating_sub(1)..after.min(last) + 1 };
        let near = &self.rows[near];
        let (first, others) = near.split_first()?;
        let larger_of = |mut worst: Vec<f64>, row: &Row| {
            worst.iter_mut().zip(&row.errors).for_each(|(worst, error)| *worst = larger(*worst, *error));
            worst
        };
        (time <= self.until).then(|| others.iter().fold(first.errors.clone(), larger_of))
    }

    /// The errors at the end; `None` where nothing can be said of it.
    pub fn last(&self) -> Option<&[f64]> {
        if self.until.is_finite() { None } else { self.rows.last().map(|row| &*row.errors) }
    }

    /// Largest absolute value of each quantity, SI units.
    pub(super) fn largest(&self) -> &[f64] {
        &self.largest
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }
}

/// By how much the value of a formula at an instant of the motion is off by a check run, with its safety.
pub(super) fn difference(
    check: &CheckRun,
    formula: &Expr,
    value: f64,
    at: (f64, Side),
) -> Result<Option<f64>, RunError> {
    let Some(stretch) = check.phases.stretch(at.0, at.1) else { return Ok(None) };
    let found = Compared::at(&mut check.run.observe(std::slice::from_ref(formula))?, stretch, at);
    Ok(found.and_then(|found| found.differences(&[value]).next().map(|(now, _)| check.safety * now)))
}

/// Unlike `f64::max`, keeps what is not a number.
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}

/// Places of a piece at which runs are compared: the ends of equal parts.
fn places(piece: &Piece, parts: usize) -> impl Iterator<Item = (f64, Side)> {
    (0..=parts).map(move |part| match part {
        last if last == parts => (piece.end, Side::Before),
        _ => (piece.start + (piece.end - piece.start) * part as f64 / parts as f64, Side::After),
    })
}

/// Values of a check run that belong to one time of the motion.
struct Compared {
    /// At the same time since the phase began.
    since: Vec<f64>,
    /// At the same time, where both runs are in the phase.
    same: Option<Vec<f64>>,
}

impl Compared {
    fn at(check: &mut Observer<'_>, [here, there]: [Stretch; 2], (time, side): (f64, Side)) -> Option<Self> {
        let since = (there.start + (time - here.start)).clamp(there.start, there.end);
        let is_in = there.start <= time && time <= there.end;
        let since = check.at(since, side)?;
        Some(Self { since, same: if is_in { check.at(time, side) } else { None } })
    }

    /// How far each value is off now, and by how much of that it may stay so.
    fn differences<'a>(&'a self, here: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
        (0..here.len()).map(move |index| {
            let since = (here[index] - self.since[index]).abs();
            // Next to an event, that it comes a little late tells of no later time.
            let Some(same) = &self.same else { return (since, 0.0) };
            let now = (here[index] - same[index]).abs();
            (now, if now < since { now } else { since })
        })
    }
}
