//! The equations of motion of one body, in its coordinates.

use tumble_expr::{Expr, Symbol, Vector};

use crate::coordinates::{Coordinates, StateRate, force_symbols, total_force};
use crate::kinematics::Kinematics;
use crate::link::total;
use crate::mass::MassProperties;
use crate::model::Model;
use crate::row::Wrench;
use crate::term::Term;

/// A body as its equations see it.
#[derive(Clone, Debug)]
pub(crate) struct BodyEquations {
    pub(crate) kinematics: Kinematics,
    pub(crate) mass: MassProperties,
    pub(crate) coordinates: Coordinates,
    /// Its states in order.
    pub(crate) states: Vec<StateRate>,
}

impl BodyEquations {
    /// Those of a body of a model, by index.
    pub(crate) fn of(model: &Model, index: usize) -> Self {
        let body = &model.bodies[index];
        let mass = body.mass_properties();
        let coordinates = Coordinates::of(model.pivot_of(&body.name), &mass);
        let kinematics = body.kinematics();
        let states = coordinates.states(&kinematics);
        Self { kinematics, mass, coordinates, states }
    }

    /// What a unit of one wrench on the body does along another.
    pub(crate) fn response(&self, i: &Wrench, j: &Wrench) -> Expr {
        self.coordinates.response(&self.kinematics, &self.mass, i, j)
    }

    /// What its pivot does to it under these terms, by its symbols, in accelerations.
    pub(crate) fn reaction(&self, index: usize, terms: &[&Term]) -> Vec<(Symbol, Expr)> {
        let term = self.coordinates.reaction(index, &self.kinematics, &self.mass, &total_force(terms));
        let by_symbol = |term: Term| {
            let components = term.force.components().to_vec();
            force_symbols(&term.load).into_iter().zip(components).collect()
        };
        term.map(by_symbol).unwrap_or_default()
    }

    /// What a unit of a wrench on the body does to the force of its pivot.
    pub(crate) fn recoil(&self, by: &Wrench) -> Vector {
        self.coordinates.recoil(&self.kinematics, &self.mass, by)
    }

    /// Force of its pivot along x and y, in accelerations and the sum of all terms by its symbols.
    pub(crate) fn reaction_to_all(&self) -> Vec<Expr> {
        let (force, _) = total(&self.kinematics.body);
        let term = self.coordinates.reaction(0, &self.kinematics, &self.mass, &force);
        term.map(|term| term.force.components().to_vec()).unwrap_or_default()
    }

    /// The accelerations, of the centre along x and y and of the angle, in the sum of all terms by its symbols.
    pub(crate) fn accelerations(&self) -> Vec<Expr> {
        let (force, torque) = total(&self.kinematics.body);
        let (a, alpha) = self.coordinates.accelerations(&self.kinematics, &self.mass, (&force, &torque));
        vec![a.x().clone(), a.y().clone(), alpha]
    }
}
