//! The run of a sweep that swings farthest.

use tumble_mech::Extreme;
use tumble_scene::Study;

use super::said::with_digits;
use super::seen::Seen;
use crate::figures::{case_label, symbols};
use crate::report::Text;
use crate::results::{Case, CaseError};

/// A run this many times the median of a sweep stands out.
const STANDS_OUT: f64 = 2.0;

/// The run of a sweep that swings farthest, where it stands out.
pub(super) fn of(study: &Study, cases: &[Case]) -> Result<Option<Text>, CaseError> {
    let pivoted =
        study.model.bodies.iter().enumerate().find(|(_, body)| study.model.pivot_of(&body.name).is_some());
    let (Some((index, body)), true) = (pivoted, cases.len() >= 3) else { return Ok(None) };
    let (mut swings, mut errors) = (vec![], vec![]);
    for case in cases {
        let seen = Seen { study, case, run: &case.run, body, index };
        let (least, most) = (extreme(&seen, Extreme::Least)?, extreme(&seen, Extreme::Greatest)?);
        let error = seen.error(seen.end(), &body.kinematics().angle())?;
        swings.push(most - least);
        errors.push(error.map(|error| 2.0 * error));
    }
    let mut sorted = swings.clone();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let (farthest, widest) =
        swings.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).expect("there are runs");
    let words = Text::from(format!("{} swings farthest with ", symbols::the(&body.name)))
        .and(case_label(&cases[farthest]));
    let words = words.and(": through ").and(with_digits(*widest, errors[farthest], "rad"));
    let found = words.and(format!(", {:.1} times the median of the runs.", widest / median));
    let found = found.capitalised();
    Ok((*widest > STANDS_OUT * median).then_some(found))
}

/// The greatest or least angle.
fn extreme(seen: &Seen<'_>, which: Extreme) -> Result<f64, CaseError> {
    let peak = seen.run.extreme(&seen.body.kinematics().angle(), which, [0.0, f64::INFINITY])?;
    Ok(peak.map_or(f64::NAN, |peak| peak.value))
}
