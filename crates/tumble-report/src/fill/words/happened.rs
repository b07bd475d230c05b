//! What happens at an instant, in words: `the foot strikes the floor, the head strikes and stays on the floor`.

use tumble_mech::{Change, ContactMode, Equations, Grip, Happening, Mode, Others, Pair, Record, Run};
use tumble_ode::Occurrence;
use tumble_scene::Study;

use super::{Verb, add, against, group, point, spoken, together};
use crate::figures::symbols;

/// More groups than these that change at one instant are counted, where bodies meet each other.
const MOST_CHANGES: usize = 5;

/// What changes of a contact at an instant.
type Changed = (usize, Vec<Change>);

/// All that happens at an instant; points that do the same are told together.
pub(crate) fn event(study: &Study, run: &Run, event: &Occurrence<Record>) -> String {
    let equations = &run.equations;
    let mut changed: Vec<Changed> = vec![];
    let mut told: Vec<String> = vec![];
    for one in &event.record.happened {
        match *one {
            Happening::Contact { pair, change } => also(&mut changed, pair, change),
            _ => told.push(happening(study, equations, one)),
        }
    }
    let alike = mode_of(run, event, event.mode_after).map(|mode| gripped_alike(equations, mode, &changed));
    alike.into_iter().flatten().for_each(|(pair, change)| also(&mut changed, pair, change));
    told.extend(bounced_out(study, equations, &mut changed));
    let mut groups: Vec<(Verb, String, Vec<String>)> = vec![];
    let before = mode_of(run, event, event.mode_before);
    for (index, changes) in changed {
        let pair = &equations.pairs()[index];
        let lasted = before.and_then(|mode| mode.contact_mode(index)).is_some_and(ContactMode::is_lasting);
        let verb = all_of(&changes, (event.time == 0.0, lasted && pair.other.is_none()));
        add(&mut groups, (verb, against(study, pair)), point(study, pair));
    }
    told.extend(match groups.len() > MOST_CHANGES {
        true => pairs_of_bodies(&groups),
        false => groups.iter().map(|(verb, to, points)| group(verb, to, points)).collect(),
    });
    let is_possible = |others: &Others| matches!(others, Others::Possible(_));
    told.extend(event.record.others.iter().any(is_possible).then(|| "other motions are possible".to_owned()));
    told.join(", ")
}

/// One more change of a contact.
fn also(changed: &mut Vec<Changed>, pair: usize, change: Change) {
    match changed.iter_mut().find(|(of, _)| *of == pair) {
        Some((_, changes)) => changes.push(change),
        None => changed.push((pair, vec![change])),
    }
}

/// A mode by its number, which is one of the motion that the event is kept in.
fn mode_of<'r>(run: &'r Run, event: &Occurrence<Record>, number: usize) -> Option<&'r Mode> {
    let own =
        run.tracks().find(|motion| motion.events.as_ptr_range().contains(&std::ptr::from_ref(event)))?;
    own.modes.get(number)
}

/// The other points by which a body touches a surface, with what its grip becomes: all slip alike, and a record tells of the one
/// that bears the friction.
fn gripped_alike(equations: &Equations, mode: &Mode, changed: &[Changed]) -> Vec<(usize, Change)> {
    let pairs = equations.pairs();
    let is_grip = |change: &Change| matches!(change, Change::Slides | Change::Sticks);
    let grips =
        changed.iter().filter_map(|(pair, changes)| Some((*pair, *changes.iter().find(|c| is_grip(c))?)));
    let others = grips.flat_map(|(pair, change)| {
        let is_other = move |other: &usize| *other != pair && is_of_same(&pairs[*other], &pairs[pair]);
        let touching = mode.contacts.iter().map(|(other, _)| *other).filter(is_other);
        let is_alike = move |other: &usize| match mode.grip(*other) {
            Some(Grip::Slides(_)) => change == Change::Slides,
            Some(Grip::Sticks | Grip::Follows) => change == Change::Sticks,
            Some(Grip::Strains(_)) | None => false,
        };
        touching.filter(is_alike).map(move |other| (other, change))
    });
    let is_known = |(pair, change): &(usize, Change)| {
        changed.iter().any(|(other, changes)| other == pair && changes.contains(change))
    };
    others.filter(|one| !is_known(one)).collect()
}

/// Whether two pairs are of one body on one surface.
fn is_of_same(one: &Pair, other: &Pair) -> bool {
    let surface = |pair: &Pair| pair.name.split('.').next().map(str::to_owned);
    one.other.is_none() && other.other.is_none() && one.body == other.body && surface(one) == surface(other)
}

/// Takes out impacts that follow each other ever faster, and says that they do.
fn bounced_out(study: &Study, equations: &Equations, changed: &mut Vec<Changed>) -> Vec<String> {
    let mut groups: Vec<(Verb, String, Vec<String>)> = vec![];
    for (pair, changes) in changed.iter_mut().filter(|(_, changes)| changes.contains(&Change::Zeno)) {
        let pair = &equations.pairs()[*pair];
        changes.retain(|change| !matches!(change, Change::Zeno | Change::Impact));
        add(&mut groups, (Verb::default(), against(study, pair)), point(study, pair));
    }
    changed.retain(|(_, changes)| !changes.is_empty());
    let bounces = |(_, on, points): &(Verb, String, Vec<String>)| {
        format!("the bounces of {} on {on} become too low to be followed", together(points))
    };
    groups.iter().map(bounces).collect()
}

/// `the cue strikes b1, 30 pairs of bodies strike and leave each other`
fn pairs_of_bodies(groups: &[(Verb, String, Vec<String>)]) -> Vec<String> {
    let mut kinds: Vec<(&Verb, usize, String)> = vec![];
    for (verb, to, points) in groups {
        match kinds.iter_mut().find(|(known, ..)| *known == verb) {
            Some((_, count, _)) => *count += points.len(),
            None => kinds.push((verb, points.len(), group(verb, to, points))),
        }
    }
    let one = |(verb, count, only): (&Verb, usize, String)| match count {
        1 => only,
        _ if verb[1] == changes_to(Change::End)[1] => format!("{count} pairs of bodies separate"),
        _ => format!("{count} pairs of bodies {} each other", verb[1]),
    };
    kinds.into_iter().map(one).collect()
}

/// All that one contact does at an instant: `strikes and sticks to`. What holds from then on tells that it touches, and what has touched before
/// does not strike.
fn all_of(changes: &[Change], (is_start, lasted): (bool, bool)) -> Verb {
    let lasts = |change: &Change| matches!(change, Change::Slides | Change::Sticks | Change::Rolls);
    let is_told = |change: &&Change| **change != Change::Start || !changes.iter().any(lasts);
    let stays = changes.contains(&Change::Impact);
    let verbs: Vec<[&str; 2]> = changes
        .iter()
        .filter(is_told)
        .map(|change| match change {
            Change::Impact if lasted => ["gets an impulse from", "get an impulse from"],
            Change::Start if stays => ["stays on", "stay on"],
            Change::Start if is_start => ["touches", "touch"],
            Change::Slides if is_start => ["slides on", "slide on"],
            Change::Rolls if is_start => ["rolls on", "roll on"],
            other => changes_to(*other),
        })
        .collect();
    [0, 1].map(|number| verbs.iter().map(|verb| verb[number]).collect::<Vec<_>>().join(" and "))
}

fn happening(study: &Study, equations: &Equations, happening: &Happening) -> String {
    match *happening {
        Happening::Event(event) => spoken(&study.model.events[event].name),
        Happening::Window { window, ends } => {
            let load = symbols::the(&equations.windows()[window].load);
            format!("{load} {}", if ends { "ends" } else { "begins" })
        }
        Happening::Joint { joint, holds } => {
            let joint = symbols::joint(&study.model.joints[joint].name);
            format!("{joint} {}", if holds { "begins to hold" } else { "lets go" })
        }
        Happening::Impulse(impulse) => {
            format!("{} gives its impulse", symbols::the(&study.model.impulses[impulse].name))
        }
        Happening::Contact { pair, .. } => equations.pairs()[pair].name.clone(),
        Happening::Brake { brake, sticks } => {
            let load = symbols::the(equations.brake_name(brake));
            format!("{load} {}", if sticks { "begins to hold" } else { "gives way" })
        }
        Happening::Rest => "all is at rest".to_owned(),
        Happening::Singular => "the joints pass a singular configuration".to_owned(),
    }
}

pub(super) fn changes_to(change: Change) -> [&'static str; 2] {
    match change {
        Change::Impact => ["strikes", "strike"],
        Change::Zeno => ["bounces ever lower on", "bounce ever lower on"],
        Change::Start => ["begins to touch", "begin to touch"],
        Change::End => ["leaves", "leave"],
        Change::Slides => ["begins to slide on", "begin to slide on"],
        Change::Stops => ["stops turning on", "stop turning on"],
        Change::Turns => ["begins to turn on", "begin to turn on"],
        Change::Sticks => ["sticks to", "stick to"],
        Change::Rolls => ["begins to roll on", "begin to roll on"],
        Change::Clear => ["is out of", "are out of"],
    }
}

#[cfg(test)]
mod tests {
    use super::event;
    use crate::scenes::motions_called;

    /// What happens at each event of the first run of a scene.
    fn events(scene: &str) -> Vec<String> {
        let (study, cases) = motions_called(scene);
        let run = &cases[0].run;
        run.events().map(|one| event(&study, run, one)).collect()
    }

    #[test]
    fn a_corner_without_a_name_of_its_own_is_that_of_a_body() {
        let block = events("17-block-on-a-slope");
        let both = "corners 1 and 2 of the block";
        // A record tells of the corner that bears the friction; both are held alike.
        assert_eq!(block, [format!("{both} slide on the incline"), format!("{both} stick to the incline")]);
    }

    #[test]
    fn bounces_that_are_not_followed_are_told_apart_from_what_comes_of_them() {
        let rough = events("21-rough-floor");
        let ends: Vec<&String> =
            rough.iter().filter(|text| text.contains("too low to be followed")).collect();
        let told = "the bounces of the tail and the tip on the floor become too low to be followed, the tail and the tip begin to slide on the floor";
        assert_eq!(ends, [told]);
    }

    #[test]
    fn points_that_do_the_same_are_told_together() {
        assert_eq!(events("16-bench"), ["the left, the middle and the right touch the floor".to_owned()]);
        let falling = events("10-falling-rod");
        assert!(
            falling.iter().any(|text| text.contains(
                "the foot gets an impulse from the floor, the head strikes and stays on the floor"
            )),
            "{falling:?}"
        );
    }
}
