//! The rows that hold bodies together in a mode, and what keeps them: see [`crate::row`].

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::rc::Rc;

use tumble_expr::{Binary, Expr, FastMap, Unary};

use super::algebra::Algebra;
use super::linking::Linking;
use super::names::{Meaning, Name};
use super::part::{Part, Pusher, RowOf};
use crate::contact::Grip;
use crate::equations::Equations;
use crate::mode::Mode;

/// The islands of a mode.
#[derive(Default)]
pub(super) struct Islands {
    all: Vec<Island>,
    of_body: FastMap<usize, usize>,
    /// What is found by the systems of all, where loads read any of it.
    pub(super) unknowns: Rc<HashSet<Name>>,
}

/// Bodies that joints keep together.
#[derive(Default)]
struct Island {
    system: Rc<System>,
    is_solved: bool,
}

/// What is unknown of an island, in this order.
#[derive(Clone, Default)]
pub(super) struct System {
    /// Of joints, without what is redundant, then of contacts; each with its bodies.
    pub(super) rows: Vec<(RowOf, Vec<usize>)>,
    /// Bodies without moment of inertia that joints turn: their angular accelerations.
    pub(super) lights: Vec<usize>,
    /// Bodies with a pivot whose force loads read, along x and y.
    pub(super) recoils: Vec<usize>,
    /// Loads that read forces, each with its body.
    pub(super) feeding: Vec<(usize, usize)>,
}

/// What is left out of a system.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Without {
    Nothing,
    /// The friction of a pair.
    Friction(usize),
    /// What loads do that read forces.
    Feedback,
}

/// Entries of a matrix by row and column.
pub(super) type Entries<Value> = Vec<BTreeMap<usize, Value>>;

impl System {
    fn size(&self) -> usize {
        self.rows.len() + self.lights.len() + 2 * self.recoils.len()
    }

    /// Places of bodies without moment of inertia.
    pub(super) fn places_of_lights(&self) -> impl Iterator<Item = (usize, usize)> {
        (self.rows.len()..).zip(self.lights.iter().copied())
    }

    /// Where the forces of pivots begin, by body.
    pub(super) fn places_of_recoils(&self) -> impl Iterator<Item = (usize, usize)> {
        (self.rows.len() + self.lights.len()..).step_by(2).zip(self.recoils.iter().copied())
    }

    /// Place of a row.
    pub(super) fn place_of(&self, row: RowOf) -> Option<usize> {
        self.rows.iter().position(|(own, _)| *own == row)
    }
}

impl Islands {
    pub(super) fn of(equations: &Equations, mode: &Mode) -> Self {
        let mut found = Self::default();
        for (index, bodies) in equations.islands(mode, &mode.bodies).into_iter().enumerate() {
            let is_light = |body: &usize| equations.is_turned_by_joints(mode, *body);
            let lights = bodies.iter().copied().filter(is_light).collect();
            found.of_body.extend(bodies.into_iter().map(|body| (body, index)));
            let system = System { lights, ..System::default() };
            found.all.push(Island { system: Rc::new(system), is_solved: false });
        }
        let joints = equations.rows_by_joint(mode).into_iter();
        let rows = joints.filter(|(index, _)| !mode.redundant.contains(index)).map(|(_, row)| row);
        let contacts = mode.held().map(RowOf::Pair).chain(mode.sticking().map(RowOf::Slip));
        for row in rows.chain(contacts).chain(mode.braked().map(RowOf::Brake)) {
            let bodies = equations.bodies_of(row);
            if let Some(island) = bodies.first().and_then(|body| found.of_body.get(body)) {
                Rc::make_mut(&mut found.all[*island].system).rows.push((row, bodies));
            }
        }
        for (load, term) in equations.feeding(mode) {
            if let Some(island) = found.of_body.get(&term.body) {
                let system = Rc::make_mut(&mut found.all[*island].system);
                system.feeding.push((load, term.body));
                system.recoils.extend(equations.recoiling(load));
                system.recoils.sort_unstable();
                system.recoils.dedup();
            }
        }
        let fed = found.all.iter().map(|island| &*island.system).filter(|system| !system.feeding.is_empty());
        found.unknowns = Rc::new(fed.flat_map(|system| equations.unknowns(mode, system)).collect());
        found
    }

    /// The system of a body's island.
    pub(super) fn system(&self, body: usize) -> Rc<System> {
        Rc::clone(&self.all[self.of_body[&body]].system)
    }

    /// The systems of some bodies as one.
    pub(super) fn together(&self, bodies: &[usize]) -> System {
        let mut islands: Vec<usize> =
            bodies.iter().filter_map(|body| self.of_body.get(body)).copied().collect();
        islands.sort_unstable();
        islands.dedup();
        islands.into_iter().fold(System::default(), |mut all, island| {
            let own = &self.all[island].system;
            all.rows.extend(own.rows.iter().cloned());
            all.lights.extend(&own.lights);
            all.recoils.extend(&own.recoils);
            all.feeding.extend(&own.feeding);
            all
        })
    }

    /// Systems with loads that read forces.
    pub(super) fn fed(&self) -> Vec<Rc<System>> {
        let fed = self.all.iter().filter(|island| !island.system.feeding.is_empty());
        fed.map(|island| Rc::clone(&island.system)).collect()
    }

    pub(super) fn is_light(&self, body: usize) -> bool {
        self.of_body.get(&body).is_some_and(|island| self.all[*island].system.lights.contains(&body))
    }

    fn has(&self, body: usize) -> bool {
        self.of_body.contains_key(&body)
    }
}

impl<A: Algebra> Linking<'_, A> {
    /// What keeps a row of a joint: nothing while that does not hold; `None` where no body of it is in the mode.
    pub(super) fn multiplier(&mut self, joint: usize, row: usize) -> Option<A::Value> {
        let equations = self.equations;
        let bodies = &equations.joints()[joint].bodies;
        let body = *bodies.iter().find(|body| self.islands.has(**body))?;
        Some(self.keeping(body, RowOf::Joint(joint, row)))
    }

    /// The force of a pair; `None` where its body is not in the mode.
    pub(super) fn normal(&mut self, pair: usize) -> Option<A::Value> {
        let body = self.equations.pairs()[pair].body;
        if !self.islands.has(body) {
            return None;
        }
        Some(match self.mode.pressed().any(|pressed| pressed == pair) {
            true => self.part(Part::Pressed(pair)).remove(0),
            false => self.keeping(body, RowOf::Pair(pair)),
        })
    }

    /// The friction of a pair; `None` where its body is not in the mode.
    pub(super) fn friction(&mut self, pair: usize) -> Option<A::Value> {
        let body = self.equations.pairs()[pair].body;
        if !self.islands.has(body) {
            return None;
        }
        let Some(tie) = self.tie(pair) else { return Some(self.keeping(body, RowOf::Slip(pair))) };
        let owner = self.equations.pair_list().owner.get(&pair).copied().unwrap_or(pair);
        let normal = self.normal(owner)?;
        Some(self.algebra.binary(Binary::Mul, tie, normal))
    }

    /// The sign in a brake; zero while it holds, when what it does stands by itself.
    pub(super) fn sign(&mut self, brake: usize) -> A::Value {
        match self.mode.brake(brake) {
            None => {
                let equations = self.equations;
                self.formula(&equations.brakes()[brake].rate.sign())
            }
            Some(Grip::Slides(way)) => self.formula(&Expr::from(way.sign())),
            Some(_) => self.algebra.zero(),
        }
    }

    /// What keeps the rate of a brake zero; `None` where its bodies are not in the mode.
    pub(super) fn braking(&mut self, brake: usize) -> Option<A::Value> {
        let body = *self.equations.brakes()[brake].bodies.iter().find(|body| self.islands.has(**body))?;
        Some(self.keeping(body, RowOf::Brake(brake)))
    }

    /// Friction of a pair that is tied to its normal force, for each unit of that.
    pub(super) fn tie(&mut self, pair: usize) -> Option<A::Value> {
        let tie = self.equations.tie(self.mode, pair)?;
        Some(self.formula(&tie))
    }

    fn keeping(&mut self, body: usize, row: RowOf) -> A::Value {
        if self.islands.system(body).place_of(row).is_none() {
            return self.algebra.zero();
        }
        let name = self.names.of_row(row);
        self.solve_about(body);
        self.value(name)
    }

    /// Finds what keeps the rows of a body's island, given the forces of all else, and how bodies without moment of inertia turn.
    pub(super) fn solve_about(&mut self, body: usize) {
        let index = self.islands.of_body[&body];
        if std::mem::replace(&mut self.islands.all[index].is_solved, true) {
            return;
        }
        let system = self.islands.system(body);
        let matrix = self.matrix(&system, Without::Nothing);
        let right = self.right_sides(&system);
        let found = self.solved(matrix, right);
        let names = system.rows.iter().map(|(row, _)| self.names.of_row(*row));
        let turning = system.lights.iter().map(|body| self.names.of_body(*body).accelerations[2]);
        let recoils = system.recoils.iter().flat_map(|body| self.names.of_body(*body).forces[..2].to_vec());
        let names: Vec<_> = names.chain(turning).chain(recoils).collect();
        names.into_iter().zip(found).for_each(|(name, value)| self.settle(name, value));
    }

    pub(super) fn solved(&mut self, matrix: Entries<A::Value>, right: Vec<A::Value>) -> Vec<A::Value> {
        self.algebra.solve(matrix.into_iter().map(|row| row.into_iter().collect()).collect(), right)
    }

    /// How much a push at a pair moves it while all other rows of its island hold, 1/kg; something may be left out.
    pub(super) fn yielding(&mut self, pair: usize, without: Without) -> A::Value {
        let system = self.islands.system(self.equations.pairs()[pair].body);
        let place = system.place_of(RowOf::Pair(pair)).unwrap_or_default();
        self.yielding_at(&system, place, without)
    }

    /// The same of any unknown of a system: what a unit of it does to its own equation while all others hold.
    pub(super) fn yielding_at(&mut self, system: &System, place: usize, without: Without) -> A::Value {
        let matrix = self.matrix(system, without);
        let one = self.formula(&Expr::one());
        let mut right = vec![self.algebra.zero(); matrix.len()];
        right[place] = one.clone();
        let found = self.solved(matrix, right).swap_remove(place);
        self.algebra.binary(Binary::Div, one, found)
    }

    /// What each unknown does to each equation: to the accelerations of rows, to the torques on bodies without moment of inertia, and to
    /// the forces of pivots.
    pub(super) fn matrix(&mut self, system: &System, without: Without) -> Entries<A::Value> {
        let System { rows, recoils, .. } = system;
        // Bodies have few neighbours: all other entries are zero.
        let mut on_body: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for (index, (_, bodies)) in rows.iter().enumerate() {
            bodies.iter().for_each(|body| _ = on_body.entry(*body).or_default().insert(index));
        }
        let mut matrix: Entries<A::Value> = vec![BTreeMap::new(); system.size()];
        for (i, (row, bodies)) in rows.iter().enumerate() {
            let others: BTreeSet<usize> = bodies.iter().flat_map(|body| &on_body[body]).copied().collect();
            for j in others.into_iter().filter(|j| *j >= i) {
                let other = rows[j].0;
                let entry = self.part(Part::Response(*row, Pusher::Row(other))).remove(0);
                // What brakes does not do so along its rate.
                let back = match [*row, other].iter().any(|row| matches!(row, RowOf::Brake(_))) {
                    true => self.part(Part::Response(other, Pusher::Row(*row))).remove(0),
                    false => entry.clone(),
                };
                let [below, above] = [(back, other, *row), (entry, *row, other)].map(|(entry, of, by)| {
                    self.with_friction(entry, by, without, |slip| (Part::Response(of, slip), 0))
                });
                matrix[j].insert(i, below);
                matrix[i].insert(j, above);
            }
        }
        for (place, body) in system.places_of_lights() {
            for index in on_body.get(&body).into_iter().flatten().copied() {
                let row = rows[index].0;
                let entry = self.part(Part::Torque(Pusher::Row(row), body)).remove(0);
                let turning = match row {
                    RowOf::Brake(_) => self.part(Part::Turning(row, body)).remove(0),
                    _ => entry.clone(),
                };
                matrix[index].insert(place, turning);
                let pushed = self.with_friction(entry, row, without, |slip| (Part::Torque(slip, body), 0));
                matrix[place].insert(index, pushed);
            }
        }
        if !recoils.is_empty() {
            self.add_recoils(system, without, &mut matrix);
        }
        if without != Without::Feedback {
            self.add_feedback(system, &mut matrix);
        }
        matrix
    }

    /// What a unit of a row's multiplier does, the friction that comes with it included but for that of a pair that is to be smooth;
    /// `of` is the part for friction alone, and which of its values.
    pub(super) fn with_friction(
        &mut self,
        own: A::Value,
        by: RowOf,
        without: Without,
        of: impl Fn(Pusher) -> (Part, usize),
    ) -> A::Value {
        let RowOf::Pair(pair) = by else { return own };
        if without == Without::Friction(pair) {
            return own;
        }
        let pairs = self.equations.pair_list();
        pairs.rubbing(pair).fold(own, |sum, rubbing| {
            let Some(tie) = self.tie(rubbing) else { return sum };
            let (part, which) = of(Pusher::Row(RowOf::Slip(rubbing)));
            let rubbed = self.part(part).swap_remove(which);
            let rubbed = self.algebra.binary(Binary::Mul, tie, rubbed);
            self.algebra.binary(Binary::Add, sum, rubbed)
        })
    }

    fn right_sides(&mut self, system: &System) -> Vec<A::Value> {
        let mut free: FastMap<usize, Vec<A::Value>> = FastMap::default();
        for body in system.rows.iter().flat_map(|(_, bodies)| bodies).chain(&system.recoils) {
            if !free.contains_key(body) {
                let accelerations = self.free_accelerations(*body);
                free.insert(*body, accelerations);
            }
        }
        let mut right = vec![];
        for (row, _) in &system.rows {
            let piece = self.equations.piece(Part::RowAcceleration(*row));
            let acceleration = self.exports_with(&piece, |_, meaning| match meaning {
                Meaning::Acceleration { body, which } => free.get(&body).map(|own| own[which].clone()),
                _ => None,
            });
            right.extend(acceleration);
        }
        for body in &system.lights {
            let [_, _, torque] = self.given(*body);
            right.push(torque);
        }
        for body in &system.recoils {
            let given = self.given(*body);
            let piece = self.equations.piece(Part::Reaction(*body));
            right.extend(self.exports_with(&piece, |_, meaning| match meaning {
                Meaning::Acceleration { body, which } => free.get(&body).map(|own| own[which].clone()),
                Meaning::Total { which, .. } => Some(given[which].clone()),
                _ => None,
            }));
        }
        right.into_iter().map(|side| self.algebra.unary(Unary::Neg, side)).collect()
    }

    /// Those that a body would have if nothing kept its rows.
    fn free_accelerations(&mut self, body: usize) -> Vec<A::Value> {
        let given = self.given(body);
        let piece = self.equations.piece(Part::Acceleration(body));
        self.exports_with(&piece, |_, meaning| match meaning {
            Meaning::Total { which, .. } => Some(given[which].clone()),
            _ => None,
        })
    }
}
