//! A sweep as a whole: what each run has answered, and where along it an answer is greatest or least.

use std::ops::ControlFlow;

use tumble_mech::Extreme;
use tumble_scene::{Study, When};

use crate::results::finished::Finished;
use crate::results::locate::{Best, Optimum, Sample};
use crate::results::swept::SweptAxis;
use crate::results::{Case, CaseError, Combinations, FindResult};

/// What a sweep has come to. Empty where nothing is swept.
#[derive(Clone, Debug, Default)]
pub struct Survey {
    /// What is swept, the last changing fastest.
    pub axes: Vec<SweptAxis>,
    /// The answers of each run, in the order of the scene's questions; of runs that were not made, and where only numbers were asked
    /// for, none.
    pub answers: Vec<Vec<Option<Sample>>>,
    /// Where each answer is greatest and least.
    pub located: Vec<Located>,
}

/// Where along a sweep of one parameter an answer is greatest or least.
#[derive(Clone, Debug)]
pub struct Located {
    /// Name of the question.
    pub find: String,
    /// Its place among the scene's.
    pub index: usize,
    /// What was looked at, as the user wrote it, and its unit.
    pub that: String,
    /// Empty where there is none.
    pub unit: String,
    /// Which of them.
    pub which: Extreme,
    /// Whether it is what the question looks for in each run too; of others than greatest and least values, both are.
    pub is_asked: bool,
    /// What is swept, and its unit.
    pub parameter: String,
    /// Empty where there is none.
    pub parameter_unit: String,
    /// Where it is.
    pub place: Optimum,
}

/// Follows the runs of a sweep while they are made.
#[derive(Clone, Debug, Default)]
pub struct Surveyor {
    survey: Survey,
    /// Of each question the greatest and the least.
    best: Vec<[Best; 2]>,
    /// What is swept, where its runs have neighbours.
    along: Option<SweptAxis>,
    keeps_answers: bool,
}

const BOTH: [Extreme; 2] = [Extreme::Greatest, Extreme::Least];

impl Surveyor {
    /// Of no run; `keeps_answers` is whether the answers of all runs are wanted, or only the best.
    pub fn of(study: &Study, keeps_answers: bool) -> Result<Self, CaseError> {
        let axes = SweptAxis::all(study)?;
        let along = match &axes[..] {
            [only] if only.values.len() > 2 && only.is_ordered() && only.name != "accuracy" => {
                Some(only.clone())
            }
            _ => None,
        };
        let best = study.finds.iter().filter(|_| along.is_some()).map(|_| BOTH.map(Best::new)).collect();
        let keeps_answers = keeps_answers && !axes.is_empty();
        Ok(Self { survey: Survey { axes, ..Survey::default() }, best, along, keeps_answers })
    }

    /// Adds a run; they come in order.
    pub fn add(&mut self, run: &Finished) {
        let first = self.survey.axes.first();
        let at = |axis: &SweptAxis| axis.values.get(run.number - 1).copied();
        let at = first.filter(|_| self.survey.axes.len() == 1).and_then(at).unwrap_or(f64::NAN);
        let answers: Vec<_> = run.finds.iter().map(|find| sample(at, find)).collect();
        for (best, answer) in self.best.iter_mut().zip(&answers) {
            best.iter_mut().for_each(|best| best.add(*answer));
        }
        if self.keeps_answers {
            self.survey.answers.resize(run.number - 1, vec![]);
            self.survey.answers.push(answers);
        }
    }

    /// How many extremes are to be located.
    pub fn targets(&self) -> usize {
        BOTH.len() * self.best.len()
    }

    /// Locates one of them, with more runs between those that were made.
    pub fn locate(
        &self,
        all: &Combinations<'_>,
        target: usize,
        reached: impl Fn(f64, f64) -> ControlFlow<()>,
    ) -> Result<Option<Located>, CaseError> {
        let Some(axis) = &self.along else { return Ok(None) };
        let (index, side) = (target / BOTH.len(), target % BOTH.len());
        let answer = |at: f64| {
            let case = Case::run_between(all, axis, at, &reached)?;
            Ok::<_, CaseError>(case.finds.get(index).and_then(|find| sample(at, find)))
        };
        let question = &all.study().finds[index];
        let is_asked = match &question.at {
            When::Extreme { which, .. } => *which == BOTH[side],
            _ => true,
        };
        let place = self.best[index][side].locate(answer)?;
        // That many runs are as little as nothing says nothing, unless it is asked for.
        let place = place.filter(|place| is_asked || place.equal.is_none());
        Ok(place.map(|place| Located {
            find: question.name.clone(),
            index,
            that: question.that.text.clone(),
            unit: question.that.quantity.unit.clone(),
            which: BOTH[side],
            is_asked,
            parameter: axis.name.clone(),
            parameter_unit: axis.unit.clone(),
            place,
        }))
    }

    /// The whole.
    pub fn end(self, located: Vec<Located>) -> Survey {
        Survey { located, ..self.survey }
    }
}

fn sample(at: f64, find: &FindResult) -> Option<Sample> {
    let is_one = find.is_reached() && find.spread.is_none() && find.value.is_finite();
    is_one.then(|| Sample { at, value: find.value, error: find.error.unwrap_or(f64::INFINITY) })
}
