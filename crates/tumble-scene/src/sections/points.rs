//! Points of bodies: `points.tip = [0, "L"]` gives one a name, other sections use it as `"rod.tip"`.

use tumble_expr::Vector;
use tumble_mech::{Body, PointRef};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table, fields};
use crate::draft::Draft;
use crate::names::fit_point;
use crate::suggest;

/// The named points of a body.
pub(super) fn read(draft: &mut Draft, body: &str, table: &mut Table) -> Vec<(String, Vector)> {
    let Some(field) = table.take("points") else { return vec![] };
    let Some(points) = field.value.as_table() else {
        draft.wrong_type(&field, "a table of places, such as `points.tip = [0, \"1 m\"]`");
        return vec![];
    };
    let mut sound = vec![];
    for point in fields(points) {
        match named(draft, &point) {
            Some(point) => sound.push(point),
            None => draft.names.break_name(&format!("{body}.{}", point.key)),
        }
    }
    sound
}

fn named(draft: &mut Draft, field: &Field) -> Option<(String, Vector)> {
    let fits = fit_point(field);
    let (fits, at) = (draft.noted(fits), draft.place(field));
    fits.and(at).map(|at| (field.key.to_owned(), at))
}

/// A point of a body, m, body coordinates: its name `"rod.tip"` or its place. `body` must exist.
pub(super) fn of_body(draft: &mut Draft, body: &str, field: &Field) -> Option<Vector> {
    if field.value.as_str().is_none() {
        return draft.place(field);
    }
    let name = draft.words(field)?;
    // A body with mistakes is not there; nor can its points be looked up.
    let found = draft.model.bodies.iter().find(|known| known.name == body)?.clone();
    let point = name.strip_prefix(body).and_then(|rest| local(&found, rest.strip_prefix('.')?));
    if point.is_none() && !draft.names.is_broken(&name) {
        draft.note(unknown(&found, &name, field));
    }
    point
}

/// A point of any body by its full name, `"rod.tip"`.
pub(super) fn named_anywhere(draft: &mut Draft, field: &Field) -> Option<PointRef> {
    let name = draft.words(field)?;
    let (body, point) = name.split_once('.').unwrap_or((&name, ""));
    if draft.names.bodies.iter().any(|known| known == body) {
        // A body with mistakes is not there; nor can its points be looked up.
        let found = draft.body_named(body)?;
        let at = found.named_point(point);
        if at.is_none() && !draft.names.is_broken(&name) {
            draft.note(unknown(&found, &name, field));
        }
        return at;
    }
    let points: Vec<String> = draft.model.bodies.iter().flat_map(known_points).collect();
    let known = points.iter().map(String::as_str);
    let help = suggest::name(&name, "points", known);
    let message = format!("there is no point \"{name}\"");
    draft.note(
        Diagnostic::new(Code::UnknownPoint, field.span.clone(), message).label("unknown point").help(help),
    );
    None
}

/// `rod.tip`, `rod.cm`
fn known_points(body: &Body) -> Vec<String> {
    let points = body.points.iter().map(|(point, _)| point.as_str()).chain(["cm"]);
    points.map(|point| format!("{}.{point}", body.name)).collect()
}

fn local(body: &Body, name: &str) -> Option<Vector> {
    match name {
        "cm" => Some(body.mass_properties().centre),
        _ => body.points.iter().find(|(known, _)| known == name).map(|(_, at)| at.clone()),
    }
}

fn unknown(body: &Body, name: &str, field: &Field) -> Diagnostic {
    let known = known_points(body);
    let whole = format!("{}.{name}", body.name);
    let help = match known.contains(&whole) {
        true => format!("write \"{whole}\""),
        false => suggest::name(name, "points", known.iter().map(String::as_str)),
    };
    let message = format!("`{}` has no point \"{name}\"", body.name);
    Diagnostic::new(Code::UnknownPoint, field.span.clone(), message).label("unknown point").help(help)
}
