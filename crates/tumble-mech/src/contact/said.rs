//! Whose restitution and friction count where two touch. What is said for the pair, in a contact that names both, comes first; then what
//! a body has of its own, the lesser of two bodies'; then the surface's. Each of the two is looked for on its own, and so is what a
//! restitution is the ratio of.

use tumble_expr::{Binary, Expr};

use crate::body::Body;
use crate::contact::meeting::BodyContact;
use crate::friction::Friction;
use crate::model::Model;
use crate::surface::{ContactLaw, Surface};

/// What happens across where they touch, and along.
pub(crate) type Said = (ContactLaw, Option<Friction>);

/// What counts for a body on a surface; a compliant one has its own law across itself.
pub(crate) fn of_surface_and_body(model: &Model, surface: &Surface, body: &Body) -> Said {
    let pair = model.contacts.iter().find(|contact| contact.is_of(surface, body));
    let restitution = pair.and_then(|pair| pair.restitution.as_ref()).or(body.restitution.as_ref());
    let of_pair = pair.and_then(|pair| pair.friction.as_ref());
    let friction = first([of_pair, body.friction.as_ref(), surface.friction.as_ref()]);
    (surface.law.with_restitution(restitution), friction)
}

/// How two bodies rebound; `None` where nobody says it.
pub(crate) fn restitution_of_bodies(contact: &BodyContact, [one, other]: [&Body; 2]) -> Option<Expr> {
    let own = match (&one.restitution, &other.restitution) {
        (Some(a), Some(b)) => Some(Expr::binary(Binary::Min, a.clone(), b.clone())),
        (a, b) => a.clone().or(b.clone()),
    };
    contact.restitution.clone().or(own)
}

/// Friction of two bodies.
pub(crate) fn friction_of_bodies(contact: &BodyContact, [one, other]: [&Body; 2]) -> Option<Friction> {
    let own = match (&one.friction, &other.friction) {
        (Some(a), Some(b)) => Some(a.lesser(b)),
        (a, b) => a.clone().or(b.clone()),
    };
    first([contact.friction.as_ref(), own.as_ref()])
}

/// The first that is there, with the first meaning of a restitution and the first rolling resistance that any of them has.
fn first<const N: usize>(said: [Option<&Friction>; N]) -> Option<Friction> {
    let said = || said.into_iter().flatten();
    let restitution = said().find_map(|friction| friction.restitution);
    let rolling = said().find_map(|friction| friction.rolling.clone());
    Some(Friction { restitution, rolling, ..said().next()?.clone() })
}
