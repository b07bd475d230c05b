//! # Law
//! Where contacts slip so that no forces hold what presses on them (Painleve), an impulse may stop the slip though nothing closes: an
//! impact without collision. With `u_n = 0` before, friction presses one contact into the surface until its slip is zero; from there on it is pushed out, and
//! compression ends at p_c where `u_n = 0` again, restitution at `(1 + e) p_c`, as in any impact. Of several at once compression is
//! the limit of `w = u + h a + A z` for `h -> 0` with the complementarity of pushes and gaps and the friction of any impact: z goes to zero
//! with h where forces hold the contacts, and else to the impulses.
//! # Symbols and units
//! u (m/s) rates of gaps and slips, a (m/s^2) what they do without pushes, A (1/kg) response, z and p (N s) impulses, h (s) a time.
//! # Sign and frame
//! Gaps open with `u_n > 0`.
//! # Validity
//! Rigid bodies where no forces exist: what could go on otherwise, as where the contact would also open by itself, is refused. It happens
//! only where the model asks for it ([`Painleve::Impact`]).
//! # Source
//! Lecornu, C. R. Acad. Sci. 140 (1905); Génot and Brogliato, European Journal of Mechanics A 18 (1999).
//! # Checked by
//! `tests/painleve.rs`: a rod's impulse and motion in closed form, one that nothing else holds and one among others.

use nalgebra::DVector;
use tumble_ode::Reason;

use super::ending::Ending;
use super::{STANDS, Settling, Touched};
use crate::contact::slip::WEDGED;
use crate::contact::sticking::{Pushes, Rough};
use crate::laws::impact::Painleve;
use crate::mode::Mode;
use crate::record::Jump;

/// In the time h forces without each other change rates by this part of the slowest slip, which may be the one that an impulse stops. Who
/// presses, sticks and slides is looked for with each in turn, and has to hold for none.
const MOMENTS: [f64; 4] = [1e-3, 1e-5, 1e-1, 1e-7];
/// Impulses that change rates by less than this part of the slowest slip are none: rounding.
const IMPULSIVE: f64 = 1e-6;

impl Settling<'_> {
    /// Lets impulses stop what slips where no forces hold the contacts, if the model asks for it; whether there are any.
    pub(super) fn impacts_without_collision(
        &mut self,
        zeno: Option<&Ending>,
        touched: &Touched,
        jump: &mut Jump<Mode>,
    ) -> Result<bool, Reason> {
        if self.equations.model().painleve == Painleve::Refused {
            return Ok(false);
        }
        let mut all = DVector::zeros(self.touch.response.nrows());
        for group in self.coupled(&self.members(zeno)) {
            all += match &group[..] {
                [only] => self.stopped_alone(*only, touched)?,
                _ => self.stopped_together(&group, touched, jump)?,
            };
        }
        if all.amax() == 0.0 {
            return Ok(false);
        }
        self.count_round()?;
        self.impulses += &all;
        self.apply(&all, jump)?;
        Ok(true)
    }

    /// The impulse at one contact; zero where a force holds it, or it opens.
    fn stopped_alone(&self, position: usize, touched: &Touched) -> Result<DVector<f64>, Reason> {
        let none = DVector::zeros(self.touch.response.nrows());
        let Some(slip) = self.touch.slips.at(position) else { return Ok(none) };
        let row = self.touch.pairs.len() + slip;
        let (rate, [_, kinetic]) = (self.touch.slips.rate[slip], self.touch.slips.friction[slip]);
        if rate.abs() <= self.still(slip) || self.touch.free[position] >= -self.zero() {
            return Ok(none);
        }
        let pushes = self.touch.pushes();
        let (own, by) = (pushes[(position, position)], pushes[(position, row)]);
        let is_wedged = touched.wedged.contains(&self.touch.pairs[position]);
        if own - rate.signum() * kinetic * by > WEDGED * own && !is_wedged {
            return Ok(none);
        }
        let mut rates = self.rates();
        rates[position] = 0.0;
        self.routh(position, &rates)
    }

    /// Impulses of several contacts; none where forces hold them.
    fn stopped_together(
        &self,
        group: &[usize],
        touched: &Touched,
        jump: &Jump<Mode>,
    ) -> Result<DVector<f64>, Reason> {
        let none = DVector::zeros(self.touch.response.nrows());
        let slipping = self.slipping_patches(group, touched, jump);
        let is_wedged = group.iter().any(|position| touched.wedged.contains(&self.touch.pairs[*position]));
        let slips = slipping.iter().filter(|patch| patch.slips.is_some());
        let slip = |row: usize| self.touch.slips.rate[row - self.touch.pairs.len()].abs();
        let slips: Vec<f64> = slips.map(|patch| slip(patch.row())).collect();
        let (Some(slowest), Some(fastest)) =
            (slips.iter().copied().reduce(f64::min), slips.iter().copied().reduce(f64::max))
        else {
            return Ok(none);
        };
        let accelerations = self.accelerations();
        if !is_wedged && self.forces(group, &slipping).solve().is_some() {
            return Ok(none);
        }
        let mut rates = self.rates_slipping(&slipping);
        group.iter().for_each(|position| rates[*position] = 0.0);
        let patches = self.patches(group, false);
        let of = |without: DVector<f64>, zero: f64| Rough { zero, ..self.rough(group, &patches, without) };
        let still = STANDS * fastest;
        let limit = |part: &f64| {
            let moment = part * slowest / accelerations.amax();
            let Pushes { grips, held, .. } =
                of(&rates + &accelerations * moment, moment * self.zero()).solve()?;
            let exact = of(rates.clone(), still);
            let sound = |found: &Pushes| exact.is_sound(found);
            // What only forces would press has no part in the impulses.
            exact.stopped(&grips, &held).filter(sound).or_else(|| exact.attempt(&grips).filter(sound))
        };
        let Some(compressed) = MOMENTS.iter().find_map(limit) else { return Ok(none) };
        let impulsive = (&self.touch.response * &compressed.pushes).amax() > IMPULSIVE * slowest;
        if !impulsive {
            return Ok(none);
        }
        self.refuse_other_laws(group)?;
        self.restored(group, &patches, compressed, still)
    }
}
