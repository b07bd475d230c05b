//! Instants that tell something of the forces on a body, where the scene names none: each load at its largest, and whatever else
//! acts together.

use tumble_expr::units::S;
use tumble_mech::{Contact, Force, Forces, Law, Pair, joined};
use tumble_ode::Side;
use tumble_scene::{Instant, Study};

use super::symbols;
use crate::results::{Case, CaseError, equal_times};

/// Instants at which forces are looked at.
const SAMPLES: usize = 400;
/// The same within a contact, and in how many of them.
const PARTS: usize = 20;
const MOST_CONTACTS: usize = 20;
/// Diagrams of a body in a scene of few bodies; of many each has one.
const MOST: usize = 3;
const FEW_BODIES: usize = 3;
/// A force below this part of the largest, or one that varies by less, has no largest.
const SMALL: f64 = 1e-6;

/// A force that is never less than this part of its largest has no smallest that is worth a diagram.
const VARIES: f64 = 0.7;

/// A load by its name with its law.
type Load = (String, Law);

/// The forces on a body at an instant.
struct Seen {
    time: f64,
    forces: Vec<Force>,
}

/// When, and what is seen there.
pub(crate) fn of(study: &Study, case: &Case, body: usize) -> Result<Vec<(Instant, String)>, CaseError> {
    let seen = seen(case, body)?;
    if acting_ever(&seen).is_empty()
        && let Some(time) = hardest_impact(case, body)
    {
        let impact = Instant { text: String::new(), time: time * S };
        return Ok(vec![(impact, "the largest impulse".to_owned())]);
    }
    let most = if study.model.bodies.len() > FEW_BODIES { 1 } else { MOST };
    let mut found = largest(study, &seen);
    found.truncate(most);
    together(study, &seen, &mut found);
    if found.len() == 1 {
        found.extend(smallest(study, &seen));
    }
    found.truncate(most);
    found.sort_by_key(|(index, _)| *index);
    let instant = |(index, label): (usize, String)| {
        (Instant { text: String::new(), time: seen[index].time * S }, label)
    };
    Ok(found.into_iter().map(instant).collect())
}

/// When the largest impulse acts on a body that nothing else acts on.
fn hardest_impact(case: &Case, body: usize) -> Option<f64> {
    let events = case.run.events();
    let struck = events.filter_map(|event| {
        let own = event.record.impulses.iter().filter(|impulse| impulse.body == body);
        let sizes = own.map(|impulse| impulse.impulse[0].hypot(impulse.impulse[1]));
        Some((sizes.reduce(f64::max)?, event.time))
    });
    struck.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, time)| time)
}

/// How many loads there are on the bodies of a run: a run that has them all shows most.
pub(crate) fn loads(case: &Case, bodies: usize) -> Result<usize, CaseError> {
    let one = |body: usize| Ok(acting_ever(&seen(case, body)?).len());
    (0..bodies).map(one).sum()
}

fn seen(case: &Case, body: usize) -> Result<Vec<Seen>, CaseError> {
    let mut forces = Forces::of(&case.run);
    let at = |time: f64| {
        let all = joined(&forces.at(time, Side::After)?);
        Ok(Seen { time, forces: all.into_iter().filter(|force| force.body == body).collect() })
    };
    let mut times: Vec<f64> = equal_times(&case.run, SAMPLES).chain(within_contacts(case, body)).collect();
    times.sort_by(f64::total_cmp);
    times.into_iter().map(at).collect()
}

/// Times within the first contacts of a body with what is compliant: they may be shorter than what lies between two of those above.
fn within_contacts(case: &Case, body: usize) -> impl Iterator<Item = f64> {
    let is_own = |pair: &Pair| !pair.is_rigid() && pair.bodies().any(|own| own == body);
    let mut contacts = case.run.contacts();
    contacts.retain(|contact| is_own(&case.run.equations.pairs()[contact.pair]));
    contacts.truncate(MOST_CONTACTS);
    let part = |index: usize| index as f64 / PARTS as f64;
    contacts.into_iter().flat_map(move |Contact { start, end, .. }| {
        (1..PARTS).map(move |index| start + (end - start) * part(index))
    })
}

fn size(force: &Force) -> f64 {
    if force.law.is_couple() { force.couple.abs() } else { force.force[0].hypot(force.force[1]) }
}

/// The loads that are more than rounding.
fn acting(seen: &Seen) -> Vec<Load> {
    let largest = seen.forces.iter().map(size).fold(0.0, f64::max);
    let real = seen.forces.iter().filter(|force| size(force) > SMALL * largest);
    real.map(|force| (force.load.clone(), force.law)).collect()
}

fn acting_ever(seen: &[Seen]) -> Vec<Load> {
    let mut all: Vec<Load> = vec![];
    for load in seen.iter().flat_map(acting) {
        if !all.contains(&load) {
            all.push(load);
        }
    }
    all
}

/// Where each load is largest, that of contacts and of what is outside first; a constant one is so nowhere.
fn largest(study: &Study, seen: &[Seen]) -> Vec<(usize, String)> {
    let mut loads = acting_ever(seen);
    loads.retain(|(_, law)| *law != Law::Weight);
    loads.sort_by_key(|(_, law)| *law == Law::Reaction);
    let mut found: Vec<(usize, String)> = vec![];
    for (load, law) in &loads {
        let sizes =
            seen.iter().map(|seen| seen.forces.iter().find(|force| force.load == *load).map_or(0.0, size));
        let sizes: Vec<f64> = sizes.collect();
        let best =
            (0..sizes.len()).fold(0, |best, index| if sizes[index] > sizes[best] { index } else { best });
        let least = sizes.iter().copied().filter(|size| *size > 0.0).fold(sizes[best], f64::min);
        if sizes[best] - least <= SMALL * sizes[best] {
            continue;
        }
        let symbol = symbols::force(study, load, *law);
        match found.iter_mut().find(|(index, _)| *index == best) {
            Some((_, label)) => *label = format!("{label} and ${symbol}$"),
            None => found.push((best, format!("largest ${symbol}$"))),
        }
    }
    found
}

/// Where the load that varies most is smallest, of those that always act.
fn smallest(study: &Study, seen: &[Seen]) -> Option<(usize, String)> {
    let of = |(load, law): &Load| {
        let sizes: Vec<f64> = seen
            .iter()
            .map(|seen| seen.forces.iter().find(|force| force.load == *load).map_or(0.0, size))
            .collect();
        let (index, least) = sizes.iter().enumerate().min_by(|one, other| one.1.total_cmp(other.1))?;
        let most = sizes.iter().copied().fold(0.0, f64::max);
        let varies = *least > 0.0 && *least < VARIES * most;
        varies.then(|| (least / most, index, symbols::force(study, load, *law)))
    };
    let loads = acting_ever(seen);
    let found = loads.iter().filter(|(_, law)| *law != Law::Weight).filter_map(of);
    let (_, index, symbol) = found.min_by(|one, other| one.0.total_cmp(&other.0))?;
    Some((index, format!("smallest ${symbol}$")))
}

/// The middle of the first stretch of each set of loads that no diagram shows yet.
fn together(study: &Study, seen: &[Seen], found: &mut Vec<(usize, String)>) {
    let load = |force: &Force| (force.load.clone(), force.law);
    let sets: Vec<Vec<Load>> = seen.iter().map(|seen| seen.forces.iter().map(load).collect()).collect();
    for (first, set) in sets.iter().enumerate() {
        let is_known = found.iter().any(|(index, _)| sets[*index] == *set);
        if !is_known {
            let length = sets[first..].iter().take_while(|other| *other == set).count();
            found.push((first + length / 2, words(study, set)));
        }
    }
}

/// What acts, in words.
fn words(study: &Study, set: &[Load]) -> String {
    let names: Vec<String> =
        set.iter().map(|(load, law)| format!("${}$", symbols::force(study, load, *law))).collect();
    match &names[..] {
        [] => "nothing acts".to_owned(),
        [only] => format!("{only} alone"),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::motions_in;

    /// The ball is in for 1 ms of 1 s.
    const SCENE: &str = r#"
        version = 1
        world.gravity = 0
        run.until = "1 s"
        [body.ball]
        ball = { radius = "5 cm" }
        mass = "1 kg"
        start = { at = [0, "1 m"], velocity = [0, "-2 m/s"] }
        [surface.floor]
        through = [0, 0]
        hertz = { stiffness = "1e9 N/m^(3/2)", damping = 0 }
    "#;

    #[test]
    fn the_largest_force_of_a_short_contact_is_seen() {
        let (study, cases) = motions_in("short", SCENE.as_bytes(), &tumble_scene::NoFiles);
        let contact = cases[0].run.contacts()[0].clone();
        let found = of(&study, &cases[0], 0).expect("instants");
        let inside = |(instant, _): &&(Instant, String)| {
            let time = study.number(&instant.time).expect("a time");
            let middle = 0.5 * (contact.start + contact.end);
            (time - middle).abs() < 0.05 * (contact.end - contact.start)
        };
        assert!(found.iter().any(|one| inside(&one) && one.1.starts_with("largest")), "{found:?}");
    }
}
