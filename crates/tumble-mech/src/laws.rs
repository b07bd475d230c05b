//! Laws of force, one a file: from what the model says to terms of the equations.

pub(crate) mod applied;
pub(crate) mod weight;
