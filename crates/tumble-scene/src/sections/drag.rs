//! `[drag.NAME]`: air resistance at a point, along the edges of a body, or on a ball.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Body, Component, Drag, DragPlace, PointRef, Shape};

use super::{body, each, points, round};
use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, may};

const DENSITY: Dimension = Dimension::new(-3, 1, 0);

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[drag.NAME]", &[&[
    may("at", Takes::POINT, "one of three", "\"rod.cm\"", "a point: the force is b u + c abs(u) u there"),
    may("along", Takes::BODY, "one of three", "\"rod\"",
        "a body: the same for each metre of its rods and of the edges of its boxes and polygons"),
    may("on", Takes::BODY, "one of three", "\"ball\"",
        "a ball or shell of radius R: c is rho C pi R^2/2, at its centre"),
    may("linear", Takes::Formula, "none", "\"0.02 kg/s\"", "b: kg/s with `at`, kg/(m*s) with `along`"),
    may("quadratic", Takes::Formula, "none", "\"0.02 kg/m\"", "c: kg/m with `at`, kg/m^2 with `along`"),
    may("component", Takes::Word(&COMPONENTS), "`\"full\"`", "\"normal\"",
        "`\"normal\"`: only the component of u across the line counts, and the force is across it"),
    may("density", Takes::Quantity(DENSITY), "needed with `on`", "\"1.2 kg/m^3\"", "rho, of the air"),
    may("coefficient", Takes::PURE, "needed with `on`", "0.47", "C, a pure number"),
]])
.one_of(&[&["at", "along", "on"]]);

const COMPONENTS: [&str; 2] = ["full", "normal"];

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, drag);
}

/// Where it acts is said once: `at` a point, `along` a body, or `on` a ball.
fn drag(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a drag", field);
    let given: Vec<_> = ["at", "along", "on"].into_iter().filter_map(|key| table.take(key)).collect();
    match &given[..] {
        [place] if place.key == "on" => on_ball(draft, name, place, table),
        [place] => by_velocity(draft, name, place, table),
        _ => {
            let mistake = not_one(table, &given);
            draft.note(mistake);
            // What belongs to the one or the other is no mistake of its own.
            table.ignore();
        }
    }
}

fn not_one(table: &Table, given: &[Field]) -> Diagnostic {
    let [first, second, ..] = given else {
        let message = format!("`{}` does not say where it acts", table.title);
        let help = "add one of `at = \"rod.cm\"` for a point, `along = \"rod\"` for the edges of a body, `on = \"ball\"` for a ball";
        return Diagnostic::new(Code::MissingKey, table.span.clone(), message).help(help);
    };
    let message = format!("`{}` says both `{}` and `{}`", table.title, first.key, second.key);
    let help = match second.key {
        "on" => format!("`{}` names the body already: leave `on` out", first.key),
        _ => "make them two sections, each with its name".to_owned(),
    };
    let mistake = Diagnostic::new(Code::Exclusive, second.key_span.clone(), message);
    mistake.label("a second place").also(first.key_span.clone(), "the first").help(help)
}

fn on_ball(draft: &mut Draft, name: String, place: &Field, table: &mut Table) {
    let on = body(draft, place);
    for key in ["linear", "quadratic", "component"] {
        let Some(field) = table.take(key) else { continue };
        let message = format!("`{key}` does not go with `on`");
        let help = "with `on` a ball's resistance follows from `density` and `coefficient`; write `at` or `along` in the place of `on` to give it by itself";
        draft.note(Diagnostic::new(Code::Exclusive, field.key_span, message).help(help));
    }
    let density = draft.coefficient(table, &name, "density");
    let coefficient = draft.coefficient(table, &name, "coefficient");
    let ball = on.and_then(|on| round::of(draft, &on, &place.span));
    let (Some(ball), Some(density), Some(coefficient)) = (ball, density, coefficient) else { return };
    draft.model.interact(Drag::ball(name, ball.centre, &ball.radius, density, coefficient));
}

fn by_velocity(draft: &mut Draft, name: String, place: &Field, table: &mut Table) {
    for key in ["density", "coefficient"] {
        let Some(field) = table.take(key) else { continue };
        let message = format!("`{key}` does not go with `{}`", place.key);
        let help = "`density` and `coefficient` describe a ball: write `on = \"ball\"`; here the resistance is `linear` and `quadratic`";
        draft.note(Diagnostic::new(Code::Exclusive, field.key_span, message).help(help));
    }
    let per = if place.key == "along" { 1 } else { 0 };
    let linear =
        table.take("linear").map(|field| strength(draft, &name, &field, Dimension::new(-per, 1, -1)));
    let quadratic =
        table.take("quadratic").map(|field| strength(draft, &name, &field, Dimension::new(-1 - per, 1, 0)));
    if linear.is_none() && quadratic.is_none() {
        let message = format!("`{}` has neither `linear` nor `quadratic`", table.title);
        let mistake = Diagnostic::new(Code::MissingKey, table.span.clone(), message);
        draft.note(mistake.help(format!("add `quadratic = \"0.02 {}\"`", ["kg/m", "kg/m^2"][per as usize])));
    }
    let component = component(draft, table);
    let on = drag_place(draft, place, component);
    let (Some(on), None | Some(Some(_)), None | Some(Some(_))) = (on, &linear, &quadratic) else { return };
    draft.model.interact(Drag { name, on, linear: linear.flatten(), quadratic: quadratic.flatten() });
}

/// A coefficient that is another quantity at a point than along a line.
fn strength(draft: &mut Draft, name: &str, field: &Field, dimension: Dimension) -> Option<Expr> {
    let before = draft.mistakes.len();
    let value = draft.constant(name, field, Want::constant(dimension));
    let rule = "`at` a point, `linear` is in kg/s and `quadratic` in kg/m; `along` a body, both are per metre of its edges: kg/(m*s) and kg/m^2";
    let fits = |code: Code| matches!(code.as_str(), "E0404" | "E0516");
    for mistake in draft.mistakes[before..].iter_mut().filter(|mistake| fits(mistake.code)) {
        let cure = mistake.help.take().map_or_else(String::new, |help| help + "; ");
        mistake.help = Some(cure + rule);
    }
    value
}

fn component(draft: &mut Draft, table: &mut Table) -> Option<(Component, Span)> {
    let Some(field) = table.take("component") else { return Some((Component::Full, table.span.clone())) };
    let word = draft.choice(&field, &COMPONENTS)?;
    Some((if word == "full" { Component::Full } else { Component::Normal }, field.span))
}

/// The place is looked at even where the component has a mistake.
fn drag_place(draft: &mut Draft, place: &Field, component: Option<(Component, Span)>) -> Option<DragPlace> {
    if place.key == "along" {
        let body = body(draft, place)?;
        let lines = lines(draft, &draft.body_named(&body)?, place)?;
        return Some(DragPlace::Lines { lines, component: component?.0 });
    }
    let point = points::named_anywhere(draft, place)?;
    let (component, span) = component?;
    match component {
        Component::Full => Some(DragPlace::Point(point)),
        Component::Normal => across(draft, point, &span),
    }
}

/// At a point, the component across the one rod that the body is made of.
fn across(draft: &mut Draft, point: PointRef, span: &Span) -> Option<DragPlace> {
    let body = draft.body_named(&point.body.body)?;
    let rods = body.parts.iter().filter_map(|part| match &part.shape {
        Shape::Rod { from, to, .. } => Some(to - from),
        _ => None,
    });
    let rods: Vec<_> = rods.collect();
    if let [along] = &rods[..] {
        return Some(DragPlace::PointNormal(point, along.perpendicular()));
    }
    let message = format!("`{}` has {} rods: normal to which line?", body.name, rods.len());
    let help = "`component = \"normal\"` at a point is across the body's one rod; write `along` for all its edges, or \"full\"";
    draft.note(Diagnostic::new(Code::ShapeInAir, span.clone(), message).label("normal to what?").help(help));
    None
}

/// Every rod, and every edge of boxes and polygons.
fn lines(draft: &mut Draft, body: &Body, place: &Field) -> Option<Vec<[PointRef; 2]>> {
    let lines: Vec<_> = body.parts.iter().flat_map(|part| part.shape.edges()).collect();
    if lines.is_empty() {
        let message = format!("`{}` has no straight line", body.name);
        let help = "`along` is for rods, boxes and polygons; write `on` for a ball, `at` for a point";
        draft.note(
            Diagnostic::new(Code::ShapeInAir, place.span.clone(), message).label("along what?").help(help),
        );
        return None;
    }
    let ends = body.points_at(lines.iter().flatten());
    Some(ends.chunks_exact(2).map(|ends| [ends[0].clone(), ends[1].clone()]).collect())
}
