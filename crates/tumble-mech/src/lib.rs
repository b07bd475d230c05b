//! Rigid bodies under forces: from a [`Model`] to [`Equations`] whose every term knows its law, body and point.
//!
//! The way through this crate is [`Body`], joints and [`Load`]s → [`Model`] → [`Equations`] (a hybrid system for the
//! integrator) → [`Observer`] (quantities along a trajectory). One law a file, in `laws`. It reads no scene and draws
//! no figure.

mod air;
mod algebraic;
mod anchor;
mod assembly;
mod balance;
mod body;
mod body_equations;
mod brake;
mod braking;
mod cache;
mod carried;
mod classes;
mod components;
mod conditions;
mod constraints;
mod contact;
mod coordinates;
mod coupling;
mod energy;
mod equations;
mod equilibrium;
mod error;
mod evaluator;
mod event;
mod extremes;
mod feedback;
mod first_forces;
mod fixed;
mod forces;
mod formulas;
mod friction;
mod gauge;
mod gauss;
mod impulse;
mod initial;
mod interaction;
mod islands;
mod joint;
mod kinematics;
mod laws;
mod linear_program;
mod link;
mod load;
mod mass;
mod mode;
mod model;
mod observer;
mod others;
mod overlap;
mod parameters;
mod place;
mod placement;
mod potential;
mod product;
mod record;
mod refined;
mod rest;
mod restrained;
mod row;
mod run;
mod sets;
mod shape;
mod singular;
mod start;
mod statement;
mod structure;
mod surface;
mod system;
mod term;
mod tracks;
mod trust;
mod uniqueness;
mod warnings;

pub use air::Wind;
pub use anchor::{Anchor, place_symbols};
pub use balance::{Balance, BodyBalance, Contribution, ContributionKind, Reading, RunBalance, Store};
pub use body::{Body, Part};
pub use contact::{
    BodyContact, Change, Contact, ContactMode, Feature, Grip, Margin, NORMAL, Pair, PolygonSide, Rule,
    TANGENT, Way,
};
pub use coordinates::Pivot;
pub use equations::Equations;
pub use equilibrium::{
    Equilibrium, EquilibriumPose, Growth, NoEquilibrium, Reaction, SmallMotions, Stability,
};
pub use error::{ModelError, ModelErrors};
pub use event::{Action, Event};
pub use extremes::{Extreme, Peak, PeakKind};
pub use forces::{Force, Forces, joined};
pub use friction::{Friction, Restitution};
pub use impulse::{AppliedImpulse, Impulse, Source};
pub use interaction::{Bodies, Interaction};
pub use joint::{Joint, JointKind};
pub use kinematics::{Kinematics, PointRef, rotated, time};
pub use laws::drag::{Component, Drag, DragPlace};
pub use laws::impact::{MultipleImpacts, Painleve};
pub use laws::magnus::Magnus;
pub use laws::spring::Spring;
pub use laws::torsion::Torsion;
pub use load::{Application, Frame, Load, Moment};
pub use mass::MassProperties;
pub use mode::Mode;
pub use model::{Gravity, Model};
pub use observer::Observer;
pub use others::{Beyond, Others, PossibleChange, PossibleContact, PossibleMotions};
pub use parameters::{Known, Parameters};
pub use place::Place;
pub use potential::Potential;
pub use record::{Happening, Record};
pub use refined::Quadrature;
pub use run::{Run, RunError, Snapshot};
pub use shape::Shape;
pub use start::Start;
pub use statement::Statement;
pub use surface::{ContactLaw, Release, Round, Surface};
pub use term::{Law, Term};
pub use trust::{At, Divergence, Errors, Horizon, Trust, depends_on_motion};
pub use uniqueness::Spread;
pub use warnings::ModelWarning;
