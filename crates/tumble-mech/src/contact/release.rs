//! How compliant contacts end: back at the surface, with their force, or by being handed to another of the same two.

use tumble_expr::Expr;
use tumble_ode::{Crossing, Reason};

use crate::contact::change::Change;
use crate::contact::contact_mode::ContactMode;
use crate::contact::settle::STANDS;
use crate::contact::start::TOUCHES;
use crate::contact::touch::Now;
use crate::contact::watched::Watched;
use crate::equations::Equations;
use crate::laws::compliant::resistance;
use crate::mode::Mode;
use crate::record::{Happening, Jump};

impl Equations {
    /// A pressed point comes back to the surface, or its force to zero. Where both do so at once but for rounding, it is clear. Who presses
    /// again inside, if it does.
    pub(super) fn let_go(
        &self,
        index: usize,
        watched: Watched,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<Vec<usize>, Reason> {
        let pair = &self.pairs()[index];
        let (after, change) = match (watched, jump.mode.contact_mode(index)) {
            (Watched::Force, Some(ContactMode::Pressed)) if self.is_at_surface(index, now, jump)? => {
                jump.zeros.push((pair.guard_name(Watched::Gap), 1));
                (None, Change::End)
            }
            (Watched::Force, Some(ContactMode::Pressed)) => (Some(ContactMode::Released), Change::End),
            (Watched::Force, _) => (Some(ContactMode::Pressed), Change::Start),
            (_, Some(ContactMode::Released)) => (None, Change::Clear),
            _ => (None, Change::End),
        };
        jump.mode.set_contact_mode(index, after);
        jump.mode.set_grip(index, None);
        jump.record.happened.push(Happening::Contact { pair: index, change });
        Ok(if after == Some(ContactMode::Pressed) { vec![index] } else { vec![] })
    }

    /// A contact leaves where there may be one while it is pressed in. Another of the same two takes over what depth there is, a corner
    /// from an edge, as the circle goes on about it; else what is stored is lost. Who takes over.
    pub(super) fn pass_on(
        &self,
        index: usize,
        now: Now<'_>,
        jump: &mut Jump<Mode>,
    ) -> Result<Vec<usize>, Reason> {
        let Some(before) = jump.mode.contact_mode(index) else { return Ok(vec![]) };
        let next = self.next_to(index, now, jump)?;
        let mut tell = |pair, change| jump.record.happened.push(Happening::Contact { pair, change });
        match before {
            ContactMode::Pressed | ContactMode::Entering(_) | ContactMode::Leaving(_) => {
                tell(index, Change::End);
                next.into_iter().for_each(|next| tell(next, Change::Start));
            }
            _ if next.is_none() => tell(index, Change::Clear),
            _ => {}
        }
        jump.mode.set_contact_mode(index, None);
        jump.mode.set_grip(index, None);
        next.into_iter().for_each(|next| jump.mode.set_contact_mode(next, Some(before)));
        Ok(next.into_iter().collect())
    }

    /// Of the pairs of the same two that are open, though they are in each other where that is a contact, the deepest that is no deeper than
    /// a pair: nothing is gained.
    fn next_to(&self, index: usize, now: Now<'_>, jump: &Jump<Mode>) -> Result<Option<usize>, Reason> {
        let own = &self.pairs()[index];
        let is_open = |other: &usize| {
            let pair = &self.pairs()[*other];
            let of_same = pair.couple() == own.couple();
            of_same && *other != index && !pair.is_rolling() && jump.mode.contact_mode(*other).is_none()
        };
        let values =
            |formulas: &[Expr]| self.values(formulas, &jump.mode, now.time, &jump.states, now.inputs);
        let known = values(&[-own.gap(), own.extents()])?;
        let most = known[0] + TOUCHES * known[1];
        let mut deepest = (0.0, None);
        for other in self.pair_list().of_body(own.body).filter(is_open) {
            let pair = &self.pairs()[other];
            let found = values(&[vec![-pair.gap()], pair.taken_within()].concat())?;
            let is_contact = found[1..].iter().all(|limit| *limit >= 0.0);
            if is_contact && found[0] > deepest.0 && found[0] <= most {
                deepest = (found[0], Some(other));
            }
        }
        Ok(deepest.1)
    }

    /// A jump of velocities or of parameters takes a force across zero without passing it, which no guard sees: what would pull lets go, and
    /// what would push again inside does. Whether there is any.
    pub(super) fn turn_round(&self, at: &Crossing<'_, Mode>, jump: &mut Jump<Mode>) -> Result<bool, Reason> {
        let same = at.mode.changes == jump.mode.changes && at.states == jump.states;
        let may_turn = |(pair, mode): &(usize, ContactMode)| match mode {
            ContactMode::Pressed | ContactMode::Released if !same => {
                Some((*pair, *mode)).filter(|_| self.pairs()[*pair].releases_early())
            }
            _ => None,
        };
        let compliant: Vec<(usize, ContactMode)> = jump.mode.contacts.iter().filter_map(may_turn).collect();
        let now = Now::of(at);
        let mut turned = false;
        for (pair, before) in compliant {
            let parts = resistance(&self.pairs()[pair]);
            let parts = self.values(&parts, &jump.mode, now.time, &jump.states, now.inputs)?;
            let (force, size) = (parts[0] + parts[1], parts[0].abs() + parts[1].abs());
            if (before == ContactMode::Pressed) == (force > 0.0) || force.abs() <= STANDS * size {
                continue;
            }
            // The depth of what has just come is rounding.
            if self.is_at_surface(pair, now, jump)? {
                continue;
            }
            let roots = self.roots(&jump.mode);
            let pressed = self.let_go(pair, Watched::Force, now, jump)?;
            self.restate(&roots, &pressed, now, jump)?;
            turned = true;
        }
        Ok(turned)
    }

    fn is_at_surface(&self, index: usize, now: Now<'_>, jump: &Jump<Mode>) -> Result<bool, Reason> {
        let touch = self.touch(&self.island_with(index, &jump.mode), &jump.mode, &jump.states, now)?;
        Ok(touch.position(index).is_some_and(|own| touch.gap[own].abs() <= touch.blur[own]))
    }
}
