//! Grips: how a contact with friction is held along its surface in a mode.

/// A way along a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Way {
    /// Along the normal turned clockwise by a right angle: to the right on a floor.
    Forward,
    /// The other way.
    Backward,
}

/// How a contact with friction is held along its surface. All points by which one body touches one surface slip alike: they are on a
/// line along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Grip {
    /// It does not slip, and friction is as much as that takes. Of several points of a body on one surface, this one is given all of
    /// it: what each has is undetermined.
    Sticks,
    /// It does not slip because another point or another surface holds it, and is given no friction.
    Follows,
    /// It slips that way, and friction is the kinetic coefficient of the normal force.
    Slides(Way),
    /// It does not slip because another surface holds it, and friction has all that it can have, as if it would slip that way.
    Strains(Way),
}

impl Way {
    /// The way of a rate along the surface.
    pub(crate) fn of(rate: f64) -> Self {
        if rate < 0.0 { Self::Backward } else { Self::Forward }
    }

    /// 1 or -1.
    pub(crate) fn sign(self) -> i32 {
        match self {
            Self::Forward => 1,
            Self::Backward => -1,
        }
    }
}

impl Grip {
    /// Whether the point does not move along the surface.
    pub fn is_still(self) -> bool {
        !matches!(self, Self::Slides(_))
    }
}
