//! Which equations hold.

/// What is switched on at an instant.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Mode {
    /// Whether each load that has a window acts, in the model's order.
    pub windows: Vec<bool>,
    /// Which events have changed parameters, in the order in which they first did; of two that change the same
    /// parameter, the later counts.
    pub changes: Vec<usize>,
}

impl Mode {
    /// The event of that index changes its parameters now.
    pub(crate) fn change(&mut self, event: usize) {
        self.changes.retain(|known| *known != event);
        self.changes.push(event);
    }
}
