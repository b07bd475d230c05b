//! Rest up to the end.

use super::said::{Said, with_digits};
use super::seen::Seen;
use crate::results::CaseError;

/// Part of the greatest speed below which a body rests.
const AT_REST: f64 = 1e-9;

/// Nothing moves faster than [`AT_REST`] of its greatest speed.
pub(super) fn of(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let values = seen.values(&seen.body.kinetic_energy())?;
    let most = values.iter().map(|(_, energy)| *energy).fold(0.0, f64::max);
    let moves = |energy: f64| energy > AT_REST * AT_REST * most;
    let last = values.iter().rposition(|(_, energy)| moves(*energy));
    Ok(match last {
        // What is at rest in the last instant only turns round there.
        Some(last) if last + 2 < values.len() && most > 0.0 => {
            let (before, after) = (values[last].0, values[last + 1].0);
            let events = seen.run.events().map(|event| event.time);
            // What comes to rest by itself does so between two samples.
            let (time, error) = match events.rev().find(|time| (before..=after).contains(time)) {
                Some(time) => {
                    (time, seen.case.trust.as_ref().and_then(|trust| trust.event_error(&seen.case.run, time)))
                }
                None => (after, Some(after - before)),
            };
            let value = with_digits(time, error, "s").and(" on");
            Some(Said::new(format!("{} is at rest from ", seen.called()), value).leading())
        }
        _ => None,
    })
}
