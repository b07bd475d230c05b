//! What happens where two touch: rigid or compliant, and friction along it.

use tumble_expr::{Dimension, Exponent};
use tumble_mech::{ContactLaw, Friction, Release, Restitution};

use super::spring::{DAMPING, STIFFNESS};
use crate::code::Code;
use crate::diagnostic::Diagnostic;
use crate::document::{Field, Table};
use crate::draft::Draft;
use crate::formula::Want;
use crate::keys::{Declared, Keys, Takes, may, must};

/// s/m, of Hunt and Crossley's damping.
const SLOWNESS: Dimension = Dimension::new(-1, 0, 1);

#[rustfmt::skip]
pub(super) const RIGID: Keys = Keys::of("rigid", &[
    &[must("restitution", Takes::PURE, "0.7", "how much of its speed an impact leaves, from 0 to 1")],
    RUBBING,
]);

/// Friction along what is rigid or compliant.
const FRICTION_ALONG: Declared = may(
    "friction",
    COEFFICIENTS,
    "none",
    "0.3",
    "dry friction: one coefficient, or `{ static = 0.4, kinetic = 0.3 }`",
);

/// Friction and what goes with it, of whatever is rigid.
#[rustfmt::skip]
pub(super) const RUBBING: &[Declared] = &[
    FRICTION_ALONG,
    may("rolling", Takes::LENGTH, "none", "\"1 mm\"",
        "rolling resistance, a length: the couple against rolling is at most so much times the normal force; with `friction`"),
    may("law", Takes::Word(&LAWS), "`\"poisson\"`", "\"stronge\"",
        "what the restitution is the ratio of in an impact with friction: `\"poisson\"` impulses, `\"stronge\"` works, \
         `\"newton\"` speeds"),
];

/// Of friction.
pub(super) const COEFFICIENTS: Takes = Takes::Either(&[Takes::PURE, Takes::Table(&FRICTION)]);

const LAWS: [&str; 3] = ["poisson", "stronge", "newton"];

#[rustfmt::skip]
const FRICTION: Keys = Keys::of("friction", &[&[
    must("static", Takes::PURE, "0.4", "greatest friction over the normal force while nothing slips"),
    must("kinetic", Takes::PURE, "0.3", "friction over the normal force while it slips; not greater"),
]]);

#[rustfmt::skip]
pub(super) const COMPLIANT: Keys = Keys::of("spring of a surface", &[&[
    must("stiffness", Takes::Quantity(STIFFNESS), "\"1e4 N/m\"", "N/m"),
    must("damping", Takes::Quantity(DAMPING), "0", "kg/s"),
    may("release", Takes::Word(&RELEASES), "`\"at zero force\"`", "\"at the surface\"", "when it lets go"),
    FRICTION_ALONG,
]]);

const RELEASES: [&str; 2] = ["at zero force", "at the surface"];

#[rustfmt::skip]
pub(super) const HERTZ: Keys = Keys::of("hertz", &[&[
    must("stiffness", Takes::Formula, "\"1e6 N/m^(3/2)\"", "N/m^(3/2)"),
    must("damping", Takes::Quantity(SLOWNESS), "0", "s/m"),
    FRICTION_ALONG,
]]);

/// What happens across where two touch, and along.
pub(super) type Law = (ContactLaw, Option<Friction>);

/// One of `rigid`, `spring` and `hertz`.
pub(super) fn of_surface(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    let laws: [(_, _, Read<Law>); 3] =
        [("rigid", &RIGID, rigid), ("spring", &COMPLIANT, spring), ("hertz", &HERTZ, hertz)];
    let Some(law) = one_of(draft, name, table, laws)? else {
        let message = format!("`{}` does not say what it does to what touches it", table.title);
        let mistake = Diagnostic::new(Code::MissingKey, table.span.clone(), message);
        let help = "add `rigid = { restitution = 0.7 }`, `spring = { stiffness = \"1e4 N/m\", damping = 0 }` or \
                    `hertz = { stiffness = \"1e6 N/m^(3/2)\", damping = 0 }`";
        draft.note(mistake.label("rigid or compliant?").help(help));
        return None;
    };
    Some(law)
}

/// How a law is read.
pub(super) type Read<T> = fn(&mut Draft, &str, &mut Table) -> Option<T>;

/// The law that is given; of two, the second is a mistake.
pub(super) fn one_of<T>(
    draft: &mut Draft,
    name: &str,
    table: &mut Table,
    laws: impl IntoIterator<Item = (&'static str, &'static Keys, Read<T>)>,
) -> Option<Option<T>> {
    let given: Vec<_> =
        laws.into_iter().filter_map(|(key, keys, read)| Some((keys, read, table.take(key)?))).collect();
    if let [(.., first), (.., second), ..] = &given[..] {
        let message = format!("`{}` is both `{}` and `{}`", table.title, first.key, second.key);
        let mistake = Diagnostic::new(Code::Exclusive, second.key_span.clone(), message);
        draft.note(mistake.label("a second law").also(first.key_span.clone(), "the first"));
        return None;
    }
    let Some((keys, read, field)) = given.into_iter().next() else { return Some(None) };
    let mut inner = draft.inline(&field, keys)?;
    let law = read(draft, name, &mut inner);
    draft.done(inner);
    law.map(Some)
}

fn rigid(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    let restitution = draft.coefficient(table, name, "restitution");
    let friction = rubbing(draft, name, table);
    Some((ContactLaw::Rigid { restitution: restitution? }, friction?))
}

/// Friction of a rigid contact, if it has any, and what its restitution is the ratio of.
pub(super) fn rubbing(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Option<Friction>> {
    let (meaning, rolling) = (table.take("law"), table.take("rolling"));
    let friction = table.take("friction").map(|field| friction(draft, name, &field));
    if let (None, Some(field)) = (&friction, &rolling) {
        let message = format!("`{name}` resists rolling, but has no `friction`");
        let help = "what rolls is held by friction: add `friction = 0.5`, or `friction = 0` where bodies have their own";
        let mistake = Diagnostic::new(Code::Exclusive, field.key_span.clone(), message);
        draft.note(mistake.label("nothing rolls here").help(help));
        return None;
    }
    let friction = match rolling {
        Some(field) => {
            draft.remember(format!("rolling resistance of `{name}`"), &field.span);
            let length = draft.number(&field, Want::constant(Dimension::LENGTH));
            friction.map(|friction| Some(friction?.rolling(length?)))
        }
        None => friction,
    };
    Some(match (friction, &meaning) {
        (Some(friction), None) => Some(friction?),
        (Some(friction), Some(field)) => {
            let meaning = ratio(draft, field);
            Some(friction?.restitution(meaning?))
        }
        (None, Some(field)) => {
            let message = format!("`{name}` has a `law` of impacts, but no `friction`");
            let help = "without friction the three laws are one: add `friction = 0.3`, or leave `law` out";
            let mistake = Diagnostic::new(Code::Exclusive, field.key_span.clone(), message);
            draft.note(mistake.label("says nothing here").help(help));
            return None;
        }
        (None, None) => None,
    })
}

/// What the restitution is the ratio of.
fn ratio(draft: &mut Draft, field: &Field) -> Option<Restitution> {
    Some(match draft.choice(field, &LAWS)? {
        "stronge" => Restitution::Stronge,
        "newton" => Restitution::Newton,
        _ => Restitution::Poisson,
    })
}

/// Friction of what is compliant, if it has any.
fn along(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Option<Friction>> {
    match table.take("friction") {
        Some(field) => friction(draft, name, &field).map(Some),
        None => Some(None),
    }
}

/// One coefficient, or a static and a kinetic one.
pub(super) fn friction(draft: &mut Draft, name: &str, field: &Field) -> Option<Friction> {
    if field.value.as_table().is_none() {
        draft.remember(format!("friction of `{name}`"), &field.span);
        return draft.number(field, Want::constant(Dimension::NONE)).map(Friction::new);
    }
    let mut inner = draft.inline(field, &FRICTION)?;
    let [of_rest, kinetic] = ["static", "kinetic"].map(|key| {
        let own = draft.required(&mut inner, key)?;
        draft.remember(format!("{key} friction of `{name}`"), &own.span);
        draft.number(&own, Want::constant(Dimension::NONE))
    });
    draft.remember(format!("friction of `{name}`"), &field.span);
    draft.done(inner);
    Some(Friction::new(of_rest?).kinetic(kinetic?))
}

pub(super) fn spring(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    let stiffness = draft.coefficient(table, name, "stiffness");
    let damping = draft.coefficient(table, name, "damping");
    let release = match table.take("release") {
        Some(field) => draft.choice(&field, &RELEASES),
        None => Some("at zero force"),
    };
    let release = match release? {
        "at the surface" => Release::AtSurface,
        _ => Release::AtZeroForce,
    };
    let friction = along(draft, name, table);
    let law = ContactLaw::Spring { stiffness: stiffness?, damping: damping?, release };
    Some((law, friction?))
}

pub(super) fn hertz(draft: &mut Draft, name: &str, table: &mut Table) -> Option<Law> {
    let want = Want::constant(Dimension { length: Exponent::new(-1, 2), ..Dimension::FORCE });
    let stiffness = draft.required(table, "stiffness");
    let stiffness = stiffness.and_then(|field| draft.constant(name, &field, want));
    let damping = draft.coefficient(table, name, "damping");
    let friction = along(draft, name, table);
    Some((ContactLaw::Hertz { stiffness: stiffness?, damping: damping? }, friction?))
}
