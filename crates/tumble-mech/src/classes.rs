//! Groups that differ by names alone: what is compiled of one serves all of its class.

use std::collections::HashMap;

use tumble_expr::{Expr, Substitution, Symbol, is_renamed};

use crate::contact::Rule;
use crate::equations::Equations;
use crate::kinematics::Kinematics;
use crate::mode::Mode;

/// By group, the first that it is like.
#[derive(Debug, Default)]
pub(crate) struct Classes(Vec<Option<Twin>>);

/// What a group is called in the first of its class.
#[derive(Debug)]
pub(crate) struct Twin {
    /// Bodies of the first, in order.
    bodies: Vec<usize>,
    /// Bodies of this one with those of the first.
    places: HashMap<usize, usize>,
    /// Pairs of this one with those of the first.
    pairs: HashMap<usize, usize>,
    names: Substitution,
}

/// What is compared of groups.
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

    /// Bodies of the first.
    pub(crate) fn bodies(&self) -> &[usize] {
        &self.bodies
    }

    /// A pair of the first.
    pub(crate) fn pair(&self, pair: usize) -> usize {
        self.pairs[&pair]
    }
}

impl Classes {
    pub(crate) fn of(equations: &Equations) -> Self {
        let groups = equations.components().groups();
        let mut firsts: HashMap<Vec<usize>, Vec<(usize, Signature)>> = HashMap::new();
        let mut found = vec![];
        for (group, bodies) in groups.iter().enumerate() {
            let twin = Signature::of(equations, group).and_then(|own| {
                let known = firsts.entry(own.shape.clone()).or_default();
                let twin = known.iter().find_map(|(first, signature)| {
                    own.as_renamed(signature).map(|names| Twin {
                        bodies: groups[*first].clone(),
                        places: bodies.iter().copied().zip(groups[*first].iter().copied()).collect(),
                        pairs: own.pairs.iter().copied().zip(signature.pairs.iter().copied()).collect(),
                        names,
                    })
                });
                if twin.is_none() {
                    known.push((group, own));
                }
                twin
            });
            debug_assert!(twin.as_ref().is_none_or(|twin| twin.bodies.len() == bodies.len()));
            found.push(twin);
        }
        Self(found)
    }
}

/// Whether a body meets others.
fn meets(equations: &Equations, body: usize) -> bool {
    let pairs = equations.pair_list().of_body(body);
    pairs.into_iter().any(|pair| equations.pairs()[pair].other.is_some())
}

impl Signature {
    /// `None` where a group has what is counted among all: joints, events, loads that do not always act, or that read forces; and where its bodies
    /// meet each other.
    fn of(equations: &Equations, group: usize) -> Option<Self> {
        let components = equations.components();
        let bodies = &components.groups()[group];
        let has = |body: &usize| bodies.binary_search(body).is_ok();
        let is_counted = equations.joints().iter().any(|joint| joint.bodies.iter().any(has))
            || equations.windows().iter().any(|window| has(&window.body))
            || components.has_events(group)
            || equations.is_fed(bodies)
            || equations.brakes().iter().any(|brake| brake.bodies.iter().any(has))
            || bodies.iter().any(|body| meets(equations, *body));
        if is_counted {
            return None;
        }
        let mut found = Self { shape: vec![bodies.len()], formulas: vec![], symbols: vec![], pairs: vec![] };
        for (place, &body) in bodies.iter().enumerate() {
            found.add_body(equations, body, place);
        }
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
        for index in equations.pair_list().of_body(body) {
            let pair = &equations.pairs()[index];
            self.pairs.push(index);
            // Groups of bodies that meet have no twins.
            let Rule::Surface(surface) = pair.rule else { continue };
            self.shape.extend([place, surface]);
            self.symbols.extend([pair.force_symbol(), pair.friction_symbol(), pair.root_symbol()]);
            self.shape.push(usize::from(pair.friction.is_some()));
            self.shape.push(usize::from(equations.pair_list().rolling.contains_key(&index)));
            self.formulas.extend([pair.gap(), pair.radius.clone()]);
            self.formulas.extend(pair.conditions());
            self.formulas.extend(pair.centre.arm.components().iter().cloned());
            // What is not the surface's own is the body's.
            self.formulas.extend(pair.law.restitution().cloned());
            if let Some(rolling) = equations.pair_list().rolling.get(&index) {
                self.pairs.push(*rolling);
                self.symbols.push(equations.pairs()[*rolling].friction_symbol());
            }
            let friction = pair.friction.iter();
            self.formulas.extend(friction.flat_map(|own| {
                [own.of_rest.clone(), own.kinetic.clone()].into_iter().chain(own.rolling.clone())
            }));
        }
        self.shape.extend([self.formulas.len(), self.symbols.len()]);
    }

    /// What symbols are called in another group, if it differs by that alone.
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
    /// The first of its class that the group of a mode is like; `None` where it is that itself.
    pub(crate) fn twin(&self, mode: &Mode) -> Option<&Twin> {
        let group = self.components().group_of(*mode.bodies.first()?);
        let groups = self.components().groups();
        if groups.len() < 2 || groups[group] != mode.bodies {
            return None;
        }
        let classes = self.built().classes.get_or_init(|| Classes::of(self));
        classes.0[group].as_ref()
    }
}
