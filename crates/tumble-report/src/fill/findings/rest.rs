//! Rest up to the end, and the friction that it needs.

use tumble_mech::Pair;
use tumble_ode::Side;

use super::said::{Said, with_digits};
use super::seen::Seen;
use crate::figures::symbols;
use crate::fill::names::quantity_to;
use crate::results::CaseError;

/// Part of the greatest speed below which a body rests.
const AT_REST: f64 = 1e-9;
/// Less than this part of what friction could be is none: rounding.
const NO_FRICTION: f64 = 1e-9;
/// Digits of forces.
const DIGITS: usize = 4;

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

/// Why it stays: by how much friction each surface that it rests on holds it, and how much there could be.
pub(super) fn held(seen: &Seen<'_>) -> Result<Vec<Said>, CaseError> {
    let forces = seen.forces(seen.end(), Side::Before)?;
    let of = |load: &str| {
        let own = forces.iter().filter(|force| force.load == load);
        own.fold([0.0, 0.0], |[x, y], force| [x + force.force[0], y + force.force[1]])
    };
    let mut found = vec![];
    for surface in &seen.study.model.surfaces {
        let place = format!("{}.{}.", surface.name, seen.name());
        let (mut along, mut most) = ([0.0, 0.0], 0.0);
        for pair in seen.run.equations.pairs().iter().filter(|pair| pair.name.starts_with(&place)) {
            let [[x, y], [normal_x, normal_y]] = [of(&friction_of(pair)), of(&pair.name)];
            let coefficient = pair.friction.as_ref().map(|friction| seen.study.number(&friction.of_rest));
            along = [along[0] + x, along[1] + y];
            most += coefficient.transpose()?.unwrap_or(0.0) * normal_x.hypot(normal_y);
        }
        let needed = along[0].hypot(along[1]);
        if needed > NO_FRICTION * most {
            let [needed, most] = [needed, most].map(|force| quantity_to(force, DIGITS, "N"));
            let before = format!("Friction holds {} on {}: ", seen.called(), symbols::the(&surface.name));
            found.push(Said::new(before, needed.and(" of at most ").and(most)));
        }
    }
    Ok(found)
}

/// The load of a pair's friction.
fn friction_of(pair: &Pair) -> String {
    format!("{}.friction", pair.name)
}
