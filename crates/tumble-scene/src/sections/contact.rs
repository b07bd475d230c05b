//! `[contact.NAME]`: bodies that meet each other, and what counts for bodies on a surface.

use tumble_expr::{Dimension, Expr};
use tumble_mech::{BodyContact, ContactLaw, Friction};

use super::{each, laws};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Keys, Takes, may, must};
use crate::quantities;
use crate::suggest;

pub(super) const SAYS: &str = "bodies that meet each other, and what counts for bodies on a surface";

#[rustfmt::skip]
pub(super) const KEYS: Keys = Keys::of("[contact.NAME]", &[&[
    must("between", Takes::Either(&[Takes::Word(&ALL), Takes::List(2, Takes::MOST, &MET)]), "\"all\"",
        "`[\"red\", \"white\"]`, or more bodies of which every two meet; `\"all\"` is all bodies, but for two that \
         a joint connects. Of a surface and bodies, `[\"floor\", \"red\"]`, it says what counts for them there"),
    may("rigid", Takes::Table(&RIGID), "bodies' own", "{ restitution = 0.9 }",
        "as of a surface; without `restitution` or `friction` the lesser of the bodies' own counts, and on a surface the body's own, \
         else the surface's"),
    may("spring", Takes::Table(&laws::COMPLIANT), "`rigid`", "{ stiffness = \"1e4 N/m\", damping = 0 }",
        "bodies are compliant where they meet, in proportion to the force"),
    may("hertz", Takes::Table(&laws::HERTZ), "`rigid`", "{ stiffness = \"1e6 N/m^(3/2)\", damping = 0 }",
        "the same as two round elastic bodies are"),
    may("friction", laws::COEFFICIENTS, "that in the law", "0.3",
        "dry friction, also on a compliant surface: one coefficient, or `{ static = 0.4, kinetic = 0.3 }`"),
    may("capture", Takes::Flag, "`false`", "true",
        "`true`: bodies that meet stick together for good, as if welded where they touch; without a law"),
]]);

const MET: Takes = Takes::Either(&[Takes::BODY, Takes::SURFACE]);

const ALL: [&str; 1] = ["all"];

#[rustfmt::skip]
const RIGID: Keys = Keys::of("rigid of bodies", &[
    &[may(
        "restitution",
        Takes::PURE,
        "the bodies' own",
        "0.9",
        "how much of its speed an impact leaves, from 0 to 1",
    )],
    laws::RUBBING,
    ],
);

pub(super) fn read(draft: &mut Draft, section: &Field) {
    each(draft, section, &KEYS, contact);
    draft.model.add_captures();
    quantities::define_meetings(&mut draft.names, &draft.model);
    quantities::define_captures(&mut draft.names, &draft.model);
}

fn contact(draft: &mut Draft, field: &Field, table: &mut Table) {
    let name = draft.own_name("a contact", field);
    draft.remember(format!("contact `{name}`"), &field.key_span);
    let between = draft.required(table, "between");
    let between = between.and_then(|field| between_of(draft, &name, &field));
    let captures = table.take("capture").map_or(Some(false), |field| draft.flag(&field));
    let law = law(draft, &name, table);
    let law = match (table.take("friction"), law) {
        (Some(field), Some(law)) => with_friction(draft, &name, &field, law),
        (_, law) => law,
    };
    let (Some(between), Some((across, friction)), Some(captures)) = (between, law, captures) else {
        return draft.names.break_name(&name);
    };
    let (restitution, compliant) = match across {
        Some(Across::Restitution(restitution)) => (Some(restitution), None),
        Some(Across::Compliant(law)) => (None, Some(law)),
        None => (None, None),
    };
    draft.model.contact(BodyContact { name, between, restitution, compliant, friction, captures });
}

/// What happens across where they meet, as far as it is said, and along.
type Law = (Option<Across>, Option<Friction>);

enum Across {
    Restitution(Expr),
    Compliant(ContactLaw),
}

/// One of `rigid`, `spring` and `hertz`, or none of them.
fn law(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    let laws: [(_, _, laws::Read<Law>); 3] =
        [("rigid", &RIGID, rigid), ("spring", &laws::COMPLIANT, spring), ("hertz", &laws::HERTZ, hertz)];
    Some(laws::one_of(draft, name, table, laws)?.unwrap_or_default())
}

fn spring(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    laws::spring(draft, name, table).map(compliant)
}

fn hertz(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    laws::hertz(draft, name, table).map(compliant)
}

fn compliant((law, friction): laws::Law) -> Law {
    (Some(Across::Compliant(law)), friction)
}

/// The same with friction that is said beside it.
fn with_friction(draft: &mut Draft, name: &str, field: &Field, (across, inner): Law) -> Option<Law> {
    let friction = laws::friction(draft, name, field);
    if inner.is_some() {
        let message = format!("`{name}` has a `friction` in its law and another beside it");
        let mistake = Diagnostic::new(Code::Exclusive, field.key_span.clone(), message);
        draft.note(mistake.label("a second one").help("leave one of them out"));
        return None;
    }
    Some((across, Some(friction?)))
}

/// Names of bodies of which every two meet; `None` is all.
fn between_of(draft: &mut Draft, name: &str, field: &Field) -> Option<Option<Vec<String>>> {
    let Some(fields) = field.elements() else {
        return draft.choice(field, &ALL).map(|_| None);
    };
    let names: Vec<Option<String>> = fields.iter().map(|field| met(draft, field)).collect();
    let names: Vec<String> = names.into_iter().collect::<Option<_>>()?;
    let again = (1..names.len()).find(|place| names[..*place].contains(&names[*place]));
    if let Some(place) = again {
        let message = format!("`{name}` is of `{}` with itself", names[place]);
        let mistake = Diagnostic::new(Code::Exclusive, fields[place].span.clone(), message);
        draft.note(mistake.label("named again").help("a body meets others: name each of them once"));
        return None;
    }
    if names.len() < 2 {
        let message = format!("`{name}` needs two bodies, or more");
        let mistake = Diagnostic::new(Code::Exclusive, field.span.clone(), message);
        let help = "write `between = [\"red\", \"white\"]`, or `between = \"all\"` for all bodies";
        draft.note(mistake.label("who meets?").help(help));
        return None;
    }
    Some(Some(names))
}

/// The name of a body or a surface, which must exist.
fn met(draft: &mut Draft, field: &Field) -> Option<String> {
    let name = draft.words(field)?;
    let known = || draft.names.bodies.iter().chain(&draft.names.surfaces);
    if known().any(|known| *known == name) {
        return Some(name);
    }
    let help = suggest::name(&name, "bodies and surfaces", known().map(String::as_str));
    let mistake = Diagnostic::new(
        Code::UnknownBody,
        field.span.clone(),
        format!("there is no body or surface \"{name}\""),
    );
    draft.note(mistake.label("unknown name").help(help));
    None
}

/// Restitution, where it is not the bodies' own, and friction.
fn rigid(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    let restitution =
        table.take("restitution").map(|field| draft.constant(name, &field, Want::constant(Dimension::NONE)));
    let friction = laws::rubbing(draft, name, table)?;
    match restitution {
        Some(own) => Some((Some(Across::Restitution(own?)), friction)),
        None => Some((None, friction)),
    }
}
