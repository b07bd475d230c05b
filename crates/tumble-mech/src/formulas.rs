//! Every formula that a model states, with what messages call it and what it must measure.

use tumble_expr::{Dimension, Expr, Vector};

use crate::anchor::Anchor;
use crate::body::Body;
use crate::contact::BodyContact;
use crate::coordinates::Pivot;
use crate::error::ModelError;
use crate::event::Event;
use crate::friction::Friction;
use crate::impulse::AppliedImpulse;
use crate::interaction::Interaction;
use crate::joint::Joint;
use crate::load::{Application, Load, Moment};
use crate::model::{Gravity, Model};
use crate::place::Place;
use crate::start::Start;
use crate::surface::{ContactLaw, Surface};

/// A formula of a model.
pub(crate) struct Stated {
    /// What messages call its place, such as "mass of `rod`".
    pub(crate) what: String,
    pub(crate) formula: Expr,
    /// `None` where it may be any.
    dimension: Option<Dimension>,
}

impl Stated {
    /// That its dimension does not fit its place.
    pub(crate) fn mistake(&self) -> Option<ModelError> {
        let fits = match self.dimension {
            Some(dimension) => self.formula.expect(dimension).map(|_| ()),
            None => self.formula.dimension().map(|_| ()),
        };
        fits.err().map(|mistake| ModelError::Type { what: self.what.clone(), mistake })
    }
}

impl Model {
    /// Every formula but those of the parameters.
    pub(crate) fn stated(&self) -> Vec<Stated> {
        let mut list = List::default();
        self.bodies.iter().for_each(|body| list.body(body));
        if let Gravity::Vertical(g) | Gravity::Horizontal(g) = &self.gravity {
            list.add("gravity", [g], Dimension::ACCELERATION);
        }
        self.pivots.iter().for_each(|pivot| list.pivot(pivot));
        self.joints.iter().for_each(|joint| list.joint(joint));
        self.loads.iter().for_each(|load| list.load(load));
        self.impulses.iter().for_each(|impulse| list.impulse(impulse));
        self.events.iter().for_each(|event| list.event(event, self));
        list.add("wind", self.wind.0.components(), Dimension::SPEED);
        self.interactions.iter().for_each(|interaction| list.interaction(&**interaction));
        self.surfaces.iter().for_each(|surface| list.surface(surface));
        self.contacts.iter().for_each(|contact| list.contact(contact));
        self.starts.iter().for_each(|(body, start)| list.start(body, start));
        list.all
    }
}

#[derive(Default)]
struct List {
    all: Vec<Stated>,
}

impl List {
    fn add<'a>(&mut self, what: &str, formulas: impl IntoIterator<Item = &'a Expr>, dimension: Dimension) {
        self.all.extend(formulas.into_iter().map(|formula| Stated {
            what: what.to_owned(),
            formula: formula.clone(),
            dimension: Some(dimension),
        }));
    }

    fn body(&mut self, body: &Body) {
        let name = &body.name;
        for (index, part) in body.parts.iter().enumerate() {
            let of = body.part_name(index);
            for place in part.shape.places() {
                self.add(&format!("shape of {of}"), place.components(), Dimension::LENGTH);
            }
            for (size, formula) in part.shape.sizes().into_iter().chain(part.shape.radii()) {
                self.add(&format!("{size} of {of}"), [&formula], Dimension::LENGTH);
            }
            self.add(&format!("mass of {of}"), [&part.mass], Dimension::MASS);
        }
        for (point, at) in &body.points {
            self.add(&format!("point `{name}.{point}`"), at.components(), Dimension::LENGTH);
        }
        if let Some(stated) = &body.stated {
            self.add(&format!("mass of `{name}`"), [&stated.mass], Dimension::MASS);
            self.add(&format!("moment of inertia of `{name}`"), [&stated.inertia], Dimension::INERTIA);
            let centre = stated.centre.components();
            self.add(&format!("centre of mass of `{name}`"), centre, Dimension::LENGTH);
        }
        self.add(&format!("restitution of `{name}`"), &body.restitution, Dimension::NONE);
        self.friction(name, body.friction.as_ref());
    }

    fn pivot(&mut self, pivot: &Pivot) {
        let places = pivot.point.components().iter().chain(pivot.world.components());
        self.add(&format!("pivot `{}`", pivot.name), places, Dimension::LENGTH);
    }

    fn joint(&mut self, joint: &Joint) {
        let places = joint.ends.iter().flat_map(Anchor::places);
        self.add(&format!("joint `{}`", joint.name), places, Dimension::LENGTH);
    }

    fn load(&mut self, load: &Load) {
        let what = format!("`{}`", load.name);
        self.application(
            &what,
            &load.application,
            ["force", "torque"],
            [Dimension::FORCE, Dimension::TORQUE],
        );
        let times = load.during.iter().flatten().filter_map(|moment| match moment {
            Moment::Time(time) => Some(time),
            Moment::Event(_) => None,
        });
        self.add(&format!("times of {what}"), times, Dimension::TIME);
    }

    fn impulse(&mut self, impulse: &AppliedImpulse) {
        let dimensions = [Dimension::new(1, 1, -1), Dimension::new(2, 1, -1)];
        let words = ["impulse", "angular impulse"];
        self.application(&format!("`{}`", impulse.name), &impulse.application, words, dimensions);
    }

    /// `words` and `dimensions` are those of a force and of a torque.
    fn application(
        &mut self,
        what: &str,
        application: &Application,
        words: [&str; 2],
        dimensions: [Dimension; 2],
    ) {
        match application {
            Application::Torque(torque) => {
                self.add(&format!("{} of {what}", words[1]), [torque], dimensions[1]);
            }
            Application::Force { at, force, .. } => {
                self.add(&format!("{} of {what}", words[0]), force.components(), dimensions[0]);
                let place = match at {
                    Place::Material(point) => &point.arm,
                    Place::World(place) | Place::FromCentre(place) => place,
                };
                self.add(&format!("place of {what}"), place.components(), Dimension::LENGTH);
            }
        }
    }

    fn event(&mut self, event: &Event, model: &Model) {
        let what = format!("event `{}`", event.name);
        let formula = event.when.clone();
        self.all.push(Stated { what: what.clone(), formula, dimension: None });
        for (name, formula) in event.settings() {
            if let Some(symbol) = model.parameters.symbol(name) {
                self.add(&format!("`{name}` as {what} sets it"), [formula], symbol.dimension);
            }
        }
    }

    fn interaction(&mut self, interaction: &dyn Interaction) {
        for (key, formula, dimension) in interaction.dimensions() {
            self.add(&format!("{key} of `{}`", interaction.name()), [&formula], dimension);
        }
    }

    fn surface(&mut self, surface: &Surface) {
        let name = &surface.name;
        self.add(&format!("surface `{name}`"), surface.through.components(), Dimension::LENGTH);
        self.add(&format!("normal of `{name}`"), surface.normal.components(), Dimension::NONE);
        self.law(name, &surface.law);
        let radius = surface.circle.iter().map(|circle| &circle.radius);
        self.add(&format!("radius of `{name}`"), radius, Dimension::LENGTH);
        self.friction(name, surface.friction.as_ref());
    }

    fn contact(&mut self, contact: &BodyContact) {
        let name = &contact.name;
        self.add(&format!("restitution of `{name}`"), &contact.restitution, Dimension::NONE);
        contact.compliant.iter().for_each(|law| self.law(name, law));
        self.friction(name, contact.friction.as_ref());
    }

    fn law(&mut self, name: &str, law: &ContactLaw) {
        for (key, formula, dimension) in law.dimensions() {
            self.add(&format!("{key} of `{name}`"), [formula], dimension);
        }
    }

    fn friction(&mut self, name: &str, friction: Option<&Friction>) {
        for (key, formula) in friction.into_iter().flat_map(Friction::coefficients) {
            self.add(&format!("{key} of `{name}`"), [formula], Dimension::NONE);
        }
        let rolling = friction.into_iter().flat_map(|friction| &friction.rolling);
        self.add(&format!("rolling resistance of `{name}`"), rolling, Dimension::LENGTH);
    }

    fn start(&mut self, body: &str, start: &Start) {
        let what = format!("start of `{body}`");
        self.add(&what, start.at.iter().flat_map(Vector::components), Dimension::LENGTH);
        self.add(&what, start.velocity.iter().flat_map(Vector::components), Dimension::SPEED);
        self.add(&what, &start.angle, Dimension::NONE);
        self.add(&what, &start.omega, Dimension::ANGULAR_RATE);
    }
}
