//! # Law
//! A load may depend on forces of contacts and joints, `F = F_0 + sum_j G_j lambda_j`, where F_0 and each G_j are any functions of the
//! time and the states: friction `-mu N sign(v)`, a wheel's drag that grows with the force of its axle. Such loads are found together with the forces
//! that they read: with a_i what a row would do without multipliers and A_ij what a unit of lambda_j does to it, the rows that hold
//! solve `(A + C) lambda = -a`, where C_ij is what G_j does to row i. A pivot's force R, which is no multiplier, is one unknown more:
//! `R = R_0 + sum_j (what a unit of lambda_j adds to it)`. An impact knows nothing of such loads, since they are finite.
//! # Symbols and units
//! F (N, or N m), lambda_j and R forces that are read (N), G_j (1, or m), A and C (1/kg).
//! # Sign and frame
//! World axes. A contact's force along its normal is never negative, and zero while it is open; so is what a joint does that does not hold.
//! # Validity
//! The load is linear in the forces that it reads, else it is one of [`crate::algebraic`]. Where it feeds back so much of a force that a push there comes
//! to move nothing, or moves it the wrong way, that force is not determined: refused in time. So is a load that reads a force which is
//! not unique.
//! # Source
//! Lagrange's equations of the first kind, with forces that depend on the multipliers.
//! # Checked by
//! `tests/feedback.rs`: a block that is pulled, on a slope, two blocks in contact, a pendulum with a drag that grows with its axle's force against
//! an independent integration, a gain that comes to one.

use std::collections::{HashMap, HashSet};

use tumble_expr::{Expr, Substitution, Symbol};
use tumble_ode::Reason;

use crate::algebraic::stated;
use crate::constraints::JointEquations;
use crate::contact::{Pair, WEDGED};
use crate::equations::Equations;
use crate::error::{ModelError, ModelErrors};
use crate::link::{Linking, Written};
use crate::mode::Mode;
use crate::model::Model;
use crate::row::Wrench;
use crate::term::Term;
use crate::uniqueness::Spot;

/// What a term reads of forces that are found with the motion.
#[derive(Clone, Debug, Default)]
pub(crate) struct Readings {
    /// Their symbols, in the order of their names.
    pub(crate) symbols: Vec<Symbol>,
    /// Bodies that they act on.
    pub(crate) bodies: Vec<usize>,
}

/// Symbols of forces that are found with the motion.
pub(crate) fn forces(model: &Model, pairs: &[Pair], joints: &[JointEquations]) -> HashSet<Symbol> {
    owners(model, pairs, joints).into_keys().collect()
}

/// By term, what it reads.
pub(crate) fn readings(
    model: &Model,
    terms: &[Term],
    pairs: &[Pair],
    joints: &[JointEquations],
) -> Result<Vec<Readings>, ModelErrors> {
    let owners = owners(model, pairs, joints);
    let all: HashSet<Symbol> = owners.keys().cloned().collect();
    let mistakes: Vec<ModelError> = terms.iter().filter_map(|term| mistake(term, &all)).collect();
    if !mistakes.is_empty() {
        return Err(ModelErrors(mistakes));
    }
    let of = |term: &Term| {
        let read = Expr::symbols_of(&formulas(term));
        let mut symbols: Vec<Symbol> = read.into_iter().filter(|symbol| all.contains(symbol)).collect();
        symbols.sort_unstable_by(|a, b| a.name.cmp(&b.name));
        let mut bodies: Vec<usize> = symbols.iter().flat_map(|symbol| &owners[symbol]).copied().collect();
        bodies.sort_unstable();
        bodies.dedup();
        Readings { symbols, bodies }
    };
    Ok(terms.iter().map(of).collect())
}

/// Forces that are found with the motion, each with the bodies that it acts on.
fn owners(model: &Model, pairs: &[Pair], joints: &[JointEquations]) -> HashMap<Symbol, Vec<usize>> {
    let of_pairs = pairs.iter().flat_map(|pair| {
        [pair.force_symbol(), pair.friction_symbol()].map(|symbol| (symbol, pair.bodies().collect()))
    });
    let of_joints = joints.iter().flat_map(|joint| {
        joint.multipliers().iter().map(|symbol| (symbol.clone(), joint.bodies.clone())).collect::<Vec<_>>()
    });
    let of_pivots = model.pivots.iter().flat_map(|pivot| {
        let body: Vec<usize> = model.body_index(&pivot.body).into_iter().collect();
        pivot.force_symbols().map(|symbol| (symbol, body.clone()))
    });
    of_pairs.chain(of_joints).chain(of_pivots).collect()
}

fn formulas(term: &Term) -> Vec<Expr> {
    [term.force.components(), std::slice::from_ref(&term.couple), term.arm.components()].concat()
}

/// That forces are read by the place of a term.
fn mistake(term: &Term, forces: &HashSet<Symbol>) -> Option<ModelError> {
    let used = Expr::symbols_of(term.arm.components());
    let mut read: Vec<String> = used.intersection(forces).map(|symbol| symbol.name.to_string()).collect();
    read.sort_unstable();
    (!read.is_empty()).then(|| ModelError::PlaceByForces { load: term.load.clone(), read })
}

/// What a load is for each unit of a force that it reads.
pub(crate) fn for_each_unit(term: &Term, force: &Symbol) -> Wrench {
    Wrench {
        body: term.body,
        arm: term.arm.clone(),
        force: term.force.map(|component| component.derivative(force)),
        couple: term.couple.derivative(force),
    }
}

impl Equations {
    /// Loads that act in a mode and read forces, each with its index.
    pub(crate) fn feeding(&self, mode: &Mode) -> impl Iterator<Item = (usize, &Term)> {
        let reads = self.readings().iter().enumerate().filter(|(_, readings)| !readings.symbols.is_empty());
        let loads = reads.map(|(load, _)| (load, &self.loads()[load]));
        loads.filter(|(_, term)| mode.has(term.body) && term.window.is_none_or(|window| mode.windows[window]))
    }

    /// Forces that loads read and that are nothing in a mode: of what is open, and of joints that do not hold.
    pub(crate) fn absent(&self, mode: &Mode) -> Substitution {
        let mut absent = Substitution::default();
        let read: HashSet<&Symbol> =
            self.feeding(mode).flat_map(|(load, _)| &self.readings()[load].symbols).collect();
        if read.is_empty() {
            return absent;
        }
        let mut leave_out = |symbol: Symbol| {
            if read.contains(&symbol) {
                absent.insert(symbol, Expr::zero());
            }
        };
        for (index, pair) in self.pairs().iter().enumerate() {
            if !mode.held().chain(mode.pressed()).any(|held| held == index) {
                leave_out(pair.force_symbol());
                leave_out(pair.friction_symbol());
            }
        }
        let joints = self.joints().iter().enumerate().filter(|(joint, _)| !self.holds(mode, *joint));
        joints.flat_map(|(_, joint)| joint.multipliers().to_vec()).for_each(leave_out);
        absent
    }

    /// Whether a load on any of some bodies reads forces.
    pub(crate) fn is_fed(&self, bodies: &[usize]) -> bool {
        let mut loads = self.loads().iter().zip(self.readings());
        loads.any(|(term, readings)| !readings.symbols.is_empty() && bodies.contains(&term.body))
            || self.algebraic().iter().any(|known| bodies.contains(&known.body))
    }

    /// Refuses forces that loads read and that are not determined: where a guard says so, by its order among those, or where too little is left
    /// of them now; and those that are not unique.
    pub(crate) fn refuse_feedback(&self, at: Spot<'_>, told: &[usize]) -> Result<(), Reason> {
        let fed = match self.feeding(at.mode).next() {
            Some(_) => Linking::new(self, at.mode, Written).feedback(),
            None => vec![],
        };
        if let Some(steep) = told.iter().find_map(|index| index.checked_sub(fed.len())) {
            let known = &self.algebraic()[self.implicit(at.mode)[steep]];
            return Err(Reason::Model(self.undetermined(&known.force.name, &known.loads, WEDGED)));
        }
        let left: Vec<Expr> = fed.iter().map(|fed| fed.left.clone()).collect();
        // What events have set is written in them already.
        let as_written = Mode { changes: vec![], ..at.mode.clone() };
        let left = self.values(&left, &as_written, at.time, at.states, at.inputs)?;
        let is_wrong =
            |(index, left): (usize, &f64)| told.contains(&index) || left.is_nan() || *left <= WEDGED;
        match left.iter().enumerate().position(is_wrong) {
            Some(wrong) => {
                Err(Reason::Model(self.undetermined(&fed[wrong].force, &fed[wrong].loads, left[wrong])))
            }
            None => self.feeding(at.mode).try_for_each(|(load, term)| {
                self.refuse_open(at, term, &self.readings()[load].symbols, &stated(term))
            }),
        }
    }

    /// That a force is not determined where it stands alone.
    pub(crate) fn jammed(&self, force: &Symbol, mode: &Mode, left: f64) -> String {
        let reads = |(load, _): &(usize, &Term)| self.readings()[*load].symbols.contains(force);
        let loads: Vec<usize> = self.feeding(mode).filter(reads).map(|(load, _)| load).collect();
        self.undetermined(&force.name, &loads, left)
    }

    pub(crate) fn undetermined(&self, force: &str, loads: &[usize], left: f64) -> String {
        let loads = self.load_names(loads);
        let how = match left {
            left if left.abs() <= 2.0 * WEDGED => "no force keeps the bodies, or any does",
            left if left < 0.0 => "the more it pushes, the more it would have to",
            _ => "it has no finite value",
        };
        format!(
            "`{force}` is not determined: {loads} depends on it and leaves the part {left} of what it does by itself, so that {how} \
             (jamming). Let {loads} depend less on it"
        )
    }

    /// Refuses a load that depends on forces which are not unique, as those of three feet on one floor, where it is not unique for that.
    pub(crate) fn refuse_open(
        &self,
        at: Spot<'_>,
        term: &Term,
        read: &[Symbol],
        formulas: &[Expr],
    ) -> Result<(), Reason> {
        let open = self.spreads(at.mode, at.time, at.states, at.inputs, formulas)?;
        if open.iter().all(Option::is_none) {
            return Ok(());
        }
        let read: Vec<String> = read.iter().map(|symbol| format!("`{}`", symbol.name)).collect();
        Err(Reason::Model(format!(
            "`{}` depends on {}, and more contacts or joints bear the load than are needed: how much each of them bears is not \
             determined, and the motion depends on it. Let it depend on their sum, or let one hold less",
            term.load,
            read.join(", ")
        )))
    }

    pub(crate) fn load_names(&self, loads: &[usize]) -> String {
        let mut names: Vec<String> =
            loads.iter().map(|load| format!("`{}`", self.loads()[*load].load)).collect();
        names.dedup();
        names.join(" and ")
    }
}
