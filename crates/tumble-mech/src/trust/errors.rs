//! Errors of quantities along a motion, from its difference to a check run.

use std::ops::Range;

use tumble_expr::Expr;
use tumble_ode::{Piece, Side};

use crate::observer::Observer;
use crate::run::{Run, RunError};
use crate::trust::ULPS;
use crate::trust::beside::{Beside, Compared, RECENT, Recent};
use crate::trust::check_run::CheckRun;
use crate::trust::phases::Stretch;

/// A phase pressed into a surface and shorter than this part of the longest so far is an impact, and one in a Zeno sequence is of
/// its last: what is off within them passes with them.
pub(super) const BRIEF: f64 = 0.05;
/// Parts of a step at whose ends the runs are compared, at least; as many as the steps of a check run where those are more.
const PARTS: usize = 4;

/// Errors of quantities along a motion.
#[derive(Clone, Debug)]
pub struct Errors {
    rows: Rows,
    largest: Vec<f64>,
    until: f64,
}

/// Errors at several times, in order.
#[derive(Clone, Debug, Default)]
struct Rows {
    /// When, s, and whether they are those of an impact, or next to an event that not every run has come to, and pass with it.
    instants: Vec<(f64, bool)>,
    /// By time, then by formula.
    errors: Vec<f64>,
}

/// Errors at one time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'a> {
    /// s
    pub(super) time: f64,
    /// By formula.
    pub(super) errors: &'a [f64],
    /// Whether they are those of an impact, or next to an event that not every run has come to, and pass with it.
    pub(super) passes: bool,
}

impl Rows {
    fn len(&self) -> usize {
        self.instants.len()
    }

    fn row(&self, index: usize) -> Row<'_> {
        let ((time, passes), width) = (self.instants[index], self.errors.len() / self.len());
        Row { time, errors: &self.errors[index * width..][..width], passes }
    }

    fn first_time(&self) -> Option<f64> {
        self.instants.first().map(|(time, _)| *time)
    }

    fn last_time(&self) -> Option<f64> {
        self.instants.last().map(|(time, _)| *time)
    }
}

impl Errors {
    pub(super) fn of(
        run: &Run,
        checks: &[CheckRun],
        until: f64,
        formulas: &[Expr],
    ) -> Result<Self, RunError> {
        let mut walk = Walk::new(run, checks, formulas)?;
        walk.along(0..pieces_until(run, until));
        Ok(Self { rows: walk.rows, largest: walk.largest, until })
    }

    /// Those about one time, s: as many as [`Errors::at`] needs for it.
    pub(super) fn near(
        run: &Run,
        checks: &[CheckRun],
        until: f64,
        formulas: &[Expr],
        time: f64,
    ) -> Result<Self, RunError> {
        let (pieces, count) = (&run.trajectory().pieces, pieces_until(run, until));
        let here = pieces[..count].partition_point(|piece| piece.end < time);
        let mut reach = 1;
        loop {
            let (first, last) = (here.saturating_sub(reach), (here + 1 + reach).min(count));
            let mut walk = Walk::new(run, checks, formulas)?;
            walk.along(first.min(last)..last);
            let is_before = first == 0 || walk.rows.first_time().is_some_and(|first| first < time);
            let is_after = last == count || walk.rows.last_time().is_some_and(|last| last > time);
            if is_before && is_after {
                return Ok(Self { rows: walk.rows, largest: walk.largest, until });
            }
            reach *= 2;
        }
    }

    /// The errors at a time, s, in the order of the formulas; `None` where nothing can be said.
    ///
    /// At an event they are the larger of those before and after it, which are rows of one time.
    pub fn at(&self, time: f64) -> Option<Vec<f64>> {
        let last = self.rows.len().checked_sub(1)?;
        let next = self.rows.instants.partition_point(|(row, _)| *row < time);
        let after = self.rows.instants.partition_point(|(row, _)| *row <= time);
        // Between two rows both count; a row at the time itself tells of it alone.
        let near = if next < after { next..after } else { next.saturating_sub(1)..after.min(last) + 1 };
        let mut near = near.map(|index| self.rows.row(index).errors);
        let mut worst = near.next()?.to_vec();
        for errors in near {
            worst.iter_mut().zip(errors).for_each(|(worst, error)| *worst = larger(*worst, *error));
        }
        (time <= self.until).then_some(worst)
    }

    /// The errors at the end; `None` where nothing can be said of it.
    pub fn last(&self) -> Option<&[f64]> {
        let last = self.rows.len().checked_sub(1)?;
        self.until.is_infinite().then(|| self.rows.row(last).errors)
    }

    /// Largest absolute value of each quantity, SI units.
    pub(super) fn largest(&self) -> &[f64] {
        &self.largest
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.rows.len()).map(|index| self.rows.row(index))
    }
}

/// How many pieces begin before a time, s.
fn pieces_until(run: &Run, until: f64) -> usize {
    run.trajectory().pieces.iter().take_while(|piece| piece.start < until).count()
}

/// The motion and its check runs, compared piece by piece.
struct Walk<'a> {
    run: &'a Run,
    observer: Observer,
    beside: Vec<Beside<'a>>,
    sizes: Recent,
    largest: Vec<f64>,
    rows: Rows,
    /// Values at the place that is looked at, and their rounding.
    here: Vec<f64>,
    rounding: Vec<f64>,
    /// Errors there.
    errors: Vec<f64>,
}

impl<'a> Walk<'a> {
    fn new(run: &'a Run, checks: &'a [CheckRun], formulas: &[Expr]) -> Result<Self, RunError> {
        Ok(Self {
            run,
            observer: run.observe(formulas)?,
            beside: checks.iter().map(|check| Beside::new(check, formulas)).collect::<Result<_, _>>()?,
            sizes: Recent::new(formulas.len()),
            largest: vec![0.0; formulas.len()],
            rows: Rows::default(),
            here: vec![],
            rounding: vec![],
            errors: vec![],
        })
    }

    /// Makes the rows of these pieces. Of those before them only the last ones count.
    fn along(&mut self, wanted: Range<usize>) {
        let run = self.run;
        for (index, piece) in run.trajectory().pieces[..wanted.end].iter().enumerate() {
            let phases: Option<Vec<[Stretch; 2]>> =
                self.beside.iter_mut().map(|check| check.phase(piece)).collect();
            let Some(phases) = phases else { break };
            if index + RECENT >= wanted.start {
                self.step(piece, &phases, wanted.contains(&index));
            }
        }
    }

    fn step(&mut self, piece: &Piece, phases: &[[Stretch; 2]], is_wanted: bool) {
        let mode = &self.run.trajectory().modes[piece.mode];
        // What is off while all is still stays so, whatever it was on the way: velocities are none.
        if mode.still.len() == mode.bodies.len() {
            self.sizes.forget();
            self.beside.iter_mut().for_each(Beside::forget);
        }
        self.sizes.advance();
        let steps = self.beside.iter_mut().map(|check| check.advance(piece)).max();
        let is_pressed = mode.pressed().next().is_some();
        let stays = |check: &Beside<'_>, [here, _]: &[Stretch; 2]| {
            let is_impact = is_pressed && here.end - here.start < BRIEF * check.longest;
            !is_impact && !here.ends_zeno_sequence
        };
        let stays: Vec<bool> =
            self.beside.iter().zip(phases).map(|(check, phase)| stays(check, phase)).collect();
        let parts = steps.unwrap_or(0).max(PARTS);
        for at in places(piece, parts) {
            let passes = self.compare(at, phases, &stays).filter(|_| is_wanted);
            if let Some(passes) = passes {
                self.rows.instants.push((at.0, passes));
                self.rows.errors.extend_from_slice(&self.errors);
            }
        }
    }

    /// Finds the errors at an instant, and whether they pass; `None` where not all runs come to it.
    fn compare(&mut self, at: (f64, Side), phases: &[[Stretch; 2]], stays: &[bool]) -> Option<bool> {
        if !self.observer.at_into(at.0, at.1, &mut self.here) {
            return None;
        }
        for (index, value) in self.here.iter().enumerate().filter(|(_, value)| value.is_finite()) {
            self.sizes.add(index, value.abs());
            self.largest[index] = self.largest[index].max(value.abs());
        }
        self.rounding.clear();
        self.rounding.extend(self.sizes.largest.iter().map(|size| ULPS * f64::EPSILON * size));
        self.errors.clone_from(&self.rounding);
        let (mut is_compared, mut passes) = (true, false);
        for ((check, phase), stays) in self.beside.iter_mut().zip(phases).zip(stays) {
            match check.raise(&mut self.errors, (&self.here, &self.rounding), *phase, at, *stays) {
                None => is_compared = false,
                Some(pass) => passes |= pass,
            }
        }
        is_compared.then_some(passes)
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
    let mut compared = Compared::new(check, std::slice::from_ref(formula))?;
    let is_there = compared.look(stretch, at);
    Ok(is_there.then(|| check.safety * compared.difference(0, value).0))
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
