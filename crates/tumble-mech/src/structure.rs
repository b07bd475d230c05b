//! Mistakes of a model that show before any number is known: in names, dimensions and what is held by what.

use std::collections::{HashMap, HashSet};

use tumble_expr::{Vector, is_identically_zero};

use crate::body::Body;
use crate::contact::{BodyContact, Feature, friction_of_bodies, moves, of_surface_and_body};
use crate::coordinates::Pivot;
use crate::error::{ModelError, ModelErrors};
use crate::event::Event;
use crate::formulas::Stated;
use crate::friction::Friction;
use crate::impulse::AppliedImpulse;
use crate::interaction::Interaction;
use crate::joint::Joint;
use crate::load::{Load, Moment};
use crate::model::Model;
use crate::parameters::time_symbol;
use crate::shape::Shape;
use crate::start::Start;
use crate::surface::{ContactLaw, Surface, is_at};

impl Model {
    /// All mistakes that show before any number is known: names and dimensions.
    pub fn check(&self) -> Result<(), ModelErrors> {
        let mut mistakes: Vec<ModelError> = self.stated().iter().filter_map(Stated::mistake).collect();
        mistakes.extend(Structure::of(self).mistakes());
        if mistakes.is_empty() { Ok(()) } else { Err(ModelErrors(mistakes)) }
    }
}

/// A model with its names in order, so that each is found without a search through all.
struct Structure<'m> {
    model: &'m Model,
    bodies: HashSet<&'m str>,
    events: HashSet<&'m str>,
    /// The first pivot of each body.
    pivots: HashMap<&'m str, &'m Pivot>,
}

impl<'m> Structure<'m> {
    fn of(model: &'m Model) -> Self {
        let mut pivots = HashMap::new();
        for pivot in &model.pivots {
            pivots.entry(pivot.body.as_str()).or_insert(pivot);
        }
        Self {
            model,
            bodies: model.bodies.iter().map(|body| body.name.as_str()).collect(),
            events: model.events.iter().map(|event| event.name.as_str()).collect(),
            pivots,
        }
    }

    fn mistakes(&self) -> Vec<ModelError> {
        let model = self.model;
        let mut mistakes: Vec<ModelError> = model.bodies.iter().filter_map(nothing).collect();
        mistakes.extend(model.bodies.is_empty().then_some(ModelError::Empty));
        mistakes.extend(self.same_names());
        mistakes.extend(model.pivots.iter().flat_map(|pivot| self.of_pivot(pivot)));
        mistakes.extend(model.joints.iter().flat_map(|joint| self.of_joint(joint)));
        mistakes.extend(model.loads.iter().flat_map(|load| self.of_load(load)));
        mistakes.extend(model.impulses.iter().flat_map(|impulse| self.of_impulse(impulse)));
        mistakes.extend(model.events.iter().flat_map(|event| self.of_event(event)));
        let interactions = model.interactions.iter();
        mistakes.extend(interactions.flat_map(|interaction| self.of_interaction(&**interaction)));
        mistakes.extend(model.surfaces.iter().flat_map(|surface| self.of_surface(surface)));
        mistakes.extend(model.contacts.iter().flat_map(|contact| self.of_contact(contact)));
        mistakes.extend(self.two_rules());
        mistakes.extend(model.starts.iter().flat_map(|(body, start)| self.of_start(body, start)));
        mistakes
    }

    fn same_names(&self) -> Vec<ModelError> {
        let model = self.model;
        let parameters = model.parameters.symbols();
        let mut names: Vec<&str> = parameters.iter().map(|symbol| &*symbol.name).collect();
        names.extend(model.bodies.iter().map(|body| body.name.as_str()));
        names.extend(model.loads.iter().map(|load| load.name.as_str()));
        names.extend(model.pivots.iter().map(|pivot| pivot.name.as_str()));
        names.extend(model.joints.iter().map(|joint| joint.name.as_str()));
        names.extend(model.impulses.iter().map(|impulse| impulse.name.as_str()));
        names.extend(model.events.iter().map(|event| event.name.as_str()));
        names.extend(model.interactions.iter().map(|interaction| interaction.name()));
        names.extend(model.surfaces.iter().map(|surface| surface.name.as_str()));
        names.extend(model.contacts.iter().map(|contact| contact.name.as_str()));
        names.sort_unstable();
        let twice = names.windows(2).filter(|pair| pair[0] == pair[1]);
        twice.map(|pair| ModelError::Duplicate { name: pair[0].to_owned() }).collect()
    }

    fn of_pivot(&self, pivot: &Pivot) -> Vec<ModelError> {
        let mut mistakes: Vec<ModelError> = self.unknown_body(&pivot.body).into_iter().collect();
        if pivot.world.components().iter().any(|path| path.branches_on(&[time_symbol()])) {
            mistakes.push(ModelError::CorneredPath { what: format!("pivot `{}`", pivot.name) });
        }
        let first = self.pivots.get(pivot.body.as_str());
        if let Some(first) = first.filter(|first| !std::ptr::eq(**first, pivot)) {
            mistakes.push(ModelError::HeldTwice {
                body: pivot.body.clone(),
                first: first.name.clone(),
                second: pivot.name.clone(),
            });
        }
        mistakes
    }

    fn of_joint(&self, joint: &Joint) -> Vec<ModelError> {
        let mut mistakes: Vec<ModelError> =
            joint.bodies().filter_map(|body| self.unknown_body(body)).collect();
        let bodies: Vec<&str> = joint.bodies().collect();
        let what = match bodies[..] {
            [] => Some("no body".to_owned()),
            [a, b] if a == b => Some(format!("`{a}` with itself")),
            _ => None,
        };
        mistakes.extend(what.map(|what| ModelError::JointOfOne { joint: joint.name.clone(), what }));
        let path = joint.world().into_iter().flat_map(Vector::components);
        if path.into_iter().any(|path| path.branches_on(&[time_symbol()])) {
            mistakes.push(ModelError::CorneredPath { what: format!("joint `{}`", joint.name) });
        }
        let from = joint.from.iter().filter(|_| joint.captured_by.is_none());
        let events = from.chain(&joint.until).filter(|event| !self.events.contains(event.as_str()));
        mistakes.extend(events.map(|name| ModelError::Unknown { kind: "event", name: name.clone() }));
        mistakes
    }

    fn of_load(&self, load: &Load) -> Vec<ModelError> {
        let unknown = load.during.iter().flatten().filter_map(|moment| match moment {
            Moment::Event(name) if !self.events.contains(name.as_str()) => {
                Some(ModelError::Unknown { kind: "event", name: name.clone() })
            }
            _ => None,
        });
        self.unknown_body(&load.body).into_iter().chain(unknown).collect()
    }

    fn of_impulse(&self, impulse: &AppliedImpulse) -> Vec<ModelError> {
        let is_known = self.events.contains(impulse.when.as_str());
        let unknown = (!is_known).then(|| ModelError::Unknown { kind: "event", name: impulse.when.clone() });
        self.unknown_body(&impulse.body).into_iter().chain(unknown).collect()
    }

    fn of_event(&self, event: &Event) -> Vec<ModelError> {
        let unknown =
            event.settings().iter().filter(|(name, _)| self.model.parameters.symbol(name).is_none());
        unknown.map(|(name, _)| ModelError::Unknown { kind: "parameter", name: name.clone() }).collect()
    }

    fn of_interaction(&self, interaction: &dyn Interaction) -> Vec<ModelError> {
        interaction.bodies().into_iter().filter_map(|body| self.unknown_body(body)).collect()
    }

    fn of_surface(&self, surface: &Surface) -> Vec<ModelError> {
        let path = surface.through.components().iter().chain(surface.normal.components());
        let is_cornered = path.into_iter().any(|path| path.branches_on(&[time_symbol()]));
        let what = format!("surface `{}`", surface.name);
        let cornered = is_cornered.then_some(ModelError::CorneredPath { what });
        let met = surface.on.iter().flatten().filter(|name| !self.can_touch(name));
        let met = met.filter_map(|name| self.unknown_body(name));
        let of_law = self.of_friction(surface);
        cornered.into_iter().chain(of_law).chain(met).chain(self.of_outline(surface)).collect()
    }

    /// Friction of a compliant surface, whoever says it, that has no law.
    fn of_friction(&self, surface: &Surface) -> Option<ModelError> {
        let met = self.model.bodies.iter().filter(|body| surface.meets(body));
        let said = met.filter_map(|body| of_surface_and_body(self.model, surface, body).1);
        without_law(&surface.name, &surface.law, &said.chain(surface.friction.clone()).collect::<Vec<_>>())
    }

    /// What a polygon cannot be.
    fn of_outline(&self, surface: &Surface) -> Vec<ModelError> {
        let wrong = |problem: &str, cure| of_rule(&surface.name, problem.to_owned(), cure);
        let corners = surface.polygon.iter();
        let moves =
            corners.clone().flatten().any(moves).then(|| {
                wrong("is a polygon, and polygons do not move", "leave the time out of its corners")
            });
        let few = corners
            .into_iter()
            .any(|corners| corners.len() < 3)
            .then(|| wrong("has fewer than three corners", "list three corners or more, counter-clockwise"));
        moves.into_iter().chain(few).collect()
    }

    fn of_contact(&self, contact: &BodyContact) -> Vec<ModelError> {
        let wrong = |problem: String, cure| of_rule(&contact.name, problem, cure);
        let names = contact.between.as_deref().unwrap_or_default();
        let bodies = names.iter().filter(|name| !self.is_surface(name));
        let mut mistakes: Vec<ModelError> = bodies.filter_map(|name| self.unknown_body(name)).collect();
        mistakes.extend(self.of_surfaces_in(contact));
        mistakes.extend(of_capture(contact));
        mistakes.extend(self.of_compliant(contact));
        let is_again = |(place, name): &(usize, &String)| names[..*place].contains(name);
        let twice = names.iter().enumerate().filter(is_again);
        mistakes.extend(twice.map(|(_, name)| {
            wrong(format!("is of `{name}` with itself"), "a body meets others: name each of them once")
        }));
        if contact.between.is_some() && names.len() < 2 {
            mistakes.push(wrong(
                "needs two bodies, or more".into(),
                "name two bodies, or write `between = \"all\"`",
            ));
        }
        let couples = contact.couples(self.model);
        let of = |couple: &[usize; 2]| couple.map(|body| &self.model.bodies[body]);
        let silent = couples.iter().find(|couple| contact.law(of(couple)).is_none()).map(of);
        mistakes.extend(silent.map(|[a, b]| {
            let problem =
                format!("does not say how `{}` and `{}` rebound, and neither of them does", a.name, b.name);
            wrong(problem, "write `rigid = { restitution = 0.8 }`, or give one of the bodies a `restitution`")
        }));
        let are_points = |couple: &&[usize; 2]| of(couple).iter().all(|body| is_point(body));
        let points = couples.iter().find(are_points).map(of);
        mistakes.extend(points.map(|[a, b]| {
            let problem =
                format!("is of `{}` and `{}`, two points: they have no size to meet by", a.name, b.name);
            wrong(problem, "make one of them a `disk` or a `ball`")
        }));
        let are_thin = |couple: &&[usize; 2]| {
            let [a, b] = of(couple);
            has_thin_side(a) && has_thin_end(b) || has_thin_side(b) && has_thin_end(a)
        };
        let thin = couples.iter().find(are_thin).map(of);
        mistakes.extend(thin.map(|[a, b]| {
            let problem =
                format!("is of `{}` and `{}`, a rod without thickness and an end or a point: nothing says on which side it is", a.name, b.name);
            wrong(problem, "give one of them an extent: a rod has an `end_radius`, a point may be a small `disk`")
        }));
        mistakes
    }

    /// What a compliant contact cannot have.
    fn of_compliant(&self, contact: &BodyContact) -> Vec<ModelError> {
        let Some(law) = &contact.compliant else { return vec![] };
        let wrong = |problem: String, cure| of_rule(&contact.name, problem, cure);
        let both = contact.restitution.is_some().then(|| {
            wrong(
                "has a restitution and is compliant: its damping says what comes back".into(),
                "leave one of the two out",
            )
        });
        let surface = contact.surfaces(self.model).next().map(|surface| {
            let problem = format!("is compliant, and `{}` is a surface, which has a law of its own", surface.name);
            wrong(problem, "say in the surface that it is compliant; a contact with it says friction and restitution only")
        });
        let couples = contact.couples(self.model);
        let said = couples
            .into_iter()
            .filter_map(|couple| friction_of_bodies(contact, couple.map(|body| &self.model.bodies[body])));
        let friction = without_law(&contact.name, law, &said.collect::<Vec<_>>());
        both.into_iter().chain(surface).chain(friction).collect()
    }

    /// What a contact cannot say of surfaces.
    fn of_surfaces_in(&self, contact: &BodyContact) -> Vec<ModelError> {
        let wrong = |problem: String, cure| of_rule(&contact.name, problem, cure);
        let surfaces: Vec<&Surface> = contact.surfaces(self.model).collect();
        let two = (surfaces.len() > 1).then(|| {
            let [a, b] = [0, 1].map(|which| &surfaces[which].name);
            wrong(format!("is of two surfaces, `{a}` and `{b}`"), "name one surface, and bodies that meet it")
        });
        let captures = surfaces.first().filter(|_| contact.captures).map(|surface| {
            let problem = format!("captures, and `{}` is a surface: only bodies are captured", surface.name);
            wrong(
                problem,
                "write a `[weld.NAME]` with `from`, which an event makes, of the body's point and a place",
            )
        });
        let compliant = surfaces.iter().find(|surface| !surface.law.is_rigid());
        let compliant = compliant.filter(|_| contact.restitution.is_some()).map(|surface| {
            let problem = format!(
                "has a restitution and is of `{}`, which is compliant: its damping says what comes back",
                surface.name
            );
            wrong(problem, "leave `restitution` out, or make the surface `rigid`")
        });
        let couples = contact.on_surfaces(self.model);
        let apart = couples
            .into_iter()
            .find(|[surface, body]| !self.model.surfaces[*surface].meets(&self.model.bodies[*body]));
        let apart = apart.map(|[surface, body]| {
            let [surface, body] = [&self.model.surfaces[surface].name, &self.model.bodies[body].name];
            wrong(
                format!("is of `{surface}` and `{body}`, which do not meet"),
                "add the body to `on` of the surface",
            )
        });
        two.into_iter().chain(captures).chain(compliant).chain(apart).collect()
    }

    /// Two that touch of which two contacts tell.
    fn two_rules(&self) -> Vec<ModelError> {
        let (mut rules, mut mistakes): (HashMap<[&str; 2], &str>, _) = (HashMap::new(), vec![]);
        for contact in &self.model.contacts {
            let couples = self.ruled(contact);
            let first = couples.iter().find_map(|couple| Some((couple, *rules.get(couple)?)));
            mistakes.extend(first.map(|([a, b], first)| {
                let problem =
                    format!("is a second rule for `{a}` and `{b}`, of which `{first}` is the first");
                of_rule(&contact.name, problem, "leave one of the two out, or name fewer in `between`")
            }));
            rules.extend(couples.into_iter().map(|couple| (couple, contact.name.as_str())));
        }
        mistakes
    }

    /// Names of every two that a contact speaks of, each two in one order.
    fn ruled(&self, contact: &BodyContact) -> Vec<[&'m str; 2]> {
        let model = self.model;
        let body = |body: usize| model.bodies[body].name.as_str();
        let bodies = contact.couples(model).into_iter().map(|[a, b]| [a.min(b), a.max(b)].map(body));
        let surfaces = contact.on_surfaces(model).into_iter();
        bodies
            .chain(surfaces.map(|[surface, own]| [model.surfaces[surface].name.as_str(), body(own)]))
            .collect()
    }

    fn is_surface(&self, name: &str) -> bool {
        self.model.surfaces.iter().any(|surface| surface.name == name)
    }

    /// Whether this is the name of a body, or of a body's point by which it touches.
    fn can_touch(&self, name: &str) -> bool {
        let by = |body: &Body| body.features().iter().any(|feature| is_at(name, body, &feature.name));
        self.bodies.contains(name) || self.model.bodies.iter().filter(|body| is_of(name, body)).any(by)
    }

    fn of_start(&self, body: &str, start: &Start) -> Vec<ModelError> {
        let mut mistakes: Vec<ModelError> = self.unknown_body(body).into_iter().collect();
        if self.pivots.contains_key(body) && (start.at.is_some() || start.velocity.is_some()) {
            let problem = "its pivot says where it is: give the angle and omega only".into();
            mistakes.push(ModelError::Start { body: body.to_owned(), problem });
        }
        mistakes
    }

    fn unknown_body(&self, name: &str) -> Option<ModelError> {
        let unknown = || ModelError::Unknown { kind: "body", name: name.to_owned() };
        (!self.bodies.contains(name)).then(unknown)
    }
}

/// A surface or a contact that cannot be.
fn of_rule(name: &str, problem: String, cure: &'static str) -> ModelError {
    ModelError::Contact { contact: name.to_owned(), problem, cure }
}

/// Friction of what is compliant that has no law.
fn without_law(name: &str, law: &ContactLaw, said: &[Friction]) -> Option<ModelError> {
    if law.is_rigid() {
        return None;
    }
    let wrong = |problem: &str, cure| of_rule(name, problem.to_owned(), cure);
    let rolling = said.iter().any(|friction| friction.rolling.is_some()).then(|| {
        wrong(
            "is compliant, and what rolls there would be resisted: only what is rigid resists rolling",
            "leave `rolling` out, or make it `rigid`",
        )
    });
    let pulls = (!said.is_empty() && law.may_pull()).then(|| {
        wrong(
            "has friction, and pulls before it lets go `\"at the surface\"`: there is no friction of what pulls",
            "write `release = \"at zero force\"`, or leave the friction or the damping out",
        )
    });
    rolling.or(pulls)
}

/// What a contact that captures has no use for.
fn of_capture(contact: &BodyContact) -> Option<ModelError> {
    let is_told = contact.restitution.is_some() || contact.compliant.is_some() || contact.friction.is_some();
    let problem = || "captures, and says how bodies rebound or rub: what is captured does neither".to_owned();
    (contact.captures && is_told).then(|| of_rule(&contact.name, problem(), "leave one of the two out"))
}

/// Whether a body has a side without thickness, as a rod without radius has.
fn has_thin_side(body: &Body) -> bool {
    let is_thin =
        |shape: &Shape| matches!(shape, Shape::Rod { end_radius, .. } if is_identically_zero(end_radius));
    body.parts.iter().any(|part| is_thin(&part.shape))
}

/// Whether a body has a point of no width: it says nothing of the side on which a rod without thickness is.
fn has_thin_end(body: &Body) -> bool {
    let is_thin = |feature: &Feature| is_identically_zero(&feature.radius) && feature.neighbours.len() < 2;
    body.features().iter().any(is_thin)
}

fn is_point(body: &Body) -> bool {
    let is_sharp = |feature: &Feature| is_identically_zero(&feature.radius) && feature.neighbours.is_empty();
    body.features().iter().all(is_sharp)
}

fn is_of(name: &str, body: &Body) -> bool {
    name.strip_prefix(body.name.as_str()).is_some_and(|rest| rest.starts_with('.'))
}

/// A body that is made of nothing.
fn nothing(body: &Body) -> Option<ModelError> {
    let problem = || ModelError::Start {
        body: body.name.clone(),
        problem: "has neither a shape nor a stated mass".into(),
    };
    (body.parts.is_empty() && body.stated.is_none()).then(problem)
}
