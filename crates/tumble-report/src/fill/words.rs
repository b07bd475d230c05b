//! What touches, what acts and what happens, in words: `the tail presses on the floor`.

use tumble_expr::is_identically_zero;
use tumble_mech::{
    Change, ContactMode, Equations, Grip, Happening, Mode, Others, Pair, PossibleChange, Record, Way,
};
use tumble_ode::Occurrence;
use tumble_scene::Study;

use crate::figures::symbols;

/// More groups of contacts than these are counted.
const MOST_GROUPS: usize = 3;
/// More contacts of one group than these are counted.
const MOST_NAMED: usize = 4;
/// More groups than these that change at one instant are counted, where bodies meet each other.
const MOST_CHANGES: usize = 5;

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
        false => format!("without {}", symbols::joint(&joint.name)),
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
        (true, true) => "all the time".to_owned(),
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
        return format!("{one}, or {other}");
    }
    let [start, end] = [&first[..before], &first[first.len() - after..]].map(|words| words.join(" "));
    format!("{start} {} or {} {end}", own(&first), own(&second)).trim_end().to_owned()
}

/// Contacts by what they do and to what; of many groups, how many do what.
fn contacts(study: &Study, equations: &Equations, mode: &Mode) -> Vec<String> {
    let mut groups: Vec<(Verb, String, Vec<String>)> = vec![];
    for (index, contact_mode) in &mode.contacts {
        let pair = &equations.pairs()[*index];
        let does = (verb(*contact_mode, grip(equations, mode, *index), pair), against(study, pair));
        add(&mut groups, does, point(study, pair));
    }
    if groups.len() > MOST_GROUPS {
        return counted(&groups);
    }
    groups.iter().map(|(verb, to, points)| group(verb, to, points)).collect()
}

/// `the tail and the tip press on the floor`; whose points they are is said once.
fn group(verb: &Verb, to: &str, points: &[String]) -> String {
    let whose = |point: &str| point.split_once(OF).map(|(_, body)| body.to_owned());
    match points {
        [only] => format!("{only} {} {to}", verb[0]),
        many if many.len() > MOST_NAMED => format!("{} points {} {to}", many.len(), verb[1]),
        [before @ .., last] => {
            let is_one = before.iter().all(|point| whose(point).is_some() && whose(point) == whose(last));
            let short = |point: &String| match point.split_once(OF).filter(|_| is_one) {
                Some((point, _)) => point.to_owned(),
                None => point.clone(),
            };
            let before: Vec<String> = before.iter().map(short).collect();
            format!("{} and {last} {} {to}", before.join(", "), verb[1])
        }
        [] => String::new(),
    }
}

/// `12 contacts: 9 touch, 3 roll on`
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
        [(word, _)] => format!("{all} contacts {word}"),
        _ => format!("{all} contacts: {}", each.join(", ")),
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
        (ContactMode::Resting, None) | (ContactMode::Idle, _) => ["touches", "touch"],
        (_, Some(Grip::Sticks | Grip::Follows)) if is_round(pair) => ["rolls on", "roll on"],
        (_, Some(Grip::Sticks | Grip::Follows)) => ["sticks to", "stick to"],
        (_, Some(Grip::Slides(_))) => ["slides on", "slide on"],
        (_, Some(Grip::Strains(_))) => ["is on the point of sliding on", "are on the point of sliding on"],
    };
    verb.map(str::to_owned)
}

fn is_round(pair: &Pair) -> bool {
    !is_identically_zero(&pair.radius)
}

/// What touches: a round body, or a point of one, with its body where there are several; a corner that the scene has no name for
/// always.
fn point(study: &Study, pair: &Pair) -> String {
    let model = &study.model.bodies[pair.body];
    let (body, point) = (symbols::the(&model.name), symbols::last(&pair.name));
    let is_named = !is_corner(point) || model.points.iter().any(|(name, _)| name == point);
    match (is_round(pair) || pair.other.is_some(), study.model.bodies.len()) {
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
fn against(study: &Study, pair: &Pair) -> String {
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
            PossibleChange::Sticks { .. } if is_round(pair) => ["rolls on", "roll on"],
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

/// All that happens at an instant; points that do the same are told together.
pub(crate) fn event(study: &Study, equations: &Equations, event: &Occurrence<Record>) -> String {
    let mut changed: Vec<(usize, Vec<Change>)> = vec![];
    let mut told: Vec<String> = vec![];
    for one in &event.record.happened {
        match *one {
            Happening::Contact { pair, change } => match changed.iter_mut().find(|(of, _)| *of == pair) {
                Some((_, changes)) => changes.push(change),
                None => changed.push((pair, vec![change])),
            },
            _ => told.push(happening(study, equations, one)),
        }
    }
    let mut groups: Vec<(Verb, String, Vec<String>)> = vec![];
    for (pair, changes) in changed {
        let pair = &equations.pairs()[pair];
        add(&mut groups, (all_of(&changes, event.time == 0.0), against(study, pair)), point(study, pair));
    }
    told.extend(match groups.len() > MOST_CHANGES {
        true => pairs_of_bodies(&groups),
        false => groups.iter().map(|(verb, to, points)| group(verb, to, points)).collect(),
    });
    let is_possible = |others: &Others| matches!(others, Others::Possible(_));
    told.extend(event.record.others.iter().any(is_possible).then(|| "other motions are possible".to_owned()));
    told.join(", ")
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
        _ => format!("{count} pairs of bodies {} each other", verb[1]),
    };
    kinds.into_iter().map(one).collect()
}

/// All that one contact does at an instant: `strikes and sticks to`. What holds from then on tells that it touches.
fn all_of(changes: &[Change], is_start: bool) -> Verb {
    let lasts = |change: &Change| matches!(change, Change::Slides | Change::Sticks | Change::Rolls);
    let is_told = |change: &&Change| **change != Change::Start || !changes.iter().any(lasts);
    let stays = changes.contains(&Change::Impact);
    let verbs: Vec<[&str; 2]> = changes
        .iter()
        .filter(is_told)
        .map(|change| match change {
            Change::Start if stays => ["stays on", "stay on"],
            Change::Start if is_start => ["touches", "touch"],
            Change::Slides if is_start => ["slides on", "slide on"],
            Change::Rolls if is_start => ["rolls on", "roll on"],
            other => changes_to(*other),
        })
        .collect();
    [0, 1].map(|number| verbs.iter().map(|verb| verb[number]).collect::<Vec<_>>().join(" and "))
}

/// One more point that does this to that.
fn add(groups: &mut Vec<(Verb, String, Vec<String>)>, (verb, to): (Verb, String), point: String) {
    match groups.iter_mut().find(|(known, other, _)| *known == verb && *other == to) {
        Some((.., points)) => points.push(point),
        None => groups.push((verb, to, vec![point])),
    }
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

fn changes_to(change: Change) -> [&'static str; 2] {
    match change {
        Change::Impact => ["strikes", "strike"],
        Change::Zeno => {
            ["bounces no higher than can be followed on", "bounce no higher than can be followed on"]
        }
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
pub(super) fn spoken(name: &str) -> String {
    name.replace(['-', '_'], " ")
}

#[cfg(test)]
mod tests {
    use super::event;
    use crate::scenes::{all, motions_of};

    /// What happens at each event of the first run of a scene.
    fn events(scene: &str) -> Vec<String> {
        let folder = all().find(|path| path.to_string_lossy().contains(scene)).expect("a scene");
        let (study, cases) = motions_of(&folder);
        let run = &cases[0].run;
        run.events().map(|one| event(&study, &run.equations, one)).collect()
    }

    #[test]
    fn a_corner_without_a_name_of_its_own_is_that_of_a_body() {
        let block = events("17-block-on-a-slope");
        assert_eq!(block[1], "corner 1 of the block sticks to the floor", "{block:?}");
    }

    #[test]
    fn points_that_do_the_same_are_told_together() {
        assert_eq!(events("16-bench"), ["the left, the middle and the right touch the floor".to_owned()]);
        let falling = events("10-falling-rod");
        assert!(
            falling
                .iter()
                .any(|text| text
                    .contains("the foot strikes the floor, the head strikes and stays on the floor")),
            "{falling:?}"
        );
    }
}
