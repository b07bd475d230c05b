//! `[body.NAME]`: a shape with its mass, parts joined rigidly, or stated mass properties.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{Body, MassProperties, Part};

use super::{each, laws, points, shape, start};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};
use crate::quantities;

pub(super) const SAYS: &str = "bodies: a shape with its mass, parts, or stated mass properties";

pub(super) const KEYS: Keys = Keys::of("[body.NAME]", &[shape::KEYS, OWN]).one_of(&[&["mass", "parts"]]);

#[rustfmt::skip]
const OWN: &[Declared] = &[
    may("mass", Takes::Quantity(Dimension::MASS), "needed with a shape", "\"1 kg\"", "spread evenly over the shape"),
    may("parts", Takes::List(1, Takes::MOST, &Takes::Table(&PART)), "none", "[{ ball = { radius = \"0.1 m\" }, mass = \"1 kg\" }]",
        "instead of shape and mass: a list of `{ SHAPE, mass = \"..\" }`, joined rigidly"),
    may("centre", Takes::PLACE, "computed", "[0, \"1 cm\"]", "centre of mass, stated together with `inertia`"),
    may("inertia", Takes::Quantity(Dimension::INERTIA), "computed", "\"0.1 kg*m^2\"",
        "moment of inertia about the centre of mass, stated together with `centre`"),
    may("points", Takes::Named(&Takes::PLACE), "none", "{ tip = [0, \"1 m\"] }",
        "named points in body coordinates: `points.tip = [x, y]`"),
    may("restitution", Takes::PURE, "the surface's", "0.8", "of its impacts on rigid surfaces, from 0 to 1"),
    may("friction", laws::COEFFICIENTS, "the surface's", "0.3",
        "dry friction on what it touches: one coefficient, or `{ static = 0.4, kinetic = 0.3 }`"),
    may("start", Takes::Table(&start::KEYS), "as drawn, at rest", "{ at = [0, \"2 m\"] }",
        "what it starts from, see below"),
];

const PART: Keys = Keys::of("part of a body", &[shape::KEYS, &[PART_MASS]]);

#[rustfmt::skip]
const PART_MASS: Declared =
    must("mass", Takes::Quantity(Dimension::MASS), "\"1 kg\"", "spread evenly over the shape");

pub(super) fn read(draft: &mut Draft, section: &Field) {
    if section.value.as_table().is_some_and(|bodies| bodies.is_empty()) {
        let mistake = Diagnostic::new(Code::MissingSection, section.key_span.clone(), "there is no body");
        draft.note(mistake.help("a body is a section such as `[body.rod]`"));
    }
    each(draft, section, &KEYS, body);
}

fn body(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = field.key;
    let claimed = draft.names.claim("a body", name, field.key_span.clone());
    let claimed = draft.noted(claimed);
    draft.remember(format!("body `{name}`"), &field.key_span);
    let matter = matter(draft, name, table);
    let points = points::read(draft, name, table);
    let restitution = table
        .take("restitution")
        .and_then(|field| draft.constant(name, &field, Want::constant(Dimension::NONE)));
    let friction = table.take("friction").and_then(|field| laws::friction(draft, name, &field));
    start::read(draft, name, table);
    match (claimed, matter) {
        (Some(()), Some((parts, stated))) => {
            let body = Body { name: name.to_owned(), parts, points, stated, restitution, friction };
            quantities::define(&mut draft.names, &draft.model.gravity, &body);
            draft.model.bodies.push(body);
        }
        _ => draft.names.break_name(name),
    }
}

type Matter = (Vec<Part>, Option<MassProperties>);

/// One of three: a shape with its mass, parts, or stated mass properties.
fn matter(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Matter> {
    let of = format!("`{name}`");
    let shape = shape::read(draft, &of, table);
    if let Some(parts) = table.take("parts") {
        return joined(draft, name, table, &shape, &parts);
    }
    let mass = draft.required(table, "mass");
    let mass = mass.and_then(|field| mass_of(draft, &of, &field));
    match [table.take("centre"), table.take("inertia")] {
        [None, None] => {
            let shape = shape::one(draft, table, shape)?;
            Some((vec![Part { shape, mass: mass? }], None))
        }
        [centre, inertia] => {
            let stated = stated(draft, name, table, mass, centre, inertia)?;
            let drawn = shape?.map(|drawn| Part { shape: drawn.shape, mass: Expr::zero() });
            Some((drawn.into_iter().collect(), Some(stated)))
        }
    }
}

fn mass_of(draft: &mut Draft, name: &str, field: &Field) -> Option<Expr> {
    draft.remember(format!("mass of {name}"), &field.span);
    draft.number(field, Want::constant(Dimension::MASS))
}

fn stated(
    draft: &mut Draft,
    name: &str,
    table: &mut Table,
    mass: Option<Expr>,
    centre: Option<Field>,
    inertia: Option<Field>,
) -> Option<MassProperties> {
    if centre.is_none() || inertia.is_none() {
        let (has, lacks) = if centre.is_some() { ("centre", "inertia") } else { ("inertia", "centre") };
        let message = format!("`{}` states its `{has}` without its `{lacks}`", table.title);
        let given = centre.or(inertia).map_or(table.span.clone(), |field| field.key_span);
        let help = format!("state `{lacks}` too, or leave `{has}` out: both are computed from the shape");
        draft.note(Diagnostic::new(Code::MissingKey, given, message).help(help));
        return None;
    }
    let centre = centre.and_then(|field| {
        draft.remember(format!("centre of mass of `{name}`"), &field.span);
        draft.place(&field)
    });
    let inertia = inertia.and_then(|field| {
        draft.remember(format!("moment of inertia of `{name}`"), &field.span);
        draft.number(&field, Want::constant(Dimension::INERTIA))
    });
    Some(MassProperties { mass: mass?, centre: centre?, inertia: inertia? })
}

/// `parts = [{ rod = { .. }, mass = ".." }, ...]`
fn joined(
    draft: &mut Draft,
    name: &str,
    table: &mut Table,
    shape: &Option<Option<shape::Drawn>>,
    field: &Field,
) -> Option<Matter> {
    let beside =
        ["mass", "centre", "inertia"].map(|key| table.take(key).map(|field| (field.key, field.key_span)));
    let drawn = shape.iter().flatten().map(|drawn| (drawn.key, drawn.span.clone()));
    for (key, span) in drawn.chain(beside.into_iter().flatten()) {
        let message = format!("`{}` has `parts` and `{key}`", table.title);
        let mistake = Diagnostic::new(Code::Exclusive, span, message).label("belongs into one of the parts");
        draft.note(mistake.also(field.key_span.clone(), "the parts"));
    }
    let Some(elements) = field.elements().filter(|elements| !elements.is_empty()) else {
        draft.wrong_type(
            field,
            "a list of tables, such as `[{ ball = { radius = \"0.1 m\" }, mass = \"1 kg\" }]`",
        );
        return None;
    };
    let of = |index: usize| match elements.len() {
        1 => format!("`{name}`"),
        _ => format!("part {} of `{name}`", index + 1),
    };
    let numbered = elements.iter().enumerate();
    let parts: Vec<_> = numbered.map(|(index, element)| part(draft, &of(index), element)).collect();
    let parts = parts.into_iter().collect::<Option<Vec<_>>>()?;
    shape.is_some().then_some((parts, None))
}

fn part(draft: &mut Draft, name: &str, field: &Field) -> Option<Part> {
    let mut table = draft.inline(field, &PART)?;
    let shape = shape::read(draft, name, &mut table);
    let mass = draft.required(&mut table, "mass");
    let mass = mass.and_then(|field| mass_of(draft, name, &field));
    let shape = shape::one(draft, &table, shape);
    draft.done(table);
    Some(Part { shape: shape?, mass: mass? })
}
