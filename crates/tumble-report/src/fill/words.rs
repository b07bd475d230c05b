//! What touches, what acts and what happens, in words: `the tail presses on the floor`.

use tumble_mech::{Change, ContactMode, Equations, Grip, Joint, Mode, Pair, PossibleChange, Way};
use tumble_scene::Study;

use super::alike::listed;
use crate::figures::symbols;

mod happened;

use happened::changes_to;
pub(crate) use happened::event;

/// More groups of contacts than these are counted.
const MOST_GROUPS: usize = 3;
/// More contacts of one group than these are counted.
const MOST_NAMED: usize = 4;

/// Words of its own, at most, that one of two sentences has that are told as one.
const MOST_OWN: usize = 2;

/// Between a point and the body that it is of.
const OF: &str = " of ";

/// What a contact does, of one point and of several.
type Verb = [String; 2];

/// What touches and what acts while a mode lasts.
pub(super) fn mode(study: &Study, equations: &Equations, mode: &Mode) -> String {
    let windows = equations.windows().iter().zip(&mode.windows);
    let acting = windows.map(|(window, acts)| match acts {
        true => format!("{} acts", symbols::the(&window.load)),
        false => format!("without {}", symbols::the(&window.load)),
    });
    let joints = study.model.joints.iter().enumerate();
    let changing = joints.filter(|(_, joint)| joint.from.is_some() || joint.until.is_some());
    let joined = changing.map(|(index, joint)| match equations.holds(mode, index) {
        true => format!("{} holds", symbols::joint(&joint.name)),
        false => not_held(joint),
    });
    let changed =
        mode.changes.iter().map(|event| format!("after {}", spoken(&study.model.events[*event].name)));
    let held = mode.brakes.iter().filter(|(_, grip)| *grip == Grip::Sticks);
    let held = held.map(|(brake, _)| {
        format!("{} holds, its sign between \u{2212}1 and 1", symbols::the(equations.brake_name(*brake)))
    });
    let touching = contacts(study, equations, mode).into_iter();
    let all: Vec<String> = touching.chain(joined).chain(acting).chain(changed).chain(held).collect();
    match (all.is_empty(), equations.pairs().is_empty()) {
        (false, _) => all.join(", "),
        (true, false) => "nothing touches".to_owned(),
        (true, true) => "throughout".to_owned(),
    }
}

/// A joint that is made later, or that was let go of; of one that does both it is not said which.
fn not_held(joint: &Joint) -> String {
    let name = symbols::joint(&joint.name);
    match (&joint.from, &joint.until) {
        (Some(_), None) => format!("before {name} holds"),
        (None, Some(_)) => format!("after {name} has let go"),
        _ => format!("without {name}"),
    }
}

/// `the tail settles or slides on the floor`: what two sentences share is said once, where each says little more.
pub(super) fn either(one: &str, other: &str) -> String {
    let (first, second): (Vec<&str>, Vec<&str>) = (one.split(' ').collect(), other.split(' ').collect());
    let shared = |a: &mut dyn Iterator<Item = (&&str, &&str)>| a.take_while(|(a, b)| a == b).count();
    let before = shared(&mut first.iter().zip(&second));
    let least = first.len().min(second.len()) - before;
    let after = shared(&mut first.iter().rev().zip(second.iter().rev())).min(least);
    let own = |words: &[&str]| words[before..words.len() - after].join(" ");
    let is_little = |words: &[&str]| (1..=MOST_OWN).contains(&(words.len() - after - before));
    if before == 0 || !is_little(&first) || !is_little(&second) {
        // Where one of them is a row of sentences, a comma would read as one more of them.
        let pause = if one.contains(", ") || other.contains(", ") { ";" } else { "," };
        return format!("{one}{pause} or {other}");
    }
    let [start, end] = [&first[..before], &first[first.len() - after..]].map(|words| words.join(" "));
    format!("{start} {} or {} {end}", own(&first), own(&second)).trim_end().to_owned()
}

/// Contacts by what they do and to what; of many groups, how many do what.
fn contacts(study: &Study, equations: &Equations, mode: &Mode) -> Vec<String> {
    let mut groups: Vec<(Verb, String, Vec<String>)> = vec![];
    for (index, contact_mode) in &mode.contacts {
        let pair = &equations.pairs()[*index];
        let verb = verb(*contact_mode, grip(equations, mode, *index), pair);
        add(&mut groups, (verb, against(study, pair)), point(study, pair));
    }
    if groups.len() > MOST_GROUPS {
        return counted(&groups);
    }
    groups.iter().map(|(verb, to, points)| group(verb, to, points)).collect()
}

/// `the tail and the tip press on the floor`
fn group(verb: &Verb, to: &str, points: &[String]) -> String {
    match points {
        [only] => format!("{only} {} {to}", verb[0]),
        many if many.len() > MOST_NAMED => format!("{} points {} {to}", many.len(), verb[1]),
        several => format!("{} {} {to}", together(several), verb[1]),
    }
}

/// `the tail and the tip`; whose points they are is said once.
pub(super) fn together(points: &[String]) -> String {
    let of = |point: &String| point.split_once(OF).map(|(point, body)| (point.to_owned(), body.to_owned()));
    match points.iter().map(of).collect::<Option<Vec<_>>>().as_deref() {
        Some([(_, body), others @ ..]) if others.iter().all(|(_, other)| other == body) => {
            let short: Vec<String> = points.iter().filter_map(of).map(|(point, _)| point).collect();
            format!("{}{OF}{body}", listed(&short))
        }
        _ => listed(points),
    }
}

/// `12 points of contact: 9 touch, 3 roll`
fn counted(groups: &[(Verb, String, Vec<String>)]) -> Vec<String> {
    let mut counts: Vec<(&str, usize)> = vec![];
    for ([_, several], _, points) in groups {
        let word = several.split(' ').next().unwrap_or_default();
        match counts.iter_mut().find(|(known, _)| *known == word) {
            Some((_, count)) => *count += points.len(),
            None => counts.push((word, points.len())),
        }
    }
    let all: usize = counts.iter().map(|(_, count)| count).sum();
    let each: Vec<String> = counts.iter().map(|(word, count)| format!("{count} {word}")).collect();
    vec![match &counts[..] {
        [(word, _)] => format!("{all} points {word}"),
        _ => format!("{all} points of contact: {}", each.join(", ")),
    }]
}

/// How a contact is held along its surface; what does not turn either does not roll.
fn grip(equations: &Equations, mode: &Mode, pair: usize) -> Option<Grip> {
    let own = mode.grip(pair);
    let rests = equations.resisting(pair).and_then(|rolling| mode.grip(rolling)).is_some_and(Grip::is_still);
    if rests && own.is_none_or(Grip::is_still) { None } else { own }
}

fn verb(contact_mode: ContactMode, grip: Option<Grip>, pair: &Pair) -> Verb {
    let verb = match (contact_mode, grip) {
        (ContactMode::Pressed, None) => ["presses on", "press on"],
        (ContactMode::Released, _) => ["is let go by", "are let go by"],
        (ContactMode::Settling, _) => ["settles on", "settle on"],
        (ContactMode::Resting, None)
        | (ContactMode::Idle | ContactMode::Entering(_) | ContactMode::Leaving(_), _) => ["touches", "touch"],
        (_, Some(Grip::Sticks | Grip::Follows)) if pair.is_round() => ["rolls on", "roll on"],
        (_, Some(Grip::Sticks | Grip::Follows)) => ["sticks to", "stick to"],
        (_, Some(Grip::Slides(_))) => ["slides on", "slide on"],
        (_, Some(Grip::Strains(_))) => ["is on the point of sliding on", "are on the point of sliding on"],
    };
    verb.map(str::to_owned)
}

/// What touches: a round body, or a point of one, with its body where there are several; a corner that the scene has no name for
/// always.
pub(super) fn point(study: &Study, pair: &Pair) -> String {
    let model = &study.model.bodies[pair.body];
    let (body, point) = (symbols::the(&model.name), symbols::last(&pair.name));
    let is_named = !is_corner(point) || model.points.iter().any(|(name, _)| name == point);
    match (pair.is_round() || pair.other.is_some(), study.model.bodies.len()) {
        (true, _) => body,
        (false, 1) if is_named => symbols::the_point(point),
        (false, _) => format!("{}{OF}{body}", symbols::the_point(point)),
    }
}

/// Whether a point has the name that corners have by themselves.
fn is_corner(point: &str) -> bool {
    point.strip_prefix("corner").is_some_and(|number| number.bytes().all(|c| c.is_ascii_digit()))
}

/// What it touches.
pub(super) fn against(study: &Study, pair: &Pair) -> String {
    match pair.other {
        Some(other) => symbols::the(&study.model.bodies[other].name),
        None => symbols::the(pair.name.split('.').next().unwrap_or(&pair.name)),
    }
}

/// What one contact would do, and the direction along it that is forward.
pub(super) struct Course {
    pub(super) pair: usize,
    pub(super) does: PossibleChange,
    pub(super) forward: [f64; 2],
}

/// `the foot slides to the left on the floor`, of all contacts in a motion.
pub(super) fn contacts_that(
    study: &Study,
    equations: &Equations,
    courses: impl Iterator<Item = Course>,
) -> String {
    let mut groups: Vec<(Verb, String, Vec<String>)> = vec![];
    for course in courses {
        let pair = &equations.pairs()[course.pair];
        add(&mut groups, (course.verb(pair), against(study, pair)), point(study, pair));
    }
    let groups: Vec<String> = groups.iter().map(|(verb, to, points)| group(verb, to, points)).collect();
    groups.join(", ")
}

impl Course {
    fn verb(&self, pair: &Pair) -> Verb {
        let verb = match self.does {
            PossibleChange::Opens { .. } => changes_to(Change::End),
            PossibleChange::Stays { .. } => ["stays on", "stay on"],
            PossibleChange::Sticks { .. } if pair.is_round() => ["rolls on", "roll on"],
            PossibleChange::Sticks { .. } => changes_to(Change::Sticks),
            PossibleChange::Slides { way, .. } => {
                let direction = self.direction(way);
                return ["slides", "slide"].map(|verb| format!("{verb} {direction} on"));
            }
        };
        verb.map(str::to_owned)
    }

    /// `to the right`, by the larger part of it.
    fn direction(&self, way: Way) -> &'static str {
        let [x, y] = self.forward.map(|part| if way == Way::Forward { part } else { -part });
        match (x.abs() >= y.abs(), x > 0.0, y > 0.0) {
            (true, true, _) => "to the right",
            (true, false, _) => "to the left",
            (false, _, true) => "upwards",
            (false, _, false) => "downwards",
        }
    }
}

/// What a contact is called in the table of a body's forces.
pub(super) fn contact(study: &Study, pair: &Pair, body: usize) -> String {
    format!("contact with {}", other(study, pair, body))
}

/// What a body of a pair touches: a surface, or the other body.
pub(super) fn other(study: &Study, pair: &Pair, body: usize) -> String {
    match pair.other == Some(body) {
        true => symbols::the(&study.model.bodies[pair.body].name),
        false => against(study, pair),
    }
}

/// One more point that does this to that.
fn add(groups: &mut Vec<(Verb, String, Vec<String>)>, (verb, to): (Verb, String), point: String) {
    match groups.iter_mut().find(|(known, other, _)| *known == verb && *other == to) {
        Some((.., points)) => points.push(point),
        None => groups.push((verb, to, vec![point])),
    }
}

/// What a load is called where its work and impulse are told, with its body where there are several.
pub(super) fn load(study: &Study, equations: &Equations, name: &str, body: Option<usize>) -> String {
    let is_of = |pair: &&Pair| pair.name == symbols::rubbed(name);
    let Some(pair) = equations.pairs().iter().find(is_of) else {
        let of = body.filter(|_| study.model.bodies.len() > 1);
        let on = of.map(|body| format!(" on {}", symbols::the(&study.model.bodies[body].name)));
        return symbols::holder(study, name).unwrap_or_else(|| spoken(name)) + &on.unwrap_or_default();
    };
    let friction = if symbols::rubbed(name) == name { "" } else { "friction of " };
    let is_other = pair.other.is_some() && pair.other == body;
    let (by, on) = (against(study, pair), point(study, pair));
    if is_other { format!("{friction}{on} on {by}") } else { format!("{friction}{by} on {on}") }
}

/// A name of the scene as it is spoken.
pub(crate) fn spoken(name: &str) -> String {
    name.replace(['-', '_'], " ")
}

#[cfg(test)]
mod tests {
    use super::either;

    #[test]
    fn sentences_that_share_little_are_both_told() {
        assert_eq!(
            either("the tip settles on the floor", "the tip slides on the floor"),
            "the tip settles or slides on the floor"
        );
        assert_eq!(either("nothing touches", "the rod holds"), "nothing touches, or the rod holds");
        // A comma is within the first.
        assert_eq!(either("a holds, b holds", "c rolls on d"), "a holds, b holds; or c rolls on d");
    }
}
