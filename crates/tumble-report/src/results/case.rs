//! The runs of a study: one, or one for every combination of what is swept.

use std::ops::ControlFlow;

use tumble_mech::{Equilibrium, Parameters, Run, RunError, Trust};
use tumble_ode::{Accuracy, Refusal};
use tumble_scene::{Diagnostics, Study};

use crate::results::checks::{self, CheckResult};
use crate::results::combinations::{Combinations, Values};
use crate::results::digits::Held;
use crate::results::error::CaseError;
use crate::results::questions::{self, FindResult};
use crate::results::survey::Survey;
use crate::results::swept::SweptAxis;
use crate::results::{CaseBalance, placed};

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
    /// The pose of equilibrium near its start, where it is asked for and there is one.
    pub equilibrium: Option<Equilibrium>,
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
    /// Time up to which its digits are verified, s: those of all bodies.
    pub(crate) fn verified_until(&self) -> f64 {
        self.trust.as_ref().map_or(f64::NEG_INFINITY, |trust| Held::of(trust).verified_until())
    }

    /// Whether digits are verified at a time, s.
    pub(crate) fn is_verified(&self, time: f64) -> bool {
        time <= self.verified_until()
    }

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

/// The runs whose motions are known, and those that were not made.
#[derive(Clone, Copy, Debug)]
pub struct Runs<'a> {
    /// With their motions.
    pub cases: &'a [Case],
    /// Not made.
    pub missing: &'a [Missing],
    /// The sweep as a whole.
    pub survey: &'a Survey,
}

impl Case {
    /// Integrates one run of all and holds the scene's claims against it. `reached` is told how far the motion is found, s, of the
    /// time that it lasts, s, and says whether it goes on.
    ///
    /// A motion that is refused on the way is no error: what was found before stands.
    pub fn run(
        all: &Combinations<'_>,
        index: usize,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<Self, CaseError> {
        Self::sketch(all, index, &reached)?.verified(all.study(), reached)
    }

    /// One run of all, of which nothing is known yet but its motion.
    pub fn sketch(
        all: &Combinations<'_>,
        index: usize,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<Self, CaseError> {
        Self::found(all.study(), (index + 1, all.values(index)?), reached)
    }

    /// The same for a run between those of a sweep, at a value of what is swept in the unit of its axis.
    pub(crate) fn run_between(
        all: &Combinations<'_>,
        axis: &SweptAxis,
        at: f64,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<Self, CaseError> {
        let values = (all.count() + 1, all.between(axis, at)?);
        Self::found(all.study(), values, &reached)?.verified(all.study(), reached)
    }

    fn found(
        study: &Study,
        (number, values): (usize, Values),
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<Self, CaseError> {
        let Values { label, parameters, accuracy } = values;
        let found = motion(study, &parameters, accuracy, reached);
        let (run, refusal) = found.map_err(|error| error.placed(study).in_run(&label))?;
        Ok(Self {
            number,
            label,
            parameters,
            accuracy,
            run,
            trust: None,
            refusal,
            finds: vec![],
            checks: vec![],
            equilibrium: None,
            said: Diagnostics::default(),
            balance: None,
        })
    }

    /// The same with all that is known of it: how far it can be trusted, the answers that the scene asks for, and its claims.
    pub fn verified(
        mut self,
        study: &Study,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<Self, CaseError> {
        let label = self.label.clone();
        let known = self.trust(study, reached).and_then(|()| self.answer(&study.with(&self.parameters)));
        known.map_err(|error| error.placed(study).in_run(&label))?;
        Ok(self)
    }

    /// Finds out how far the motion can be trusted; it is found again where it has not the accuracy.
    fn trust(
        &mut self,
        study: &Study,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<(), CaseError> {
        if self.refusal.is_some() {
            return Ok(());
        }
        let study = study.with(&self.parameters);
        let until = study.number(&study.until)?;
        let equations = study.equations().with(&self.parameters)?;
        let reached = |time| reached(time, until);
        let run = self.run.clone();
        match run.trusted_from(&equations, &self.parameters, until, self.accuracy, reached) {
            Ok((run, trust)) => (self.run, self.trust) = (run, Some(trust)),
            Err(error) => (self.run, self.refusal) = refused(error).map(|(run, why)| (run, Some(why)))?,
        }
        Ok(())
    }

    fn answer(&mut self, study: &Study) -> Result<(), CaseError> {
        self.finds = questions::finds(study, self)?;
        self.checks = checks::evaluate(study, self)?;
        self.said = placed::said(study, self)?;
        if study.equilibrium {
            self.find_equilibrium(study);
        }
        Ok(())
    }

    fn find_equilibrium(&mut self, study: &Study) {
        match self.run.equations.equilibrium(&self.parameters) {
            Ok(found) => self.equilibrium = Some(found),
            Err(reason) => {
                let mut said = study.no_equilibrium(&reason.to_string());
                placed::name_run(&mut said, &self.label);
                self.said.extend(said);
            }
        }
    }

    /// The folder of its tables.
    pub fn folder(&self) -> String {
        folder(self.number)
    }
}

/// The motion of a run, and why it stopped early, if it did.
fn motion(
    study: &Study,
    parameters: &Parameters,
    accuracy: Accuracy,
    reached: impl Fn(f64, f64) -> ControlFlow<()>,
) -> Result<(Run, Option<Refusal>), CaseError> {
    let study = study.with(parameters);
    let until = study.number(&study.until)?;
    let equations = study.equations().with(parameters)?;
    match Run::refined_of(&equations, parameters, until, accuracy, |time| reached(time, until)) {
        Ok(run) => Ok((run, None)),
        Err(error) => refused(error).map(|(run, why)| (run, Some(why))),
    }
}

/// What was found of a motion that was refused on the way, and why.
fn refused(error: RunError) -> Result<(Run, Refusal), CaseError> {
    match error {
        error if error.is_interrupted() => Err(CaseError::Interrupted),
        RunError::Refused { refusal, partial } if !partial.is_empty() => Ok((*partial, refusal)),
        error => Err(error.into()),
    }
}

/// The folder of the tables of a run.
pub fn folder(number: usize) -> String {
    format!("run-{number:03}")
}
