//! Motions that rigid bodies with friction allow at an instant, where several are possible: what contacts do in each of them.

use tumble_expr::Expr;
use tumble_mech::{Beyond, Others, PossibleContact, PossibleMotions};
use tumble_ode::Side;
use tumble_scene::Study;

use super::said::{Said, with_digits};
use crate::fill::words::{Course, contacts_that};
use crate::report::Text;
use crate::results::{Case, CaseError};

/// The first instant at which there are several, and how many there are besides.
pub(super) fn of(study: &Study, case: &Case) -> Result<Option<Said>, CaseError> {
    let instants: Vec<(f64, &PossibleMotions)> = (case.run.events())
        .flat_map(|event| event.record.others.iter().map(move |others| (event.time, others)))
        .filter_map(|(time, others)| match others {
            Others::Possible(motions) => Some((time, motions)),
            Others::Unexamined => None,
        })
        .collect();
    let Some(((time, motions), later)) = instants.split_first() else { return Ok(None) };
    let error = case.trust.as_ref().and_then(|trust| trust.event_error(&case.run, *time));
    let value = with_digits(*time, error, "s").and(" on: ").and(listed(study, case, *time, motions)?);
    let besides = match later.len() {
        0 => Text::default(),
        1 => "; so they could at one later instant".into(),
        count => format!("; so they could at {count} later instants").into(),
    };
    let before = format!("Rigid bodies with friction could go on in {} from ", counted(motions));
    Ok(Some(Said::new(before, value.and(besides)).leading()))
}

/// `3 ways`
fn counted(of: &PossibleMotions) -> String {
    match (of.motions.len(), of.beyond) {
        (1, Beyond::None) => "one way".to_owned(),
        (count, Beyond::None) => format!("{count} ways"),
        (_, Beyond::Between | Beyond::LargerForces) => "many ways".to_owned(),
    }
}

/// `the foot sticks to the floor, as this run goes on; or the foot leaves the floor`
fn listed(study: &Study, case: &Case, time: f64, of: &PossibleMotions) -> Result<String, CaseError> {
    let mut ways = vec![];
    for (index, motion) in of.motions.iter().enumerate() {
        let taken = if of.taken == Some(index) { ", as this run goes on" } else { "" };
        ways.push(format!("{}{taken}", motion_in_words(study, case, time, motion)?));
    }
    let beyond = match of.beyond {
        Beyond::None => "",
        Beyond::Between => "; or what is between these",
        Beyond::LargerForces => "; or with larger forces",
    };
    Ok(format!("{}{beyond}", ways.join("; or ")))
}

fn motion_in_words(
    study: &Study,
    case: &Case,
    time: f64,
    motion: &[PossibleContact],
) -> Result<String, CaseError> {
    let equations = &case.run.equations;
    let tangents: Vec<Expr> = (motion.iter())
        .flat_map(|contact| {
            let tangent = equations.pairs()[contact.pair].tangent();
            [tangent.x().clone(), tangent.y().clone()]
        })
        .collect();
    let there = case.run.observe(&tangents)?.at(time, Side::After).unwrap_or_default();
    let courses = motion.iter().zip(there.chunks(2)).map(|(contact, tangent)| Course {
        pair: contact.pair,
        does: contact.does,
        forward: [tangent[0], tangent[1]],
    });
    Ok(contacts_that(study, equations, courses))
}
