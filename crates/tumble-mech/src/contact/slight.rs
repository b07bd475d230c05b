//! Hertzian contacts that touch and have no force yet, or none any more.
//!
//! # Law
//! The force k d^(3/2) has no Taylor series at the surface. Alone, with some speed, a contact begins there in a transformed time (see
//! [`crate::laws::compliant`]); where several begin at one instant, or one without speed, there is none. Then the force is left out up to a
//! depth delta that rounding hardly tells from touching:
//!
//! ```text
//! delta = SLIGHT sqrt(sum of l^2)
//! ```
//!
//! with l the lengths that the gap is made of: what is added up along the normal of a plane, and else places. The work (2/5) k delta^(5/2) is
//! not done: of that of a contact which goes as deep as D a part (delta/D)^(5/2). Check runs leave out four times the depth, so that what it
//! does is in the errors stated; where it is more than UNTOLD of the energy with which the contact comes to delta it is refused.
//! Of several that end together the force is left out again from AT_END delta on. That is four roundings of the lengths, and the work in it
//! less than what rounding of the gap does to that of the whole contact, as long as D is more than ten of them.
//!
//! # Symbols and units
//! k (N/m^(3/2)); d, D, delta and l (m).
//!
//! # Sign and frame
//! Depths are gaps taken negative.
//!
//! # Validity
//! Depths beyond delta: of what does not press as deep, for its lengths, nothing is known. The least length is a nanometre.
//!
//! # Source
//! The work of the force along the depth, whatever the speed.
//!
//! # Checked by
//! `tests/compliant.rs`: a ball that is put down, a rod that falls flat; `tests/compliant_bodies.rs`: balls in a row that touch;
//! `tests/trust.rs`: a floor so stiff that what is left out counts.

use tumble_expr::Expr;
use tumble_expr::units::M;
use tumble_ode::Reason;

use super::pair::dot;
use crate::contact::contact_mode::{ContactMode, Margin};
use crate::contact::opposite::Opposite;
use crate::contact::pair::Pair;
use crate::contact::start::TOUCHES;
use crate::contact::touch::{Now, Touch};
use crate::equations::Equations;
use crate::mode::Mode;
use crate::record::Jump;

/// Deeper than what is taken for touching when a run starts, whichever way lengths are added up.
const SLIGHT: f64 = 4.0 * TOUCHES;
/// The least of the lengths, m, for a point that is at the origin and has no extent: 6e-23 m is less than any depth.
const SMALLEST: f64 = 1e-9;
/// The margin of check runs, in units of delta: the work that they leave out is 32 times as much, so that the difference tells of that of the motion also
/// where it is no small part of the whole.
const WIDE: f64 = 4.0;
/// The work that is left out, in parts of the energy with which a contact comes to that depth: until then no check run differs, and where it is no
/// more than this the depth is off by less than rounding.
const UNTOLD: f64 = 1e-2;
/// Whoever is as deep, in parts of delta, when another begins to press does so too.
pub(super) const LEAST: f64 = 0.5;
/// At the end, in parts of delta: deeper than rounding of the gap, and so much less deep than the beginning that rounding does not take that back.
const AT_END: f64 = 1.0 / 64.0;
/// Whoever is no deeper than this many times that when another ends does so too.
const AS_DEEP: f64 = 2.0;

impl Pair {
    /// The depth up to which it has no force where it does not begin alone and with speed, m.
    pub(crate) fn slight(&self) -> Expr {
        let places = [self.centre.position(), self.opposite.position(&self.through)];
        let places = places.iter().map(|place| match &self.opposite {
            Opposite::Plane => {
                squared(&(place.x() * self.normal.x())) + squared(&(place.y() * self.normal.y()))
            }
            Opposite::Circle(_) | Opposite::Edge(_) => dot(place, place),
        });
        let arm = dot(&self.centre.arm, &self.centre.arm);
        let lengths = [squared(&self.radius), squared(&self.extent()), arm, squared(&(SMALLEST * M))];
        SLIGHT * places.chain(lengths).fold(Expr::zero(), |sum, next| sum + next).sqrt()
    }

    /// The same in a contact mode.
    pub(crate) fn slight_within(&self, contact_mode: Option<ContactMode>) -> Expr {
        match contact_mode {
            Some(ContactMode::Entering(Margin::Wide) | ContactMode::Leaving(Margin::Wide)) => {
                WIDE * self.slight()
            }
            _ => self.slight(),
        }
    }

    /// What becomes positive where the force is left out again, by the root of the depth, m^(1/2).
    pub(crate) fn shallow(&self) -> Expr {
        (AT_END * self.slight()).sqrt() - Expr::from(self.root_symbol())
    }
}

fn squared(length: &Expr) -> Expr {
    length * length
}

impl Equations {
    /// Whether there is no time transformation for the end of a Hertzian contact, since that of others may be the same.
    pub(super) fn is_among_roots(&self, mode: &Mode, pair: usize) -> bool {
        self.pairs()[pair].is_hertzian() && self.roots(mode).len() > 1
    }

    /// A Hertzian contact begins without force; `touch` is what its bodies are at that instant, where something presses it already.
    pub(super) fn enter(
        &self,
        index: usize,
        touch: Option<&Touch>,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<(), Reason> {
        let pair = &self.pairs()[index];
        let mode = Mode { contacts: vec![], ..jump.mode.clone() };
        let states = &jump.states[..self.states(&mode).len()];
        let Some((stiffness, _)) = pair.law.coefficients() else { return Ok(()) };
        let asked = [pair.slight(), stiffness.clone()];
        let found = self.values(&asked, &mode, now.time, states, now.inputs)?;
        let (slight, work) = (found[0], 0.4 * found[1] * libm::pow(found[0], 2.5));
        let energy = |(touch, own): (&Touch, usize)| {
            let (rate, lightness) = (touch.rate[own], touch.response[(own, own)]);
            (rate * rate / 2.0 - touch.free[own] * slight) / lightness
        };
        let pressed = touch.and_then(|touch| Some((touch, touch.position(index)?)));
        if pressed.map(energy).is_some_and(|energy| work > UNTOLD * energy) {
            return Err(Reason::Model(format!(
                "`{}` is pressed in by about what rounding makes of its gap, {slight:.0e} m: let it be nearer to the origin, or take `rigid`",
                pair.name
            )));
        }
        jump.mode.set_contact_mode(index, Some(ContactMode::Entering(self.margin())));
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
        let touch =
            |pair: &usize| self.touch(&self.island_with(*pair, &jump.mode), &jump.mode, &jump.states, now);
        let touches = begun.iter().map(touch).collect::<Result<Vec<_>, _>>()?;
        for (pair, touch) in begun.into_iter().zip(&touches) {
            self.enter(pair, Some(touch), now, jump)?;
        }
        self.restate(&pressed, &[], now, jump)
    }

    fn margin(&self) -> Margin {
        if self.rounding().is_nearest() { Margin::Narrow } else { Margin::Wide }
    }

    /// One goes through the depth up to which it has no force, and with it whoever does so at this instant but for rounding: from there on
    /// nobody would see it. Who presses from now on, if they do.
    pub(super) fn pass_slight(
        &self,
        index: usize,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<Vec<usize>, Reason> {
        let goes_in = !jump.mode.is_pressed(index);
        let mut passing = vec![];
        for (other, contact_mode) in &jump.mode.contacts {
            let pair = &self.pairs()[*other];
            let is_alike = match goes_in {
                true => matches!(contact_mode, ContactMode::Entering(_)),
                false => *contact_mode == ContactMode::Pressed && pair.is_hertzian(),
            };
            if *other == index || (is_alike && self.is_there(*other, goes_in, now, jump)?) {
                passing.push(*other);
            }
        }
        let after = if goes_in { ContactMode::Pressed } else { ContactMode::Leaving(self.margin()) };
        for pair in &passing {
            jump.mode.set_contact_mode(*pair, Some(after));
            jump.mode.set_grip(*pair, None);
        }
        Ok(if goes_in { passing } else { vec![] })
    }

    /// Whether a contact goes through that depth, or through the one where it ends, with another one.
    fn is_there(&self, index: usize, goes_in: bool, now: Now<'_>, jump: &Jump<Mode>) -> Result<bool, Reason> {
        let pair = &self.pairs()[index];
        let depth = if goes_in { -pair.gap() } else { squared(&pair.root_symbol().into()) };
        let asked = [depth, pair.gap_rate(), pair.slight_within(jump.mode.contact_mode(index))];
        let found = self.values(&asked, &jump.mode, now.time, &jump.states, now.inputs)?;
        let (depth, rate, slight) = (found[0], found[1], found[2]);
        Ok(match goes_in {
            true => depth >= LEAST * slight && rate < 0.0,
            false => depth <= AS_DEEP * AT_END * slight && rate > 0.0,
        })
    }
}
