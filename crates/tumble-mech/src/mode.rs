//! Which equations hold.

/// What is switched on at an instant.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Mode {
    /// Whether each load that has a window acts, in the model's order.
    pub windows: Vec<bool>,
}
