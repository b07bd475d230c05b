//! Bodies that meet each other: which do, and what happens where they touch.

use std::collections::HashSet;

use tumble_expr::{Binary, Expr, Vector};

use crate::body::Body;
use crate::contact::feature::Feature;
use crate::contact::opposite::Opposite;
use crate::contact::pair::{Pair, Rule};
use crate::friction::Friction;
use crate::kinematics::PointRef;
use crate::model::Model;
use crate::shape::Shape;
use crate::surface::ContactLaw;

/// Rigid contacts of bodies with each other, by their round rims and points.
#[derive(Clone, Debug)]
pub struct BodyContact {
    /// Its name.
    pub name: String,
    /// Names of the bodies of which every two meet; `None` is all bodies, but for those that a joint connects.
    pub between: Option<Vec<String>>,
    /// Impulse while separating over impulse while approaching, 0 to 1; where it is not given, the lesser of the bodies' own.
    pub restitution: Option<Expr>,
    /// Dry friction between them; none where nothing is said.
    pub friction: Option<Friction>,
}

impl BodyContact {
    /// Without friction.
    pub fn new(name: impl Into<String>, between: [&str; 2], restitution: impl Into<Expr>) -> Self {
        let between = between.map(str::to_owned).to_vec();
        Self { between: Some(between), ..Self::of_all(name, restitution) }
    }

    /// Of all bodies of a model, but for those that a joint connects, without friction.
    pub fn of_all(name: impl Into<String>, restitution: impl Into<Expr>) -> Self {
        Self { name: name.into(), between: None, restitution: Some(restitution.into()), friction: None }
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

    /// What happens where two bodies touch; `None` where nobody says how they rebound.
    pub fn law(&self, [one, other]: [&Body; 2]) -> Option<ContactLaw> {
        let own = match (&one.restitution, &other.restitution) {
            (Some(a), Some(b)) => Some(Expr::binary(Binary::Min, a.clone(), b.clone())),
            (a, b) => a.clone().or(b.clone()),
        };
        Some(ContactLaw::Rigid { restitution: self.restitution.clone().or(own)? })
    }

    /// Its pairs; `features` are those of all bodies, with where they are.
    pub(crate) fn pairs(
        &self,
        index: usize,
        model: &Model,
        features: &[Vec<(Feature, PointRef)>],
    ) -> Vec<Pair> {
        let mut pairs = vec![];
        for [one, other] in self.couples(model) {
            let bodies = [one, other].map(|body| &model.bodies[body]);
            // The model was checked: somebody says how they rebound.
            let Some(law) = self.law(bodies) else { continue };
            let name = format!("{}.{}.{}", self.name, bodies[0].name, bodies[1].name);
            let is_one = features[one].len() == 1 && features[other].len() == 1;
            for first in &features[one] {
                for second in &features[other] {
                    let places = format!("{name}.{}.{}", first.0.name, second.0.name);
                    let opposite = Opposite::circle(
                        Some(second.1.clone()),
                        second.0.radius.clone(),
                        false,
                        &first.0.radius,
                    );
                    let through = second.1.position();
                    let nowhere = || Vector::planar(Expr::zero(), Expr::zero());
                    pairs.push(Pair {
                        name: if is_one { name.clone() } else { places },
                        rule: Rule::Bodies(index),
                        body: one,
                        other: Some(other),
                        centre: first.1.clone(),
                        radius: first.0.radius.clone(),
                        normal: opposite.normal(&first.1, &through).unwrap_or_else(nowhere),
                        through,
                        law: law.clone(),
                        friction: self.friction.clone(),
                        opposite,
                    });
                }
            }
        }
        pairs
    }
}

impl Body {
    /// Whether it has rims and points only, by which it can meet other bodies and circles from outside.
    pub fn is_round(&self) -> bool {
        let is_round = |shape: &Shape| match shape {
            Shape::Rod { .. } | Shape::Box { .. } | Shape::Polygon { .. } => false,
            Shape::Point { .. } | Shape::Disk { .. } | Shape::Ring { .. } => true,
            Shape::Ball { .. } | Shape::Shell { .. } => true,
        };
        !self.parts.is_empty() && self.parts.iter().all(|part| is_round(&part.shape))
    }
}

/// Bodies that a joint connects, the first by index first.
fn joined(model: &Model) -> HashSet<[usize; 2]> {
    let ends = model.joints.iter().filter_map(|joint| {
        let mut bodies = joint.bodies().filter_map(|name| model.body_index(name));
        Some([bodies.next()?, bodies.next()?])
    });
    ends.map(|[a, b]| [a.min(b), a.max(b)]).collect()
}
