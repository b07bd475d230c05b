//! Where a force acts.

use tumble_expr::Vector;

use crate::kinematics::{Kinematics, PointRef};

/// The point of action of a force on a body.
#[derive(Clone, Debug)]
pub enum Place {
    /// A material point, which moves and turns with its body.
    Material(PointRef),
    /// A place in the world, m: the body's material that is there at each instant.
    World(Vector),
    /// An offset from the centre of mass along the world axes, m: it does not turn with the body.
    FromCentre(Vector),
}

impl Place {
    /// From the centre of mass of `body` to the point, m, world axes.
    pub fn arm(&self, body: &Kinematics) -> Vector {
        match self {
            Self::Material(point) => point.world_arm(),
            Self::World(place) => place - body.position(),
            Self::FromCentre(offset) => offset.clone(),
        }
    }
}
