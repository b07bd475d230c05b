//! What was found, in words: each by a rule with its threshold, and nothing where the rule does not hold.
//!
//! | finding | rule |
//! |---|---|
//! | asked | each `[find.NAME]` of the scene, first |
//! | [`throw`] | a free body's centre stops rising; how far it gets, if that is more than its own size; where it would be without air; whether air bears its weight |
//! | [`turning`] | a body has turned by at least one full turn; how far a pivoted body swings; it turns back at intervals that agree; its small swings beside the gusts |
//! | [`contacts`] | a body has touched a surface; what its first contact did to its speed and spin, and friction until it rolls, if it does; a lasting contact is lost |
//! | [`rest`] | nothing moves faster than a small part of its greatest speed, up to the end; friction holds it there |
//! | [`possible`] | rigid contacts with friction would allow other motions from an instant on: which |
//! | [`energy`] | the work of loads of one kind that have no potential is more than a part of the energies in the run; what joints pass on |
//! | [`resonance`] | nothing is asked for, and one run of a short sweep swings by much more than the median of all |
//!
//! A finding is a [`Said`]: what runs differ in stands apart, so that several runs are one sentence.

mod contacts;
mod energy;
mod possible;
mod resonance;
mod rest;
mod said;
mod seen;
mod throw;
mod turning;

use tumble_mech::Gravity;
use tumble_scene::{Question, Study, When};

use super::names::quantity;
use super::sweep;
use crate::figures::finds;
use crate::report::Text;
use crate::results::{Case, CaseError, FindResult, Runs};

use said::Said;
pub(super) use said::{ALL_VERIFIED, with_digits};
use seen::Seen;

/// So many runs are answered one by one; of more it is told in which an answer is largest and smallest.
const FEW: usize = 4;

pub(super) fn of(study: &Study, runs: Runs<'_>, told: &[&Case]) -> Result<Vec<Text>, CaseError> {
    let is_located = runs.survey.located.iter().any(|located| located.place.made > 0);
    let mut found: Vec<Text> = match runs.cases {
        few if few.len() <= FEW && !is_located => {
            said::together(&few.iter().map(|case| (case, asked(study, case))).collect::<Vec<_>>())
        }
        _ => sweep::findings(study, runs),
    };
    let own = told.iter().map(|case| Ok((*case, of_run(&study.with(&case.parameters), case)?)));
    found.extend(said::together(&own.collect::<Result<Vec<_>, CaseError>>()?));
    // What is asked for says where it swings farthest.
    if !sweep::is_long(runs.cases) && study.finds.is_empty() {
        found.splice(0..0, resonance::of(study, runs.cases)?);
    }
    Ok(found)
}

/// What the scene asks for; what it asks for at one instant is one sentence.
fn asked(study: &Study, case: &Case) -> Vec<Said> {
    let mut finds = case.finds.iter();
    let sentences = finds::at_once(study).map(|questions| {
        let answers: Vec<_> = finds.by_ref().zip(questions).collect();
        answered(study, case, &answers)
    });
    sentences.collect()
}

/// `Lowest: speed v is 2 m/s and normal force N is 5 N, at 0.4 s`
fn answered(study: &Study, case: &Case, answers: &[(&FindResult, &Question)]) -> Said {
    let (first, question) = answers[0];
    let words = Text::from(finds::called(study, question));
    let end = case.run.end().unwrap_or(f64::INFINITY);
    let words = match first.during {
        Some([from, to]) if to < end => {
            words.and(" between ").and(quantity(from, "s")).and(" and ").and(quantity(to, "s"))
        }
        Some([from, _]) => words.and(" from ").and(quantity(from, "s")).and(" on"),
        None => words,
    };
    if !first.is_reached() {
        return Said::new(words.and(": "), "not reached, its time does not come in this motion".into());
    }
    let (verb, value) = value(first);
    let others = answers[1..].iter().enumerate().map(|(index, (find, question))| {
        let between = if index + 2 == answers.len() { " and " } else { ", " };
        let (verb, value) = self::value(find);
        Text::from(between).and(finds::that(study, question)).and(format!(" {verb}")).and(value)
    });
    let values = others.fold(value, Text::and);
    // When a run ends that nothing stops is known.
    let is_told = match question.at {
        When::End => case.run.ends_at_event() && !finds::is_given(study, question),
        _ => true,
    };
    let at = if is_told { Text::from(", at ").and(quantity(first.at, "s")) } else { Text::default() };
    Said::new(words.and(format!(" {verb}")), values.and(at))
}

/// What a question has for an answer: `is `, `2 m/s`; what is said instead of a value has a verb of its own.
fn value(find: &FindResult) -> (&'static str, Text) {
    match find.open() {
        Some(open) => ("", open.into()),
        None => ("is ", with_digits(find.value, find.error, &find.unit)),
    }
}

/// What is striking in one run.
fn of_run(study: &Study, case: &Case) -> Result<Vec<Said>, CaseError> {
    let mut found = vec![];
    let falls = matches!(study.model.gravity, Gravity::Vertical(_));
    for (index, body) in study.model.bodies.iter().enumerate() {
        let is_free = study.model.pivot_of(&body.name).is_none();
        let seen = Seen { study, case, run: &case.run, body, index };
        if is_free && falls && !seen.is_jointed() {
            found.extend(throw::without_air(&seen)?);
            found.extend(throw::apex(&seen)?);
            found.extend(throw::range(&seen)?);
            found.extend(throw::terminal_speed(&seen)?);
        }
        found.extend(turning::rotations(&seen)?);
        if !is_free {
            // What is asked for says how far, in scenes that ask.
            let swings = if study.finds.is_empty() { turning::swings(&seen)? } else { None };
            found.extend(swings);
            found.extend(turning::small_swings(&seen)?);
            found.extend(turning::period(&seen)?);
        }
        found.extend(contacts::touched(&seen));
        found.extend(contacts::first_effect(&seen)?);
        found.extend(contacts::rolls(&seen)?);
        found.extend(contacts::slides(&seen));
        found.extend(contacts::lost(&seen)?);
        if let Some(rests) = rest::of(&seen)? {
            found.push(rests);
            found.extend(rest::held(&seen)?);
        }
    }
    found.extend(possible::of(study, case)?);
    found.extend(energy::of(study, case));
    found.retain(Said::is_known);
    Ok(found)
}

#[cfg(test)]
mod tests;
