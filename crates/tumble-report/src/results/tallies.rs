//! What events have left up to an instant, by the names in finds and checks: impulses of contacts and how often something happened.

use tumble_mech::{At, Change, Happening, Impulse, Record, Run, Source, Trust};
use tumble_ode::{Occurrence, Side};
use tumble_scene::Count;

use crate::results::moments::is_part;

/// A number that the run has come to.
pub(crate) struct Tally {
    pub(crate) value: f64,
    /// What rounding does to it at least.
    pub(crate) blur: f64,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    /// Of an impact at that time, s.
    Impulse(f64),
    Count,
    /// What a Zeno sequence has infinitely often, of which the first are followed: a count, or the impulse of all the others together.
    Infinite,
}

/// Rounding errors of an impulse, which is found from a few products.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

const COUNT: &str = ".count";
const CONTACTS: &str = ".contacts";
const IMPULSE: &str = ".impulse[";

/// Whether a name is one of these.
pub(crate) fn is_tally(name: &str) -> bool {
    name.ends_with(COUNT) || name.ends_with(CONTACTS) || name.contains(IMPULSE)
}

/// What a name stands for; `None` where it has not come to that.
pub(crate) fn found(run: &Run, name: &str, at: At) -> Option<Tally> {
    let has_come = |time: f64| time < at.time || (time == at.time && at.side == Side::After);
    if let Some((place, rest)) = name.split_once(IMPULSE) {
        let (count, axis) = rest.split_once("].")?;
        return impulse(run, place, Count::read(count)?, axis);
    }
    let is_there = |pair: usize, place: &str| is_part(&run.equations.pairs()[pair].name, place);
    let (count, is_infinite) = match name.strip_suffix(CONTACTS) {
        Some(place) => {
            let contacts = run.contacts();
            let there =
                contacts.iter().filter(|contact| is_there(contact.pair, place) && has_come(contact.start));
            let mut ends = sequences(run, has_come);
            (there.count(), ends.any(|(pair, _)| is_there(pair, place)))
        }
        None => {
            let happening = run.equations.named(name.strip_suffix(COUNT)?)?;
            let own = |event: &&Occurrence<Record>| event.record.happened.contains(&happening);
            let events: Vec<f64> = run.events().filter(own).map(|event| event.time).collect();
            let goes_on = |[from, to]: [f64; 2]| events.iter().any(|time| from < *time && *time <= to);
            let mut ends = sequences(run, has_come);
            (
                events.iter().filter(|time| has_come(**time)).count(),
                ends.any(|(_, last)| last.is_some_and(goes_on)),
            )
        }
    };
    let kind = if is_infinite { Kind::Infinite } else { Kind::Count };
    Some(Tally { value: count as f64, blur: 0.0, kind })
}

/// The Zeno sequences that have ended, each with its pair and the times of the last two impacts of that.
fn sequences(run: &Run, has_come: impl Fn(f64) -> bool) -> impl Iterator<Item = (usize, Option<[f64; 2]>)> {
    let ends = run.events().filter(move |event| has_come(event.time));
    let pairs = ends.flat_map(|event| event.record.zeno_sequences().map(move |pair| (event.time, pair)));
    let last = move |(end, pair): (f64, usize)| {
        let impact = Happening::Contact { pair, change: Change::Impact };
        let before =
            run.events().filter(|event| event.time <= end && event.record.happened.contains(&impact));
        let times: Vec<f64> = before.map(|event| event.time).collect();
        (pair, times.last_chunk().copied())
    };
    pairs.map(last)
}

impl Tally {
    /// Error stated of it; `None` where nothing is known of it.
    pub(crate) fn error(&self, run: &Run, trust: &Trust, name: &str, at: At) -> Option<f64> {
        let is_before_the_end = trust.horizon.as_ref().is_none_or(|horizon| at.time <= horizon.time);
        match self.kind {
            Kind::Infinite => None,
            // What is compared with the check runs at the instant says how far it is known.
            Kind::Count => is_before_the_end.then_some(0.0),
            Kind::Impulse(time) => {
                trust.event_error(run, time)?;
                trust.off(self.value, |check| Some(found(check, name, at)?.value))
            }
        }
    }
}

/// The impulse of a contact on its body, on the first of two, N s; zero of one that begins without an impact.
fn impulse(run: &Run, place: &str, count: Count, axis: &str) -> Option<Tally> {
    let contacts = run.contacts();
    let pairs = run.equations.pairs();
    let there = contacts.iter().filter(|contact| is_part(&pairs[contact.pair].name, place));
    let contact = count.of(there)?;
    let at = || run.events().filter(|event| event.time == contact.start);
    let impulses = at().flat_map(|event| &event.record.impulses);
    let capture = run.equations.capture_of(contact.pair).map(Source::Joint);
    let sources: Vec<Source> =
        [Source::Pair(contact.pair), Source::Friction(contact.pair)].into_iter().chain(capture).collect();
    let body = pairs[contact.pair].body;
    let own = impulses.filter(|impulse| impulse.body == body && sources.contains(&impulse.source));
    let [x, y] = own.fold([0.0, 0.0], |[x, y], Impulse { impulse, .. }| [x + impulse[0], y + impulse[1]]);
    let size = (x * x + y * y).sqrt();
    let value = match axis {
        "x" => x,
        "y" => y,
        _ => size,
    };
    // Far from the origin all runs round alike the places that the normal is found from.
    let normal = &pairs[contact.pair].normal;
    let rounding =
        |axis: usize| Trust::rounding_at(run, &normal[axis], (contact.start, Side::Before)).ok()?;
    let turned = rounding(0)?.hypot(rounding(1)?);
    // From there on bounces are not followed one by one, and those after them have other numbers than they would have.
    let begins = at().any(|event| event.record.zeno_sequences().next().is_some());
    let mut ended = sequences(run, |time| time <= contact.start);
    let is_numbered = matches!(count, Count::Nth(_));
    let is_infinite = begins || (is_numbered && ended.any(|(pair, _)| is_part(&pairs[pair].name, place)));
    let kind = if is_infinite { Kind::Infinite } else { Kind::Impulse(contact.start) };
    Some(Tally { value, blur: (ROUNDING + turned) * size, kind })
}
