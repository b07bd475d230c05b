//! Bodies that are alike: of many, one is shown in full, and the others are named with it.

use tumble_mech::Law;
use tumble_scene::Study;

use super::passed::Passed;
use crate::figures::symbols;

/// Of so many bodies each is shown; of more than these, one of each kind.
const MOST_SHOWN: usize = 3;
/// So many names are all said; of more than these, from where to where they are numbered, or the first two and the last.
const MOST_NAMED: usize = 4;

/// Bodies of one kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Kind {
    /// The one that is shown: that on which most acts.
    pub shown: usize,
    /// All of them, in order.
    pub bodies: Vec<usize>,
    /// Joints hold them: the equations of one say nothing of the others'.
    pub is_joined: bool,
}

impl Kind {
    /// The bodies whose equations of motion are told.
    pub(super) fn told(&self) -> &[usize] {
        if self.is_joined { &self.bodies } else { std::slice::from_ref(&self.shown) }
    }

    /// `the rod`, `link 2, and likewise link 3 and link 4`, or `b5, and likewise the other 14 of b1 to b15`.
    pub(super) fn name(&self, study: &Study) -> String {
        let name = |body: &usize| symbols::the(&study.model.bodies[*body].name);
        let (own, all) = (name(&self.shown), self.bodies.iter().map(name).collect::<Vec<_>>());
        let others: Vec<String> = all.iter().filter(|name| **name != own).cloned().collect();
        let each = if study.model.contacts.is_empty() { "" } else { ", each with its own contacts" };
        let likewise = match row(&all) {
            Some(row) if others.len() > MOST_NAMED => format!("the other {} of {row}", others.len()),
            _ => listed(&others),
        };
        if others.is_empty() { own } else { format!("{own}, and likewise {likewise}{each}") }
    }
}

/// The bodies by kind, a kind where its first body stands.
pub(super) fn kinds(study: &Study, passed: &[Vec<Passed<'_>>]) -> Vec<Kind> {
    let mut found: Vec<(Likeness, Kind, usize)> = vec![];
    for (body, passed) in passed.iter().enumerate() {
        let (likeness, loads) = likeness(study, passed, body);
        let same = found.iter_mut().find(|(other, ..)| *other == likeness);
        match same {
            Some((_, kind, most)) => {
                kind.bodies.push(body);
                if loads > *most {
                    (kind.shown, *most) = (body, loads);
                }
            }
            None => {
                let is_joined = likeness.is_joined;
                found.push((likeness, Kind { shown: body, bodies: vec![body], is_joined }, loads));
            }
        }
    }
    let kinds = found.into_iter().map(|(_, kind, _)| kind);
    if passed.len() > MOST_SHOWN {
        return kinds.collect();
    }
    let mut each: Vec<Kind> = kinds.flat_map(parted).collect();
    each.sort_by_key(|kind| kind.shown);
    each
}

/// One by one.
fn parted(kind: Kind) -> Vec<Kind> {
    let one = |body: &usize| Kind { shown: *body, bodies: vec![*body], ..kind };
    kind.bodies.iter().map(one).collect()
}

/// What bodies share that are alike.
#[derive(PartialEq)]
struct Likeness {
    /// Shapes, mass and moment of inertia, as formulas are written.
    properties: String,
    /// The loads on it; of contacts, what stands in the scene.
    loads: Vec<String>,
    is_joined: bool,
    /// The scene asks for its diagram.
    is_asked: bool,
}

/// Of a body, and how many loads there are on it.
fn likeness(study: &Study, passed: &[Passed<'_>], body: usize) -> (Likeness, usize) {
    let own = &study.model.bodies[body];
    let properties = own.mass_properties();
    let terms = passed.iter().flat_map(|Passed { case, mode }| case.run.equations.shown_terms(mode));
    let mut all: Vec<(String, Law)> =
        terms.filter(|term| term.body == body).map(|term| (term.load, term.law)).collect();
    all.sort_by(|one, other| one.0.cmp(&other.0));
    all.dedup_by(|one, other| one.0 == other.0);
    let count = all.len();
    let mut loads: Vec<String> = all.iter().map(|(load, law)| stated_as(study, load, *law)).collect();
    loads.sort();
    loads.dedup();
    let joints = &study.model.joints;
    let likeness = Likeness {
        properties: format!("{:?} {:?} {:?}", own.parts, properties.mass, properties.inertia),
        loads,
        is_joined: study.model.pivot_of(&own.name).is_some()
            || joints.iter().any(|joint| joint.bodies().any(|name| name == own.name)),
        is_asked: study.free_bodies.iter().any(|sheet| sheet.body == body),
    };
    (likeness, count)
}

/// The section of the scene that a load comes from.
fn stated_as(study: &Study, load: &str, law: Law) -> String {
    let pair = symbols::rubbed(load);
    match law {
        Law::Contact | Law::Friction | Law::Rolling => pair.split('.').next().unwrap_or(pair).to_owned(),
        Law::Reaction => held(study, load),
        _ => load.to_owned(),
    }
}

/// One pin between bodies is like another, and one pivot like another that holds the same point of its body; other holds are not.
fn held(study: &Study, load: &str) -> String {
    let (pivots, joints) = (&study.model.pivots, &study.model.joints);
    match pivots.iter().find(|pivot| pivot.name == load) {
        Some(pivot) => format!("pivot at {:?}", pivot.point),
        None if joints.iter().any(|joint| joint.name == load && joint.world().is_none()) => {
            "joint".to_owned()
        }
        None => load.to_owned(),
    }
}

/// Names in a row; of many, from where to where they are numbered, and where these are still many the first two and the last. Corners are
/// told by their numbers: `corners 1 and 2`.
pub(crate) fn listed(names: &[String]) -> String {
    let number = |name: &String| name.strip_prefix("corner ").map(str::to_owned);
    if names.len() > 1
        && let Some(numbers) = names.iter().map(number).collect::<Option<Vec<_>>>()
    {
        return format!("corners {}", listed(&numbers));
    }
    let names = if names.len() > MOST_NAMED { rows(names) } else { names.to_vec() };
    match &names[..] {
        [] => String::new(),
        [only] => only.clone(),
        [first, second, .., last] if names.len() > MOST_NAMED => format!("{first}, {second}, …, {last}"),
        [before @ .., last] => format!("{} and {last}", before.join(", ")),
    }
}

/// Names with those that are in a row as one.
fn rows(names: &[String]) -> Vec<String> {
    let runs = names.chunk_by(|a, b| follows(a, b));
    runs.flat_map(|run| row(run).filter(|_| run.len() > 2).map_or_else(|| run.to_vec(), |row| vec![row]))
        .collect()
}

/// `b1 to b15` of names that one number tells apart and that leave none out.
fn row(names: &[String]) -> Option<String> {
    let is_row =
        numbered(names.first()?).is_some() && names.windows(2).all(|pair| follows(&pair[0], &pair[1]));
    is_row.then(|| format!("{} to {}", names[0], names[names.len() - 1]))
}

/// Whether the second of two names has the next number.
fn follows(one: &str, next: &str) -> bool {
    numbered(one)
        .is_some_and(|(stem, number)| numbered(next) == number.checked_add(1).map(|next| (stem, next)))
}

/// The stem of a name, and the number that it ends with.
fn numbered(name: &str) -> Option<(&str, u32)> {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    Some((stem, name[stem.len()..].parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::motions_in;

    /// Balls side by side, some of them pushed.
    fn kinds_of(count: usize, pushed: &[usize]) -> Vec<Kind> {
        let ball = |index: usize| {
            format!(
                "[body.b{index}]\nball = {{ radius = \"1 cm\" }}\nmass = \"1 kg\"\nstart.at = [\"{index} m\", 0]\n"
            )
        };
        let push = |index: &usize| {
            format!("[force.push{index}]\non = \"b{index}\"\nat = \"b{index}.cm\"\nforce = [\"1 N\", 0]\n")
        };
        let head = "version = 1\nworld.gravity = \"9.81 m/s^2\"\nrun.until = \"0.1 s\"\n".to_owned();
        let scene =
            (1..=count).map(ball).chain(pushed.iter().map(push)).fold(head, |scene, part| scene + &part);
        let (study, cases) = motions_in("balls", scene.as_bytes(), &tumble_scene::NoFiles);
        kinds(&study, &super::super::passed::by_body(&cases))
    }

    #[test]
    fn of_many_that_are_alike_one_is_shown() {
        assert_eq!(kinds_of(7, &[]), [Kind { shown: 0, bodies: (0..7).collect(), is_joined: false }]);
        assert_eq!(kinds_of(3, &[]).len(), 3);
    }

    #[test]
    fn what_acts_makes_a_difference() {
        let kinds = kinds_of(8, &[2]);
        assert_eq!(kinds[0].bodies, [0, 2, 3, 4, 5, 6, 7]);
        assert_eq!(kinds[1], Kind { shown: 1, bodies: vec![1], is_joined: false });
    }

    #[test]
    fn many_names_are_said_by_the_first_and_the_last() {
        let names = |count: usize| (1..=count).map(|index| format!("b{index}")).collect::<Vec<_>>();
        assert_eq!(listed(&names(1)), "b1");
        assert_eq!(listed(&names(3)), "b1, b2 and b3");
        assert_eq!(listed(&names(15)), "b1 to b15");
        assert_eq!(
            listed(&names(15)[1..].iter().chain(&names(1)).cloned().collect::<Vec<_>>()),
            "b2 to b15 and b1"
        );
        let links = [names(6), vec!["the stone".to_owned()]].concat();
        assert_eq!(listed(&links), "b1 to b6 and the stone");
        let others = ["a", "b", "c", "d", "e"].map(str::to_owned);
        assert_eq!(listed(&others), "a, b, …, e");
        assert_eq!(listed(&["corner 1", "corner 2"].map(str::to_owned)), "corners 1 and 2");
    }
}
