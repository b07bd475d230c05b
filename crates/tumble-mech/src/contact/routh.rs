//! # Law
//! An impact at one contact, followed by its normal impulse p (Routh): the velocity of the point that touches, along the surface
//! and out of it, changes by `du = A (f, 1) dp`. While it slips, `f = -mu_k sign(u_t)`. Where the slip comes to zero it sticks, with
//! `f = -A_tn / A_tt`, if that is at most mu_s in size; else it slips the way that the impact drives it, towards `sign(A_tn)`.
//! Compression ends with `u_n = 0` at p_c. The impact ends (Poisson) at `(1 + e) p_c`; (Stronge) where restitution has done the part
//! e^2 of the work of compression; (Newton) where `u_n` is -e times what it was.
//! # Symbols and units
//! A (1/kg) response to impulses, u (m/s), p (N s), mu_s and mu_k coefficients of friction (1), e restitution (1).
//! # Sign and frame
//! n points out of the solid, t is n turned clockwise by a right angle. `u_n < 0` closes.
//! # Validity
//! One contact of rigid bodies in the plane. A of rank one, as of a body on a pivot, may jam: it sticks, and no further push moves
//! it; how large the impulse grows then is undetermined. Newton's law may gain energy where friction acts (Kane): that is refused.
//! # Source
//! Routh 1905, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV; Stronge 2000, Impact Mechanics; Wang and Mason
//! 1992, J. Appl. Mech. 59.
//! # Checked by
//! Tests below: every regime against closed forms and against an integration in small steps; energy of random impacts.

use crate::contact::complementarity::DEPENDENT;
use crate::friction::Restitution;

/// An impact with Newton's law gains energy if it does so by more than this part of the motion's energies that it exchanges: less is
/// rounding.
const GAIN: f64 = 1e-12;

/// What an impact starts from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strike {
    /// Changes of the velocity by unit impulses: along by along, along by out, out by out, 1/kg.
    pub(crate) response: [f64; 3],
    /// Velocity before, along the surface and out of it, m/s.
    pub(crate) before: [f64; 2],
    /// Static and kinetic coefficient.
    pub(crate) friction: [f64; 2],
    /// e
    pub(crate) restitution: f64,
    /// What it is the ratio of.
    pub(crate) law: Restitution,
}

/// How an impact ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// It slips as it did at the beginning.
    Slips,
    /// It has come to stick.
    Sticks,
    /// It has come to slip the other way, or was driven to slip from none.
    Turns,
    /// It sticks and nothing that pushes moves it: the impulse is undetermined beyond what stopped it.
    Jams,
}

/// What an impact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Struck {
    /// Impulse along the surface and out of it, N s.
    pub(crate) impulse: [f64; 2],
    pub(crate) ending: Ending,
}

/// Why there is no impact by the law asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Refused {
    /// Nothing parts the contact.
    Blocked,
    /// Newton's law would add so much energy, J.
    GainsEnergy(f64),
}

/// A stretch in which the ratio of the impulses is constant.
#[derive(Clone, Copy)]
struct Stretch {
    /// Impulse along the surface for each unit out of it.
    ratio: f64,
    /// Changes of both velocities for each unit.
    slopes: [f64; 2],
}

/// The course of an impact: one stretch, and another from where the slip has stopped.
struct Course {
    before: [f64; 2],
    first: Stretch,
    /// Where the slip stops, N s; infinite if it does not.
    stop: f64,
    then: Stretch,
    after_stop: Ending,
}

impl Strike {
    /// The impulse of the whole impact.
    pub(crate) fn resolve(&self) -> Result<Struck, Refused> {
        let course = self.course();
        let compression = course.compression().ok_or(Refused::Blocked)?;
        let end = match self.law {
            _ if course.jams_at(compression) => compression,
            Restitution::Poisson => (1.0 + self.restitution) * compression,
            Restitution::Stronge => course.released(compression, self.restitution),
            Restitution::Newton => course.parting_with(-self.restitution * self.before[1], compression),
        };
        let struck = Struck { impulse: course.impulse(end), ending: course.ending(end) };
        self.refuse_gain(&struck)?;
        if end.is_finite() { Ok(struck) } else { Err(Refused::Blocked) }
    }

    fn stretch(&self, ratio: f64) -> Stretch {
        let [tt, tn, nn] = self.response;
        Stretch { ratio, slopes: [tn + tt * ratio, nn + tn * ratio] }
    }

    fn course(&self) -> Course {
        let ([u_t, _], [_, kinetic]) = (self.before, self.friction);
        let (then, after_stop) = self.once_still();
        let first = if u_t == 0.0 { then } else { self.stretch(-kinetic * u_t.signum()) };
        let towards_zero = -u_t / first.slopes[0];
        let stop = match u_t == 0.0 {
            true => 0.0,
            false if towards_zero > 0.0 => towards_zero,
            false => f64::INFINITY,
        };
        Course { before: self.before, first, stop, then, after_stop }
    }

    /// What happens once nothing slips.
    fn once_still(&self) -> (Stretch, Ending) {
        let ([tt, tn, nn], [of_rest, kinetic]) = (self.response, self.friction);
        if tn.abs() > of_rest * tt {
            return (self.stretch(-kinetic * tn.signum()), Ending::Turns);
        }
        // Where nothing moves along the surface, nothing has to be held.
        let ratio = if tt > 0.0 { -tn / tt } else { 0.0 };
        let out = nn + tn * ratio;
        match out <= DEPENDENT * nn {
            true => (Stretch { ratio, slopes: [0.0, 0.0] }, Ending::Jams),
            false => (Stretch { ratio, slopes: [0.0, out] }, Ending::Sticks),
        }
    }

    /// Energy that an impulse adds, J, with the size of what that is a difference of.
    fn gain(&self, [p_t, p_n]: [f64; 2]) -> (f64, f64) {
        let ([tt, tn, nn], [u_t, u_n]) = (self.response, self.before);
        let own = [tt * p_t * p_t, nn * p_n * p_n, 2.0 * tn * p_t * p_n].map(|part| 0.5 * part);
        let parts = [u_t * p_t, u_n * p_n, own[0], own[1], own[2]];
        (parts.iter().sum(), parts.iter().map(|part| part.abs()).sum())
    }

    fn refuse_gain(&self, struck: &Struck) -> Result<(), Refused> {
        let (gain, size) = self.gain(struck.impulse);
        match self.law == Restitution::Newton && gain > GAIN * size {
            true => Err(Refused::GainsEnergy(gain)),
            false => Ok(()),
        }
    }
}

impl Course {
    /// Velocity out of the surface where the slip stops, m/s.
    fn out_at_stop(&self) -> f64 {
        self.before[1] + self.first.slopes[1] * self.stop
    }

    /// Impulse that ends compression.
    fn compression(&self) -> Option<f64> {
        let own = -self.before[1] / self.first.slopes[1];
        if self.first.slopes[1] > 0.0 && own <= self.stop {
            return Some(own);
        }
        let left = -self.out_at_stop();
        match self.after_stop {
            // What stops with the slip but for rounding is stopped.
            Ending::Jams if left <= DEPENDENT * self.before[1].abs() => Some(self.stop),
            Ending::Jams => None,
            _ => Some(self.stop + left / self.then.slopes[1]).filter(|end| end.is_finite()),
        }
    }

    /// Whether no push from there on moves anything: compression and slip have ended at once.
    fn jams_at(&self, compression: f64) -> bool {
        self.after_stop == Ending::Jams && self.stop <= compression * (1.0 + DEPENDENT)
    }

    /// Impulse at which restitution has done the part e^2 of what compression has taken.
    fn released(&self, compression: f64, e: f64) -> f64 {
        let target = e * e * self.taken(compression);
        let Stretch { slopes: [_, first], .. } = self.first;
        let until_stop = (self.stop - compression).max(0.0);
        if self.stop > compression && 0.5 * first * until_stop * until_stop >= target {
            return compression + libm::sqrt(2.0 * target / first);
        }
        let left = target - if self.stop > compression { 0.5 * first * until_stop * until_stop } else { 0.0 };
        let speed = if self.stop > compression { first * until_stop } else { 0.0 };
        let root = libm::sqrt(speed * speed + 2.0 * self.then.slopes[1] * left);
        let more = if left > 0.0 { 2.0 * left / (speed + root) } else { 0.0 };
        self.stop.max(compression) + more
    }

    /// Work done against the motion in compression.
    fn taken(&self, compression: f64) -> f64 {
        let first = self.stop.min(compression);
        let at_first_end = self.before[1] + self.first.slopes[1] * first;
        -0.5 * ((self.before[1] + at_first_end) * first + at_first_end * (compression - first))
    }

    /// Impulse at which the contact parts with a speed.
    fn parting_with(&self, speed: f64, compression: f64) -> f64 {
        if speed <= 0.0 {
            return compression;
        }
        let own = (speed - self.before[1]) / self.first.slopes[1];
        if self.first.slopes[1] > 0.0 && own <= self.stop {
            return own;
        }
        self.stop + (speed - self.out_at_stop()) / self.then.slopes[1]
    }

    fn impulse(&self, end: f64) -> [f64; 2] {
        let first = end.min(self.stop);
        [self.first.ratio * first + self.then.ratio * (end - first), end]
    }

    fn ending(&self, end: f64) -> Ending {
        if end < self.stop { Ending::Slips } else { self.after_stop }
    }
}

#[cfg(test)]
mod tests;
