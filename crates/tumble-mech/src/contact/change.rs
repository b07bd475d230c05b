//! What an instant changes for a pair.

/// What can happen to a pair at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Change {
    /// An impact, of no duration.
    Impact,
    /// Impacts have become too small to be followed one by one.
    Zeno,
    /// A contact begins that lasts.
    Start,
    /// A lasting contact ends.
    End,
    /// A contact with friction begins to slip, or slips the other way from now on.
    Slides,
    /// It ceases to slip.
    Sticks,
    /// The same of a round rim, which rolls from now on.
    Rolls,
    /// Of what resists rolling: it turns no longer, or begins to.
    Stops,
    /// See [`Self::Stops`].
    Turns,
    /// A body that a surface has let go inside itself is out of it.
    Clear,
}

impl Change {
    /// What friction may do to a contact.
    pub const OF_FRICTION: [Self; 3] = [Self::Slides, Self::Sticks, Self::Rolls];
    /// What resistance against rolling may do.
    pub const OF_ROLLING: [Self; 2] = [Self::Stops, Self::Turns];

    /// What people call it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Zeno => "zeno",
            Self::Start => "start",
            Self::End => "end",
            Self::Slides => "slides",
            Self::Sticks => "sticks",
            Self::Rolls => "rolls",
            Self::Stops => "stops",
            Self::Turns => "turns",
            Self::Clear => "clear",
        }
    }
}
