//! The rows that hold bodies together in a mode, and what keeps them: see [`crate::row`].

use std::collections::{BTreeMap, BTreeSet};

use tumble_expr::{Binary, Expr, FastMap, Unary};

use super::algebra::Algebra;
use super::linking::Linking;
use super::names::Meaning;
use super::part::{Part, RowOf};
use crate::equations::Equations;
use crate::mode::Mode;

/// The islands of a mode.
#[derive(Default)]
pub(super) struct Islands {
    all: Vec<Island>,
    of_body: FastMap<usize, usize>,
}

/// Bodies that joints keep together.
#[derive(Default)]
struct Island {
    /// Of joints, without what is redundant, then of contacts; each with its bodies.
    rows: Vec<(RowOf, Vec<usize>)>,
    /// Bodies without moment of inertia that joints turn.
    lights: Vec<usize>,
    is_solved: bool,
}

impl Islands {
    pub(super) fn of(equations: &Equations, mode: &Mode) -> Self {
        let mut found = Self::default();
        for (index, bodies) in equations.islands(mode, &mode.bodies).into_iter().enumerate() {
            let is_light = |body: &usize| equations.is_turned_by_joints(mode, *body);
            let lights = bodies.iter().copied().filter(is_light).collect();
            found.of_body.extend(bodies.into_iter().map(|body| (body, index)));
            found.all.push(Island { lights, ..Island::default() });
        }
        let joints = equations.rows_by_joint(mode).into_iter();
        let rows = joints.filter(|(index, _)| !mode.redundant.contains(index)).map(|(_, row)| row);
        let contacts = mode.held().map(RowOf::Pair).chain(mode.sticking().map(RowOf::Slip));
        for row in rows.chain(contacts) {
            let bodies = equations.bodies_of(row);
            if let Some(island) = bodies.first().and_then(|body| found.of_body.get(body)) {
                found.all[*island].rows.push((row, bodies));
            }
        }
        found
    }

    pub(super) fn is_light(&self, body: usize) -> bool {
        self.of_body.get(&body).is_some_and(|island| self.all[*island].lights.contains(&body))
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

    /// Friction of a pair that is tied to its normal force, for each unit of that.
    fn tie(&mut self, pair: usize) -> Option<A::Value> {
        let tie = self.equations.tie(self.mode, pair)?;
        Some(self.formula(&tie))
    }

    fn keeping(&mut self, body: usize, row: RowOf) -> A::Value {
        let island = &self.islands.all[self.islands.of_body[&body]];
        if !island.rows.iter().any(|(own, _)| *own == row) {
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
        let island = &mut self.islands.all[index];
        let (rows, lights) = (std::mem::take(&mut island.rows), island.lights.clone());
        let matrix = self.matrix(&rows, &lights, None);
        let right = self.right_sides(&rows, &lights);
        let found = self.algebra.solve(matrix, right);
        let names = rows.iter().map(|(row, _)| self.names.of_row(*row));
        let turning = lights.iter().map(|body| self.names.of_body(*body).accelerations[2]);
        let names: Vec<_> = names.chain(turning).collect();
        names.into_iter().zip(found).for_each(|(name, value)| self.settle(name, value));
        self.islands.all[index].rows = rows;
    }

    /// How much a push at a pair moves it while all other rows of its island hold, 1/kg; one pair may be without its friction.
    pub(super) fn yielding(&mut self, pair: usize, smooth: Option<usize>) -> A::Value {
        let index = self.islands.of_body[&self.equations.pairs()[pair].body];
        let island = &mut self.islands.all[index];
        let (rows, lights) = (std::mem::take(&mut island.rows), island.lights.clone());
        let matrix = self.matrix(&rows, &lights, smooth);
        let one = self.formula(&Expr::one());
        let mut right = vec![self.algebra.zero(); matrix.len()];
        let place = rows.iter().position(|(row, _)| *row == RowOf::Pair(pair)).unwrap_or_default();
        right[place] = one.clone();
        let found = self.algebra.solve(matrix, right).swap_remove(place);
        self.islands.all[index].rows = rows;
        self.algebra.binary(Binary::Div, one, found)
    }

    /// Entries by row: what multipliers do to the accelerations of rows, and their torques on bodies without moment of inertia.
    fn matrix(
        &mut self,
        rows: &[(RowOf, Vec<usize>)],
        lights: &[usize],
        smooth: Option<usize>,
    ) -> Vec<Vec<(usize, A::Value)>> {
        // Bodies have few neighbours: all other entries are zero.
        let mut on_body: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for (index, (_, bodies)) in rows.iter().enumerate() {
            bodies.iter().for_each(|body| _ = on_body.entry(*body).or_default().insert(index));
        }
        let mut matrix: Vec<BTreeMap<usize, A::Value>> = vec![BTreeMap::new(); rows.len() + lights.len()];
        for (i, (row, bodies)) in rows.iter().enumerate() {
            let others: BTreeSet<usize> = bodies.iter().flat_map(|body| &on_body[body]).copied().collect();
            for j in others.into_iter().filter(|j| *j >= i) {
                let entry = self.part(Part::Response(*row, rows[j].0)).remove(0);
                let [below, above] = [(rows[j].0, *row), (*row, rows[j].0)].map(|(of, by)| {
                    self.with_friction(entry.clone(), by, smooth, |slip| Part::Response(of, slip))
                });
                matrix[j].insert(i, below);
                matrix[i].insert(j, above);
            }
        }
        for (place, body) in (rows.len()..).zip(lights) {
            for index in on_body.get(body).into_iter().flatten().copied() {
                let row = rows[index].0;
                let entry = self.part(Part::Torque(row, *body)).remove(0);
                matrix[index].insert(place, entry.clone());
                let pushed = self.with_friction(entry, row, smooth, |slip| Part::Torque(slip, *body));
                matrix[place].insert(index, pushed);
            }
        }
        matrix.into_iter().map(|row| row.into_iter().collect()).collect()
    }

    /// What a unit of a row's multiplier does, the friction that comes with it included but for that of a pair that is to be smooth;
    /// `of` is the part for friction alone.
    pub(super) fn with_friction(
        &mut self,
        own: A::Value,
        by: RowOf,
        smooth: Option<usize>,
        of: impl Fn(RowOf) -> Part,
    ) -> A::Value {
        let RowOf::Pair(pair) = by else { return own };
        if smooth == Some(pair) {
            return own;
        }
        let pairs = self.equations.pair_list();
        pairs.rubbing(pair).fold(own, |sum, rubbing| {
            let Some(tie) = self.tie(rubbing) else { return sum };
            let rubbed = self.part(of(RowOf::Slip(rubbing))).remove(0);
            let rubbed = self.algebra.binary(Binary::Mul, tie, rubbed);
            self.algebra.binary(Binary::Add, sum, rubbed)
        })
    }

    fn right_sides(&mut self, rows: &[(RowOf, Vec<usize>)], lights: &[usize]) -> Vec<A::Value> {
        let mut free: FastMap<usize, Vec<A::Value>> = FastMap::default();
        for body in rows.iter().flat_map(|(_, bodies)| bodies) {
            if !free.contains_key(body) {
                let accelerations = self.free_accelerations(*body);
                free.insert(*body, accelerations);
            }
        }
        let mut right = vec![];
        for (row, _) in rows {
            let piece = self.equations.piece(Part::RowAcceleration(*row));
            let acceleration = self.exports_with(&piece, |_, meaning| match meaning {
                Meaning::Acceleration { body, which } => free.get(&body).map(|own| own[which].clone()),
                _ => None,
            });
            right.extend(acceleration);
        }
        for body in lights {
            let [_, _, torque] = self.given(*body);
            right.push(torque);
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
