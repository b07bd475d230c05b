//! A model: bodies, what holds them and what acts on them.

use std::sync::Arc;

use tumble_expr::{Expr, Vector};

use crate::air::Wind;
use crate::body::Body;
use crate::contact::{BodyContact, Pair, Pairs};
use crate::coordinates::Pivot;
use crate::event::Event;
use crate::impulse::AppliedImpulse;
use crate::interaction::Interaction;
use crate::joint::Joint;
use crate::kinematics::PointRef;
use crate::laws::impact::{MultipleImpacts, Painleve};
use crate::load::Load;
use crate::parameters::Parameters;
use crate::place::Place;
use crate::start::Start;
use crate::surface::Surface;

/// Gauss nodes to begin with; [`crate::Run::refined`] doubles them until they do not matter.
pub(crate) const DEFAULT_NODES: usize = 8;

/// Gravity, and how the plane of motion lies in it.
#[derive(Clone, Debug)]
pub enum Gravity {
    /// None.
    None,
    /// The plane is vertical: the weight is along -y. m/s^2, positive downwards.
    Vertical(Expr),
    /// The plane is horizontal and seen from above: weight and support cancel out of the plane. m/s^2.
    Horizontal(Expr),
}

impl Gravity {
    /// Within the plane of motion, m/s^2, world axes; `None` where it has no part in the motion.
    pub(crate) fn in_plane(&self) -> Option<Vector> {
        match self {
            Self::Vertical(g) => Some(Vector::planar(Expr::zero(), -g)),
            Self::None | Self::Horizontal(_) => None,
        }
    }
}

/// Bodies, what holds them, what acts on them and what they start from.
#[derive(Clone, Debug)]
pub struct Model {
    /// Parameters of all formulas.
    pub parameters: Parameters,
    /// Gravity on every body.
    pub gravity: Gravity,
    /// The bodies, in the order of their states.
    pub bodies: Vec<Body>,
    /// At most one a body.
    pub pivots: Vec<Pivot>,
    /// What keeps points of bodies together.
    pub joints: Vec<Joint>,
    /// Forces and torques.
    pub loads: Vec<Load>,
    /// What events apply at once.
    pub impulses: Vec<AppliedImpulse>,
    /// Air resistance, springs and other laws known by their coefficients.
    pub interactions: Vec<Arc<dyn Interaction>>,
    /// What bodies meet.
    pub surfaces: Vec<Surface>,
    /// Which bodies meet each other.
    pub contacts: Vec<BodyContact>,
    /// How impacts at several contacts at one instant are taken.
    pub multiple_impacts: MultipleImpacts,
    /// What becomes of contacts that friction leaves no forces.
    pub painleve: Painleve,
    /// The air.
    pub wind: Wind,
    /// Gauss nodes on each line whose air resistance has no closed form.
    pub nodes: usize,
    /// What is watched for.
    pub events: Vec<Event>,
    /// Whether the motion ends where all bodies have come to rest for good.
    pub stops_at_rest: bool,
    /// Initial values by body; a body without an entry starts at rest at angle zero, its drawing where it is drawn.
    pub starts: Vec<(String, Start)>,
}

impl Default for Model {
    fn default() -> Self {
        Self::new()
    }
}

impl Model {
    /// An empty world without gravity.
    pub fn new() -> Self {
        Self {
            parameters: Parameters::default(),
            gravity: Gravity::None,
            bodies: vec![],
            pivots: vec![],
            joints: vec![],
            loads: vec![],
            impulses: vec![],
            interactions: vec![],
            surfaces: vec![],
            contacts: vec![],
            multiple_impacts: MultipleImpacts::default(),
            painleve: Painleve::default(),
            wind: Wind::still(),
            nodes: DEFAULT_NODES,
            events: vec![],
            stops_at_rest: false,
            starts: vec![],
        }
    }

    /// Adds a body, and hands it back for naming its points in formulas.
    pub fn add(&mut self, body: Body) -> Body {
        self.bodies.push(body.clone());
        body
    }

    /// Holds the point of a body that its drawing has at `point`, m, at that place of the world.
    pub fn pivot(&mut self, body: &Body, point: [Expr; 2]) {
        self.pivot_at(format!("{}.pivot", body.name), body, point.clone(), point);
    }

    /// Holds a point of a body, m in body coordinates, at a place of the world, m.
    pub fn pivot_at(&mut self, name: impl Into<String>, body: &Body, point: [Expr; 2], world: [Expr; 2]) {
        let [point, world] = [point, world].map(|[x, y]| Vector::planar(x, y));
        self.pivots.push(Pivot { name: name.into(), body: body.name.clone(), point, world });
    }

    /// Keeps points of bodies, or a point and a place, together.
    pub fn join(&mut self, joint: Joint) {
        self.joints.push(joint);
    }

    /// A force on a material point of a body, N, in world axes.
    pub fn force(&mut self, name: impl Into<String>, at: &PointRef, force: Vector) {
        let body = at.body.body.clone();
        self.loads.push(Load::force(name, body, Place::Material(at.clone()), force));
    }

    /// A torque on a body, N m.
    pub fn torque(&mut self, name: impl Into<String>, body: &Body, torque: Expr) {
        self.loads.push(Load::torque(name, &body.name, torque));
    }

    /// Air resistance, a spring, or another law known by its coefficients.
    pub fn interact(&mut self, interaction: impl Interaction + 'static) {
        self.interactions.push(Arc::new(interaction));
    }

    /// A surface that bodies meet.
    pub fn surface(&mut self, surface: Surface) {
        self.surfaces.push(surface);
    }

    /// Bodies that meet each other.
    pub fn contact(&mut self, contact: BodyContact) {
        self.contacts.push(contact);
    }

    /// Everything that may touch: each point of a body and each surface that it meets, then points of bodies that meet.
    pub fn pairs(&self) -> Vec<Pair> {
        Pairs::of(self).all
    }

    /// Whether a body, by its index, may be met by its edges: by other bodies, circles from outside and polygons.
    pub(crate) fn meets_by_edges(&self, body: usize) -> bool {
        let own = &self.bodies[body];
        let is_outline = |surface: &&Surface| {
            surface.polygon.is_some() || surface.circle.as_ref().is_some_and(|circle| !circle.inside)
        };
        let surfaces = self.surfaces.iter().filter(is_outline).any(|surface| surface.meets_all_of(own));
        surfaces
            || self
                .contacts
                .iter()
                .any(|contact| contact.couples(self).iter().any(|couple| couple.contains(&body)))
    }

    /// Whether any term is a sum over Gauss nodes.
    pub fn has_quadrature(&self) -> bool {
        self.interactions.iter().any(|interaction| interaction.is_quadrature(&self.wind))
    }

    /// Index of a body.
    pub fn body_index(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    /// The pivot of a body.
    pub fn pivot_of(&self, body: &str) -> Option<&Pivot> {
        self.pivots.iter().find(|pivot| pivot.body == body)
    }

    /// What a body starts from.
    pub fn start_of(&self, body: &str) -> Start {
        self.starts.iter().find(|(name, _)| name == body).map(|(_, start)| start.clone()).unwrap_or_default()
    }
}
