//! The runs of a study: one, or one for every combination of what is swept.

use tumble_mech::{Equations, Parameters, Run, RunError, Trust};
use tumble_ode::{Accuracy, Refusal};
use tumble_scene::{Diagnostics, Study, SweepAxis, SweepValue, Swept};

use crate::balance::CaseBalance;
use crate::checks::{self, CheckResult};
use crate::jobs;
use crate::pipeline::{Options, PipelineError};
use crate::placed;
use crate::progress::Progress;
use crate::questions::{self, FindResult};

/// One run of a study, with the values it was made with.
#[derive(Debug)]
pub struct Case {
    /// Counts the runs from 1.
    pub number: usize,
    /// What is different about it, as legends say it: `T = 0.5 s`; empty where there is only one run.
    pub label: String,
    /// The parameters of this run.
    pub parameters: Parameters,
    /// What its motion was to be held to.
    pub accuracy: Accuracy,
    /// The motion, as far as it was found.
    pub run: Run,
    /// How far it can be trusted; nothing is known of a motion that stopped early.
    pub trust: Option<Trust>,
    /// Why it stopped early, if it did.
    pub refusal: Option<Refusal>,
    /// What the scene asks for.
    pub finds: Vec<FindResult>,
    /// The scene's claims, each with what was found.
    pub checks: Vec<CheckResult>,
    /// What a user should know of it.
    pub said: Diagnostics,
    /// Energy, momentum and what changed them; `None` where only numbers were asked for.
    pub balance: Option<CaseBalance>,
}

/// A motion, as one looks at it: that of a case, or a check run beside it.
#[derive(Clone, Copy)]
pub(crate) struct Solution<'a> {
    pub(crate) run: &'a Run,
    /// How far it can be trusted; nothing is known of a check run.
    pub(crate) trust: Option<&'a Trust>,
    /// Whether it has come to its end.
    pub(crate) is_whole: bool,
}

impl Case {
    /// The motion with what is known of its errors.
    pub(crate) fn solution(&self) -> Solution<'_> {
        Solution { run: &self.run, trust: self.trust.as_ref(), is_whole: self.refusal.is_none() }
    }
}

/// A run that was not made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Its number among all runs, counted from 1.
    pub number: usize,
    /// What is different about it, as legends say it.
    pub label: String,
}

/// What one run is made with, and its label.
#[derive(Clone)]
struct Values {
    label: String,
    parameters: Parameters,
    accuracy: Accuracy,
}

impl Values {
    /// The same with a value of a sweep.
    fn with(&self, study: &Study, axis: &SweepAxis, value: &SweepValue) -> Result<Self, PipelineError> {
        let mut next = self.clone();
        match &axis.of {
            Swept::Parameter(name) => {
                let set = next.parameters.set(name, value.value.clone());
                set.map_err(tumble_mech::ModelErrors::from)?;
            }
            Swept::Accuracy => next.accuracy = Accuracy::new(study.number(&value.value)?)?,
        }
        let separator = if self.label.is_empty() { "" } else { ", " };
        next.label = format!("{}{separator}{}", self.label, value.label);
        Ok(next)
    }
}

/// Every combination of what is swept; the last axis changes fastest.
fn combinations(study: &Study) -> Result<Vec<Values>, PipelineError> {
    let parameters = study.model.parameters.clone();
    let mut all = vec![Values { label: String::new(), parameters, accuracy: study.accuracy }];
    for axis in &study.sweep {
        let with =
            |values: &Values| axis.values.iter().map(|value| values.with(study, axis, value)).collect();
        let next: Vec<Vec<Values>> = all.iter().map(with).collect::<Result<_, PipelineError>>()?;
        all = next.concat();
    }
    Ok(all)
}

/// Makes the runs of a study on so many cores as the options say, `done` with each as it is finished; those that were made, and
/// those that were not because no more were wanted. What comes out does not depend on the number of cores: of several runs that
/// fail the first is told.
pub(crate) fn all(
    study: &Study,
    options: &Options,
    done: impl Fn(&mut Case) -> Result<(), PipelineError> + Sync,
) -> Result<(Vec<Case>, Vec<Missing>), PipelineError> {
    let all = combinations(study)?;
    let progress = Progress::new(&study.title, all.len(), options);
    // What the runs have in common is built once. Mistakes are told by the run that has them.
    let equations = Equations::new(study.model.clone()).ok();
    let make = |index: usize| {
        let mut case = Case::run(study, equations.as_ref(), (index + 1, all[index].clone()), &progress)?;
        done(&mut case)?;
        progress.finish();
        Ok(case)
    };
    let (mut cases, mut missing) = (vec![], vec![]);
    for (index, made) in jobs::in_order(all.len(), options.jobs, make).into_iter().enumerate() {
        let left_out = Missing { number: index + 1, label: all[index].label.clone() };
        match made {
            Some(Ok(case)) => cases.push(case),
            None | Some(Err(PipelineError::Interrupted)) => missing.push(left_out),
            // One after the other it would not have been begun.
            Some(Err(error)) if missing.is_empty() => return Err(error),
            Some(Err(_)) => missing.push(left_out),
        }
    }
    if cases.is_empty() { Err(PipelineError::Interrupted) } else { Ok((cases, missing)) }
}

impl Case {
    /// Integrates one run and holds the scene's claims against it.
    ///
    /// A motion that is refused on the way is no error: what was found before stands.
    fn run(
        study: &Study,
        equations: Option<&Equations>,
        (number, values): (usize, Values),
        progress: &Progress,
    ) -> Result<Self, PipelineError> {
        let label = values.label.clone();
        let made = Self::made(study, equations, (number, values), progress);
        made.map_err(|error| error.placed(study).in_run(&label))
    }

    fn made(
        study: &Study,
        equations: Option<&Equations>,
        (number, values): (usize, Values),
        progress: &Progress,
    ) -> Result<Self, PipelineError> {
        let Values { label, parameters, accuracy } = values;
        let study = &study.with(&parameters);
        let until = study.number(&study.until)?;
        let progress = progress.of_run(until);
        let reached = |time| progress.reached(time);
        let equations = match equations {
            Some(equations) => equations.with(&parameters)?,
            None => Equations::new(study.model.clone())?,
        };
        let found = Run::trusted_of(&equations, &parameters, until, accuracy, reached);
        let (run, trust, refusal) = match found {
            Ok((run, trust)) => (run, Some(trust), None),
            Err(error) if error.is_interrupted() => return Err(PipelineError::Interrupted),
            Err(RunError::Refused { refusal, partial }) if !partial.trajectory.pieces.is_empty() => {
                (*partial, None, Some(refusal))
            }
            Err(error) => return Err(error.into()),
        };
        let mut case = Self {
            number,
            label,
            parameters,
            accuracy,
            run,
            trust,
            refusal,
            finds: vec![],
            checks: vec![],
            said: Diagnostics::default(),
            balance: None,
        };
        case.finds = questions::finds(study, &case)?;
        case.checks = checks::evaluate(study, &case)?;
        case.said = placed::said(study, &case)?;
        Ok(case)
    }

    /// Whether the motion reached its end and every claim holds.
    pub fn is_success(&self) -> bool {
        self.refusal.is_none() && self.checks.iter().all(|check| check.holds)
    }

    /// The folder of its tables.
    pub fn folder(&self) -> String {
        folder(self.number)
    }
}

/// The folder of the tables of a run.
pub(crate) fn folder(number: usize) -> String {
    format!("run-{number:03}")
}
