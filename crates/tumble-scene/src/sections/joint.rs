//! `[pin.NAME]` and `[weld.NAME]`: keep a point of a body at a point of another or at a place.

use tumble_mech::{Anchor, Joint, JointKind, Kinematics, Pivot};

use super::{each, event_named as event, spring};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::quantities;

pub(super) const PIN: Keys = Keys::of("[pin.NAME]", &[JOINT]);
pub(super) const WELD: Keys = Keys::of("[weld.NAME]", &[JOINT]);

#[rustfmt::skip]
const JOINT: &[Declared] = &[
    must("between", Takes::Pair(&Takes::Either(&[Takes::POINT, Takes::BODY, Takes::Table(&spring::WORLD)])), "[\"upper.tip\", \"lower.top\"]",
        "two ends: `\"upper.tip\"`, or `{ world = [x, y] }`, which may depend on the time; of a joint with `from` the \
         second may be a body, `\"rod\"`: wherever the first end is on it then"),
    may("from", Takes::EVENT, "the start", "\"hit\"", "name of the event that makes it"),
    may("until", Takes::EVENT, "the end", "\"snap\"", "name of the event that releases it"),
    may("assemble", Takes::Flag, "`false`", "true",
        "`true`: bodies that do not fit together at the start are brought to where they do"),
];

pub(super) fn read_pins(draft: &mut Draft, section: &Field) {
    each(draft, section, &PIN, |draft, field, table| joint(draft, field, table, JointKind::Pin));
}

pub(super) fn read_welds(draft: &mut Draft, section: &Field) {
    each(draft, section, &WELD, |draft, field, table| joint(draft, field, table, JointKind::Weld));
}

/// What the second end of a joint may be besides an anchor: wherever the first is on a body when an event makes the joint.
enum Second {
    Anchor(Anchor),
    On(Kinematics),
}

fn joint(draft: &mut Draft, field: &Field, table: &mut Table, kind: JointKind) {
    let owner = if kind == JointKind::Pin { "a pin" } else { "a weld" };
    let name = draft.own_name(owner, field);
    draft.remember(format!("joint `{}`", field.key), &field.key_span);
    let from = table.take("from").map(|field| event(draft, &field));
    let until = table.take("until").map(|field| event(draft, &field));
    let between = ends(draft, table, from.is_some());
    let assemble = match table.take("assemble") {
        Some(field) => draft.flag(&field),
        None => Some(false),
    };
    let (Some((first, second)), Some(assemble)) = (between, assemble) else { return };
    let (from, until) = match (from, until) {
        (Some(None), _) | (_, Some(None)) => return,
        (from, until) => (from.flatten(), until.flatten()),
    };
    // Its force is that on a body: of a body and a place, the body comes first.
    let (first, second) = match (first, second) {
        (Anchor::World(place), Second::Anchor(body)) => (body, Second::Anchor(Anchor::World(place))),
        ends => ends,
    };
    let joint = |ends| {
        let joint = if kind == JointKind::Pin { Joint::pin(&name, ends) } else { Joint::weld(&name, ends) };
        Joint { assemble, from: from.clone(), until: until.clone(), ..joint }
    };
    let joint = match second {
        Second::Anchor(second) => joint([first, second]),
        Second::On(body) => joint([first.clone(), first]).seated_on(&body),
    };
    match pivot(draft, &joint) {
        Some(pivot) => {
            draft.remember(format!("pivot `{}`", field.key), &field.key_span);
            quantities::define_joint(&mut draft.names, &pivot.name, pivot.force_symbols().into());
            draft.model.pivots.push(pivot);
        }
        None => {
            quantities::define_joint(&mut draft.names, &joint.name, joint.multipliers());
            let ends = [joint.from.is_some().then_some("start"), joint.until.is_some().then_some("end")];
            draft.names.happenings.extend(ends.iter().flatten().map(|end| format!("{}.{end}", joint.name)));
            draft.names.happenings.insert("singular".to_owned());
            draft.model.join(joint);
        }
    }
}

/// A pin of a body and a place that always holds is a pivot, whose body is known by its angle alone; a body has one at most.
fn pivot(draft: &Draft, joint: &Joint) -> Option<Pivot> {
    let is_lasting = joint.from.is_none() && joint.until.is_none() && joint.kind == JointKind::Pin;
    let [Anchor::Material(point), Anchor::World(world)] = &joint.ends else { return None };
    let body = draft.model.bodies.iter().find(|body| body.name == point.body.body)?;
    let is_free = draft.model.pivot_of(&body.name).is_none();
    let start = draft.model.start_of(&body.name);
    let is_placed = start.at.is_some() || start.velocity.is_some();
    (is_lasting && is_free && !is_placed).then(|| Pivot {
        name: joint.name.clone(),
        body: body.name.clone(),
        point: &point.arm + &body.mass_properties().centre,
        world: world.clone(),
    })
}

/// `between = ["upper.tip", "lower.top"]`, `["rod.tip", { world = [0, 0] }]`, or of a joint that an event makes `["bullet.cm", "rod"]`.
fn ends(draft: &mut Draft, table: &mut Table, is_made: bool) -> Option<(Anchor, Second)> {
    let field = draft.required(table, "between")?;
    let pair = draft.pair(&field, "[one end, the other end]")?;
    let first = spring::anchor(draft, &pair[0]);
    let named = pair[1].value.as_str().filter(|name| draft.names.bodies.iter().any(|body| body == name));
    let second = match named {
        Some(body) if is_made => Some(Second::On(Kinematics::new(body))),
        Some(body) => {
            let message = format!("\"{body}\" is a body: which point of it is joined?");
            let mistake =
                Diagnostic::new(Code::UnknownPoint, pair[1].span.clone(), message).label("a point is needed");
            let known = format!("{body}.cm");
            draft.note(mistake.help(format!(
                "write a point, such as \"{known}\"; a body alone stands for the place where the joint is when an event makes it (`from`)"
            )));
            None
        }
        None => spring::anchor(draft, &pair[1]).map(Second::Anchor),
    };
    let (first, second) = (first?, second?);
    let mistake = match (&first, &second) {
        (Anchor::World(_), Second::Anchor(Anchor::World(_))) => {
            "both ends belong to the world, and nothing is kept"
        }
        (Anchor::World(_), Second::On(_)) => "a place is joined to a body: write the body's point first",
        (Anchor::Material(a), Second::Anchor(Anchor::Material(b))) if a.body == b.body => {
            "both ends belong to one rigid body, which keeps them where they are anyway"
        }
        (Anchor::Material(a), Second::On(b)) if a.body == *b => {
            "both ends belong to one rigid body, which keeps them where they are anyway"
        }
        _ => return Some((first, second)),
    };
    draft.note(Diagnostic::new(Code::Exclusive, field.span, mistake).label("joins nothing"));
    None
}
