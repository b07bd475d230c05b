//! Contacts: how many, what the first of them did, when one is lost.

use tumble_mech::{Change, Contact, Happening, Rule};
use tumble_ode::Side;

use super::said::Said;
use super::seen::Seen;
use crate::figures::symbols;
use crate::fill::names::quantity_to;
use crate::fill::{alike, words};
use crate::report::Text;
use crate::results::CaseError;

/// Part of the run that a contact lasts which is told when it is lost: shorter ones are bounces.
const LASTS: f64 = 0.02;
/// Digits of speeds before and after.
const DIGITS: usize = 4;
/// Part of the larger by which two speeds have to differ.
const CHANGES: f64 = 1e-6;
/// A component of a normal below this is rounding: the plane is level or upright.
const LEVEL: f64 = 1e-9;
/// Less than this part of a speed is none: a body that turns has it by rounding.
const NOTHING: f64 = 1e-12;

/// A body has touched a surface.
pub(super) fn touched(seen: &Seen<'_>) -> Vec<Said> {
    let surfaces = seen.study.model.surfaces.iter();
    surfaces.filter_map(|surface| touched_by(seen, &surface.name)).collect()
}

/// Each point of the body that comes to touch counts; what stands there from the start has not come.
fn touched_by(seen: &Seen<'_>, surface: &str) -> Option<Said> {
    let pairs = seen.run.equations.pairs();
    let place = format!("{surface}.{}.", seen.name());
    let own = |contact: &Contact| pairs[contact.pair].name.starts_with(&place);
    let (there, contacts): (Vec<Contact>, Vec<Contact>) =
        joined(seen.run.contacts().into_iter().filter(own)).into_iter().partition(|one| one.start == 0.0);
    let first = contacts.first()?;
    let point = |pair: usize| pairs[pair].name[place.len()..].to_owned();
    let mut points: Vec<String> = contacts.iter().map(|contact| point(contact.pair)).collect();
    points.sort();
    points.dedup();
    // A round body touches by its rim, which says nothing.
    let with: Vec<String> =
        points.iter().filter(|point| *point != "rim").map(|point| symbols::the_point(point)).collect();
    let with = match with.is_empty() {
        true => String::new(),
        false => format!("with {}, ", alike::listed(&with)),
    };
    let mut sequences = seen.run.events().flat_map(|event| event.record.zeno_sequences());
    let accumulates = sequences.any(|pair| pairs[pair].name.starts_with(&place));
    let mut value = match contacts.len() {
        _ if accumulates => Text::from(format!("infinitely often, {with}first at ")),
        1 => Text::from(format!("once, {with}at ")),
        2 => Text::from(format!("twice, {with}first at ")),
        several => Text::from(format!("{several} times, {with}first at ")),
    };
    value = value.and(seen.event_time(first.start));
    match contacts.iter().rfind(|contact| contact.is_open) {
        Some(last) if last.start == first.start => value = value.and(", and stays there"),
        Some(last) => value = value.and(", and stays from ").and(seen.event_time(last.start)).and(" on"),
        None => {}
    }
    let comes_to_stay = contacts.len() > 1 && contacts.iter().any(|contact| contact.is_open);
    let already = if there.is_empty() { "" } else { "from the start, and later " };
    let said = Said::new(format!("{} touches {} {already}", seen.called(), symbols::the(surface)), value);
    Some(if comes_to_stay { said.leading() } else { said })
}

/// What the first contact that ends did to the speed of the centre and to the spin.
pub(super) fn first_effect(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let contacts = seen.contacts();
    let first = contacts.first().filter(|first| !first.is_open && first.start > 0.0);
    let Some(first) = first else { return Ok(None) };
    // Of several that touch at once, the instant is one.
    let lasting = contacts.iter().filter(|other| other.start == first.start);
    let end = lasting.map(|contact| contact.end).fold(first.end, f64::max);
    if end - first.start > LASTS * seen.end() {
        return Ok(None);
    }
    let surface = surface_of(seen, first);
    let changes = changes(seen, (first.start, Side::Before), (end, Side::After))?;
    // Of two bodies either could be meant.
    let before = match seen.run.equations.pairs()[first.pair].other {
        Some(_) => format!("{} in its first contact with {surface} changes ", seen.called()),
        None => format!("The first contact of {} with {surface} changes ", seen.called()),
    };
    Ok(changes.map(|value| Said::new(before, value)))
}

/// A round body that slides at the start of a contact comes to roll: what friction did until then.
pub(super) fn rolls(seen: &Seen<'_>) -> Result<Option<Said>, CaseError> {
    let contacts = seen.contacts();
    let is_rolling = |happening: &Happening, pair: usize| matches!(happening, Happening::Contact { pair: of, change: Change::Rolls } if *of == pair);
    let begins = |contact: &Contact| {
        let mut events = seen.run.events().filter(|event| event.time > contact.start);
        let rolls =
            events.find(|event| event.record.happened.iter().any(|one| is_rolling(one, contact.pair)))?;
        (rolls.time <= contact.end).then_some(rolls.time)
    };
    let Some((contact, time)) = contacts.iter().find_map(|contact| Some((contact, begins(contact)?))) else {
        return Ok(None);
    };
    let Some(changes) = changes(seen, (contact.start, Side::After), (time, Side::After))? else {
        return Ok(None);
    };
    let before = format!("{} slides on {} and rolls from ", seen.called(), surface_of(seen, contact));
    let value = seen.event_time(time).and(" on; until then friction changes ").and(changes);
    Ok(Some(Said::new(before, value).leading()))
}

/// A round body slides from the start to the end.
pub(super) fn slides(seen: &Seen<'_>) -> Option<Said> {
    let whole = seen.contacts().into_iter().find(|contact| contact.start == 0.0 && contact.is_open)?;
    let changes = seen.run.events().flat_map(|event| &event.record.happened).filter_map(|one| match *one {
        Happening::Contact { pair, change } if pair == whole.pair => Some(change),
        _ => None,
    });
    let changes: Vec<Change> = changes.collect();
    let is_round = seen.run.equations.pairs()[whole.pair].name.ends_with(".rim");
    let only_slides = changes.iter().all(|change| matches!(change, Change::Start | Change::Slides));
    let before = format!("{} slides on {} ", seen.called(), surface_of(seen, &whole));
    (is_round && only_slides && changes.contains(&Change::Slides))
        .then(|| Said::new(before, "throughout and never rolls".into()).leading())
}

/// The inclined plane on which a body is from the start to the end, with the unit vector up along it.
pub(super) fn incline(seen: &Seen<'_>) -> Result<Option<(String, [f64; 2])>, CaseError> {
    let mut contacts = joined(seen.contacts().into_iter()).into_iter();
    let whole = contacts.find(|contact| contact.start == 0.0 && contact.is_open);
    let rule = whole.map(|whole| seen.run.equations.pairs()[whole.pair].rule);
    let Some(Rule::Surface(surface)) = rule else { return Ok(None) };
    let surface = &seen.study.model.surfaces[surface];
    let [x, y] = [surface.normal.x(), surface.normal.y()];
    let normal = [seen.at(0.0, x)?, seen.at(0.0, y)?];
    let is_plane = surface.circle.is_none() && surface.polygon.is_none();
    let is_inclined = is_plane && normal[0].abs() > LEVEL && normal[1].abs() > LEVEL;
    let stays = normal == [seen.at(seen.end(), x)?, seen.at(seen.end(), y)?];
    let up = [-normal[0] * normal[1], normal[0] * normal[0]].map(|part| part / normal[0].abs());
    Ok((is_inclined && stays).then(|| (symbols::the(&surface.name), up)))
}

fn surface_of(seen: &Seen<'_>, contact: &Contact) -> String {
    words::other(seen.study, &seen.run.equations.pairs()[contact.pair], seen.index)
}

/// Speed of the centre and spin at two instants, where they differ; of what goes back the way it came, or is turned round along an axis, the
/// velocity with its sign.
fn changes(seen: &Seen<'_>, from: (f64, Side), to: (f64, Side)) -> Result<Option<Text>, CaseError> {
    let motion = seen.body.kinematics();
    let formulas = [motion.velocity().components(), &[motion.omega()]].concat();
    let mut observer = seen.run.observe(&formulas)?;
    let (Some(before), Some(after)) = (observer.at(from.0, from.1), observer.at(to.0, to.1)) else {
        return Ok(None);
    };
    let (name, [was, is]) = along([before[0], before[1]], [after[0], after[1]]);
    let reach = seen.study.number(&seen.body.reach())?;
    let rates = [(was, is, "m/s", 1.0), (before[2], after[2], "rad/s", reach)];
    let fastest = rates.iter().map(|(a, b, _, size)| a.abs().max(b.abs()) * size).fold(0.0, f64::max);
    let part = |(name, (a, b, unit, size)): (&str, (f64, f64, &str, f64))| {
        let differ =
            (a - b).abs() > CHANGES * a.abs().max(b.abs()) && (a - b).abs() * size > NOTHING * fastest;
        let shown = |value: f64| if value.abs() * size < NOTHING * fastest { 0.0 } else { value };
        let [from, to] = [quantity_to(shown(a), DIGITS, ""), quantity_to(shown(b), DIGITS, unit)];
        differ.then(|| Text::from(format!("its {name} from ")).and(from).and(" to ").and(to))
    };
    let parts = [name, "spin"].into_iter().zip(rates).filter_map(part);
    Ok(parts.reduce(|all, next| all.and(" and ").and(next)))
}

/// What is said of two velocities: their sizes, with signs where one is the reverse of the other's direction; along an axis those of its coordinate.
fn along(before: [f64; 2], after: [f64; 2]) -> (&'static str, [f64; 2]) {
    let [was, is] = [before, after].map(|[x, y]: [f64; 2]| x.hypot(y));
    let (dot, cross) =
        (before[0] * after[0] + before[1] * after[1], before[0] * after[1] - before[1] * after[0]);
    if dot >= 0.0 || cross.abs() > CHANGES * was * is {
        return ("speed", [was, is]);
    }
    let axis = usize::from(before[1].abs() > before[0].abs());
    let is_along = before[1 - axis].abs() <= CHANGES * was;
    let sign = if is_along { before[axis].signum() } else { 1.0 };
    ("velocity", [sign * was, -sign * is])
}

/// A contact with a surface that has lasted ends: no impact takes the point away, and no other contact of it begins at once.
pub(super) fn lost(seen: &Seen<'_>) -> Result<Vec<Said>, CaseError> {
    let mut found = vec![];
    let (angle, pairs) = (seen.body.kinematics().angle(), seen.run.equations.pairs());
    let begins = seen.at(0.0, &angle)?;
    for contact in joined(seen.contacts().into_iter()) {
        let lasts = contact.end - contact.start >= LASTS * seen.end();
        let pair = &pairs[contact.pair];
        if contact.is_open || !lasts || contact.end >= seen.end() || pair.other.is_some() {
            continue;
        }
        if is_struck(seen, contact.end) {
            continue;
        }
        let mut names = pair.name.split('.');
        let (surface, _, point) = (names.next(), names.next(), names.next());
        let [surface, point] = [surface, point].map(|name| symbols::the(name.unwrap_or_default()));
        let mut value = seen.event_time(contact.end);
        if seen.at(contact.end, &angle)? != begins {
            let turned = seen.known_in(contact.end, &angle, ("deg", f64::to_degrees))?;
            value = value.and(", when it has turned to ").and(turned);
        }
        let before = format!("{point} of {} leaves {surface}, whose push falls to zero, at ", seen.called());
        found.push(Said::new(before, value).leading());
    }
    Ok(found)
}

/// Whether the body is struck at an instant.
fn is_struck(seen: &Seen<'_>, time: f64) -> bool {
    let events = seen.run.events().filter(|event| event.time == time);
    let mut impulses = events.flat_map(|event| &event.record.impulses);
    impulses.any(|impulse| impulse.body == seen.index)
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

#[cfg(test)]
mod tests {
    use super::along;

    #[test]
    fn what_goes_back_has_a_sign() {
        assert_eq!(along([2.0, 0.0], [-0.8, 0.0]), ("velocity", [2.0, -0.8]));
        assert_eq!(along([0.0, -3.0], [0.0, 1.5]), ("velocity", [-3.0, 1.5]));
        assert_eq!(along([3.0, 4.0], [-1.5, -2.0]), ("velocity", [5.0, -2.5]));
        assert_eq!(along([3.0, 4.0], [3.0, -4.0]), ("speed", [5.0, 5.0]));
        assert_eq!(along([3.0, 0.0], [1.0, 0.0]), ("speed", [3.0, 1.0]));
    }
}
