//! The accuracy a user asks for, and what a single step is held to for it.

use thiserror::Error;

/// Largest error that a run may have, relative to the scales of its states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy(f64);

/// An accuracy that cannot be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("an accuracy of {0:e} cannot be asked for: it lies between {min:e} and {max:e}", min = Accuracy::FINEST, max = Accuracy::COARSEST)]
pub struct AccuracyError(pub f64);

impl Accuracy {
    /// Finer than this, rounding in doubles leaves nothing to control.
    pub const FINEST: f64 = 1e-14;
    /// Coarser than this, a result is not worth its name.
    pub const COARSEST: f64 = 1e-3;
    /// What is asked for when nobody asks.
    pub const DEFAULT: Self = Self(1e-9);

    /// Errors of many steps add up and grow: each is held to this much of the whole, at an accuracy of 1, ...
    const LOCAL_MARGIN: f64 = 0.01;
    /// ... and to less of a finer one, whose steps are more, and whose runs are longer: so 1e-3 to 1e-9 are met with a hundredth
    /// to a thousandth of them on motions that do not diverge.
    const LOCAL_POWER: f64 = 1.1;
    /// Runs this far apart in tolerance have orders four apart, and the error of one is small beside the other's.
    const OTHER: f64 = 1e3;
    /// A run that is coarser for want of a finer one: other steps, and an error that is not much larger.
    const COARSE: f64 = 10.0;
    /// Runs closer than this in tolerance would take nearly the same steps.
    const APART: f64 = 4.0;
    /// Half a unit in the last place: no step can be held to less.
    const LOCAL_FLOOR: f64 = f64::EPSILON / 2.0;

    /// An accuracy between [`Accuracy::FINEST`] and [`Accuracy::COARSEST`].
    pub fn new(value: f64) -> Result<Self, AccuracyError> {
        let allowed = Self::FINEST..=Self::COARSEST;
        if allowed.contains(&value) { Ok(Self(value)) } else { Err(AccuracyError(value)) }
    }

    /// Tighter by so much that the steps have another order; the finest where there is none.
    pub fn finer(self) -> Self {
        Self((self.0 / Self::OTHER).max(Self::FINEST))
    }

    /// The accuracy of a second run that is to tell the error of one to this accuracy: finer where steps can be held to
    /// that, else coarser.
    pub fn independent(self) -> Self {
        let floor = libm::pow(Self::LOCAL_FLOOR / Self::LOCAL_MARGIN, 1.0 / Self::LOCAL_POWER);
        if self.0 >= Self::APART * floor { self.finer() } else { Self(floor * Self::COARSE) }
    }

    /// The number.
    pub fn value(self) -> f64 {
        self.0
    }

    /// Error that one step may add, relative to the scales.
    pub fn local_tolerance(self) -> f64 {
        (libm::pow(self.0, Self::LOCAL_POWER) * Self::LOCAL_MARGIN).max(Self::LOCAL_FLOOR)
    }
}

impl Default for Accuracy {
    fn default() -> Self {
        Self::DEFAULT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_can_be_reached_can_be_asked_for() {
        assert!(Accuracy::new(1e-9).is_ok());
        for bad in [0.0, -1e-9, 1e-15, 1.0, f64::NAN, f64::INFINITY] {
            assert!(Accuracy::new(bad).is_err(), "{bad}");
        }
    }
}
