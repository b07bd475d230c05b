//! Loads that read forces of contacts and joints, in the systems that these are found from: see [`crate::feedback`].

use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

use tumble_expr::{Binary, Expr, Unary};

use super::algebra::Algebra;
use super::island::{Entries, System, Without};
use super::linking::Linking;
use super::names::{Meaning, Name};
use super::part::{Part, Pusher, RowOf, TermOf};
use crate::contact::WEDGED;
use crate::equations::Equations;
use crate::mode::Mode;

/// A force that loads read.
pub(crate) struct Fed<Value> {
    /// Its name.
    pub(crate) force: String,
    /// The loads, by index.
    pub(crate) loads: Vec<usize>,
    /// Part that they leave of what a unit of it does to its own equation: 1 without them, 0 where it is not determined.
    pub(crate) left: Value,
}

impl Equations {
    /// Forces that are found by a system of a mode.
    pub(super) fn unknowns(&self, mode: &Mode, system: &System) -> Vec<Name> {
        let names = self.names();
        let of_row = |(row, _): &(RowOf, Vec<usize>)| {
            let pair = if let RowOf::Pair(pair) = row { Some(*pair) } else { None };
            let rubbing = pair.into_iter().flat_map(|pair| self.pair_list().rubbing(pair));
            let tied = rubbing.filter(|rubbing| self.tie(mode, *rubbing).is_some()).map(RowOf::Slip);
            std::iter::once(*row).chain(tied).map(|row| names.of_row(row)).collect::<Vec<_>>()
        };
        let recoils = system.recoils.iter().flat_map(|body| names.of_body(*body).forces[..2].to_vec());
        system.rows.iter().flat_map(of_row).chain(recoils).collect()
    }

    /// Bodies with a pivot whose force a load reads.
    pub(super) fn recoiling(&self, load: usize) -> Vec<usize> {
        let of_pivot =
            |(_, meaning)| if let Meaning::Reaction { body, .. } = meaning { Some(body) } else { None };
        self.read_by(load).into_iter().filter_map(of_pivot).collect()
    }

    /// What a load reads.
    fn read_by(&self, load: usize) -> Vec<(Name, Meaning)> {
        let names = self.names();
        let read = self.readings()[load].symbols.iter().filter_map(|symbol| names.find(symbol));
        read.map(|name| (name, names.get(name).1)).collect()
    }
}

impl<A: Algebra> Linking<'_, A> {
    /// What a term does where nothing keeps any row.
    pub(super) fn without_feedback(&mut self, term: TermOf) -> Vec<A::Value> {
        let piece = self.equations.piece(Part::Term(term));
        let (unknowns, zero) = (Rc::clone(&self.islands.unknowns), self.algebra.zero());
        self.exports_with(&piece, |name, _| unknowns.contains(&name).then(|| zero.clone()))
    }

    /// Equations of the pivots' forces that are read: each is what all that is unknown makes of it.
    pub(super) fn add_recoils(&mut self, system: &System, without: Without, matrix: &mut Entries<A::Value>) {
        let one = self.formula(&Expr::one());
        let less = self.algebra.unary(Unary::Neg, one);
        for (first, body) in system.places_of_recoils() {
            let own = system.rows.iter().enumerate().filter(|(_, (_, bodies))| bodies.contains(&body));
            for (which, place) in [first, first + 1].into_iter().enumerate() {
                matrix[place].insert(place, less.clone());
                for (index, (row, _)) in own.clone() {
                    let entry = self.part(Part::Recoil(body, Pusher::Row(*row))).swap_remove(which);
                    let of = |slip| (Part::Recoil(body, slip), which);
                    let entry = self.with_friction(entry, *row, without, of);
                    matrix[place].insert(index, entry);
                }
            }
        }
    }

    /// What loads do for each unit of the forces that they read.
    pub(super) fn add_feedback(&mut self, system: &System, matrix: &mut Entries<A::Value>) {
        for &(load, body) in &system.feeding {
            for (name, meaning) in self.equations.read_by(load) {
                let Some((column, tie)) = self.column(system, meaning) else { continue };
                for (place, part, which) in fed_by(system, body, Pusher::Load(load, name)) {
                    let mut entry = self.part(part).swap_remove(which);
                    if let Some(tie) = &tie {
                        entry = self.algebra.binary(Binary::Mul, tie.clone(), entry);
                    }
                    if let Some(known) = matrix[place].get(&column).cloned() {
                        entry = self.algebra.binary(Binary::Add, known, entry);
                    }
                    matrix[place].insert(column, entry);
                }
            }
        }
    }

    /// Place of the unknown that a force follows from, and, for friction that is tied to one, how much it is of that; `None` of what is
    /// known, or zero.
    fn column(&mut self, system: &System, meaning: Meaning) -> Option<(usize, Option<A::Value>)> {
        match meaning {
            Meaning::Normal { pair } => system.place_of(RowOf::Pair(pair)).map(|place| (place, None)),
            Meaning::Friction { pair } => match self.tie(pair) {
                None => system.place_of(RowOf::Slip(pair)).map(|place| (place, None)),
                tie => {
                    let owner = self.equations.pair_list().owner.get(&pair).copied().unwrap_or(pair);
                    system.place_of(RowOf::Pair(owner)).map(|place| (place, tie))
                }
            },
            Meaning::Multiplier { joint, row } => {
                system.place_of(RowOf::Joint(joint, row)).map(|place| (place, None))
            }
            Meaning::Reaction { body, which } => {
                let mut recoils = system.places_of_recoils();
                recoils.find(|(_, own)| *own == body).map(|(first, _)| (first + which, None))
            }
            _ => None,
        }
    }

    /// Of every force that loads read how much the loads leave of what a unit of it does to its own equation.
    pub(crate) fn feedback(&mut self) -> Vec<Fed<A::Value>> {
        let mut found = vec![];
        for system in self.islands.fed() {
            for (place, loads) in self.read_places(&system) {
                let [left, own] = [Without::Nothing, Without::Feedback]
                    .map(|without| self.yielding_at(&system, place, without));
                let left = self.algebra.binary(Binary::Div, left, own);
                found.push(Fed { force: self.name_of_unknown(&system, place), loads, left });
            }
        }
        found
    }

    /// What unit forces at some contacts of an island do to the accelerations of each, row by row, with what loads do that read forces; `None`
    /// where none does.
    pub(super) fn pushes_of(&mut self, island: &[usize], contacts: &[RowOf]) -> Option<Vec<A::Value>> {
        let system = self.islands.together(island);
        let is_braked = system.rows.iter().any(|(row, _)| matches!(row, RowOf::Brake(_)));
        if system.feeding.is_empty() && !is_braked {
            return None;
        }
        let first = system.rows.len();
        let rows = contacts.iter().map(|row| (*row, self.equations.bodies_of(*row)));
        let rows = system.rows.iter().cloned().chain(rows).collect();
        let matrix = self.matrix(&System { rows, ..system }, Without::Nothing);
        let own = first..first + contacts.len();
        let others: Vec<usize> = (0..matrix.len()).filter(|place| !own.contains(place)).collect();
        let kept = self.kept_up(&matrix, &others, own.clone());
        let mut found = vec![];
        for row in own.clone() {
            for (column, kept) in own.clone().zip(&kept) {
                let direct = self.entry(&matrix, row, column);
                let with = others.iter().zip(kept).filter(|(place, _)| matrix[row].contains_key(place));
                found.push(with.fold(direct, |sum, (place, unknown)| {
                    let taken = self.algebra.binary(Binary::Mul, matrix[row][place].clone(), unknown.clone());
                    self.algebra.binary(Binary::Sub, sum, taken)
                }));
            }
        }
        Some(found)
    }

    /// By column, what all that is kept takes to make up for a unit of it, negative.
    fn kept_up(
        &mut self,
        matrix: &Entries<A::Value>,
        others: &[usize],
        columns: Range<usize>,
    ) -> Vec<Vec<A::Value>> {
        let place = |place: &usize| others.binary_search(place).ok();
        let row =
            |row: &usize| matrix[*row].iter().filter_map(|(at, entry)| Some((place(at)?, entry.clone())));
        let among: Entries<A::Value> = others.iter().map(|other| row(other).collect()).collect();
        let right = |column: usize| others.iter().map(|row| self.entry(matrix, *row, column)).collect();
        let rights: Vec<Vec<A::Value>> = columns.map(right).collect();
        rights.into_iter().map(|right| self.solved(among.clone(), right)).collect()
    }

    fn entry(&mut self, matrix: &Entries<A::Value>, row: usize, column: usize) -> A::Value {
        matrix[row].get(&column).cloned().unwrap_or_else(|| self.algebra.zero())
    }

    /// What becomes zero where a force that loads read is determined no more.
    pub(super) fn too_much_feedback(&mut self) -> Vec<(String, A::Value)> {
        let least = self.formula(&Expr::from(WEDGED));
        let fed = self.feedback().into_iter();
        let guards =
            fed.map(|Fed { force, left, .. }| (force, self.algebra.binary(Binary::Sub, left, least.clone())));
        guards.map(|(force, formula)| (format!("{force}.feedback"), formula)).collect()
    }

    /// Places of what loads read among the unknowns of a system, in order, each with those loads.
    fn read_places(&mut self, system: &System) -> BTreeMap<usize, Vec<usize>> {
        let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (load, _) in &system.feeding {
            for (_, meaning) in self.equations.read_by(*load) {
                let Some((place, _)) = self.column(system, meaning) else { continue };
                let loads = found.entry(place).or_default();
                if !loads.contains(load) {
                    loads.push(*load);
                }
            }
        }
        found
    }

    fn name_of_unknown(&self, system: &System, place: usize) -> String {
        let row = system.rows.get(place).map(|(row, _)| self.names.of_row(*row));
        let mut recoils = system.places_of_recoils();
        let name = row.or_else(|| {
            let (first, body) = recoils.find(|(first, _)| place < first + 2)?;
            Some(self.names.of_body(body).forces[place - first])
        });
        name.map_or_else(String::new, |name| self.names.get(name).0.name.to_string())
    }
}

/// What something that acts on a body does to which equations of a system, and which of the part's values.
fn fed_by(system: &System, body: usize, by: Pusher) -> Vec<(usize, Part, usize)> {
    let rows = system.rows.iter().enumerate().filter(|(_, (_, bodies))| bodies.contains(&body));
    let rows = rows.map(|(place, (row, _))| (place, Part::Response(*row, by), 0));
    let lights = system.places_of_lights().filter(|(_, own)| *own == body);
    let lights = lights.map(|(place, _)| (place, Part::Torque(by, body), 0));
    let recoils = system.places_of_recoils().filter(|(_, own)| *own == body);
    let recoils =
        recoils.flat_map(|(first, _)| [0, 1].map(|which| (first + which, Part::Recoil(body, by), which)));
    rows.chain(lights).chain(recoils).collect()
}
