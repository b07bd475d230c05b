//! Which bodies have a part in each other's motion, always or at times, and which never do.
//!
//! Bodies of a *group* are always one motion: forces and joints that always act couple them. Bodies of an *island* are one motion now:
//! they touch or are near it, or a joint that events make or release holds, besides. Bodies of a *component* may ever have a part in each
//! other's motion: they may meet, an event reads several of them, or acts on them. No term, row, guard or jump of one component reads a state of another: each is a motion of
//! its own, with its own modes, steps, scales and errors. What all bodies meet alike, a floor or the wind, couples none of them.
//!
//! A parameter that an event sets is read by all: its event has a part in the motion of all. Where there is one, or a body is carried by a
//! pivot that moves, bodies that may meet are one group. Hertzian contacts share one time transformation: where there are any, all bodies
//! are one group. So are those of a component whose joints close a loop, which is looked at as a whole where it is singular.

use std::collections::HashMap;

use tumble_expr::{Expr, Symbol, Vector};

use crate::contact::{Pair, moves};
use crate::coordinates::force_symbols;
use crate::equations::Equations;
use crate::event::Action;
use crate::load::Moment;
use crate::mode::Mode;
use crate::model::Model;
use crate::sets::Sets;
use crate::term::Term;

/// The symbols of the motion, each with the body that it belongs to, and the other of a pair.
type Owners = HashMap<Symbol, (usize, Option<usize>)>;

/// The groups and components of a model, and what belongs to which.
#[derive(Clone, Debug, Default)]
pub(crate) struct Components {
    /// Bodies of each group, in order.
    groups: Vec<Vec<usize>>,
    group_of_body: Vec<usize>,
    /// Groups of each component, in order.
    all: Vec<Vec<usize>>,
    of_group: Vec<usize>,
    /// By event, the groups that it reads or acts on, in order; the first where there are none.
    of_event: Vec<Vec<usize>>,
    /// The bodies that a symbol of the motion belongs to.
    owners: Owners,
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
        let bodies = couplings.model.bodies.len();
        let owners = couplings.owners();
        let events: Vec<Vec<usize>> =
            (0..couplings.model.events.len()).map(|event| couplings.of_event(event, &owners)).collect();
        let mut always = Sets::new(bodies);
        couplings.join(&owners, &mut always);
        let mut ever = always.clone();
        couplings.join_at_times(&events, &mut ever);
        couplings.join_loops(&mut always, &mut ever);
        let (groups, group_of_body) = always.in_order();
        let mut of_groups = Sets::new(groups.len());
        (0..bodies).for_each(|body| of_groups.join(group_of_body[body], group_of_body[ever.least(body)]));
        let (all, of_group) = of_groups.in_order();
        let of_event = events.into_iter().map(|bodies| {
            let mut of: Vec<usize> = bodies.into_iter().map(|body| group_of_body[body]).collect();
            of.sort_unstable();
            of.dedup();
            // One that reads and does nothing of any body may come with any.
            if of.is_empty() { vec![0] } else { of }
        });
        Self { of_event: of_event.collect(), groups, group_of_body, all, of_group, owners }
    }

    /// Says which body a symbol belongs to.
    pub(crate) fn own(&mut self, symbol: Symbol, body: usize) {
        self.owners.insert(symbol, (body, None));
    }

    /// Bodies of each group, in order; no body is in two.
    pub(crate) fn groups(&self) -> &[Vec<usize>] {
        &self.groups
    }

    /// Groups of each component, in order.
    pub(crate) fn all(&self) -> &[Vec<usize>] {
        &self.all
    }

    /// The group of a body.
    pub(crate) fn group_of(&self, body: usize) -> usize {
        self.group_of_body[body]
    }

    /// The component of a group.
    pub(crate) fn of_group(&self, group: usize) -> usize {
        self.of_group[group]
    }

    /// Bodies of several groups, in order.
    pub(crate) fn bodies_of(&self, groups: &[usize]) -> Vec<usize> {
        let mut bodies: Vec<usize> = groups.iter().flat_map(|group| &self.groups[*group]).copied().collect();
        bodies.sort_unstable();
        bodies
    }

    /// The groups that an event reads or acts on, in order.
    pub(crate) fn of_event(&self, event: usize) -> &[usize] {
        &self.of_event[event]
    }

    /// Whether a mode is of all bodies that an event reads or acts on.
    pub(crate) fn watches(&self, mode: &Mode, event: usize) -> bool {
        self.of_event[event].iter().all(|group| mode.has(self.groups[*group][0]))
    }

    /// Groups whose motion formulas read, in order; the first where they read none.
    pub(crate) fn read_by<'a>(&self, formulas: impl IntoIterator<Item = &'a Expr>) -> Vec<usize> {
        let symbols = formulas.into_iter().flat_map(Expr::symbols);
        let bodies = symbols.filter_map(|symbol| self.owners.get(&symbol));
        let bodies = bodies.flat_map(|(body, other)| std::iter::once(*body).chain(*other));
        let mut found: Vec<usize> = bodies.map(|body| self.group_of_body[body]).collect();
        found.sort_unstable();
        found.dedup();
        if found.is_empty() { vec![0] } else { found }
    }

    /// The groups of some bodies, in order.
    pub(crate) fn groups_of(&self, bodies: &[usize]) -> Vec<usize> {
        let mut groups: Vec<usize> = bodies.iter().map(|body| self.group_of_body[*body]).collect();
        groups.sort_unstable();
        groups.dedup();
        groups
    }

    /// Whether events read or act on some bodies alone.
    pub(crate) fn has_events(&self, bodies: &[usize]) -> bool {
        let groups = self.groups_of(bodies);
        let is_own = |group: &usize| groups.binary_search(group).is_ok();
        self.of_event.iter().any(|of| of.iter().all(is_own))
    }
}

impl Equations {
    /// Groups of those in a mode that joints which hold now, or contacts, make one motion, in order.
    pub(crate) fn coupled(&self, mode: &Mode, groups: &[usize]) -> Vec<Vec<usize>> {
        let place = |body: usize| groups.binary_search(&self.components().group_of(body)).ok();
        let mut sets = Sets::new(groups.len());
        let mut join = |bodies: &mut dyn Iterator<Item = usize>| {
            let ends: Vec<usize> = bodies.filter_map(place).collect();
            ends.windows(2).for_each(|two| sets.join(two[0], two[1]));
        };
        for (_, joint) in self.joints().iter().enumerate().filter(|(joint, _)| self.holds(mode, *joint)) {
            join(&mut joint.bodies.iter().copied());
        }
        mode.contacts.iter().for_each(|(pair, _)| join(&mut self.pairs()[*pair].bodies()));
        let (islands, _) = sets.in_order();
        islands.into_iter().map(|island| island.into_iter().map(|place| groups[place]).collect()).collect()
    }
}

impl Couplings<'_> {
    fn owners(&self) -> Owners {
        let mut owners = HashMap::new();
        let mut own_both = |symbols: Vec<Symbol>, bodies: (usize, Option<usize>)| {
            owners.extend(symbols.into_iter().map(|symbol| (symbol, bodies)));
        };
        for pair in self.pairs {
            let symbols = vec![pair.force_symbol(), pair.friction_symbol(), pair.root_symbol()];
            own_both(symbols, (pair.body, pair.other));
        }
        let mut own = |symbols: Vec<Symbol>, body: usize| own_both(symbols, (body, None));
        for (index, body) in self.model.bodies.iter().enumerate() {
            own(body.kinematics().symbols(), index);
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

    /// Joins what always has a part in each other's motion.
    fn join(&self, owners: &Owners, sets: &mut Sets) {
        let model = self.model;
        if self.pairs.iter().any(Pair::is_hertzian) {
            sets.join_all();
            return;
        }
        let mut read = |body: usize, formulas: Vec<&Expr>| {
            read_by(formulas, owners).into_iter().for_each(|other| sets.join(body, other));
        };
        for term in self.terms {
            let vectors = [&term.arm, &term.force].into_iter().flat_map(|vector| vector.components());
            read(term.body, vectors.chain([&term.couple]).collect());
        }
        for impulse in &model.impulses {
            read(self.body(&impulse.body), impulse.application.formulas());
        }
        for pair in self.pairs {
            let friction = pair.friction.iter();
            let friction =
                friction.flat_map(|own| [&own.of_rest, &own.kinetic].into_iter().chain(&own.rolling));
            let law = pair.law.dimensions().into_iter().map(|(_, formula, _)| formula).chain(friction);
            let gap = pair.gap();
            let formulas: Vec<&Expr> = law.chain([&gap]).collect();
            let is_own = |body: usize| pair.has(body) && self.is_apart_at_times(pair, owners);
            if !read_by(formulas.iter().copied(), owners).into_iter().all(is_own) {
                read(pair.body, formulas);
            }
        }
        for pivot in &model.pivots {
            read(self.body(&pivot.body), pivot.world.components().iter().collect());
        }
        for (joint, (of, _)) in model.joints.iter().zip(&self.joints) {
            read(of[0], joint.world().into_iter().flat_map(Vector::components).collect());
        }
        for interaction in &model.interactions {
            let of: Vec<usize> = interaction.bodies().into_iter().map(|name| self.body(name)).collect();
            of.windows(2).for_each(|two| sets.join(two[0], two[1]));
        }
        for (joint, (of, _)) in model.joints.iter().zip(&self.joints) {
            if joint.from.is_none() && joint.until.is_none() {
                of.windows(2).for_each(|two| sets.join(two[0], two[1]));
            }
        }
    }

    /// Whether what may meet is known to be apart by where it is: nothing that an event sets moves it or makes it larger.
    fn is_apart_at_times(&self, pair: &Pair, owners: &Owners) -> bool {
        let is_moved = |world: &Vector| moves(world) || !read_by(world.components(), owners).is_empty();
        let is_carried = |body: usize| {
            self.model.pivot_of(&self.model.bodies[body].name).is_some_and(|pivot| is_moved(&pivot.world))
        };
        let sets = |event: &crate::Event| matches!(event.action, Action::Set(_));
        !self.model.events.iter().any(sets) && !pair.bodies().any(is_carried)
    }

    /// Joins what events or contacts give a part in each other's motion, as long as it may be.
    fn join_at_times(&self, events: &[Vec<usize>], sets: &mut Sets) {
        for pair in self.pairs {
            pair.other.into_iter().for_each(|other| sets.join(pair.body, other));
        }
        let joints = self.joints.iter().map(|(of, _)| *of);
        for together in events.iter().map(Vec::as_slice).chain(joints) {
            together.windows(2).for_each(|two| sets.join(two[0], two[1]));
        }
    }

    /// Makes one group of all bodies of what has a loop of joints, those that do not hold yet among them.
    fn join_loops(&self, always: &mut Sets, ever: &mut Sets) {
        let world = self.model.bodies.len();
        let mut joined = Sets::new(world + 1);
        let pivots = self.model.pivots.iter().map(|pivot| [self.body(&pivot.body), world]);
        let joints = self.joints.iter().map(|(of, _)| [of[0], of.get(1).copied().unwrap_or(world)]);
        let mut looped = vec![];
        for [a, b] in pivots.chain(joints) {
            if joined.least(a) == joined.least(b) {
                looped.push(ever.least(a));
            }
            joined.join(a, b);
        }
        for body in 0..world {
            let root = ever.least(body);
            if looped.contains(&root) {
                always.join(body, root);
            }
        }
    }

    /// Bodies that an event reads or acts on.
    fn of_event(&self, index: usize, owners: &Owners) -> Vec<usize> {
        let (model, event) = (self.model, &self.model.events[index]);
        if matches!(event.action, Action::Set(_)) {
            return (0..model.bodies.len()).collect();
        }
        let is_this = |name: &Option<String>| name.as_ref() == Some(&event.name);
        let mut of = read_by([&event.when], owners);
        for load in &model.loads {
            let ends = load.during.iter().flatten();
            let is_window =
                ends.into_iter().any(|end| matches!(end, Moment::Event(name) if *name == event.name));
            of.extend(is_window.then(|| self.body(&load.body)));
        }
        for (joint, (bodies, _)) in model.joints.iter().zip(&self.joints) {
            if is_this(&joint.from) || is_this(&joint.until) {
                of.extend(bodies.iter());
            }
        }
        let impulses = model.impulses.iter().filter(|impulse| impulse.when == event.name);
        of.extend(impulses.map(|impulse| self.body(&impulse.body)));
        of
    }

    fn body(&self, name: &str) -> usize {
        self.model.body_index(name).expect("the model was checked")
    }
}

/// Bodies whose motion formulas read.
fn read_by<'a>(formulas: impl IntoIterator<Item = &'a Expr>, owners: &Owners) -> Vec<usize> {
    let symbols = formulas.into_iter().flat_map(Expr::symbols);
    let bodies = symbols.filter_map(|symbol| owners.get(&symbol).copied());
    bodies.flat_map(|(body, other)| std::iter::once(body).chain(other)).collect()
}
