//! `[force.NAME]`: a force at a point of a body, or a torque.

use tumble_expr::{Dimension, Vector};
use tumble_mech::{Application, Frame, Load, Moment, Place};

use super::{body, each, points};
use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::names::Level;

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, load);
}

fn load(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a force", field);
    let on = draft.required(table, "on", "\"rod\"").and_then(|field| body(draft, &field));
    let application = application(draft, &name, on.as_deref(), table);
    let during = during(draft, &name, table);
    let (Some(body), Some(application), Some(during)) = (on, application, during) else { return };
    if during.is_some() {
        draft.names.windows.extend(["start", "end"].map(|end| format!("{name}.{end}")));
    }
    draft.model.loads.push(Load { name, body, application, during });
}

fn application(draft: &mut Draft, name: &str, on: Option<&str>, table: &mut Table) -> Option<Application> {
    match (table.take("force"), table.take("torque")) {
        (Some(force), None) => {
            draft.remember(format!("force of `{name}`"), &force.span);
            pushed(draft, name, on, table, &force)
        }
        (None, Some(torque)) => {
            draft.remember(format!("torque of `{name}`"), &torque.span);
            turned(draft, table, &torque)
        }
        (force, torque) => {
            let mistake = not_one(table, force.zip(torque));
            draft.note(mistake);
            // What belongs to the one or the other is no mistake of its own.
            let _ = (table.take("at"), table.take("frame"));
            None
        }
    }
}

fn not_one(table: &Table, both: Option<(Field, Field)>) -> Diagnostic {
    match both {
        Some((force, torque)) => {
            let message = format!("`{}` is a force and a torque", table.title);
            Diagnostic::new(Code::Exclusive, torque.key_span, message)
                .label("a torque")
                .also(force.key_span, "a force")
                .help("make them two sections, each with its name")
        }
        None => {
            let message = format!("`{}` has neither `force` nor `torque`", table.title);
            Diagnostic::new(Code::MissingKey, table.span.clone(), message)
                .help("add `force = [\"10 N\", 0]` with `at`, or `torque = \"1 N*m\"`")
        }
    }
}

fn pushed(
    draft: &mut Draft,
    name: &str,
    on: Option<&str>,
    table: &mut Table,
    force: &Field,
) -> Option<Application> {
    let force = draft.vector(force, Want::constant(Dimension::FORCE).at(Level::Motion));
    let at = draft.required(table, "at", &format!("\"{}.cm\"", on.unwrap_or("rod")));
    let at = at.zip(on).and_then(|(field, on)| {
        draft.remember(format!("place of `{name}`"), &field.span);
        place(draft, on, &field)
    });
    let frame = match table.take("frame") {
        Some(field) => draft.choice(&field, &["world", "body"])?,
        None => "world",
    };
    let frame = if frame == "body" { Frame::Body } else { Frame::World };
    Some(Application::Force { at: at?, force: force?, frame })
}

/// A torque is the same wherever it acts, and has no components.
fn turned(draft: &mut Draft, table: &mut Table, torque: &Field) -> Option<Application> {
    for key in ["at", "frame"] {
        let Some(field) = table.take(key) else { continue };
        let message = format!("`{}` is a torque and has no `{key}`", table.title);
        let mistake = Diagnostic::new(Code::Exclusive, field.key_span, message).label("only for a force");
        draft.note(mistake.help("a torque without a force turns a body in the same way wherever it acts"));
    }
    draft.number(torque, Want::constant(Dimension::TORQUE).at(Level::Motion)).map(Application::Torque)
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
    let mut inner = Table::new("at".to_owned(), field.key_span.clone(), table);
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
