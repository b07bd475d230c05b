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
//! phases, and in the last impacts of a Zeno sequence: an impact that comes a little late spoils no digits after it; e_i the error D of a state; noise the rounding error of f itself; tau the error of the time.
//! What is singular, or jumps, elsewhere in the run spoils D there and leaves P. The error of an event's time is SAFETY times
//! the largest difference of the times, and what rounding of the function does that is crossed.
//!
//! What an event or an extremum says is compared with what it says in each check run: SAFETY times the largest difference of f, and
//! what rounding of the instant does by the rate before it. A body that lies on a rigid surface has, besides, what rounding of the
//! forces on it may have moved it by: all runs round alike what does not move.
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
mod phases;

use std::ops::ControlFlow;

use tumble_expr::Expr;
use tumble_ode::{Accuracy, Cause, Event, Side};

use crate::balance::{Contribution, RunBalance};
use crate::coordinates::Measure;
use crate::equations::Equations;
use crate::model::Model;
use crate::parameters::Parameters;
use crate::record::Record;
use crate::run::{Run, RunError};
use check_run::CheckRun;
pub use errors::Errors;
use errors::Row;
pub use instant::{At, depends_on_motion};

/// The difference of two runs may be small by accident at one time and for one quantity; calibrated by the tests.
const SAFETY: f64 = 2.2;
/// Rounding errors, in ulps, that any value has by being computed from states.
const ULPS: f64 = 4.0;
/// An error of this part of the scale leaves not one digit.
const LOST: f64 = 0.1;
/// A motion that does not come up to the accuracy asked for is found again at most so many times, ever tighter.
const MOST_REPEATS: usize = 2;
/// Repeating helps only where it makes the error this much smaller: else it is rounding that is in the way.
const GAIN: f64 = 0.5;

/// What a check run says of a motion.
#[derive(Clone, Debug)]
pub struct Trust {
    checks: Vec<CheckRun>,
    /// Errors of places, angles and their rates, six a body.
    states: Errors,
    /// Accuracy that was asked for.
    pub asked: f64,
    /// Accuracy that steps were held to in the end: finer than what was asked for, where that was not enough.
    pub used: f64,
    /// Largest error of a position, an angle or a rate, in units of its scale, up to the end or the horizon; within impacts, where
    /// what is off passes with them, it may be larger.
    pub reached: f64,
    /// Where the digits end, if they do before the motion does.
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
        let at = |held: Accuracy| {
            let run = Self::refined_of(equations, parameters, until, held, &progress)?;
            let trust = Trust::of(&run, parameters, until, (accuracy, held), &progress)?;
            Ok::<_, RunError>((run, trust))
        };
        let mut best = at(accuracy)?;
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
        let checks = CheckRun::all(run, parameters, until, used, &progress)?;
        let horizons = checks.iter().filter_map(|check| check.phases.divergence.clone());
        let horizon = horizons.min_by(|a, b| a.time.total_cmp(&b.time));
        let end = horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time);
        let states = Errors::of(run, &checks, end, &kinematics(run))?;
        let (asked, used) = (asked.value(), used.value());
        let mut trust = Self { horizon, checks, states, asked, used, reached: 0.0 };
        trust.measure(run);
        Ok(trust)
    }

    /// Finds how large the errors of the states become, and when they are lost. What rounding errors of the rates may have
    /// done is no motion, and its digits are not counted; nor are those of impacts, which pass with them.
    fn measure(&mut self, run: &Run) {
        let scales = scales(run, &self.states);
        let rounding = MEASURES.map(|measure| {
            let floor = run.trajectory.rounding.get(measure as usize).copied().unwrap_or(0.0);
            SAFETY * ULPS * floor
        });
        for Row { time, errors, .. } in self.states.rows().filter(|row| !row.passes) {
            // What is no number counts.
            let is_motion =
                |index: usize, error: f64| error.is_nan() || error > rounding[index % MEASURES.len()];
            let counted = errors.iter().enumerate().filter(|(index, error)| is_motion(*index, **error));
            let relative = counted.map(|(index, error)| error / scales[index % MEASURES.len()]);
            let worst = relative.fold(0.0, errors::larger);
            if worst.is_nan() || worst >= LOST {
                self.horizon = Some(Horizon { time, reason: Divergence::Grown });
                break;
            }
            self.reached = self.reached.max(worst);
        }
    }

    /// Whether the accuracy asked for holds to the end.
    pub fn is_reached(&self) -> bool {
        self.horizon.is_none() && self.reached <= self.asked
    }

    /// Errors of formulas of the motion along it; `run` is the motion that this is about.
    pub fn errors(&self, run: &Run, formulas: &[Expr]) -> Result<Errors, RunError> {
        Errors::of(run, &self.checks, self.end(), formulas)
    }

    /// Error of the time of an event of the motion, s; `None` where nothing can be said of it.
    ///
    /// What the check runs are off by, and what rounding of the function that was crossed may have done.
    pub fn event_error(&self, run: &Run, time: f64) -> Option<f64> {
        let mut off = self.checks.iter().map(|check| Some(check.safety * check.phases.off(time)?));
        let off = off.try_fold(0.0, |worst: f64, off: Option<f64>| Some(worst.max(off?)))?;
        (time <= self.end()).then_some(off + Self::event_blur(run, time))
    }

    /// What rounding of the function that was crossed, and of the time itself, may have done to the time of an event, s.
    pub fn event_blur(run: &Run, time: f64) -> f64 {
        let blurs = events_at(run, time).map(|event| event.blur);
        blurs.fold(ULPS * f64::EPSILON * time, f64::max)
    }

    /// What rounding may have moved the instant of an event by that its quantities are of, s: of one that is located not what its
    /// time has lost, which the step that ends there has in its length.
    pub fn instant_blur(run: &Run, time: f64) -> f64 {
        let is_located = |cause: &Cause| matches!(cause, Cause::Guard(_) | Cause::LazyGuard(_));
        let mut here = events_at(run, time).peekable();
        let is_found = here.peek().is_some() && here.all(|event| event.causes.iter().all(is_located));
        match run.trajectory.piece_at(time, Side::Before) {
            Some(piece) if is_found && piece.end == time && piece.time_series.is_none() => {
                let blurs = events_at(run, time).map(|event| event.blur);
                blurs.fold(ULPS * f64::EPSILON * piece.length, f64::max)
            }
            _ => Self::event_blur(run, time),
        }
    }

    /// Errors of the works of a balance's contributions up to a time, s, J; `None` where nothing can be said of them.
    pub fn work_errors(
        &self,
        balance: &mut RunBalance<'_>,
        time: f64,
        side: Side,
    ) -> Result<Option<Vec<f64>>, RunError> {
        let Some(here) = balance.at(time, side)?.filter(|_| time <= self.end()) else { return Ok(None) };
        let rounding = |(work, whole): (&f64, &Contribution)| whole.rounding(*work);
        let rounding: Vec<f64> = here.work.iter().zip(&balance.contributions).map(rounding).collect();
        let mut errors = rounding.clone();
        for check in &self.checks {
            let Some(differences) = check.work_differences(balance, &here.work, (time, side))? else {
                return Ok(None);
            };
            for (index, difference) in differences.into_iter().enumerate() {
                errors[index] = errors::larger(errors[index], check.safety * difference + rounding[index]);
            }
        }
        Ok(Some(errors))
    }

    fn is_better(&self, other: &Self) -> bool {
        let [here, there] = [self, other].map(Self::end);
        here > there || (here == there && self.reached < GAIN * other.reached)
    }

    /// Time up to which something can be said, s; infinite where that is the whole motion.
    fn end(&self) -> f64 {
        self.horizon.as_ref().map_or(f64::INFINITY, |horizon| horizon.time)
    }
}

/// The events of one time.
fn events_at(run: &Run, time: f64) -> impl Iterator<Item = &Event<Record>> {
    let events = &run.trajectory.events;
    let first = events.partition_point(|event| event.time < time);
    events[first..].iter().take_while(move |event| event.time == time)
}

/// What [`kinematics`] are measured in.
const MEASURES: [Measure; 6] =
    [Measure::Length, Measure::Length, Measure::Angle, Measure::Speed, Measure::Speed, Measure::AngularRate];

/// What their errors are relative to: the scales of the states, and at least the largest value of their kind.
fn scales(run: &Run, errors: &Errors) -> [f64; MEASURES.len()] {
    MEASURES.map(|measure| {
        let values = errors.largest().iter().enumerate();
        let same = values.filter(|(index, _)| MEASURES[index % MEASURES.len()] == measure);
        same.map(|(_, value)| *value).fold(run.trajectory.scales[measure as usize], f64::max)
    })
}

/// Place, angle and their rates of every body, six each.
fn kinematics(run: &Run) -> Vec<Expr> {
    let of = |body: &crate::Body| {
        let kinematics = body.kinematics();
        let (at, velocity) = (kinematics.position(), kinematics.velocity());
        [
            at.x().clone(),
            at.y().clone(),
            kinematics.angle(),
            velocity.x().clone(),
            velocity.y().clone(),
            kinematics.omega(),
        ]
    };
    run.equations.model().bodies.iter().flat_map(of).collect()
}
