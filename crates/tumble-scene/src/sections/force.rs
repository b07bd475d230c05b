//! `[force.NAME]`: a force at a point of a body, or a torque; `[impulse.NAME]`: the impulse of one that lasts no time, at each of the
//! events of a name.

use tumble_expr::{Dimension, Vector};
use tumble_mech::{Application, AppliedImpulse, Change, Frame, Load, Moment, Place};

use super::{body, each, event_named as event, points};
use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::names::Level;

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[force.NAME]", &[&[
    ON,
    may("force", Takes::Vector(Dimension::FORCE), "this or `torque`", "[\"10 N\", 0]", "components `[x, y]`"),
    may("torque", Takes::Quantity(Dimension::TORQUE), "this or `force`", "\"1 N*m\"", "counter-clockwise"),
    may("at", PLACE, "needed with `force`", "\"rod.cm\"", "where it acts"),
    FRAME,
    may("during", Takes::Pair(&Takes::Either(&[Takes::TIME, Takes::EVENT])), "always", "[\"1 s\", \"2 s\"]",
        "`[start, end]`: times, or names of events"),
]])
.one_of(&[&["force", "torque"]]);

#[rustfmt::skip]
pub(super) const IMPULSES: Keys = Keys::of("[impulse.NAME]", &[&[
    ON,
    must("when", Takes::EVENT, "\"hit\"", "name of the event"),
    may("impulse", Takes::Vector(Dimension::MOMENTUM), "this or `angular_impulse`", "[\"10 N*s\", 0]",
        "components `[x, y]`, N*s; formulas of the motion as it is before"),
    may("angular_impulse", Takes::Quantity(ANGULAR_IMPULSE), "this or `impulse`", "\"1 N*m*s\"",
        "counter-clockwise, N*m*s"),
    may("at", PLACE, "needed with `impulse`", "\"rod.cm\"",
        "where it acts, as the `at` of a [force](#forcename)"),
    FRAME,
]])
.one_of(&[&["impulse", "angular_impulse"]]);

const ON: Declared = must("on", Takes::BODY, "\"rod\"", "name of the body");
#[rustfmt::skip]
const FRAME: Declared = may("frame", Takes::Word(&FRAMES), "`\"world\"`", "\"body\"",
    "axes of the components: `\"world\"` or `\"body\"`");
const FRAMES: [&str; 2] = ["world", "body"];
const PLACE: Takes = Takes::Either(&[Takes::POINT, Takes::Table(&AT)]);

#[rustfmt::skip]
const AT: Keys = Keys::of("place of a force", &[&[
    may("body", Takes::PLACE, "one of three", "[0, 0]", "a place in body coordinates"),
    may("world", Takes::PLACE, "one of three", "[0, 0]", "a place in the world"),
    may("from_centre", Takes::PLACE, "one of three", "[0, 0]",
        "seen from the centre of mass, in axes of the world"),
]])
.one_of(&[&["body", "world", "from_centre"]]);

const ANGULAR_IMPULSE: Dimension = Dimension::new(2, 1, -1);

/// How a kind of load is written.
struct Words {
    /// Keys of what acts at a point and of what turns only.
    keys: [&'static str; 2],
    /// What messages call them.
    what: [&'static str; 2],
    one: [&'static str; 2],
    dimensions: [Dimension; 2],
    /// What their formulas may depend on.
    level: Level,
    example: &'static str,
}

const FORCE: Words = Words {
    keys: ["force", "torque"],
    what: ["force", "torque"],
    one: ["a force", "a torque"],
    dimensions: [Dimension::FORCE, Dimension::TORQUE],
    level: Level::Forces,
    example: "add `force = [\"10 N\", 0]` with `at`, or `torque = \"1 N*m\"`",
};

const IMPULSE: Words = Words {
    keys: ["impulse", "angular_impulse"],
    what: ["impulse", "angular impulse"],
    one: ["an impulse", "an angular impulse"],
    dimensions: [Dimension::MOMENTUM, ANGULAR_IMPULSE],
    level: Level::Motion,
    example: "add `impulse = [\"10 N*s\", 0]` with `at`, or `angular_impulse = \"1 N*m*s\"`",
};

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, load);
}

pub(super) fn read_impulses(draft: &mut Draft, section: &Field) {
    each(draft, section, &IMPULSES, impulse);
}

fn load(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a force", field);
    let on = draft.required(table, "on").and_then(|field| body(draft, &field));
    let application = application(draft, &FORCE, &name, on.as_deref(), table);
    let during = during(draft, &name, table);
    let (Some(body), Some(application), Some(during)) = (on, application, during) else { return };
    if during.is_some() {
        draft.names.happenings.extend(["start", "end"].map(|end| format!("{name}.{end}")));
    }
    if has_signs(&application) {
        let changes = [Change::Sticks, Change::Slides].map(|change| format!("{name}.{}", change.word()));
        draft.names.happenings.extend(changes);
    }
    draft.model.loads.push(Load { name, body, application, during });
}

/// Whether what it is may stay at a sign that is zero, as dry friction does.
fn has_signs(application: &Application) -> bool {
    match application {
        Application::Torque(torque) => !torque.signs().is_empty(),
        Application::Force { force, .. } => force.components().iter().any(|part| !part.signs().is_empty()),
    }
}

fn impulse(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("an impulse", field);
    let on = draft.required(table, "on").and_then(|field| body(draft, &field));
    let application = application(draft, &IMPULSE, &name, on.as_deref(), table);
    let when = draft.required(table, "when").and_then(|field| event(draft, &field));
    let (Some(body), Some(application), Some(when)) = (on, application, when) else { return };
    draft.names.happenings.insert(name.clone());
    draft.remember(format!("impulse `{name}`"), &field.key_span);
    draft.model.impulses.push(AppliedImpulse { name, body, when, application });
}

fn application(
    draft: &mut Draft,
    words: &Words,
    name: &str,
    on: Option<&str>,
    table: &mut Table,
) -> Option<Application> {
    match (table.take(words.keys[0]), table.take(words.keys[1])) {
        (Some(force), None) => {
            draft.remember(format!("{} of `{name}`", words.what[0]), &force.span);
            pushed(draft, words, name, on, table, &force)
        }
        (None, Some(torque)) => {
            draft.remember(format!("{} of `{name}`", words.what[1]), &torque.span);
            turned(draft, words, table, &torque)
        }
        (force, torque) => {
            let mistake = not_one(words, table, force.zip(torque));
            draft.note(mistake);
            // What belongs to the one or the other is no mistake of its own.
            table.ignore();
            None
        }
    }
}

fn not_one(words: &Words, table: &Table, both: Option<(Field, Field)>) -> Diagnostic {
    let [[a_force, a_torque], [force_key, torque_key]] = [words.one, words.keys];
    match both {
        Some((force, torque)) => {
            let message = format!("`{}` is {a_force} and {a_torque}", table.title);
            Diagnostic::new(Code::Exclusive, torque.key_span, message)
                .label(a_torque)
                .also(force.key_span, a_force)
                .help("make them two sections, each with its name")
        }
        None => {
            let message = format!("`{}` has neither `{force_key}` nor `{torque_key}`", table.title);
            Diagnostic::new(Code::MissingKey, table.span.clone(), message).help(words.example)
        }
    }
}

fn pushed(
    draft: &mut Draft,
    words: &Words,
    name: &str,
    on: Option<&str>,
    table: &mut Table,
    force: &Field,
) -> Option<Application> {
    let force = draft.vector(force, Want::constant(words.dimensions[0]).at(words.level));
    let at = draft.required_like(table, "at", &format!("\"{}.cm\"", on.unwrap_or("rod")));
    let at = at.zip(on).and_then(|(field, on)| {
        draft.remember(format!("place of `{name}`"), &field.span);
        place(draft, on, &field)
    });
    let frame = match table.take("frame") {
        Some(field) => draft.choice(&field, &FRAMES)?,
        None => "world",
    };
    let frame = if frame == "body" { Frame::Body } else { Frame::World };
    Some(Application::Force { at: at?, force: force?, frame })
}

/// A torque is the same wherever it acts, and has no components.
fn turned(draft: &mut Draft, words: &Words, table: &mut Table, torque: &Field) -> Option<Application> {
    for key in ["at", "frame"] {
        let Some(field) = table.take(key) else { continue };
        let [a_force, a_torque] = words.one;
        let message = format!("`{}` is {a_torque} and has no `{key}`", table.title);
        let mistake =
            Diagnostic::new(Code::Exclusive, field.key_span, message).label(format!("only for {a_force}"));
        draft.note(mistake.help("a torque without a force turns a body in the same way wherever it acts"));
    }
    draft.number(torque, Want::constant(words.dimensions[1]).at(words.level)).map(Application::Torque)
}

/// `"rod.tip"`, `{ body = [..] }`, `{ world = [..] }` or `{ from_centre = [..] }`.
fn place(draft: &mut Draft, on: &str, field: &Field) -> Option<Place> {
    if field.value.as_str().is_some() {
        let local = points::of_body(draft, on, field)?;
        return material(draft, on, &local);
    }
    let Some(table) = field.value.as_table() else {
        let expected =
            "the name of a point, or one of { body = [..] }, { world = [..] }, { from_centre = [..] }";
        draft.wrong_type(field, expected);
        return None;
    };
    let mut inner = Table::new(&AT, "at".to_owned(), field.key_span.clone(), table);
    let place = one_place(draft, on, &field.span, &mut inner);
    draft.done(inner);
    place
}

fn one_place(draft: &mut Draft, on: &str, span: &Span, table: &mut Table) -> Option<Place> {
    let given = ["body", "world", "from_centre"].map(|key| table.take(key));
    let count = given.iter().flatten().count();
    if count != 1 {
        // A key that is not known is the mistake then.
        if table.fields.is_empty() {
            let message = format!("`at` is one of `body`, `world` and `from_centre`, not {count} of them");
            draft.note(Diagnostic::new(Code::Exclusive, span.clone(), message));
        }
        return None;
    }
    let [local, world, offset] = given;
    let moving = Want::constant(Dimension::LENGTH).at(Level::Motion);
    if let Some(local) = local {
        let local = draft.place(&local)?;
        return material(draft, on, &local);
    }
    let world = world.map(|field| draft.vector(&field, moving).map(Place::World));
    let offset = offset.map(|field| draft.vector(&field, moving).map(Place::FromCentre));
    world.or(offset).flatten()
}

fn material(draft: &Draft, on: &str, local: &Vector) -> Option<Place> {
    let body = draft.model.bodies.iter().find(|body| body.name == on)?;
    Some(Place::Material(body.at(local)))
}

/// The inner `None` is always; the outer one a mistake.
fn during(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Option<[Moment; 2]>> {
    let Some(field) = table.take("during") else { return Some(None) };
    draft.remember(format!("times of `{name}`"), &field.span);
    let [from, to] = draft.pair(&field, "[start, end]")?;
    let (from, to) = (moment(draft, &from), moment(draft, &to));
    Some(Some([from?, to?]))
}

/// A time, or the name of an event.
fn moment(draft: &mut Draft, field: &Field) -> Option<Moment> {
    let text = field.value.as_str().map(str::trim);
    match draft.names.events.iter().find(|event| Some(event.as_str()) == text) {
        Some(name) => Some(Moment::Event(name.clone())),
        None => draft.number(field, Want::constant(Dimension::TIME)).map(Moment::Time),
    }
}
