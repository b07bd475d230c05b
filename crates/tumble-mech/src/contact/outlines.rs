//! Outlines of bodies and surfaces as convex figures, and how deep those that meet are in each other.

use std::collections::HashMap;

use tumble_expr::{Expr, Vector};

use crate::body::Body;
use crate::contact::depth::{Hull, depth};
use crate::contact::pair::Rule;
use crate::kinematics::PointRef;
use crate::model::Model;
use crate::surface::Surface;

/// Two that meet: what says so, the body, and the other, if it is none of the world.
pub(crate) type Couple = (Rule, usize, Option<usize>);

/// Whose outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Whose {
    Body(usize),
    Surface(usize),
}

/// The second of those that meet.
fn second(rule: Rule, other: Option<usize>) -> Whose {
    match (rule, other) {
        (_, Some(other)) => Whose::Body(other),
        (Rule::Surface(surface), None) => Whose::Surface(surface),
        (Rule::Bodies(contact), None) => unreachable!("contact {contact} is of two bodies"),
    }
}

/// Formulas of the convex figures of which bodies and surfaces are made.
#[derive(Default)]
pub(crate) struct Outlines {
    pub(crate) formulas: Vec<Expr>,
    /// By owner, of each figure where its formulas begin, the radius last, and how many places it has.
    of: HashMap<Whose, Vec<(usize, usize)>>,
}

impl Outlines {
    /// Those of all that meet.
    pub(crate) fn of(met: &[Couple], model: &Model) -> Self {
        let mut outlines = Self::default();
        for (rule, body, other) in met {
            outlines.add(Whose::Body(*body), model);
            outlines.add(second(*rule, *other), model);
        }
        outlines
    }

    /// How deep two are in each other, m, by values of the formulas; negative where they are apart.
    pub(crate) fn depth(&self, (rule, body, other): &Couple, values: &[f64]) -> f64 {
        let [own, others] =
            [Whose::Body(*body), second(*rule, *other)].map(|whose| self.hulls(whose, values));
        let depths = own.iter().flat_map(|one| others.iter().map(move |other| depth(one, other)));
        depths.fold(f64::NEG_INFINITY, f64::max)
    }

    fn add(&mut self, whose: Whose, model: &Model) {
        if self.of.contains_key(&whose) {
            return;
        }
        let figures = match whose {
            Whose::Body(body) => of_body(&model.bodies[body]),
            Whose::Surface(surface) => of_surface(&model.surfaces[surface]),
        };
        let place = |(places, radius): (Vec<Vector>, Expr)| {
            let figure = (self.formulas.len(), places.len());
            self.formulas.extend(places.iter().flat_map(|place| place.components().to_vec()).chain([radius]));
            figure
        };
        let figures = figures.into_iter().map(place).collect();
        self.of.insert(whose, figures);
    }

    fn hulls(&self, whose: Whose, values: &[f64]) -> Vec<Hull> {
        let hull = |(first, count): &(usize, usize)| {
            let places = values[*first..first + 2 * count].chunks_exact(2).map(|place| [place[0], place[1]]);
            Hull { places: places.collect(), radius: values[first + 2 * count] }
        };
        self.of[&whose].iter().map(hull).collect()
    }
}

fn of_body(body: &Body) -> Vec<(Vec<Vector>, Expr)> {
    let part = |part: &crate::body::Part| {
        let (places, radius) = part.shape.hull();
        (body.points_at(&places).iter().map(PointRef::position).collect(), radius)
    };
    body.parts.iter().map(part).collect()
}

fn of_surface(surface: &Surface) -> Vec<(Vec<Vector>, Expr)> {
    match (&surface.polygon, &surface.circle) {
        (Some(corners), _) => vec![(corners.clone(), Expr::zero())],
        (None, Some(circle)) => vec![(vec![surface.through.clone()], circle.radius.clone())],
        (None, None) => vec![],
    }
}
