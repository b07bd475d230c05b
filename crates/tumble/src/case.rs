//! The runs of a study: one, or one for every combination of what is swept.

use tumble_mech::{Equilibrium, Parameters, Run, RunError, Trust};
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
struct Values {
    label: String,
    parameters: Parameters,
    accuracy: Accuracy,
}

impl Values {
    /// Those that the study has itself.
    fn of(study: &Study) -> Self {
        Self { label: String::new(), parameters: study.model.parameters.clone(), accuracy: study.accuracy }
    }

    /// Puts in a value of a sweep.
    fn set(&mut self, study: &Study, axis: &SweepAxis, value: SweepValue) -> Result<(), PipelineError> {
        match &axis.of {
            Swept::Parameter(name) => {
                let set = self.parameters.set(name, value.value);
                set.map_err(tumble_mech::ModelErrors::from)?;
            }
            Swept::Accuracy => self.accuracy = Accuracy::new(study.number(&value.value)?)?,
        }
        Ok(())
    }
}

/// Every combination of what is swept, each made when it is asked for; the last axis changes fastest.
struct Combinations<'a>(&'a Study);

impl<'a> Combinations<'a> {
    /// Refuses what no run can be made with, before any is begun.
    fn of(study: &'a Study) -> Result<Self, PipelineError> {
        for axis in &study.sweep {
            let mut values = Values::of(study);
            axis.values.iter().try_for_each(|value| values.set(study, axis, value))?;
        }
        Ok(Self(study))
    }

    fn count(&self) -> usize {
        self.0.sweep.iter().map(|axis| axis.values.count()).product()
    }

    /// A value of each axis, by its place there.
    fn choice(&self, index: usize) -> impl Iterator<Item = (&'a SweepAxis, usize)> {
        let mut inner = self.count();
        self.0.sweep.iter().map(move |axis| {
            let outer = inner;
            inner /= axis.values.count();
            (axis, index % outer / inner)
        })
    }

    fn label(&self, index: usize) -> String {
        let labels: Vec<String> = self.choice(index).map(|(axis, place)| axis.values.label(place)).collect();
        labels.join(", ")
    }

    fn values(&self, index: usize) -> Result<Values, PipelineError> {
        let mut values = Values { label: self.label(index), ..Values::of(self.0) };
        self.choice(index).try_for_each(|(axis, place)| values.set(self.0, axis, axis.values.at(place)))?;
        Ok(values)
    }
}

/// Makes the runs of a study on so many cores as the options say, and has each that was made kept, in order: what `done` made of
/// it. What comes out does not depend on the number of cores: of several runs that fail the first is told.
///
/// The runs that were not made, because no more were wanted.
pub(crate) fn all<T: Send>(
    study: &Study,
    options: &Options,
    done: impl Fn(Case) -> Result<T, PipelineError> + Sync,
    keep: impl FnMut(T) -> Result<(), PipelineError> + Send,
) -> Result<Vec<Missing>, PipelineError> {
    let all = Combinations::of(study)?;
    let progress = Progress::new(&study.title, all.count(), options);
    let make = |index: usize| {
        let run = (index + 1, all.values(index)?);
        let kept = done(Case::run(study, run, &progress)?)?;
        progress.finish();
        Ok(kept)
    };
    let mut made = Made { all: &all, keep, count: 0, missing: vec![], error: None };
    jobs::in_order(all.count(), options.jobs, make, |index, run| made.take(index, run));
    made.end()
}

/// What became of the runs so far.
struct Made<'a, F> {
    all: &'a Combinations<'a>,
    keep: F,
    /// How many were made.
    count: usize,
    missing: Vec<Missing>,
    error: Option<PipelineError>,
}

impl<F> Made<'_, F> {
    fn take<T>(&mut self, index: usize, run: Option<Result<T, PipelineError>>)
    where
        F: FnMut(T) -> Result<(), PipelineError>,
    {
        match run {
            _ if self.error.is_some() => {}
            Some(Ok(run)) => {
                self.count += 1;
                self.error = (self.keep)(run).err();
            }
            // One after the other it would not have been begun.
            Some(Err(error)) if !error.is_interruption() && self.missing.is_empty() => {
                self.error = Some(error)
            }
            _ => self.missing.push(Missing { number: index + 1, label: self.all.label(index) }),
        }
    }

    fn end(self) -> Result<Vec<Missing>, PipelineError> {
        match self.error {
            Some(error) => Err(error),
            None if self.count == 0 => Err(PipelineError::Interrupted),
            None => Ok(self.missing),
        }
    }
}

impl Case {
    /// Integrates one run and holds the scene's claims against it.
    ///
    /// A motion that is refused on the way is no error: what was found before stands.
    fn run(
        study: &Study,
        (number, values): (usize, Values),
        progress: &Progress,
    ) -> Result<Self, PipelineError> {
        let label = values.label.clone();
        let made = Self::made(study, (number, values), progress);
        made.map_err(|error| error.placed(study).in_run(&label))
    }

    fn made(
        study: &Study,
        (number, values): (usize, Values),
        progress: &Progress,
    ) -> Result<Self, PipelineError> {
        let Values { label, parameters, accuracy } = values;
        let study = &study.with(&parameters);
        let until = study.number(&study.until)?;
        let progress = progress.of_run(until);
        let reached = |time| progress.reached(time);
        let equations = study.equations().with(&parameters)?;
        let found = Run::trusted_of(&equations, &parameters, until, accuracy, reached);
        let (run, trust, refusal) = match found {
            Ok((run, trust)) => (run, Some(trust), None),
            Err(error) if error.is_interrupted() => return Err(PipelineError::Interrupted),
            Err(RunError::Refused { refusal, partial }) if !partial.is_empty() => {
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
            equilibrium: None,
            said: Diagnostics::default(),
            balance: None,
        };
        case.finds = questions::finds(study, &case)?;
        case.checks = checks::evaluate(study, &case)?;
        case.said = placed::said(study, &case)?;
        if study.equilibrium {
            case.find_equilibrium(study);
        }
        Ok(case)
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

/// The folder of the tables of a run.
pub(crate) fn folder(number: usize) -> String {
    format!("run-{number:03}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_axis_changes_fastest() {
        let scene = r#"
            version = 1
            run.until = "1 s"
            world.gravity = "9.81 m/s^2"
            [parameters]
            a = 1
            b = 1
            [body.stone]
            point = {}
            mass = "a*b*1 kg"
            [sweep]
            a = [1, 2]
            b = [3, 4, 5]
        "#;
        let study = tumble_scene::read("scene", scene, &[]).expect("a scene without mistakes");
        let all = Combinations::of(&study).expect("values that can be set");
        let labels: Vec<String> = (0..all.count()).map(|index| all.label(index)).collect();
        let expected =
            ["a = 1, b = 3", "a = 1, b = 4", "a = 1, b = 5", "a = 2, b = 3", "a = 2, b = 4", "a = 2, b = 5"];
        assert_eq!(labels, expected);
        assert_eq!(all.values(4).expect("a run").parameters.values().expect("numbers"), [2.0, 4.0]);
    }
}
