//! Contacts at the start of a run: what touches then, and what would begin inside a surface.

use std::collections::{HashMap, HashSet};

use tumble_expr::Expr;
use tumble_ode::{Cause, Reason};

use crate::contact::circles::{Circles, meeting_within, ordered};
use crate::contact::outlines::{Couple, Outlines};
use crate::contact::pair::{Pair, Rule};
use crate::equations::Equations;
use crate::error::ModelError;
use crate::mode::Mode;

/// A gap within this many ulps of the lengths it is made of is none: bodies are drawn and placed to touch.
pub(crate) const TOUCHES: f64 = 64.0 * f64::EPSILON;

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
        let near = self.near_each_other(mode, states, inputs);
        let is_near = |pair: &Pair| pair.other.is_none_or(|other| near.contains(&ordered(pair.body, other)));
        let pairs =
            || self.pairs().iter().enumerate().filter(|(_, pair)| !pair.is_rolling() && is_near(pair));
        let formulas = pairs().flat_map(|(_, pair)| {
            let size = &extents[pair.body] + pair.through.norm() + &pair.radius + pair.extent();
            [pair.gap(), size].into_iter().chain(pair.within())
        });
        let formulas: Vec<Expr> = formulas.collect();
        let values = self.values(&formulas, mode, 0.0, states, inputs).map_err(|reason| match reason {
            Reason::Compile(mistake) => ModelError::Compile { what: "a surface".into(), mistake },
            other => ModelError::Start { body: "surfaces".into(), problem: other.to_string() },
        })?;
        let mut causes = vec![];
        let mut inside: Vec<ModelError> = vec![];
        let mut sizes: HashMap<Couple, f64> = HashMap::new();
        let mut values = values.into_iter();
        for (index, pair) in pairs() {
            let mut next = || values.next().unwrap_or(f64::NAN);
            let (gap, size) = (next(), next());
            let holds = pair.limits.iter().fold(true, |holds, _| next() >= 0.0 && holds);
            if pair.has_edge() {
                let most = sizes.entry(pair.couple()).or_default();
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

    /// Bodies that may meet and are not shown to be apart at the start, the lesser first.
    fn near_each_other(&self, mode: &Mode, states: &[f64], inputs: &[f64]) -> HashSet<[usize; 2]> {
        let meet = &self.pair_list().couples;
        let circles = Circles::of(self, meet.iter().flatten().copied(), mode, (0.0, states), inputs);
        meeting_within(&circles.at(self, mode, states), meet)
    }

    /// What starts inside each other of those that meet by edges; `sizes` are the lengths that their places are made of, m.
    fn overlapping(
        &self,
        sizes: &HashMap<Couple, f64>,
        mode: &Mode,
        (states, inputs): (&[f64], &[f64]),
    ) -> Result<Vec<ModelError>, ModelError> {
        let mut met: Vec<Couple> = sizes.keys().copied().collect();
        met.sort_unstable();
        let outlines = Outlines::of(&met, self.model());
        let values = self.values(&outlines.formulas, mode, 0.0, states, inputs);
        let values = values
            .map_err(|reason| ModelError::Start { body: "surfaces".into(), problem: reason.to_string() })?;
        let inside = met.iter().filter_map(|known| {
            let depth = outlines.depth(known, &values);
            let pair = self.pairs().iter().find(|pair| pair.couple() == *known)?;
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
