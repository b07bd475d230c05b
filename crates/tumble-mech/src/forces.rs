//! The forces of a run at any time: the terms that were integrated, as numbers.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use tumble_expr::{Expr, Jets};
use tumble_ode::{Reason, Side};

use crate::evaluator::evaluate;
use crate::run::Run;
use crate::term::{Law, Term};

/// A force at its point and a couple, at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Force {
    /// Name of the load, joint or pair.
    pub load: String,
    /// The law it follows.
    pub law: Law,
    /// Index of the body it acts on.
    pub body: usize,
    /// From the body's centre of mass to the point of action, m, world axes.
    pub arm: [f64; 2],
    /// N, world axes.
    pub force: [f64; 2],
    /// Couple beyond the moment of the force, N m.
    pub couple: f64,
}

impl Force {
    /// Torque about the body's centre of mass, N m.
    pub fn torque(&self) -> f64 {
        self.arm[0] * self.force[1] - self.arm[1] * self.force[0] + self.couple
    }
}

/// Evaluates all forces at any time of a run.
pub struct Forces {
    /// The motions of bodies that nothing couples, with the forces by mode, built when first needed.
    parts: Vec<(Run, HashMap<usize, Compiled>)>,
}

/// The terms of a mode, with what evaluates them.
type Compiled = (Vec<Term>, Jets<f64>);

/// Outputs a term: arm, force, couple.
const OUTPUTS: usize = 5;

impl Forces {
    /// The forces of a run.
    pub fn of(run: &Run) -> Self {
        Self { parts: run.parts().into_iter().map(|part| (part, HashMap::new())).collect() }
    }

    /// Every force that acts at a time, reactions and contacts included; at an event, on that side of it. Nothing outside
    /// the motion.
    pub fn at(&mut self, time: f64, side: Side) -> Result<Vec<Force>, Reason> {
        let mut all = vec![];
        for (run, known) in &mut self.parts {
            let motion = run.motion();
            let Some(place) = motion.place_at(time, side) else { return Ok(vec![]) };
            let (terms, jets) = match known.entry(place.mode) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(empty) => empty.insert(compiled(run, place.mode)?),
            };
            evaluate(jets, &place);
            let value = |term: usize, which: usize| jets.value_of(term * OUTPUTS + which);
            all.extend(terms.iter().enumerate().map(|(index, term)| Force {
                load: term.load.clone(),
                law: term.law,
                body: term.body,
                arm: [value(index, 0), value(index, 1)],
                force: [value(index, 2), value(index, 3)],
                couple: value(index, 4),
            }));
        }
        Ok(all)
    }
}

fn compiled(run: &Run, mode: usize) -> Result<Compiled, Reason> {
    let (equations, mode) = (&run.equations, &run.trajectory().modes[mode]);
    let acting = equations.acting_with_shares(mode).into_iter().map(|(.., term)| term);
    let terms: Vec<Term> = acting.chain(equations.pivot_terms(mode)).collect();
    let outputs: Vec<Expr> = terms
        .iter()
        .flat_map(|term| {
            [term.arm.components(), term.force.components(), std::slice::from_ref(&term.couple)].concat()
        })
        .collect();
    let jets = equations.evaluator(mode, &outputs, &run.inputs)?;
    Ok((terms, jets))
}

/// Forces of one load on one body as one: their sum, at the mean of their points by the size of each, and the couple
/// that keeps the torque.
pub fn joined(forces: &[Force]) -> Vec<Force> {
    let mut all: Vec<Vec<Force>> = vec![];
    for force in forces {
        match all.iter_mut().find(|same| same[0].load == force.load && same[0].body == force.body) {
            Some(same) => same.push(force.clone()),
            None => all.push(vec![force.clone()]),
        }
    }
    all.iter().map(|same| if let [only] = &same[..] { only.clone() } else { resultant(same) }).collect()
}

fn resultant(forces: &[Force]) -> Force {
    let size = |force: &Force| libm::hypot(force.force[0], force.force[1]);
    let sum = |of: &dyn Fn(&Force) -> f64| forces.iter().map(of).sum::<f64>();
    let whole = sum(&size);
    let mean = |axis: usize| match whole > 0.0 {
        true => sum(&|force| size(force) * force.arm[axis]) / whole,
        false => 0.0,
    };
    let mut one = Force {
        arm: [mean(0), mean(1)],
        force: [sum(&|force| force.force[0]), sum(&|force| force.force[1])],
        couple: 0.0,
        ..forces[0].clone()
    };
    one.couple = sum(&Force::torque) - one.torque();
    one
}
