//! Check runs on their way along a motion, and how far each is from it.

use std::collections::VecDeque;

use tumble_expr::Expr;
use tumble_ode::{Piece, Side};

use crate::observer::Observer;
use crate::run::RunError;
use crate::trust::check_run::CheckRun;
use crate::trust::errors::larger;
use crate::trust::phases::Stretch;

/// Steps before that of a time whose differences count: one may be small by accident, and a value too. What decays is known ever
/// better, and what was off long ago and is not now has passed.
pub(super) const RECENT: usize = 1;

/// The largest values of some quantities over the last steps.
pub(super) struct Recent {
    /// Of each step before this one.
    steps: VecDeque<Vec<f64>>,
    /// Of this step and those.
    pub(super) largest: Vec<f64>,
    /// Of this step.
    now: Vec<f64>,
}

impl Recent {
    pub(super) fn new(quantities: usize) -> Self {
        let none = vec![0.0; quantities];
        Self { steps: VecDeque::new(), largest: none.clone(), now: none }
    }

    /// Values so far do not count from now on.
    pub(super) fn forget(&mut self) {
        *self = Self::new(self.now.len());
    }

    /// Begins another step.
    pub(super) fn advance(&mut self) {
        let oldest = if self.steps.len() < RECENT { None } else { self.steps.pop_front() };
        let mut next = oldest.unwrap_or_else(|| self.now.clone());
        next.fill(0.0);
        self.steps.push_back(std::mem::replace(&mut self.now, next));
        for (index, largest) in self.largest.iter_mut().enumerate() {
            *largest = self.steps.iter().map(|step| step[index]).fold(0.0, larger);
        }
    }

    pub(super) fn add(&mut self, index: usize, value: f64) {
        self.now[index] = larger(self.now[index], value);
        self.largest[index] = larger(self.largest[index], value);
    }
}

/// A check run on its way along the motion.
pub(super) struct Beside<'a> {
    pieces: &'a [Piece],
    /// The first of its pieces that is not over, and the first that has not begun, where the last step was.
    near: [usize; 2],
    phases: std::iter::Peekable<std::slice::Iter<'a, [Stretch; 2]>>,
    safety: f64,
    compared: Compared,
    /// Differences that stay, by formula.
    differences: Recent,
    /// Of its stretches so far, s.
    pub(super) longest: f64,
}

impl<'a> Beside<'a> {
    pub(super) fn new(check: &'a CheckRun, formulas: &[Expr]) -> Result<Self, RunError> {
        Ok(Self {
            pieces: &check.run.trajectory().pieces,
            near: [0; 2],
            phases: check.phases.all.iter().peekable(),
            safety: check.safety,
            compared: Compared::new(check, formulas)?,
            differences: Recent::new(formulas.len()),
            longest: 0.0,
        })
    }

    /// Differences so far do not count from now on.
    pub(super) fn forget(&mut self) {
        self.differences.forget();
    }

    /// The stretch that a piece of the motion lies in.
    pub(super) fn phase(&mut self, piece: &Piece) -> Option<[Stretch; 2]> {
        while self.phases.next_if(|[here, _]| here.end <= piece.start).is_some() {}
        let phase = **self.phases.peek()?;
        self.longest = self.longest.max(phase[0].end - phase[0].start);
        Some(phase)
    }

    /// Begins another step; how many of its own pieces lie in it.
    pub(super) fn advance(&mut self, piece: &Piece) -> usize {
        self.differences.advance();
        let [first, beyond] = &mut self.near;
        while self.pieces.get(*first).is_some_and(|own| own.end <= piece.start) {
            *first += 1;
        }
        while self.pieces.get(*beyond).is_some_and(|own| own.start < piece.end) {
            *beyond += 1;
        }
        beyond.saturating_sub(*first)
    }

    /// Makes the errors at least as large as those that this run tells of, of values of the motion at an instant within a
    /// stretch, each with its rounding. Whether they pass; `None` where it tells of none.
    pub(super) fn raise(
        &mut self,
        errors: &mut [f64],
        (here, rounding): (&[f64], &[f64]),
        phase: [Stretch; 2],
        at: (f64, Side),
        stays: bool,
    ) -> Option<bool> {
        if !self.compared.look(phase, at) {
            return None;
        }
        for (index, error) in errors.iter_mut().enumerate() {
            let (now, later) = self.compared.difference(index, here[index]);
            if stays {
                self.differences.add(index, later);
            }
            let stated = self.safety * larger(self.differences.largest[index], now);
            *error = larger(*error, stated + rounding[index]);
        }
        Some(!stays || self.compared.same == Same::Outside)
    }
}

/// Values of a check run that belong to one time of the motion.
pub(super) struct Compared {
    observer: Observer,
    /// At the same time since the phase began.
    since: Vec<f64>,
    /// At the same time.
    at_once: Vec<f64>,
    same: Same,
}

/// Which values of a check run are those at the same time.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Same {
    /// None: it is not in the phase then.
    Outside,
    /// Those at the same time since the phase began, which is the same instant.
    Since,
    /// Others.
    AtOnce,
}

impl Compared {
    pub(super) fn new(check: &CheckRun, formulas: &[Expr]) -> Result<Self, RunError> {
        let observer = check.run.observe(formulas)?;
        Ok(Self { observer, since: vec![], at_once: vec![], same: Same::Outside })
    }

    /// Whether it has values at an instant of the motion.
    pub(super) fn look(&mut self, [here, there]: [Stretch; 2], (time, side): (f64, Side)) -> bool {
        let since = (there.start + (time - here.start)).clamp(there.start, there.end);
        let is_in = there.start <= time && time <= there.end;
        if !self.observer.at_into(since, side, &mut self.since) {
            return false;
        }
        self.same = match is_in {
            true if since == time => Same::Since,
            true if self.observer.at_into(time, side, &mut self.at_once) => Same::AtOnce,
            _ => Same::Outside,
        };
        true
    }

    /// How far a value is off now, and by how much of that it may stay so.
    pub(super) fn difference(&self, index: usize, here: f64) -> (f64, f64) {
        let since = (here - self.since[index]).abs();
        let same = match self.same {
            // Next to an event, that it comes a little late tells of no later time.
            Same::Outside => return (since, 0.0),
            Same::Since => self.since[index],
            Same::AtOnce => self.at_once[index],
        };
        let now = (here - same).abs();
        (now, if now < since { now } else { since })
    }
}
