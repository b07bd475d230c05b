//! What was found, in words: each by a rule with its threshold, and nothing where the rule does not hold.
//!
//! | finding | rule |
//! |---|---|
//! | asked | each `[find.NAME]` of the scene, first |
//! | apex | a free body's centre stops rising: `vy` passes zero downwards; the first [`MOST_LISTED`] |
//! | range | a free body in a vertical plane is farther from its start, to the side, than its own size |
//! | rotations | a body has turned by at least one full turn |
//! | bounces | a body has touched a surface more than once, or for a time |
//! | rest | nothing moves faster than [`AT_REST`] of its greatest speed, up to the end |
//! | energy | the work of a load that has no potential is more than [`MATTERS`] of the energies in the run |
//! | period | a pivoted body turns back at intervals that agree to [`REPEATS`] |
//! | resonance | one run of a sweep swings by [`STANDS_OUT`] times the median of all |

use tumble_expr::Expr;
use tumble_mech::{At, Body, Contact, Extreme, Gravity, Observer, Run};
use tumble_ode::Side;
use tumble_report::report::Text;
use tumble_scene::Study;

use super::names::{quantity, quantity_to};
use crate::case::Case;
use crate::digits;
use crate::figures::case_label;
use crate::pipeline::PipelineError;
use crate::questions::FindResult;
use crate::tables::equal_times;

/// Instants at which the motion is looked at.
const SAMPLES: usize = 4000;
/// Halvings that locate an instant between two samples to the last digit.
const HALVINGS: usize = 60;
/// More of one kind are counted, not listed.
const MOST_LISTED: usize = 3;
/// Part of the greatest speed below which a body rests.
const AT_REST: f64 = 1e-9;
/// Part of the energies in a run from which on the work of a load is told.
const MATTERS: f64 = 0.01;
/// Digits that are read; more are counted.
const READ: usize = 6;
/// Part of the run over which a rate is taken to tell the error of an instant.
const RATE_STEP: f64 = 1e-6;
/// Relative difference within which intervals are one period.
const REPEATS: f64 = 1e-7;
/// A run this many times the median of a sweep stands out.
const STANDS_OUT: f64 = 2.0;

pub(super) fn of(study: &Study, cases: &[Case]) -> Result<Vec<Text>, PipelineError> {
    let mut found: Vec<Text> = cases.iter().flat_map(asked).collect();
    for case in cases {
        let case_study = study.with(&case.parameters);
        for body in &study.model.bodies {
            let seen = Seen { study: &case_study, case, run: &case.run, body };
            found.extend(seen.findings()?.into_iter().map(|text| of_case(case, text)));
        }
    }
    for case in cases {
        found.extend(works(case));
    }
    found.extend(resonance(study, cases)?);
    Ok(found)
}

/// What the scene asks for.
fn asked(case: &Case) -> Vec<Text> {
    let text = |find: &FindResult| {
        let words = Text::from(format!("{}: {}", find.name.replace(['-', '_'], " "), find.that));
        let at = |words: Text| words.and(", at ").and(quantity(find.at, "s")).and(".");
        let words = match find.open() {
            _ if !find.is_reached() => words.and(": not reached, its time does not come in this motion."),
            Some(open) => at(words.and(format!(" {open}"))),
            None => at(words.and(" = ").and(with_digits(find.value, find.error, &find.unit))),
        };
        of_case(case, words)
    };
    case.finds.iter().map(text).collect()
}

/// With the label of the run, where there are several.
fn of_case(case: &Case, text: Text) -> Text {
    let label = case_label(case);
    if label.is_empty() { text } else { Text::from(label).and(": ").and(text) }
}

/// One body in one run.
struct Seen<'a> {
    study: &'a Study,
    case: &'a Case,
    run: &'a Run,
    body: &'a Body,
}

impl Seen<'_> {
    fn findings(&self) -> Result<Vec<Text>, PipelineError> {
        let is_free = self.study.model.pivot_of(&self.body.name).is_none();
        let falls = matches!(self.study.model.gravity, Gravity::Vertical(_));
        let mut found = vec![];
        if is_free && falls {
            found.extend(self.apex()?);
            found.extend(self.range()?);
        }
        found.extend(self.rotations()?);
        found.extend(self.bounces());
        found.extend(self.rest()?);
        if !is_free {
            found.extend(self.period()?);
        }
        Ok(found)
    }

    fn end(&self) -> f64 {
        self.run.end().unwrap_or(0.0)
    }

    fn values(&self, formula: &Expr) -> Result<Vec<(f64, f64)>, PipelineError> {
        let mut observer = self.run.observe(std::slice::from_ref(formula))?;
        Ok(equal_times(self.run, SAMPLES)
            .filter_map(|time| Some((time, observer.at(time, Side::After)?[0])))
            .collect())
    }

    /// Instants at which a smooth quantity passes zero downwards.
    fn falls_through_zero(&self, formula: &Expr) -> Result<Vec<f64>, PipelineError> {
        let values = self.values(formula)?;
        let mut observer = self.run.observe(std::slice::from_ref(formula))?;
        let jumps = self.jumps(&mut observer);
        let mut found = vec![];
        for pair in values.windows(2) {
            let ((mut low, before), (mut high, after)) = (pair[0], pair[1]);
            // A jump is no passing.
            let jumps = jumps.iter().any(|event| low <= *event && *event <= high);
            if jumps || !(before > 0.0 && after <= 0.0) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                let positive = observer.at(middle, Side::After).is_some_and(|values| values[0] > 0.0);
                *(if positive { &mut low } else { &mut high }) = middle;
            }
            found.push(high);
        }
        Ok(found)
    }

    /// Events at which a quantity is not continuous.
    fn jumps(&self, observer: &mut Observer) -> Vec<f64> {
        let events = self.run.events().enumerate();
        let jumps = events.filter(|(index, _)| observer.at_event(*index).is_some_and(|[a, b]| a != b));
        jumps.map(|(_, event)| event.time).collect()
    }

    fn at(&self, time: f64, formula: &Expr) -> Result<f64, PipelineError> {
        let values = self.run.observe(std::slice::from_ref(formula))?.at(time, Side::After);
        Ok(values.map_or(f64::NAN, |values| values[0]))
    }

    fn error(&self, time: f64, formula: &Expr) -> Result<Option<f64>, PipelineError> {
        let off = self.case.trust.as_ref().and_then(|trust| trust.event_error(&self.case.run, time));
        digits::error(self.case.solution(), formula, At { time, side: Side::After, off: off.unwrap_or(0.0) })
    }

    /// A value with its digits.
    fn known(&self, time: f64, formula: &Expr, unit: &str) -> Result<Text, PipelineError> {
        Ok(with_digits(self.at(time, formula)?, self.error(time, formula)?, unit))
    }

    /// An instant at which a quantity is zero, with its digits.
    fn instant(&self, time: f64, formula: &Expr) -> Result<Text, PipelineError> {
        Ok(with_digits(time, self.error_of_instant(time, formula)?, "s"))
    }

    /// The error of an instant at which a quantity is zero: that of the quantity over its rate.
    fn error_of_instant(&self, time: f64, formula: &Expr) -> Result<Option<f64>, PipelineError> {
        let step = self.end() * RATE_STEP;
        let (before, after) = ((time - step).max(0.0), (time + step).min(self.end()));
        let rate = (self.at(after, formula)? - self.at(before, formula)?) / (after - before);
        let rounding = time * f64::EPSILON;
        Ok(self.error(time, formula)?.map(|error| (error / rate).abs() + rounding))
    }

    /// The greatest or least angle.
    fn extreme(&self, which: Extreme) -> Result<f64, PipelineError> {
        let peak = self.run.extreme(&self.body.kinematics().angle(), which, [0.0, f64::INFINITY])?;
        Ok(peak.map_or(f64::NAN, |peak| peak.value))
    }

    fn name(&self) -> &str {
        &self.body.name
    }

    fn apex(&self) -> Result<Vec<Text>, PipelineError> {
        let motion = self.body.kinematics();
        let tops = self.falls_through_zero(motion.velocity().y())?;
        let mut found = vec![];
        for time in tops.iter().take(MOST_LISTED) {
            let height = self.known(*time, motion.position().y(), "m")?;
            let words = Text::from(format!("The centre of {} comes to a highest point, ", self.name()));
            let when = self.instant(*time, motion.velocity().y())?;
            found.push(words.and(height).and(", at ").and(when).and("."));
        }
        if tops.len() > MOST_LISTED {
            let more = tops.len() - MOST_LISTED;
            found.push(format!("{} comes to {more} more highest points.", self.name()).into());
        }
        Ok(found)
    }

    fn range(&self) -> Result<Option<Text>, PipelineError> {
        let x = self.body.kinematics().position().x().clone();
        let distance = self.at(self.end(), &x)? - self.at(0.0, &x)?;
        let size = self.study.number(&(self.body.reach() * 2))?;
        let words = Text::from(format!("{} gets ", self.name()));
        let side = if distance > 0.0 { " to the right of" } else { " to the left of" };
        let error = self.error(self.end(), &x)?;
        let found = words.and(with_digits(distance.abs(), error, "m")).and(side).and(" where it began.");
        Ok((distance.abs() > size.max(f64::MIN_POSITIVE)).then_some(found))
    }

    fn rotations(&self) -> Result<Option<Text>, PipelineError> {
        let angle = self.body.kinematics().angle();
        let turns = (self.at(self.end(), &angle)? - self.at(0.0, &angle)?) / std::f64::consts::TAU;
        let way = if turns > 0.0 { "counter-clockwise" } else { "clockwise" };
        let words = Text::from(format!("{} turns by ", self.name()));
        let error = self.error(self.end(), &angle)?.map(|error| error / std::f64::consts::TAU);
        let turned = with_digits(turns.abs(), error, "rev");
        Ok((turns.abs() >= 1.0).then(|| words.and(turned).and(format!(" {way}."))))
    }

    fn bounces(&self) -> Vec<Text> {
        let surfaces = self.study.model.surfaces.iter();
        surfaces.filter_map(|surface| self.bounces_on(&surface.name)).collect()
    }

    /// Each point of the body that touches counts.
    fn bounces_on(&self, surface: &str) -> Option<Text> {
        let pairs = self.run.equations.pairs();
        let place = format!("{surface}.{}.", self.name());
        let own = |contact: &Contact| pairs[contact.pair].name.starts_with(&place);
        let contacts = joined(self.run.contacts().into_iter().filter(own));
        let first = contacts.first()?;
        let by = |pair: usize| pairs[pair].name[place.len()..].to_owned();
        let mut points: Vec<String> = contacts.iter().map(|contact| by(contact.pair)).collect();
        points.sort();
        points.dedup();
        let by = points.join(", ");
        let times = match contacts.len() {
            1 => format!(" touches {surface} once, by {by}, at "),
            several => format!(" touches {surface} {several} times, by {by}, first at "),
        };
        let words = Text::from(self.name().to_owned()).and(times);
        let when = |time: f64| {
            let error = self.case.trust.as_ref().and_then(|trust| trust.event_error(&self.case.run, time));
            with_digits(time, error, "s")
        };
        let mut words = words.and(when(first.start));
        if let Some(last) = contacts.iter().rfind(|contact| contact.is_open) {
            words = words.and(", and stays from ").and(when(last.start)).and(" on");
        }
        Some(words.and("."))
    }

    fn rest(&self) -> Result<Option<Text>, PipelineError> {
        let values = self.values(&self.body.kinetic_energy())?;
        let most = values.iter().map(|(_, energy)| *energy).fold(0.0, f64::max);
        let moves = |energy: f64| energy > AT_REST * AT_REST * most;
        let last = values.iter().rposition(|(_, energy)| moves(*energy));
        Ok(match last {
            // What is at rest in the last instant only turns round there.
            Some(last) if last + 2 < values.len() && most > 0.0 => {
                let (before, after) = (values[last].0, values[last + 1].0);
                let events = self.run.events().map(|event| event.time);
                // What comes to rest by itself does so between two samples.
                let (time, error) = match events.rev().find(|time| (before..=after).contains(time)) {
                    Some(time) => (
                        time,
                        self.case.trust.as_ref().and_then(|trust| trust.event_error(&self.case.run, time)),
                    ),
                    None => (after, Some(after - before)),
                };
                let words = Text::from(format!("{} rests from ", self.name()));
                Some(words.and(with_digits(time, error, "s")).and(" on."))
            }
            _ => None,
        })
    }

    fn period(&self) -> Result<Option<Text>, PipelineError> {
        let turns = self.falls_through_zero(&self.body.kinematics().omega())?;
        let intervals: Vec<f64> = turns.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let [first, rest @ ..] = &intervals[..] else { return Ok(None) };
        let repeats = !rest.is_empty() && rest.iter().all(|next| (next - first).abs() <= REPEATS * first);
        let mean = intervals.iter().sum::<f64>() / intervals.len() as f64;
        let last = self.error_of_instant(*turns.last().unwrap_or(&0.0), &self.body.kinematics().omega())?;
        // Of the first and the last turn, each may be off.
        let error = last.map(|error| 2.0 * error / intervals.len() as f64);
        let words = Text::from(format!("{} repeats its motion every ", self.name()));
        Ok(repeats.then(|| words.and(with_digits(mean, error, "s")).and(".")))
    }
}

/// Contacts of one point that follow on each other at once, such as an impact and the rest that it leads to, as one.
fn joined(contacts: impl Iterator<Item = Contact>) -> Vec<Contact> {
    let mut found: Vec<Contact> = vec![];
    for contact in contacts {
        let before = found.iter_mut().rfind(|before| before.pair == contact.pair);
        match before.filter(|before| before.end >= contact.start) {
            Some(before) => {
                before.end = before.end.max(contact.end);
                before.is_open |= contact.is_open;
            }
            None => found.push(contact),
        }
    }
    found
}

/// A value to its verified digits, at most so many as are read, and how many those are.
fn with_digits(value: f64, error: Option<f64>, unit: &str) -> Text {
    let Some(error) = error else { return quantity(value, unit).and(" (no digit is known)") };
    if error == 0.0 {
        return quantity(value, unit);
    }
    let held = digits::digits(value, error);
    let plural = if held == 1 { "" } else { "s" };
    quantity_to(value, held.clamp(1, READ), unit).and(format!(" ({held} digit{plural})"))
}

/// Loads that have taken out or put in much energy.
fn works(case: &Case) -> Vec<Text> {
    let Some(balance) = &case.balance else { return vec![] };
    let matters = |work: f64| work.abs() > MATTERS * balance.energy.scale;
    let contributions = balance.contributions.iter().enumerate();
    let told =
        contributions.filter(|(_, (_, contribution))| contribution.counts() && matters(contribution.work));
    let text = |(index, (name, contribution)): (usize, &(String, tumble_mech::Contribution))| {
        let does = if contribution.work < 0.0 { "takes out" } else { "puts in" };
        let error = balance.work_errors.as_ref().map(|errors| errors[index]);
        let work = with_digits(contribution.work.abs(), error, "J");
        of_case(case, Text::from(format!("{name} {does} ")).and(work).and("."))
    };
    told.map(text).collect()
}

/// The run of a sweep that swings farthest, where it stands out.
fn resonance(study: &Study, cases: &[Case]) -> Result<Option<Text>, PipelineError> {
    let pivoted = study.model.bodies.iter().find(|body| study.model.pivot_of(&body.name).is_some());
    let (Some(body), true) = (pivoted, cases.len() >= 3) else { return Ok(None) };
    let (mut swings, mut errors) = (vec![], vec![]);
    for case in cases {
        let seen = Seen { study, case, run: &case.run, body };
        let (least, most) = (seen.extreme(Extreme::Least)?, seen.extreme(Extreme::Greatest)?);
        let error = seen.error(seen.end(), &body.kinematics().angle())?;
        swings.push(most - least);
        errors.push(error.map(|error| 2.0 * error));
    }
    let mut sorted = swings.clone();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let (index, widest) =
        swings.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).expect("there are runs");
    let words = Text::from(format!("{} swings farthest with ", body.name)).and(case_label(&cases[index]));
    let words = words.and(": through ").and(with_digits(*widest, errors[index], "rad"));
    let found = words.and(format!(", {:.1} times the median of the runs.", widest / median));
    Ok((*widest > STANDS_OUT * median).then_some(found))
}
