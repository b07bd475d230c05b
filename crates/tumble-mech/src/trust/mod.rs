//! How far a motion can be trusted: a second, independent run beside it.
//!
//! # Law
//! The second run is held to another tolerance, so that it has another order and takes other steps, and it starts a few
//! roundings away. Two such runs differ by the error of the coarser one, and by what the motion makes of roundings. The
//! error stated of a quantity f at t is
//!
//! ```text
//! SAFETY max(d(t), max over t' <= t of c(t'))  +  (ROUNDINGS eps + q) max over t' <= t of |f1(t')|
//! ```
//!
//! with d the difference at equal times; c the smaller of d and the difference at equal times since the last event, zero
//! while a surface that gives way is hit, for a time much shorter than other phases: a blow that comes a little late spoils
//! no digits after it; and q the change that the last doubling of Gauss nodes made, where there are lines of them.
//!
//! # Symbols and units
//! f as the quantity; t, s; eps the spacing of doubles at 1.
//!
//! # Sign and frame
//! Errors have no sign; they are in the frame of their quantity.
//!
//! # Validity
//! The runs are compared between events that both have. Next to an event, where one run is before it and the other past it,
//! there is no d. Events that only record are not compared: they change nothing. A cascade of impacts is one event. From the first event that only one of them has, or once the error of a
//! state is [`LOST`] of its scale, nothing is stated: that is the [`Horizon`].
//!
//! # Source
//! Differences of runs at two tolerances: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.4. The
//! factors are calibrated by tests.
//!
//! # Checked by
//! `tests/trust.rs`: the error stated is never less than the true one where that is known, and no more than some digits
//! larger.

mod errors;
mod phases;

use std::ops::ControlFlow;

use tumble_expr::Expr;
use tumble_ode::{Accuracy, Side};

use crate::coordinates::Measure;
use crate::ledger::{Entry, Ledger};
use crate::model::Model;
use crate::parameters::Parameters;
use crate::run::{Run, RunError};
pub use errors::Errors;
use phases::{Phases, phases};

/// The difference of two runs may be small by accident at one time and for one quantity; calibrated by the tests.
const SAFETY: f64 = 4.0;
/// Roundings that any value has by being computed from states.
const ROUNDINGS: f64 = 8.0;
/// An error of this part of the scale leaves not one digit.
const LOST: f64 = 0.1;
/// The start of the second run is off by this part of each state.
const NUDGE: f64 = 4.0 * f64::EPSILON;
/// A motion that does not come up to the accuracy asked for is found again at most so many times, ever tighter.
const MOST_REPEATS: usize = 2;
/// Repeating helps only where it makes the error this much smaller: else it is rounding that is in the way.
const GAIN: f64 = 0.5;

/// What a second run says of a motion.
#[derive(Clone, Debug)]
pub struct Trust {
    second: Box<Run>,
    phases: Phases,
    /// Accuracy that was asked for.
    pub asked: f64,
    /// Accuracy that steps were held to in the end: finer than what was asked for, where that was not enough.
    pub used: f64,
    /// Largest error of a position, an angle or a rate, in units of its scale, up to the end or the horizon.
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
    pub reason: Parting,
}

/// Why two runs of one motion tell nothing of each other any more.
#[derive(Clone, Debug, PartialEq)]
pub enum Parting {
    /// They differ by so much that no digit is left.
    Grown,
    /// What happens next is not the same in both.
    Events {
        /// What happens in the motion; nothing, if it is only in the second run that something does.
        first: Vec<String>,
        /// What happens in the second run.
        second: Vec<String>,
    },
    /// The second run was refused here.
    Refused,
}

impl std::fmt::Display for Parting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let list = |tags: &[String]| if tags.is_empty() { "nothing".to_owned() } else { tags.join(", ") };
        match self {
            Self::Grown => write!(f, "two runs that began alike have come apart"),
            Self::Events { first, second } => {
                write!(f, "{} happens, and {} in a run that began alike", list(first), list(second))
            }
            Self::Refused => write!(f, "a run that began alike was refused"),
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
        let at = |held: Accuracy| {
            let run = Self::refined(model.clone(), parameters, until, held, &progress)?;
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
        let second = match second(run, parameters, until, used.independent(), progress) {
            Err(error) if error.is_interrupted() => return Err(error),
            Err(RunError::Refused { partial, .. }) => *partial,
            other => other?,
        };
        let phases = phases(run, &second);
        let (asked, used) = (asked.value(), used.value());
        let mut trust = Self {
            horizon: phases.parting.clone(),
            second: Box::new(second),
            phases,
            asked,
            used,
            reached: 0.0,
        };
        trust.measure(run)?;
        Ok(trust)
    }

    /// Finds how large the errors of the states become, and when they are lost.
    fn measure(&mut self, run: &Run) -> Result<(), RunError> {
        let errors = self.errors(run, &kinematics(run))?;
        let scales = scales(run, &errors);
        let scale = |index: usize| scales[index % MEASURES.len()];
        for (time, row) in errors.rows() {
            let relative = row.iter().enumerate().filter(|(_, error)| **error != 0.0);
            let worst = relative.map(|(index, error)| error / scale(index)).fold(0.0, errors::larger);
            if worst.is_nan() || worst >= LOST {
                self.horizon = Some(Horizon { time, reason: Parting::Grown });
                break;
            }
            self.reached = worst;
        }
        Ok(())
    }

    /// Whether the accuracy asked for holds to the end.
    pub fn is_reached(&self) -> bool {
        self.horizon.is_none() && self.reached <= self.asked
    }

    /// Errors of formulas of the motion along it; `run` is the motion that this is about.
    pub fn errors(&self, run: &Run, formulas: &[Expr]) -> Result<Errors, RunError> {
        Errors::of(run, &self.second, &self.phases, self.end(), formulas)
    }

    /// Error of the time of an event, s; `None` where nothing can be said of it.
    pub fn event_error(&self, time: f64) -> Option<f64> {
        let changing = self.phases.all.iter().map(|[here, there]| [here.end, there.end]);
        let [here, there] =
            changing.chain(self.phases.recorded.iter().copied()).find(|[here, _]| *here == time)?;
        let apart = (here - there).abs();
        (time < self.end()).then_some(SAFETY * apart + ROUNDINGS * f64::EPSILON * time)
    }

    /// Errors of the works of a ledger's entries up to a time, s, J; `None` where nothing can be said of them.
    pub fn work_errors(
        &self,
        ledger: &mut Ledger<'_>,
        time: f64,
        side: Side,
    ) -> Result<Option<Vec<f64>>, RunError> {
        let Some(since) = self.phases.counterpart(time, side).filter(|_| time <= self.end()) else {
            return Ok(None);
        };
        let mut second = Ledger::of(&self.second, ledger.about)?;
        let (Some(here), Some(there)) = (ledger.at(time, side)?, second.at(since, side)?) else {
            return Ok(None);
        };
        let key = |entry: &Entry| (entry.load.clone(), entry.body, entry.kind);
        let error = |(entry, work): (&Entry, &f64)| {
            let others = second.entries.iter().zip(&there.work);
            let other = others.filter(|(other, _)| key(other) == key(entry)).map(|(_, work)| work).next();
            let apart = other.map_or(f64::INFINITY, |other| (work - other).abs());
            SAFETY * apart + ROUNDINGS * f64::EPSILON * work.abs()
        };
        Ok(Some(ledger.entries.iter().zip(&here.work).map(error).collect()))
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

/// The same motion from nearly the same start, to another accuracy.
fn second(
    run: &Run,
    parameters: &Parameters,
    until: f64,
    accuracy: Accuracy,
    progress: impl Fn(f64) -> ControlFlow<()>,
) -> Result<Run, RunError> {
    let mut start = run.equations.start(parameters)?;
    for state in &mut start.states {
        *state *= 1.0 + NUDGE;
    }
    let found = Run::from_start(run.equations.clone(), start, until, accuracy, &progress);
    match found {
        Err(error) if error.is_interrupted() => Err(error),
        Err(RunError::Refused { partial, .. }) if partial.trajectory.pieces.is_empty() => {
            Run::new(run.equations.clone(), parameters, until, accuracy, progress)
        }
        found => found,
    }
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
