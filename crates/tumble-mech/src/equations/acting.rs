//! What acts in a mode: terms of loads, pivots and contacts, and formulas in what the mode knows.

use std::convert::Infallible;
use std::sync::Arc;

use tumble_expr::{Expr, Substitution, Symbol, Vector};

use super::{Definitions, Equations};
use crate::constraints::JointEquations;
use crate::coordinates::{force_symbols, total_force};
use crate::feedback::Readings;
use crate::link::{Linking, TermOf, Written};
use crate::mode::Mode;
use crate::term::Term;

impl Equations {
    /// The terms that act in a mode, reactions of pivots included, in the states of the mode.
    pub fn terms(&self, mode: &Mode) -> Vec<Term> {
        let definitions = self.definitions_of(mode);
        self.terms_with(self.acting(mode), mode, |formula| definitions.apply(formula))
    }

    /// The terms that act in a mode as a reader wants to see them: places and velocities in the states, accelerations
    /// and the forces of contacts by their symbols.
    pub fn shown_terms(&self, mode: &Mode) -> Vec<Term> {
        // What a brake does while it holds is what its law says otherwise.
        let is_law = |(term, _): &(TermOf, bool)| !matches!(term, TermOf::Brake(..));
        let acting = self.acting_terms(mode).filter(is_law).map(|(term, _)| self.term(term)).collect();
        self.terms_with(acting, mode, |formula| self.shown(mode, formula))
    }

    /// A formula of the bodies' motion with what is not a state in those that are; accelerations stay symbols.
    pub(crate) fn in_coordinates(&self, formula: &Expr) -> Expr {
        self.parts.definitions.apply(formula)
    }

    pub(crate) fn shown(&self, mode: &Mode, formula: &Expr) -> Expr {
        self.absent(mode).apply(&self.changes(mode).apply(&self.parts.definitions.apply(formula)))
    }

    fn terms_with(&self, acting: Vec<&Term>, mode: &Mode, shown: impl Fn(&Expr) -> Expr) -> Vec<Term> {
        let by_body = self.acting_by_body(mode);
        let reactions = mode.bodies.iter().filter_map(|&index| {
            let body = &self.parts.bodies[index];
            let force = total_force(&by_body[index]);
            body.coordinates.reaction(index, &body.kinematics, &body.mass, &force)
        });
        let terms = acting.iter().map(|term| (*term).clone()).chain(reactions);
        let vector = |v: &Vector| v.map(&shown);
        let shown_terms = terms.map(|term| Term {
            arm: vector(&term.arm),
            force: vector(&term.force),
            couple: shown(&term.couple),
            ..term
        });
        shown_terms.collect()
    }

    /// A formula of any kinematic symbols, accelerations included, in the states of a mode.
    pub fn in_states(&self, mode: &Mode, formula: &Expr) -> Expr {
        self.definitions_of(mode).apply(formula)
    }

    /// What every kinematic symbol stands for in a mode.
    fn definitions_of(&self, mode: &Mode) -> Arc<Definitions> {
        let build = || Ok::<_, Infallible>(self.define(mode));
        self.parts.built.definitions.get(mode, build).unwrap_or_else(|never| match never {})
    }

    fn define(&self, mode: &Mode) -> Definitions {
        let names = self.names();
        let mut linking = Linking::new(self, mode, Written);
        let mut kinematic = Substitution::default();
        for body in &mode.bodies {
            let own = names.of_body(*body);
            let places = own.places.iter().filter(|_| self.is_pivoted(*body));
            for name in places.chain(&own.accelerations).chain(&own.forces) {
                kinematic.insert(names.get(*name).0.clone(), linking.value(*name));
            }
        }
        Definitions { kinematic, changes: self.changes(mode) }
    }

    /// What pivots do in a mode, by the symbols of their forces.
    pub(crate) fn pivot_terms(&self, mode: &Mode) -> impl Iterator<Item = Term> {
        let none = Vector::planar(Expr::zero(), Expr::zero());
        mode.bodies.iter().filter_map(move |&index| {
            let body = &self.parts.bodies[index];
            let term = body.coordinates.reaction(index, &body.kinematics, &body.mass, &none)?;
            let [x, y] = force_symbols(&term.load).map(Expr::from);
            Some(Term { force: Vector::planar(x, y), ..term })
        })
    }

    /// Parameters that events have given other formulas.
    pub(crate) fn changes(&self, mode: &Mode) -> Substitution {
        let mut changes = Substitution::default();
        self.changes_by(&mode.changes).for_each(|(symbol, formula)| changes.insert(symbol, formula));
        changes
    }

    /// What events change parameters to, the later after the earlier.
    pub(crate) fn changes_by(&self, events: &[usize]) -> impl Iterator<Item = (Symbol, Expr)> {
        let settings = events.iter().flat_map(|event| self.model.events[*event].settings());
        settings.filter_map(|(name, formula)| {
            Some((self.model.parameters.symbol(name)?.clone(), formula.clone()))
        })
    }

    /// The terms that act in a mode, each with whether it is there to keep a row.
    pub(crate) fn acting_terms(&self, mode: &Mode) -> impl Iterator<Item = (TermOf, bool)> {
        let acts = |term: &Term| mode.has(term.body) && term.window.is_none_or(|window| mode.windows[window]);
        let loads = self.parts.terms.iter().zip(0..).filter(move |(term, _)| acts(term));
        let loads = loads.map(|(_, load)| (TermOf::Load(load), false));
        let sides = |pair: usize| 0..self.pairs()[pair].bodies().count();
        let across =
            move |pair: usize, keeps: bool| sides(pair).map(move |side| (TermOf::Pair(pair, side), keeps));
        let along = move |pair: usize| {
            let keeps = !mode.has_known_friction(pair);
            sides(pair).map(move |side| (TermOf::Friction(pair, side), keeps))
        };
        let pressed = mode.pressed().flat_map(move |pair| across(pair, false));
        let held = mode.held().flat_map(move |pair| across(pair, true));
        let rubbing = mode.rubbing().flat_map(along);
        let joints = self.parts.joints.iter().enumerate().filter(|(joint, _)| self.holds(mode, *joint));
        let of_joint = |(joint, known): (usize, &JointEquations)| {
            (0..known.terms.len()).map(move |term| (TermOf::Joint(joint, term), true)).collect::<Vec<_>>()
        };
        let of_brake = |brake: usize| {
            (0..self.parts.brakes[brake].terms.len()).map(move |term| (TermOf::Brake(brake, term), true))
        };
        let braked = mode.braked().flat_map(of_brake);
        loads.chain(pressed).chain(held).chain(rubbing).chain(joints.flat_map(of_joint)).chain(braked)
    }

    pub(crate) fn acting(&self, mode: &Mode) -> Vec<&Term> {
        self.acting_terms(mode).map(|(term, _)| self.term(term)).collect()
    }

    /// All terms that are not of contacts or joints.
    pub(crate) fn loads(&self) -> &[Term] {
        &self.parts.terms
    }

    /// By load, the forces of contacts and joints that it reads.
    pub(crate) fn readings(&self) -> &[Readings] {
        &self.parts.readings
    }

    /// The same by body.
    pub(crate) fn acting_by_body(&self, mode: &Mode) -> Vec<Vec<&Term>> {
        let mut by_body = vec![vec![]; self.parts.bodies.len()];
        self.acting(mode).into_iter().for_each(|term| by_body[term.body].push(term));
        by_body
    }
}

pub(crate) fn on_body<'a>(terms: &[&'a Term], body: usize) -> Vec<&'a Term> {
    terms.iter().copied().filter(|term| term.body == body).collect()
}
