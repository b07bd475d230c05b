//! What events have left up to an instant, by the names in finds and checks: impulses of contacts and how often something happened.

use tumble_mech::{At, Impulse, Run, Source};
use tumble_ode::{Occurrence, Side};
use tumble_scene::Count;

use crate::results::moments::is_part;

/// A number that the run has come to.
pub(crate) struct Tally {
    pub(crate) value: f64,
    /// What rounding does to it at least.
    pub(crate) blur: f64,
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
    let count = match name.strip_suffix(CONTACTS) {
        Some(place) => {
            let contacts = run.contacts();
            let there =
                contacts.iter().filter(|contact| is_part(&run.equations.pairs()[contact.pair].name, place));
            there.filter(|contact| has_come(contact.start)).count()
        }
        None => {
            let happening = run.equations.named(name.strip_suffix(COUNT)?)?;
            let events = run.events().filter(|event| has_come(event.time));
            events.filter(|event| event.record.happened.contains(&happening)).count()
        }
    };
    Some(Tally { value: count as f64, blur: 0.0 })
}

/// The impulse of a contact on its body, on the first of two, N s; zero of one that begins without an impact.
fn impulse(run: &Run, place: &str, count: Count, axis: &str) -> Option<Tally> {
    let contacts = run.contacts();
    let pairs = run.equations.pairs();
    let there = contacts.iter().filter(|contact| is_part(&pairs[contact.pair].name, place));
    let contact = count.of(there)?;
    let at = |event: &&Occurrence<tumble_mech::Record>| event.time == contact.start;
    let impulses = run.events().filter(at).flat_map(|event| &event.record.impulses);
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
    Some(Tally { value, blur: ROUNDING * size })
}
