//! Bodies that meet each other: which do, and what happens where they touch.

use std::collections::HashSet;

use tumble_expr::Expr;

use crate::body::Body;
use crate::contact::between::Between;
use crate::contact::border::Border;
use crate::contact::pair::{Pair, Rule};
use crate::contact::said::{friction_of_bodies, restitution_of_bodies};
use crate::friction::Friction;
use crate::model::Model;
use crate::surface::{ContactLaw, Surface};

/// Contacts of bodies with each other, or what is said of bodies on a surface.
#[derive(Clone, Debug)]
pub struct BodyContact {
    /// Its name.
    pub name: String,
    /// Names of the bodies of which every two meet; `None` is all bodies, but for those that a joint connects. A surface among them is met
    /// by the bodies anyway, and what is said here counts for them on it.
    pub between: Option<Vec<String>>,
    /// Impulse while separating over impulse while approaching, 0 to 1; where it is not given, what those that touch say, see
    /// [`crate::Body`].
    pub restitution: Option<Expr>,
    /// What happens across where they meet if they are compliant there; rigid where nothing is said.
    pub compliant: Option<ContactLaw>,
    /// Dry friction between them; where it is not given, what those that touch say.
    pub friction: Option<Friction>,
    /// Whether bodies that meet stick together for good.
    pub captures: bool,
}

impl BodyContact {
    /// Without friction.
    pub fn new(name: impl Into<String>, between: [&str; 2], restitution: impl Into<Expr>) -> Self {
        let between = between.map(str::to_owned).to_vec();
        Self { between: Some(between), ..Self::of_all(name, restitution) }
    }

    /// Of all bodies of a model, but for those that a joint connects, without friction.
    pub fn of_all(name: impl Into<String>, restitution: impl Into<Expr>) -> Self {
        Self {
            name: name.into(),
            between: None,
            restitution: Some(restitution.into()),
            compliant: None,
            friction: None,
            captures: false,
        }
    }

    /// Of all bodies of a model, but for those that a joint connects: compliant, without friction.
    pub fn compliant(name: impl Into<String>, law: ContactLaw) -> Self {
        Self { restitution: None, compliant: Some(law), ..Self::of_all(name, 0) }
    }

    /// Of all bodies of a model: those that meet stick together for good, as by a weld that begins where they touch.
    pub fn capturing(name: impl Into<String>) -> Self {
        Self { restitution: None, captures: true, ..Self::of_all(name, 0) }
    }

    /// The same with friction.
    pub fn with_friction(self, friction: Friction) -> Self {
        Self { friction: Some(friction), ..self }
    }

    /// The bodies that meet, two by two, by index; those that are not there are left out.
    pub fn couples(&self, model: &Model) -> Vec<[usize; 2]> {
        let (bodies, joined) = match &self.between {
            Some(names) => (names.iter().filter_map(|name| model.body_index(name)).collect(), HashSet::new()),
            None => ((0..model.bodies.len()).collect::<Vec<_>>(), joined(model)),
        };
        let rest = |place: usize| bodies[place + 1..].iter().copied();
        let couples =
            bodies.iter().enumerate().flat_map(|(place, one)| rest(place).map(move |other| [*one, other]));
        couples.filter(|[a, b]| a != b && !joined.contains(&[*a.min(b), *a.max(b)])).collect()
    }

    /// Of two bodies that meet by it.
    pub(crate) fn name_of(&self, [one, other]: [&Body; 2]) -> String {
        format!("{}.{}.{}", self.name, one.name, other.name)
    }

    /// What happens where two bodies meet; `None` where nobody says it.
    pub(crate) fn law(&self, bodies: [&Body; 2]) -> Option<ContactLaw> {
        if let Some(law) = &self.compliant {
            return Some(law.clone());
        }
        let restitution =
            if self.captures { Some(Expr::zero()) } else { restitution_of_bodies(self, bodies) };
        Some(ContactLaw::Rigid { restitution: restitution? })
    }

    /// The surfaces that it speaks of.
    pub fn surfaces<'m>(&'m self, model: &'m Model) -> impl Iterator<Item = &'m Surface> {
        let names = self.between.iter().flatten();
        names.filter_map(|name| model.surfaces.iter().find(|surface| surface.name == *name))
    }

    /// Surfaces and bodies of which it says what counts for them, by index.
    pub(crate) fn on_surfaces(&self, model: &Model) -> Vec<[usize; 2]> {
        let named = |name: &String| self.between.as_ref().is_some_and(|names| names.contains(name));
        let surfaces = (0..model.surfaces.len()).filter(|surface| named(&model.surfaces[*surface].name));
        let bodies: Vec<usize> =
            (0..model.bodies.len()).filter(|body| named(&model.bodies[*body].name)).collect();
        surfaces.flat_map(|surface| bodies.iter().map(move |body| [surface, *body])).collect()
    }

    /// Whether it speaks of a body on a surface.
    pub(crate) fn is_of(&self, surface: &Surface, body: &Body) -> bool {
        self.between.as_ref().is_some_and(|names| names.contains(&surface.name) && names.contains(&body.name))
    }

    /// Its pairs; `borders` are those of all bodies.
    pub(crate) fn pairs(&self, index: usize, model: &Model, borders: &[Border]) -> Vec<Pair> {
        let pairs = self.couples(model).into_iter().filter_map(|[one, other]| {
            let bodies = [one, other].map(|body| &model.bodies[body]);
            let between = Between {
                name: self.name_of(bodies),
                rule: Rule::Bodies(index),
                body: one,
                other: Some(other),
                // The model was checked: somebody says how they rebound.
                law: self.law(bodies)?,
                friction: friction_of_bodies(self, bodies),
            };
            Some(between.pairs(&borders[one], &borders[other]))
        });
        pairs.flatten().collect()
    }
}

/// Bodies that a joint connects, the first by index first.
fn joined(model: &Model) -> HashSet<[usize; 2]> {
    let joints = model.joints.iter().filter(|joint| joint.captured_by.is_none());
    let ends = joints.filter_map(|joint| {
        let mut bodies = joint.bodies().filter_map(|name| model.body_index(name));
        Some([bodies.next()?, bodies.next()?])
    });
    ends.map(|[a, b]| [a.min(b), a.max(b)]).collect()
}
