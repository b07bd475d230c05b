//! `[surface.NAME]`: a floor, wall, slope, bowl or pole, at rest or moving, and what it does to what touches it.

use tumble_expr::{Dimension, Expr, Vector};
use tumble_mech::Surface;

use super::{body, each, laws, shape};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, may, must};
use crate::names::Level;
use crate::quantities;
use crate::suggest;

pub(super) const SAYS: &str = "floors, walls, slopes and bowls, and what they do to what touches them";

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[surface.NAME]", &[&[
    may("through", Takes::PLACE, "this, `circle` or `polygon`", "[0, 0]",
        "a point of a plane, `[x, y]`; it may depend on the time"),
    may("polygon", shape::CORNERS, "this, `through` or `circle`", "[[0, 0], [\"1 m\", 0], [\"1 m\", \"0.5 m\"]]",
        "corners of a convex polygon that is solid inside, counter-clockwise: `[[x, y], [x, y], [x, y]]`, or more. It is at \
         rest"),
    may("circle", Takes::Table(&CIRCLE), "this, `through` or `polygon`", "{ centre = [0, 0], radius = \"1 m\", inside = true }",
        "`{ centre = [x, y], radius = \"1 m\", inside = true }`: met from inside, as a bowl is, or from outside \
         without `inside`; the centre may depend on the time"),
    may("normal", Takes::Vector(Dimension::NONE), "this or `slope`", "[0, 1]",
        "out of the solid, `[x, y]` of any length; it may depend on the time"),
    may("slope", Takes::Angle(Dimension::NONE), "`0`, a floor", "\"30 deg\"",
        "angle by which it rises to the right; it may depend on the time"),
    may("rigid", Takes::Table(&laws::RIGID), "one of three", "{ restitution = 0.7 }",
        "what it does to what touches it: it does not give"),
    may("spring", Takes::Table(&laws::COMPLIANT), "one of three", "{ stiffness = \"1e4 N/m\", damping = 0 }",
        "compliant, in proportion to the force"),
    may("hertz", Takes::Table(&laws::HERTZ), "one of three", "{ stiffness = \"1e6 N/m^(3/2)\", damping = 0 }",
        "compliant, as one elastic body pressed against another"),
    may("on", Takes::Either(&[MET, Takes::List(1, Takes::MOST, &MET)]), "all", "\"ball\"",
        "what meets it: a body, `\"ball\"`, a single point of one, `\"rod.tip\"`, or a list of such"),
]]).one_of(&[&["through", "circle", "polygon"], &["rigid", "spring", "hertz"]]);

const MET: Takes = Takes::Either(&[Takes::BODY, Takes::POINT]);

#[rustfmt::skip]
const CIRCLE: Keys = Keys::of("circle", &[&[
    must("centre", Takes::PLACE, "[0, 0]", "its centre; it may depend on the time"),
    must("radius", Takes::LENGTH, "\"1 m\"", "a length"),
    may("inside", Takes::Flag, "`false`", "true", "whether it is met from inside, as a bowl is"),
]]);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, surface);
    quantities::define_contacts(&mut draft.names, &draft.model);
}

fn surface(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a surface", field);
    draft.remember(format!("surface `{name}`"), &field.key_span);
    let form = match (table.take("circle"), table.take("polygon")) {
        (Some(circle), Some(polygon)) => {
            let message = format!("`{}` is a `circle` and a `polygon`", table.title);
            let mistake = Diagnostic::new(Code::Exclusive, polygon.key_span, message);
            draft.note(mistake.label("leave one of them out").also(circle.key_span, "the circle"));
            None
        }
        (Some(field), None) => circle(draft, &name, table, &field),
        (None, Some(field)) => polygon(draft, &name, table, &field),
        (None, None) => plane(draft, &name, table),
    };
    let law = laws::of_surface(draft, &name, table);
    let on = table.take("on").map(|field| met(draft, &field));
    let (Some((place, facing)), Some((law, friction)), None | Some(Some(_))) = (form, law, &on) else {
        return draft.names.break_name(&name);
    };
    let at = [place.x().clone(), place.y().clone()];
    let surface = match facing {
        Facing::Normal(normal) => Surface::new(name, at, [normal.x().clone(), normal.y().clone()], law),
        Facing::Slope(angle) => Surface::sloping(name, at, &angle, law),
        Facing::In(radius) => Surface::bowl(name, at, radius, law),
        Facing::Out(radius) => Surface::circle(name, at, radius, law),
        Facing::OutOf(corners) => Surface::polygon(name, corners, law),
    };
    draft.model.surface(Surface { on: on.flatten(), friction, ..surface });
}

enum Facing {
    Normal(Vector),
    Slope(Expr),
    /// Into a circle of that radius.
    In(Expr),
    /// Out of one.
    Out(Expr),
    /// Out of a polygon with these corners.
    OutOf(Vec<Vector>),
}

/// A plane: a point of it, and where it looks.
fn plane(draft: &mut Draft, name: &str, table: &mut Table) -> Option<(Vector, Facing)> {
    let through = draft
        .required(table, "through")
        .and_then(|field| draft.vector(&field, Want::constant(Dimension::LENGTH).at(Level::Time)));
    let facing = facing(draft, name, table);
    Some((through?, facing?))
}

/// What a plane has and a circle or a polygon has not.
fn refuse_plane(draft: &mut Draft, table: &mut Table, field: &Field) {
    for key in ["through", "normal", "slope"] {
        if let Some(other) = table.take(key) {
            let what = field.key;
            let message = format!("`{}` is a `{what}` and has a `{key}`, as a plane has", table.title);
            let mistake = Diagnostic::new(Code::Exclusive, other.key_span, message);
            draft.note(
                mistake.label("leave one of them out").also(field.key_span.clone(), format!("the {what}")),
            );
        }
    }
}

/// A polygon: its first corner, and all of them.
fn polygon(draft: &mut Draft, name: &str, table: &mut Table, field: &Field) -> Option<(Vector, Facing)> {
    refuse_plane(draft, table, field);
    let corners = shape::corners(draft, &format!("`{name}`"), field)?;
    Some((corners[0].clone(), Facing::OutOf(corners)))
}

/// A circle: its centre, and where it looks.
fn circle(draft: &mut Draft, name: &str, table: &mut Table, field: &Field) -> Option<(Vector, Facing)> {
    refuse_plane(draft, table, field);
    let mut inner = draft.inline(field, &CIRCLE)?;
    let centre = draft.required(&mut inner, "centre");
    let centre =
        centre.and_then(|field| draft.vector(&field, Want::constant(Dimension::LENGTH).at(Level::Time)));
    let radius = draft.coefficient(&mut inner, name, "radius");
    let inside = match inner.take("inside") {
        Some(field) => draft.flag(&field),
        None => Some(false),
    };
    draft.done(inner);
    Some((centre?, if inside? { Facing::In(radius?) } else { Facing::Out(radius?) }))
}

/// Out of the solid: level and upwards where nothing is said.
fn facing(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Facing> {
    let (normal, slope) = (table.take("normal"), table.take("slope"));
    for field in normal.iter().chain(&slope) {
        draft.remember(format!("normal of `{name}`"), &field.span);
    }
    match (normal, slope) {
        (Some(normal), Some(slope)) => {
            let message = format!("`{}` has a `normal` and a `slope`", table.title);
            let mistake = Diagnostic::new(Code::Exclusive, slope.key_span, message);
            draft.note(mistake.label("leave one of them out").also(normal.key_span, "the normal"));
            None
        }
        (Some(normal), None) => {
            let want = Want::constant(Dimension::NONE).at(Level::Time);
            draft.vector(&normal, want).map(Facing::Normal)
        }
        (None, Some(slope)) => {
            let want = Want::angular(Dimension::NONE).at(Level::Time);
            draft.number(&slope, want).map(Facing::Slope)
        }
        (None, None) => Some(Facing::Slope(Expr::zero())),
    }
}

/// One name or a list of names, of bodies or of single points by which they touch.
fn met(draft: &mut Draft, field: &Field) -> Option<Vec<String>> {
    let fields = field.elements().unwrap_or_else(|| vec![field.clone()]);
    if fields.is_empty() {
        let mistake = Diagnostic::new(Code::Value, field.span.clone(), "`on` names nothing");
        draft.note(
            mistake
                .label("an empty list")
                .help("name the bodies that meet the surface, or leave `on` out: then all do"),
        );
        return None;
    }
    let names: Vec<_> = fields.iter().map(|field| body_or_point(draft, field)).collect();
    names.into_iter().collect()
}

fn body_or_point(draft: &mut Draft, field: &Field) -> Option<String> {
    let of_point = field.value.as_str().and_then(|name| name.split_once('.'));
    let of_body = of_point.filter(|(body, _)| draft.names.bodies.iter().any(|known| known == body));
    let Some((owner, point)) = of_body else { return body(draft, field) };
    // A body with mistakes is not there; nor can its points be looked up.
    let features = draft.body_named(owner)?.features();
    if features.iter().any(|feature| feature.name == point) {
        return Some(format!("{owner}.{point}"));
    }
    let known: Vec<String> = features.iter().map(|feature| format!("{owner}.{}", feature.name)).collect();
    let help = match draft.body_named(owner)?.named_point(point) {
        Some(_) => format!(
            "a point alone touches nothing: add a part `{{ point = {{ at = .. }}, mass = 0 }}` to `{owner}` there"
        ),
        None => suggest::name(&format!("{owner}.{point}"), "points", known.iter().map(String::as_str)),
    };
    let message = format!("`{owner}` has no end, corner or rim \"{point}\" by which it could touch");
    let mistake = Diagnostic::new(Code::UnknownPoint, field.span.clone(), message);
    draft.note(mistake.label("touches nothing").help(help));
    None
}
