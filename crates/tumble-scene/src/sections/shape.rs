//! The shapes of bodies: `rod = { from = [..], to = [..] }` and the others.

use tumble_expr::{Dimension, Expr, Vector};
use tumble_mech::Shape;

use crate::code::Code;
use crate::diagnostic::{Diagnostic, Span};
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::suggest;

/// A shape is one of these keys, of a body or of a part.
#[rustfmt::skip]
pub(super) const KEYS: &[Declared] = &[
    shape("point", &POINT, "{}", "a point with a mass and no extent"),
    shape("rod", &ROD, "{ from = [0, 0], to = [0, \"1 m\"] }", "a thin rod"),
    shape("disk", &DISK, "{ radius = \"0.1 m\" }", "a full disk"),
    shape("ring", &RING, "{ radius = \"0.1 m\" }", "a thin ring"),
    shape("ball", &BALL, "{ radius = \"0.1 m\" }", "a solid ball"),
    shape("shell", &SHELL, "{ radius = \"0.1 m\" }", "a thin spherical shell"),
    shape("box", &BOX, "{ width = \"0.2 m\", height = \"0.1 m\" }", "a rectangle"),
    shape("polygon", &POLYGON, "{ corners = [[0, 0], [\"1 m\", 0], [0, \"1 m\"]] }", "a polygon"),
];

const fn shape(
    name: &'static str,
    keys: &'static Keys,
    example: &'static str,
    says: &'static str,
) -> Declared {
    may(name, Takes::Table(keys), "one of these", example, says)
}

const POINT: Keys = Keys::of("point", &[&[may("at", Takes::PLACE, "the origin", "[0, 0]", "its place")]]);
const DISK: Keys = Keys::of("disk", &[ROUND]);
const RING: Keys = Keys::of("ring", &[ROUND]);
const BALL: Keys = Keys::of("ball", &[ROUND]);
const SHELL: Keys = Keys::of("shell", &[ROUND]);
const BOX: Keys = Keys::of("box", &[&[size_of("width"), size_of("height"), CENTRE]]);

const ROUND: &[Declared] = &[size_of("radius"), CENTRE];
const CENTRE: Declared = may("centre", Takes::PLACE, "the origin", "[0, 0]", "its centre");

const fn size_of(name: &'static str) -> Declared {
    must(name, Takes::LENGTH, "\"0.1 m\"", "a length")
}

#[rustfmt::skip]
const ROD: Keys = Keys::of("rod", &[&[
    must("from", Takes::PLACE, "[0, 0]", "one end"),
    must("to", Takes::PLACE, "[0, \"1 m\"]", "the other end"),
    may("end_radius", Takes::LENGTH, "0", "\"1 cm\"", "of its ends, which are rounded where they touch surfaces"),
]]);

/// Of a polygon, counter-clockwise.
pub(super) const CORNERS: Takes = Takes::List(3, Takes::MOST, &Takes::PLACE);

#[rustfmt::skip]
const POLYGON: Keys = Keys::of("polygon", &[&[
    must("corners", CORNERS, "[[0, 0], [\"1 m\", 0], [0, \"1 m\"]]", "three or more, in order"),
]]);

/// A shape and the key it was given by.
pub(super) struct Drawn {
    pub(super) key: &'static str,
    pub(super) span: Span,
    pub(super) shape: Shape,
}

/// The second argument is what messages call it: "`rod`", or "part 2 of `rod`".
type Read = fn(&mut Draft, &str, &mut Table) -> Option<Shape>;

const SHAPES: &[(&str, &Keys, Read)] = &[
    ("point", &POINT, point),
    ("rod", &ROD, rod),
    ("disk", &DISK, |draft, name, table| {
        round(draft, name, table, |centre, radius| Shape::Disk { centre, radius })
    }),
    ("ring", &RING, |draft, name, table| {
        round(draft, name, table, |centre, radius| Shape::Ring { centre, radius })
    }),
    ("ball", &BALL, |draft, name, table| {
        round(draft, name, table, |centre, radius| Shape::Ball { centre, radius })
    }),
    ("shell", &SHELL, |draft, name, table| {
        round(draft, name, table, |centre, radius| Shape::Shell { centre, radius })
    }),
    ("box", &BOX, rectangle),
    ("polygon", &POLYGON, polygon),
];

/// The shape of a body or part, if it has one; the outer `None` is a mistake that has been noted.
pub(super) fn read(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Option<Drawn>> {
    let given: Vec<_> =
        SHAPES.iter().filter_map(|(key, keys, read)| Some((*key, *keys, read, table.take(key)?))).collect();
    if let [(.., first), (.., second), ..] = &given[..] {
        let message = format!("`{}` is both `{}` and `{}`", table.title, first.key, second.key);
        let mistake = Diagnostic::new(Code::Exclusive, second.key_span.clone(), message);
        let mistake = mistake.label("a second shape").also(first.key_span.clone(), "the first shape");
        draft
            .note(mistake.help("a body of several shapes is `parts = [{ .. }, { .. }]`, each with its mass"));
        return None;
    }
    let Some((key, keys, read, field)) = given.into_iter().next() else { return Some(None) };
    draft.remember(format!("shape of {name}"), &field.span);
    let mut inner = draft.table(&field, keys)?;
    let shape = read(draft, name, &mut inner);
    draft.done(inner);
    Some(Some(Drawn { key, span: field.key_span, shape: shape? }))
}

/// The shape where there must be one.
pub(super) fn one(draft: &mut Draft, table: &Table, found: Option<Option<Drawn>>) -> Option<Shape> {
    let found = found?;
    if found.is_none() {
        let message = format!("`{}` has no shape", table.title);
        let known = suggest::list(SHAPES.iter().map(|(key, ..)| *key));
        let help = format!("add one of {known}, such as `rod = {{ from = [0, 0], to = [0, \"1 m\"] }}`");
        let mistake = Diagnostic::new(Code::MissingKey, table.span.clone(), message);
        draft.note(mistake.label("of which shape?").help(help));
    }
    found.map(|drawn| drawn.shape)
}

/// A place that is the body's origin where it is not given.
fn place_or_origin(draft: &mut Draft, table: &mut Table, key: &'static str) -> Option<Vector> {
    match table.take(key) {
        Some(field) => draft.place(&field),
        None => Some(Vector::planar(Expr::zero(), Expr::zero())),
    }
}

fn size(draft: &mut Draft, name: &str, table: &mut Table, key: &'static str) -> Option<Expr> {
    let field = draft.required(table, key)?;
    draft.remember(format!("{key} of {name}"), &field.span);
    draft.number(&field, Want::constant(Dimension::LENGTH))
}

fn point(draft: &mut Draft, _: &str, table: &mut Table) -> Option<Shape> {
    Some(Shape::Point { at: place_or_origin(draft, table, "at")? })
}

fn rod(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Shape> {
    draft.remember(format!("length of {name}"), &table.span);
    let from = draft.required(table, "from").and_then(|field| draft.place(&field));
    let to = draft.required(table, "to").and_then(|field| draft.place(&field));
    let end_radius = table.take("end_radius").map(|field| {
        draft.remember(format!("end radius of {name}"), &field.span);
        draft.number(&field, Want::constant(Dimension::LENGTH))
    });
    let end_radius = end_radius.unwrap_or_else(|| Some(Expr::zero()));
    Some(Shape::Rod { from: from?, to: to?, end_radius: end_radius? })
}

fn round(
    draft: &mut Draft,
    name: &str,
    table: &mut Table,
    shape: fn(Vector, Expr) -> Shape,
) -> Option<Shape> {
    let radius = size(draft, name, table, "radius");
    let centre = place_or_origin(draft, table, "centre");
    Some(shape(centre?, radius?))
}

fn rectangle(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Shape> {
    let (width, height) = (size(draft, name, table, "width"), size(draft, name, table, "height"));
    let centre = place_or_origin(draft, table, "centre");
    Some(Shape::Box { centre: centre?, width: width?, height: height? })
}

fn polygon(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Shape> {
    draft.remember(format!("area of {name}"), &table.span);
    let field = draft.required(table, "corners")?;
    Some(Shape::Polygon { corners: corners(draft, name, &field)? })
}

/// The corners of a polygon; `name` is what messages call what it is of.
pub(super) fn corners(draft: &mut Draft, name: &str, field: &Field) -> Option<Vec<Vector>> {
    draft.remember(format!("polygon of {name}"), &field.span);
    let Some(corners) = field.elements() else {
        draft.wrong_type(field, "a list of places, [[x, y], [x, y], ...]");
        return None;
    };
    if corners.len() < 3 {
        let message = format!("a polygon has 3 corners or more, not {}", corners.len());
        draft.note(Diagnostic::new(Code::Length, field.span.clone(), message));
        return None;
    }
    let places: Vec<_> = corners.iter().map(|corner| draft.place(corner)).collect();
    places.into_iter().collect()
}
