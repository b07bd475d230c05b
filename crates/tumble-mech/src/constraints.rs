//! What holds bodies in a mode: the rows of joints and of lasting contacts, by island, and the forces that keep them.

use std::collections::HashMap;

use tumble_expr::{Expr, Symbol, is_identically_zero};

use crate::contact::{ContactMode, Grip, Pair};
use crate::coordinates::{Coordinates, Measure, StateRate};
use crate::equations::{Equations, Window};
use crate::joint::{Joint, Side};
use crate::link::RowOf;
use crate::mode::Mode;
use crate::model::Model;
use crate::placement::Placement;
use crate::row::{Row, Wrench};
use crate::term::Term;

/// A joint with its bodies by index.
#[derive(Clone, Debug)]
pub(crate) struct JointEquations {
    pub(crate) bodies: Vec<usize>,
    pub(crate) rows: Vec<Row>,
    pub(crate) terms: Vec<Term>,
    /// States that it has while it holds, with what they are when it begins to.
    pub(crate) seat: Vec<(Symbol, Measure)>,
    pub(crate) seat_values: Vec<Expr>,
    /// Symbols of what keeps it, also while it does not hold.
    multipliers: Vec<Symbol>,
}

impl JointEquations {
    /// Those of a model, in its order.
    pub(crate) fn all(model: &Model) -> Vec<Self> {
        if model.joints.is_empty() {
            return vec![];
        }
        let placements = model.placements();
        let bodies: HashMap<&str, usize> =
            model.bodies.iter().enumerate().map(|(index, body)| (body.name.as_str(), index)).collect();
        // The model was checked: it has them all.
        let index = |name: &str| bodies[name];
        model.joints.iter().map(|joint| Self::of(joint, index, &placements)).collect()
    }

    fn of(joint: &Joint, index: impl Fn(&str) -> usize + Copy, placements: &[Placement]) -> Self {
        let angle = |side: Side<'_>| side.sign * &placements[index(&side.point.body.body)].angle;
        let angle = joint.sides().map(angle).fold(Expr::zero(), |sum, angle| sum + angle);
        Self {
            bodies: joint.bodies().map(index).collect(),
            rows: joint.rows(&angle, index),
            terms: joint.terms(index),
            seat: joint.seat(),
            seat_values: joint.seat_values(),
            multipliers: joint.multipliers(),
        }
    }
}

impl JointEquations {
    /// Symbols of what keeps it, in the order of its rows.
    pub(crate) fn multipliers(&self) -> &[Symbol] {
        &self.multipliers
    }

    /// Symbols that it brings.
    pub(crate) fn symbols(&self) -> Vec<Symbol> {
        let seat = self.seat.iter().map(|(symbol, _)| symbol);
        self.multipliers.iter().chain(seat).cloned().collect()
    }
}

impl Equations {
    /// Whether a joint, by its index, holds in a mode: one of other bodies does not.
    pub fn holds(&self, mode: &Mode, joint: usize) -> bool {
        let holds = self.model().joints[joint].from.is_none() != mode.switched.contains(&joint);
        holds && self.joints()[joint].bodies.iter().all(|body| mode.has(*body))
    }

    /// The same mode as far as it is that of some bodies, which no joint holds to others now. What has become of a joint to others is
    /// kept.
    pub(crate) fn restricted(&self, mode: &Mode, bodies: &[usize]) -> Mode {
        let has = |body: &usize| bodies.binary_search(body).is_ok();
        let joints = self.joints();
        let rows = self.joints_of_rows();
        let windows = self.windows().iter().zip(&mode.windows);
        Mode {
            bodies: bodies.to_vec(),
            windows: windows.map(|(window, acts)| *acts && has(&window.body)).collect(),
            changes: mode.changes.clone(),
            grips: some_pairs(&mode.grips, |pair| self.pairs()[pair].bodies().all(|body| has(&body))),
            brakes: some_pairs(&mode.brakes, |brake| self.brakes()[brake].bodies.iter().all(has)),
            still: some_of(&mode.still, has),
            contacts: mode
                .contacts
                .iter()
                .filter(|(pair, _)| self.pairs()[*pair].bodies().all(|body| has(&body)))
                .copied()
                .collect(),
            switched: some_of(&mode.switched, |joint| joints[*joint].bodies.iter().any(has)),
            redundant: some_of(&mode.redundant, |row| joints[rows[*row]].bodies.iter().all(has)),
        }
    }

    /// By row, the joint that it belongs to.
    pub(crate) fn joints_of_rows(&self) -> Vec<usize> {
        let joints = self.joints().iter().enumerate();
        joints.flat_map(|(joint, known)| known.rows.iter().map(move |_| joint)).collect()
    }

    /// Modes of different bodies at one time as one.
    pub(crate) fn as_one(&self, modes: &[&Mode]) -> Mode {
        let all = |of: fn(&Mode) -> &Vec<usize>| {
            let mut all: Vec<usize> = modes.iter().flat_map(|mode| of(mode)).copied().collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let acts = |(index, window): (usize, &Window)| {
            modes.iter().any(|mode| mode.has(window.body) && mode.windows[index])
        };
        let mut contacts: Vec<_> = modes.iter().flat_map(|mode| &mode.contacts).copied().collect();
        contacts.sort_unstable();
        let mut grips: Vec<_> = modes.iter().flat_map(|mode| &mode.grips).copied().collect();
        grips.sort_unstable();
        let mut brakes: Vec<_> = modes.iter().flat_map(|mode| &mode.brakes).copied().collect();
        brakes.sort_unstable();
        Mode {
            bodies: all(|mode| &mode.bodies),
            windows: self.windows().iter().enumerate().map(acts).collect(),
            // What sets parameters is an event of all.
            changes: modes.first().map(|mode| mode.changes.clone()).unwrap_or_default(),
            contacts,
            grips,
            brakes,
            still: all(|mode| &mode.still),
            switched: all(|mode| &mode.switched),
            redundant: all(|mode| &mode.redundant),
        }
    }

    /// Rows of the joints that hold in a mode, all that are counted by [`Mode::redundant`] included: index and row.
    pub(crate) fn joint_rows(&self, mode: &Mode) -> impl Iterator<Item = (usize, &Row)> {
        let joints = self.joints().iter().enumerate();
        let rows =
            joints.flat_map(|(joint, known)| known.rows.iter().map(move |row| (joint, row))).enumerate();
        rows.filter(|(_, (joint, _))| self.holds(mode, *joint)).map(|(index, (_, row))| (index, row))
    }

    /// The rows of the joints that hold in a mode, each with its index among all.
    pub(crate) fn rows_by_joint(&self, mode: &Mode) -> Vec<(usize, RowOf)> {
        let joints = self.joints().iter().enumerate();
        let rows = joints.flat_map(|(joint, known)| (0..known.rows.len()).map(move |row| (joint, row)));
        let holding = rows.enumerate().filter(|(_, (joint, _))| self.holds(mode, *joint));
        holding.map(|(index, (joint, row))| (index, RowOf::Joint(joint, row))).collect()
    }

    /// Bodies that a row is about.
    pub(crate) fn bodies_of(&self, row: RowOf) -> Vec<usize> {
        match row {
            RowOf::Pair(pair) | RowOf::Slip(pair) => self.pairs()[pair].bodies().collect(),
            RowOf::Brake(brake) => self.brakes()[brake].bodies.clone(),
            RowOf::Joint(joint, row) => {
                self.joints()[joint].rows[row].wrenches.iter().map(|wrench| wrench.body).collect()
            }
        }
    }

    /// States of the joints that events have made: they do not change while those hold.
    pub(crate) fn seats(&self, mode: &Mode) -> Vec<StateRate> {
        let joints = self.joints().iter().enumerate().filter(|(joint, _)| self.holds(mode, *joint));
        let state = |(symbol, measure): &(Symbol, Measure)| StateRate {
            symbol: symbol.clone(),
            rate: Expr::zero(),
            measure: *measure,
            per_parameter: false,
        };
        joints.flat_map(|(_, joint)| joint.seat.iter().map(state)).collect()
    }

    /// By body, those that joints, contacts that push and loads that read forces keep it together with in a mode.
    fn neighbours(&self, mode: &Mode) -> Vec<Vec<usize>> {
        let mut neighbours = vec![vec![]; self.model().bodies.len()];
        for (index, joint) in self.joints().iter().enumerate() {
            if let ([a, b], true) = (&joint.bodies[..], self.holds(mode, index)) {
                neighbours[*a].push(*b);
                neighbours[*b].push(*a);
            }
        }
        for (pair, contact_mode) in &mode.contacts {
            let is_in = *contact_mode == ContactMode::Pressed || contact_mode.is_slight();
            if contact_mode.is_lasting() || is_in {
                self.pairs()[*pair].join(&mut neighbours);
            }
        }
        for (load, term) in self.feeding(mode) {
            for other in self.readings()[load].bodies.iter().filter(|body| mode.has(**body)) {
                neighbours[*other].push(term.body);
                neighbours[term.body].push(*other);
            }
        }
        for brake in mode.braked() {
            for two in self.brakes()[brake].bodies.windows(2) {
                neighbours[two[0]].push(two[1]);
                neighbours[two[1]].push(two[0]);
            }
        }
        neighbours
    }

    /// Bodies that joints and lasting contacts keep together with a body in a mode, itself included, in order.
    pub(crate) fn island_of(&self, mode: &Mode, body: usize) -> Vec<usize> {
        self.islands(mode, &[body]).concat()
    }

    /// All islands of some bodies, each once.
    pub(crate) fn islands(&self, mode: &Mode, bodies: &[usize]) -> Vec<Vec<usize>> {
        self.islands_with(mode, bodies, &[])
    }

    /// The same where some pairs couple their bodies besides.
    pub(crate) fn islands_with(&self, mode: &Mode, bodies: &[usize], pairs: &[usize]) -> Vec<Vec<usize>> {
        let mut neighbours = self.neighbours(mode);
        pairs.iter().for_each(|pair| self.pairs()[*pair].join(&mut neighbours));
        let mut is_placed = vec![false; neighbours.len()];
        let mut found = vec![];
        for &body in bodies {
            let (mut island, mut pending) = (vec![], vec![body]);
            while let Some(next) = pending.pop() {
                if !std::mem::replace(&mut is_placed[next], true) {
                    island.push(next);
                    pending.extend(&neighbours[next]);
                }
            }
            island.sort_unstable();
            found.extend((!island.is_empty()).then_some(island));
        }
        found
    }

    /// Those of an island's joints, without what is redundant.
    pub(crate) fn independent_rows_of(&self, mode: &Mode, island: &[usize]) -> Vec<(usize, RowOf)> {
        let is_own = |row: RowOf| self.bodies_of(row).iter().all(|body| island.binary_search(body).is_ok());
        let rows = self.rows_by_joint(mode).into_iter();
        rows.filter(|(index, row)| !mode.redundant.contains(index) && is_own(*row)).collect()
    }

    /// The rows that hold an island in a mode: of its joints, without what is redundant, then of its lasting contacts, and of those that
    /// stick.
    pub(crate) fn rows_on(&self, mode: &Mode, island: &[usize]) -> Vec<Row> {
        let joints = self.independent_rows_of(mode, island).into_iter();
        let own = |pair: &&Pair| island.binary_search(&pair.body).is_ok();
        let held = mode.held().map(|pair| &self.pairs()[pair]).filter(own);
        let sticking = mode.sticking().map(|pair| &self.pairs()[pair]).filter(own);
        joints
            .map(|(_, row)| self.row(row))
            .chain(held.map(Pair::row))
            .chain(sticking.map(Pair::slip_row))
            .collect()
    }

    /// By how fast the conditions change that hold an island of a body in a mode, m/s^2, shown like the terms.
    pub fn shown_constraints(&self, mode: &Mode, body: usize) -> Vec<Expr> {
        let rows = self.rows_on(mode, &self.island_of(mode, body));
        let own = rows.iter().filter(|row| row.wrenches.iter().any(|wrench| wrench.body == body));
        own.map(|row| self.shown(mode, &row.acceleration)).collect()
    }

    /// Whether a body has no moment of inertia and joints hold it beside its centre or its angle: they say how it turns.
    pub(crate) fn is_turned_by_joints(&self, mode: &Mode, body: usize) -> bool {
        let known = self.body_equations(body);
        let is_point = matches!(known.coordinates, Coordinates::Free { is_point: true });
        let turns = |row: &Row| {
            let own = row.wrenches.iter().filter(|wrench| wrench.body == body);
            own.into_iter().any(|Wrench { arm, couple, .. }| {
                !couple.is_zero() || !arm.components().iter().all(is_identically_zero)
            })
        };
        is_point && self.joint_rows(mode).any(|(_, row)| turns(row))
    }

    /// What each velocity of a body takes to be changed, kg or kg m^2.
    pub(crate) fn masses(&self, mode: &Mode, body: usize) -> Vec<Expr> {
        let known = self.body_equations(body);
        known.coordinates.masses(&known.mass, self.is_turned_by_joints(mode, body))
    }
}

fn some_pairs(all: &[(usize, Grip)], keeps: impl Fn(usize) -> bool) -> Vec<(usize, Grip)> {
    all.iter().copied().filter(|(pair, _)| keeps(*pair)).collect()
}

fn some_of(all: &[usize], keeps: impl Fn(&usize) -> bool) -> Vec<usize> {
    all.iter().copied().filter(|one| keeps(one)).collect()
}
