//! Looking at a motion where a scene asks to: at an instant, at the end, or where something is greatest or least.

use tumble_expr::{Dimension, Expr, Unit};
use tumble_mech::{At, Run, Spread};
use tumble_ode::Side;
use tumble_scene::{Question, Study, When};

use crate::results::case::{Case, Solution};
use crate::results::moments::{Moments, Timed};
use crate::results::open::{self, NO_VALUE, NOT_UNIQUE};
use crate::results::works::{self, is_work};
use crate::results::{CaseError, digits};

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
    /// From when to when a greatest or least value was looked for, s; `None` is the whole run.
    pub during: Option<[f64; 2]>,
    /// The value; not a number where the motion does not reach that time.
    pub value: f64,
    /// Error stated of it; `None` where nothing is known of it.
    pub error: Option<f64>,
    /// Where the value is not unique, what it may be; `value` is then one of many.
    pub spread: Option<Spread>,
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
        match self.spread {
            _ if !self.is_reached() => NOT_REACHED,
            Some(_) => NOT_UNIQUE,
            None if self.value.is_nan() => NO_VALUE,
            None => "found",
        }
    }

    /// What is said instead of a value, where it is not unique or there is none.
    pub fn open(&self) -> Option<String> {
        open::instead_of(self.value, self.spread.as_ref(), &self.unit)
    }
}

/// What the scene asks for in a motion.
pub(crate) fn finds(study: &Study, case: &Case) -> Result<Vec<FindResult>, CaseError> {
    let answered =
        |question| find(study, case, question).map_err(|error: CaseError| error.of_question(study, question));
    study.finds.iter().map(answered).collect()
}

fn find(study: &Study, case: &Case, question: &Question) -> Result<FindResult, CaseError> {
    let Answer { at, found, error, spread, .. } = answer(study, case, question, None)?;
    let Question { name, that, .. } = question;
    let unit = that.quantity.unit.clone();
    let during = match &question.at {
        When::Extreme { during: Some(during), .. } => {
            Moments::of(study, case.solution()).window(Some(during))?
        }
        _ => None,
    };
    let (name, that) = (name.clone(), that.text.clone());
    Ok(FindResult { name, that, unit, at, during, value: found, error, spread })
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
    /// Where what was found less what was claimed is not unique, what may be found.
    pub(crate) spread: Option<Spread>,
}

impl Answer {
    /// Of a time that does not come.
    pub(crate) const NOTHING: Self =
        Self { at: f64::NAN, found: f64::NAN, expected: f64::NAN, error: None, spread: None };
}

/// What a question comes to in a motion, beside a claim if there is one.
pub(crate) fn answer(
    study: &Study,
    case: &Case,
    question: &Question,
    claim: Option<&Expr>,
) -> Result<Answer, CaseError> {
    let Some(asked) = Asked::of(study, case.solution(), question)? else { return Ok(Answer::NOTHING) };
    let Some(Seen { mut answer, difference, blur }) = asked.seen(claim)? else { return Ok(Answer::NOTHING) };
    if let (Some(known), Some(trust)) = (answer.error, &case.trust) {
        // The same may be seen in the check runs, where it is a question of events: at each at its own.
        let of_check = |run: &Run| {
            let asked = Asked::of(study, Solution { run, trust: None, is_whole: true }, question).ok()??;
            asked.seen(claim).ok()?.map(|seen| seen.answer.found - seen.answer.expected)
        };
        let compared = match asked.margin {
            Some(_) => trust.compared(&case.run, &difference, asked.at(), of_check)?,
            None => None,
        };
        let compared = compared.zip(asked.margin).map(|(compared, margin)| margin * compared + blur);
        answer.error = Some(match compared {
            Some(compared) if asked.has_works => compared,
            Some(compared) => known.min(compared),
            None => known,
        });
    }
    Ok(answer)
}

/// A greatest value, and a work, is compared at one instant of each run, where by accident they may agree: its differences count
/// more; calibrated.
const ONE_INSTANT: f64 = 3.0;

/// What is seen at the time of a question.
struct Seen {
    answer: Answer,
    /// The formula of what was found less what was claimed.
    difference: Expr,
    /// What rounding of the times it names, and of the potentials where it names works, does to that.
    blur: f64,
}

/// A question with its time.
struct Asked<'a> {
    solution: Solution<'a>,
    moments: Moments<'a>,
    that: Timed,
    dimension: Dimension,
    time: f64,
    /// Error of the time, s; `None` where nothing is known of it.
    off: Option<f64>,
    side: Side,
    /// What its differences in the check runs are multiplied with; `None` where a time alone says what is asked for.
    margin: Option<f64>,
    has_works: bool,
    /// Whether a greatest or least value was looked for where there is none.
    is_open: bool,
}

impl<'a> Asked<'a> {
    /// `None` where its time does not come in this motion.
    fn of(study: &'a Study, solution: Solution<'a>, question: &Question) -> Result<Option<Self>, CaseError> {
        let moments = Moments::of(study, solution);
        let Some(that) = moments.known(&question.that.quantity.formula) else { return Ok(None) };
        // A motion that an event has stopped ends there; one that was refused has no end, and nobody knows what is greatest.
        let is_whole = solution.is_whole;
        let has_works = question.that.quantity.formula.symbols().iter().any(is_work);
        let names = Moments::names(&question.that.quantity.formula);
        let margin = match &question.at {
            When::Extreme { .. } => Some(ONE_INSTANT),
            _ if has_works => Some(ONE_INSTANT),
            When::End => (names || solution.run.ends_at_event()).then_some(1.0),
            When::At(instant) => (names || Moments::names(&instant.time)).then_some(1.0),
        };
        let mut is_open = false;
        let found = match &question.at {
            When::End => {
                let end = solution.run.end().filter(|_| is_whole);
                end.map(|end| (end, moments.event_error(end), question.side))
            }
            When::At(instant) => moments.time(instant)?.map(|(time, off)| (time, off, question.side)),
            When::Extreme { which, during } => match moments.window(during.as_ref())?.filter(|_| is_whole) {
                // At an extreme the value does not change with the time. Where digits end within the window it may be elsewhere.
                Some(window) => {
                    is_open = solution.run.is_open_within(&that.formula, window)?;
                    let peak = solution.run.extreme(&that.formula, *which, window)?;
                    let off = digits::are_known_to(solution, &that.formula, window[1])?.then_some(0.0);
                    peak.map(|peak| (peak.time, off, peak.side))
                }
                None => None,
            },
        };
        let dimension = question.that.quantity.dimension;
        Ok(found.map(|(time, off, side)| Self {
            solution,
            moments,
            that,
            dimension,
            time,
            off,
            side,
            margin,
            has_works,
            is_open,
        }))
    }

    /// What is found, beside a claim if there is one; `None` outside the motion.
    fn seen(&self, claim: Option<&Expr>) -> Result<Option<Seen>, CaseError> {
        let (solution, at) = (self.solution, self.at());
        let claimed = match claim {
            None => Some(Timed::plain(&(0 * Unit(self.dimension)))),
            Some(claim) => self.moments.known(claim),
        };
        let Some(claimed) = claimed else { return Ok(None) };
        // Works that both sides name are off in both alike.
        let difference = &self.that.formula - &claimed.formula;
        let Some(works) = works::of(solution, &difference, at)? else { return Ok(None) };
        let of_times = |of_that: &[Expr], of_claim: &[Expr]| -> Vec<Expr> {
            let of_that = of_that.iter().map(|other| other - &claimed.formula);
            let of_claim = of_claim.iter().map(|other| &self.that.formula - other);
            of_that.chain(of_claim).map(|other| works.put_into(&other)).collect()
        };
        let mut formulas =
            [&self.that.formula, &claimed.formula, &difference].map(|side| works.put_into(side)).to_vec();
        formulas.extend(of_times(&self.that.variants, &claimed.variants));
        formulas.extend(works.variants(&difference));
        let first_blurred = formulas.len();
        formulas.extend(of_times(&self.that.blurred, &claimed.blurred));
        formulas.extend(works.blurred(&difference));
        let Some(values) = solution.run.observe(&formulas)?.at(self.time, self.side) else { return Ok(None) };
        let off = |others: &[f64]| -> f64 { others.iter().map(|other| (other - values[2]).abs()).sum() };
        let (of_variants, blur) = (off(&values[3..first_blurred]), off(&values[first_blurred..]));
        let is_sure = self.that.is_sure && claimed.is_sure && works.is_sure();
        let difference = works.put_into(&difference);
        let depends = self.off.is_some() || !tumble_mech::depends_on_motion(solution.run, &difference);
        let error = digits::error(solution, &difference, self.at())?.filter(|_| is_sure && depends);
        let error = error.map(|error| error + of_variants);
        let (found, expected) = (values[0] + 0.0, values[1]);
        let spread = self.spread(&difference, expected)?;
        let answer =
            Answer { at: self.time, found, expected, error: error.filter(|_| spread.is_none()), spread };
        Ok(Some(Seen { answer, difference, blur }))
    }

    /// What may be found where the difference to what is expected is not unique.
    fn spread(&self, difference: &Expr, expected: f64) -> Result<Option<Spread>, CaseError> {
        if self.is_open {
            return Ok(Some(Spread { least: f64::NEG_INFINITY, greatest: f64::INFINITY }));
        }
        let spread = self.solution.run.spreads(std::slice::from_ref(difference), self.time, self.side)?[0];
        Ok(spread.map(|Spread { least, greatest }| Spread {
            least: least + expected,
            greatest: greatest + expected,
        }))
    }

    fn at(&self) -> At {
        At { time: self.time, side: self.side, off: self.off.unwrap_or(0.0) }
    }
}
