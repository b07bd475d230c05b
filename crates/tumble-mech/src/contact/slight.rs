//! Hertzian contacts that touch and have no force yet, or none any more.
//!
//! # Law
//! The force k d^(3/2) has no Taylor series at the surface. Alone, with some speed, a contact begins there in a transformed time (see
//! [`crate::laws::compliant`]); where several begin at one instant, or one without speed, there is none. Then the force is left out up to a
//! depth delta that rounding hardly tells from touching, and at the end of several at once from a quarter of it on, so that rounding does not
//! take back what has begun:
//!
//! ```text
//! delta = SLIGHT sqrt(sum of l^2)
//! ```
//!
//! with l the lengths that the gap is made of. Of the impulse of a contact that goes as deep as D that is a part of (delta/D)^2 or less,
//! which is less than what rounding of the gap does to its force.
//!
//! # Symbols and units
//! k (N/m^(3/2)); d, D, delta and l (m).
//!
//! # Sign and frame
//! Depths are gaps taken negative.
//!
//! # Validity
//! Depths well beyond delta: who does not press as deep has no force. A point at the origin that has no extent has no delta.
//!
//! # Source
//! The expansion of the motion at first touch: with a speed v the depth is v t and the impulse 2 k v^(3/2) t^(5/2) / 5, without it a t^2 / 2
//! and k (a/2)^(3/2) t^4 / 4.
//!
//! # Checked by
//! `tests/compliant.rs`: a ball that is put down, a rod that falls flat; `tests/compliant_bodies.rs`: balls in a row that touch.

use tumble_expr::Expr;
use tumble_ode::Reason;

use super::pair::dot;
use crate::contact::contact_mode::ContactMode;
use crate::contact::pair::Pair;
use crate::contact::start::TOUCHES;
use crate::contact::touch::Now;
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Jump;

/// Deeper than what is taken for touching when a run starts, whichever way lengths are added up.
const SLIGHT: f64 = 4.0 * TOUCHES;

/// Whoever is as deep, in parts of this depth, when another begins to press does so too, and ends where another does that is not: between
/// both ends of what is left out.
pub(super) const LEAST: f64 = 0.5;
/// At the end the force is left out from this part of the root of the depth on.
const ROOT_AT_END: f64 = 0.5;

impl Pair {
    /// The depth up to which it has no force where it does not begin alone and with speed, m.
    pub(crate) fn slight(&self) -> Expr {
        let places = [self.centre.position(), self.opposite.position(&self.through)];
        let places = places.iter().map(|place| dot(place, place));
        let arm = dot(&self.centre.arm, &self.centre.arm);
        let lengths = [&self.radius * &self.radius, self.extent() * self.extent(), arm].into_iter();
        SLIGHT * places.chain(lengths).fold(Expr::zero(), |sum, next| sum + next).sqrt()
    }

    /// What becomes positive where the force is left out again, by the root of the depth, m^(1/2).
    pub(crate) fn shallow(&self) -> Expr {
        ROOT_AT_END * self.slight().sqrt() - Expr::from(self.root_symbol())
    }
}

impl Equations {
    /// Whether there is no time transformation for the end of a Hertzian contact, since that of others may be the same.
    pub(super) fn is_among_roots(&self, mode: &Mode, pair: usize) -> bool {
        self.pairs()[pair].is_hertzian() && self.roots(mode).len() > 1
    }

    /// A Hertzian contact begins without force.
    pub(super) fn enter(&self, index: usize, now: Now<'_>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        let pair = &self.pairs()[index];
        let mode = Mode { contacts: vec![], ..jump.mode.clone() };
        let states = &jump.states[..self.states(&mode).len()];
        let slight = self.values(&[pair.slight()], &mode, now.time, states, now.inputs)?[0];
        if slight <= 0.0 {
            return Err(Reason::Model(format!(
                "`{}` is of a point at the origin that touches without speed or with others, and nothing says how deep is deep: let it begin \
                 a little above the surface, or with some speed",
                pair.name
            )));
        }
        jump.mode.set_contact_mode(index, Some(ContactMode::Entering));
        Ok(())
    }

    /// Contacts that begin to press at one instant, and so with roots of depths that are all zero, begin without force.
    pub(super) fn enter_together(&self, now: Now<'_>, jump: &mut Jump<Mode>) -> Result<(), Reason> {
        let pressed = self.roots(&jump.mode);
        let roots = &jump.states[jump.states.len() - pressed.len()..];
        let begun: Vec<usize> =
            pressed.iter().zip(roots).filter(|(_, root)| **root == 0.0).map(|(pair, _)| *pair).collect();
        if begun.len() < 2 {
            return Ok(());
        }
        begun.into_iter().try_for_each(|pair| self.enter(pair, now, jump))?;
        self.restate(&pressed, &[], now, jump)
    }

    /// One goes through the depth up to which it has no force, and with it whoever does so at this instant but for rounding: from there on
    /// nobody would see it. Who presses from now on, if they do.
    pub(super) fn pass_slight(
        &self,
        index: usize,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<Vec<usize>, Reason> {
        let goes_in = jump.mode.contact_mode(index) != Some(ContactMode::Pressed);
        let (from, after) = match goes_in {
            true => (ContactMode::Entering, ContactMode::Pressed),
            false => (ContactMode::Pressed, ContactMode::Leaving),
        };
        let mut passing = vec![index];
        let others = jump.mode.contacts.iter().filter(|(other, mode)| *other != index && *mode == from);
        let others = others.map(|(other, _)| *other).filter(|other| self.pairs()[*other].is_hertzian());
        for other in others {
            let pair = &self.pairs()[other];
            let asked = [-pair.gap(), pair.gap_rate(), pair.slight()];
            let found = self.values(&asked, &jump.mode, now.time, &jump.states, now.inputs)?;
            let (depth, rate, slight) = (found[0], found[1], found[2]);
            let is_in = depth >= LEAST * slight;
            let is_there = if goes_in { is_in && rate < 0.0 } else { !is_in && rate > 0.0 };
            passing.extend(is_there.then_some(other));
        }
        for pair in &passing {
            jump.mode.set_contact_mode(*pair, Some(after));
            jump.mode.set_grip(*pair, None);
        }
        Ok(if goes_in { passing } else { vec![] })
    }
}
