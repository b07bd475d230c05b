//! The runs that a motion is checked by.

use std::ops::ControlFlow;

use tumble_expr::Rounding;
use tumble_ode::{Accuracy, Side};

use crate::balance::{Contribution, RunBalance};
use crate::islands::Reached;
use crate::parameters::Parameters;
use crate::run::{Run, RunError};
use crate::trust::SAFETY;
use crate::trust::part::Part;
use crate::trust::phases::{Phases, phases};

/// Seeds of the ways in which check runs are rounded: one number of each hides what the others show in a few percent of all
/// cases, all three in one of ten thousands.
const SEEDS: [u64; 3] = [0x7475_6d62, 0x6c65_2121, 0x6d6f_7665];
/// Lengths of their steps: at one tolerance truncation errors of equal steps are equal, and where the errors of steps happen to
/// cancel each other in one run they do not in the others.
const STRIDES: [f64; 3] = [1.0, 0.9, 0.8];
/// Steps of a check run after which it is looked at for the first time: a shorter one costs less than looking. From then on when it is twice as long.
const FIRST_LOOK: usize = 256;
/// It goes on for so many times as long as digits did. What only one of the two runs has had by then is off by as much as its time.
const AFTERWARDS: f64 = 2.0;
/// A sum with half as many nodes is off by more than the one that is used.
const HALF_AS_MANY: f64 = 1.0;

/// A run beside the motion, and which stretches of both belong together.
#[derive(Clone, Debug)]
pub(super) struct CheckRun {
    pub(super) run: Run,
    pub(super) phases: Phases,
    /// What its differences are multiplied with.
    pub(super) safety: f64,
}

/// All that a motion is checked by, each with what its differences are multiplied with. Once the digits of all bodies have ended a check
/// run has nothing to say any more, and ends.
pub(super) fn all(
    run: &Run,
    parameters: &Parameters,
    until: f64,
    used: Accuracy,
    progress: &impl Fn(f64) -> ControlFlow<()>,
) -> Result<Vec<(Run, f64)>, RunError> {
    let mut all: Vec<(Run, f64)> = vec![];
    for ((seed, stride), accuracy) in SEEDS.into_iter().zip(STRIDES).zip([used.independent(), used, used]) {
        let other = Other { accuracy, stride, rounding: Rounding::perturbed(seed) };
        let mut use_of = UseOf::of(run, all.first());
        let found = perturbed(run, parameters, until, other, |reached| {
            progress(reached.time)?;
            use_of.after(reached)
        });
        let check = match found {
            Err(RunError::Refused { partial, .. }) if use_of.has_ended => *partial,
            Err(error) if error.is_interrupted() => return Err(error),
            Err(RunError::Refused { partial, .. }) => *partial,
            found => found?,
        };
        all.push((check, SAFETY));
    }
    all.extend(run.coarser.as_ref().map(|coarser| ((**coarser).clone(), HALF_AS_MANY)));
    Ok(all)
}

/// How long a check run on its way is of use.
struct UseOf<'a> {
    run: &'a Run,
    /// When it has none any more, as far as that is known, s.
    until: f64,
    /// Steps that it has taken, and those after which it is looked at.
    steps: usize,
    next: usize,
    has_ended: bool,
}

impl<'a> UseOf<'a> {
    /// Of a check run of a motion; by another one of the same motion, if there is one.
    fn of(run: &'a Run, other: Option<&(Run, f64)>) -> Self {
        let until = other.map_or(f64::INFINITY, |(check, _)| of_no_use(run, check));
        Self { run, until, steps: 0, next: FIRST_LOOK, has_ended: false }
    }

    /// Whether it is of use beyond what it has come to.
    fn after(&mut self, reached: Reached<'_>) -> ControlFlow<()> {
        self.steps += 1;
        if self.steps == self.next {
            self.next *= 2;
            self.until = self.until.min(of_no_use(self.run, &self.run.beside(reached.so_far())));
        }
        self.has_ended = reached.time >= self.until;
        if self.has_ended { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// When a check run is of no use any more, by as much of it as there is, s: well after the last digits have ended, so that what one of them has
/// and the other has not yet is not taken for a difference.
fn of_no_use(run: &Run, check: &Run) -> f64 {
    let end =
        |groups: &Vec<usize>| Part::of(run.part(groups), &[(check.clone(), SAFETY)]).map(|part| part.end());
    let ends: Result<Vec<f64>, RunError> = run.groups().iter().map(end).collect();
    let end = ends.map_or(f64::INFINITY, |ends| ends.into_iter().fold(0.0, f64::max));
    // That there is no more of it is no difference yet.
    if check.end().is_some_and(|known| end < known) { AFTERWARDS * end } else { f64::INFINITY }
}

impl CheckRun {
    pub(super) fn new(run: &Run, check: Run, safety: f64) -> Self {
        Self { phases: phases(run, &check), run: check, safety }
    }

    /// By how much the works of a balance's contributions are off; `None` where nothing can be said of them.
    pub(super) fn work_differences(
        &self,
        balance: &RunBalance,
        works: &[f64],
        (time, side): (f64, Side),
    ) -> Result<Option<Vec<f64>>, RunError> {
        let Some(since) = self.phases.counterpart(time, side) else { return Ok(None) };
        let mut check = RunBalance::of(&self.run, balance.about)?;
        let Some(there) = check.at(since, side)? else { return Ok(None) };
        let difference = |(contribution, work): (&Contribution, &f64)| {
            let mut others = check.contributions.iter().zip(&there.work);
            let other = others.find(|(other, _)| other.key() == contribution.key());
            // What it does not have has done no work there: at a start that is at rest but for rounding, one run may have impulses and another none.
            (work - other.map_or(0.0, |(_, other)| *other)).abs()
        };
        Ok(Some(balance.contributions.iter().zip(works).map(difference).collect()))
    }
}

/// In what a check run differs from the motion.
struct Other {
    accuracy: Accuracy,
    stride: f64,
    rounding: Rounding,
}

/// The same motion from numbers that are rounded in another way.
fn perturbed(
    run: &Run,
    parameters: &Parameters,
    until: f64,
    Other { accuracy, stride, rounding }: Other,
    mut progress: impl FnMut(Reached<'_>) -> ControlFlow<()>,
) -> Result<Run, RunError> {
    let parameters = parameters.rounded(rounding);
    let equations = run.equations.rounded(rounding);
    let mut start = equations.start(&parameters)?;
    start.stride = stride;
    // Where no step of the motion had to be cut nothing in it is narrow. A check run that passes over something all the same
    // differs from it, and the error stated says so.
    start.is_proved = run.work().cuts > 0;
    let found = Run::watched(equations.clone(), start, until, accuracy, &mut progress);
    match found {
        Err(error) if error.is_interrupted() => Err(error),
        // At the edge of what can begin, a few ulps decide: then it begins as the motion does.
        Err(RunError::Refused { partial, .. }) if partial.is_empty() => {
            let parameters = parameters.rounded(Rounding::NEAREST);
            let equations = equations.rounded(Rounding::NEAREST);
            let start = equations.start(&parameters)?;
            Run::watched(equations, start, until, accuracy, &mut progress)
        }
        found => found,
    }
}
