//! What laws say of the loads on bodies, as they are written on a board.
//!
//! Each law states itself beside its terms; that both are the same is held by tests. Names are those of textbooks: u the velocity
//! of the air relative to a point, w that of the wind, r from the centre of mass, d from one end of a spring to the other.

use tumble_expr::{Expr, Vector, Written, is_identically_zero};

use crate::equations::Equations;
use crate::interaction::Bodies;
use crate::laws::{applied, compliant, weight};
use crate::mode::Mode;
use crate::term::{Law, Term};

/// What a law says of one load on one body.
#[derive(Clone, Debug)]
pub struct Statement {
    /// Name of the load.
    pub load: String,
    /// The law.
    pub law: Law,
    /// Index of the body.
    pub body: usize,
    /// The force, N; none of a couple.
    pub force: Option<Written>,
    /// The torque about the centre of mass, N m, where it is more than the arm to one point times the force.
    pub torque: Option<Written>,
}

impl Statement {
    pub(crate) fn of(term: &Term, force: Written) -> Self {
        Self { load: term.load.clone(), law: term.law, body: term.body, force: Some(force), torque: None }
    }

    pub(crate) fn couple(term: &Term, torque: Written) -> Self {
        Self { force: None, torque: Some(torque), ..Self::of(term, Written::Scalar(Expr::zero())) }
    }

    /// With every formula in it through `f`.
    fn map(&self, f: &dyn Fn(&Expr) -> Expr) -> Self {
        let through = |part: &Option<Written>| part.as_ref().map(|part| part.map(f));
        Self { force: through(&self.force), torque: through(&self.torque), ..self.clone() }
    }
}

impl Equations {
    /// What the laws say of the loads that act in a mode, in the symbols of [`Equations::shown_terms`]. Reactions follow from the
    /// other loads: no law says them. Of rigid contacts and friction it is the direction that is said.
    pub fn shown_statements(&self, mode: &Mode) -> Vec<Statement> {
        let acting = self.acting(mode);
        let acts = |statement: &Statement| {
            acting.iter().any(|term| term.load == statement.load && term.body == statement.body)
        };
        let all = self.statements().into_iter().filter(acts);
        all.map(|statement| statement.map(&|formula| self.shown(mode, formula))).collect()
    }

    fn statements(&self) -> Vec<Statement> {
        let model = self.model();
        let bodies = Bodies::of(model);
        let on_body = |body: usize| {
            let weight =
                model.gravity.in_plane().map(|g| weight::statement(body, self.mass_properties(body), &g));
            let own = model.loads.iter().filter(move |load| load.body == model.bodies[body].name);
            let kinematics = model.bodies[body].kinematics();
            let own: Vec<Statement> = own.map(|load| applied::statement(load, body, &kinematics)).collect();
            weight.into_iter().chain(own)
        };
        let interactions = model.interactions.iter().flat_map(|law| law.statements(&bodies));
        let surfaces = self.pairs().iter().filter(|pair| !pair.is_rolling()).flat_map(|pair| {
            let pushes =
                if pair.law.is_rigid() { Some(pair.statement()) } else { compliant::statement(pair) };
            pushes.into_iter().chain(pair.friction_statement())
        });
        (0..model.bodies.len()).flat_map(on_body).chain(interactions).chain(surfaces).collect()
    }
}

/// A coefficient times something; 1 is not written.
pub(crate) fn times(coefficient: &Expr, of: Vec<Written>) -> Written {
    Written::Product(std::iter::once(Written::Scalar(coefficient.clone())).chain(of).collect())
}

/// The sum of what is there; nothing is 0.
pub(crate) fn sum(terms: Vec<Written>) -> Written {
    match <[Written; 1]>::try_from(terms) {
        Ok([only]) => only,
        Err(terms) if terms.is_empty() => Written::Scalar(Expr::zero()),
        Err(terms) => Written::Sum(terms.into_iter().map(|term| (false, term)).collect()),
    }
}

/// Whether a vector is zero whatever its symbols are.
pub(crate) fn vanishes(vector: &Vector) -> bool {
    vector.components().iter().all(is_identically_zero)
}
