//! Rigid bodies under forces: from a [`Model`] to [`Equations`] whose every term knows its law, body and point.
//!
//! The way through this crate is [`Body`], joints and [`Load`]s → [`Model`] → [`Equations`] (a hybrid system for the
//! integrator) → [`Observer`] (quantities along a trajectory). One law a file, in `laws`. It reads no scene and draws
//! no figure.

mod air;
mod anchor;
mod balance;
mod body;
mod cache;
mod carried;
mod conditions;
mod contact;
mod coordinates;
mod energy;
mod equations;
mod error;
mod evaluator;
mod event;
mod extremes;
mod first_forces;
mod fixed;
mod forces;
mod gauss;
mod initial;
mod interaction;
mod kinematics;
mod laws;
mod load;
mod mass;
mod mode;
mod model;
mod observer;
mod parameters;
mod place;
mod run;
mod shape;
mod start;
mod stated;
mod structure;
mod surface;
mod system;
mod term;
mod trust;
mod warnings;

pub use air::Wind;
pub use anchor::{Anchor, place_symbols};
pub use balance::{Balance, BodyBalance, Contribution, Kind, Reading, RunBalance, Store};
pub use body::{Body, Part};
pub use contact::{Contact, ContactMode, Feature, Impulse, Pair};
pub use coordinates::Pivot;
pub use equations::Equations;
pub use error::{ModelError, ModelErrors};
pub use event::{Action, Event};
pub use extremes::{Extreme, Peak, PeakKind};
pub use forces::{Force, Forces, joined};
pub use interaction::{Bodies, Interaction};
pub use kinematics::{Kinematics, PointRef, rotated, time};
pub use laws::drag::{Component, Drag, DragPlace};
pub use laws::impact::MultipleImpacts;
pub use laws::magnus::Magnus;
pub use laws::spring::Spring;
pub use laws::torsion::Torsion;
pub use load::{Application, Frame, Load, Moment};
pub use mass::MassProperties;
pub use mode::Mode;
pub use model::{Gravity, Model};
pub use observer::Observer;
pub use parameters::{Known, Parameters};
pub use place::Place;
pub use run::{Instant, Quadrature, Run, RunError};
pub use shape::Shape;
pub use start::Start;
pub use surface::{ContactLaw, Release, Surface};
pub use term::{Law, Term};
pub use trust::{At, Divergence, Errors, Horizon, Trust, depends_on_motion};
pub use warnings::ModelWarning;
