//! How far a motion can be trusted: independent check runs beside it.
//!
//! # Law
//! A motion is found three times more: once to a tighter tolerance, so that the order is another and the steps are others, and
//! twice to the same in shorter steps; each time from numbers that are rounded in another way, an ulp or two off in every direction, after events
//! too. Where sums stand for integrals along lines there is a run with half as many nodes besides. Runs differ by the error of the
//! coarser one, and by what the motion makes of rounding errors. The error stated of a quantity f at t is
//!
//! ```text
//! max(min(D, P), SAFETY d(t)) + noise + |f'| tau
//! D = SAFETY max(d(t), max over t' of c(t')) + ULPS eps max over t' of |f(t')|
//! P = sum over states of |f(.., x_i + e_i, ..) - f(x)|
//! ```
//!
//! with t' in the step of t and the one before it; d the largest difference to a check run at equal times; c the smaller of d and the
//! difference at equal times since the last event, zero while a compliant surface is hit, for a time much shorter than other
//! phases, and in the last impacts of a Zeno sequence: an impact that comes a little late spoils no digits after it; e_i the error D of a
//! state; noise NOISE times the largest of some rounding errors that f itself may have; tau the error of the time.
//! What is singular, or jumps, elsewhere in the run spoils D there and leaves P. The error of an event's time is SAFETY times
//! the largest difference of the times, and what rounding of the function does that is crossed.
//!
//! What an event or an extremum says is compared with what it says in each check run: SAFETY times the largest difference of f, and
//! what rounding of the instant does by the rate before it.
//!
//! # Symbols and units
//! f as the quantity; t, tau, s; x, e as the state; eps the spacing of doubles at 1.
//!
//! # Sign and frame
//! Errors have no sign; they are in the frame of their quantity.
//!
//! # Validity
//! Runs are compared between events that all have. Next to an event, where one run is before it and the other past it, there
//! is no d. Events that only record are not compared: they change nothing. A Zeno sequence of impacts is one event. From
//! the first event that only one of them has, or whose order is uncertain, or once the error of a state is [`LOST`] of its
//! scale, nothing is stated: that is the [`Horizon`].
//!
//! # Source
//! Differences of runs at two tolerances: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4. The
//! factors are calibrated.
//!
//! # Checked by
//! `tests/trust.rs` and the calibration: the error stated is not less than the true one, and no more than some digits larger.

mod beside;
mod check_run;
mod errors;
mod instant;
mod own;
mod part;
mod phases;

use std::collections::HashMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use tumble_expr::Expr;
use tumble_ode::{Accuracy, Side, Work};

use crate::balance::{Contribution, RunBalance};
use crate::cache::Cache;
use crate::equations::Equations;
use crate::model::Model;
use crate::parameters::Parameters;
use crate::run::{Run, RunError};
pub use errors::Errors;
pub use instant::{At, depends_on_motion};
use part::Part;

/// The difference of two runs may be small by accident at one time and for one quantity. Calibrated: with 2.2 two errors in a thousand are larger
/// than stated, by up to twice; with this one in some thousands.
const SAFETY: f64 = 2.9;
/// Rounding errors, in ulps, that any value has by being computed from states.
const ULPS: f64 = 4.0;
/// A motion that does not come up to the accuracy asked for is found again at most so many times, ever tighter.
const MOST_REPEATS: usize = 2;
/// Repeating helps only where it makes the error this much smaller: else it is rounding that is in the way.
const GAIN: f64 = 0.5;

/// What check runs say of a motion.
#[derive(Clone, Debug)]
pub struct Trust {
    /// The check runs, each with what its differences are multiplied with.
    checks: Vec<(Run, f64)>,
    /// By group of bodies that always move as one.
    parts: Vec<Arc<Part>>,
    /// Of several groups.
    joined: Cache<Vec<usize>, Part>,
    /// Accuracy that was asked for.
    pub asked: f64,
    /// Accuracy that steps were held to in the end: finer than what was asked for, where that was not enough.
    pub used: f64,
    /// Largest error of a position, an angle or a rate, in units of its scale, up to the end or the horizon; within impacts, where
    /// what is off passes with them, it may be larger.
    pub reached: f64,
    /// Where the first digits end, if any do before the motion does: those of bodies that nothing couples to them go on.
    pub horizon: Option<Horizon>,
}

/// The time after which nothing of a motion carries digits.
#[derive(Clone, Debug, PartialEq)]
pub struct Horizon {
    /// s
    pub time: f64,
    /// Why they end.
    pub reason: Divergence,
}

/// Divergence of the check run: why it tells nothing of the motion any more.
#[derive(Clone, Debug, PartialEq)]
pub enum Divergence {
    /// They differ by so much that no digit is left.
    Grown,
    /// What happens next is not the same in both.
    Events {
        /// What happens in the motion; nothing, if it is only in the check run that something does.
        first: Vec<String>,
        /// What happens in the check run.
        second: Vec<String>,
    },
    /// The check run was refused here.
    Refused,
}

impl std::fmt::Display for Divergence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |names: &[String]| if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
        match self {
            Self::Grown => write!(f, "the check run has diverged"),
            Self::Events { first, second } => {
                write!(f, "{} happens, and {} in the check run", list(first), list(second))
            }
            Self::Refused => write!(f, "the check run was refused"),
        }
    }
}

impl Run {
    /// Integrates as [`Run::refined`], and once more to see how far the motion can be trusted.
    ///
    /// Where the accuracy is not reached, the motion is found again at a finer one, as long as that helps.
    pub fn trusted(
        model: &Model,
        parameters: &Parameters,
        until: f64,
        accuracy: Accuracy,
        progress: impl Fn(f64) -> ControlFlow<()>,
    ) -> Result<(Self, Trust), RunError> {
        Self::trusted_of(&Equations::new(model.clone())?, parameters, until, accuracy, progress)
    }

    /// The same of equations that may be used for other motions too.
    pub fn trusted_of(
        equations: &Equations,
        parameters: &Parameters,
        until: f64,
        accuracy: Accuracy,
        progress: impl Fn(f64) -> ControlFlow<()>,
    ) -> Result<(Self, Trust), RunError> {
        let first = Self::refined_of(equations, parameters, until, accuracy, &progress)?;
        first.trusted_from(equations, parameters, until, accuracy, progress)
    }

    /// The same for a motion that was found by [`Run::refined_of`] from all of these already.
    pub fn trusted_from(
        self,
        equations: &Equations,
        parameters: &Parameters,
        until: f64,
        accuracy: Accuracy,
        progress: impl Fn(f64) -> ControlFlow<()>,
    ) -> Result<(Self, Trust), RunError> {
        let known = |run: Self, held: Accuracy| {
            let trust = Trust::of(&run, parameters, until, (accuracy, held), &progress)?;
            Ok::<_, RunError>((run, trust))
        };
        let at =
            |held: Accuracy| known(Self::refined_of(equations, parameters, until, held, &progress)?, held);
        let mut best = known(self, accuracy)?;
        for _ in 0..MOST_REPEATS {
            let held = Accuracy::new(best.1.used).map_or(accuracy, Accuracy::finer);
            if best.1.is_reached() || held.value() >= best.1.used {
                break;
            }
            // A finer attempt that is refused leaves what was found before.
            match at(held) {
                Ok(next) if next.1.is_better(&best.1) => best = next,
                Err(error) if error.is_interrupted() => return Err(error),
                _ => break,
            }
        }
        Ok(best)
    }
}

impl Trust {
    fn of(
        run: &Run,
        parameters: &Parameters,
        until: f64,
        (asked, used): (Accuracy, Accuracy),
        progress: impl Fn(f64) -> ControlFlow<()>,
    ) -> Result<Self, RunError> {
        let checks = check_run::all(run, parameters, until, used, &progress)?;
        let groups = run.groups().into_iter();
        let parts = groups.map(|groups| Part::of(run.part(&groups), &checks).map(Arc::new));
        let parts = parts.collect::<Result<Vec<_>, RunError>>()?;
        let horizons = parts.iter().filter_map(|part| part.horizon.clone());
        Ok(Self {
            horizon: horizons.min_by(|a, b| a.time.total_cmp(&b.time)),
            reached: parts.iter().map(|part| part.reached).fold(0.0, f64::max),
            checks,
            parts,
            joined: Cache::default(),
            asked: asked.value(),
            used: used.value(),
        })
    }

    /// What is known of the motion that formulas read.
    fn along(&self, run: &Run, formulas: &[Expr]) -> Result<Arc<Part>, RunError> {
        let mut groups = run.read_by(formulas);
        // What a force is depends on all that it couples.
        if formulas.iter().any(|formula| run.equations.reads_forces(formula)) {
            groups = run.all_tracks().ever_with(&groups);
        }
        self.of_groups(run, groups)
    }

    /// What is known of the motion of some groups.
    fn of_groups(&self, run: &Run, groups: Vec<usize>) -> Result<Arc<Part>, RunError> {
        match (&self.parts[..], &groups[..]) {
            ([only], _) => Ok(Arc::clone(only)),
            (parts, [one]) => Ok(Arc::clone(&parts[*one])),
            (parts, several) => {
                let some: Vec<&Part> = several.iter().map(|group| &*parts[*group]).collect();
                self.joined.get(&groups, || Part::joined(run.part(several), &self.checks, &some))
            }
        }
    }

    /// Whether the accuracy asked for holds to the end.
    pub fn is_reached(&self) -> bool {
        self.horizon.is_none() && self.reached <= self.asked
    }

    /// Errors of formulas of the motion along it; `run` is the motion that this is about.
    pub fn errors(&self, run: &Run, formulas: &[Expr]) -> Result<Errors, RunError> {
        self.along(run, formulas)?.errors(formulas)
    }

    /// What the check runs cost.
    pub fn work(&self) -> Work {
        self.checks.iter().map(|(check, _)| check.work()).sum()
    }

    /// Time up to which anything is known of a formula of the motion, s; infinite where that is all of it.
    pub fn known_until(&self, run: &Run, formula: &Expr) -> Result<f64, RunError> {
        Ok(self.along(run, std::slice::from_ref(formula))?.end())
    }

    /// Error stated of a formula of the motion at an instant; `None` where nothing can be said of it.
    pub fn error_at(&self, run: &Run, formula: &Expr, at: At) -> Result<Option<f64>, RunError> {
        self.along(run, std::slice::from_ref(formula))?.error_at(formula, at)
    }

    /// Error stated of a formula at an instant that events or extremes say, from what it comes to in each check run at its own, and
    /// from what rounding does to the instant; `None` where one of them does not come to it.
    pub fn compared(
        &self,
        run: &Run,
        formula: &Expr,
        at: At,
        of_check: impl Fn(&Run) -> Option<f64>,
    ) -> Result<Option<f64>, RunError> {
        let found: Option<Vec<f64>> = self.checks.iter().map(|(check, _)| of_check(check)).collect();
        let Some(found) = found else { return Ok(None) };
        self.along(run, std::slice::from_ref(formula))?.compared(formula, at, &found)
    }

    /// Error of a number that each run comes to by itself, from the differences of the check runs; `None` where one of them does not come to it.
    pub fn off(&self, value: f64, of_check: impl Fn(&Run) -> Option<f64>) -> Option<f64> {
        let mut checks = self.checks.iter();
        checks.try_fold(0.0, |worst: f64, (check, safety)| {
            Some(worst.max(safety * (of_check(check)? - value).abs()))
        })
    }

    /// Error of the time of an event of the motion, s; `None` where nothing can be said of it.
    ///
    /// What the check runs are off by, and what rounding of the function that was crossed may have done.
    pub fn event_error(&self, run: &Run, time: f64) -> Option<f64> {
        let own: Vec<&Arc<Part>> = self.parts.iter().filter(|part| part.has_event(time)).collect();
        let errors = match own.is_empty() {
            true => self.parts.iter().filter_map(|part| part.event_error(time)).reduce(f64::max),
            false => {
                own.into_iter().try_fold(0.0, |worst: f64, part| Some(worst.max(part.event_error(time)?)))
            }
        };
        Some(errors? + Self::event_blur(run, time))
    }

    /// What rounding of the function that was crossed, and of the time itself, may have done to the time of an event, s.
    pub fn event_blur(run: &Run, time: f64) -> f64 {
        run.tracks().map(|track| part::event_blur(track, time)).fold(0.0, f64::max)
    }

    /// What rounding of a formula and of the states that it is of may have done to it; `None` where the motion does not come to the
    /// time. All runs may round alike what does not move, as places far from the origin.
    pub fn rounding_at(run: &Run, formula: &Expr, at: (f64, Side)) -> Result<Option<f64>, RunError> {
        instant::rounding_at(&run.along(std::slice::from_ref(formula)), formula, at)
    }

    /// What rounding may have moved the instant of an event by that its quantities are of, s: of one that is located not what its
    /// time has lost, which the step that ends there has in its length.
    pub fn instant_blur(run: &Run, time: f64) -> f64 {
        let own = run.tracks().filter(|track| part::events_at(track, time).next().is_some());
        let blur = own.map(|track| part::instant_blur(track, time)).reduce(f64::max);
        blur.unwrap_or_else(|| Self::event_blur(run, time))
    }

    /// Errors of the works of a balance's contributions up to a time, s, J; `None` where nothing can be said of them.
    pub fn work_errors(
        &self,
        run: &Run,
        balance: &mut RunBalance,
        time: f64,
        side: Side,
    ) -> Result<Option<Vec<f64>>, RunError> {
        let Some(here) = balance.at(time, side)? else { return Ok(None) };
        let known = balance.contributions.iter().zip(&here.work);
        let mut errors: Vec<f64> = known.map(|(whole, work)| whole.rounding(*work)).collect();
        let runs = run.parts();
        for own in &runs {
            let part = self.of_groups(run, own.all_tracks().groups.clone())?;
            let found = match runs.len() {
                1 => part.work_differences(balance, &here.work, (time, side))?,
                _ => {
                    let mut own = RunBalance::of(own, balance.about)?;
                    let Some(here) = own.at(time, side)? else { return Ok(None) };
                    let found = part.work_differences(&own, &here.work, (time, side))?;
                    found.map(|found| placed(balance, &own, &found))
                }
            };
            let Some(differences) = found else { return Ok(None) };
            errors.iter_mut().zip(differences).for_each(|(error, difference)| *error += difference);
        }
        Ok(Some(errors))
    }

    fn is_better(&self, other: &Self) -> bool {
        let [here, there] =
            [self, other].map(|trust| trust.horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time));
        here > there || (here == there && self.reached < GAIN * other.reached)
    }
}

/// Values of the contributions of a part's balance by those of the whole; zero of all others.
fn placed(whole: &RunBalance, part: &RunBalance, values: &[f64]) -> Vec<f64> {
    let known = part.contributions.iter().map(Contribution::key).zip(values);
    let known: HashMap<_, _> = known.collect();
    let value = |contribution: &Contribution| known.get(&contribution.key()).map_or(0.0, |value| **value);
    whole.contributions.iter().map(value).collect()
}
