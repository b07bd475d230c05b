//! Contacts at the start of a run: what touches then, and what would begin inside a surface.

use std::collections::HashMap;

use tumble_expr::Expr;
use tumble_ode::{Cause, Reason};

use crate::contact::pair::Rule;
use crate::equations::Equations;
use crate::error::ModelError;
use crate::mode::Mode;

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
                [pair.gap(), &extents[pair.body] + pair.through.norm() + &pair.radius + pair.extent()]
            })
            .collect();
        let values = self.values(&formulas, mode, 0.0, states, inputs).map_err(|reason| match reason {
            Reason::Compile(mistake) => ModelError::Compile { what: "a surface".into(), mistake },
            other => ModelError::Start { body: "surfaces".into(), problem: other.to_string() },
        })?;
        let mut causes = vec![];
        let mut inside: Vec<ModelError> = vec![];
        for (index, pair) in self.pairs().iter().enumerate() {
            let (gap, size) = (values[2 * index], values[2 * index + 1]);
            if !gap.is_finite() {
                let what = format!("gap of `{}`", pair.name);
                inside.push(ModelError::NotFinite { what, value: gap });
            } else if gap < -TOUCHES * size {
                inside.push(self.inside(index, -gap));
            } else if gap <= TOUCHES * size {
                causes.push(Cause::LazyGuard(index));
            }
        }
        mistakes.extend(deepest(inside));
        Ok(causes)
    }

    fn inside(&self, pair: usize, depth: f64) -> ModelError {
        let (pair, model) = (&self.pairs()[pair], self.model());
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
