//! The symbols of a model, counted, and what each means whatever the mode.

use std::collections::HashMap;

use tumble_expr::{Dimension, Symbol};

use super::part::RowOf;
use crate::equations::Equations;
use crate::parameters::time_symbol;

/// A symbol by its number.
pub(crate) type Name = u32;

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// The time, or a state wherever it has a value.
    Leaf,
    /// A parameter, which events may have changed.
    Parameter,
    /// Of a body: x, y, vx or vy of its centre.
    Place { body: usize, which: usize },
    /// Of a body: ax, ay or alpha.
    Acceleration { body: usize, which: usize },
    /// Of all terms on a body: force along x and y, torque about what it turns about.
    Total { body: usize, which: usize },
    /// Force of a body's pivot along x or y.
    Reaction { body: usize, which: usize },
    /// What keeps a row of a joint, by its order there.
    Multiplier { joint: usize, row: usize },
    /// The force of a pair along its normal.
    Normal { pair: usize },
    /// The same along its surface.
    Friction { pair: usize },
    /// The sign in a brake.
    Sign { brake: usize },
    /// What keeps its rate zero.
    Brake { brake: usize },
    /// Rate of a force that loads read otherwise than linearly, by its index.
    Rate { index: usize },
}

/// All symbols of the motion, the time and the parameters.
#[derive(Debug, Default)]
pub(crate) struct Names {
    by_symbol: HashMap<Symbol, Name>,
    all: Vec<(Symbol, Meaning)>,
    of_bodies: Vec<OfBody>,
    /// By joint and row.
    multipliers: Vec<Vec<Name>>,
    /// By pair.
    normals: Vec<Name>,
    /// Of pairs with friction.
    frictions: HashMap<usize, Name>,
    brakes: Vec<Name>,
}

/// Names of what belongs to a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct OfBody {
    /// x, y, vx, vy
    pub(crate) places: [Name; 4],
    /// ax, ay, alpha
    pub(crate) accelerations: [Name; 3],
    /// Of its pivot, its pairs and its joints.
    pub(crate) forces: Vec<Name>,
}

/// Symbols for what all terms on a body do, force along x and y and torque: no formula of a model has them.
pub(crate) fn totals(body: &str) -> [Symbol; 3] {
    let named =
        |(what, dimension): (&str, Dimension)| Symbol::new(format!("all on {body}: {what}"), dimension);
    [("fx", Dimension::FORCE), ("fy", Dimension::FORCE), ("torque", Dimension::TORQUE)].map(named)
}

impl Names {
    pub(crate) fn of(equations: &Equations) -> Self {
        let (model, mut names) = (equations.model(), Self::default());
        names.add(time_symbol(), Meaning::Leaf);
        for symbol in model.parameters.symbols() {
            names.add(symbol, Meaning::Parameter);
        }
        for body in 0..model.bodies.len() {
            let own = names.add_body(equations, body);
            names.of_bodies.push(own);
        }
        for (index, pair) in equations.pairs().iter().enumerate() {
            let normal = names.add(pair.force_symbol(), Meaning::Normal { pair: index });
            pair.bodies().for_each(|body| names.of_bodies[body].forces.push(normal));
            names.normals.push(normal);
            if pair.friction.is_some() {
                let friction = names.add(pair.friction_symbol(), Meaning::Friction { pair: index });
                pair.bodies().for_each(|body| names.of_bodies[body].forces.push(friction));
                names.frictions.insert(index, friction);
            }
            names.add(pair.root_symbol(), Meaning::Leaf);
        }
        for (index, joint) in equations.joints().iter().enumerate() {
            let mut own = vec![];
            for (row, symbol) in joint.multipliers().iter().enumerate() {
                own.push(names.add(symbol.clone(), Meaning::Multiplier { joint: index, row }));
            }
            joint.bodies.iter().for_each(|body| names.of_bodies[*body].forces.extend(&own));
            names.multipliers.push(own);
            for (symbol, _) in &joint.seat {
                names.add(symbol.clone(), Meaning::Leaf);
            }
        }
        for (index, known) in equations.algebraic().iter().enumerate() {
            names.add(known.state.clone(), Meaning::Leaf);
            names.add(known.rate.clone(), Meaning::Rate { index });
        }
        for (index, brake) in equations.brakes().iter().enumerate() {
            let sign = names.add(brake.sign.clone(), Meaning::Sign { brake: index });
            let force = names.add(brake.row.multiplier.clone(), Meaning::Brake { brake: index });
            brake.bodies.iter().for_each(|body| names.of_bodies[*body].forces.extend([sign, force]));
            names.brakes.push(force);
        }
        names
    }

    fn add_body(&mut self, equations: &Equations, body: usize) -> OfBody {
        let kinematics = &equations.body_equations(body).kinematics;
        self.add_all([kinematics.angle_symbol(), kinematics.omega_symbol()], |_| Meaning::Leaf);
        let ([x, y], [vx, vy]) = (kinematics.position_symbols(), kinematics.velocity_symbols());
        let [ax, ay] = kinematics.acceleration_symbols();
        let places = self.add_all([x, y, vx, vy], |which| Meaning::Place { body, which });
        let accelerations =
            self.add_all([ax, ay, kinematics.alpha_symbol()], |which| Meaning::Acceleration { body, which });
        self.add_all(totals(&kinematics.body), |which| Meaning::Total { body, which });
        let pivot = equations.model().pivot_of(&kinematics.body);
        let forces =
            pivot.map(|pivot| self.add_all(pivot.force_symbols(), |which| Meaning::Reaction { body, which }));
        OfBody { places, accelerations, forces: forces.into_iter().flatten().collect() }
    }

    fn add_all<const N: usize>(
        &mut self,
        symbols: [Symbol; N],
        meaning: impl Fn(usize) -> Meaning,
    ) -> [Name; N] {
        let mut which = 0..;
        symbols.map(|symbol| self.add(symbol, meaning(which.next().unwrap_or_default())))
    }

    fn add(&mut self, symbol: Symbol, meaning: Meaning) -> Name {
        let next = self.all.len() as Name;
        let name = *self.by_symbol.entry(symbol.clone()).or_insert(next);
        if name == next {
            self.all.push((symbol, meaning));
        }
        name
    }

    /// The number of a symbol, if the model has it.
    pub(crate) fn find(&self, symbol: &Symbol) -> Option<Name> {
        self.by_symbol.get(symbol).copied()
    }

    /// A symbol and what it means.
    pub(crate) fn get(&self, name: Name) -> (&Symbol, Meaning) {
        let (symbol, meaning) = &self.all[name as usize];
        (symbol, *meaning)
    }

    /// What keeps a row.
    pub(crate) fn of_row(&self, row: RowOf) -> Name {
        match row {
            RowOf::Joint(joint, row) => self.multipliers[joint][row],
            RowOf::Pair(pair) => self.normals[pair],
            RowOf::Slip(pair) => self.frictions[&pair],
            RowOf::Brake(brake) => self.brakes[brake],
        }
    }

    /// Whether it is a state wherever it has a value and does not follow from others.
    pub(crate) fn is_state(&self, name: Name) -> bool {
        let (symbol, meaning) = self.get(name);
        matches!(meaning, Meaning::Leaf | Meaning::Place { .. }) && *symbol != time_symbol()
    }

    /// What belongs to a body.
    pub(crate) fn of_body(&self, body: usize) -> &OfBody {
        &self.of_bodies[body]
    }
}
