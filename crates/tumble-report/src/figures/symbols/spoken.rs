//! Quantities, bodies and points in running text.

use std::collections::BTreeMap;

use tumble_drawing::Label;
use tumble_expr::language::is_name;
use tumble_mech::Gravity;
use tumble_scene::Study;

use super::{QUANTITIES, label};

/// Words for coordinates of a plane that is seen from above.
const FROM_ABOVE: [&str; 2] = ["position", "velocity"];

/// What a quantity is in words: `angle of the rod`, with the body's name where there are several; none of other formulas.
pub(crate) fn words(study: &Study, text: &str) -> Option<String> {
    let noun = noun(study, text)?;
    let (owner, _) = without_unit(text).rsplit_once('.')?;
    let bodies = &study.model.bodies;
    let is_one_of_many = bodies.len() > 1 && bodies.iter().any(|body| body.name == owner);
    let point = owner.split_once('.').and_then(|(body, point)| {
        let own = bodies.iter().find(|own| own.name == body)?;
        own.points.iter().any(|(name, _)| name == point).then(|| (the_point(point), the(body)))
    });
    Some(match point {
        Some((point, body)) if bodies.len() > 1 => format!("{noun} of {point} of {body}"),
        Some((point, _)) => format!("{noun} of {point}"),
        None if is_one_of_many => format!("{noun} of {}", the(owner)),
        None => noun.to_owned(),
    })
}

/// What a quantity is called in a sentence: words and symbol where it has them, `angle θ`.
pub(crate) fn called(study: &Study, symbols: &BTreeMap<String, String>, text: &str) -> Label {
    let name = without_unit(text);
    if is_name(name) && name.contains('.') && !symbols.contains_key(name) {
        return Label::plain(&in_words(study, name));
    }
    let label = label(symbols, text);
    if let Some(meaning) = study.meanings.get(name) {
        return Label::markup(meaning).then(Label::plain(" (")).then(label).then(Label::plain(")"));
    }
    match of_surface(study, name).or_else(|| words(study, text)) {
        Some(words) => Label::plain(&format!("{words} ")).then(label),
        None => label,
    }
}

/// `normal force of the floor`: a surface is none of the bodies that a quantity is of without saying so.
fn of_surface(study: &Study, name: &str) -> Option<String> {
    let (owner, _) = name.rsplit_once('.')?;
    study.model.surfaces.iter().find(|surface| surface.name == owner)?;
    Some(format!("{} of {}", noun(study, name)?, the(owner)))
}

/// Whether a name is one of what an event has left behind, which does not change any more.
pub(crate) fn is_moment(study: &Study, name: &str) -> bool {
    let is_event = study.model.events.iter().any(|event| event.name == name);
    is_name(name) && (name.contains(".contact[") || name.ends_with(".rolls") || is_event)
}

/// A quantity that has no symbol: `start of contact 1 with the floor`, `work of the spring`.
pub(crate) fn in_words(study: &Study, name: &str) -> String {
    if let Some((place, rest)) = name.split_once(".contact[")
        && let Some((number, part)) = rest.split_once("].")
    {
        let part = match part {
            "impulse.x" => "horizontal impulse",
            "impulse.y" => "vertical impulse",
            other => other,
        };
        return format!("{part} of contact {number} {}", touching(study, place, "with"));
    }
    let Some((owner, last)) = name.rsplit_once('.') else { return format!("time of “{name}”") };
    match noun(study, name) {
        Some(noun) if owner.contains('.') => format!("{noun} {}", touching(study, owner, "on")),
        Some(noun) => format!("{noun} of {}", holder(study, owner).unwrap_or_else(|| the(owner))),
        None if last == "rolls" => format!("beginning of rolling {}", touching(study, owner, "on")),
        None => format!("{last} of {}", the(owner)),
    }
}

/// What touches and where: `with the floor` of `floor`, `of corner 2 with the floor` of `floor.block.corner2`.
fn touching(study: &Study, place: &str, with: &str) -> String {
    let parts: Vec<&str> = place.split('.').collect();
    match parts[..] {
        [contact, a, b] if study.model.contacts.iter().any(|known| known.name == contact) => {
            format!("of {} {with} {}", the(a), the(b))
        }
        [surface, body] | [surface, body, "rim"] => format!("of {} {with} {}", the(body), the(surface)),
        [surface, _, point] => format!("of {} {with} {}", the(point), the(surface)),
        _ => format!("{with} {}", the(place)),
    }
}

/// The same without the body.
pub(crate) fn noun(study: &Study, text: &str) -> Option<&'static str> {
    let (owner, quantity) = without_unit(text).rsplit_once('.')?;
    let known = QUANTITIES.into_iter().find(|(name, ..)| *name == quantity && !owner.contains(' '))?;
    Some(match (&study.model.gravity, quantity) {
        (Gravity::Horizontal(_), "x" | "y") => FROM_ABOVE[0],
        (Gravity::Horizontal(_), "vx" | "vy") => FROM_ABOVE[1],
        _ => known.2,
    })
}

/// Without the unit that a value is asked for in.
pub(crate) fn without_unit(text: &str) -> &str {
    text.rsplit_once(" in ").map_or(text, |(formula, _)| formula)
}

/// A body or point in running text: `the rod`, `the front wheel` of `front_wheel`, but `link 6` and `A`.
pub(crate) fn the(name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let is_word = stem.chars().count() > 1 && stem.chars().all(|c| c.is_lowercase() || c == '_' || c == '-');
    match (is_word, stem.len() == name.len()) {
        (false, _) => name.to_owned(),
        (true, true) => format!("the {}", name.replace(['_', '-'], " ")),
        (true, false) => format!("{} {}", stem.replace(['_', '-'], " ").trim_end(), &name[stem.len()..]),
    }
}

/// A point of a body in running text: `the tail`; the ends of a rod have names that are no words for them, `the end "from"`.
pub(crate) fn the_point(name: &str) -> String {
    if ["from", "to"].contains(&name) { format!("the end \u{201c}{name}\u{201d}") } else { the(name) }
}

/// A body or point in a list or a picture: `rod`, `link 6`.
pub(crate) fn bare(name: &str) -> String {
    let spoken = the(name);
    spoken.strip_prefix("the ").map(str::to_owned).unwrap_or(spoken)
}

/// A pivot or joint in running text: `the hinge`, `joint 3`, but `pin A`.
pub(crate) fn joint(name: &str) -> String {
    let spoken = the(name);
    let is_letter = spoken.starts_with(|c: char| c.is_uppercase());
    if is_letter { format!("pin {spoken}") } else { spoken }
}

/// The pivot or joint of this name in running text, if it is one.
pub(crate) fn holder(study: &Study, name: &str) -> Option<String> {
    let pivots = study.model.pivots.iter().map(|pivot| &pivot.name);
    let mut all = pivots.chain(study.model.joints.iter().map(|joint| &joint.name));
    all.any(|known| known == name).then(|| joint(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_spoken() {
        let spoken = ["rod", "front_wheel", "corner1", "A", "link-12"].map(the);
        assert_eq!(spoken, ["the rod", "the front wheel", "corner 1", "A", "link 12"]);
    }
}
