//! Ends of springs and dampers.

use tumble_expr::{Dimension, Expr, Symbol, Vector};

use crate::kinematics::PointRef;
use crate::parameters::time_symbol;

/// A point that something is fastened to.
#[derive(Clone, Debug)]
pub enum Anchor {
    /// A material point of a body.
    Material(PointRef),
    /// A place of the world, m; a formula of the time where it is moved on a given path.
    World(Vector),
}

impl Anchor {
    /// Position, m.
    pub fn position(&self) -> Vector {
        match self {
            Self::Material(point) => point.position(),
            Self::World(place) => place.clone(),
        }
    }

    /// Velocity, m/s.
    pub fn velocity(&self) -> Vector {
        match self {
            Self::Material(point) => point.velocity(),
            Self::World(place) => rate(place),
        }
    }

    /// The point of a body that it is.
    pub(crate) fn material(&self) -> Option<&PointRef> {
        match self {
            Self::Material(point) => Some(point),
            Self::World(_) => None,
        }
    }

    /// The body it belongs to.
    pub fn body(&self) -> Option<&str> {
        match self {
            Self::Material(point) => Some(&point.body.body),
            Self::World(_) => None,
        }
    }

    /// Formulas of its place, for checking their dimension.
    pub(crate) fn places(&self) -> &[Expr] {
        match self {
            Self::Material(point) => point.arm.components(),
            Self::World(place) => place.components(),
        }
    }
}

/// Derivative of a given path with respect to the time.
pub(crate) fn rate(path: &Vector) -> Vector {
    let t: Symbol = time_symbol();
    path.map(|component| component.derivative(&t))
}

/// A name's symbol for a place that a wind field depends on.
pub fn place_symbols() -> [Symbol; 2] {
    ["x", "y"].map(|name| Symbol::new(name, Dimension::LENGTH))
}
