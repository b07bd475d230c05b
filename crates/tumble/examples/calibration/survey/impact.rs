//! An impact at one contact with friction, by its impulse out of the surface (Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV).
//!
//! As long as the state of slip lasts the velocities change in proportion to the impulse. So what happens is a few straight pieces, from the
//! beginning to where slip or closing comes to zero, and to the end.

use super::real::Real;

/// What an impact starts from, along the surface and out of it.
pub(crate) struct Impact {
    /// Changes of the velocity by unit impulses: along by along, along by out, out by out.
    pub(crate) response: [Real; 3],
    pub(crate) velocity: [Real; 2],
    /// Kinetic and static coefficient.
    pub(crate) friction: [Real; 2],
    pub(crate) restitution: Real,
    /// Whether e is the ratio of impulses (Poisson) or of the roots of works (Stronge).
    pub(crate) is_of_work: bool,
}

/// Velocity, impulse, and work of the push, on the way.
#[derive(Clone)]
struct Now {
    velocity: [Real; 2],
    impulse: [Real; 2],
    work: Real,
}

impl Impact {
    /// The impulse of the whole impact.
    pub(crate) fn impulse(&self) -> [Real; 2] {
        let zero = Real::zero();
        let mut now =
            Now { velocity: self.velocity.clone(), impulse: [zero.clone(), zero.clone()], work: zero };
        now = self.until(now, |now, [_, out]| -(&now.velocity[1] / out));
        let (pushed, taken) = (now.impulse[1].clone(), -&now.work);
        let end = |now: &Now, [_, out]: [&Real; 2]| match self.is_of_work {
            // out p^2/2 + u p is what is left of the work.
            true => {
                let left = &taken * self.restitution.squared() - (&now.work + &taken);
                let root = (now.velocity[1].squared() + out * left * 2).sqrt();
                (root - &now.velocity[1]) / out
            }
            false => &pushed * (1 + &self.restitution) - &now.impulse[1],
        };
        self.until(now, end).impulse
    }

    /// Friction for each unit of push.
    fn ratio(&self, slip: &Real) -> Real {
        let [along, cross, _] = &self.response;
        let [kinetic, of_rest] = &self.friction;
        match slip.sign() {
            0 if cross.abs() <= of_rest * along => -(cross / along),
            0 => -(kinetic * cross.sign()),
            way => -(kinetic * way),
        }
    }

    /// Follows it as far as `end` says from where it is and by how velocities change; a stop of slip comes between.
    fn until(&self, now: Now, end: impl Fn(&Now, [&Real; 2]) -> Real) -> Now {
        let [along, cross, out] = &self.response;
        let ratio = self.ratio(&now.velocity[0]);
        let slopes = [cross + along * &ratio, out + cross * &ratio];
        let sticks = now.velocity[0].is_zero() && cross.abs() <= &self.friction[1] * along;
        let own = end(&now, [&slopes[0], &slopes[1]]);
        let stop = -(&now.velocity[0] / if slopes[0].is_zero() { Real::from(1) } else { slopes[0].clone() });
        // Where the push does not end it before, the slip does: also where it would close for ever while it slips.
        let ends = slopes[1].sign() > 0 && own.sign() >= 0;
        if !sticks && stop.sign() > 0 && (!ends || stop < own) {
            let mut there = now.after(&stop, &ratio, &slopes);
            there.velocity[0] = Real::zero();
            return self.until(there, end);
        }
        assert!(ends, "it is wedged");
        let mut there = now.after(&own, &ratio, &slopes);
        if sticks {
            there.velocity[0] = Real::zero();
        }
        there
    }
}

impl Now {
    fn after(&self, push: &Real, ratio: &Real, slopes: &[Real; 2]) -> Self {
        let Self { velocity: [slip, speed], impulse: [along, out], work } = self;
        let velocity = [slip + &slopes[0] * push, speed + &slopes[1] * push];
        let work = work + (speed + &velocity[1]) * push / 2;
        Self { velocity, impulse: [along + ratio * push, out + push], work }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(response: [&str; 3], velocity: [&str; 2], friction: &str, is_of_work: bool) -> [f64; 2] {
        let friction = [Real::read(friction), Real::read(friction)];
        let [response, restitution] = [response.map(Real::read).to_vec(), vec![Real::read("0.5")]];
        let response = response.try_into().expect("three");
        let restitution = restitution[0].clone();
        Impact { response, velocity: velocity.map(Real::read), friction, restitution, is_of_work }
            .impulse()
            .map(|part| part.to_f64())
    }

    #[test]
    fn without_coupling_both_laws_are_one() {
        for is_of_work in [false, true] {
            // It slips to the end, and it stops on the way.
            assert_eq!(of(["3", "0", "1"], ["8", "-2"], "0.25", is_of_work), [-0.75, 3.0]);
            assert_eq!(of(["2", "0", "1"], ["1", "-2"], "0.25", is_of_work), [-0.5, 3.0]);
        }
    }

    #[test]
    fn slip_turns_round() {
        // Slip stops with p = 1, at 1/(1 + 1/4); sticking would take 1, and 1/4 is there.
        let [along, out] = of(["1", "-1", "2"], ["1.25", "-4.5"], "0.25", false);
        // Then it goes on towards the sign of the coupling: friction is forwards. Compression: 4.5 = 2.25 + 1.75 p.
        let compression = 1.0 + 2.25 / 1.75;
        assert!((out - 1.5 * compression).abs() < 1e-15);
        assert!((along - (-0.25 + 0.25 * (out - 1.0))).abs() < 1e-15);
    }
}
