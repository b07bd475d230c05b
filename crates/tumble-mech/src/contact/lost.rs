//! What is in each other, though it is rigid, or further than its compliant contacts know of: a contact was lost, and the motion is refused
//! from there on.
//!
//! Contacts are located one by one, so this is not how they are found. It is what a motion is held against that has been found: of those
//! that meet by edges, which have many pairs of features, the convex figures themselves are compared.

use std::collections::BTreeSet;
use std::sync::Arc;

use tumble_expr::Expr;
use tumble_ode::{Accuracy, Piece, Reason, Refusal, Side};

use crate::contact::outlines::{Couple, Outlines};
use crate::contact::pair::{Pair, Rule};
use crate::equations::Equations;
use crate::mode::Mode;
use crate::run::{Run, RunError};

/// Bodies may be in each other by this part of their distance from the origin, or by the accuracy, where that is more: rounding and
/// truncation of a contact that lasts are less.
const LOST: f64 = 1e-9;
/// How often along each step it is looked at: a step may be a whole flight.
const LOOKS: u32 = 4;

impl Run {
    /// The run, unless bodies get into each other on the way: then it is refused, and ends where they were last seen apart.
    pub(crate) fn with_contacts_kept(self, accuracy: Accuracy) -> Result<Self, RunError> {
        let met: BTreeSet<Couple> =
            self.equations.pairs().iter().filter(|pair| pair.has_edge()).map(Pair::couple).collect();
        if met.is_empty() {
            return Ok(self);
        }
        let met: Vec<Couple> = met.into_iter().collect();
        let Some((refusal, apart)) = self.first_lost(&met, accuracy.value().max(LOST))? else {
            return Ok(self);
        };
        Err(RunError::Refused { refusal, partial: Box::new(self.until(apart)) })
    }

    /// When two are first seen in each other, and when they were last seen apart.
    fn first_lost(&self, met: &[Couple], limit: f64) -> Result<Option<(Refusal, f64)>, RunError> {
        let outlines = Outlines::of(met, self.equations.model());
        let yielding = Yielding::of(self, met);
        let mut observer = self.observe(&[&outlines.formulas[..], &yielding.gaps].concat())?;
        let looks = |piece: &Piece| {
            let (from, to) = (piece.start, piece.end);
            (1..=LOOKS).map(move |part| {
                if part == LOOKS { to } else { from + (to - from) * f64::from(part) / f64::from(LOOKS) }
            })
        };
        let mut times: Vec<f64> =
            self.tracks().flat_map(|motion| motion.pieces.iter().flat_map(looks)).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let (mut values, mut apart) = (vec![], self.start().unwrap_or(0.0));
        for time in times {
            if !observer.at_into(time, Side::Before, &mut values) {
                continue;
            }
            let (places, gaps) = values.split_at(outlines.formulas.len());
            let size = places.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            for couple in met {
                let depth = outlines.depth(couple, places);
                if depth > limit * size && depth > limit * size + yielding.depth(couple, gaps, time) {
                    return Ok(Some((
                        Refusal { time: apart, reason: self.lost(couple, depth, time) },
                        apart,
                    )));
                }
            }
            apart = time;
        }
        Ok(None)
    }

    fn lost(&self, &(rule, body, other): &Couple, depth: f64, time: f64) -> Reason {
        let model = self.equations.model();
        let first = &model.bodies[body].name;
        let second = match (other, rule) {
            (Some(other), _) => &model.bodies[other].name,
            (None, Rule::Surface(surface)) => &model.surfaces[surface].name,
            (None, Rule::Bodies(contact)) => &model.contacts[contact].name,
        };
        let is_rigid = |pair: &Pair| pair.couple() == (rule, body, other) && pair.is_rigid();
        let way_out = match self.equations.pairs().iter().any(is_rigid) {
            true => "with a restitution of 0, or started a little differently, they may not be",
            false => "with more stiffness, or started a little differently, they may not be",
        };
        Reason::Model(format!(
            "a contact of `{first}` and `{second}` is lost: at {time} s they are {depth:.1e} m in each other; {way_out}"
        ))
    }
}

/// The compliant contacts of those that meet by edges.
struct Yielding {
    /// Each motion with the modes that it has.
    motions: Vec<Arc<tumble_ode::Motion<Equations>>>,
    pairs: Vec<(Couple, usize)>,
    /// Of each of these, m.
    gaps: Vec<Expr>,
}

impl Yielding {
    fn of(run: &Run, met: &[Couple]) -> Self {
        let pairs = run.equations.pairs();
        let own = pairs.iter().map(Pair::couple).zip(0..);
        let own = own.filter(|(couple, pair)| met.contains(couple) && !pairs[*pair].is_rigid());
        let own: Vec<(Couple, usize)> = own.collect();
        let gaps = own.iter().map(|(_, pair)| pairs[*pair].gap()).collect();
        let motions = if own.is_empty() { vec![] } else { run.parts().iter().map(Run::motion).collect() };
        Self { motions, pairs: own, gaps }
    }

    /// How deep the contacts are by which two are pressed into each other, or have let go of each other inside, m.
    fn depth(&self, couple: &Couple, gaps: &[f64], time: f64) -> f64 {
        let modes = self.motions.iter().filter_map(|motion| {
            let place = motion.place_at(time, Side::Before)?;
            Some(&motion.modes[place.mode])
        });
        let modes: Vec<&Mode> = modes.collect();
        let is_in = |pair: usize| modes.iter().any(|mode| mode.contact_mode(pair).is_some());
        let own = self.pairs.iter().zip(gaps).filter(|((of, pair), _)| of == couple && is_in(*pair));
        own.fold(0.0, |most, (_, gap)| most.max(-gap))
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use tumble_expr::units::{KG, M, S};
    use tumble_expr::{Expr, Vector};

    use super::*;
    use crate::body::Body;
    use crate::contact::BodyContact;
    use crate::equations::Equations;
    use crate::model::{Gravity, Model};
    use crate::shape::Shape;
    use crate::start::Start;

    /// A box that flies at another with 2 m/s, from 1 m away.
    fn boxes() -> Model {
        let mut model = Model::new();
        model.gravity = Gravity::Vertical(0 * M / (S * S));
        for (name, x, speed) in [("left", -1.5, 2.0), ("right", 0.0, 0.0)] {
            let square = Shape::Box { centre: Vector::planar(0 * M, 0 * M), width: 0.5 * M, height: 0.5 * M };
            let body = model.add(Body::of_shape(name, square).mass(1 * KG));
            let start = Start::default().at([x * M, 0 * M]).velocity([speed * M / S, 0 * M / S]);
            model.starts.push((body.name, start));
        }
        model
    }

    fn run(model: &Model) -> Run {
        let equations = Equations::new(model.clone()).expect("a model");
        Run::new(equations, &model.parameters, 1.0, Accuracy::DEFAULT, |_| ControlFlow::Continue(()))
            .expect("a motion")
    }

    #[test]
    fn what_gets_into_each_other_is_refused() {
        let (apart, mut meeting) = (boxes(), boxes());
        meeting.contact(BodyContact::of_all("hit", Expr::one()));
        let kept = run(&meeting).with_contacts_kept(Accuracy::DEFAULT);
        assert!(kept.is_ok(), "they bounce off each other");
        // The same flight, of which nobody has seen that they meet.
        let through = run(&apart);
        let motion = through.trajectory().clone();
        let lost = Run::of(Equations::new(meeting).expect("a model"), motion, through.inputs);
        let Err(RunError::Refused { refusal, partial }) = lost.with_contacts_kept(Accuracy::DEFAULT) else {
            panic!("refused")
        };
        assert!(
            refusal.reason.to_string().starts_with("a contact of `left` and `right` is lost"),
            "{refusal}"
        );
        assert!(partial.end().is_none_or(|end| end <= 0.5), "they meet after half a second");
    }
}
