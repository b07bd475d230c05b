//! The equations of statics of a mode as formulas.

use tumble_expr::{Expr, Layout, Substitution, Symbol};

use crate::coordinates::Measure;
use crate::equations::{Equations, on_body};
use crate::laws::compliant;
use crate::mode::Mode;
use crate::row::Row;

impl Equations {
    /// States that are coordinates of a body which something can move, each with what it measures: what has no moment of inertia
    /// and is not turned has no angle of its own.
    pub(super) fn moved_coordinates(&self, mode: &Mode, body: usize) -> Vec<(usize, Measure)> {
        let known = self.body_equations(body);
        let is_point = !self.is_pivoted(body)
            && tumble_expr::is_identically_zero(&known.mass.inertia)
            && !self.is_turned_by_joints(mode, body);
        let coordinates = self.coordinate_states(mode, body).into_iter().zip(self.coordinate_measures(body));
        coordinates.filter(|(_, measure)| !(is_point && *measure == Measure::Angle)).collect()
    }

    /// Kinematic symbols and forces of contacts in the states, all velocities zero; rows that are left out push nothing.
    pub(super) fn still(&self, mode: &Mode, rows: &[Row]) -> Substitution {
        let mut halted = Substitution::default();
        for &body in &mode.bodies {
            let motion = &self.body_equations(body).kinematics;
            let velocities = motion.velocity_symbols().into_iter().chain([motion.omega_symbol()]);
            velocities.for_each(|velocity| halted.insert(velocity, Expr::zero()));
            for symbol in motion.position_symbols().into_iter().filter(|_| self.is_pivoted(body)) {
                let place = self.in_coordinates(&symbol.clone().into());
                halted.insert(symbol, place);
            }
        }
        let mut still = halted.clone();
        let is_row = |symbol: &Symbol| rows.iter().any(|row| row.multiplier == *symbol);
        let joints = self.model().joints.iter().flat_map(|joint| joint.multipliers());
        let pairs = self.pairs().iter().map(|pair| pair.force_symbol());
        joints
            .chain(pairs)
            .filter(|symbol| !is_row(symbol))
            .for_each(|symbol| still.insert(symbol, Expr::zero()));
        for pair in mode.pressed().map(|pair| &self.pairs()[pair]) {
            let mut depth = Substitution::default();
            depth.insert(pair.root_symbol(), (-pair.gap()).sqrt());
            let force = compliant::normal_force(pair).unwrap_or_else(Expr::zero);
            still.insert(pair.force_symbol(), halted.apply(&depth.apply(&force)));
        }
        still
    }
}

/// Forces, their sizes, masses, what is zero in each row, and the derivatives of forces and rows by the coordinates.
pub(super) fn outputs(
    equations: &Equations,
    mode: &Mode,
    rows: &[Row],
    still: &Substitution,
    layout: &Layout,
    coordinates: &[usize],
) -> Vec<Expr> {
    let acting = equations.acting(mode);
    let (mut forces, mut strengths, mut masses) = (vec![], vec![], vec![]);
    for &body in &mode.bodies {
        let known = equations.body_equations(body);
        let own = on_body(&acting, body);
        let whole = known.coordinates.forces(&known.kinematics, &own);
        let sizes: Vec<Vec<Expr>> =
            own.iter().map(|term| known.coordinates.sizes(&known.kinematics, term)).collect();
        let moved: Vec<usize> =
            equations.moved_coordinates(mode, body).iter().map(|(state, _)| *state).collect();
        let states = equations.coordinate_states(mode, body);
        for (place, ((force, mass), state)) in
            whole.into_iter().zip(equations.masses(mode, body)).zip(states).enumerate()
        {
            if moved.contains(&state) {
                forces.push(still.apply(&force));
                let size = sizes.iter().fold(Expr::zero(), |sum, parts| sum + &parts[place]);
                strengths.push(still.apply(&size));
                masses.push(still.apply(&mass));
            }
        }
    }
    let gaps: Vec<Expr> = rows.iter().map(|row| still.apply(&row.position)).collect();
    let derivatives = |of: &[Expr]| -> Vec<Expr> {
        let by = |formula: &Expr| {
            let symbols = formula.symbols();
            let one = |state: &usize| match symbols.contains(&layout.states[*state]) {
                true => formula.derivative(&layout.states[*state]),
                false => Expr::zero(),
            };
            coordinates.iter().map(one).collect::<Vec<_>>()
        };
        of.iter().flat_map(by).collect()
    };
    let (stiffness, gradient) = (derivatives(&forces), derivatives(&gaps));
    [forces, strengths, masses, gaps, stiffness, gradient].concat()
}
