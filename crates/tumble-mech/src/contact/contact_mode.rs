//! Contact modes: how a pair touches in a mode. A pair that a mode does not mention is apart.

/// Contact mode of a pair: how a point of a body touches a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ContactMode {
    /// Pressed into a compliant surface.
    Pressed,
    /// Still inside a compliant surface, but let go by it.
    Released,
    /// In a Hertzian surface, since it touches, and so little that there is no force yet.
    Entering,
    /// In a Hertzian surface, and so little that there is no force any more.
    Leaving,
    /// On a rigid surface, which pushes as much as keeps it there.
    Resting,
    /// On a rigid surface after impacts that have become too small to be told apart and will soon have ended.
    Settling,
    /// On a rigid surface, kept there by other contacts of the same body: the forces between them are undetermined, and
    /// this one is given none.
    Idle,
}

impl ContactMode {
    /// Whether the surface is rigid and keeps the point on it by a force that the equations solve for.
    pub(crate) fn is_held(self) -> bool {
        matches!(self, Self::Resting | Self::Settling)
    }

    /// Whether it is in a compliant surface by less than rounding tells from touching.
    pub(crate) fn is_slight(self) -> bool {
        matches!(self, Self::Entering | Self::Leaving)
    }

    /// Whether the point stays on a rigid surface.
    pub(crate) fn is_lasting(self) -> bool {
        self.is_held() || self == Self::Idle
    }
}
