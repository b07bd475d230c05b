//! Looking at a motion where a scene asks to: at an instant, at the end, or where something is greatest or least.

use tumble_expr::{Dimension, Expr, Unit};
use tumble_mech::At;
use tumble_ode::Side;
use tumble_scene::{Question, Study, When};

use crate::case::Case;
use crate::digits;
use crate::moments::{Moments, Timed};
use crate::pipeline::PipelineError;
use crate::works;

/// A value that the scene asks for.
#[derive(Clone, Debug)]
pub struct FindResult {
    /// Its name in the scene.
    pub name: String,
    /// What was looked at, as the user wrote it.
    pub that: String,
    /// Unit of the value, SI where the scene asks for no other; empty where there is none.
    pub unit: String,
    /// When, s; not a number where it is an event that did not happen.
    pub at: f64,
    /// The value; not a number where the motion does not reach that time.
    pub value: f64,
    /// Error stated of it; `None` where nothing is known of it.
    pub error: Option<f64>,
}

/// What becomes of a question whose time does not come in a motion, or whose event does not happen.
pub(crate) const NOT_REACHED: &str = "not reached";

impl FindResult {
    /// Whether the motion reaches its time, and its event happens.
    pub fn is_reached(&self) -> bool {
        self.at.is_finite()
    }

    /// What becomes of the question, in a word or two.
    pub fn status(&self) -> &'static str {
        if self.is_reached() { "found" } else { NOT_REACHED }
    }
}

/// What the scene asks for in a motion.
pub(crate) fn finds(study: &Study, case: &Case) -> Result<Vec<FindResult>, PipelineError> {
    let answered = |question| {
        find(study, case, question).map_err(|error: PipelineError| error.of_question(study, question))
    };
    study.finds.iter().map(answered).collect()
}

fn find(study: &Study, case: &Case, question: &Question) -> Result<FindResult, PipelineError> {
    let asked = Asked::of(study, case, question)?;
    let answer = asked.map(|asked| asked.answer(None)).transpose()?.flatten();
    let Answer { at, found, error, .. } = answer.unwrap_or(Answer::NOTHING);
    let Question { name, that, .. } = question;
    let unit = that.quantity.unit.clone();
    Ok(FindResult { name: name.clone(), that: that.text.clone(), unit, at, value: found, error })
}

/// What a question comes to, in its unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer {
    /// s
    pub(crate) at: f64,
    pub(crate) found: f64,
    /// What was claimed; zero where nothing was.
    pub(crate) expected: f64,
    /// Error stated of what was found less what was claimed; `None` where nothing is known of it.
    pub(crate) error: Option<f64>,
}

impl Answer {
    /// Of a time that does not come.
    pub(crate) const NOTHING: Self = Self { at: f64::NAN, found: f64::NAN, expected: f64::NAN, error: None };
}

/// A question with its time.
pub(crate) struct Asked<'a> {
    case: &'a Case,
    moments: Moments<'a>,
    that: Timed,
    dimension: Dimension,
    time: f64,
    /// Error of the time, s; `None` where nothing is known of it.
    off: Option<f64>,
    side: Side,
}

impl<'a> Asked<'a> {
    /// `None` where its time does not come in this motion.
    pub(crate) fn of(
        study: &'a Study,
        case: &'a Case,
        question: &Question,
    ) -> Result<Option<Self>, PipelineError> {
        let moments = Moments::of(study, case);
        let Some(that) = moments.known(&question.that.quantity.formula) else { return Ok(None) };
        // A motion that an event has stopped ends there; one that was refused has no end, and nobody knows what is greatest.
        let is_whole = case.refusal.is_none();
        let found = match &question.at {
            When::End => {
                let end = case.run.trajectory.end().filter(|_| is_whole);
                end.map(|end| (end, moments.event_error(end), question.side))
            }
            When::At(instant) => moments.time(instant)?.map(|(time, off)| (time, off, question.side)),
            When::Extreme { which, during } => match moments.window(during.as_ref())?.filter(|_| is_whole) {
                // At an extreme the value does not change with the time.
                Some(window) => {
                    let peak = case.run.extreme(&that.formula, *which, window)?;
                    peak.map(|peak| (peak.time, Some(0.0), peak.side))
                }
                None => None,
            },
        };
        let dimension = question.that.quantity.dimension;
        Ok(found.map(|(time, off, side)| Self { case, moments, that, dimension, time, off, side }))
    }

    /// What is found, beside a claim if there is one; `None` outside the motion.
    pub(crate) fn answer(&self, claim: Option<&Expr>) -> Result<Option<Answer>, PipelineError> {
        let (case, at) = (self.case, (self.time, self.side));
        let claimed = match claim {
            None => Some(Timed { formula: 0 * Unit(self.dimension), variants: vec![], is_sure: true }),
            Some(claim) => self.moments.known(claim),
        };
        let Some(claimed) = claimed else { return Ok(None) };
        let mut is_sure = self.that.is_sure && claimed.is_sure;
        let mut known = |formula: &Expr| {
            let known = works::known(case, formula.clone(), at)?;
            is_sure &= known.as_ref().is_none_or(|known| known.is_sure);
            Ok::<_, PipelineError>(known)
        };
        let (Some(that), Some(expected)) = (known(&self.that.formula)?, known(&claimed.formula)?) else {
            return Ok(None);
        };
        let difference = &that.formula - &expected.formula;
        let of_that = that.variants.iter().cloned().chain(of_times(&mut known, &self.that)?);
        let of_that = of_that.map(|other| other - &expected.formula);
        let of_claim = expected.variants.iter().cloned().chain(of_times(&mut known, &claimed)?);
        let others = of_that.chain(of_claim.map(|other| &that.formula - other));
        let formulas: Vec<Expr> =
            [&that.formula, &expected.formula, &difference].into_iter().cloned().chain(others).collect();
        let Some(values) = case.run.observe(&formulas)?.at(self.time, self.side) else { return Ok(None) };
        let of_variants: f64 = values[3..].iter().map(|other| (other - values[2]).abs()).sum();
        let at = At { time: self.time, side: self.side, off: self.off.unwrap_or(0.0) };
        let depends = self.off.is_some() || !tumble_mech::depends_on_motion(&case.run, &difference);
        let error = digits::error(case, &difference, at)?.filter(|_| is_sure && depends);
        Ok(Some(Answer {
            at: self.time,
            found: values[0] + 0.0,
            expected: values[1],
            error: error.map(|error| error + of_variants),
        }))
    }
}

/// For each moment of a formula, the formula with that one off by its error.
fn of_times(
    known: &mut impl FnMut(&Expr) -> Result<Option<works::Known>, PipelineError>,
    timed: &Timed,
) -> Result<Vec<Expr>, PipelineError> {
    let variants = timed.variants.iter().map(|variant| Ok(known(variant)?.map(|known| known.formula)));
    let variants: Result<Vec<Option<Expr>>, PipelineError> = variants.collect();
    Ok(variants?.into_iter().flatten().collect())
}
