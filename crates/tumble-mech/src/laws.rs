//! Laws of force, one a file: from what the model says to terms of the equations.

pub(crate) mod applied;
pub(crate) mod compliant;
pub(crate) mod drag;
pub(crate) mod impact;
pub(crate) mod magnus;
pub(crate) mod spring;
pub(crate) mod torsion;
pub(crate) mod weight;
