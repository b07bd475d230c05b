//! Bodies that differ from others by names alone: what is compiled of some serves all of their class.

use std::collections::HashMap;
use std::convert::Infallible;
use std::sync::Arc;

use tumble_expr::{Expr, Substitution, Symbol, is_renamed};

use crate::cache::Cache;
use crate::contact::Rule;
use crate::equations::Equations;
use crate::kinematics::Kinematics;
use crate::mode::Mode;

/// More bodies than these are seldom like others.
const MOST_BODIES: usize = 8;

/// Groups by class, and bodies of several.
#[derive(Debug, Default)]
pub(crate) struct Classes {
    /// By group, the first that it is like, if it is like any.
    first: Vec<Option<usize>>,
    /// By first, all that are like it, in order.
    members: HashMap<usize, Vec<usize>>,
    twins: Cache<Vec<usize>, Option<Arc<Twin>>>,
}

/// What some bodies are called in the first of their class.
#[derive(Debug)]
pub(crate) struct Twin {
    /// Bodies of the first, in order.
    bodies: Vec<usize>,
    /// Bodies of these with those of the first.
    places: HashMap<usize, usize>,
    /// Pairs of these with those of the first.
    pairs: HashMap<usize, usize>,
    names: Substitution,
}

/// What is compared of bodies.
struct Signature {
    /// Counts, kinds and indices.
    shape: Vec<usize>,
    formulas: Vec<Expr>,
    /// Symbols of the motion in order.
    symbols: Vec<Symbol>,
    pairs: Vec<usize>,
}

impl Twin {
    /// A formula in the names of the first.
    pub(crate) fn renamed(&self, formula: &Expr) -> Expr {
        self.names.apply(formula)
    }

    /// The mode of the first that a mode is like.
    pub(crate) fn mode(&self, mode: &Mode) -> Mode {
        let mut contacts: Vec<_> =
            mode.contacts.iter().map(|(pair, contact_mode)| (self.pairs[pair], *contact_mode)).collect();
        contacts.sort_unstable();
        let mut grips: Vec<_> = mode.grips.iter().map(|(pair, grip)| (self.pairs[pair], *grip)).collect();
        grips.sort_unstable();
        let still = mode.still.iter().filter_map(|body| self.places.get(body)).copied().collect();
        Mode { bodies: self.bodies.clone(), contacts, grips, still, ..mode.clone() }
    }

    /// A body of the first.
    pub(crate) fn body(&self, body: usize) -> usize {
        self.places[&body]
    }

    /// A pair of the first.
    pub(crate) fn pair(&self, pair: usize) -> usize {
        self.pairs[&pair]
    }
}

impl Classes {
    pub(crate) fn of(equations: &Equations) -> Self {
        let mut firsts: HashMap<Vec<usize>, Vec<(usize, Signature)>> = HashMap::new();
        let mut found = Self::default();
        for (group, bodies) in equations.components().groups().iter().enumerate() {
            let first = Signature::of(equations, bodies).map(|own| {
                let known = firsts.entry(own.shape.clone()).or_default();
                let first = known.iter().find(|(_, other)| own.as_renamed(other).is_some());
                let first = first.map_or(group, |(first, _)| *first);
                if first == group {
                    known.push((group, own));
                }
                first
            });
            found.first.push(first);
            first.into_iter().for_each(|first| found.members.entry(first).or_default().push(group));
        }
        found
    }

    /// The first of their class that some bodies are like, unless they are that.
    fn twin(&self, equations: &Equations, bodies: &[usize]) -> Option<Twin> {
        let groups = equations.components().groups_of(bodies);
        let firsts = self.first_like(&groups)?;
        let first = equations.components().bodies_of(&firsts);
        if first == bodies || first.len() != bodies.len() {
            return None;
        }
        let [own, other] = [bodies, &first].map(|bodies| Signature::of(equations, bodies));
        let (own, other) = (own?, other?);
        own.as_renamed(&other).map(|names| Twin {
            places: bodies.iter().copied().zip(first.iter().copied()).collect(),
            bodies: first,
            pairs: own.pairs.iter().copied().zip(other.pairs.iter().copied()).collect(),
            names,
        })
    }

    /// Groups of the same classes, in order, the first that there are: they do not depend on which are asked about before others.
    fn first_like(&self, groups: &[usize]) -> Option<Vec<usize>> {
        let mut firsts: Vec<usize> = vec![];
        for group in groups {
            let members = &self.members[&self.first[*group]?];
            let after = firsts.last().map_or(0, |last| members.partition_point(|member| member <= last));
            firsts.push(members[after]);
        }
        Some(firsts)
    }
}

impl Signature {
    /// `None` where bodies have what is counted among all: joints, events, loads that do not always act, or that read forces.
    fn of(equations: &Equations, bodies: &[usize]) -> Option<Self> {
        let has = |body: &usize| bodies.binary_search(body).is_ok();
        let is_counted = equations.joints().iter().any(|joint| joint.bodies.iter().any(has))
            || equations.windows().iter().any(|window| has(&window.body))
            || equations.components().has_events(bodies)
            || equations.is_fed(bodies)
            || equations.brakes().iter().any(|brake| brake.bodies.iter().any(has));
        if is_counted {
            return None;
        }
        let mut found = Self { shape: vec![bodies.len()], formulas: vec![], symbols: vec![], pairs: vec![] };
        for (place, &body) in bodies.iter().enumerate() {
            found.add_body(equations, body, place);
        }
        for index in equations.pair_list().among(bodies) {
            found.add_pair(equations, index, bodies);
        }
        found.shape.extend([found.formulas.len(), found.symbols.len()]);
        Some(found)
    }

    fn add_body(&mut self, equations: &Equations, body: usize, place: usize) {
        let (known, model) = (equations.body_equations(body), equations.model());
        self.symbols.extend(Kinematics::symbols(&known.kinematics));
        self.formulas.extend([
            known.mass.mass.clone(),
            known.mass.inertia.clone(),
            model.bodies[body].reach(),
        ]);
        self.formulas.extend(known.mass.centre.components().iter().cloned());
        self.shape.push(known.coordinates.count());
        if let Some(pivot) = model.pivot_of(&model.bodies[body].name) {
            self.symbols.extend(pivot.force_symbols());
            self.formulas.extend([pivot.point.components(), pivot.world.components()].concat());
        }
        for term in equations.terms_of(body) {
            self.shape.extend([place, term.law as usize]);
            self.formulas.extend([term.arm.components(), term.force.components()].concat());
            self.formulas.push(term.couple.clone());
        }
    }

    fn add_pair(&mut self, equations: &Equations, index: usize, bodies: &[usize]) {
        let pair = &equations.pairs()[index];
        if pair.is_rolling() {
            // It goes with that whose it is.
            return;
        }
        self.pairs.push(index);
        self.shape.extend(pair.bodies().filter_map(|body| bodies.binary_search(&body).ok()));
        self.shape.extend(match pair.rule {
            Rule::Surface(surface) => [0, surface],
            Rule::Bodies(contact) => [1, contact],
        });
        self.symbols.extend([pair.force_symbol(), pair.friction_symbol(), pair.root_symbol()]);
        let rolling = equations.pair_list().rolling.get(&index);
        self.shape.extend([pair.friction.is_some(), rolling.is_some(), pair.is_level].map(usize::from));
        self.formulas.extend([pair.gap(), pair.radius.clone()]);
        self.formulas.extend(pair.conditions());
        let arms = [Some(pair.centre.arm.clone()), pair.opposite.point().map(|point| point.arm.clone())];
        self.formulas.extend(arms.iter().flatten().flat_map(|arm| arm.components().to_vec()));
        // What is not the surface's own is the body's.
        self.formulas.extend(pair.law.dimensions().into_iter().map(|(_, formula, _)| formula.clone()));
        if let Some(rolling) = rolling {
            self.pairs.push(*rolling);
            self.symbols.push(equations.pairs()[*rolling].friction_symbol());
        }
        let friction = pair.friction.iter();
        self.formulas.extend(friction.flat_map(|own| {
            [own.of_rest.clone(), own.kinetic.clone()].into_iter().chain(own.rolling.clone())
        }));
    }

    /// What symbols are called where others are, if these differ by that alone.
    fn as_renamed(&self, other: &Self) -> Option<Substitution> {
        let names: HashMap<&Symbol, &Symbol> = self.symbols.iter().zip(&other.symbols).collect();
        let stands_for = |own: &Symbol, its: &Symbol| match names.get(own) {
            Some(name) => *name == its,
            None => own == its,
        };
        if self.shape != other.shape || !is_renamed(&self.formulas, &other.formulas, stands_for) {
            return None;
        }
        let mut renaming = Substitution::default();
        names.into_iter().for_each(|(own, its)| renaming.insert(own.clone(), its.clone().into()));
        Some(renaming)
    }
}

impl Equations {
    /// The first of their class that the bodies of a mode are like; `None` where they are that themselves, or like no others.
    pub(crate) fn twin(&self, mode: &Mode) -> Option<Arc<Twin>> {
        if self.components().groups().len() < 2 || mode.bodies.len() > MOST_BODIES {
            return None;
        }
        let classes = self.built().classes.get_or_init(|| Classes::of(self));
        let twin = || Ok::<_, Infallible>(classes.twin(self, &mode.bodies).map(Arc::new));
        let twin = classes.twins.get(&mode.bodies, twin).unwrap_or_else(|never| match never {});
        twin.as_ref().clone()
    }
}
