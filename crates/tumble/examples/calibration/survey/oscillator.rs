//! A linear motion in one direction, of which most other motions here are parts.

use super::real::Real;

/// x'' = -stiffness x - damping x' + drive, each for one kilogram.
#[derive(Clone, Debug)]
pub(crate) struct Oscillator {
    /// Negative where the motion runs away, s^-2.
    pub(crate) stiffness: Real,
    /// s^-1
    pub(crate) damping: Real,
}

/// A place and a velocity.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) x: Real,
    pub(crate) v: Real,
}

/// A cos(w t) + B sin(w t), as (A, B, w).
pub(crate) type Wave = [Real; 3];

impl Oscillator {
    /// One without damping.
    pub(crate) fn undamped(stiffness: Real) -> Self {
        Self { stiffness, damping: Real::zero() }
    }

    /// Where it is a time later, without a drive.
    ///
    /// exp(-c t/2) (x0 C + (v0 + c x0/2) S), with C and S the cosine and sine over its frequency of s^2 = k - c^2/4, or
    /// the hyperbolic ones where that is negative.
    pub(crate) fn free(&self, start: &State, time: &Real) -> State {
        let half = &self.damping / 2;
        let square = &self.stiffness - half.squared();
        let (cosine, sine) = pair(&square, time);
        let fading = (-(&half * time)).exp();
        let from_rest = &start.v + &half * &start.x;
        let x = &fading * (&start.x * &cosine + &from_rest * &sine);
        let rate = &fading * (&from_rest * &cosine - &square * &start.x * &sine);
        State { v: rate - half * &x, x }
    }

    /// Where it is a time later under a constant drive, m/s^2.
    pub(crate) fn pushed(&self, start: &State, drive: &Real, time: &Real) -> State {
        if !self.stiffness.is_zero() {
            let rest = drive / &self.stiffness;
            let State { x, v } = self.free(&State { x: &start.x - &rest, v: start.v.clone() }, time);
            return State { x: x + rest, v };
        }
        let (x, v) = if self.damping.is_zero() {
            (drive * time.squared() / 2, drive * time)
        } else {
            let gone = 1 - (-(&self.damping * time)).exp();
            let end = drive / &self.damping;
            ((time - &gone / &self.damping) * &end, gone * end)
        };
        let free = self.free(start, time);
        State { x: free.x + x, v: free.v + v }
    }

    /// Where it is a time after the start under a drive F cos(w t), m/s^2, that is no resonance without damping.
    pub(crate) fn driven(&self, start: &State, [drive, frequency]: [&Real; 2], time: &Real) -> State {
        let [a, b, w] = self.answer(drive, frequency);
        let [sine, cosine] = [(&w * time).sin(), (&w * time).cos()];
        let at_start = State { x: &start.x - &a, v: &start.v - &w * &b };
        let free = self.free(&at_start, time);
        State { x: free.x + &a * &cosine + &b * &sine, v: free.v + w * (b * cosine - a * sine) }
    }

    /// The lasting answer to F cos(w t).
    fn answer(&self, drive: &Real, frequency: &Real) -> Wave {
        let off = &self.stiffness - frequency.squared();
        let loss = &self.damping * frequency;
        let scale = drive / (off.squared() + loss.squared());
        [off * &scale, loss * scale, frequency.clone()]
    }
}

/// C and S of y'' = -square y: C(0) = 1, C'(0) = 0, S(0) = 0, S'(0) = 1.
fn pair(square: &Real, time: &Real) -> (Real, Real) {
    let rate = square.abs().sqrt();
    let angle = &rate * time;
    match square.sign() {
        0 => (Real::from(1), time.clone()),
        1 => (angle.cos(), angle.sin() / rate),
        _ => (angle.cosh(), angle.sinh() / rate),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(text: &str) -> Real {
        Real::read(text)
    }

    /// The residual of the equation by differences of the rate, which are good to the square of their step.
    fn residual(of: &Oscillator, at: &dyn Fn(&Real) -> State, drive: &dyn Fn(&Real) -> Real) -> f64 {
        let (time, step) = (real("0.7"), real("1e-15"));
        let [before, after] = [&time - &step, &time + &step].map(|time| at(&time));
        let here = at(&time);
        let rate = (after.x - before.x) / (&step * 2) - &here.v;
        let change = (after.v - before.v) / (step * 2);
        let law = drive(&time) - &of.stiffness * here.x - &of.damping * here.v;
        (rate.abs() + (change - law).abs()).to_f64()
    }

    #[test]
    fn solutions_obey_the_equation() {
        let start = State { x: real("0.3"), v: real("-1.1") };
        let (drive, frequency) = (real("0.9"), real("1.7"));
        for [stiffness, damping] in
            [["4", "0"], ["4", "0.6"], ["-2", "0.5"], ["1", "5"], ["0", "0"], ["0", "2"]]
        {
            let system = Oscillator { stiffness: real(stiffness), damping: real(damping) };
            let pushed = |time: &Real| system.pushed(&start, &drive, time);
            assert!(residual(&system, &pushed, &|_| drive.clone()) < 1e-28, "{stiffness} {damping}");
            let driven = |time: &Real| system.driven(&start, [&drive, &frequency], time);
            let wave = |time: &Real| &drive * (&frequency * time).cos();
            assert!(residual(&system, &driven, &wave) < 1e-28, "{stiffness} {damping}");
            for at in [pushed(&Real::zero()), driven(&Real::zero())] {
                assert!((at.x - &start.x).abs() + (at.v - &start.v).abs() < real("1e-70"));
            }
        }
    }
}
