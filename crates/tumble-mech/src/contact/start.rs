//! Contacts at the start of a run: what touches then, and what would begin inside a surface.

use std::collections::HashMap;

use tumble_expr::{Expr, Vector};
use tumble_ode::{Cause, Reason};

use crate::body::Body;
use crate::contact::depth::{Hull, depth};
use crate::contact::pair::{Pair, Rule};
use crate::equations::Equations;
use crate::error::ModelError;
use crate::kinematics::PointRef;
use crate::mode::Mode;
use crate::model::Model;
use crate::surface::Surface;

/// A gap within this many ulps of the lengths it is made of is none: bodies are drawn and placed to touch.
const TOUCHES: f64 = 64.0 * f64::EPSILON;

impl Equations {
    /// Pairs that touch at time 0, as causes of a jump before the first step.
    pub(crate) fn first_contacts(
        &self,
        mode: &Mode,
        states: &[f64],
        inputs: &[f64],
        mistakes: &mut Vec<ModelError>,
    ) -> Result<Vec<Cause>, ModelError> {
        // A foot at the origin is where it is by the body's place and the way from there.
        let extent = |body: &crate::Body| body.kinematics().position().norm() + body.reach();
        let extents: Vec<Expr> = self.model().bodies.iter().map(extent).collect();
        let formulas: Vec<_> = self
            .pairs()
            .iter()
            .flat_map(|pair| {
                let size = &extents[pair.body] + pair.through.norm() + &pair.radius + pair.extent();
                [pair.gap(), size].into_iter().chain(pair.within())
            })
            .collect();
        let values = self.values(&formulas, mode, 0.0, states, inputs).map_err(|reason| match reason {
            Reason::Compile(mistake) => ModelError::Compile { what: "a surface".into(), mistake },
            other => ModelError::Start { body: "surfaces".into(), problem: other.to_string() },
        })?;
        let mut causes = vec![];
        let mut inside: Vec<ModelError> = vec![];
        let mut sizes: HashMap<(Rule, usize, Option<usize>), f64> = HashMap::new();
        let mut values = values.into_iter();
        for (index, pair) in self.pairs().iter().enumerate() {
            let mut next = || values.next().unwrap_or(f64::NAN);
            let (gap, size) = (next(), next());
            let holds = pair.limits.iter().fold(true, |holds, _| next() >= 0.0 && holds);
            if pair.has_edge() {
                let most = sizes.entry((pair.rule, pair.body, pair.other)).or_default();
                *most = most.max(size);
            }
            if !gap.is_finite() {
                let what = format!("gap of `{}`", pair.name);
                inside.push(ModelError::NotFinite { what, value: gap });
            } else if gap < -TOUCHES * size && !pair.has_edge() {
                inside.push(self.inside(pair, -gap));
            } else if gap.abs() <= TOUCHES * size && holds {
                causes.push(Cause::LazyGuard(index));
            }
        }
        inside.extend(self.overlapping(&sizes, mode, (states, inputs))?);
        mistakes.extend(deepest(inside));
        Ok(causes)
    }

    /// What starts inside each other of those that meet by edges; `sizes` are the lengths that their places are made of, m.
    fn overlapping(
        &self,
        sizes: &HashMap<(Rule, usize, Option<usize>), f64>,
        mode: &Mode,
        (states, inputs): (&[f64], &[f64]),
    ) -> Result<Vec<ModelError>, ModelError> {
        let mut met: Vec<_> = sizes.keys().copied().collect();
        met.sort_unstable();
        let mut outlines = Outlines::default();
        for (rule, body, other) in &met {
            outlines.add(Whose::Body(*body), self.model());
            outlines.add(second(*rule, *other), self.model());
        }
        let values = self.values(&outlines.formulas, mode, 0.0, states, inputs);
        let values = values
            .map_err(|reason| ModelError::Start { body: "surfaces".into(), problem: reason.to_string() })?;
        let deepest = |(rule, body, other): &(Rule, usize, Option<usize>)| {
            let own = outlines.hulls(Whose::Body(*body), &values);
            let others = outlines.hulls(second(*rule, *other), &values);
            let depths = own.iter().flat_map(|one| others.iter().map(move |other| depth(one, other)));
            depths.fold(f64::NEG_INFINITY, f64::max)
        };
        let inside = met.iter().filter_map(|known| {
            let depth = deepest(known);
            let pair = self.pairs().iter().find(|pair| (pair.rule, pair.body, pair.other) == *known)?;
            (depth > TOUCHES * sizes[known]).then(|| self.inside(pair, depth))
        });
        Ok(inside.collect())
    }

    fn inside(&self, pair: &Pair, depth: f64) -> ModelError {
        let model = self.model();
        let body = model.bodies[pair.body].name.clone();
        match pair.rule {
            Rule::Surface(surface) => {
                let surface = model.surfaces[surface].name.clone();
                let feature = pair.name.trim_start_matches(&format!("{surface}.{body}.")).to_owned();
                ModelError::Inside { body, feature, surface, depth }
            }
            Rule::Bodies(contact) => ModelError::InEachOther {
                first: body,
                second: pair.other.map(|other| model.bodies[other].name.clone()).unwrap_or_default(),
                contact: model.contacts[contact].name.clone(),
                depth,
            },
        }
    }
}

/// Whose outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Whose {
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
pub(super) struct Outlines {
    pub(super) formulas: Vec<Expr>,
    /// By owner, of each figure where its formulas begin, the radius last, and how many places it has.
    of: HashMap<Whose, Vec<(usize, usize)>>,
}

impl Outlines {
    pub(super) fn add(&mut self, whose: Whose, model: &Model) {
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

    pub(super) fn hulls(&self, whose: Whose, values: &[f64]) -> Vec<Hull> {
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

/// Of several points of one body inside one surface only the deepest is told of.
fn deepest(inside: Vec<ModelError>) -> Vec<ModelError> {
    let depth_of = |mistake: &ModelError| match mistake {
        ModelError::Inside { body, surface, depth, .. } => Some(((body.clone(), surface.clone()), *depth)),
        ModelError::InEachOther { first, second, depth, .. } => {
            Some(((first.clone(), second.clone()), *depth))
        }
        _ => None,
    };
    let mut most: HashMap<(String, String), (f64, usize)> = HashMap::new();
    for (index, mistake) in inside.iter().enumerate() {
        let Some((of, depth)) = depth_of(mistake) else { continue };
        let found = most.entry(of).or_insert((depth, index));
        if depth > found.0 {
            *found = (depth, index);
        }
    }
    let kept = |(index, mistake): &(usize, ModelError)| match depth_of(mistake) {
        None => true,
        Some((of, _)) => most[&of].1 == *index,
    };
    inside.into_iter().enumerate().filter(kept).map(|(_, mistake)| mistake).collect()
}
