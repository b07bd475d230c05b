//! What is wrong with a model.

use thiserror::Error;
use tumble_expr::{CompileError, TypeError};

/// One mistake in a model.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ModelError {
    /// A formula whose dimension does not fit its place.
    #[error("{what}: {mistake}")]
    Type {
        /// The place, such as "mass of `rod`".
        what: String,
        /// What does not fit.
        mistake: TypeError,
    },
    /// A formula that cannot be evaluated.
    #[error("{what}: {mistake}")]
    Compile {
        /// The place.
        what: String,
        /// Why.
        mistake: CompileError,
    },
    /// Two things of one name.
    #[error("there are two of the name `{name}`")]
    Duplicate {
        /// The name.
        name: String,
    },
    /// A name that nothing has.
    #[error("there is no {kind} `{name}`")]
    Unknown {
        /// "body", "point", ...
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A number that must be positive is not.
    #[error("{what} is {}: it must be positive", quantity(*value, unit))]
    NotPositive {
        /// The place.
        what: String,
        /// Its value.
        value: f64,
        /// SI unit.
        unit: &'static str,
    },
    /// A number that must not be negative is.
    #[error("{what} is {}: it must not be negative", quantity(*value, unit))]
    Negative {
        /// The place.
        what: String,
        /// Its value.
        value: f64,
        /// SI unit.
        unit: &'static str,
    },
    /// A positive number so small that it has lost digits.
    #[error("{what} is {value:e} {unit}: numbers below 2.3e-308 have lost digits")]
    TooSmall {
        /// The place.
        what: String,
        /// Its value.
        value: f64,
        /// SI unit.
        unit: &'static str,
    },
    /// An angle so large that the next number is too far away from it.
    #[error(
        "{what}: an angle of {value:e} rad points nowhere, since numbers of that size are too far apart: at most \
         {most:e} rad are possible here"
    )]
    Angle {
        /// The place.
        what: String,
        /// rad
        value: f64,
        /// The limit, rad.
        most: f64,
    },
    /// A vector without length that has to point somewhere.
    #[error("{what} has no length, and so no direction")]
    NoDirection {
        /// The vector.
        what: String,
    },
    /// A point held at its own place.
    #[error("{what} holds a body without moment of inertia about it: nothing says how it turns")]
    NoInertia {
        /// The pivot.
        what: String,
    },
    /// A load that is infinite or not a number at the start.
    #[error("`{load}` is {value} at the start: a force must be a finite number")]
    NoForce {
        /// Name of the load.
        load: String,
        /// Its force or torque.
        value: f64,
    },
    /// Ends of a spring that are at one place at the start.
    #[error(
        "the ends of `{load}` are at one place at the start: the direction in which it pulls is undefined"
    )]
    NoSpan {
        /// Name of the spring.
        load: String,
    },
    /// A mistake that an event makes by setting parameters.
    #[error("after the event `{event}`: {mistake}")]
    AfterEvent {
        /// Name of the event.
        event: String,
        /// What is wrong then.
        mistake: Box<ModelError>,
    },
    /// The place where a load acts depends on forces of contacts or joints.
    #[error(
        "the place of `{load}` depends on {}, which are found with the motion: it has to follow from the motion and the time",
        listed(read)
    )]
    PlaceByForces {
        /// Name of the load.
        load: String,
        /// Symbols of those forces.
        read: Vec<String>,
    },
    /// A load jumps where others depend on forces otherwise than linearly.
    #[error(
        "`{load}` may jump between events, and {} would with it, on which a load depends otherwise than linearly",
        listed(read)
    )]
    Jumps {
        /// Name of the load.
        load: String,
        /// Symbols of the forces.
        read: Vec<String>,
    },
    /// Forces that loads read and that are not determined at the start.
    #[error("at the start: {problem}")]
    Feedback {
        /// Which, and why.
        problem: String,
    },
    /// A value that is infinite or not a number.
    #[error("{what} is {value}: it must be a finite number")]
    NotFinite {
        /// The place.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A force window that ends before it begins.
    #[error("`{load}` acts from {from} s to {to} s: it must not end before it begins")]
    Window {
        /// Name of the load.
        load: String,
        /// Start, s.
        from: f64,
        /// End, s.
        to: f64,
    },
    /// A body without moment of inertia that something turns.
    #[error("`{body}` is a point and has no moment of inertia, but `{load}` turns it")]
    PointTurned {
        /// Name of the body.
        body: String,
        /// Name of the load.
        load: String,
    },
    /// A body that is held twice.
    #[error("`{body}` is held by `{first}` and by `{second}`: one pivot is all a body in the plane can have")]
    HeldTwice {
        /// Name of the body.
        body: String,
        /// Name of one pivot.
        first: String,
        /// Name of the other.
        second: String,
    },
    /// A joint of something with itself.
    #[error("`{joint}` joins {what}: a joint keeps a body at another body or at a place")]
    JointOfOne {
        /// Name of the joint.
        joint: String,
        /// What it joins.
        what: String,
    },
    /// A joint whose points are not at one place at the start.
    #[error("what `{joint}` joins is {gap} m apart at the start: place it there, or write `assemble = true`")]
    JointOpen {
        /// Name of the joint.
        joint: String,
        /// m; of a weld an angle, rad, may be in it.
        gap: f64,
    },
    /// A joint whose points move apart at the start.
    #[error(
        "what `{joint}` joins moves apart at {rate} m/s at the start: give it fitting velocities, or write `assemble = true`"
    )]
    JointMoves {
        /// Name of the joint.
        joint: String,
        /// m/s; of a weld an angular rate, rad/s, may be in it.
        rate: f64,
    },
    /// Joints that no pose of their bodies closes.
    #[error("no pose of the bodies was found in which {} hold: what is left is {gap} m", listed(joints))]
    JointsDoNotClose {
        /// Their names.
        joints: Vec<String>,
        /// What is left, m.
        gap: f64,
    },
    /// A start in which joints can be kept in more than one way.
    #[error(
        "the bodies start in a singular configuration. {branches}. Turn one of them a little, so that the start says how they go on"
    )]
    StartsSingular {
        /// Which joints those are, quoted, and how the bodies may go on, in a sentence.
        branches: String,
    },
    /// A path that a pivot is moved on with a corner or a jump.
    #[error(
        "the path of {what} has a branch (abs, sign, step, min, max, if or a table): a corner in it would be an \
         impact on the body, which no force stands for; write a smooth path"
    )]
    CorneredPath {
        /// The pivot or the surface.
        what: String,
    },
    /// A restitution that no impact has.
    #[error("{what} is {}: it must lie between 0 and 1", number(*value))]
    Restitution {
        /// Whose it is.
        what: String,
        /// Its value.
        value: f64,
    },
    /// Static friction that is less than kinetic.
    #[error(
        "{what} is less than the kinetic one, by {below}: what slips would be held better than what is at rest"
    )]
    StaticBelowKinetic {
        /// Whose it is.
        what: String,
        /// By how much.
        below: f64,
    },
    /// A body that starts inside a surface.
    #[error("`{body}` starts {depth} m inside `{surface}`, by its point `{feature}`")]
    Inside {
        /// Name of the body.
        body: String,
        /// The point of it that is deepest in that surface.
        feature: String,
        /// Name of the surface.
        surface: String,
        /// How deep it is, m.
        depth: f64,
    },
    /// Two bodies that meet each other and start inside each other.
    #[error("`{first}` and `{second}` start {depth} m inside each other, and `{contact}` lets them meet")]
    InEachOther {
        /// One of them.
        first: String,
        /// The other.
        second: String,
        /// Name of the contact.
        contact: String,
        /// How deep they are in each other, m.
        depth: f64,
    },
    /// A contact of bodies that cannot be.
    #[error("`{contact}` {problem}")]
    Contact {
        /// Its name.
        contact: String,
        /// What is wrong.
        problem: String,
        /// A way out.
        cure: &'static str,
    },
    /// A body without start, or a start that does not fit the body.
    #[error("start of `{body}`: {problem}")]
    Start {
        /// Name of the body.
        body: String,
        /// What is wrong.
        problem: String,
    },
    /// A bowl that is not larger than what is in it.
    #[error("{what} is less than that of what moves in it, or no more: {} m are lacking", number(*less))]
    NoRoom {
        /// What it is.
        what: String,
        /// By how much, m.
        less: f64,
    },
    /// A polygon that others meet by its edges and that is not convex, or crosses itself.
    #[error("the {what} is not convex, and others meet it by its edges")]
    NotConvex {
        /// Whose it is.
        what: String,
    },
    /// The same with nothing inside, or with a side of no length.
    #[error("corners of the {what} coincide, or all lie in one line, and others meet it by its edges")]
    Flat {
        /// Whose it is.
        what: String,
    },
    /// The same with its corners clockwise.
    #[error("the corners of the {what} go round clockwise, and others meet it by its edges")]
    Clockwise {
        /// Whose it is.
        what: String,
    },
    /// Nothing to move.
    #[error("there is no body")]
    Empty,
}

/// Numbers of this size are written without an exponent.
const PLAIN: std::ops::Range<f64> = 1e-5..1e16;

/// A number for a message, in which many zeros tell nobody anything.
fn number(value: f64) -> String {
    if value == 0.0 || PLAIN.contains(&value.abs()) || !value.is_finite() {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

fn quantity(value: f64, unit: &str) -> String {
    format!("{} {unit}", number(value)).trim_end().to_owned()
}

/// All mistakes of a model.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
pub struct ModelErrors(pub Vec<ModelError>);

impl From<ModelError> for ModelErrors {
    fn from(error: ModelError) -> Self {
        Self(vec![error])
    }
}

impl ModelError {
    /// What messages call the place that it is about, where it is about one: "mass of `rod`".
    pub fn what(&self) -> Option<&str> {
        match self {
            Self::Type { what, .. }
            | Self::Compile { what, .. }
            | Self::NotPositive { what, .. }
            | Self::Negative { what, .. }
            | Self::NotFinite { what, .. }
            | Self::TooSmall { what, .. }
            | Self::Angle { what, .. }
            | Self::NoDirection { what }
            | Self::NoInertia { what }
            | Self::NoRoom { what, .. }
            | Self::NotConvex { what }
            | Self::Flat { what }
            | Self::Clockwise { what }
            | Self::CorneredPath { what }
            | Self::StaticBelowKinetic { what, .. }
            | Self::Restitution { what, .. } => Some(what),
            _ => None,
        }
    }

    /// The name in it: of a body, a load or a surface.
    pub(crate) fn owner(&self) -> Option<&str> {
        self.what()?.split('`').nth(1)
    }
}

impl ModelErrors {
    /// The first mistake, for whoever asked for one value.
    pub(crate) fn into_first(self) -> ModelError {
        self.0.into_iter().next().unwrap_or(ModelError::Empty)
    }
}

fn listed(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}
