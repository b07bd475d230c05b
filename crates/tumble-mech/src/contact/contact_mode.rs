//! Contact modes: how a pair touches in a mode. A pair that a mode does not mention is apart.

/// Contact mode of a pair: how a point of a body touches a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ContactMode {
    /// Pressed into a compliant surface.
    Pressed,
    /// Still inside a compliant surface, but let go by it.
    Released,
    /// In a Hertzian surface, since it touches, and so little that there is no force yet.
    Entering(Margin),
    /// In a Hertzian surface, and so little that there is no force any more.
    Leaving(Margin),
    /// On a rigid surface, which pushes as much as keeps it there.
    Resting,
    /// On a rigid surface after impacts that have become too small to be told apart and will soon have ended.
    Settling,
    /// On a rigid surface, kept there by other contacts of the same body: the forces between them are undetermined, and
    /// this one is given none.
    Idle,
}

/// How deep is little. What the force that is left out would do is so in the difference of a motion and its check runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Margin {
    /// As little as rounding allows.
    Narrow,
    /// Four times that, in check runs.
    Wide,
}

impl ContactMode {
    /// Whether the surface is rigid and keeps the point on it by a force that the equations solve for.
    pub(crate) fn is_held(self) -> bool {
        matches!(self, Self::Resting | Self::Settling)
    }

    /// Whether it is in a compliant surface by less than rounding tells from touching.
    pub(crate) fn is_slight(self) -> bool {
        matches!(self, Self::Entering(_) | Self::Leaving(_))
    }

    /// Whether the point stays on a rigid surface.
    pub fn is_lasting(self) -> bool {
        self.is_held() || self == Self::Idle
    }
}
