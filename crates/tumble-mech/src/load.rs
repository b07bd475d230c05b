//! What a user says acts on a body.

use tumble_expr::{Expr, Vector};

use crate::place::Place;

/// A force or torque on one body, as formulas of the time, the parameters and any body's state.
#[derive(Clone, Debug)]
pub struct Load {
    /// Its name.
    pub name: String,
    /// Name of the body it acts on.
    pub body: String,
    /// What it does.
    pub application: Application,
    /// Start and end of its action: it acts from the start on and before the end. `None` is always.
    pub during: Option<[Moment; 2]>,
}

/// When something begins or ends.
#[derive(Clone, Debug)]
pub enum Moment {
    /// A time, s, a formula of the parameters.
    Time(Expr),
    /// Each time the event of that name happens.
    Event(String),
}

impl From<Expr> for Moment {
    fn from(time: Expr) -> Self {
        Self::Time(time)
    }
}

/// A force at a place, or a couple.
#[derive(Clone, Debug)]
pub enum Application {
    /// A force, N.
    Force {
        /// Where it acts.
        at: Place,
        /// Its components.
        force: Vector,
        /// What the components refer to.
        frame: Frame,
    },
    /// A torque without a force, N m, counter-clockwise positive.
    Torque(Expr),
}

impl Application {
    /// What it is stated by.
    pub(crate) fn formulas(&self) -> Vec<&Expr> {
        match self {
            Self::Torque(couple) => vec![couple],
            Self::Force { at, force, .. } => {
                let place = match at {
                    Place::Material(_) => [].as_slice(),
                    Place::World(place) | Place::FromCentre(place) => place.components(),
                };
                force.components().iter().chain(place).collect()
            }
        }
    }
}

/// Axes that components refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frame {
    /// x to the right, y up.
    World,
    /// The axes in which the body is described; they turn with it.
    Body,
}

impl Load {
    /// A force in world axes, N, that always acts.
    pub fn force(name: impl Into<String>, body: impl Into<String>, at: Place, force: Vector) -> Self {
        let application = Application::Force { at, force, frame: Frame::World };
        Self { name: name.into(), body: body.into(), application, during: None }
    }

    /// A torque, N m, that always acts.
    pub fn torque(name: impl Into<String>, body: impl Into<String>, torque: Expr) -> Self {
        Self { name: name.into(), body: body.into(), application: Application::Torque(torque), during: None }
    }

    /// The same load from one moment on and before another.
    #[must_use]
    pub fn during(mut self, from: impl Into<Moment>, to: impl Into<Moment>) -> Self {
        self.during = Some([from.into(), to.into()]);
        self
    }
}
