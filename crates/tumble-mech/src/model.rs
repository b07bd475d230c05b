//! A model: bodies, what holds them and what acts on them.

use std::sync::Arc;

use tumble_expr::{Dimension, Expr, Vector};

use crate::air::Wind;
use crate::body::Body;
use crate::contact::{Pair, Pairs};
use crate::coordinates::Pivot;
use crate::error::{ModelError, ModelErrors};
use crate::event::{Action, Event};
use crate::interaction::Interaction;
use crate::kinematics::PointRef;
use crate::laws::impact::MultipleImpacts;
use crate::load::{Application, Load, Moment};
use crate::parameters::Parameters;
use crate::place::Place;
use crate::start::Start;
use crate::surface::{Surface, is_at};

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
    /// Forces and torques.
    pub loads: Vec<Load>,
    /// Air resistance, springs and other laws known by their coefficients.
    pub interactions: Vec<Arc<dyn Interaction>>,
    /// What bodies meet.
    pub surfaces: Vec<Surface>,
    /// How impacts of one body at several contacts at one instant are taken.
    pub multiple_impacts: MultipleImpacts,
    /// The air.
    pub wind: Wind,
    /// Gauss nodes on each line whose air resistance has no closed form.
    pub nodes: usize,
    /// What is watched for.
    pub events: Vec<Event>,
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
            loads: vec![],
            interactions: vec![],
            surfaces: vec![],
            multiple_impacts: MultipleImpacts::default(),
            wind: Wind::still(),
            nodes: DEFAULT_NODES,
            events: vec![],
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

    /// Everything that may touch: each point of a body and each surface that it meets.
    pub fn pairs(&self) -> Vec<Pair> {
        Pairs::of(self).all
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

    /// All mistakes that show before any number is known: names and dimensions.
    pub fn check(&self) -> Result<(), ModelErrors> {
        let mut mistakes: Vec<ModelError> = self.bodies.iter().flat_map(Body::mistakes).collect();
        if self.bodies.is_empty() {
            mistakes.push(ModelError::Empty);
        }
        mistakes.extend(self.name_mistakes());
        mistakes.extend(self.gravity_mistake());
        mistakes.extend(self.pivots.iter().flat_map(|pivot| self.pivot_mistakes(pivot)));
        mistakes.extend(self.loads.iter().flat_map(|load| self.load_mistakes(load)));
        mistakes.extend(self.events.iter().flat_map(|event| self.event_mistakes(event)));
        mistakes.extend(mistake("wind", self.wind.0.components(), Dimension::SPEED));
        mistakes.extend(
            self.interactions.iter().flat_map(|interaction| self.interaction_mistakes(&**interaction)),
        );
        mistakes.extend(self.surfaces.iter().flat_map(|surface| self.surface_mistakes(surface)));
        mistakes.extend(self.starts.iter().flat_map(|(body, start)| self.start_mistakes(body, start)));
        if mistakes.is_empty() { Ok(()) } else { Err(ModelErrors(mistakes)) }
    }

    fn name_mistakes(&self) -> Vec<ModelError> {
        let parameters = self.parameters.symbols();
        let bodies = self.bodies.iter().map(|body| body.name.as_str());
        let loads = self.loads.iter().map(|load| load.name.as_str());
        let pivots = self.pivots.iter().map(|pivot| pivot.name.as_str());
        let mut names: Vec<&str> = parameters.iter().map(|symbol| &*symbol.name).collect();
        names.extend(bodies.chain(loads).chain(pivots));
        names.extend(self.events.iter().map(|event| event.name.as_str()));
        names.extend(self.interactions.iter().map(|interaction| interaction.name()));
        names.extend(self.surfaces.iter().map(|surface| surface.name.as_str()));
        names.sort_unstable();
        let twice = names.windows(2).filter(|pair| pair[0] == pair[1]);
        twice.map(|pair| ModelError::Duplicate { name: pair[0].to_owned() }).collect()
    }

    fn gravity_mistake(&self) -> Option<ModelError> {
        match &self.gravity {
            Gravity::None => None,
            Gravity::Vertical(g) | Gravity::Horizontal(g) => {
                mistake("gravity", [g], Dimension::ACCELERATION).pop()
            }
        }
    }

    fn pivot_mistakes(&self, pivot: &Pivot) -> Vec<ModelError> {
        let what = format!("pivot `{}`", pivot.name);
        let places = pivot.point.components().iter().chain(pivot.world.components());
        let mut mistakes = mistake(&what, places, Dimension::LENGTH);
        mistakes.extend(self.unknown_body(&pivot.body));
        if pivot.world.components().iter().any(|path| path.branches_on(&[crate::parameters::time_symbol()])) {
            mistakes.push(ModelError::CorneredPath { what: format!("pivot `{}`", pivot.name) });
        }
        if let Some(first) = self.pivot_of(&pivot.body)
            && !std::ptr::eq(first, pivot)
        {
            mistakes.push(ModelError::HeldTwice {
                body: pivot.body.clone(),
                first: first.name.clone(),
                second: pivot.name.clone(),
            });
        }
        mistakes
    }

    fn load_mistakes(&self, load: &Load) -> Vec<ModelError> {
        let what = format!("`{}`", load.name);
        let mut mistakes: Vec<ModelError> = self.unknown_body(&load.body).into_iter().collect();
        match &load.application {
            Application::Torque(torque) => mistakes.extend(mistake(&what, [torque], Dimension::TORQUE)),
            Application::Force { at, force, .. } => {
                mistakes.extend(mistake(&what, force.components(), Dimension::FORCE));
                let place = match at {
                    Place::Material(point) => &point.arm,
                    Place::World(place) | Place::FromCentre(place) => place,
                };
                mistakes.extend(mistake(&format!("place of {what}"), place.components(), Dimension::LENGTH));
            }
        }
        for moment in load.during.iter().flatten() {
            match moment {
                Moment::Time(time) => {
                    mistakes.extend(mistake(&format!("times of {what}"), [time], Dimension::TIME))
                }
                Moment::Event(name) if self.events.iter().any(|event| event.name == *name) => {}
                Moment::Event(name) => {
                    mistakes.push(ModelError::Unknown { kind: "event", name: name.clone() });
                }
            }
        }
        mistakes
    }

    fn event_mistakes(&self, event: &Event) -> Vec<ModelError> {
        let what = format!("event `{}`", event.name);
        let mut mistakes: Vec<ModelError> = match event.when.dimension() {
            Ok(_) => vec![],
            Err(mistake) => vec![ModelError::Type { what: what.clone(), mistake }],
        };
        let Action::Set(settings) = &event.action else { return mistakes };
        let symbols = self.parameters.symbols();
        for (name, formula) in settings {
            match symbols.iter().find(|symbol| *symbol.name == **name) {
                Some(symbol) => mistakes.extend(mistake(&what, [formula], symbol.dimension)),
                None => mistakes.push(ModelError::Unknown { kind: "parameter", name: name.clone() }),
            }
        }
        mistakes
    }

    fn interaction_mistakes(&self, interaction: &dyn Interaction) -> Vec<ModelError> {
        let formulas = interaction.dimensions().into_iter();
        let wrong = formulas.flat_map(|(key, formula, dimension)| {
            mistake(&format!("{key} of `{}`", interaction.name()), [&formula], dimension)
        });
        wrong.chain(interaction.bodies().into_iter().filter_map(|body| self.unknown_body(body))).collect()
    }

    fn surface_mistakes(&self, surface: &Surface) -> Vec<ModelError> {
        let what = format!("surface `{}`", surface.name);
        let mut mistakes = mistake(&what, surface.through.components(), Dimension::LENGTH);
        mistakes.extend(mistake(&what, surface.normal.components(), Dimension::NONE));
        for (key, formula, dimension) in surface.law.dimensions() {
            mistakes.extend(mistake(&format!("{key} of `{}`", surface.name), [formula], dimension));
        }
        let path = surface.through.components().iter().chain(surface.normal.components());
        if path.into_iter().any(|path| path.branches_on(&[crate::parameters::time_symbol()])) {
            mistakes.push(ModelError::CorneredPath { what });
        }
        let met = surface.on.iter().flatten();
        mistakes.extend(met.filter(|name| !self.can_touch(name)).filter_map(|name| self.unknown_body(name)));
        mistakes
    }

    /// Whether this is the name of a body's point by which it touches.
    fn can_touch(&self, name: &str) -> bool {
        let by = |body: &Body| body.features().iter().any(|feature| is_at(name, body, feature));
        self.bodies.iter().any(by)
    }

    fn start_mistakes(&self, body: &str, start: &Start) -> Vec<ModelError> {
        let what = format!("start of `{body}`");
        let at = start.at.iter().flat_map(Vector::components);
        let velocity = start.velocity.iter().flat_map(Vector::components);
        let mut mistakes = mistake(&what, at, Dimension::LENGTH);
        mistakes.extend(mistake(&what, velocity, Dimension::SPEED));
        mistakes.extend(mistake(&what, start.angle.iter(), Dimension::NONE));
        mistakes.extend(mistake(&what, start.omega.iter(), Dimension::ANGULAR_RATE));
        mistakes.extend(self.unknown_body(body));
        if self.pivot_of(body).is_some() && (start.at.is_some() || start.velocity.is_some()) {
            let problem = "its pivot says where it is: give the angle and omega only".into();
            mistakes.push(ModelError::Start { body: body.to_owned(), problem });
        }
        mistakes
    }

    fn unknown_body(&self, name: &str) -> Option<ModelError> {
        let unknown = || ModelError::Unknown { kind: "body", name: name.to_owned() };
        self.body_index(name).is_none().then(unknown)
    }
}

fn mistake<'a>(
    what: &str,
    formulas: impl IntoIterator<Item = &'a Expr>,
    expected: Dimension,
) -> Vec<ModelError> {
    let wrong = formulas.into_iter().filter_map(|formula| formula.expect(expected).err());
    wrong.map(|mistake| ModelError::Type { what: what.to_owned(), mistake }).collect()
}
