//! Points of bodies: `points.tip = [0, "L"]` gives one a name, other sections use it as `"rod.tip"`.

use std::collections::BTreeMap;

use tumble_expr::Vector;
use tumble_mech::{Body, PointRef};

use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table, fields};
use crate::draft::Draft;
use crate::names::fit_point;
use crate::suggest;

/// The point that every body has.
const CENTRE: &str = "cm";

/// The named points of a body.
pub(super) fn read(draft: &mut Draft, body: &str, table: &mut Table) -> Vec<(String, Vector)> {
    let Some(field) = table.take("points") else { return vec![] };
    let Some(points) = field.value.as_table() else {
        draft.wrong_type(&field, "a table of places, such as `points.tip = [0, \"1 m\"]`");
        return vec![];
    };
    let mut sound = vec![];
    for point in fields(points) {
        draft.remember(format!("point `{body}.{}`", point.key), &point.span);
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

/// The names of all points by their bodies, known before anything of them is read: a body with mistakes has points too.
pub(super) fn all_names(top: &[Field]) -> BTreeMap<String, Vec<String>> {
    let bodies = top.iter().find(|field| field.key == "body").and_then(|field| field.value.as_table());
    let of_body = |body: Field| {
        let points = body.value.as_table().and_then(|body| body.get("points"));
        let points = points.and_then(|points| points.get_ref().as_table()).map(fields).unwrap_or_default();
        let names = points.iter().map(|point| point.key).chain([CENTRE]).map(str::to_owned);
        (body.key.to_owned(), names.collect())
    };
    bodies.map(fields).unwrap_or_default().into_iter().map(of_body).collect()
}

/// A point of a body, m, body coordinates: its name `"rod.tip"` or its place. `body` must exist.
pub(super) fn of_body(draft: &mut Draft, body: &str, field: &Field) -> Option<Vector> {
    if field.value.as_str().is_none() {
        return draft.place(field);
    }
    let name = draft.words(field)?;
    let point = name.strip_prefix(body).and_then(|rest| rest.strip_prefix('.')).unwrap_or_default();
    refuse_unknown(draft, body, (&name, point), field);
    // A body with mistakes is not there; nor can its points be looked up.
    local(draft.model.bodies.iter().find(|known| known.name == body)?, point)
}

/// A point of any body by its full name, `"rod.tip"`.
pub(super) fn named_anywhere(draft: &mut Draft, field: &Field) -> Option<PointRef> {
    let name = draft.words(field)?;
    let (body, point) = name.split_once('.').unwrap_or((&name, ""));
    if draft.names.points.contains_key(body) {
        refuse_unknown(draft, body, (&name, point), field);
        return draft.model.bodies.iter().find(|known| known.name == body)?.named_point(point);
    }
    let names = draft.names.points.iter();
    let points: Vec<String> = names.flat_map(|(body, points)| full_names(body, points)).collect();
    let help = suggest::name(&name, "points", points.iter().map(String::as_str));
    let message = format!("there is no point \"{name}\"");
    draft.note(
        Diagnostic::new(Code::UnknownPoint, field.span.clone(), message).label("unknown point").help(help),
    );
    None
}

/// `rod.tip`, `rod.cm`
fn full_names(body: &str, points: &[String]) -> Vec<String> {
    points.iter().map(|point| format!("{body}.{point}")).collect()
}

fn local(body: &Body, name: &str) -> Option<Vector> {
    match name {
        CENTRE => Some(body.mass_properties().centre),
        _ => body.points.iter().find(|(known, _)| known == name).map(|(_, at)| at.clone()),
    }
}

/// Notes a point that its body does not have, given by its full name and its own.
fn refuse_unknown(draft: &mut Draft, body: &str, (name, point): (&str, &str), field: &Field) {
    let points = draft.names.points.get(body).map(Vec::as_slice).unwrap_or_default();
    if points.iter().any(|known| known == point) || draft.names.is_broken(&format!("{body}.{point}")) {
        return;
    }
    let known = full_names(body, points);
    let whole = format!("{body}.{name}");
    let help = match known.contains(&whole) {
        true => format!("write \"{whole}\""),
        false => suggest::name(name, "points", known.iter().map(String::as_str)),
    };
    let message = format!("`{body}` has no point \"{name}\"");
    let mistake = Diagnostic::new(Code::UnknownPoint, field.span.clone(), message);
    draft.note(mistake.label("unknown point").help(help));
}
