//! Which bodies have a part in each other's motion, and which never do.
//!
//! A component is a set of bodies that forces, joints or events may couple at some time. No term, row, guard or jump of one
//! component reads a state of another: each is a motion of its own, with its own modes, steps, scales and errors. What all bodies
//! meet alike, a floor or the wind, couples none of them. A parameter that an event sets is read by all; Hertzian contacts share
//! one time transformation: where there are any, all bodies are one component.

use std::collections::HashMap;

use tumble_expr::{Expr, Symbol, Vector};

use crate::contact::Pair;
use crate::coordinates::force_symbols;
use crate::event::Action;
use crate::load::Moment;
use crate::model::Model;
use crate::sets::Sets;
use crate::term::Term;

/// The components of a model, and what belongs to which.
#[derive(Clone, Debug, Default)]
pub(crate) struct Components {
    /// Bodies of each, in order.
    all: Vec<Vec<usize>>,
    of_body: Vec<usize>,
    of_event: Vec<usize>,
    /// A body that a symbol of the motion belongs to.
    owners: HashMap<Symbol, usize>,
}

/// What may couple bodies, as far as the equations have been set up.
pub(crate) struct Couplings<'a> {
    pub(crate) model: &'a Model,
    pub(crate) terms: &'a [Term],
    pub(crate) pairs: &'a [Pair],
    /// By joint: its bodies, and the symbols that it brings.
    pub(crate) joints: Vec<(&'a [usize], Vec<Symbol>)>,
}

impl Components {
    pub(crate) fn of(couplings: &Couplings<'_>) -> Self {
        let model = couplings.model;
        let owners = couplings.owners();
        // Bodies, then events.
        let mut sets = Sets::new(model.bodies.len() + model.events.len());
        couplings.join(&owners, &mut sets);
        let mut found = Self { owners, ..Self::default() };
        let mut by_root: HashMap<usize, usize> = HashMap::new();
        for body in 0..model.bodies.len() {
            let component = *by_root.entry(sets.least(body)).or_insert(found.all.len());
            if component == found.all.len() {
                found.all.push(vec![]);
            }
            found.all[component].push(body);
            found.of_body.push(component);
        }
        let events = (0..model.events.len()).map(|event| sets.least(model.bodies.len() + event));
        // One that reads and does nothing of any body may come with any.
        found.of_event = events.map(|root| by_root.get(&root).copied().unwrap_or(0)).collect();
        found
    }

    /// Bodies of each component, in order; no body is in two.
    pub(crate) fn all(&self) -> &[Vec<usize>] {
        &self.all
    }

    /// A body of the component that watches for an event.
    pub(crate) fn body_of_event(&self, event: usize) -> usize {
        self.all[self.of_event[event]][0]
    }

    /// Components whose motion formulas read, in order; the first where they read none.
    pub(crate) fn read_by<'a>(&self, formulas: impl IntoIterator<Item = &'a Expr>) -> Vec<usize> {
        let symbols = formulas.into_iter().flat_map(Expr::symbols);
        let bodies = symbols.filter_map(|symbol| self.owners.get(&symbol));
        let mut found: Vec<usize> = bodies.map(|body| self.of_body[*body]).collect();
        found.sort_unstable();
        found.dedup();
        if found.is_empty() { vec![0] } else { found }
    }

    /// Whether a component watches for events.
    pub(crate) fn has_events(&self, component: usize) -> bool {
        self.of_event.contains(&component)
    }

    /// The component of a body.
    pub(crate) fn of_body(&self, body: usize) -> usize {
        self.of_body[body]
    }
}

impl Couplings<'_> {
    /// The symbols of the motion, each with a body that it belongs to.
    fn owners(&self) -> HashMap<Symbol, usize> {
        let mut owners = HashMap::new();
        let mut own = |symbols: Vec<Symbol>, body: usize| {
            owners.extend(symbols.into_iter().map(|symbol| (symbol, body)));
        };
        for (index, body) in self.model.bodies.iter().enumerate() {
            own(body.kinematics().symbols(), index);
        }
        for pair in self.pairs {
            own(vec![pair.force_symbol(), pair.root_symbol()], pair.body);
        }
        for (bodies, symbols) in &self.joints {
            own(symbols.clone(), bodies[0]);
        }
        for pivot in &self.model.pivots {
            let body = self.model.body_index(&pivot.body).expect("the model was checked");
            own(force_symbols(&pivot.name).to_vec(), body);
        }
        owners
    }

    /// Joins what has a part in each other's motion.
    fn join(&self, owners: &HashMap<Symbol, usize>, sets: &mut Sets) {
        let model = self.model;
        let bodies = model.bodies.len();
        let is_set = model.events.iter().any(|event| matches!(event.action, Action::Set(_)));
        if is_set || self.pairs.iter().any(Pair::is_hertzian) {
            sets.join_all();
            return;
        }
        let body = |name: &str| model.body_index(name).expect("the model was checked");
        let event = |name: &str| {
            let found = model.events.iter().position(|event| event.name == name);
            bodies + found.expect("the model was checked")
        };
        let read = |member: usize, formulas: Vec<&Expr>, sets: &mut Sets| {
            let symbols = formulas.into_iter().flat_map(Expr::symbols);
            let read: Vec<usize> = symbols.filter_map(|symbol| owners.get(&symbol).copied()).collect();
            read.into_iter().for_each(|other| sets.join(member, other));
        };
        for term in self.terms {
            let vectors = [&term.arm, &term.force].into_iter().flat_map(|vector| vector.components());
            read(term.body, vectors.chain([&term.couple]).collect(), sets);
        }
        for load in &model.loads {
            for moment in load.during.iter().flatten() {
                if let Moment::Event(name) = moment {
                    sets.join(body(&load.body), event(name));
                }
            }
        }
        for interaction in &model.interactions {
            let of: Vec<usize> = interaction.bodies().into_iter().map(body).collect();
            of.windows(2).for_each(|two| sets.join(two[0], two[1]));
        }
        for (joint, (of, _)) in model.joints.iter().zip(&self.joints) {
            of.windows(2).for_each(|two| sets.join(two[0], two[1]));
            let events = joint.from.iter().chain(&joint.until);
            events.for_each(|name| sets.join(of[0], event(name)));
        }
        for impulse in &model.impulses {
            sets.join(body(&impulse.body), event(&impulse.when));
            read(body(&impulse.body), impulse.application.formulas(), sets);
        }
        for (index, watched) in model.events.iter().enumerate() {
            read(bodies + index, vec![&watched.when], sets);
        }
        for pair in self.pairs {
            let law = pair.law.dimensions().into_iter().map(|(_, formula, _)| formula);
            read(pair.body, law.chain([&pair.gap()]).collect(), sets);
        }
        for pivot in &model.pivots {
            read(body(&pivot.body), pivot.world.components().iter().collect(), sets);
        }
        for (joint, (of, _)) in model.joints.iter().zip(&self.joints) {
            read(of[0], joint.world().into_iter().flat_map(Vector::components).collect(), sets);
        }
    }
}
