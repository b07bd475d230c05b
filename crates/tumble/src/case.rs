//! The runs of a study: one, or one for every combination of swept parameters.

use tumble_mech::{Parameters, Run, RunError, Trust};
use tumble_ode::Refusal;
use tumble_scene::{Diagnostics, Study};

use crate::balance::CaseBalance;
use crate::checks::{self, CheckResult};
use crate::pipeline::PipelineError;
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

/// Parameters of one run, with its label.
pub(crate) struct Values {
    label: String,
    parameters: Parameters,
}

/// Every combination of the swept parameters; the last axis changes fastest.
pub(crate) fn combinations(study: &Study) -> Result<Vec<Values>, PipelineError> {
    let mut all = vec![Values { label: String::new(), parameters: study.model.parameters.clone() }];
    for axis in &study.sweep {
        let mut next = vec![];
        for values in &all {
            for value in &axis.values {
                let mut parameters = values.parameters.clone();
                parameters
                    .set(&axis.parameter, value.value.clone())
                    .map_err(tumble_mech::ModelErrors::from)?;
                let separator = if values.label.is_empty() { "" } else { ", " };
                next.push(Values {
                    label: format!("{}{separator}{}", values.label, value.label),
                    parameters,
                });
            }
        }
        all = next;
    }
    Ok(all)
}

impl Case {
    /// Integrates one run and holds the scene's claims against it.
    ///
    /// A motion that is refused on the way is no error: what was found before stands.
    pub(crate) fn run(
        study: &Study,
        number: usize,
        values: Values,
        visible: bool,
    ) -> Result<Self, PipelineError> {
        let label = values.label.clone();
        Self::made(study, number, values, visible).map_err(|error| error.placed(study).in_run(&label))
    }

    fn made(study: &Study, number: usize, values: Values, visible: bool) -> Result<Self, PipelineError> {
        let Values { label, parameters } = values;
        let study = &study.with(&parameters);
        let until = study.number(&study.until)?;
        let title = if label.is_empty() { study.title.clone() } else { label.clone() };
        let progress = Progress::new(&title, until, visible);
        let reached = |time| progress.reached(time);
        let found = Run::trusted(&study.model, &parameters, until, study.accuracy, reached);
        let (run, trust, refusal) = match found {
            Ok((run, trust)) => (run, Some(trust), None),
            Err(RunError::Refused { refusal, partial }) if !partial.trajectory.pieces.is_empty() => {
                (*partial, None, Some(refusal))
            }
            Err(error) => return Err(error.into()),
        };
        let mut case = Self {
            number,
            label,
            parameters,
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
        format!("run-{:03}", self.number)
    }
}
