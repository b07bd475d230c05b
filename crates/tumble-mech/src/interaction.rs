//! What laws between bodies and their surroundings have in common.

use std::fmt::Debug;

use tumble_expr::{Dimension, Expr, Vector};

use crate::air::Wind;
use crate::body::Body;
use crate::model::Model;
use crate::potential::Potential;
use crate::statement::Statement;
use crate::term::{Law, Term};

/// A law of force that the model knows by its coefficients.
pub trait Interaction: Debug + Send + Sync {
    /// Its name.
    fn name(&self) -> &str;
    /// The terms it contributes.
    fn terms(&self, bodies: &Bodies<'_>) -> Vec<Term>;
    /// What it says of each load, as it is written on a board; nothing of a law that leaves it to its terms.
    fn statements(&self, _: &Bodies<'_>) -> Vec<Statement> {
        vec![]
    }
    /// The energy that its terms, or a part of them, come from, if there is one.
    fn potential(&self, _: &Bodies<'_>) -> Option<Potential> {
        None
    }
    /// Names of the bodies it acts on.
    fn bodies(&self) -> Vec<&str>;
    /// Its coefficients: key, formula, dimension it must have.
    fn dimensions(&self) -> Vec<(&'static str, Expr, Dimension)>;
    /// Coefficients that must not be negative: key, formula, SI unit.
    fn nonnegative(&self) -> Vec<(&'static str, Expr, &'static str)> {
        vec![]
    }
    /// Angles, rad, among its coefficients: key, formula.
    fn angles(&self) -> Vec<(&'static str, Expr)> {
        vec![]
    }
    /// Vectors that must point somewhere: key, formula.
    fn directions(&self) -> Vec<(&'static str, Vector)> {
        vec![]
    }
    /// Places of its two ends, m, where it is something between two points.
    fn ends(&self) -> Option<[Vector; 2]> {
        None
    }
    /// Whether its terms depend on [`Bodies::nodes`].
    fn is_quadrature(&self, _: &Wind) -> bool {
        false
    }
}

/// What an interaction may look up.
#[derive(Clone, Copy)]
pub struct Bodies<'a> {
    bodies: &'a [Body],
    /// The air.
    pub wind: &'a Wind,
    /// Gauss nodes on each line that has no closed form.
    pub nodes: usize,
}

impl<'a> Bodies<'a> {
    pub(crate) fn of(model: &'a Model) -> Self {
        Self { bodies: &model.bodies, wind: &model.wind, nodes: model.nodes }
    }

    /// A term on the body of that name; the model was checked to have it.
    pub(crate) fn term(
        &self,
        load: &str,
        law: Law,
        body: &str,
        arm: Vector,
        force: Vector,
        couple: Expr,
    ) -> Term {
        let body = self.bodies.iter().position(|known| known.name == body).expect("the model was checked");
        Term { load: load.to_owned(), law, body, arm, force, couple, window: None }
    }
}
